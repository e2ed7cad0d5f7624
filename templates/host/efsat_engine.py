{% for line in h.header -%}
# {{ line }}
{% endfor -%}
"""The words of {{ h.prefix }}efsat_engine in Python: constants, packing of packets, unpacking of answers.

A packet is words of 64 bits, TLAST with the last one; here it is bytes, little-endian. Images of trees are made by
`efsat tree build`, and the numbers {% if h.by_number %}of a pose by `efsat tree query`.{% else %}and rows of a pose by `efsat tree query`, whose packets `packets` reads.{% endif %}

{% if h.by_number %}    packet = pairs(sides, [(0, 5), (0, 6)], pose)
    found, report = answer(exchange(packet), packet){% else %}    for packet in packets(open("queries.txt")):
        pairs, report = answer(exchange(packet), packet){% endif %}

Numbers are whole, of any type that is. What the engine makes no promise for, and answers that it cannot have given, are refused with
a ValueError that has the value, its index and the range expected; what is no whole number with a TypeError.
"""

import itertools
import operator
import struct
from typing import NamedTuple
{% for group in h.groups %}
# {{ group.what }}
{%- for constant in group.constants %}
{{ constant.upper() }} = {{ constant.python() }}  # {{ constant.what }}
{%- endfor %}
{% endfor %}
# Of a report, in the order of their codes.
REASONS = (
{%- for reason in h.reasons %}
    "{{ reason }}",
{%- endfor %}
)


{% if h.by_number -%}
class Side(NamedTuple):
    """Where the triangles of an object are in memory: an address in bytes, a multiple of 64, and how many there are."""

    triangles_at: int
    triangles: int


{% else -%}
# Directions that each choice of a row has.
_CHOICES = ({{ h.slots }})


class Side(NamedTuple):
    """Where an object is in memory: addresses in bytes, multiples of 64, and how many blocks and triangles there are."""

    blocks_at: int
    triangles_at: int
    blocks: int
    triangles: int


class Row(NamedTuple):
    """A row of the realignment, for two opposite directions: three choices of a direction, their factors, and the rest."""

    choices: tuple
    factors: tuple
    rest: int


{% endif -%}
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


{% include "host/whole.py" %}

def _field(name, value, bits):
    return _whole(name, value, 0, (1 << bits) - 1)


def _both(name, low, high):
    return _field(name, low, 32) | _field(name, high, 32) << 32


def _bytes(words):
    return struct.pack(f"<{len(words)}Q", *words)


def _words(data):
    if len(data) % 8:
        raise ValueError(f"found {len(data)} bytes; expected whole words of 8")
    return list(struct.unpack(f"<{len(data) // 8}Q", data))


{% if !h.by_number -%}
def _query(packet):
    words = _words(packet)
    if len(words) != QUERY_WORDS:
        raise ValueError(f"found {len(words)} words; expected the {QUERY_WORDS} of a query")
    return words


{% endif -%}
# The numbers that queries get.
_numbers = itertools.count()


{% if !h.by_number -%}
def _options(limit, flags, number):
    flags = _field("flags", flags, 32)
    if flags & ~QUERY_FLAGS:
        raise ValueError(f"flags: found {flags:#x}; expected an OR of FIRST_CONTACT and the like, {QUERY_FLAGS:#x}")
    if number is None:
        number = next(_numbers) % (1 << QUERY_NUMBER_BITS)
    return _both("limit", limit, flags) | _field("number", number, QUERY_NUMBER_BITS) << QUERY_NUMBER_LOW


def _row(i, row):
    word = _field(f"rest of row {i}", row.rest, ROW_REST_BITS) << ROW_REST_LOW
    choices, factors = _all(f"choices of row {i}", row.choices, 3), _all(f"factors of row {i}", row.factors, 3)
    for slot, (choice, factor, known) in enumerate(zip(choices, factors, _CHOICES)):
        choice = _whole(f"choice {slot} of row {i}", choice, 0, known - 1)
        factor = _field(f"factor {slot} of row {i}", factor, FACTOR_BITS)
        word |= (factor << ROW_CHOICE_BITS | choice) << slot * ROW_SLOT_BITS
    return word


{% endif -%}
def _address(what, at):
    at = _whole(what, at, 0, (1 << 38) - 64)
    if at % 64:
        raise ValueError(f"{what}: found {at}; expected a multiple of 64")
    return at // 64


