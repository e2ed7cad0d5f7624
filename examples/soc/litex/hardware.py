"""A system by LiteX: a RISC-V processor (VexRiscv), memory, a serial line, and two cores of efsat behind their registers.

    hardware.py OUT

writes OUT/soc.v, the files of its memories, and OUT/soc.h with addresses and interrupts for the program. The cores are the
modules pairs_efsat_shell (the unit) and efsat_shell (the engine, which reads trees from the memory of the processor).
"""

import os
import sys

from litex.build.generic_platform import Pins, Subsignal
from litex.build.sim import SimPlatform
from litex.soc.integration.soc import SoCRegion
from litex.soc.integration.soc_core import SoCCore
from litex.soc.interconnect import axi
from migen import ClockDomain, ClockSignal, Instance, Module, ResetSignal, Signal

SERIAL = [("valid", 1), ("ready", 1), ("data", 8)]
PINS = [
    ("clock", 0, Pins(1)),
    ("reset", 0, Pins(1)),
    ("serial", 0, *(Subsignal(f"{side}_{name}", Pins(bits)) for side in ("source", "sink") for name, bits in SERIAL)),
]
# The ports of AXI4-Lite that a slave reads, and those that it drives.
LITE_IN = ["awaddr", "awvalid", "wdata", "wstrb", "wvalid", "bready", "araddr", "arvalid", "rready"]
LITE_OUT = ["awready", "wready", "bresp", "bvalid", "arready", "rdata", "rresp", "rvalid"]
# The same of the read port of the engine, which is a master.
READ_OUT = ["araddr", "arlen", "arsize", "arburst", "arcache", "arprot", "arvalid", "rready"]
READ_IN = ["arready", "rdata", "rresp", "rlast", "rvalid"]


def ports(prefix, bus, inputs, outputs):
    """Ports of an instance, by the names of the channels: `awaddr` is `addr` of `aw`."""

    def signal(name):
        channel = name[:2] if name[:2] in ("aw", "ar") else name[0]
        wire = getattr(getattr(bus, channel), name[len(channel) :])
        return wire[:12] if prefix == "s_axi" and name.endswith("addr") else wire

    directions = {"i": inputs, "o": outputs}
    return {f"{way}_{prefix}_{name}": signal(name) for way, names in directions.items() for name in names}


class Clocks(Module):
    def __init__(self, platform):
        self.clock_domains.cd_sys = ClockDomain()
        self.comb += [self.cd_sys.clk.eq(platform.request("clock")), self.cd_sys.rst.eq(platform.request("reset"))]


class System(SoCCore):
    def __init__(self):
        platform = SimPlatform("SIM", PINS, name="soc")
        super().__init__(
            platform,
            clk_freq=int(100e6),
            cpu_type="vexriscv",
            integrated_rom_size=0x20000,
            integrated_rom_init=[0],
            integrated_sram_size=0x2000,
            integrated_main_ram_size=0x40000,
            uart_name="sim",
        )
        self.submodules.clocks = Clocks(platform)
        self.add_core("pairs", "pairs_efsat_shell", 0x9000_0000, {})
        memory = axi.AXIInterface(data_width=32, address_width=32, id_width=1, bursting=True)
        self.bus.add_master("queries_memory", memory)
        self.add_core("queries", "efsat_shell", 0x9000_1000, ports("m_axi", memory, READ_IN, READ_OUT))

    def add_core(self, name, module, origin, more):
        """A core of efsat: its registers at an address of their own, and its interrupt."""
        registers = axi.AXILiteInterface(data_width=32, address_width=32)
        self.bus.add_slave(name, registers, SoCRegion(origin=origin, size=0x1000, cached=False))
        irq = Signal()
        self.irq.add(name, use_loc_if_exists=True)
        self.comb += self.cpu.interrupt[self.irq.locs[name]].eq(irq)
        lite = ports("s_axi", registers, LITE_IN, LITE_OUT)
        self.specials += Instance(module, i_aclk=ClockSignal(), i_aresetn=~ResetSignal(), o_irq=irq, **lite, **more)


def main(out):
    system = System()
    system.finalize()
    os.makedirs(out, exist_ok=True)
    os.chdir(out)
    system.platform.get_verilog(system, name="soc").write("soc.v")
    uart = system.csr_regions["uart"].origin
    constants = {
        "UART_DATA": uart,
        "UART_IS_FULL": uart + 4,
        "PAIRS_BASE": system.bus.regions["pairs"].origin,
        "QUERIES_BASE": system.bus.regions["queries"].origin,
    }
    lines = [f"#define {name} {hex(value)}" for name, value in constants.items()]
    lines += [f"#define {name.upper()}_INTERRUPT {system.irq.locs[name]}" for name in ("pairs", "queries")]
    with open("soc.h", "w") as file:
        file.write("\n".join(["/* Where things are in the system. */", *lines]) + "\n")
    sources = [path for path, language, *_ in system.platform.sources if language == "verilog"]
    with open("sources.txt", "w") as file:
        file.write("\n".join(sources) + "\n")


if __name__ == "__main__":
    main(sys.argv[1])
