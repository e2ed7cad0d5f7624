"""Tests of the package: answers equal those that are known, and what is wrong is refused."""

import ast
import hashlib
import pathlib
import re
import subprocess
import sys
import threading
import time
from fractions import Fraction

import numpy as np
import pytest
import trimesh

import efsat

ROOT = pathlib.Path(__file__).parents[3]
FACE = [[0, 0, 0], [4, 0, 0], [0, 4, 0]]


def pair(z):
    return FACE + [[1, 1, z], [1, 1, 1], [2, 1, 0.5]]


PAIRS = np.array([pair(-1.0), pair(0.0), pair(5e-324)])


def moved(*t):
    pose = np.eye(4)
    pose[:3, 3] = t
    return pose


PAGES = [ROOT / page for page in ["README.md", "docs/exact-software.md", "gen/python/README.md"]]
BLOCKS = [(str(page.relative_to(ROOT)), block) for page in PAGES for block in re.findall(r"```python\n(.*?)```", page.read_text(), re.S)]


@pytest.mark.parametrize("page, block", BLOCKS)
def test_the_python_of_the_pages_runs(page, block):
    exec(compile(block, page, "exec"), {})


def test_every_page_has_a_block_and_that_of_the_readme_is_short():
    assert {ROOT / page for page, _ in BLOCKS} == set(PAGES)
    readme = [block for page, block in BLOCKS if page == "README.md"][0]
    assert len([line for line in readme.splitlines() if line]) <= 10


def test_the_examples_run(tmp_path):
    def says(*words):
        return subprocess.run([sys.executable, *words], check=True, capture_output=True, text=True).stdout

    *rows, last = says(ROOT / "examples/python_fcl.py").splitlines()
    assert last == "True overlap" and len(rows) > 20 and all("crossing" in row or "touching" in row for row in rows)
    plot = tmp_path / "plot.pdf"
    says(ROOT / "examples/accuracy_time.py", ROOT / "docs/accuracy/headlight/points.csv", plot)
    assert plot.read_bytes().startswith(b"%PDF")


def test_the_stubs_name_what_there_is():
    stub = ast.parse(pathlib.Path(efsat.__file__).with_suffix(".pyi").read_text())
    members = lambda node: {part.name for part in node.body if isinstance(part, ast.FunctionDef) and not part.name.startswith("_")}
    for node in stub.body:
        if isinstance(node, ast.ClassDef) and node.name in efsat.__all__ and not node.bases:
            public = {name for name in dir(getattr(efsat, node.name)) if not name.startswith("_")}
            assert members(node) == public, node.name
    named = {part.name for part in stub.body if isinstance(part, (ast.ClassDef, ast.FunctionDef))}
    assert {name for name in efsat.__all__ if callable(getattr(efsat, name))} <= named | {"CollisionManager"}


def test_pairs_of_any_shape_and_type():
    expected = [efsat.INTERSECT, efsat.TOUCH, efsat.SEPARATE]
    for given in [PAIRS, PAIRS.reshape(3, 18), PAIRS.reshape(3, 2, 3, 3), PAIRS.tolist(), np.asfortranarray(PAIRS)]:
        assert efsat.retest(given).tolist() == expected
        assert [efsat.KINDS[kind] for kind in efsat.kinds(given)] == ["crossing", "touching", "separate"]
    assert efsat.retest(PAIRS[::-1]).tolist() == expected[::-1]
    assert efsat.retest(np.empty((0, 18))).tolist() == []
    flat = FACE + [[1, 1, 0], [5, 1, 0], [1, 5, 0]]
    assert efsat.KINDS[efsat.kinds([flat])[0]] == "coplanar"