{% if h.by_number %}{% include "host/numbers.py" %}
{% else -%}
def query(sides, errors, pose, rows, limit=0, flags=0, number=None{% if h.is_sticky %}, sticky=0{% endif %}):
    """The packet of a query: two Sides, three errors of the shift, m00 m01 m02 m10 ... m22 t_x t_y t_z, a Row for each two opposite directions.

    `flags` is an OR of FIRST_CONTACT and the like, `limit` the most expansions or 0. `number` returns in the report, and names the
    query in a stop; without it each query gets the next one. Without KEEP_CACHES the engine reads again what the query needs; with it
    the answer is right only if no image has been written to since the last query without it.
{%- if h.is_sticky %}
    Bit i of `sticky`: number i is greater than its lower bound.
{%- endif %}
    """
    sides, errors = _all("sides", sides, 2), _all("errors of the shift", errors, 3)
    pose, rows = _all("numbers of the pose", pose, 12), _all("rows", rows, ROWS)
    at = [[_address(f"address of side {i}", at) for i, at in enumerate(ats)] for ats in zip(*(side[:2] for side in sides))]
{%- if h.is_sticky %}
    sticky = _field("sticky", sticky, 12)
{%- endif %}
    ranges = [("entry of M", ENTRY_LEAST, ENTRY_MOST)] * 9 + [("entry of t", TRANSLATION_LEAST, TRANSLATION_MOST)] * 3
    low = [
        _whole(f"{what} {i}", x, least, most{% if h.is_sticky %} - (sticky >> i & 1){% endif %}) % (1 << 32)
        for i, (x, (what, least, most)) in enumerate(zip(pose, ranges))
    ]
    return _bytes(
        [
            _both("header", QUERY_HEADER, QUERY_FORMAT),
            _both("address", *at[0]),
            _both("address", *at[1]),
            _both("number of blocks", *(side.blocks for side in sides)),
            _both("number of triangles", *(side.triangles for side in sides)),
            _options(limit, flags, number),
            sum(_field(f"error {axis}", error, 16) << 16 * axis for axis, error in enumerate(errors)),
            {% if h.is_sticky %}sticky{% else %}0{% endif %},
            *(_both("pose", *low[i : i + 2]) for i in range(0, 12, 2)),
            *(_row(i, row) for i, row in enumerate(rows)),
        ]
    )


def asked(packet, limit=0, flags=0, number=None):
    """A query that asks for something else; without `number` it gets the next one."""
    words = _query(packet)
    words[OPTIONS_WORD] = _options(limit, flags, number)
    return _bytes(words)


