"""Tables in Markdown, for scripts/figures: by their description in docs/figures.toml, or by a function of this file that it names."""

import csv
import functools
import hashlib
import json
import math
import os
import re
import shutil
import subprocess
import sys
import tempfile
import tomllib
from pathlib import Path
from types import SimpleNamespace

KEPT = Path("target/figures")


def run(command):
    """What a command prints. Status 1 is a check that failed; of `synth` it may be a clock that was missed, of `mutate` a mutant that
    survived, and a table shows both."""
    words = [os.environ["EFSAT"] if word == "efsat" else word for word in command.split()]
    done = subprocess.run(words, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)
    shown = command.startswith(("efsat synth", "efsat mutate"))
    if done.returncode not in ((0, 1) if shown else (0,)) or not done.stdout.strip():
        raise SystemExit(f"error: {command}: {done.stderr.strip() or f'exit status {done.returncode}'}")
    return done.stdout


def kept(command):
    """The same, from an earlier run of the same program if there is one."""
    files = [Path(word).read_bytes() for word in command.split() if Path(word).is_file()]
    parts = [Path(shutil.which(os.environ["EFSAT"])).read_bytes(), " ".join(command.split()).encode(), *files]
    file = KEPT / hashlib.sha256(b"\0".join(parts)).hexdigest()[:16]
    if not file.exists():
        print(command, file=sys.stderr, flush=True)
        text = run(command)
        file.parent.mkdir(parents=True, exist_ok=True)
        file.write_text(text)
    return file.read_text()


@functools.lru_cache(maxsize=None)
def ask(command, dear=True):
    """The JSON object that a command of efsat prints, with its keys as attributes."""
    text = (kept if dear else run)(f"efsat {command} --json").split("\n", 1)[0]
    return json.loads(text, object_hook=lambda keys: SimpleNamespace(**keys))


def share(part, whole, places=2):
    return f"{100 * part / whole:.{places}f}"


def code(text, empty="none"):
    return f"`{text}`" if text else empty


def luts(cells):
    """Look-up tables for logic and as memory."""
    return cells.luts + cells.memory_luts


def against(p, a):
    """Predicted against counted cells."""
    return f"{p:,} / {a:,}" + (f", {100 * (p - a) / a:+.1f} %" if a and p != a else "")


def routed(clock):
    """The median of the clocks after routing, and all of them."""
    clocks = [f"{mhz:.1f}" if mhz else "not routed" for mhz in vars(clock.seeds).values()]
    median = f"**{clock.median:.1f}**" if clock.median else "not routed"
    return median + (f", median of {', '.join(clocks)}" if len(clocks) > 1 else ", one seed")


def parts(unit):
    """A unit and everything in it."""
    return [unit, *(inner for part in unit.parts for inner in parts(part))]


def mean(found, key):
    return f"{getattr(found, key) / found.queries:,.0f}"


def busy(found):
    """Shares of the clocks of an engine: volume unit, triangle unit, bus."""
    return [share(getattr(found, key), found.clocks, 0) + " %" for key in ("volume_busy", "triangle_busy", "words")]


def engine(options):
    """Predicted cells of an engine; memory and query are no options of the design."""
    found = ask("synth --predict --engine " + re.sub(r"--latency \d+|--first-contact", "", options))
    return found.units.predicted


def changed_list(mesh, width):
    """Self-intersections that a mesh has only after it was moved to a grid, and those that it has only before."""

    def pairs(options):
        run(f"efsat self-intersections {mesh} {options} --csv {KEPT}/pairs.csv")
        return {tuple(row[:2]) for row in csv.reader((KEPT / "pairs.csv").read_text().splitlines()[1:])}

    file, moved = pairs(""), pairs(f"--width {width}")
    return len(moved - file), len(file - moved)


