{% for line in header -%}
# {{ line }}
{% endfor -%}
"""Plays the vectors of {{ entity }} in cocotb and GHDL, at full speed and with random stalls, and compares the answers.

    pip install cocotb==2.1.0
    python3 test_{{ core.stem }}.py
{% if report_words > 0 %}
It plays them up to the first reset{% if memories.len() > 0 %} or fault of the memory{% endif %}, which are for the testbench in VHDL.
{% endif -%}
"""

import random
from pathlib import Path

import cocotb
from cocotb.clock import Clock
from cocotb.triggers import ClockCycles, RisingEdge

RTL = Path(__file__).resolve().parent.parent
TOP = "{{ entity }}"
VECTORS = RTL / "{{ vectors }}"
{%- if report_words > 0 %}
REPORT_WORDS = {{ report_words }}
# What is compared of a report, by its mode: all its counts, no other pair than expected, no pair missing, the order of pairs.
COUNTS, NO_OTHER, NONE_MISSING, IN_ORDER = {2, 3}, {1, 2, 3}, {2, 3}, {3, 4}
{%- endif %}


def read():
    """Packets to send, what must come for each, and words of memory."""
    sent, due, memory = [[]], [{% if report_words == 0 %}[]{% endif %}], {}
    {%- if report_words > 0 %}
    pairs, words = [], []
    {%- endif %}
    for line in VECTORS.read_text().splitlines()[1:]:
        letter, *fields = line.split()
        if letter == "#" or letter == "end":
            continue
        fields = [int(field, 16) for field in fields]
        if letter == "I":
            word, last, whole = fields
            sent[-1].append((word, last, whole))
            if last:
                sent.append([])
        elif letter == "O":
            {%- if report_words > 0 %}
            words.append(fields[0])
            if fields[1]:
                due.append(words)
                words = []
            {%- else %}
            due[-1].append(fields[0])
            if fields[1]:
                due.append([])
            {%- endif %}
        {%- if report_words > 0 %}
        elif letter == "A":
            pairs.append(fields[0])
        elif letter == "R":
            due.append((pairs, fields))
            pairs = []
        elif letter == "M":
            memory[fields[0]] = fields[1]
        else:
            break
        {%- endif %}
    {%- if report_words > 0 %}
    return sent[: len(due)], due, memory
    {%- else %}
    return sent[:-1], due[:-1], memory
    {%- endif %}


def compare(number, words, due):
    """An answer to a packet with what it must be."""
    {%- if report_words > 0 %}
    if isinstance(due, tuple):
        pairs, (low, mode, *counts) = due
        found, report = words[:-REPORT_WORDS], words[-REPORT_WORDS:]
        assert report[0] & 0xFFFFFFFF == low, f"packet {number}: report {report[0]:016x}, expected {low:08x}"
        assert mode not in COUNTS or report[1:4] == counts, f"packet {number}: {report[1:4]}, expected {counts}"
        if mode in IN_ORDER:
            assert found == pairs[: len(found)], f"packet {number}: other pairs, or in another order"
        assert mode not in NO_OTHER or set(found) <= set(pairs), f"packet {number}: pairs that do not touch"
        assert mode not in NONE_MISSING or sorted(found) == sorted(pairs), f"packet {number}: pairs are missing"
        return
    {%- endif %}
    assert words == due, f"packet {number}: {words}, expected {due}"


async def send(dut, sent, rng, share):
    """All words; between them no offer for a share of the clocks."""
    size = len(dut.s_axis_tkeep)
    for packet in sent:
        for word, last, whole in packet:
            while rng.random() < share:
                await RisingEdge(dut.aclk)
            dut.s_axis_tdata.value = word
            dut.s_axis_tkeep.value = (1 << size if whole else 1 << size - 1) - 1
            dut.s_axis_tlast.value = last
            dut.s_axis_tvalid.value = 1
            await RisingEdge(dut.aclk)
            while dut.s_axis_tready.value != 1:
                await RisingEdge(dut.aclk)
            dut.s_axis_tvalid.value = 0


async def receive(dut, count, rng, share):
    """So many packets."""
    packets = [[]]
    while len(packets) <= count:
        ready = rng.random() >= share
        dut.m_axis_tready.value = ready
        await RisingEdge(dut.aclk)
        if ready and dut.m_axis_tvalid.value == 1:
            packets[-1].append(dut.m_axis_tdata.value.to_unsigned())
            if dut.m_axis_tlast.value == 1:
                packets.append([])
    return packets[:-1]
{%- if memories.len() > 0 %}


