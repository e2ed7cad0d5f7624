"""Exact tests of triangles and meshes in binary64, and the reference models of the units that efsat generates.

A pair is two triangles, a0 a1 a2 b0 b1 b2, each x y z: arrays of shape (n, 18), (n, 6, 3) or (n, 2, 3, 3). A pose is a 4 by 4 matrix that
takes a point of B to the frame of A, as trimesh has them. Wherever a mesh is expected, anything with `vertices` and `faces` does, such as
a trimesh. Numbers that are infinite or no number raise ValueError, and nothing else is rounded or guessed.

>>> import efsat, numpy
>>> face = [[0, 0, 0], [4, 0, 0], [0, 4, 0]]
>>> pair = lambda z: face + [[1, 1, z], [1, 1, 1], [2, 1, 1]]
>>> efsat.retest([pair(-1.0), pair(0.0), pair(5e-324)]).tolist() == [efsat.INTERSECT, efsat.TOUCH, efsat.SEPARATE]
True
"""

from collections import namedtuple as _namedtuple
from fractions import Fraction as _Fraction

import numpy as _np

from . import _efsat
from ._efsat import Scene as _Scene
from .manager import CollisionManager

__all__ = [
    "SEPARATE", "TOUCH", "INTERSECT", "POSSIBLY_INCORRECT", "KINDS", "Answers", "Collider", "CollisionManager", "Contacts", "Design",
    "Engine", "Mesh", "Reason", "Register", "Scene", "classify", "contacts", "kinds", "read_mesh", "retest", "scene", "segments",
    "self_intersections",
]

#: Exact answers.
SEPARATE, TOUCH, INTERSECT = 0, 1, 2
#: The third verdict of a unit, whose others are 0, separate, and 1, intersect.
POSSIBLY_INCORRECT = 2
#: What the numbers of kinds of contacts mean.
KINDS = ("separate", "touching", "crossing", "coplanar")

#: Pairs of triangles (n, 2), and kinds (n,), numbers into KINDS.
Contacts = _namedtuple("Contacts", "pairs kinds")


def _pairs(points):
    points = _np.ascontiguousarray(points, dtype=_np.float64)
    if points.shape[1:] not in [(18,), (6, 3), (2, 3, 3)]:
        raise ValueError(f"pairs of shape {points.shape}: expected (n, 18), (n, 6, 3) or (n, 2, 3, 3)")
    return points.reshape(-1, 18)


def _poses(poses, shape):
    poses = _np.ascontiguousarray(_np.eye(4) if poses is None else poses, dtype=_np.float64)
    if poses.ndim != len(shape) or poses.shape[-2:] != (4, 4):
        raise ValueError(f"poses of shape {poses.shape}: expected {', '.join(map(str, shape))}")
    return poses.reshape(-1, 4, 4)


def _one(pose):
    return _poses(pose, (4, 4))


def _arrays(vertices, faces):
    vertices = _np.ascontiguousarray(vertices, dtype=_np.float64)
    faces = _np.asarray(faces)
    for name, array in [("vertices", vertices), ("faces", faces)]:
        if array.ndim != 2 or array.shape[1] != 3:
            raise ValueError(f"{name} of shape {array.shape}: expected (n, 3)")
    if faces.size and not _np.issubdtype(faces.dtype, _np.integer):
        raise ValueError(f"faces of type {faces.dtype}: expected whole numbers")
    if faces.size and not 0 <= faces.min() <= faces.max() < len(vertices):
        wrong = faces.min() if faces.min() < 0 else faces.max()
        raise ValueError(f"a face of vertex {wrong}: expected one of {len(vertices)} vertices, counted from 0")
    return vertices, _np.ascontiguousarray(faces, dtype=_np.uint32)


class Mesh(_efsat.Mesh):
    """Vertices (n, 3) and triangles (n, 3) with their tree. Give the same Mesh to several colliders: the tree is shared."""

    def __new__(cls, vertices, faces):
        return super().__new__(cls, *_arrays(vertices, faces))


def _mesh(mesh):
    return mesh if isinstance(mesh, _efsat.Mesh) else Mesh(mesh.vertices, mesh.faces)


def read_mesh(path):
    """The mesh of an STL, OBJ, PLY or OFF file, its numbers as they stand there; polygons become triangles."""
    return _efsat.read_mesh(path)


def retest(pairs):
    """The exact answers for pairs, by all cores: an array of SEPARATE, TOUCH and INTERSECT."""
    return _efsat.retest(_pairs(pairs))