def rows_of(figure):
    """The cells of a table by its description in the registry, the head first."""
    dear = figure["cost"] == "dear"
    names = {"ask": functools.partial(ask, dear=dear)} | {f.__name__: f for f in (share, code, luts, against, routed, parts, mean, busy, engine, changed_list)}
    columns, command = figure["columns"], figure["command"].removeprefix("efsat ")
    yield ([figure["head"]] if "cell" in figure else []) + [column[0] for column in columns]
    rows = figure.get("rows", [""])
    for row in eval(f"({rows})", names) if isinstance(rows, str) else rows:
        row = row if isinstance(row, list | tuple) else [code(row), row]
        label, options = row[0], row[-1]

        def cells(source, texts, /, **more):
            # A row's names are kept from cell to cell. The registry is as trusted as this file.
            space = names | {"row": row, "label": label, "options": options} | vars(source) | more
            return [eval(text, space) for text in texts]

        if "cell" in figure:
            found = [names["ask"](command.format(options=options, column=column)) for _, column in columns]
            yield [label, *(cells(one, [figure["cell"]])[0] for one in found)]
            continue
        found = names["ask"](command.format(options=options))
        over = cells(found, [figure.get("over", "[found]")], found=found)[0]
        yield from (cells(found, [text for _, text in columns], **(vars(one) | {"found": found, "one": one})) for one in over)


def table(head, rows):
    """A table; columns whose head begins with < are text."""
    lines = [[cell.removeprefix("<") for cell in head], ["---" if cell.startswith("<") else "---:" for cell in head]]
    lines += [[f"{cell:,}" if isinstance(cell, int) else str(cell) for cell in row] for row in rows]
    return "\n".join(f"| {' | '.join(cells)} |" for cells in lines)


def make(figure):
    """The table: what its command prints, or rows of what its commands say in JSON."""
    command = figure["command"]
    if "columns" in figure:
        head, *rows = rows_of(figure)
        if not rows:
            raise SystemExit(f"error: {figure['name']}: expected a row at least")
        return table(head, rows)
    name, *arguments = command.split()
    if name in SPECIAL:
        return SPECIAL[name](*arguments)
    return (kept if figure["cost"] == "dear" and name == "efsat" else run)(command).strip()


# Tables that no row of commands makes.


def stored(scene):
    """The results of `efsat accuracy` that are in the repository."""
    return json.loads(Path(f"docs/accuracy/{scene}/accuracy.json").read_text())


def row_of(rows, paper=False, method="axes", width="18"):
    """The row of a design in stored results."""
    for row in rows:
        options = row["options"]
        rounded = options.get("projection-width") == "rounded" and options.get("edge-test") == "off"
        if options["width"] == width and options.get("method", "axes") == method and rounded == paper and (row["base"] or paper or method != "axes"):
            return row
    raise SystemExit(f"error: docs/accuracy: expected a row of {width} bits, {method}, {'the' if paper else 'not the'} paper's options")


def files(*devices):
    """The files and folders beside the entities of a unit, by the README of the generated design, and the devices that have them."""
    found = {}
    for device in devices:
        with tempfile.TemporaryDirectory() as folder:
            run(f"efsat generate --device {device} --out {folder}")
            listed = Path(folder, "README.md").read_text().split("## The files")[1].split("\n## ")[0]
        for name, what in re.findall(r"^\| `(\S+)` \| (.*) \|$", listed, re.MULTILINE):
            if not name.endswith(".vhd") or "constants" in name:
                what = re.sub(r", part \S+\.$", ".", what)
                found.setdefault((name, what), []).append(device)
    rows = ([code(name), what, "every" if len(of) == len(devices) else ", ".join(map(code, of))] for (name, what), of in found.items())
    return table(["<file or folder", "<what it is", "<device"], rows)


