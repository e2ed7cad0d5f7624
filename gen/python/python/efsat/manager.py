"""Several bodies at once, in the manner of trimesh.collision.CollisionManager."""

import numpy as _np



class CollisionManager:
    """Bodies by their names, each a mesh and a transform (4, 4) to the world.

    The pose of one body as seen from another is computed in binary64, inverse(T_a) T_b; what follows is exact for it. The names of
    functions and their results are those of trimesh; data are `ContactData`.
    """

    def __init__(self):
        self._bodies = {}
        self._colliders = {}

    def add_object(self, name, mesh, transform=None):
        """Adds a body."""
        from . import _mesh, _one

        if name in self._bodies:
            raise ValueError(f"object '{name}': expected a name that is not taken")
        self._bodies[name] = (_mesh(mesh), _one(transform)[0])

    def remove_object(self, name):
        """Removes a body."""
        self._mesh_of(name)
        del self._bodies[name]
        self._colliders = {names: collider for names, collider in self._colliders.items() if name not in names}

    def set_transform(self, name, transform):
        """Moves a body."""
        from . import _one

        self._bodies[name] = (self._mesh_of(name), _one(transform)[0])

    def in_collision_internal(self, return_names=False, return_data=False):
        """Whether any two bodies touch; with their names as a set of pairs, and the contacts."""
        bodies = sorted(self._bodies)
        pairs = ((p, q) for at, p in enumerate(bodies) for q in bodies[at + 1:])
        return _answer(((names, *self._seen(*names)) for names in pairs), return_names, return_data)

    def in_collision_single(self, mesh, transform=None, return_names=False, return_data=False):
        """Whether a mesh touches any body; with the names of those, and the contacts, in which the mesh is "__external"."""
        from . import Collider, _mesh, _one

        mesh, transform = _mesh(mesh), _one(transform)[0]
        asked = (((name, "__external"), Collider(body, mesh), _seen(placed, transform)) for name, (body, placed) in self._bodies.items())
        hit, names, *data = _answer(asked, True, return_data)
        return _returned(hit, {name for name, _ in names}, sum(data, []), return_names, return_data)

    def in_collision_other(self, other_manager, return_names=False, return_data=False):
        """Whether a body touches one of another manager; with pairs of their names, and the contacts."""
        from . import Collider

        asked = (
            ((p, q), Collider(mesh, other), _seen(placed, at))
            for p, (mesh, placed) in self._bodies.items()
            for q, (other, at) in other_manager._bodies.items()
        )
        return _answer(asked, return_names, return_data)

    def _mesh_of(self, name):
        if name not in self._bodies:
            raise ValueError(f"object '{name}': expected one of {sorted(self._bodies)}")
        return self._bodies[name][0]

    def _seen(self, p, q):
        from . import Collider

        if (p, q) not in self._colliders:
            self._colliders[p, q] = Collider(self._bodies[p][0], self._bodies[q][0])
        return self._colliders[p, q], _seen(self._bodies[p][1], self._bodies[q][1])


def _seen(a, b):
    pose = _np.linalg.inv(a) @ b
    # The inverse of a matrix leaves the last row only nearly as it was.
    pose[3] = [0, 0, 0, 1]
    return pose


def _answer(asked, return_names, return_data):
    """Names, colliders and poses as the answer of a manager; all contacts are found only if they are wanted."""
    names, data = set(), []
    for pair, collider, pose in asked:
        if return_data:
            pairs, kinds = collider.contacts(pose)
            found = [ContactData(pair, a, b, kind, collider, pose) for (a, b), kind in zip(pairs.tolist(), kinds.tolist())]
        else:
            found = collider.first_contact(pose)
        names |= {pair} if found else set()
        data += found if return_data else []
        if names and not (return_names or return_data):
            break
    return _returned(bool(names), names, data, return_names, return_data)


def _returned(hit, names, data, return_names, return_data):
    result = [hit] + [names] * return_names + [data] * return_data
    return hit if len(result) == 1 else tuple(result)


class ContactData:
    """Two triangles that touch: `names` of the bodies, `index(name)` of the triangle, `kind`, and the corners of what they have in common
    by `segment()`, in the frame of the first body."""

    def __init__(self, names, a, b, kind, collider, pose):
        from . import KINDS

        self.names, self.kind = set(names), KINDS[kind]
        self._order, self._triangles, self._collider, self._pose = names, (a, b), collider, pose

    def index(self, name):
        """The number of the triangle of a body."""
        return self._triangles[self._order.index(name)]

    def segment(self):
        """What the triangles have in common, rounded once, (k, 3)."""
        return self._collider.segments([self._triangles], self._pose)[0]
