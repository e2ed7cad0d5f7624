{% for line in header -%}
# {{ line }}
{% endfor -%}
"""Runs the testbenches of efsat in VUnit: python3 run.py [--help]

VUnit takes testbenches with its own generic, and the ones here are plain VHDL-93. So each gets a small one around it,
written to the output folder. All is compiled as VHDL-93: GHDL does not mix standards.
"""

from pathlib import Path

from vunit import VUnit

RTL = Path(__file__).resolve().parent.parent
BENCHES = {
{%- for bench in benches %}
    "{{ bench.entity }}": "{{ bench.vectors }}",
{%- endfor %}
}
AROUND = """library vunit_lib;
use vunit_lib.run_types_pkg.all;
use vunit_lib.run_pkg.all;

entity tb_{name} is
  generic (runner_cfg : string);
end entity tb_{name};

architecture simulation of tb_{name} is
  signal finished : boolean;
begin
  bench : entity work.{name}{generics} port map (finished => finished);

  main : process
  begin
    test_runner_setup(runner, runner_cfg);
    wait until finished;
    test_runner_cleanup(runner);
    wait;
  end process main;
end architecture simulation;
"""


def main():
    project = VUnit.from_argv(vhdl_standard="93", compile_builtins=False)
    project.add_vhdl_builtins()
    library = project.add_library("{{ prefix }}efsat")
    for name in (RTL / "files.txt").read_text().split():
        library.add_source_file(RTL / name)
    around = Path(project._output_path) / "around"
    around.mkdir(parents=True, exist_ok=True)
    for name, vectors in BENCHES.items():
        generics = f' generic map (vectors => "{(RTL / vectors).as_posix()}")' if vectors else ""
        path = around / f"tb_{name}.vhd"
        text = AROUND.format(name=name, generics=generics)
        if not path.exists() or path.read_text() != text:
            path.write_text(text)
        library.add_source_file(path)
    project.main()


if __name__ == "__main__":
    main()
