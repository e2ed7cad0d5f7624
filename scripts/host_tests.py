"""The generated Python driver (host/efsat.py) against the generated VHDL, in cocotb: run by scripts/cocotb.

    host_tests.py stream DESIGN
    host_tests.py board DESIGN BAUD PACKETS [PAIRS VERDICTS]

DESIGN is the folder of a design; what is made goes to the current folder. Pairs, poses and the answers due are those of
efsat_tb.vec, which are the reference model's. For the board, BAUD is the speed of the line, PACKETS how many packets of
these pairs and poses are sent, PAIRS a CSV file of pairs of real numbers, and VERDICTS what `efsat classify` says of them.
"""

import csv
import os
import random
import sys
from pathlib import Path

import cocotb
from cocotb.clock import Clock
from cocotb.triggers import ClockCycles, FallingEdge, ReadOnly, Timer

DESIGN = Path(os.environ.get("EFSAT_DESIGN") or sys.argv[2]).resolve()
sys.path.insert(0, str(DESIGN / "host"))
import board_line  # noqa: E402
import efsat as unit  # noqa: E402

# Tags of any value: no two neighbours have the same.
TAGS = 1 << unit.TAG_BITS
STEP = 40503
# The vectors of a design with a guard have numbers outside their ranges.
ANY = {"outside": True} if unit.pairs_packet.__kwdefaults__ else {}


def fields(word, count):
    """Signed numbers in a word, the first in its low bits, and what is above them."""
    numbers = [word >> i * unit.NUMBER_BITS & (1 << unit.NUMBER_BITS) - 1 for i in range(count)]
    half = 1 << unit.NUMBER_BITS - 1
    return [(x ^ half) - half for x in numbers], word >> count * unit.NUMBER_BITS


def vectors():
    """(pose, pair, answer) of the vector file; pose is None where it stays: its numbers, and whether it is bypassed."""
    pose = None
    for line in (DESIGN / "efsat_tb.vec").read_text().splitlines():
        kind, *words = line.split()
        if kind == "P":
            numbers, bypass = fields(int(words[0], 16), unit.POSE_NUMBERS)
            pose = (numbers, bypass == 1)
        elif kind == "V":
            numbers, rest = fields(int(words[0], 16), unit.PAIR_NUMBERS)
            assert rest == 0, "this design has sticky bits: expected one without"
            answer, flags = int(words[1], 16), unit.FLAG_BITS
            low = (1 << flags) - 1
            # What is outside the declared ranges no host sends; nor a pose that makes all its pairs so.
            if answer >> 2 + 2 * flags & 1:
                continue
            yield pose, numbers, (answer & 3, answer >> 2 & low, answer >> 2 + flags & low)
            pose = None


