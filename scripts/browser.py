"""Checks the pages in a browser. What they show is compared with what is reckoned here from the same data."""

import csv
import json
import math
import os
import subprocess
import sys
import tempfile
from pathlib import Path

from playwright.sync_api import sync_playwright

SCENES = ["headlight", "bolt_nut", "lock_nuts"]
PICTURES = Path(sys.argv[1]) if len(sys.argv) > 1 else None
SIZES = {"wide": (1400, 1000, "light"), "dark": (1400, 1000, "dark"), "narrow": (390, 844, "light")}
passed = 0


def check(what, found, expected):
    """Counts a check, or ends with what was found."""
    global passed
    close = isinstance(found, float) and math.isclose(found, expected, rel_tol=1e-9)
    if not close and found != expected:
        raise SystemExit(f"FAILED: {what}: found {found!r}, expected {expected!r}")
    passed += 1


def true(what, holds):
    check(what, bool(holds), True)


def nanoseconds(text):
    """A time as the page writes it."""
    number, unit = text.split()
    return float(number.replace(",", "")) * {"ns": 1, "µs": 1e3, "ms": 1e6, "s": 1e9}[unit]


def alike(what, found, expected):
    """Compares with a number that the page rounds to three digits."""
    true(f"{what}: found {found}, expected about {expected}", math.isclose(found, expected, rel_tol=5.1e-3))


class Browser:
    """A window in which nothing may go wrong."""

    def __init__(self, chromium, size="wide"):
        width, height, scheme = SIZES[size]
        self.size = size
        self.context = chromium.new_context(viewport={"width": width, "height": height}, color_scheme=scheme)
        self.page = self.context.new_page()
        self.trouble = []
        self.page.on("console", lambda message: self.trouble.append(message.text))
        self.page.on("pageerror", lambda error: self.trouble.append(str(error)))
        self.page.on("request", lambda request: None if request.url.startswith(("file:", "data:", "blob:"))
                     else self.trouble.append(request.url))

    def open(self, path):
        self.page.goto(Path(path).resolve().as_uri())
        self.page.wait_for_timeout(500)

    def picture(self, name, full=True):
        self.page.wait_for_timeout(300)
        if PICTURES:
            PICTURES.mkdir(parents=True, exist_ok=True)
            self.page.screenshot(path=PICTURES / f"{name}-{self.size}.png", full_page=full)

    def close(self):
        check("console and network", self.trouble, [])
        true("nothing is wider than the window",
             self.page.evaluate("document.documentElement.scrollWidth <= innerWidth"))
        self.context.close()

    def slide(self, name, place):
        self.page.locator(f"#{name}").evaluate(
            "(slider, to) => { slider.value = to; slider.dispatchEvent(new Event('input')); }", str(place))

    def rows(self, table):
        return self.page.eval_on_selector_all(
            f"#{table} tbody tr", "rows => rows.map(row => [...row.cells].map(cell => cell.textContent))")

    def text(self, selector):
        return self.page.locator(selector).inner_text()


def frontier(campaign, clock=math.inf, transfer=0.0, retest=1.0, multipliers=math.inf, fits=True, part="xc2v6000-4"):
    """What the page should show: [bits, clocks, multipliers, ns, share] of what nothing beats, by time."""
    points = []
    for row in campaign["rows"]:
        options, hardware, cells = row["options"], row["hardware"], row["hardware"]["cells"]
        if (options["device"] != part or options["transform"] != "on" or cells["multipliers"] > multipliers
                or fits and not hardware["fits"]):
            continue
        share, cost = row["possibly_incorrect"]["share"], retest * row["cost_ns"] + transfer
        ns = 1000 * hardware["interval"] / min(clock, hardware["clock"]) + share * cost
        points.append((ns, share, cells["multipliers"], int(options["width"]), hardware["interval"]))
    best, least = [], math.inf
    for ns, share, found, bits, clocks in sorted(points):
        if share < least:
            least = share
            best.append([bits, clocks, found, ns, share])
    return best


def shows(browser, what, expected):
    """The table of the frontier against one that was reckoned here."""
    rows = browser.rows("front")
    check(f"{what}: points of the frontier", len(rows), len(expected))
    for row, (bits, clocks, multipliers, ns, share) in zip(rows, expected):
        check(f"{what}: bits, clocks, multipliers", [int(cell.replace(",", "")) for cell in row[2:5]],
              [bits, clocks, multipliers])
        alike(f"{what}: time", nanoseconds(row[5]), ns)
        alike(f"{what}: undecided", float(row[6].split()[0]) / 100, share)
    if len(expected) > 1:
        words = browser.text("#answer")
        factor = float(words.split(" times as long")[0].split()[-1].replace(",", ""))
        alike(f"{what}: factor in the conclusion", factor, expected[-1][3] / expected[0][3])


