import math
import random
import efsat as unit

rng, half = random.Random(16), math.sqrt(0.5)
turn = [half, -half, 0, half, half, 0, 0, 0, 1, 0, 0, 0]
unit.pose_packet([unit.number(x) for x in turn])
refused = 0
for _ in range(200):
    a = [rng.uniform(-0.1, 0.1) for _ in range(9)]
    b = [rng.uniform(-0.1, 0.1) + place for _ in range(3) for place in (7.8, -7.8, 0)]
    try:
        unit.pairs_packet([([unit.number(x) for x in a + b], 0)])
    except ValueError as error:
        assert str(error).startswith("coordinate 9: found ") and str(error).endswith("; expected -268435456 to 268435456")
        refused += 1
print(refused)