@pytest.mark.parametrize("wrong, words", [
    ([pair(float("nan"))], "pair 0: z of b0 is NaN: expected a finite number"),
    ([pair(0.0), pair(float("inf"))], "pair 1: z of b0 is inf"),
    (np.zeros((2, 17)), "expected (n, 18)"),
    (np.zeros(18), "expected (n, 18)"),
])
def test_wrong_pairs_are_refused(wrong, words):
    for function in [efsat.retest, efsat.kinds, efsat.segments, efsat.classify]:
        with pytest.raises(ValueError, match=re.escape(words)):
            function(wrong)


def test_segments():
    through = FACE + [[0, 1, -1], [0, 1, 2], [1, 1, 2]]
    rounded, nothing = efsat.segments([through, pair(5e-324)])
    assert sorted(rounded.tolist()) == [[0.0, 1.0, 0.0], [1 / 3, 1.0, 0.0]] and nothing.shape == (0, 3)
    exact, nothing = efsat.segments([through, pair(5e-324)], exact=True)
    assert sorted(exact) == [(0, 1, 0), (Fraction(1, 3), 1, 0)] and nothing == []
    assert efsat.segments(np.empty((0, 18))) == efsat.segments(np.empty((0, 18)), exact=True) == []


def test_meshes_are_checked():
    for faces, words in [([[0, 1, 3]], "vertex 3"), ([[0, 1, -1]], "vertex -1"), ([[0, 1]], "(n, 3)"), ([[0.0, 1.0, 2.0]], "whole numbers")]:
        with pytest.raises(ValueError, match=re.escape(words)):
            efsat.Mesh(FACE, faces)
    with pytest.raises(ValueError, match="y of vertex 1 is inf"):
        efsat.Mesh([[0, 0, 0], [0, float("inf"), 0], [1, 0, 0]], [[0, 1, 2]])
    with pytest.raises(ValueError, match="no_such.stl"):
        efsat.read_mesh("no_such.stl")
    mesh = efsat.read_mesh(ROOT / "scenes/m8_bolt.stl")
    again = efsat.Mesh(mesh.vertices, mesh.faces)
    assert len(mesh) == len(again) == 9320 and np.array_equal(mesh.vertices, again.vertices)


def test_self_intersections_are_those_of_the_command_line():
    pairs, kinds = efsat.self_intersections(efsat.read_mesh(ROOT / "scenes/m8_bolt.stl"))
    assert len(pairs) == len(kinds) and {"crossing", "touching"} >= set(kinds) - {"neighbours", "duplicate"}
    crossed = trimesh.Trimesh(FACE + [[1, 1, -1], [1, 1, 1], [1, 0.5, 0]], [[0, 1, 2], [3, 4, 5]], process=False)
    pairs, kinds = efsat.self_intersections(crossed)
    assert (pairs.tolist(), kinds) == ([[0, 1]], ["crossing"])


def test_colliders():
    box = trimesh.creation.box()
    collider = efsat.Collider(box, efsat.Mesh(box.vertices, box.faces))
    poses = np.array([moved(x, 0, 0) for x in (0.5, 1.0, np.nextafter(1.0, 2.0))])
    assert collider.touches(poses).tolist() == [True, True, False]
    assert [collider.solids(pose) for pose in poses] == ["overlap", "abut", "apart"]
    found = collider.contacts_at(poses)
    assert [len(contacts.pairs) for contacts in found][2] == 0
    for pose, contacts in zip(poses, found):
        alone = collider.contacts(pose)
        assert np.array_equal(alone.pairs, contacts.pairs) and np.array_equal(alone.kinds, contacts.kinds)
        first = collider.first_contact(pose)
        assert (first is None) == (len(alone.pairs) == 0)
        # The same as pairs of moved triangles, which these poses move without rounding.
        corners = lambda pairs: np.concatenate([box.triangles[pairs[:, 0]], box.triangles[pairs[:, 1]] + pose[:3, 3]], axis=1)
        every = np.stack(np.meshgrid(np.arange(12), np.arange(12), indexing="ij"), axis=-1).reshape(-1, 2)
        kinds = efsat.kinds(corners(every).reshape(-1, 6, 3))
        assert np.array_equal(every[kinds > 0], alone.pairs) and np.array_equal(kinds[kinds > 0], alone.kinds)
        segments = collider.segments(alone.pairs, pose)
        assert all(len(segment) > 0 for segment in segments)
    assert collider.nestings(moved(0, 0, 5)) == []
    small = trimesh.creation.box([0.1] * 3)
    assert efsat.Collider(box, small).nestings() == [(0, 0, "b in a")]
    with pytest.raises(IndexError):
        collider.segments([[0, 12]])
    for wrong, words in [(np.full((4, 4), np.nan), "last row"), (np.eye(3), "shape"), (moved(np.inf, 0, 0), "x of the translation is inf")]:
        with pytest.raises(ValueError, match=words):
            collider.contacts(wrong)
    open_box = trimesh.Trimesh(box.vertices, box.faces[1:], process=False)
    with pytest.raises(ValueError, match="the mesh is open"):
        efsat.Collider(open_box, box).solids()


