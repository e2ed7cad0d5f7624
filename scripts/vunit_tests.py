"""Wrapper, registers and engine between the models of VUnit, which check the protocols: run by scripts/drop-in.

    vunit_tests.py UNIT ENGINE [options of VUnit]

UNIT is the folder of a unit, ENGINE that of an engine with its trees behind AXI, both generated with --registers. Words are those of the
generated vectors; answers are compared by the generated test for cocotb.
"""

import importlib.util
import sys
from pathlib import Path

from vunit import VUnit

BENCHES = Path(__file__).resolve().parent / "vunit"


def played(design, name):
    """The generated test, which reads vectors and compares answers."""
    spec = importlib.util.spec_from_file_location(name, design / f"cocotb/{name}.py")
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    return module


def whole(packet):
    """The registers carry whole words alone."""
    return all(is_whole for _, _, is_whole in packet)


def add(project, design, test, bench, kept=lambda packet: True):
    """A testbench, the words that it sends, and the comparison of what comes back."""
    test = played(design, test)
    sent, due, memory = test.read()
    chosen = [(packet, answer) for packet, answer in zip(sent, due) if kept(packet)]
    folder = Path(project._output_path) / "words"
    folder.mkdir(parents=True, exist_ok=True)
    words, answers, image = (folder / f"{bench}-{name}.txt" for name in ("words", "answers", "image"))
    lines = (f"{word:016x} {last} {255 if is_whole else 127:02x}" for packet, _ in chosen for word, last, is_whole in packet)
    words.write_text("\n".join(lines) + "\n")
    generics = {"words": words.as_posix(), "answers": answers.as_posix(), "packets": len(chosen)}
    if memory:
        rows = (f"{memory[i]:016x}" if i in memory else "-" for i in range(max(memory) + 1))
        image.write_text("\n".join(rows) + "\n")
        generics["image"] = image.as_posix()

    def compare(output_path):
        packets = [[]]
        for word, last in map(str.split, answers.read_text().splitlines()):
            packets[-1].append(int(word, 16))
            if last == "1":
                packets.append([])
        assert len(packets) == len(chosen) + 1, f"{len(packets) - 1} packets, expected {len(chosen)}"
        for number, (found, (_, expected)) in enumerate(zip(packets, chosen)):
            test.compare(number, found, expected)
        print(f"{bench}: {len(chosen)} packets, all as the reference model's")
        return True

    library = project.add_library(bench)
    library.add_source_files([design / name for name in (design / "files-synthesis.txt").read_text().split()])
    library.add_source_files([BENCHES / "play_pkg.vhd", BENCHES / f"{bench}.vhd"])
    library.test_bench(bench).add_config("words", generics=generics, post_check=compare)


def main(unit, engine, *options):
    unit, engine = Path(unit).resolve(), Path(engine).resolve()
    project = VUnit.from_argv(list(options), vhdl_standard="2008", compile_builtins=False)
    project.add_vhdl_builtins()
    project.add_verification_components()
    project.set_sim_option("ghdl.sim_flags", ["--ieee-asserts=disable-at-0"], allow_empty=True)
    add(project, unit, "test_efsat", "tb_wrapper")
    add(project, unit, "test_efsat", "tb_shell", whole)
    add(project, engine, "test_efsat_engine", "tb_engine")
    project.main()


if __name__ == "__main__":
    main(*sys.argv[1:])