def packets(rng, most, cut):
    """Packets and the answers due to each, as tuples; packets have up to `most` pairs, some are cut short."""
    sent, due, pairs = [], [], []
    tag = 0

    def flush():
        if not pairs:
            return
        packet = unit.pairs_packet([(numbers, tag) for numbers, tag, _ in pairs], **ANY)
        answers = [(*answer[:1], 0, False, tag, *answer[1:]) for _, tag, answer in pairs]
        if cut and rng.random() < 0.2:
            # The last record loses its last word: no verdict for it, but a report.
            packet = packet[: -unit.WORD_BITS // 8]
            answers[-1] = (unit.VERDICT_REPORT, unit.REASONS.index("packet too short"), True, 0, 0, 0)
        sent.append(packet)
        due.append(answers)
        pairs.clear()

    for pose, numbers, answer in vectors():
        if pose is not None:
            flush()
            sent.append(unit.pose_packet(*pose, **ANY))
            due.append([(unit.VERDICT_REPORT, unit.REASONS.index("pose taken"), False, 0, 0, 0)])
        tag = (tag + STEP) % TAGS
        pairs.append((numbers, tag, answer))
        if len(pairs) >= rng.randint(1, most):
            flush()
    flush()
    return sent, due


def told(data):
    """Answers as the tuples of `packets`. A guard is compared elsewhere."""
    return [(a.verdict, a.reason, a.malformed, a.tag, a.separated, a.overlapping) for a in unit.answers(data)]


async def feed(dut, sent, stalls, rng):
    """Packets into the wrapper, with clocks without a word."""
    size = unit.WORD_BITS // 8
    for packet in sent:
        for at in range(0, len(packet), size):
            while rng.random() < stalls:
                await FallingEdge(dut.aclk)
            dut.s_axis_tdata.value = int.from_bytes(packet[at : at + size], "little")
            dut.s_axis_tlast.value = int(at + size == len(packet))
            dut.s_axis_tvalid.value = 1
            taken = False
            while not taken:
                await ReadOnly()
                taken = dut.s_axis_tready.value == 1
                await FallingEdge(dut.aclk)
            dut.s_axis_tvalid.value = 0


async def collect(dut, count, stalls, rng):
    """Packets out of the wrapper, with clocks without TREADY."""
    received, data = [], b""
    while len(received) < count:
        ready = rng.random() >= stalls
        dut.m_axis_tready.value = int(ready)
        await ReadOnly()
        if ready and dut.m_axis_tvalid.value == 1:
            data += dut.m_axis_tdata.value.to_unsigned().to_bytes(unit.ANSWER_WORD_BITS // 8, "little")
            if dut.m_axis_tlast.value == 1:
                received.append(data)
                data = b""
        await FallingEdge(dut.aclk)
    return received


async def through_the_wrapper(dut, stalls, seed):
    rng = random.Random(seed)
    sent, due = packets(rng, most=24, cut=True)
    dut.aresetn.value = 0
    dut.s_axis_tvalid.value = 0
    dut.s_axis_tkeep.value = (1 << unit.WORD_BITS // 8) - 1
    dut.m_axis_tready.value = 0
    cocotb.start_soon(Clock(dut.aclk, 10, "ns").start())
    await ClockCycles(dut.aclk, 4)
    await FallingEdge(dut.aclk)
    dut.aresetn.value = 1
    cocotb.start_soon(feed(dut, sent, stalls, random.Random(seed + 1)))
    received = await collect(dut, len(sent), stalls, random.Random(seed + 2))
    pairs = 0
    for i, (data, expected) in enumerate(zip(received, due)):
        assert told(data) == expected, f"packet {i}: {told(data)}, expected {expected}"
        pairs += len(expected)
    dut._log.info(f"{len(sent)} packets, {pairs} answers, all as the reference model's")


@cocotb.test(timeout_time=10, timeout_unit="ms")
async def stream_at_full_speed(dut):
    await through_the_wrapper(dut, 0.0, 1)


@cocotb.test(timeout_time=10, timeout_unit="ms")
async def stream_with_random_stalls(dut):
    await through_the_wrapper(dut, 0.4, 2)


async def board(dut):
    """Resets the design on the ULX3S; returns a function that sends a packet and waits for the answers to it."""
    bit, received = await board_line.reset(dut, DESIGN, int(os.environ["EFSAT_BAUD"]))

    async def exchange(packet, count):
        received.clear()
        await board_line.transmit(dut.ftdi_txd, packet, bit)
        size = count * unit.ANSWER_WORD_BITS // 8
        # The packet ends with the silence; then the last answer leaves.
        await Timer((board_line.SILENCE + 10 * (size + 40)) * bit, "ps")
        assert len(received) == size, f"{len(received)} bytes, expected {size}"
        return bytes(received)

    return exchange


@cocotb.test()
async def board_answers_the_vectors(dut):
    exchange = await board(dut)
    sent, due = packets(random.Random(3), most=6, cut=True)
    most = int(os.environ["EFSAT_PACKETS"])
    for i, (packet, expected) in enumerate(list(zip(sent, due))[:most]):
        found = told(await exchange(packet, len(expected)))
        assert found == expected, f"packet {i}: {found}, expected {expected}"
    dut._log.info(f"{min(most, len(sent))} packets, {sum(map(len, due[:most]))} answers, all as the reference model's")


def rows(variable):
    """The rows of a CSV file that the environment names."""
    with open(os.environ[variable]) as file:
        return list(csv.reader(file))


@cocotb.test()
async def board_decides_pairs_of_real_numbers(dut):
    exchange = await board(dut)
    names = ["separate", "intersect", "possibly-incorrect"]
    pairs = [[unit.number(float(x)) for x in row] for row in rows("EFSAT_PAIRS")]
    verdicts = [verdict for _, verdict in rows("EFSAT_VERDICTS")[1:]]
    assert len(pairs) == len(verdicts) > 0
    await exchange(unit.pose_packet([0] * unit.POSE_NUMBERS, bypass=True), 1)
    tagged = [(pair, i) for i, pair in enumerate(pairs)]
    answers = unit.answers_to(tagged, await exchange(unit.pairs_packet(tagged), len(tagged)))
    found = [(answer.tag, names[answer.verdict]) for answer in answers]
    assert found == list(enumerate(verdicts)), f"{found}, expected {verdicts}"
    dut._log.info(f"{len(pairs)} pairs, {len(set(verdicts))} kinds of verdicts, all as `efsat classify` says")


def main(what, design, baud="", most="", pairs="", verdicts=""):
    tops = {"stream": "efsat_stream", "board": "efsat_ulx3s"}
    if what not in tops:
        sys.exit(f"error: {what}: expected stream or board")
    files, parameters = board_line.synthesised(DESIGN), {}
    if what == "board":
        files = board_line.files(DESIGN)
        parameters = {"baud_rate": int(baud), "silence_bits": board_line.SILENCE}
    environment = {
        "EFSAT_BAUD": baud,
        "EFSAT_PACKETS": most,
        "EFSAT_PAIRS": pairs and str(Path(pairs).resolve()),
        "EFSAT_VERDICTS": verdicts and str(Path(verdicts).resolve()),
    }
    # The other test of the board needs pairs of numbers.
    test_filter = "board_answers_" if what == "board" and not pairs else f"{what}_"
    board_line.simulate(__file__, DESIGN, files, tops[what], what, parameters, environment, test_filter)


if __name__ == "__main__":
    main(*sys.argv[1:])