def kinds(pairs):
    """How pairs meet, exactly: an array of numbers into KINDS. INTERSECT is crossing, or coplanar in one plane."""
    return _efsat.kinds(_pairs(pairs))


def _split(corners, exact):
    points, counts, fractions = corners
    if exact:
        points = [tuple(_Fraction(int(p), int(q)) for p, q in point) for point in fractions]
    ends = _np.cumsum(counts, dtype=int).tolist()
    return [points[end - count:end] for end, count in zip(ends, counts)]


def segments(pairs, exact=False):
    """What the triangles of each pair have in common: nothing, a point, the ends of a segment or the corners of a polygon.

    A list of arrays (k, 3), each coordinate the binary64 number nearest to the exact one; with `exact` lists of fractions.
    """
    return _split(_efsat.segments(_pairs(pairs), exact), exact)


class Collider:
    """Two meshes that move against each other. Every answer is exact for the twelve numbers of the pose; none is the identity."""

    def __init__(self, a, b):
        self._collider = _efsat.Collider(_mesh(a), _mesh(b))

    def contacts(self, pose=None):
        """All contacts in a pose: Contacts(pairs, kinds), in ascending order."""
        return Contacts(*self._collider.contacts(_one(pose))[0])

    def contacts_at(self, poses):
        """All contacts in each of some poses (n, 4, 4), by all cores: a list of Contacts."""
        (pairs, found), counts = self._collider.contacts(_poses(poses, ("n", 4, 4)))
        ends = _np.cumsum(counts, dtype=int).tolist()
        return [Contacts(pairs[end - count:end], found[end - count:end]) for end, count in zip(ends, counts.tolist())]

    def first_contact(self, pose=None):
        """Some contact (triangle of A, triangle of B, kind), or None: faster than all of them."""
        a, b, kind = self._collider.first_contacts(_one(pose))[0].tolist()
        return None if a < 0 else (a, b, KINDS[kind])

    def touches(self, poses):
        """Whether the meshes touch in each of some poses (n, 4, 4), by all cores: an array of bool."""
        return self._collider.first_contacts(_poses(poses, ("n", 4, 4)))[:, 0] >= 0

    def segments(self, pairs, pose=None, exact=False):
        """What pairs of triangles, as `contacts` gives them, have in common, in the frame of A: as the function `segments`."""
        pairs = _np.ascontiguousarray(pairs, dtype=_np.uint32).reshape(-1, 2)
        return _split(self._collider.segments(pairs, _one(pose), exact), exact)

    def solids(self, pose=None):
        """How two solids lie: "apart", "abut" (they only touch) or "overlap". ValueError says why a mesh bounds no solid."""
        return self._collider.solids(_one(pose))

    def nestings(self, pose=None):
        """Components of closed meshes that are inside each other: a list of (component of A, of B, "a in b" or "b in a")."""
        return self._collider.nestings(_one(pose))


def contacts(a, b, pose=None):
    """All contacts of two meshes in a pose. For several poses make a Collider."""
    return Collider(a, b).contacts(pose)


def self_intersections(mesh):
    """Triangles of a mesh that have more in common than vertices and edges: pairs (n, 2), and a list of what is wrong with each."""
    return _efsat.self_intersections(_mesh(mesh))


#: Verdicts (separate, intersect, possibly incorrect), flags of axes, bit i for axis i, whether a number was outside its range, and
#: whether the host has decided, because the pair does not fit the unit.
Answers = _namedtuple("Answers", "verdicts separated overlapping outside by_host")

#: Why a pair is left open, in words; the gap that was measured, and by how much that may be wrong, in units of the last place that is
#: compared: None for a number outside its range.
Reason = _namedtuple("Reason", "words gap error")

_AXES = ["n_A", "n_B"] + [f"C_{k}{l}" for k in range(3) for l in range(3)] + [f"n_{t} x e_{t}{k}" for t in "AB" for k in range(3)]


#: A register: address in bytes, access (R, W, RW, or RW1C: ones clear), value after reset, and lowest bit and size of each field.
Register = _namedtuple("Register", "address access reset fields")


def _registers(core):
    return {name: Register(*rest, {field: (low, bits) for field, low, bits in fields}) for name, *rest, fields in core.registers()}


def _words(options):
    def word(name, value):
        option = "--" + name.replace("_", "-")
        if name == "like_paper" and isinstance(value, bool):
            return [option] if value else []
        value = {True: "on", False: "off"}.get(value, value) if isinstance(value, bool) else value
        return [f"{option}={value}"]

    return [text for name, value in options.items() for text in word(name, value)]