def accuracy(chromium):
    page = "docs/accuracy/index.html"
    campaigns = [json.loads(Path(f"docs/accuracy/{scene}/accuracy.json").read_text()) for scene in SCENES]
    headlight = campaigns[0]
    browser = Browser(chromium)
    browser.open(page)
    check("scenes", browser.page.locator("#scene option").count(), len(campaigns))
    check("points in the table", len(browser.rows("points")), len(headlight["rows"]))
    check("plots", browser.page.locator(".plot canvas").count(), 4)
    shows(browser, "as opened", frontier(headlight))
    # Each control, alone and together.
    browser.slide("clock", 50)
    shows(browser, "clock at most 50 MHz", frontier(headlight, clock=50))
    check("the clock shown", browser.text("#clock-value"), "50 MHz")
    browser.slide("clock", 200)
    browser.slide("transfer", 30)
    shows(browser, "10 µs of transfer", frontier(headlight, transfer=1e4))
    browser.slide("retest", 30)
    shows(browser, "and retests ten times as long", frontier(headlight, transfer=1e4, retest=10))
    browser.slide("multipliers", 23)
    budget = round(8 * 2 ** (23 / 7.5))
    check("the budget shown", browser.text("#multipliers-value"), f"at most {budget}")
    shows(browser, "and few multipliers", frontier(headlight, transfer=1e4, retest=10, multipliers=budget))
    true("points that are left out are grey",
         browser.page.locator("#points tr.out").count() > browser.page.locator("#points tbody tr:not(.out)").count())
    address = browser.page.url
    browser.page.click("#reset")
    shows(browser, "reset", frontier(headlight))
    browser.page.uncheck("#fits")
    shows(browser, "units that do not fit, too", frontier(headlight, fits=False))
    browser.page.check("#fits")
    browser.page.select_option("#part", "xc7a200t-1")
    shows(browser, "another part", frontier(headlight, part="xc7a200t-1"))
    browser.page.select_option("#part", "xc2v6000-4")
    for i, campaign in enumerate(campaigns):
        browser.page.select_option("#scene", str(i))
        shows(browser, f"scene {i}", frontier(campaign))
        check("sections of the scene", browser.page.locator("section[data-scene]:visible").count(), 1)
        true("its sentences", campaign["headline"][1] in browser.text(f"section[data-scene='{i}']"))
    browser.page.select_option("#scene", "0")
    # Pointing: the same point in plots, table and description.
    browser.page.locator("#points tbody tr").nth(3).hover()
    check("rings of what the pointer is on", browser.page.locator(".ring:not(.pinned):visible").count(), 4)
    name = browser.text("#point h3")
    browser.page.locator("#points tbody tr").nth(3).click()
    browser.page.mouse.move(0, 0)
    check("rings of what was clicked", browser.page.locator(".ring.pinned:visible").count(), 4)
    check("what was clicked stays described", browser.text("#point h3"), name)
    ring = browser.page.locator("#by-bits .ring.pinned").bounding_box()
    browser.page.locator("#points tbody tr").nth(3).click()
    browser.page.mouse.move(ring["x"] + ring["width"] / 2, ring["y"] + ring["height"] / 2)
    check("pointing at the mark in a plot describes it", browser.text("#point h3"), name)
    check("and marks its row", browser.page.locator("#points tr.on").count(), 1)
    # Sorting.
    browser.page.locator("#points thead button", has_text="multipliers").click()
    shown = [int(row[8].replace(",", "")) for row in browser.rows("points")]
    visible = shown[:browser.page.locator("#points tbody tr:not(.out)").count()]
    check("sorted by multipliers", visible, sorted(visible))
    # An address brings settings back.
    browser.page.goto("about:blank")
    browser.page.goto(address)
    browser.page.wait_for_timeout(300)
    shows(browser, "settings of an address", frontier(headlight, transfer=1e4, retest=10, multipliers=budget))
    browser.close()
    # Wide, dark and narrow.
    for size in SIZES:
        browser = Browser(chromium, size)
        browser.open(page)
        browser.picture("accuracy")
        browser.close()


def colours(browser):
    """How many different pixels the view of the scene has, and their digest."""
    return browser.page.evaluate("""() => {
        const view = document.querySelector('#view canvas');
        const copy = document.createElement('canvas');
        [copy.width, copy.height] = [view.width, view.height];
        const context = copy.getContext('2d');
        context.drawImage(view, 0, 0);
        const pixels = new Uint32Array(context.getImageData(0, 0, copy.width, copy.height).data.buffer);
        let digest = 0;
        const seen = new Set();
        pixels.forEach((pixel) => { seen.add(pixel); digest = (Math.imul(digest, 31) + pixel) | 0; });
        return [seen.size, digest];
    }""")


# What the legend says of a pair, by its verdict and by whether it is separate.
KINDS = {
    ("intersect", False): "intersect",
    ("possibly incorrect", False): "possibly incorrect, touching",
    ("possibly incorrect", True): "possibly incorrect, separate",
    ("not asked", False): "degenerate, touching",
}


