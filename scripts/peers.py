"""All contacts of two meshes by this project and by others, a row for each scene and program; then all self-intersections of a mesh."""

import collections
import importlib.util
import pathlib
import subprocess
import sys
import tempfile
import time

import efsat
import numpy as np

ROUNDS = 5
#: Commands of peers.cpp and peers.rs, if they could be compiled.
COMPILED = {name: [sys.argv[4], name] for name in ("CGAL", "Embree", "Bullet") if sys.argv[4]}
COMPILED |= {"parry": [file] for file in sys.argv[5:] if file}
Shape = collections.namedtuple("Shape", "vertices faces")


def ours(a, b):
    collider = efsat.Collider(*[efsat.Mesh(mesh.vertices, mesh.faces) for mesh in (a, b)])
    return collider.contacts, lambda found: found.pairs.tolist()


def fcl(a, b):
    import fcl

    def model(mesh):
        tree = fcl.BVHModel()
        tree.beginModel(len(mesh.faces), len(mesh.vertices))
        tree.addSubModel(mesh.vertices, mesh.faces)
        tree.endModel()
        return tree

    fixed, tree = fcl.CollisionObject(model(a), fcl.Transform()), model(b)
    request = fcl.CollisionRequest(num_max_contacts=2**31 - 1, enable_contact=False)

    def query(pose):
        result = fcl.CollisionResult()
        fcl.collide(fixed, fcl.CollisionObject(tree, fcl.Transform(pose[:3, :3], pose[:3, 3])), request, result)
        return result

    return query, lambda result: [(contact.b1, contact.b2) for contact in result.contacts]


def coal(a, b):
    import coal

    def model(mesh):
        tree = coal.BVHModelOBB()
        tree.beginModel(len(mesh.faces), len(mesh.vertices))
        tree.addVertices(np.asfortranarray(mesh.vertices))
        tree.addTriangles(mesh.faces.astype(np.int64))
        tree.endModel()
        return tree

    first, second = model(a), model(b)
    request = coal.CollisionRequest(coal.CollisionRequestFlag.NO_REQUEST, 2**31 - 1)

    def query(pose):
        result = coal.CollisionResult()
        coal.collide(first, coal.Transform3s(), second, coal.Transform3s(pose[:3, :3], pose[:3, 3]), request, result)
        return result

    return query, lambda result: [(contact.b1, contact.b2) for contact in result.getContacts()]


def of_meshlib(mesh):
    from meshlib import mrmeshnumpy

    # Vertices of non-manifold edges would be doubled, which numbers no face otherwise.
    return mrmeshnumpy.meshFromFacesVerts(mesh.faces.astype(np.int32), mesh.vertices)


def meshlib(a, b):
    from meshlib import mrmeshpy

    built = [of_meshlib(mesh) for mesh in (a, b)]
    for mesh in built:
        mesh.getAABBTree()
    first, second = map(mrmeshpy.MeshPart, built)

    def query(pose):
        vector = lambda row: mrmeshpy.Vector3f(*map(float, row))
        motion = mrmeshpy.AffineXf3f(mrmeshpy.Matrix3f(*map(vector, pose[:3, :3])), vector(pose[:3, 3]))
        return mrmeshpy.findCollidingTriangles(first, second, motion)

    return query, lambda found: [(pair.aFace.get(), pair.bFace.get()) for pair in found]


def trueform(a, b):
    import trueform

    first, second = [trueform.Mesh(mesh.faces.astype(np.int32), np.ascontiguousarray(mesh.vertices)) for mesh in (a, b)]
    for mesh in (first, second):
        mesh.build_tree()

    def query(pose):
        second.transformation = pose
        return trueform.gather_intersecting_ids(first, second)

    return query, lambda found: found.tolist()


def libigl(a, b):
    from igl.copyleft import cgal

    faces = [mesh.faces.astype(np.int64) for mesh in (a, b)]

    def query(pose):
        # Its trees are made in each query.
        moved = b.vertices @ pose[:3, :3].T + pose[:3, 3]
        return cgal.intersect_other(a.vertices, faces[0], moved, faces[1], detect_only=True, cutoff=2**31 - 1)

    return query, lambda found: found[0].tolist()


def own(mesh):
    mesh = efsat.Mesh(mesh.vertices, mesh.faces)
    return lambda _: efsat.self_intersections(mesh), lambda found: found[0].tolist()


def own_meshlib(mesh):
    from meshlib import mrmeshpy

    built = of_meshlib(mesh)
    part = mrmeshpy.MeshPart(built)

    def query(_):
        # Its tree is kept; this project makes its own each time.
        built.invalidateCaches()
        return mrmeshpy.findSelfCollidingTriangles(part)

    return query, lambda found: [sorted((pair.aFace.get(), pair.bFace.get())) for pair in found]


def own_libigl(mesh):
    from igl.copyleft import cgal

    faces = mesh.faces.astype(np.int64)
    query = lambda _: cgal.remesh_self_intersections(mesh.vertices, faces, detect_only=True, cutoff=2**31 - 1)
    return query, lambda found: np.sort(found[2], axis=1).tolist()