class Design:
    """The unit that `efsat generate` makes with some options, as its reference model, bit for bit.

    Options have the names of the command line, `width=20, method="determinants"`; on and off are True and False.
    """

    def __init__(self, **options):
        self._design = _efsat.Design(_words(options))

    @property
    def options(self):
        """All options with their values, as text."""
        return dict(self._design.options)

    @property
    def command_line(self):
        """What generates the unit."""
        return self._design.command_line

    def classify(self, pairs):
        """What the unit answers for pairs, both triangles of each in one frame: Answers."""
        return Answers(*self._design.classify(_pairs(pairs)))

    def reasons(self, pairs):
        """Why each pair is possibly incorrect, by the test that came nearest to an answer: a list of Reason, None where it is decided."""
        return [reason and Reason(*reason) for reason in self._design.reasons(_pairs(pairs))]

    def tests(self, pair):
        """What each test of the unit says of a pair: a dict of axis to "separates", "overlaps" or "uncertain"; of determinants to "+",
        "-" or "uncertain"."""
        pair = _pairs([pair])
        if self._design.axes == 0:
            sign = lambda low, high: "+" if low > 0 else "-" if high < 0 else "uncertain"
            trace = self._design.trace(pair)
            return {name[5:]: sign(low, high) for name, low, high in trace if name.startswith("sign.")}
        _, (separated,), (overlapping,), _, (by_host,) = self._design.classify(pair)
        says = lambda i: "separates" if separated >> i & 1 else "overlaps" if overlapping >> i & 1 else "uncertain"
        return {} if by_host else {_AXES[i]: says(i) for i in range(self._design.axes)}

    def numbers(self, pairs):
        """The numbers at the ports of the unit, (n, 18) and the sticky bit of each; zeros where the host decides."""
        return self._design.numbers(_pairs(pairs))

    def packets(self, pairs, width=64):
        """The packets that the stream wrapper takes for pairs, as bytes of little-endian words: one with the pose, if the design has
        one, and one with the pairs."""
        return self._design.packets(_pairs(pairs), width)

    def answer(self, packets, width=64):
        """What the wrapped unit answers to packets: what a simulation of it must give."""
        return self._design.answer([bytes(packet) for packet in packets], width)

    def finish(self, pairs, answers, width=64):
        """The exact answers for pairs from the packets that came back; what the unit left open is decided in software."""
        return self._design.finish(_pairs(pairs), [bytes(packet) for packet in answers], width)

    @property
    def registers(self):
        """The registers that `--registers` puts around the stream: a dict of name to Register."""
        return _registers(self._design)

    def writes(self, packet):
        """What is written to registers, (address, value) each, to send a packet of 64-bit words."""
        return self._design.writes(bytes(packet))

    def reads(self, answer):
        """What is read from registers, (address, value) each, to get a packet that answers: the values are those that must come."""
        return self._design.reads(bytes(answer))


def classify(pairs, **options):
    """What the unit of some options answers for pairs: Design(**options).classify(pairs)."""
    return Design(**options).classify(pairs)


class Engine:
    """The collision engine that `efsat generate --engine` makes, with two meshes, as its reference model.

    `options` are those of the engine, `unit` those of the unit in it.
    """

    def __init__(self, a, b, options=None, unit=None):
        a, b = _mesh(a), _mesh(b)
        meshes = [(mesh.vertices, mesh.faces) for mesh in (a, b)]
        self._engine = _efsat.Engine(*meshes, _words(options or {}), _words(unit or {}))

    def memory(self):
        """What lies in the memory of the engine, as 64-bit words; empty for block RAM."""
        return self._engine.memory()

    def loads(self):
        """The packets that fill block RAM, as lists of 64-bit words."""
        return self._engine.loads()

    def queries(self, poses):
        """For each pose (n, 4, 4) the packet of a query, the packet that answers it, and the pairs that touch, exactly."""
        return self._engine.queries(_poses(poses, ("n", 4, 4)))

    @property
    def registers(self):
        """The registers that `--registers` puts around the engine: a dict of name to Register."""
        return _registers(self._engine)

    def writes(self, packet):
        """What is written to registers, (address, value) each, to send a packet."""
        return self._engine.writes(packet)

    def reads(self, answer):
        """What is read from registers, (address, value) each, to get a packet that answers: the values are those that must come."""
        return self._engine.reads(answer)


class Scene(_Scene):
    """A scene file: `names` and `meshes()` of its objects, `len()` frames, and for each frame `label(i)` and `meetings(i)`, a list of
    (object, object, pose of the second as seen from the first)."""


def scene(path):
    """The scene of a file."""
    return Scene(path)