def test_managers_answer_as_trimesh_asks():
    ours, box = efsat.CollisionManager(), trimesh.creation.box()
    ours.add_object("a", box)
    ours.add_object("b", box, moved(1, 0, 0))
    hit, names, data = ours.in_collision_internal(return_names=True, return_data=True)
    assert hit and names == {("a", "b")} and {contact.kind for contact in data} <= set(efsat.KINDS)
    assert all(contact.segment().shape[1] == 3 and 0 <= contact.index("b") < 12 for contact in data)
    assert ours.in_collision_single(box, moved(2, 0, 0), return_names=True) == (True, {"b"})
    other = efsat.CollisionManager()
    other.add_object("c", box, moved(-1, 0, 0))
    assert ours.in_collision_other(other, return_names=True) == (True, {("a", "c")})
    ours.remove_object("b")
    assert not ours.in_collision_internal()
    with pytest.raises(ValueError, match="expected a name"):
        ours.add_object("a", box)
    with pytest.raises(ValueError, match="object 'b'"):
        ours.set_transform("b", np.eye(4))


def test_designs():
    default = efsat.classify(PAIRS)
    assert default.verdicts.tolist() == [1, 2, 2] and not default.by_host.any() and not default.outside.any()
    wide = efsat.Design(width=32, axes=17, like_paper=False)
    assert wide.options["width"] == "32" and "--width 32" in wide.command_line
    tests = wide.tests(PAIRS[0])
    assert len(tests) == 17 and all(tests[axis] == "overlaps" for axis in list(tests)[:11])
    for method in ["axes", "determinants"]:
        decided, *reasons = efsat.Design(method=method).reasons(PAIRS)
        assert decided is None and all("certain" in reason.words and abs(reason.gap) <= reason.error for reason in reasons)
    signs = efsat.Design(method="determinants").tests(PAIRS[1])
    assert set(signs.values()) <= {"+", "-", "uncertain"} and "uncertain" in signs.values()
    exact = efsat.Design(method="exact")
    assert exact.classify(PAIRS[:2]).verdicts.tolist() == [1, 1]
    for options, words in [({"width": 99}, "99"), ({"witdh": 20}, "--witdh"), ({"method": "exact", "axes": 17}, "--method axes"), ({"method": "exact", "like_paper": True}, "--like-paper")]:
        with pytest.raises(ValueError, match=words):
            efsat.Design(**options)