def moved(packet, by):
    """A query whose images have been moved by so many bytes, a multiple of 64."""
    by = operator.index(by)
    if by % 64:
        raise ValueError(f"found {by} bytes; expected a multiple of 64")
    words = _query(packet)
    for i in (1, 2):
        words[i] = _both("address", *((words[i] >> low) % (1 << 32) + by // 64 for low in (0, 32)))
    return _bytes(words)
{% endif -%}
{% if h.block_ram %}

def load(address, data):
    """The packet that fills memory from a byte address on: 0 or more for blocks, TRIANGLES_AT or more for triangles."""
    address = operator.index(address)
    if address % 64 or not data or len(data) % 64:
        raise ValueError(f"found {len(data)} bytes to {address:#x}; expected multiples of 64")
    return _bytes([LOAD_HEADER, _field("address", address, 32)]) + data
{% endif %}

def _order(header, number):
    return _bytes([header | _field("number", number, QUERY_NUMBER_BITS) << QUERY_NUMBER_LOW])


{% if !h.by_number -%}
def stop(number):
    """The packet that ends the query with a number, if it runs or waits; it has no answer of its own."""
    return _order(STOP_HEADER, number)


{% endif -%}
def reset(number=0):
    """The packet of a soft reset: nothing that was sent before has another answer than the report to this.

    Its reason is REASON_RESET and its number the given one; pairs before it in its packet mean nothing.
    """
    return _order(RESET_HEADER, number)


{% if h.by_number %}{% include "host/numbers_belongs.py" %}

{% else -%}
def packets(lines):
    """The packets of a file that `efsat tree query` has written."""
    rows = [line.rstrip("\n").split(",") for line in lines]
    return [_bytes([_field("word", int(word, 16), 64) for word in row[-1].split()]) for row in rows[1:] if row[-1]]


def answer(data, packet=None):
    """The Pairs and the Report of the bytes that came back for one packet.

    With the packet of the query an answer is refused that is not the answer to it. An answer that no engine gives is refused
    always: words that are no pairs, a pair twice, other pairs than the report counts. The pairs of an incomplete answer prove
    nothing, and are not compared with anything.
    """
    words = _words(data)
    if len(words) < REPORT_WORDS or words[-REPORT_WORDS] & 3 != VERDICT_REPORT:
        raise ValueError(f"found {len(words)} words; expected a report in the last {REPORT_WORDS}")
    report = _report(words[-REPORT_WORDS:])
    pairs = [_pair(i, word) for i, word in enumerate(words[:-REPORT_WORDS])]
    if packet is not None:
        _belongs(pairs, report, _query(packet))
    if report.incomplete:
        return pairs, report
    seen = set()
    for i, pair in enumerate(pairs):
        if pair[1:] in seen:
            raise ValueError(f"pair {i}: found triangles {pair.a} and {pair.b} twice; expected each pair once")
        seen.add(pair[1:])
    for what, verdict, due in [
        ("intersect", VERDICT_INTERSECT, report.intersect),
        ("possibly incorrect", VERDICT_POSSIBLY_INCORRECT, report.possibly_incorrect),
    ]:
        found = sum(pair.verdict == verdict for pair in pairs)
        if found != due:
            raise ValueError(f"found {found} pairs that are {what}; expected {due}, as the report says")
    return pairs, report


def _belongs(pairs, report, query):
    """Refuses what is no answer to a query."""
    options, counts = query[OPTIONS_WORD], query[TRIANGLES_WORD]
    number, flags = options >> QUERY_NUMBER_LOW, options >> 32
    # The report of a packet that was not read has no number.
    if report.number != number and (report.reason < REASON_UNKNOWN_HEADER or report.reason == REASON_SILENT):
        raise ValueError(f"found the report of query {report.number}; expected that of query {number}")
    if report.incomplete:
        return
    if report.reason == REASON_CONTACT and not (flags & FIRST_CONTACT and report.intersect):
        raise ValueError("found the report of a first contact; expected all, or one with a contact")
    for i, pair in enumerate(pairs):
        if pair.a >= counts % (1 << 32) or pair.b >= counts >> 32:
            raise ValueError(f"pair {i}: found triangles {pair.a} and {pair.b}; expected such as the objects have")
        if pair.verdict == VERDICT_SEPARATE and not flags & ALL_PAIRS:
            raise ValueError(f"pair {i}: found a separate pair; expected none, because none was asked for")
        if pair.verdict != VERDICT_POSSIBLY_INCORRECT and flags & LEAF_PAIRS:
            raise ValueError(f"pair {i}: found a decided pair; expected possibly incorrect, because no triangle is tested")
    if flags & (ALL_PAIRS | LEAF_PAIRS) and report.reason == REASON_COMPLETE and len(pairs) != report.leaf_pairs:
        raise ValueError(f"found {len(pairs)} pairs; expected {report.leaf_pairs}, as the report says")


{% endif -%}
def _pair(i, word):
    number = (1 << ANSWER_NUMBER_BITS) - 1
    pair = Pair(word & 3, word >> ANSWER_A_LOW & number, word >> ANSWER_B_LOW & number)
    if pair.verdict == VERDICT_REPORT or word >> 2 & 63:
        raise ValueError(f"pair {i}: found {word:#018x}; expected a pair of triangles")
    return pair


def _report(words):
    head, clocks = words[0] % (1 << 32), words[0] >> 32
    halves = [half for word in words[1:] for half in (word % (1 << 32), word >> 32)]
    reason, incomplete = head >> REPORT_REASON_LOW & 31, bool(head >> REPORT_INCOMPLETE & 1)
    report = Report(reason, incomplete, head >> REPORT_NUMBER_LOW, clocks, *halves)
    if reason >= len(REASONS) or incomplete != (reason >= REASON_LIMIT) or report.stack >> 16:
        raise ValueError(f"found {words[0]:#018x} as the first word of a report; expected one of this engine")
    return report
