{% for line in h.header -%}
# {{ line }}
{% endfor -%}
"""The words of {{ h.prefix }}efsat_stream in Python: constants, packing of packets, unpacking of answers.

A packet in is a header word and then records, TLAST with the last word; a packet out is one answer for each pair, or one
report. All bytes are little-endian. Numbers are whole, of any type that is: lower bounds in the input format, as `number` makes
them.

    pairs = [([number(x) for x in coordinates],{% if h.has_tag %} tag{% endif %}), ...]
    for answer in answers_to(pairs, exchange(pairs_packet(pairs))): ...

What the unit makes no promise for, and answers that it cannot have given, are refused with a ValueError that has the value, its
index and the range expected; what is no whole number with a TypeError.
"""

import operator
from typing import NamedTuple
{% for group in h.groups %}
# {{ group.what }}
{%- for constant in group.constants %}
{{ constant.upper() }} = {{ constant.python() }}  # {{ constant.what }}
{%- endfor %}
{% endfor %}
# Of a report, in the order of their codes.
REASONS = ("pose taken", "unknown header", "packet too short", "packet too long")


class Answer(NamedTuple):
    """What the unit says of a pair, or with verdict VERDICT_REPORT of a packet."""

    verdict: int
    reason: int
    outside: bool
    malformed: bool
    tag: int
    separated: int
    overlapping: int


{% include "host/whole.py" %}

def number(x):
    """The greatest number of the input format that is not above x, a finite number of any kind; exact."""
    try:
        above, below = x.as_integer_ratio() if hasattr(x, "as_integer_ratio") else (operator.index(x), 1)
    except (ValueError, OverflowError):
        raise ValueError(f"found {x!r}; expected a finite number") from None
    return (above << NUMBER_BITS - INTEGRAL_BITS) // below


