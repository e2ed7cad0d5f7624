"""The VHDL of Microwatt as its Python package has it, without the reports of every instruction, which take most of a simulation's time.

    sources.py OUT

writes the files to OUT and prints their names. Assertions stay.
"""

import re
import sys
from pathlib import Path

from pythondata_cpu_microwatt import data_location

FILES = """
    decode_types common wishbone_types utils helpers insn_helpers crhelpers ppc_fx_insns plrufn nonrandom cache_ram predecode fetch1
    icache decode1 control decode2 register_file cr_file countbits logical rotator multiply multiply-32s divider pmu fpu execute1
    loadstore1 mmu dcache writeback core_debug core wishbone_arbiter
""".split()
# A report that is a statement of its own follows the end of one, or a word that begins a list of them.
REPORT = re.compile(r"(;|\bthen|\belse|\bbegin|\bis|\bloop|=>)((?:\s|--[^\n]*\n)*)\breport\b[^;]*;")


def main(out):
    for name in FILES:
        text = (Path(data_location) / f"{name}.vhdl").read_text()
        before = None
        while before != text:
            before, text = text, REPORT.sub(r"\1\2null;", text)
        (Path(out) / f"{name}.vhdl").write_text(text)
        print(f"{name}.vhdl")


if __name__ == "__main__":
    main(sys.argv[1])
