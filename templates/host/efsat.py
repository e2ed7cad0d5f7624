{% for line in header -%}
# {{ line }}
{% endfor -%}
"""The words of {{ prefix }}efsat_stream in Python: constants, packing of packets, unpacking of answers.

A packet in is a header word and then records, TLAST with the last word; a packet out is one answer for each pair, or one
report. All bytes are little-endian. Numbers are whole: lower bounds in the input format, as `number` makes them.

    packet = pairs_packet([([number(x) for x in coordinates], tag), ...])
    for answer in answers(received): ...
"""

import math
from typing import NamedTuple
{% for group in groups %}
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


def number(x):
    """The greatest number of the input format that is not above x."""
    return math.floor(math.ldexp(x, NUMBER_BITS - INTEGRAL_BITS))


def _record(words, count, numbers, low):
    if len(numbers) != count:
        raise ValueError(f"{len(numbers)} numbers: expected {count}")
    end = 1 << NUMBER_BITS - 1
    for i, x in enumerate(numbers):
        if not -end <= x < end:
            raise ValueError(f"number {i}, {x}: expected {-end} to {end - 1}")
        low |= x % (1 << RECORD_NUMBER_STEP) << RECORD_NUMBER_LOW + i * RECORD_NUMBER_STEP
    return low.to_bytes(words * WORD_BITS // 8, "little")


def pair(numbers{% if has_tag %}, tag=0{% endif %}{% if is_sticky %}, sticky=0{% endif %}):
    """The record of a pair: v0_x v0_y v0_z v1_x ... w2_z.{% if is_sticky %} Bit i of `sticky`: number i is greater than its lower bound.{% endif %}"""
{%- if has_tag %}
    if not 0 <= tag < 1 << TAG_BITS:
        raise ValueError(f"tag {tag}: expected 0 to {(1 << TAG_BITS) - 1}")
{%- endif %}
    return _record(PAIR_WORDS, PAIR_NUMBERS, numbers, {% if is_sticky %}sticky{% if has_tag %} | {% endif %}{% else if !has_tag %}0{% endif %}{% if has_tag %}tag << RECORD_TAG_LOW{% endif %})

{% if has_pose %}
def pose(numbers, bypass=False{% if is_sticky %}, sticky=0{% endif %}):
    """The record of a pose: {% if has_matrix %}m00 m01 m02 m10 ... m22 {% endif %}t_x t_y t_z. With `bypass` B stays as it is."""
    return _record(POSE_WORDS, POSE_NUMBERS, numbers, {% if is_sticky %}sticky | {% endif %}bool(bypass) << RECORD_BYPASS)


def pose_packet(numbers, bypass=False{% if is_sticky %}, sticky=0{% endif %}):
    """The packet of a pose."""
    return _header(POSE_HEADER) + pose(numbers, bypass{% if is_sticky %}, sticky{% endif %})

{% endif %}
def pairs_packet(pairs):
    """The packet of some pairs, each the arguments of `pair`."""
    return _header(PAIRS_HEADER) + b"".join(pair(*arguments) for arguments in pairs)


def _header(header):
    return header.to_bytes(WORD_BITS // 8, "little")


def answers(data):
    """The answers in bytes that came back."""
    size = ANSWER_WORD_BITS // 8
    if len(data) % size:
        raise ValueError(f"{len(data)} bytes: expected whole words of {size}")
    return [_answer(int.from_bytes(data[at : at + size], "little")) for at in range(0, len(data), size)]


def _answer(word):
    def field(low, bits):
        return word >> low & (1 << bits) - 1

    return Answer(
        field(ANSWER_VERDICT_LOW, 2),
        field(ANSWER_REASON_LOW, 2),
        {% if has_outside %}bool(field(ANSWER_OUTSIDE, 1)){% else %}False{% endif %},
        bool(field(ANSWER_MALFORMED, 1)),
        {% if has_tag %}field(ANSWER_TAG_LOW, TAG_BITS){% else %}0{% endif %},
        field(ANSWER_SEPARATED_LOW, FLAG_BITS),
        field(ANSWER_OVERLAPPING_LOW, FLAG_BITS),
    )
