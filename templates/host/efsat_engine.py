{% for line in header -%}
# {{ line }}
{% endfor -%}
"""The words of {{ prefix }}efsat_engine in Python: constants, packing of packets, unpacking of answers.

A packet is words of 64 bits, TLAST with the last one; here it is bytes, little-endian. The engine answers every packet but a stop.
`efsat tree answer` prints the packets that load two images and ask for the triangles that touch.
"""

import struct
from typing import NamedTuple

# Packets in.
QUERY_HEADER = 0x{{ query_header }}  # low half of the first word of a query
QUERY_WORDS = {{ query_words }}  # words of a query
LOAD_HEADER = 0x{{ load_header }}  # first word of a load
STOP_HEADER = 0x{{ stop_header }}  # the only word of a stop
TRIANGLES_AT = 0x{{ triangles_at }}  # byte address of the first triangle; blocks begin at 0
BLOCK_LINES = {{ block_lines }}  # blocks that memory holds
TRIANGLE_LINES = {{ triangle_lines }}  # triangles that memory holds

# Verdicts: the low bits of a word out.
VERDICT_SEPARATE = {{ verdict_separate }}
VERDICT_INTERSECT = {{ verdict_intersect }}
VERDICT_POSSIBLY_INCORRECT = {{ verdict_possibly_incorrect }}
VERDICT_REPORT = {{ verdict_report }}

# Packets out: pairs, then a report.
REPORT_WORDS = {{ report_words }}

# Of a report, in the order of their codes.
REASONS = (
{%- for reason in reasons %}
    "{{ reason }}",
{%- endfor %}
)


class Pair(NamedTuple):
    """A pair of triangles that is not separate: VERDICT_INTERSECT or VERDICT_POSSIBLY_INCORRECT, and the faces of A and B."""

    verdict: int
    a: int
    b: int


class Report(NamedTuple):
    """The end of an answer. If `incomplete` is set, pairs that touch may be missing: find them in software."""

    reason: int
    incomplete: bool
    number: int
    clocks: int
    expansions: int
    tests: int
    survivors: int
    leaf_pairs: int
    intersect: int
    possibly_incorrect: int
    blocks: int
    blocks_read: int
    triangles: int
    triangles_read: int
    words_read: int
    memory_waits: int
    queue_waits: int
    stack: int


def _words(data):
    if len(data) % 8:
        raise ValueError(f"{len(data)} bytes: expected whole words of 8")
    return list(struct.unpack(f"<{len(data) // 8}Q", data))


def load(address, data):
    """The packet that fills memory from a byte address on: 0 or more for blocks, TRIANGLES_AT or more for triangles."""
    if address % 64 or not 0 <= address < 1 << 32 or not data or len(data) % 64:
        raise ValueError(f"{len(data)} bytes to {address:#x}: expected multiples of 64")
    return struct.pack("<2Q", LOAD_HEADER, address) + data


def stop():
    """The packet that ends the query that runs."""
    return struct.pack("<Q", STOP_HEADER)


def answer(data):
    """The Pairs and the Report of the bytes that came back for one packet."""
    words = _words(data)
    if len(words) < REPORT_WORDS or words[-REPORT_WORDS] & 3 != VERDICT_REPORT:
        raise ValueError(f"{len(words)} words: expected a report in the last {REPORT_WORDS}")
    return [_pair(word) for word in words[:-REPORT_WORDS]], _report(words[-REPORT_WORDS:])


def _pair(word):
    pair = Pair(word & 3, word >> 8 & (1 << 28) - 1, word >> 36)
    if pair.verdict == VERDICT_REPORT or word >> 2 & 63:
        raise ValueError(f"{word:#018x}: expected a pair of triangles")
    return pair


def _report(words):
    head, clocks = words[0] % (1 << 32), words[0] >> 32
    halves = [half for word in words[1:] for half in (word % (1 << 32), word >> 32)]
    return Report(head >> 2 & 31, bool(head >> 7 & 1), head >> 8, clocks, *halves)