#: What is asked for contacts, and for self-intersections: name, module, program.
CONTACTS = [
    ("efsat", "efsat", ours),
    ("FCL", "fcl", fcl),
    ("Coal", "coal", coal),
    ("MeshLib", "meshlib", meshlib),
    ("trueform", "trueform", trueform),
    ("libigl", "igl", libigl),
]
OWN = [("efsat", "efsat", own), ("MeshLib", "meshlib", own_meshlib), ("libigl", "igl", own_libigl)]


def tori(sides=224):
    """Two of 2 * sides * sides triangles that touch along a curve, and poses of the second."""
    i, j = np.divmod(np.arange(sides * sides), sides)
    u, v = (np.stack([i, j]) * (2 * np.pi / sides))
    r = 1 + 0.4 * np.cos(v)
    index = lambda i, j: i % sides * sides + j % sides
    p, q, s, t = index(i, j), index(i + 1, j), index(i + 1, j + 1), index(i, j + 1)
    faces = np.concatenate([np.stack([p, q, s], 1), np.stack([p, s, t], 1)])
    mesh = Shape(np.stack([r * np.cos(u), r * np.sin(u), 0.4 * np.sin(v)], 1), faces)
    return mesh, [moved([x, 0.1, 0.2]) for x in (2.79, 2.6, 2.4, 2.2, 1.9)]


def moved(t):
    pose = np.eye(4)
    pose[:3, 3] = t
    return pose


def ask(query, read, poses):
    """The best processor time of each query in microseconds, the mean of these, and the pairs that were found."""
    best = np.full(len(poses), np.inf)
    for _ in range(ROUNDS):
        found = set()
        for i, pose in enumerate(poses):
            start = time.process_time()
            result = query(pose)
            best[i] = min(best[i], time.process_time() - start)
            found |= {(i, *pair) for pair in read(result)}
    return best.mean() * 1e6, found


def timed(program, poses):
    """What `ask` says of a program, after the best processor time of making its trees in milliseconds."""
    trees = []
    for _ in range(ROUNDS):
        start = time.process_time()
        asked = program()
        trees.append(time.process_time() - start)
    return 1e3 * min(trees), *ask(*asked, poses)


def compiled(name, a, b, poses):
    """The same of a program of COMPILED."""
    with tempfile.TemporaryDirectory() as folder:
        folder = pathlib.Path(folder)
        for mesh, file in [(a, "a.f64"), (b, "b.f64")]:
            mesh.vertices[mesh.faces].astype("<f8").tofile(folder / file)
        np.array([[*pose[:3, :3].flat, *pose[:3, 3]] for pose in poses]).astype("<f8").tofile(folder / "poses.f64")
        said = subprocess.run([*COMPILED[name], folder, str(ROUNDS)], check=True, capture_output=True, text=True).stdout
        trees, query = map(float, said.split())
        return 1e3 * trees, 1e6 * query, set(map(tuple, np.fromfile(folder / "found.u32", "<u4").reshape(-1, 3).tolist()))


def rows(what, programs, trees_apart=True):
    """A row for each program: the first one says what was asked and how many pairs there are, the others what they missed and invented."""
    exact = None
    for name, measure in programs:
        trees, micros, found = measure()
        if exact is None:
            exact, says = found, f"{len(found):,}"
        else:
            says = f"{len(exact - found):,} / {len(found - exact):,}" if found != exact else ""
        print(f"| {what} | {name} | {f'{trees:,.1f}' if trees_apart else ''} | {micros:,.0f} | {says} |", flush=True)
        what = ""


def installed(programs):
    for name, module, program in programs:
        if importlib.util.find_spec(module) is None:
            print(f"skipped: {name} is not installed", file=sys.stderr)
        else:
            yield name, program


def pairs(what, a, b, poses):
    measures = [(name, lambda program=program: timed(lambda: program(a, b), poses)) for name, program in installed(CONTACTS)]
    measures += [(name, lambda name=name: compiled(name, a, b, poses)) for name in COMPILED]
    rows(what, measures)


def main():
    most, scenes, files = int(sys.argv[1]), sys.argv[2].split(), sys.argv[3].split()
    print("| scene or mesh | program | trees, ms | microseconds | pairs, or missed / invented |")
    print("| --- | --- | ---: | ---: | ---: |")
    for file in scenes:
        scene = efsat.scene(file)
        meshes = scene.meshes()
        meetings = [meeting for frame in range(len(scene)) for meeting in scene.meetings(frame)]
        a, b = meetings[0][:2]
        poses = [pose for p, q, pose in meetings if (p, q) == (a, b)]
        shapes = [Shape(mesh.vertices, mesh.faces) for mesh in (meshes[a], meshes[b])]
        pairs(scene.name, *shapes, poses[:: max(1, -(-len(poses) // most))])
    if not files:
        return
    torus, poses = tori()
    pairs("tori", torus, torus, poses)
    count = len(torus.vertices)
    both = Shape(np.concatenate([torus.vertices, torus.vertices + poses[1][:3, 3]]), np.concatenate([torus.faces, torus.faces + count]))
    meshes = [(pathlib.Path(file).stem, efsat.read_mesh(file)) for file in files]
    for name, mesh in [*meshes, ("two tori", both)]:
        rows(f"{name} itself", [(of, lambda program=program: timed(lambda: program(mesh), [None])) for of, program in installed(OWN)], False)


main()
