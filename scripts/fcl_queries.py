"""Asks FCL about all contacts in the meetings that the benchmark `query` wrote: prints contacts and microseconds per query;
then distance, queries and microseconds per query for each distance of a turn."""

import itertools
import sys
import time
from pathlib import Path

import fcl
import numpy

ROUNDS = 5


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
    meetings = numpy.fromfile(folder / "meetings.f64").reshape(-1, 15)
    still = fcl.Transform()
    queries = [
        (
            fcl.CollisionObject(models[int(row[1])], still),
            fcl.CollisionObject(models[int(row[2])], fcl.Transform(row[3:12].reshape(3, 3), row[12:15])),
        )
        for row in meetings
    ]
    request = fcl.CollisionRequest(num_max_contacts=2**31 - 1, enable_contact=False)
    # The best processor time of each query: what else the machine does comes and goes.
    best = numpy.full(len(queries), numpy.inf)
    for _ in range(ROUNDS):
        contacts = 0
        for i, (a, b) in enumerate(queries):
            result = fcl.CollisionResult()
            start = time.thread_time()
            fcl.collide(a, b, request, result)
            best[i] = min(best[i], time.thread_time() - start)
            contacts += len(result.contacts)
    print(contacts, f"{best.mean() * 1e6:.2f}")
    for distance, group in itertools.groupby(range(len(queries)), lambda i: meetings[i, 0]):
        times = best[list(group)]
        if not numpy.isnan(distance):
            print(f"{distance:g} {len(times)} {times.mean() * 1e6:.2f}")


main()
