{% for line in header -%}
# {{ line }}
{% endfor -%}
"""The words of {{ prefix }}efsat_engine in Python: constants, packing of packets, unpacking of answers.

A packet is words of 64 bits, TLAST with the last one; here it is bytes, little-endian. Images of trees are made by
`efsat tree build`, and the numbers and rows of a pose by `efsat tree query`, whose packets `packets` reads.

    for packet in packets(open("queries.txt")):
        pairs, report = answer(exchange(asked(packet, number=7)))
"""

import struct
from typing import NamedTuple
{% for group in groups %}
# {{ group.what }}
{%- for constant in group.constants %}
{{ constant.upper() }} = {{ constant.python() }}  # {{ constant.what }}
{%- endfor %}
{% endfor %}
# Of a report, in the order of their codes.
REASONS = (
{%- for reason in reasons %}
    "{{ reason }}",
{%- endfor %}
)


class Side(NamedTuple):
    """Where an object is in memory: addresses in bytes, multiples of 64, and how many blocks and triangles there are."""

    blocks_at: int
    triangles_at: int
    blocks: int
    triangles: int


class Row(NamedTuple):
    """A row of the realignment: three choices of a direction, their factors, and the rest."""

    choices: tuple
    factors: tuple
    rest: int


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


def _field(name, value, bits):
    if not 0 <= value < 1 << bits:
        raise ValueError(f"{name} {value}: expected 0 to {(1 << bits) - 1}")
    return value


def _both(name, low, high):
    return _field(name, low, 32) | _field(name, high, 32) << 32


def _bytes(words):
    return struct.pack(f"<{len(words)}Q", *words)


def _words(data):
    if len(data) % 8:
        raise ValueError(f"{len(data)} bytes: expected whole words of 8")
    return list(struct.unpack(f"<{len(data) // 8}Q", data))


def _query(packet):
    words = _words(packet)
    if len(words) != QUERY_WORDS:
        raise ValueError(f"{len(words)} words: expected the {QUERY_WORDS} of a query")
    return words


def _options(limit, flags, number):
    if flags & ~(FIRST_CONTACT | ALL_PAIRS | LEAF_PAIRS | KEEP_CACHES):
        raise ValueError(f"flags {flags:#x}: expected an OR of FIRST_CONTACT, ALL_PAIRS, LEAF_PAIRS, KEEP_CACHES")
    return _both("limit", limit, flags) | _field("number", number, QUERY_NUMBER_BITS) << QUERY_NUMBER_LOW


def _row(row):
    word = _field("rest", row.rest, ROW_REST_BITS) << ROW_REST_LOW
    for slot in range(3):
        choice = _field("choice", row.choices[slot], ROW_CHOICE_BITS)
        factor = _field("factor", row.factors[slot], FACTOR_BITS)
        word |= (factor << ROW_CHOICE_BITS | choice) << slot * ROW_SLOT_BITS
    return word


