"""The generated Python driver of the engine (host/efsat_engine.py) at the pins of a ULX3S, in cocotb: run by scripts/cocotb.

    engine_host_tests.py DESIGN BAUD ANSWER [ANSWER ...]

DESIGN is the folder of an engine, BAUD the speed of the line, and each ANSWER is what `efsat tree answer A B` prints of the same two
images: the packets, and the answer of the reference model. What is made goes to the current folder.
"""

import json
import os
import sys
from pathlib import Path

import cocotb
from cocotb.triggers import Timer

DESIGN = Path(os.environ.get("EFSAT_DESIGN") or sys.argv[1]).resolve()
sys.path.insert(0, str(DESIGN / "host"))
import board_line  # noqa: E402
import efsat_engine as engine  # noqa: E402

# Bit times without a byte after which no answer is waited for.
PATIENCE = 50_000
COUNTS = ("expansions", "tests", "survivors", "leaf_pairs", "intersect", "possibly_incorrect")


def answer(received, packet):
    """The pairs and the report, if all of them are there."""
    is_query = len(packet) == 8 * engine.QUERY_WORDS
    try:
        return engine.answer(bytes(received), packet if is_query else None)
    except ValueError:
        return None


async def pins(dut):
    """Resets the board; returns a function that sends a packet, and one that does and waits for the answer."""
    bit, received = await board_line.reset(dut, DESIGN, int(os.environ["EFSAT_BAUD"]))

    async def send(packet):
        received.clear()
        await board_line.transmit(dut.ftdi_txd, packet, bit)

    async def ask(packet):
        await send(packet)
        waited = 0
        while (found := answer(received, packet)) is None:
            before = len(received)
            await Timer(20 * bit, "ps")
            waited = waited + 20 if len(received) == before else 0
            assert waited < PATIENCE, f"no answer, only {len(received)} bytes"
        await Timer(40 * bit, "ps")
        pairs, report = found
        size = (len(pairs) + engine.REPORT_WORDS) * 8
        assert len(received) == size, f"{len(received)} bytes, expected {size}"
        return pairs, report

    async def silence():
        await Timer(2 * board_line.SILENCE * bit, "ps")

    return send, ask, silence


def asked():
    """What the files say: packets, and what the reference model answers."""
    return [json.loads(Path(file).read_text()) for file in os.environ["EFSAT_ANSWERS"].split(":")]


def packed(words):
    return b"".join(int(word, 16).to_bytes(8, "little") for word in words)


@cocotb.test()
async def engine_answers_as_the_reference_model(dut):
    _, ask, _ = await pins(dut)
    for words in asked()[0]["loads"]:
        packet = packed(words)
        address = int.from_bytes(packet[8:16], "little")
        assert engine.load(address, packet[16:]) == packet
        pairs, report = await ask(packet)
        assert not pairs and engine.REASONS[report.reason] == "complete" and not report.incomplete, report
        dut._log.info(f"{len(packet)} bytes loaded")
    told = 0
    for query in asked():
        expected = query["expected"]
        pairs, report = await ask(packed(query["query"]))
        found = sorted(pair.verdict | pair.a << 8 | pair.b << 36 for pair in pairs)
        assert found == [int(word, 16) for word in expected["answers"]], f"{pairs}, expected {expected['answers']}"
        assert report.reason == expected["reason"] and not report.incomplete, report
        counts = {name: getattr(report, name) for name in COUNTS}
        assert counts == {name: expected[name] for name in COUNTS}, f"{report}, expected {expected}"
        assert report.clocks > 0
        told += len(pairs)
    assert told > 0, "no query has a pair that touches"
    dut._log.info(f"{len(asked())} queries, {told} pairs, all as the reference model's")


@cocotb.test()
async def engine_reports_what_is_no_query(dut):
    send, ask, silence = await pins(dut)
    packet = packed(asked()[0]["query"])
    for what, reason in [
        (packet[:16], "packet too short"),
        (packet + bytes(8), "packet too long"),
        (bytes(8), "unknown header"),
        # No whole word.
        (packet[:13], "packet too short"),
        # An address that is no multiple of 64, and one line more than the memory has.
        (engine.load(0, bytes(64))[:8] + (8).to_bytes(8, "little") + bytes(64), "unknown header"),
        (engine.load(64 * (engine.BLOCK_LINES - 1), bytes(128)), "packet too long"),
    ]:
        pairs, report = await ask(what)
        assert not pairs and report.incomplete and engine.REASONS[report.reason] == reason, f"{report}, expected {reason}"
    # A stop without a query is not answered, and the next packet is.
    await send(engine.stop(0))
    await silence()
    pairs, report = await ask(packet[:16])
    assert not pairs and engine.REASONS[report.reason] == "packet too short", report


def main(_, baud, *files):
    answers = ":".join(str(Path(file).resolve()) for file in files)
    parameters = {"baud_rate": int(baud), "silence_bits": board_line.SILENCE}
    environment = {"EFSAT_BAUD": baud, "EFSAT_ANSWERS": answers}
    board_line.simulate(__file__, DESIGN, board_line.files(DESIGN), "efsat_ulx3s", "engine", parameters, environment)


if __name__ == "__main__":
    main(*sys.argv[1:])