async def answer_reads(dut, port, memory, rng, share):
    """A memory behind the read port: bursts in order, a word of them every clock."""
    signal = lambda name: getattr(dut, f"{port}_{name}")
    size = len(signal("rdata")) // 8
    bursts, beats = [], []
    offered = accepts = False
    while True:
        await RisingEdge(dut.aclk)
        if accepts and signal("arvalid").value == 1:
            address, length = signal("araddr").value.to_unsigned(), signal("arlen").value.to_unsigned()
            assert address % size == 0 and signal("arburst").value == 1
            bursts.append([address + size * i for i in range(length + 1)])
        if offered and signal("rready").value == 1:
            beats.pop(0)
            offered = False
        if bursts and not beats:
            burst = bursts.pop(0)
            beats = [(address, address == burst[-1]) for address in burst]
        if beats and not offered and rng.random() >= share:
            address, last = beats[0]
            data = b"".join(memory[i].to_bytes(8, "little") for i in range(address // 8, (address + size + 7) // 8))
            signal("rdata").value = int.from_bytes(data[address % 8 :][:size], "little")
            signal("rlast").value = last
            offered = True
        signal("rvalid").value = offered
        accepts = len(bursts) < 4 and rng.random() >= share
        signal("arready").value = accepts
{%- endif %}


async def play(dut, share):
    rng = random.Random(1)
    sent, due, memory = read()
    assert due
    dut.aresetn.value = 0
    {%- if report_words > 0 %}
    dut.soft_reset.value = 0
    {%- endif %}
    for signal in (dut.s_axis_tvalid, dut.m_axis_tready{% for port in memories %}, dut.{{ port }}_arready, dut.{{ port }}_rvalid, dut.{{ port }}_rresp{% endfor %}):
        signal.value = 0
    cocotb.start_soon(Clock(dut.aclk, 10, "ns").start())
    await ClockCycles(dut.aclk, 16)
    dut.aresetn.value = 1
    {%- for port in memories %}
    cocotb.start_soon(answer_reads(dut, "{{ port }}", memory, rng, share))
    {%- endfor %}
    sender = cocotb.start_soon(send(dut, sent, rng, share))
    received = await receive(dut, len(due), rng, share)
    await sender
    {%- if core.in_order %}
    for number, (words, expected) in enumerate(zip(received, due)):
        compare(number, words, expected)
    {%- else %}
    for number, words in enumerate(received):
        # By its report, or the next one of those that have none.
        key = lambda expected: expected[1][0] if isinstance(expected, tuple) else None
        of = words[-REPORT_WORDS] & 0xFFFFFFFF if len(words) >= REPORT_WORDS and words[-REPORT_WORDS] & 3 == 3 else None
        place = next((i for i, expected in enumerate(due) if key(expected) == of), None)
        assert place is not None, f"packet {number} answers none that was sent"
        compare(number, words, due.pop(place))
    {%- endif %}
    dut._log.info(f"{len(received)} packets, {sum(map(len, received))} words, all as the reference model's")


@cocotb.test(timeout_time=10, timeout_unit="ms")
async def at_full_speed(dut):
    await play(dut, 0.0)


@cocotb.test(timeout_time=10, timeout_unit="ms")
async def with_random_stalls(dut):
    await play(dut, 0.4)


def main():
    from cocotb_tools.check_results import get_results
    from cocotb_tools.runner import get_runner

    runner = get_runner("ghdl")
    sources = [RTL / file for file in (RTL / "files-synthesis.txt").read_text().split()]
    runner.build(sources=sources, hdl_toplevel=TOP, build_args=["--std=93"], build_dir="sim_cocotb")
    results = runner.test(
        test_module=Path(__file__).stem,
        hdl_toplevel=TOP,
        test_args=["--std=93"],
        plusargs=["--ieee-asserts=disable-at-0"],
        build_dir="sim_cocotb",
    )
    count, failed = get_results(Path(results))
    if failed or not count:
        raise SystemExit(f"error: {failed} of {count} tests failed")


if __name__ == "__main__":
    main()