def budgets():
    """How many units fit into a part and what they do together: multipliers all used, look-up tables to four fifths, 100 MHz."""
    parts = ["xc2v6000-4", "xc7a200t-1"]
    designs = ["", *(f"--method determinants --clocks-per-pair {n}" for n in (11, 2)), "--method determinants"]
    rows = stored("headlight")["rows"]

    def row(part, design):
        found = ask(f"synth --predict --device {part} {design}", dear=False)
        cells, capacity = found.units.predicted, found.capacity
        number = min(capacity.multipliers // cells.multipliers, 4 * capacity.luts // 5 // luts(cells))
        rate = number * 100 / found.initiation_interval
        result = row_of(rows, False, "determinants" if "determinants" in design else "axes")
        undecided = result["answers"]["possibly_incorrect"] / result["answers"]["pairs"]
        time = f"{1000 / rate + undecided * result['cost_ns']:.2f}" if number else "does not fit"
        return [part, code(design), number, f"{rate:.1f}", time]

    head = ["<part", "<options", "units", "million pairs per second", "ns per pair, all decided"]
    return table(head, (row(part, design) for part in parts for design in designs))


def schedule(*options):
    """The optimum of every unit's schedule by GLPK, beside what the scheduler found."""
    if not shutil.which("glpsol"):
        raise SystemExit("error: glpsol is not installed; as root: apt-get install glpk-utils")
    run(f"efsat generate --lp {KEPT}/lp {' '.join(options)}")

    def optimum(unit, how):
        run(f"glpsol --lp {KEPT}/lp/{unit}.lp {how} --output {KEPT}/solution")
        return float(re.search(r"^Objective:.*= (\S+)", (KEPT / "solution").read_text(), re.M)[1])

    _, *units = csv.reader((KEPT / "lp/units.csv").read_text().splitlines())
    rows = [[f"`{u}`", int(n), int(bits), optimum(u, "--nomip"), optimum(u, "--tmlim 60")] for u, n, bits in units]
    sums = [sum(row[1] * row[i] for row in rows) for i in (2, 3, 4)]
    cells = [[*map(str, row[:3]), *(f"{x:.10g}" for x in row[3:])] for row in rows] + [["all", "", str(sums[0]), f"{sums[1]:.1f}", f"{sums[2]:.0f}"]]
    return table(["<unit", "instances", "register bits", "linear optimum", "whole captures"], cells)


def synthesis(part):
    """What `efsat synth` prints of the default design behind its units."""
    text = kept(f"efsat synth --device {part}")
    return f"```text\n{text[text.index(chr(10) + part + ': ') :].strip()}\n```"


COMPARED = {"headlight": "--scene headlight", "headlight, mm": "--scene headlight --units file", "bolt and nut": "--scene scenes/bolt_nut.toml",
            "bolt and nut, mm": "--scene scenes/bolt_nut.toml --units file"}


def comparison(what="answers"):
    """The paper's Table 1 and ours, or the wrong answers of every test."""
    compared = {name: options for name, options in COMPARED.items() if what == "wrong" or "mm" not in name}
    found = [ask(f"compare --like-paper {options}") for options in compared.values()]
    if what == "wrong":
        pair = lambda one: f"{one.missed:,} / {one.false:,}" if one.missed or one.false else "."
        rows = [[test.test, *(pair(one.software[i]) for one in found)] for i, test in enumerate(found[0].software)]
        rows = [row for row in rows if set(row[1:]) != {"."}]
        return table(["<missed / false", *compared], [["EFSAT, definite", *(one.wrong.efsat for one in found)], *rows])
    paper = ["70.93", "0", "0.02", "0", "0.13", "0", "0.04", "0.77", "0", "0", "0", "28.13"]
    short = {"separate": "sep.", "intersect": "int.", "possibly-incorrect": "int. (p.i.)"}
    rows = [[*(short[getattr(row, key)] for key in ("efsat", "moeller", "sat")), figure,
             *(share(one.rows[i].pairs, one.pairs, 3) if one.rows[i].pairs else "0" for one in found)]
            for i, (row, figure) in enumerate(zip(found[0].rows, paper, strict=True))]
    rows = [row for row in rows if set(row[3:]) != {"0"}]
    return table(["<EFSAT", "<Moeller", "<SAT", "paper", *compared], [*rows, ["pairs", "", "", "-", *(one.pairs for one in found)]])


def scenes():
    """The ready scenes; what one shows is how its comment begins."""
    comment = lambda text: " ".join(line.removeprefix("#").strip() for line in re.match(r"(# .*\n)+", text)[0].splitlines())
    return table(["<file", "<what it shows"], ([f"`{file.name}`", re.split(r"[.:]( |$)", comment(file.read_text()))[0]] for file in sorted(Path("scenes").glob("*.toml"))))


def engines():
    """Names and options of the engines of the table of clocks, the ready one first."""
    rows = tomllib.loads(Path("docs/figures.toml").read_text())["engine-clocks"]["rows"]
    return dict(zip(("ready", "132 multipliers", "252 multipliers"), (options for _, options in rows), strict=True))


SOFTWARE = ("this project in software", "FCL", "Coal", "Embree")


def distances():
    """Times per query from docs/engine-speed/times.csv, which scripts/engine-speed makes."""
    rows = list(csv.DictReader(Path("docs/engine-speed/times.csv").read_text().splitlines()))
    series = list(dict.fromkeys(row["series"] for row in rows))
    places = list(dict.fromkeys(row["distance"] for row in rows))
    times = {(row["distance"], row["series"]): float(row["microseconds"]) for row in rows}
    queries = {row["distance"]: row["queries"] for row in rows}

    def time(place, name):
        found = times[place, name]
        text = f"{float(f'{found:.3g}'):,.0f}" if found >= 99.5 else f"{found:.2g}" if found < 10 else f"{found:.1f}"
        return f"{text} ({times[place, SOFTWARE[0]] / found:.1f})" if name not in SOFTWARE else text

    # The default scene has the first six.
    default, first = "all of these", places[:6]
    queries[default] = sum(int(queries[place]) for place in first)
    for name in series:
        times[default, name] = sum(int(queries[place]) * times[place, name] for place in first) / queries[default]
    shown = [*first, default, *places[6:]]
    return table(["<distance", "queries", *series], ([place, queries[place], *(time(place, name) for name in series)] for place in shown))


def simulated(scene, options):
    """A simulation of queries, whose answers and counts are those of the reference model."""
    found = ask(f"cosim --engine --scene {scene} {options}")
    assert found.mismatches == 0 and found.answered_in_software == 0, found
    return found


def torus(turned):
    """A torus with bumps, 224 by 224 quadrangles: 100,352 triangles, of which no two are alike."""
    steps, points = range(224), []
    for i in steps:
        for j in steps:
            u, v = (2 * math.pi * x / 224 for x in (i, j))
            radius = 0.6 + 0.05 * math.sin(9 * u) * math.cos(7 * v)
            ring = 2 + radius * math.cos(v)
            x, y, z = ring * math.cos(u), ring * math.sin(u), radius * math.sin(v)
            points.append((x, z, y) if turned else (x, y, z))
    # Six places, so that every machine writes the same file.
    text = [f"v {x:.6f} {y:.6f} {z:.6f}" for x, y, z in points]
    for i in steps:
        for j in steps:
            p, q, r, s = (1 + a % 224 * 224 + b % 224 for a, b in ((i, j), (i + 1, j), (i + 1, j + 1), (i, j + 1)))
            text += [f"f {p} {q} {r}", f"f {p} {r} {s}"]
    return "\n".join(text) + "\n"


def tori():
    """Two large meshes, one through the hole of the other, so that they touch at one side."""
    KEPT.mkdir(parents=True, exist_ok=True)
    a, b, scene = (KEPT / name for name in ("a.obj", "b.obj", "rings.toml"))
    a.write_text(torus(False))
    b.write_text(torus(True))
    scene.write_text("name = 'rings'\na.mesh = 'a.obj'\nb.mesh = 'b.obj'\n[[pose]]\ntranslation = [0.9, 0.1, 0.05]\n")

    keys = ("expansions", "leaf_pairs", "intersect", "possibly_incorrect", "clocks")
    found = {name: simulated(scene, options) for name, options in engines().items()}
    head = ["<engine", "expansions", "leaf pairs", "intersect", "possibly incorrect", "clocks", "volume unit busy", "triangle unit busy", "bus busy"]
    return table(head, ([n, *(mean(one, key) for key in keys), *busy(one)] for n, one in found.items()))


SPECIAL = {f.__name__: f for f in (scenes, budgets, schedule, synthesis, comparison, distances, files, tori)}