@pytest.mark.parametrize("width", [32, 64, 128, 1024])
def test_words_of_the_stream(width):
    for options in [{}, {"upper": "sticky"}, {"method": "determinants"}, {"method": "exact"}]:
        design = efsat.Design(**options)
        packets = design.packets(PAIRS, width)
        assert all(len(packet) % (width // 8) == 0 for packet in packets)
        answers = design.answer(packets, width)
        assert design.finish(PAIRS, answers, width).tolist() == [2, 1, 0]
        with pytest.raises(ValueError):
            design.finish(PAIRS, answers[:-1], width)
    with pytest.raises(ValueError, match="expected one of 32"):
        efsat.Design().packets(PAIRS, 48)
    numbers, sticky = efsat.Design().numbers(PAIRS)
    assert numbers.shape == sticky.shape == (3, 18) and numbers.any()


def test_words_of_the_registers():
    rows = re.findall(r"^\| `(\w{3})` \| `(\w+)` \| (\w+) \| (\w+) \|", (ROOT / "docs/registers.md").read_text(), re.M)
    page = {name: (int(address, 16), access, reset) for address, name, access, reset in rows}
    box = trimesh.creation.box()
    engine = efsat.Engine(box, box)
    for design in [efsat.Design(), engine]:
        for name, (address, access, reset, fields) in design.registers.items():
            assert page[name][:2] == (address, access) and page[name][2] in (f"{reset:x}", "constant"), name
            assert all(0 <= low < low + bits <= 32 for low, bits in fields.values())
    assert set(page) == set(engine.registers)
    design = efsat.Design(method="determinants")
    at = {name: register.address for name, register in design.registers.items()}
    assert design.registers["parameters"].reset == int(hashlib.sha256(design.command_line.encode()).hexdigest()[:8], 16)
    packet = design.packets(PAIRS)[-1]
    for words, writes in [(np.frombuffer(packet, "<u8").tolist(), design.writes(packet)), ([1 << 40, 2], engine.writes([1 << 40, 2]))]:
        assert [low + (high << 32) for (_, low), (_, high) in zip(writes[::2], writes[1::2])] == words
        higher = [at["transmit_high"]] * (len(words) - 1) + [at["transmit_last"]]
        assert [address for address, _ in writes] == [x for high in higher for x in (at["transmit_low"], high)]
    answer, *_ = design.answer([packet])
    reads = design.reads(answer)
    assert {address for address, _ in reads} == {at["receive_low"], at["receive_high"]}
    size = 2 * len(answer) // len(reads)
    words = [low + (high << 32) for (_, low), (_, high) in zip(reads[::2], reads[1::2])]
    assert b"".join(word.to_bytes(size, "little") for word in words) == answer
    with pytest.raises(ValueError, match="multiple of 8"):
        design.writes(packet[:-1])


def test_engines():
    box = trimesh.creation.box()
    engine = efsat.Engine(box, box, unit={"width": 18})
    (packet, answer, pairs), (_, _, none) = engine.queries(np.array([moved(0.5, 0.25, 0.125), moved(3, 0, 0)]))
    assert packet and answer and none == []
    assert np.array_equal(pairs, efsat.contacts(box, box, moved(0.5, 0.25, 0.125)).pairs)
    assert len(engine.memory()) + len(engine.loads()) > 0


def test_scenes():
    scene = efsat.scene(ROOT / "scenes/gears.toml")
    meshes = scene.meshes()
    assert len(scene) > 0 and len(scene.names) == len(meshes)
    a, b, pose = scene.meetings(0)[0]
    assert pose.shape == (4, 4) and len(efsat.Collider(meshes[a], meshes[b]).contacts(pose).pairs) > 0
    with pytest.raises(IndexError):
        scene.meetings(len(scene))
    with pytest.raises(ValueError):
        efsat.scene("no_such.toml")


def test_the_interpreter_is_free_meanwhile():
    pairs = np.repeat(PAIRS.reshape(3, 18), 200_000, axis=0)
    ticks, done = [], threading.Event()

    def tick():
        while not done.is_set():
            ticks.append(time.perf_counter())
            time.sleep(0.001)

    thread = threading.Thread(target=tick)
    thread.start()
    start = time.perf_counter()
    efsat.retest(pairs)
    end = time.perf_counter()
    done.set()
    thread.join()
    assert sum(start < at < end for at in ticks) > 3