def scene(chromium, name, options):
    """The viewer of a scene run against what the run says of the same pairs."""
    with tempfile.TemporaryDirectory() as folder:
        page, table = Path(folder) / "view.html", Path(folder) / "pairs.csv"
        command = [os.environ["EFSAT"], "scene", "run", f"scenes/{name}.toml", *options, "--cosim", "none", "--json",
                   "--view", page, "--pairs", table]
        run = json.loads(subprocess.run(command, check=True, stdout=subprocess.PIPE).stdout)
        pairs = list(csv.DictReader(table.open()))
        browser = Browser(chromium)
        browser.open(page)
        open_pairs = {frame["frame"]: frame["possibly_incorrect"] + frame["intersect"] for frame in run["frames"]}
        shown = [frame["frame"] for frame in run["frames"]
                 if open_pairs[frame["frame"]] + sum(int(pair["frame"]) == frame["frame"] for pair in pairs) > 0]
        check(f"{name}: poses", int(browser.page.get_attribute("#step", "max")) + 1, len(shown))
        for place, number in enumerate(shown[:3]):
            browser.slide("step", place)
            true(f"{name}: pose {number}", browser.text("#frame").startswith(f"pose {number}:"))
            rows = browser.rows("pairs")
            touching = sorted(
                (f"{pair['a']} {pair['triangle_a']}", f"{pair['b']} {pair['triangle_b']}", pair["exact"])
                for pair in pairs if int(pair["frame"]) == number and pair["exact"] != "separate")
            check(f"{name}: pairs that touch in pose {number}",
                  sorted((row[0].removeprefix("■ "), row[1], row[3]) for row in rows if row[3] != "separate"), touching)
        # The legend has a row for each kind of pair that is in some pose, and none for another.
        kinds = set()
        for place in range(len(shown)):
            browser.slide("step", place)
            kinds |= {KINDS[row[2], row[3] == "separate"] for row in browser.rows("pairs")}
        legend = browser.page.locator("#legend span").all_inner_texts()
        check(f"{name}: kinds of pairs in the legend", {row.strip() for row in legend} & set(KINDS.values()), kinds)
        # Something is drawn, and turning, stepping and picking change it.
        browser.slide("step", 0)
        browser.page.wait_for_timeout(300)
        many, before = colours(browser)
        true(f"{name}: the scene is drawn, in {many} colours", many > 20)
        browser.page.locator("#pairs tbody tr").first.click()
        browser.page.wait_for_timeout(300)
        picked = colours(browser)[1]
        true(f"{name}: a pair that is picked is drawn otherwise", picked != before)
        check(f"{name}: its row is marked", browser.page.locator("#pairs tr.on").count(), 1)
        first = browser.rows("pairs")[0]
        told = browser.text("#pair dl")
        true(f"{name}: its verdict and exact answer are told: {told}", first[2] in told and first[3] in told)
        signs = browser.page.locator("#pair table tbody tr").count()
        true(f"{name}: so is what every axis or determinant says: {signs}", signs in ([15] if "determinants" in options else [12, 18]))
        view = browser.page.locator("#view canvas").bounding_box()
        middle = [view["x"] + view["width"] / 2, view["y"] + view["height"] / 2]
        browser.page.mouse.move(*middle)
        browser.page.mouse.down()
        browser.page.mouse.move(middle[0] + 120, middle[1] + 60, steps=4)
        browser.page.mouse.up()
        browser.page.wait_for_timeout(300)
        true(f"{name}: dragging turns the scene", colours(browser)[1] != picked)
        # Clicking a triangle in the view: somewhere along its lines there are some.
        browser.page.click("#near")
        browser.page.locator("#view").hover()
        browser.page.wait_for_timeout(300)
        browser.slide("step", 0)
        check(f"{name}: nothing is picked in a new pose", browser.page.locator("#pairs tr.on").count(), 0)
        found = 0
        for x in range(1, 20):
            for y in range(1, 20):
                browser.page.mouse.click(view["x"] + view["width"] * x / 20, view["y"] + view["height"] * y / 20)
                found = browser.page.locator("#pairs tr.on").count()
                if found:
                    break
            if found:
                break
        check(f"{name}: clicking a triangle picks its pair", found, 1)
        browser.page.keyboard.press("ArrowRight")
        if len(shown) > 1:
            true(f"{name}: an arrow key steps", browser.text("#frame").startswith(f"pose {shown[1]}:"))
        browser.close()
        for size in SIZES:
            browser = Browser(chromium, size)
            browser.open(page)
            browser.picture(f"scene-{name}", full=False)
            browser.close()


with sync_playwright() as playwright:
    # As root Chromium has no sandbox; it opens only files of this project. Pictures are computed without a graphics card.
    switches = ["--no-sandbox", "--use-gl=angle", "--use-angle=swiftshader", "--enable-unsafe-swiftshader"]
    chromium = playwright.chromium.launch(executable_path=os.environ["CHROMIUM"], args=switches)
    accuracy(chromium)
    scene(chromium, "gears", [])
    scene(chromium, "plates", ["--method", "determinants"])
    chromium.close()
print(f"{passed} passed, 0 failed")
