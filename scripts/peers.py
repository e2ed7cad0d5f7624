"""All contacts of two meshes by this project and by others, a row for each scene and program; then all self-intersections of a mesh."""

import importlib.util
import sys
import time

import efsat
import numpy as np

ROUNDS = 5


def ours(a, b):
    collider = efsat.Collider(a, b)
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

    first, second = [mrmeshpy.MeshPart(of_meshlib(mesh)) for mesh in (a, b)]

    def query(pose):
        vector = lambda row: mrmeshpy.Vector3f(*map(float, row))
        motion = mrmeshpy.AffineXf3f(mrmeshpy.Matrix3f(*map(vector, pose[:3, :3])), vector(pose[:3, 3]))
        return mrmeshpy.findCollidingTriangles(first, second, motion)

    return query, lambda found: [(pair.aFace.get(), pair.bFace.get()) for pair in found]


def own(mesh):
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


def rows(what, programs, poses):
    exact = None
    for name, module, program in programs:
        if importlib.util.find_spec(module) is None:
            print(f"skipped: {name} is not installed", file=sys.stderr)
            continue
        micros, found = ask(*program(), poses)
        exact = found if exact is None else exact
        numbers = [f"{micros:,.0f}", *(f"{len(x):,}" for x in (found, exact - found, found - exact))]
        print(f"| {what} | {name} | {' | '.join(numbers)} |")


def main():
    most, *files = sys.argv[1:]
    print("| scene or mesh | program | microseconds | found | missed | invented |\n| --- | --- | ---: | ---: | ---: | ---: |")
    for file in files:
        scene = efsat.scene(file)
        meshes = scene.meshes()
        meetings = [meeting for frame in range(len(scene)) for meeting in scene.meetings(frame)]
        a, b = meetings[0][:2]
        poses = [pose for p, q, pose in meetings if (p, q) == (a, b)]
        poses = poses[:: max(1, -(-len(poses) // int(most)))]
        pair = meshes[a], meshes[b]
        programs = [("efsat", "efsat", ours), ("FCL", "fcl", fcl), ("Coal", "coal", coal), ("MeshLib", "meshlib", meshlib)]
        rows(scene.name, [(name, module, lambda program=program: program(*pair)) for name, module, program in programs], poses)
    for file in ["m8_bolt", "m8_nut", "cad_headlight"]:
        mesh = efsat.read_mesh(f"scenes/{file}.stl")
        programs = [("efsat", "efsat", lambda: own(mesh)), ("MeshLib", "meshlib", lambda: own_meshlib(mesh))]
        rows(f"{file} itself", programs, [None])


main()
