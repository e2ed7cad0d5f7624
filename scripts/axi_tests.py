"""The stream wrapper and the registers against models of AXI by others, cocotbext-axi: run by scripts/cocotb.

    axi_tests.py stream DESIGN
    axi_tests.py registers DESIGN

DESIGN is the folder of a design, for `registers` generated with --registers. Packets and answers are those of host_tests.py, and all
channels stall at random. Addresses and fields of registers are those of host/efsat_registers.h.
"""

import itertools
import random
import re
import sys

import board_line
import cocotb
from cocotb.clock import Clock
from cocotb.triggers import ClockCycles
from cocotbext.axi import AxiLiteBus, AxiLiteMaster, AxiResp, AxiStreamBus, AxiStreamSink, AxiStreamSource
from host_tests import DESIGN, packets, told, unit

BYTES = unit.WORD_BITS // 8
ANSWER_BYTES = unit.ANSWER_WORD_BITS // 8


def pauses(seed, share):
    """Whether a channel rests, clock by clock."""
    rng = random.Random(seed)
    return (rng.random() < share for _ in itertools.count())


async def start(dut):
    """The clock, in reset: models look at outputs at once, which have no value before."""
    cocotb.start_soon(Clock(dut.aclk, 10, "ns").start())
    dut.aresetn.value = 0
    await ClockCycles(dut.aclk, 2)


async def release(dut):
    await ClockCycles(dut.aclk, 16)
    dut.aresetn.value = 1
    await ClockCycles(dut.aclk, 2)


def compared(dut, received, due):
    """All answers to all packets."""
    assert len(received) == len(due), f"{len(received)} packets, expected {len(due)}"
    for i, (data, expected) in enumerate(zip(received, due)):
        assert told(data) == expected, f"packet {i}: {told(data)}, expected {expected}"
    dut._log.info(f"{len(due)} packets, {sum(map(len, due))} answers, all as the reference model's")


async def through_streams(dut, share, seed):
    await start(dut)
    source = AxiStreamSource(AxiStreamBus.from_prefix(dut, "s_axis"), dut.aclk, dut.aresetn, reset_active_level=False)
    sink = AxiStreamSink(AxiStreamBus.from_prefix(dut, "m_axis"), dut.aclk, dut.aresetn, reset_active_level=False)
    if share:
        source.set_pause_generator(pauses(seed, share))
        sink.set_pause_generator(pauses(seed + 1, share))
    sent, due = packets(random.Random(seed), most=24, cut=True)
    await release(dut)
    for packet in sent:
        await source.send(packet)
    compared(dut, [bytes((await sink.recv()).tdata) for _ in sent], due)


@cocotb.test(timeout_time=10, timeout_unit="ms")
async def stream_to_models_at_full_speed(dut):
    await through_streams(dut, 0.0, 1)


@cocotb.test(timeout_time=10, timeout_unit="ms")
async def stream_to_models_with_random_stalls(dut):
    await through_streams(dut, 0.4, 2)


class Registers:
    """The registers by their names in the header."""

    def __init__(self, dut, share, seed):
        text = (DESIGN / "host/efsat_registers.h").read_text()
        pattern = r"^#define EFSAT_REGISTERS_(\w+) (?:UINT32_C\()?(0x[0-9a-f]+|\d+)"
        self.constants = {name: int(value, 0) for name, value in re.findall(pattern, text, re.M)}
        self.master = AxiLiteMaster(AxiLiteBus.from_prefix(dut, "s_axi"), dut.aclk, dut.aresetn, reset_active_level=False)
        self.refused = 0
        if share:
            channels = [self.master.write_if.aw_channel, self.master.write_if.w_channel, self.master.write_if.b_channel,
                        self.master.read_if.ar_channel, self.master.read_if.r_channel]
            for i, channel in enumerate(channels):
                channel.set_pause_generator(pauses(seed + i, share))

    def field(self, word, name):
        return (word & self.constants[f"{name}_MASK"]) >> self.constants[f"{name}_SHIFT"]

    async def store(self, at, word, size=4):
        """Whether a write is done."""
        response = (await self.master.write(at, word.to_bytes(4, "little")[:size])).resp
        self.refused += response == AxiResp.SLVERR
        return response == AxiResp.OKAY

    async def load(self, at):
        """The word, none if the read is refused."""
        answer = await self.master.read(at, 4)
        self.refused += answer.resp == AxiResp.SLVERR
        assert answer.resp == AxiResp.OKAY or answer.data == bytes(4)
        return int.from_bytes(answer.data, "little") if answer.resp == AxiResp.OKAY else None

    async def write(self, name, word):
        assert await self.store(self.constants[name], word), name

    async def read(self, name):
        word = await self.load(self.constants[name])
        assert word is not None, name
        return word