def _record(words, numbers, ranges, low{% if h.is_sticky %}, sticky{% endif %}):
    numbers = _all("numbers", numbers, len(ranges))
{%- if h.is_sticky %}
    sticky = _whole("sticky", sticky, 0, (1 << len(ranges)) - 1)
    low |= sticky
{%- endif %}
    for i, (x, (what, least, most)) in enumerate(zip(numbers, ranges)):
{%- if h.is_sticky %}
        # A number above its lower bound is below the end of its range.
        above = what != "number" and sticky >> i & 1
{%- endif %}
        x = _whole(f"{what} {i}", x, least, most{% if h.is_sticky %} - above{% endif %})
        low |= x % (1 << RECORD_NUMBER_STEP) << RECORD_NUMBER_LOW + i * RECORD_NUMBER_STEP
    return low.to_bytes(words * WORD_BITS // 8, "little")


# What the numbers of a record are, and their declared ranges.
_PAIR = [("coordinate", COORDINATE_LEAST, COORDINATE_MOST)] * PAIR_NUMBERS
{%- if h.has_pose %}
_POSE = {% if h.has_matrix %}[("entry of M", ENTRY_LEAST, ENTRY_MOST)] * 9 + {% endif %}[("entry of t", TRANSLATION_LEAST, TRANSLATION_MOST)] * 3
{%- endif %}


def _ranges(declared, every):
    """The ranges of a record's numbers, or those of their words for numbers that the unit does not read, or that its guard checks."""
    return [("number", NUMBER_LEAST, NUMBER_MOST)] * len(declared) if every else declared


def pair(numbers{% if h.has_tag %}, tag=0{% endif %}{% if h.is_sticky %}, sticky=0{% endif %}{% if h.has_guards %}, *, outside=False{% endif %}):
    """The record of a pair: v0_x v0_y v0_z v1_x ... w2_z.{% if h.is_sticky %} Bit i of `sticky`: number i is greater than its lower bound.{% endif %}
{%- if h.has_guards %} With `outside` numbers outside their
    declared range are sent, too: the guard answers possibly incorrect.{% endif %}"""
    low = {% if h.has_tag %}_whole("tag", tag, 0, (1 << TAG_BITS) - 1) << RECORD_TAG_LOW{% else %}0{% endif %}
    return _record(PAIR_WORDS, numbers, _ranges(_PAIR, {% if h.has_guards %}outside{% else %}False{% endif %}), low{% if h.is_sticky %}, sticky{% endif %})

{% if h.has_pose %}
def pose(numbers, bypass=False{% if h.is_sticky %}, sticky=0{% endif %}{% if h.has_guards %}, *, outside=False{% endif %}):
    """The record of a pose: {% if h.has_matrix %}m00 m01 m02 m10 ... m22 {% endif %}t_x t_y t_z. With `bypass` B stays as it is, and they are not read."""
    ranges = _ranges(_POSE, bypass{% if h.has_guards %} or outside{% endif %})
    return _record(POSE_WORDS, numbers, ranges, bool(bypass) << RECORD_BYPASS{% if h.is_sticky %}, sticky{% endif %})


def pose_packet(*arguments, **options):
    """The packet of a pose, of the arguments of `pose`."""
    return _header(POSE_HEADER) + pose(*arguments, **options)

{% endif %}
def pairs_packet(pairs{% if h.has_guards %}, *, outside=False{% endif %}):
    """The packet of some pairs, each the arguments of `pair`."""
    return _header(PAIRS_HEADER) + b"".join(pair(*arguments{% if h.has_guards %}, outside=outside{% endif %}) for arguments in pairs)


def _header(header):
    return header.to_bytes(WORD_BITS // 8, "little")


def answers(data):
    """The answers in bytes that came back, of any packet. A word that no unit of this design sends is refused."""
    size = ANSWER_WORD_BITS // 8
    if len(data) % size:
        raise ValueError(f"found {len(data)} bytes; expected whole words of {size}")
    return [_answer(at // size, int.from_bytes(data[at : at + size], "little")) for at in range(0, len(data), size)]


def answers_to(pairs, data):
    """The answers to the packet of these pairs, each the arguments of `pair`, from all bytes of its answer.

    Answers that are not due, in number{% if h.has_tag %}, order{% endif %} or kind, are refused: then no verdict of the packet counts.
    """
    pairs, found = list(pairs), answers(data)
    for i, answer in enumerate(found):
        if answer.verdict == VERDICT_REPORT:
            raise ValueError(f"answer {i}: found the report '{REASONS[answer.reason]}'; expected a verdict")
    if len(found) != len(pairs):
        raise ValueError(f"found {len(found)} answers; expected {len(pairs)}, one for each pair")
{%- if h.has_tag %}
    for i, (answer, (_, *more)) in enumerate(zip(found, pairs)):
        tag = operator.index(more[0]) if more else 0
        if answer.tag != tag:
            raise ValueError(f"answer {i}: found tag {answer.tag}; expected {tag}")
{%- endif %}
    return found


def _answer(at, word):
    def field(low, bits):
        return word >> low & (1 << bits) - 1

    answer = Answer(
        field(ANSWER_VERDICT_LOW, 2),
        field(ANSWER_REASON_LOW, 2),
        {% if h.has_outside %}bool(field(ANSWER_OUTSIDE, 1)){% else %}False{% endif %},
        bool(field(ANSWER_MALFORMED, 1)),
        {% if h.has_tag %}field(ANSWER_TAG_LOW, TAG_BITS){% else %}0{% endif %},
        field(ANSWER_SEPARATED_LOW, FLAG_BITS),
        field(ANSWER_OVERLAPPING_LOW, FLAG_BITS),
    )
    {% if h.has_outside %}spare = field(ANSWER_MALFORMED - 2, 2){% else %}spare = field(ANSWER_MALFORMED - 3, 3){% endif %} or word >> ANSWER_OVERLAPPING_LOW + FLAG_BITS
    if spare or _contradicts(answer):
        raise ValueError(f"answer {at}: found {word:#x}, which no unit of this design sends")
    return answer


def _contradicts(answer):
    """Whether a verdict and the flags that it does not follow from, or flags that exclude each other, are in one answer."""
    s, o = answer.separated, answer.overlapping
    separate, intersect = answer.verdict == VERDICT_SEPARATE, answer.verdict == VERDICT_INTERSECT
    if answer.verdict == VERDICT_REPORT:
        return answer.outside or answer.malformed != (answer.reason > 0) or (answer.tag, s, o) != (0, 0, 0)
    if answer.reason or answer.malformed:
        return True
    if answer.outside:
        return separate or intersect or (s, o) != (0, 0)
    if s & o:
        return True
{%- if h.method == "axes" %}
    # An axis that separates decides; else all of the eleven have to overlap{% if h.edge_test %}, or an edge passes through, of which no flag tells{% endif %}.
    if separate != (s > 0):
        return True
    if o & 0x7FF == 0x7FF:
        return not intersect
    return {% if h.edge_test %}False{% else %}intersect{% endif %}
{%- else %}
    # All of a triangle on one side of the other's plane: its three edges miss the other.
    if (s & 2 and s & 0x1C0 != 0x1C0) or (s & 4 and s & 0x038 != 0x038):
        return True
{%- if h.method == "determinants" %}
    # Boxes, a plane, or five of the six edges separate; else one edge that pierces is enough.
    if separate != (s & 7 > 0 or bin(s >> 3).count("1") >= 5) or o & 7:
        return True
    return o > 0 if separate else intersect != (o > 0)
{%- else %}
    # Triangles in one plane, or of which no edge hits the other, are separate if the first flag or no edge says otherwise.
    if separate != (s & 1 > 0 or o & 0x1FA == 0) or separate == intersect:
        return True
    if (separate and o & ~2) or (o & 2 and (s & ~1 or o & 0x1F8)):
        return True
    return bool(o & 4) and not (o & 1 and o & 0x1FA)
{%- endif %}
{%- endif %}
