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


def module_of(design, path):
    """A generated module: the test, which reads vectors and compares answers, or the words of the host."""
    spec = importlib.util.spec_from_file_location(Path(path).stem, design / path)
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    return module


def whole(packet):
    """The registers carry whole words alone."""
    return all(is_whole for _, _, is_whole in packet)


def add(project, design, test, bench, kept=lambda packet: True):
    """A testbench, the words that it sends, and the comparison of what comes back."""
    test = module_of(design, f"cocotb/{test}.py")
    sent, due, memory = test.read()
    chosen = [(packet, answer) for packet, answer in zip(sent, due) if kept(packet)]
    folder = Path(project._output_path) / "words"
    folder.mkdir(parents=True, exist_ok=True)
    library = project.add_library(bench)
    library.add_source_files([design / name for name in (design / "files-synthesis.txt").read_text().split()])
    library.add_source_files([BENCHES / "play_pkg.vhd", BENCHES / f"{bench}.vhd"])
    words = folder / f"{bench}-words.txt"
    lines = (f"{word:016x} {last} {255 if is_whole else 127:02x}" for packet, _ in chosen for word, last, is_whole in packet)
    words.write_text("\n".join(lines) + "\n")
    generics = {"words": words.as_posix(), "packets": len(chosen)}
    if memory:
        image = folder / f"{bench}-image.txt"
        rows = (f"{memory[i]:016x}" if i in memory else "-" for i in range(max(memory) + 1))
        image.write_text("\n".join(rows) + "\n")
        generics |= {"image": image.as_posix(), "errors": 0}

    def config(name, compare, **more):
        answers = folder / f"{bench}-{name}-answers.txt"

        def check(output_path):
            packets = [[]]
            for word, last in map(str.split, answers.read_text().splitlines()):
                packets[-1].append(int(word, 16))
                if last == "1":
                    packets.append([])
            assert len(packets) == len(chosen) + 1, f"{len(packets) - 1} packets, expected {len(chosen)}"
            said = compare([(number, found, due) for number, (found, (_, due)) in enumerate(zip(packets, chosen))])
            print(f"{bench}: {len(chosen)} packets, {said}")
            return True

        library.test_bench(bench).add_config(
            name, generics=generics | {"answers": answers.as_posix()} | more, post_check=check
        )

    def all_right(packets):
        for packet in packets:
            test.compare(*packet)
        return "all as the reference model's"

    def right_or_ended(packets):
        """Where the report says that memory failed, no pair before it is false, and it leaves no pose; all others are right."""
        host = module_of(design, "host/efsat_engine.py")
        ended, posed = 0, True
        for number, found, due in packets:
            *before, head = found[: len(found) - test.REPORT_WORDS + 1] or [0]
            query = isinstance(due, tuple)
            failed = query and head >> host.REPORT_REASON_LOW & 31 == host.REASON_MEMORY
            # The answer to a pose is a word with reason 0.
            posed = not failed and (posed or query or due == [3])
            if not failed:
                if posed or len(due) == 1:
                    test.compare(number, found, due)
                continue
            pairs, (_, mode, *_) = due
            assert mode not in test.NO_OTHER or set(before) <= set(pairs), f"packet {number}: pairs that do not touch"
            ended += 1
        assert 0 < ended < len(packets), f"{ended} packets are ended by an error of memory"
        return f"{ended} ended by an error of memory, all others as the reference model's"

    config("words", all_right)
    if memory:
        config("errors", right_or_ended, errors=2)


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
