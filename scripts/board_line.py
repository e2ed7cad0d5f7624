"""A board in simulation: bytes on its serial pins, and the simulator that runs a test. For scripts/host_tests.py and
scripts/engine_host_tests.py, in cocotb."""

import re
import sys
from pathlib import Path

import cocotb
from cocotb.clock import Clock
from cocotb.triggers import FallingEdge, Timer

# Bit times of silence that end a packet.
SILENCE = 64


async def transmit(line, data, bit):
    """Bytes onto a serial line: start bit, eight bits from the lowest, stop bit."""
    for byte in data:
        for level in [0, *(byte >> i & 1 for i in range(8)), 1]:
            line.value = level
            await Timer(bit, "ps")


async def listen(line, bit, received):
    """Bytes from a serial line, for ever."""
    while True:
        await FallingEdge(line)
        await Timer(bit + bit // 2, "ps")
        byte = 0
        for i in range(8):
            byte |= int(line.value) << i
            await Timer(bit, "ps")
        assert line.value == 1, "a byte without a stop bit"
        received.append(byte)


async def reset(dut, design, baud):
    """Resets the design on the ULX3S; picoseconds of a bit, and the bytes that will have come back."""
    top = next((design / "ulx3s").glob("*efsat_ulx3s.vhd")).read_text()
    hertz = int(re.search(r"clock_frequency : positive := (\d+);", top)[1])
    bit = 10**12 // baud
    dut.ftdi_txd.value = 1
    dut.btn_fire1.value = 1
    # The stand-in for the PLL hands this clock on.
    cocotb.start_soon(Clock(dut.clk_25mhz, 10**12 // hertz // 2 * 2, "ps").start())
    await Timer(20 * bit, "ps")
    dut.btn_fire1.value = 0
    await Timer(20 * bit, "ps")
    assert dut.led_0.value == 1 and dut.wifi_gpio0.value == 1 and dut.ftdi_rxd.value == 1
    received = bytearray()
    cocotb.start_soon(listen(dut.ftdi_rxd, bit, received))
    return bit, received


def files(design):
    """The VHDL files of the design on the ULX3S, in dependency order."""
    example = [f"example/{name}.vhd" for name in ("uart_receiver", "uart_transmitter", "efsat_uart_top")]
    return [*synthesised(design), *example, "ulx3s/efsat_ulx3s_stand_in.vhd", "ulx3s/efsat_ulx3s.vhd"]


def synthesised(design):
    """The VHDL files without what is around them."""
    return (design / "files-synthesis.txt").read_text().split()


def simulate(module, design, files, top, folder, parameters, environment, test_filter=None):
    """Runs the tests of a module in GHDL; what is made goes to a folder. Ends with an error if one fails."""
    from cocotb_tools.check_results import get_results
    from cocotb_tools.runner import get_runner

    runner = get_runner("ghdl")
    runner.build(
        sources=[design / file for file in files],
        hdl_toplevel=top,
        build_args=["--std=93"],
        build_dir=folder,
        clean=True,
    )
    results = runner.test(
        test_module=Path(module).stem,
        hdl_toplevel=top,
        parameters=parameters,
        test_args=["--std=93"],
        plusargs=["--ieee-asserts=disable-at-0"],
        test_filter=test_filter,
        build_dir=folder,
        results_xml=str(Path(folder).resolve() / "results.xml"),
        extra_env={"EFSAT_DESIGN": str(design), **environment},
    )
    count, failed = get_results(Path(results))
    if failed or not count:
        sys.exit(f"error: {failed} of {count} tests failed")
