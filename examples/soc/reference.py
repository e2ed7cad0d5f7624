"""What the processor is given, and what it must print, by the reference model.

    reference.py data EFSAT MESH_A MESH_B IMAGE_A IMAGE_B PAIRS POSES >data.h
    reference.py expected EFSAT MESH_A MESH_B IMAGE_A IMAGE_B PAIRS POSES METHOD >expected.txt

EFSAT is the program, a mesh is an OBJ file, its image is of `efsat tree build`, PAIRS is a CSV file of triangles, POSES is how many of
the poses below there are, and METHOD is that of the unit.
"""

import csv
import json
import subprocess
import sys
from fractions import Fraction
from pathlib import Path

# As the options of `efsat tree answer`; the entries are such that all images of corners are binary64 numbers.
POSES = [
    "1,0,0,0,1,0,0,0,1,1,0,0",
    "0,-1,0,1,0,0,0,0,1,1.5,0.5,0.25",
    "1,0,0,0,0,-1,0,1,0,0.5,0.25,-0.125",
    "0.5,0,0,0,0.5,0,0,0,1,0.25,0.5,2",
    "1,0,0,0,1,0,0,0,1,0,3,0",
]
# Of the input format of the unit, whose numbers are from -1 to 1.
FRACTION_BITS = 28
VERDICTS = ["separate", "intersect", "possibly-incorrect"]


def triangles(path):
    """The corners of the triangles of a mesh."""
    lines = [line.split() for line in Path(path).read_text().splitlines()]
    corners = [[float(x) for x in fields[1:]] for fields in lines if fields[:1] == ["v"]]
    return [[x for i in fields[1:] for x in corners[int(i) - 1]] for fields in lines if fields[:1] == ["f"]]


def scaled(path):
    """Pairs of triangles, by a power of two so small that the unit takes them."""
    rows = [[float(x) for x in row] for row in csv.reader(Path(path).open()) if row and not row[0].strip()[0].isalpha()]
    scale = 1.0
    while max(abs(x) for row in rows for x in row) * scale > 1:
        scale /= 2
    return [[x * scale for x in row] for row in rows]


def moved(triangle, pose):
    """A triangle under a pose, which must not need rounding."""
    m, t = pose[:9], pose[9:]
    points = [triangle[i : i + 3] for i in (0, 3, 6)]
    exact = [sum(Fraction(m[3 * i + j]) * Fraction(p[j]) for j in range(3)) + Fraction(t[i]) for p in points for i in range(3)]
    rounded = [float(x) for x in exact]
    assert all(Fraction(x) == y for x, y in zip(rounded, exact))
    return rounded


def told(efsat, rows, *options):
    """Answers of `efsat classify` to pairs."""
    text = "".join(",".join(map(repr, row)) + "\n" for row in rows)
    run = subprocess.run([efsat, "classify", *options, "-"], input=text, capture_output=True, text=True, check=True)
    return list(csv.DictReader(run.stdout.splitlines()))


def verdict(efsat, word, row):
    """A line's end: the verdict, and the exact answer where it is open."""
    if VERDICTS[word] != "possibly-incorrect":
        return VERDICTS[word]
    return f"possibly-incorrect, exactly {told(efsat, [row], '--exact')[0]['exact']}"


def data(efsat, meshes, images, pairs, poses):
    def array(kind, name, rows):
        rows = ",\n".join("  {" + ", ".join(map(str, row)) + "}" for row in rows)
        print(f"static const {kind} {name}[][{len(rows_of[name][0])}] = {{\n{rows}\n}};")

    meshes = [triangles(mesh) for mesh in meshes]
    pairs = scaled(pairs)
    rows_of = {
        "mesh_a": meshes[0],
        "mesh_b": meshes[1],
        "poses": [[float(x) for x in pose.split(",")] for pose in poses],
        "pairs": pairs,
        "pair_numbers": [[f"INT64_C({int(Fraction(x) * 2**FRACTION_BITS // 1)})" for x in row] for row in pairs],
    }
    print("/* Meshes, poses and pairs for main.c. */\n#include <stdint.h>")
    print(f"#define POSES {len(poses)}\n#define PAIRS {len(pairs)}\n#define MOST_TRIANGLES {max(map(len, meshes))}")
    for name, rows in rows_of.items():
        array("int64_t" if name == "pair_numbers" else "double", name, rows)
    # In memory, not in the program: the engine reads them there.
    for name, image in zip(("image_a", "image_b"), images):
        print(f"static uint8_t {name}[] __attribute__((aligned(64))) = {{{', '.join(map(str, Path(image).read_bytes()))}}};")


def expected(efsat, meshes, images, pairs, poses, method):
    pairs = scaled(pairs)
    for i, (row, answer) in enumerate(zip(pairs, told(efsat, pairs, "--method", method))):
        print(f"pair {i}: {verdict(efsat, VERDICTS.index(answer['verdict']), row)}")
    meshes = [triangles(mesh) for mesh in meshes]
    for i, text in enumerate(poses):
        run = subprocess.run([efsat, "tree", "answer", *images, "--pose", text], capture_output=True, text=True, check=True)
        answer = json.loads(run.stdout)["expected"]
        words = sorted((int(word, 16) for word in answer["answers"]), key=lambda word: word >> 8)
        print(f"query {i}: reason {answer['reason']}, pairs {len(words)}")
        pose = [float(x) for x in text.split(",")]
        for word in words:
            a, b = word >> 8 & (1 << 28) - 1, word >> 36
            print(f"{a} {b}: {verdict(efsat, word & 3, meshes[0][a] + moved(meshes[1][b], pose))}")
    print("interrupts: some\nend")


def main(what, efsat, mesh_a, mesh_b, image_a, image_b, pairs, poses, *method):
    tell = {"data": data, "expected": expected}[what]
    tell(efsat, [mesh_a, mesh_b], [image_a, image_b], pairs, POSES[: int(poses)], *method)


if __name__ == "__main__":
    main(*sys.argv[1:])