async def send(registers, sent, rng):
    """All packets, a word as soon as it is not refused."""
    for packet in sent:
        for at in range(0, len(packet), BYTES):
            low, high = (int.from_bytes(packet[at + i : at + i + 4], "little") for i in (0, 4))
            await registers.write("TRANSMIT_LOW", low)
            name = "TRANSMIT_LAST" if at + BYTES == len(packet) else "TRANSMIT_HIGH"
            while not await registers.store(registers.constants[name], high):
                await ClockCycles(registers.master.write_if.clock, rng.randint(1, 40))


async def receive(dut, registers, count, rng):
    """The answers to packets; each time by the interrupt, or by looking."""
    received, data = [], b""
    while len(received) < count:
        level = registers.field(await registers.read("STATUS"), "STATUS_RECEIVE_LEVEL")
        if not level:
            while dut.irq.value == 0:
                await ClockCycles(dut.aclk, 1)
            await registers.write("PENDING", 1 << registers.constants["PENDING_RECEIVE_SHIFT"])
            continue
        last = registers.field(await registers.read("STATUS"), "STATUS_RECEIVE_LAST")
        low, high = await registers.read("RECEIVE_LOW"), await registers.read("RECEIVE_HIGH")
        data += (low | high << 32).to_bytes(8, "little")[:ANSWER_BYTES]
        if last:
            received.append(data)
            data = b""
    return received


async def disturb(registers, rng, stop):
    """Accesses that are refused, all the time."""
    while not stop:
        at = rng.choice([0x2C, 0x6C, 0xFFC, 0x800])
        assert not await registers.store(at, 0xFFFFFFFF)
        assert await registers.load(at) is None
        assert not await registers.store(registers.constants["CONTROL"], 3, size=rng.randint(1, 3)), "partial"
        assert not await registers.store(registers.constants["IDENTITY"], 3), "only read"
        await ClockCycles(registers.master.write_if.clock, rng.randint(1, 100))


async def through_registers(dut, share, seed):
    await start(dut)
    rng = random.Random(seed)
    registers = Registers(dut, share, seed)
    sent, due = packets(rng, most=9, cut=True)
    sent, due = sent[:40], due[:40]
    await release(dut)
    for name in ("IDENTITY", "VERSION", "PARAMETERS", "CORE"):
        assert await registers.read(name) == registers.constants[f"{name}_RESET"], name
    await registers.write("MASK", registers.constants["MASK_RECEIVE_MASK"])
    await registers.write("CONTROL", registers.constants["CONTROL_ENABLE_MASK"])
    stop = []
    others = cocotb.start_soon(disturb(registers, random.Random(seed + 10), stop))
    sender = cocotb.start_soon(send(registers, sent, random.Random(seed + 11)))
    received = await receive(dut, registers, len(sent), rng)
    stop.append(True)
    await sender
    await others
    compared(dut, received, due)
    assert await registers.read("PACKETS_IN") == await registers.read("PACKETS_OUT") == len(sent)
    verdicts = sum(answer[0] != unit.VERDICT_REPORT for answers in due for answer in answers)
    assert await registers.read("PAIRS") == verdicts
    assert registers.field(await registers.read("REFUSAL"), "REFUSAL_COUNT") == registers.refused > 8


@cocotb.test(timeout_time=20, timeout_unit="ms")
async def registers_at_full_speed(dut):
    await through_registers(dut, 0.0, 1)


@cocotb.test(timeout_time=20, timeout_unit="ms")
async def registers_with_random_stalls(dut):
    await through_registers(dut, 0.3, 2)


def main(what, design):
    tops = {"stream": "efsat_stream", "registers": "efsat_shell"}
    if what not in tops:
        sys.exit(f"error: {what}: expected stream or registers")
    board_line.simulate(__file__, DESIGN, board_line.synthesised(DESIGN), tops[what], f"axi-{what}", {}, {}, f"{what}_")


if __name__ == "__main__":
    main(*sys.argv[1:])
