"""Asks FCL about all contacts in the meetings that the benchmark `query` wrote: prints contacts and microseconds per query."""

import itertools
import sys
import time
from pathlib import Path

import fcl
import numpy

ROUNDS = 3


def model(file):
    """A tree of oriented boxes; triangles share no vertices, which makes no difference to it."""
    vertices = numpy.fromfile(file).reshape(-1, 3)
    faces = numpy.arange(len(vertices)).reshape(-1, 3)
    tree = fcl.BVHModel()
    tree.beginModel(len(faces), len(vertices))
    tree.addSubModel(vertices, faces)
    tree.endModel()
    return tree


def main():
    folder = Path(sys.argv[1])
    files = itertools.takewhile(Path.exists, (folder / f"mesh_{i}.f64" for i in itertools.count()))
    models = [model(file) for file in files]
    meetings = numpy.fromfile(folder / "meetings.f64").reshape(-1, 14)
    still = fcl.Transform()
    queries = [
        (
            fcl.CollisionObject(models[int(row[0])], still),
            fcl.CollisionObject(models[int(row[1])], fcl.Transform(row[2:11].reshape(3, 3), row[11:14])),
        )
        for row in meetings
    ]
    request = fcl.CollisionRequest(num_max_contacts=2**31 - 1, enable_contact=False)
    best = float("inf")
    for _ in range(ROUNDS):
        contacts = 0
        start = time.perf_counter()
        for a, b in queries:
            result = fcl.CollisionResult()
            fcl.collide(a, b, request, result)
            contacts += len(result.contacts)
        best = min(best, time.perf_counter() - start)
    print(contacts, f"{best * 1e6 / len(queries):.2f}")


main()