def query(sides, errors, pose, rows, limit=0, flags=0, number=0{% if is_sticky %}, sticky=0{% endif %}):
    """The packet of a query: two Sides, three errors of the shift, m00 m01 m02 m10 ... m22 t_x t_y t_z, a Row for each direction.

    `flags` is an OR of FIRST_CONTACT and the like, `limit` the most expansions or 0, `number` returns in the report, and names the
    query in a stop. Without KEEP_CACHES the engine reads again what the query needs; with it the answer is right only if no image
    has been written to since the last query without it.
{%- if is_sticky %}
    Bit i of `sticky`: number i is greater than its lower bound.
{%- endif %}
    """
    a, b = sides
    if any(at % 64 for side in sides for at in side[:2]):
        raise ValueError("expected addresses that are multiples of 64")
    if (len(pose), len(rows)) != (12, DIRECTIONS):
        raise ValueError(f"{len(pose)} numbers and {len(rows)} rows: expected 12 and {DIRECTIONS}")
    end = 1 << TRANSFORM_BITS - 1
    if not all(-end <= x < end for x in pose):
        raise ValueError(f"a number of the pose is outside {-end} to {end - 1}")
    low = [x % (1 << 32) for x in pose]
    return _bytes(
        [
            _both("header", QUERY_HEADER, QUERY_FORMAT),
            _both("address", a.blocks_at // 64, b.blocks_at // 64),
            _both("address", a.triangles_at // 64, b.triangles_at // 64),
            _both("number of blocks", a.blocks, b.blocks),
            _both("number of triangles", a.triangles, b.triangles),
            _options(limit, flags, number),
            sum(_field("error", error, 16) << 16 * axis for axis, error in enumerate(errors)),
            {% if is_sticky %}_field("sticky", sticky, 12){% else %}0{% endif %},
            *(_both("pose", *low[i : i + 2]) for i in range(0, 12, 2)),
            *map(_row, rows),
        ]
    )


def asked(packet, limit=0, flags=0, number=0):
    """A query that asks for something else."""
    words = _query(packet)
    words[OPTIONS_WORD] = _options(limit, flags, number)
    return _bytes(words)


def moved(packet, by):
    """A query whose images have been moved by so many bytes, a multiple of 64."""
    if by % 64:
        raise ValueError(f"{by} bytes: expected a multiple of 64")
    words = _query(packet)
    for i in (1, 2):
        words[i] = _both("address", *((words[i] >> low) % (1 << 32) + by // 64 for low in (0, 32)))
    return _bytes(words)
{% if block_ram %}

def load(address, data):
    """The packet that fills memory from a byte address on: 0 or more for blocks, TRIANGLES_AT or more for triangles."""
    if address % 64 or not data or len(data) % 64:
        raise ValueError(f"{len(data)} bytes to {address:#x}: expected multiples of 64")
    return _bytes([LOAD_HEADER, _field("address", address, 32)]) + data
{% endif %}

def _order(header, number):
    return _bytes([header | _field("number", number, QUERY_NUMBER_BITS) << QUERY_NUMBER_LOW])


def stop(number):
    """The packet that ends the query with a number, if it runs or waits; it has no answer of its own."""
    return _order(STOP_HEADER, number)


def reset(number=0):
    """The packet of a soft reset: nothing that was sent before has another answer than the report to this.

    Its reason is REASON_RESET and its number the given one; pairs before it in its packet mean nothing.
    """
    return _order(RESET_HEADER, number)


def packets(lines):
    """The packets of a file that `efsat tree query` has written."""
    rows = [line.rstrip("\n").split(",") for line in lines]
    return [_bytes([_field("word", int(word, 16), 64) for word in row[-1].split()]) for row in rows[1:] if row[-1]]


def answer(data):
    """The Pairs and the Report of the bytes that came back for one packet."""
    words = _words(data)
    if len(words) < REPORT_WORDS or words[-REPORT_WORDS] & 3 != VERDICT_REPORT:
        raise ValueError(f"{len(words)} words: expected a report in the last {REPORT_WORDS}")
    return [_pair(word) for word in words[:-REPORT_WORDS]], _report(words[-REPORT_WORDS:])


def _pair(word):
    number = (1 << ANSWER_NUMBER_BITS) - 1
    pair = Pair(word & 3, word >> ANSWER_A_LOW & number, word >> ANSWER_B_LOW & number)
    if pair.verdict == VERDICT_REPORT or word >> 2 & 63:
        raise ValueError(f"{word:#018x}: expected a pair of triangles")
    return pair


def _report(words):
    head, clocks = words[0] % (1 << 32), words[0] >> 32
    halves = [half for word in words[1:] for half in (word % (1 << 32), word >> 32)]
    incomplete = bool(head >> REPORT_INCOMPLETE & 1)
    return Report(head >> REPORT_REASON_LOW & 31, incomplete, head >> REPORT_NUMBER_LOW, clocks, *halves)
