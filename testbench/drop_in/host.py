import random
import sys
import efsat as unit

# What came back is taken word by word, or refused with a ValueError.
rng, size = random.Random(7), unit.ANSWER_WORD_BITS // 8
for length in range(4 * size):
    try:
        assert len(unit.answers(rng.randbytes(length))) * size == length
    except ValueError:
        pass


class Other:
    """A whole number of another type, as those of numpy are."""

    def __init__(self, value):
        self.value = value

    def __index__(self):
        return self.value


def refused(error, made):
    try:
        made()
    except error as said:
        return str(said)
    raise AssertionError("expected a refusal")


def said(made):
    try:
        return made()
    except ValueError as said:
        return said


zeros = [0] * unit.PAIR_NUMBERS
assert unit.pair(map(Other, zeros)) == unit.pair(zeros)
for wrong in (0.0, "0", None, [0]):
    text = refused(TypeError, lambda: unit.pair([0, 0, wrong, *zeros[3:]]))
    assert text.startswith(f"coordinate 2: found {wrong!r}; expected a whole number, {unit.COORDINATE_LEAST} to "), text
assert refused(ValueError, lambda: unit.pair(zeros[1:])) == "numbers: found 17; expected 18"
for big in (1 << 64, -(1 << 64), unit.COORDINATE_MOST + (1 << 32)):
    text = refused(ValueError, lambda: unit.pair([*zeros[:17], Other(big)]))
    assert text == f"coordinate 17: found {big}; expected {unit.COORDINATE_LEAST} to {unit.COORDINATE_MOST}", text
if STICKY:
    assert refused(ValueError, lambda: unit.pair(zeros, sticky=1 << 18)) == "sticky: found 262144; expected 0 to 262143"
if TAG:
    most = (1 << unit.TAG_BITS) - 1
    assert refused(ValueError, lambda: unit.pair(zeros, most + 1)) == f"tag: found {most + 1}; expected 0 to {most}"
assert refused(ValueError, lambda: unit.number(float("nan"))) == "found nan; expected a finite number"
assert refused(ValueError, lambda: unit.number(float("-inf"))) == "found -inf; expected a finite number"
one = 1 << unit.NUMBER_BITS - unit.INTEGRAL_BITS
assert [unit.number(x) for x in (1, Other(-1), 0.75, -5e-324, 2**60 + 1)] == [one, -one, one * 3 // 4, -1, (2**60 + 1) * one]

for line in sys.stdin:
    kind, *numbers = line.split()
    tag, sticky, *numbers = map(int, numbers)
    more = {"sticky": sticky} if STICKY else {}
    named = {"tag": tag % (1 << 64)} if TAG else {}
    if kind == "p":
        record = said(lambda: unit.pair(numbers, **named, **more).hex())
        print(*([record] if isinstance(record, ValueError) else [unit.pairs_packet([]).hex(), record]), sep="\n")
    elif kind == "m":
        word = unit.WORD_BITS // 8
        packet = said(lambda: unit.pose_packet(numbers[: unit.POSE_NUMBERS], tag == 1, **more))
        print(*([packet] if isinstance(packet, ValueError) else [packet[:word].hex(), packet[word:].hex()]), sep="\n")
    elif kind == "a":
        found = said(lambda: unit.answers(bytes(numbers[: unit.ANSWER_WORD_BITS // 8])))
        print(*["refused"] if isinstance(found, ValueError) else map(int, found[0]))
    else:
        pairs = [(zeros, x % (1 << 64)) if TAG else (zeros,) for x in numbers[:tag]]
        found = said(lambda: unit.answers_to(pairs, bytes(numbers[tag:])))
        for answer in [["refused"]] if isinstance(found, ValueError) else found:
            print(*answer if isinstance(answer, list) else map(int, answer))
