import random
import sys
import efsat_engine as engine

# What is read is taken, or refused with a ValueError.
rng = random.Random(6)
report = engine.struct.pack("<8Q", engine.VERDICT_REPORT, 0, 0, 1, *range(4))
readers = [
    engine.asked,
    lambda data: engine.moved(data, 64),
    lambda data: engine.answer(data[:1] + engine.struct.pack("<8Q", engine.VERDICT_REPORT, *[0] * 7)[1:]),
    lambda data: engine.answer(data[:8] + report),
    lambda data: engine.packets(["head", data.decode("latin-1")]),
    lambda data: engine.packets(["head", "1,2," + " ".join(f"{byte:x}{rng.choice('0f -')}" * (byte % 20) for byte in data)]),
]
outcomes = [set() for _ in readers]
for _ in range(400):
    size = rng.choice([8 * engine.QUERY_WORDS, 8 * rng.randrange(20), rng.randrange(300)])
    data = bytes(rng.choice([0, 0, 1, 3, rng.randrange(256)]) for _ in range(size))
    for read, outcome in zip(readers, outcomes):
        try:
            read(data)
            outcome.add("taken")
        except ValueError:
            outcome.add("refused")
assert outcomes.count({"taken", "refused"}) == len(readers), outcomes


class Other:
    """A whole number of another type, as those of numpy are."""

    def __init__(self, value):
        self.value = value

    def __index__(self):
        return self.value


def refused(error, **changes):
    given = {"sides": [engine.Side(0, 64, 1, 1)] * 2, "errors": (1, 2, 3), "pose": [0] * 12}
    given["rows"] = [engine.Row((0, 0, 0), (0, 0, 0), 0)] * engine.ROWS
    plain = engine.query(**given, number=1)
    wider = dict(given, errors=map(Other, (1, 2, 3)), pose=map(Other, [0] * 12), number=Other(1))
    wider["rows"] = [engine.Row(*[[Other(0)] * 3] * 2, Other(0))] * engine.ROWS
    assert engine.query(**wider) == plain
    try:
        engine.query(**dict(given, **changes))
    except error as said:
        return str(said)
    raise AssertionError("expected a refusal")


for wrong in [(1, 2), (1, 2, 3, 4), ()]:
    assert refused(ValueError, errors=wrong) == f"errors of the shift: found {len(wrong)}; expected 3"
assert refused(ValueError, errors=(0, Other(65536), 0)) == "error 1: found 65536; expected 0 to 65535"
assert refused(TypeError, errors=(0, 0, 1.0)) == "error 2: found 1.0; expected a whole number, 0 to 65535"
text = refused(ValueError, pose=[0] * 11 + [Other(1 << 40)])
assert text == f"entry of t 11: found {1 << 40}; expected {engine.TRANSLATION_LEAST} to {engine.TRANSLATION_MOST}", text
text = refused(ValueError, pose=[engine.ENTRY_MOST + 1] + [0] * 11)
assert text.startswith(f"entry of M 0: found {engine.ENTRY_MOST + 1}; expected "), text
assert refused(ValueError, sides=[engine.Side(0, 32, 1, 1)] * 2) == "address of side 0: found 32; expected a multiple of 64"
rows = [engine.Row((0, 0), (0, 0, 0), 0)] * engine.ROWS
assert refused(ValueError, rows=rows) == "choices of row 0: found 2; expected 3"
numbers = {engine.asked(bytes(8 * engine.QUERY_WORDS)) for _ in range(100)}
assert len(numbers) == 100, "each query has a number of its own"

def show(packet):
    return " ".join(f"{int.from_bytes(packet[i : i + 8], 'little'):016x}" for i in range(0, len(packet), 8))

for line in sys.stdin:
    kind, *rest = line.split()
    rest = iter(map(int, rest))
    take = lambda count: [next(rest) for _ in range(count)]
    if kind == "q":
        sides = []
        for _ in range(2):
            blocks_at, triangles_at, blocks, triangles = take(4)
            sides.append(engine.Side(64 * blocks_at, 64 * triangles_at, blocks, triangles))
        limit, flags, number = take(3)
        errors, [sticky], pose, rows = take(3), take(1), take(12), []
        for _ in range(engine.ROWS):
            terms = take(6)
            rows.append(engine.Row(terms[::2], terms[1::2], next(rest)))
        more = {"sticky": sticky} if STICKY else {}
        try:
            plain = engine.query(sides, errors, pose, rows, **more)
        except ValueError as said:
            print(said)
            continue
        packet = engine.asked(plain, limit, flags, number)
        assert packet == engine.query(sides, errors, pose, rows, limit, flags, number, **more)
        print(show(packet))
        print(show(engine.moved(packet, 640)[8:24]))
        print(show(engine.stop(0xABCDEF) + engine.reset(7)))
    elif kind == "d":
        packet = [0] * engine.QUERY_WORDS
        packet[engine.TRIANGLES_WORD], packet[engine.OPTIONS_WORD], count = take(3)
        packet = [word % (1 << 64) for word in packet]
        words = [low | high << 32 for low, high in zip(*[rest] * 2)]
        assert len(words) == count
        pack = lambda words: engine.struct.pack(f"<{len(words)}Q", *words)
        try:
            engine.answer(pack(words), pack(packet))
            print("taken")
        except ValueError:
            print("refused")
    else:
        pair = next(rest)
        words = [low | high << 32 for low, high in zip(*[rest] * 2)]
        [found], report = engine.answer(engine.struct.pack("<9Q", pair, *words))
        assert report.incomplete == (report.reason >= engine.REASON_LIMIT)
        print(*found)
        print(*map(int, report))
