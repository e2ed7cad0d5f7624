// The accuracy page: reckons what every point costs with the settings of the controls, and shows it as plots and tables
// that point at each other. What was counted and timed comes from `data`; docs/accuracy.md defines the effective time.
"use strict";
(function () {
  const data = JSON.parse(document.getElementById("data").textContent);
  const $ = (id) => document.getElementById(id);
  const element = (tag, attributes, ...children) => {
    const made = document.createElement(tag);
    Object.entries(attributes).forEach(([name, value]) => made.setAttribute(name, value));
    made.append(...children);
    return made;
  };

  // Numbers as people write them.
  const significant = (x) => (x >= 1000 ? Math.round(x).toLocaleString("en") : String(Number(x.toPrecision(3))));
  const percent = (share) => (share === 0 ? "0" : significant(100 * share) + " %");
  const time = (ns) => {
    const [unit, scale] = [["s", 1e9], ["ms", 1e6], ["µs", 1e3]].find(([, scale]) => ns >= scale) || ["ns", 1];
    return significant(ns / scale) + " " + unit;
  };
  const whole = (n) => n.toLocaleString("en");
  const clocks = (n) => n + (n === 1 ? " clock" : " clocks");

  // The kinds of points: name, colour, mark. The last one is no hardware.
  const KINDS = [
    { name: "separating axes", colour: "--axes", mark: "circle" },
    { name: "separating axes, the paper’s roundings", colour: "--paper-axes", mark: "square" },
    { name: "determinants", colour: "--determinants", mark: "diamond" },
    { name: "software, one core", colour: "--software", mark: "hollow" },
  ];
  const SOFTWARE = 3;

  // What can be set. `read` makes a value of a slider's place.
  const CLOCK = 200;
  const MULTIPLIERS = 60;
  const settings = {
    clock: { at: CLOCK, most: CLOCK, read: (at) => (at >= CLOCK ? Infinity : at), show: (v) => (v === Infinity ? "each its own" : v + " MHz") },
    transfer: { at: 0, most: 50, read: (at) => (at === 0 ? 0 : 10 ** (1 + at / 10)), show: (v) => (v === 0 ? "0" : time(v)) },
    retest: { at: 20, most: 40, read: (at) => 10 ** ((at - 20) / 10), show: (v) => "× " + significant(v) },
    multipliers: { at: MULTIPLIERS, most: MULTIPLIERS, read: (at) => (at >= MULTIPLIERS ? Infinity : Math.round(8 * 2 ** (at / 7.5))), show: (v) => (v === Infinity ? "any number" : "at most " + whole(v)) },
  };
  const value = (name) => settings[name].read(Number($(name).value));

  let scene = data.scenes[0];
  let front = [];
  let hovered = null;
  let pinned = null;

  // Everything that follows from the controls.
  function reckon() {
    const [limit, transfer, retest, budget] = ["clock", "transfer", "retest", "multipliers"].map(value);
    const part = $("part").value;
    for (const point of scene.points) {
      point.at = Math.min(point.clock, limit);
      point.hardware = (1000 * point.clocks) / point.at;
      point.cost = retest * point.retest + transfer;
      point.ns = point.hardware + point.share * point.cost;
      // A unit without the transform leaves work to the host that is not counted.
      point.shown = point.device === part && point.whole && point.multipliers <= budget && (point.fits || !$("fits").checked);
    }
    scene.software.forEach((test) => (test.ns = retest * test.measured));
    front = pareto(scene.points.filter((point) => point.shown));
  }

  // The points that no other one beats in both time and share, by time.
  function pareto(points) {
    const sorted = [...points].sort((a, b) => a.ns - b.ns || a.share - b.share || a.multipliers - b.multipliers);
    let least = Infinity;
    return sorted.filter((point) => point.share < least && ((least = point.share), true));
  }

  // Plots.

  const PLOTS = [
    { id: "frontier", x: (p) => p.ns, xlog: true, xunit: time, xlabel: "effective time per pair (log scale)", software: true, front: true, height: [430, 360] },
    { id: "by-bits", x: (p) => p.bits, xlabel: "working width, bits", lines: true, height: [270, 270] },
    { id: "time-by-bits", x: (p) => p.bits, y: (p) => p.ns, yunit: time, xlabel: "working width, bits", lines: true, height: [270, 270] },
    { id: "by-multipliers", x: (p) => p.multipliers, xlog: true, xunit: whole, xlabel: "multipliers (log scale)", height: [270, 270] },
  ];
  const colour = (name) => getComputedStyle(document.documentElement).getPropertyValue(name).trim();
  const FONT = "12px system-ui, -apple-system, 'Segoe UI', Roboto, Arial, sans-serif";

  // Round numbers on a logarithmic scale, not more than `room`.
  function decades(low, high, room) {
    const steps = [[1, 1.5, 2, 3, 4, 5, 7], [1, 2, 5], [1, 3], [1]];
    const make = (choice, stride) => {
      const found = [];
      for (let power = Math.floor(Math.log10(low)); power <= Math.ceil(Math.log10(high)); power += 1) {
        if (power % stride === 0) {
          found.push(...choice.map((step) => Number((step * 10 ** power).toPrecision(3))));
        }
      }
      return found.filter((x) => x >= low && x <= high);
    };
    const tries = [...steps.map((choice) => make(choice, 1)), make([1], 2), make([1], 3)];
    return tries.find((ticks) => ticks.length <= room) || tries[tries.length - 1];
  }

  // What a plot shows. A test in software that takes much longer than every unit would squeeze all others together.
  function items(plot) {
    const points = scene.points.filter((point) => point.shown);
    const slowest = Math.max(...points.map((point) => point.ns));
    return plot.software ? [...points, ...scene.software.filter((test) => points.length === 0 || test.ns < 5 * slowest)] : points;
  }

  // The columns of a plot: x, then for each kind its line and its points, then the front.
  function columns(plot) {
    const share = plot.y === undefined;
    plot.items = items(plot).sort((a, b) => plot.x(a) - plot.x(b));
    const positive = plot.items.map((item) => item.share).filter((y) => y > 0);
    // A share of nothing has no place on a logarithmic scale: it gets one below all others.
    plot.nothing = share ? Math.min(...positive, 0.001) / 4 : 0;
    plot.height_of = plot.y || ((item) => (item.share > 0 ? item.share : plot.nothing));
    const only = (keep) => plot.items.map((item) => (keep(item) ? plot.height_of(item) : null));
    const found = [plot.items.map(plot.x)];
    KINDS.forEach((_, kind) => {
      found.push(only((item) => plot.lines && item.kind === kind && item.line));
      found.push(only((item) => item.kind === kind));
    });
    found.push(only((item) => plot.front && front.includes(item)));
    return found;
  }

  const padded = (numbers, log, by) => {
    const [low, high] = [Math.min(...numbers), Math.max(...numbers)];
    if (numbers.length === 0) {
      return [1, 10];
    }
    if (!log) {
      return [low - 1, high + 1];
    }
    const room = (high / low) ** by * 1.12;
    return [low / room, high * room];
  };

  // The outline of a mark as uPlot draws it, `size` being in pixels of the canvas.
  function outline(path, mark, x, y, size) {
    const r = size / 2;
    if (mark === "circle") {
      path.moveTo(x + r, y);
      path.arc(x, y, r, 0, 2 * Math.PI);
    } else if (mark === "diamond") {
      path.moveTo(x, y - 1.3 * r);
      path.lineTo(x + 1.3 * r, y);
      path.lineTo(x, y + 1.3 * r);
      path.lineTo(x - 1.3 * r, y);
      path.closePath();
    } else {
      path.rect(x - 0.9 * r, y - 0.9 * r, 1.8 * r, 1.8 * r);
    }
  }

  const marks = (mark) => (u, series, from, to) => {
    const path = new Path2D();
    const [xs, ys] = [u.data[0], u.data[series]];
    for (let i = from; i <= to; i += 1) {
      if (ys[i] !== null) {
        outline(path, mark, u.valToPos(xs[i], "x", true), u.valToPos(ys[i], "y", true), 8 * uPlot.pxRatio);
      }
    }
    return { fill: path, stroke: path, clip: null, flags: 3 };
  };

  function make(plot) {
    const box = $(plot.id);
    box.replaceChildren();
    const narrow = box.clientWidth < 560;
    const [ink, soft, grid, paper] = ["--ink", "--soft", "--grid", "--paper"].map(colour);
    const series = [{}];
    KINDS.forEach((kind) => {
      const paint = colour(kind.colour);
      series.push({ stroke: paint, width: 1.6, spanGaps: true, points: { show: false } });
      const fill = kind.mark === "hollow" ? paper : paint;
      const stroke = kind.mark === "hollow" ? paint : paper;
      series.push({ paths: () => null, points: { show: true, size: 8, width: kind.mark === "hollow" ? 1.8 : 0.6, fill, stroke, paths: marks(kind.mark) } });
    });
    series.push({ stroke: ink, width: 2, spanGaps: true, paths: uPlot.paths.stepped({ align: 1 }), points: { show: false } });
    const share = plot.y === undefined;
    const axis = { stroke: soft, font: FONT, labelFont: FONT, grid: { stroke: grid, width: 1 }, ticks: { show: false }, filter: (_, ticks) => ticks };
    const yunit = share ? (v) => (v === plot.nothing ? "none" : percent(v)) : plot.yunit;
    const yticks = (u, _, low, high) => {
      const ticks = decades(share ? Math.max(low, 2 * plot.nothing) : low, high, u.height / 38);
      return share && plot.items.some((item) => item.share === 0) ? [plot.nothing, ...ticks] : ticks;
    };
    const options = {
      width: box.clientWidth,
      height: plot.height[narrow ? 1 : 0],
      legend: { show: false },
      cursor: { x: false, y: false, points: { show: false }, drag: { x: false, y: false } },
      scales: {
        x: { time: false, distr: plot.xlog ? 3 : 1, range: () => padded(plot.items.map(plot.x), plot.xlog, plot.front ? 0.05 : 0.04) },
        y: { distr: 3, range: () => padded(plot.items.map(plot.height_of), true, 0.04) },
      },
      axes: [
        { ...axis, label: plot.xlabel, labelSize: 22, size: 32, ...(!plot.xlog && { incrs: [1, 2, 5, 10] }), ...(plot.xlog && { splits: (u, _, low, high) => decades(low, high, u.width / 75) }), values: (_, ticks) => ticks.map(plot.xunit || String) },
        { ...axis, size: 62, splits: yticks, values: (_, ticks) => ticks.map(yunit) },
      ],
      series,
      hooks: {
        draw: [(u) => plot.front && label(u, plot, narrow)],
        setCursor: [(u) => hover(nearest(u, plot))],
      },
    };
    plot.u = new uPlot(options, columns(plot), box);
    plot.rings = ["", " pinned"].map((name) => element("div", { class: "ring" + name }));
    plot.u.over.append(...plot.rings);
    plot.u.over.addEventListener("click", () => pin(nearest(plot.u, plot)));
    plot.u.over.addEventListener("mouseleave", () => hover(null));
  }

  function nearest(u, plot) {
    const { left, top } = u.cursor;
    let [best, least] = [null, 22];
    if (left >= 0) {
      for (const item of plot.items) {
        const away = Math.hypot(u.valToPos(plot.x(item), "x") - left, u.valToPos(plot.height_of(item), "y") - top);
        if (away < least) {
          [best, least] = [item, away];
        }
      }
    }
    return best;
  }

  const named = (p) => `${p.method} ${p.bits} bits · ${clocks(p.clocks)} · ${whole(p.multipliers)} mult.`;

  // The knee of the front: what lies deepest below the line between its ends, both axes logarithmic.
  function knee() {
    const positive = front.map((p) => p.share).filter((share) => share > 0);
    const place = (p) => [Math.log(p.ns), Math.log(p.share || Math.min(...positive) / 4)];
    const [[x, y], [toX, toY]] = [place(front[0]), place(front.at(-1))];
    const depth = (p) => y + ((toY - y) * (place(p)[0] - x)) / (toX - x) - place(p)[1];
    const deepest = front.slice(1, -1).reduce((best, p) => (best && depth(best) >= depth(p) ? best : p), null);
    return deepest && depth(deepest) > 0 ? deepest : null;
  }

  // What accuracy costs, in sentences.
  function answer() {
    const [fast, sure] = [front[0], front.at(-1)];
    const what = (p) => `${time(p.ns)} per pair with ${percent(p.share)} undecided`;
    const words = !fast ? ["No unit fits these settings."]
      : fast === sure ? [`The fastest unit is also the most accurate: ${what(fast)}.`]
        : [`The most accurate unit takes ${significant(sure.ns / fast.ns)} times as long as the fastest: ${what(sure)} instead of ${what(fast)}.`];
    const between = fast === sure ? null : knee();
    if (between) {
      words.push(`The knee between them is ${named(between)}: ${what(between)}.`);
    }
    const exact = scene.software.filter((test) => test.exact).sort((a, b) => a.ns - b.ns)[0];
    if (exact && (!fast || exact.ns <= fast.ns)) {
      words.push(`Software beats every unit: ${exact.name} takes ${time(exact.ns)} on one core and leaves nothing undecided.`);
    }
    $("answer").textContent = words.join(" ");
  }

  // Names beside the points of the front, or their numbers in the table where there is no room for names; names of tests
  // in software. A name that has no free place is left out: the table has it.
  function label(u, plot, narrow) {
    const { ctx } = u;
    const k = uPlot.pxRatio;
    const place = (item) => [u.valToPos(plot.x(item), "x", true), u.valToPos(plot.height_of(item), "y", true)];
    const taken = plot.items.map(place).map(([x, y]) => [x - 5 * k, y - 5 * k, x + 5 * k, y + 5 * k]);
    front.slice(1).forEach((point, i) => {
      const [[x, y], [end]] = [place(front[i]), place(point)];
      taken.push([x, y - 2 * k, end, y + 2 * k]);
    });
    const hits = (a) => taken.some((b) => a[0] - 4 * k < b[2] && b[0] < a[2] + 4 * k && a[1] < b[3] && b[1] < a[3]);
    ctx.save();
    ctx.textBaseline = "middle";
    ctx.textAlign = "left";
    const write = (item, text, weight, paint) => {
      ctx.font = `${weight} ${12 * k}px system-ui, -apple-system, 'Segoe UI', Roboto, Arial, sans-serif`;
      const [x, y] = place(item);
      const [width, height, gap] = [ctx.measureText(text).width, 15 * k, 9 * k];
      const corners = [];
      for (const down of [0, -14, 14, -28, 28, -42, 42, -56, 56, -70, 70, -84, 84]) {
        corners.push([x + gap, y + down * k - height / 2], [x - gap - width, y + down * k - height / 2]);
      }
      corners.push([x - width / 2, y - 24 * k], [x - width / 2, y + 9 * k]);
      const { left, top, width: wide, height: high } = u.bbox;
      const fits = ([l, t]) => l >= left && t >= top && l + width <= left + wide && t + height <= top + high && !hits([l, t, l + width, t + height]);
      const corner = corners.find(fits);
      if (!corner) {
        return false;
      }
      const [l, t] = corner;
      taken.push([l, t, l + width, t + height]);
      if (Math.abs(t + height / 2 - y) > 16 * k) {
        ctx.strokeStyle = colour("--soft");
        ctx.lineWidth = k;
        ctx.beginPath();
        ctx.moveTo(x, y);
        ctx.lineTo(l > x ? l - 2 * k : l + width + 2 * k, t + height / 2);
        ctx.stroke();
      }
      ctx.lineWidth = 3 * k;
      ctx.lineJoin = "round";
      ctx.strokeStyle = colour("--paper");
      ctx.strokeText(text, l, t + height / 2);
      ctx.fillStyle = paint;
      ctx.fillText(text, l, t + height / 2);
      return true;
    };
    // The ends come first: they are what most readers look for.
    const order = [...front].sort((a, b) => (b === front[0] || b === front.at(-1)) - (a === front[0] || a === front.at(-1)));
    order.forEach((point) => {
      const number = String(front.indexOf(point) + 1);
      const wrote = !narrow && write(point, `${number}: ${named(point)}`, 600, colour("--ink"));
      return wrote || write(point, number, 600, colour("--ink"));
    });
    if (!narrow) {
      plot.items.filter((item) => item.kind === SOFTWARE).forEach((test) => write(test, test.name, 400, colour("--soft")));
    }
    ctx.restore();
  }

  // Pointing.

  function rings() {
    for (const plot of PLOTS) {
      [hovered, pinned].forEach((item, i) => {
        const there = item && plot.items.includes(item);
        const ring = plot.rings[i];
        ring.style.display = there ? "block" : "none";
        if (there) {
          ring.style.left = plot.u.valToPos(plot.x(item), "x") + "px";
          ring.style.top = plot.u.valToPos(plot.height_of(item), "y") + "px";
        }
      });
    }
    for (const row of document.querySelectorAll("#front tbody tr, #points tbody tr")) {
      row.classList.toggle("on", row.item === hovered || row.item === pinned);
      row.classList.toggle("pinned", row.item === pinned);
    }
    for (const tile of document.querySelectorAll(".tiles button")) {
      tile.setAttribute("aria-pressed", tile.item === pinned);
    }
  }

  function hover(item) {
    if (item !== hovered) {
      hovered = item;
      rings();
      describe();
    }
  }

  function pin(item) {
    pinned = item === pinned ? null : item;
    rings();
    describe();
  }

  function describe() {
    const item = hovered || pinned || front[0];
    const box = $("point");
    if (!item) {
      box.replaceChildren(element("p", { class: "soft" }, "No unit fits these settings."));
      return;
    }
    const facts = element("dl", {});
    const fact = (name, text) => facts.append(element("dt", {}, name), element("dd", {}, text));
    fact("effective time", time(item.ns));
    if (item.kind === SOFTWARE) {
      fact("without a right answer", percent(item.share));
      box.replaceChildren(element("h3", {}, item.name), element("p", { class: "soft" }, item.about), facts);
      return;
    }
    fact("hardware", `${time(item.hardware)}: ${clocks(item.clocks)} at ${significant(item.at)} MHz`);
    fact("undecided pairs", `${time(item.share * item.cost)}: ${percent(item.share)} of ${time(item.cost)}`);
    fact("95 % bounds", `${percent(item.low)} to ${percent(item.high)}`);
    fact("wrong answers", whole(item.wrong));
    fact("multipliers", whole(item.multipliers));
    fact("LUTs, flip-flops", `${whole(item.luts)}, ${whole(item.flip_flops)}`);
    fact("latency", clocks(item.latency));
    fact("fits " + item.device, item.fits ? "yes" : "no");
    const command = element("code", {}, ("efsat generate " + item.options).trim());
    box.replaceChildren(element("h3", {}, named(item)), facts, command);
  }

  // A row of a table that is the same point as in the plots.
  function row(item, cells) {
    const made = element("tr", { tabindex: "0" }, ...cells.map(([text, words]) => element("td", words ? { class: "words" } : {}, text)));
    made.item = item;
    made.addEventListener("mouseenter", () => hover(item));
    made.addEventListener("mouseleave", () => hover(null));
    made.addEventListener("focus", () => hover(item));
    made.addEventListener("click", () => pin(item));
    made.addEventListener("keydown", (event) => event.key === "Enter" && pin(item));
    return made;
  }

  const COLUMNS = [
    ["method", "", (p) => p.method, String, true],
    ["bits", "", (p) => p.bits, String],
    ["undecided", "", (p) => p.share, percent],
    ["wrong", "", (p) => p.wrong, whole],
    ["time", "effective", (p) => p.ns, time],
    ["interval", "clocks", (p) => p.clocks, whole],
    ["clock", "MHz", (p) => p.at, significant],
    ["latency", "clocks", (p) => p.latency, whole],
    ["multipliers", "", (p) => p.multipliers, whole],
    ["LUTs", "", (p) => p.luts, whole],
    ["flip-flops", "", (p) => p.flip_flops, whole],
    ["part", "", (p) => p.device + (p.fits ? "" : " (does not fit)"), String, true],
    ["options of efsat generate", "", (p) => p.options, String, true],
  ];
  let order = { column: 4, up: true };

  function table() {
    const key = COLUMNS[order.column][2];
    const compare = (a, b) => (key(a) < key(b) ? -1 : key(a) > key(b) ? 1 : 0) * (order.up ? 1 : -1);
    const rows = [...scene.points].sort((a, b) => b.shown - a.shown || compare(a, b)).map((point) => {
      const made = row(point, COLUMNS.map(([, , of, show, words]) => [show(of(point)), words]));
      made.classList.toggle("out", !point.shown);
      return made;
    });
    $("points").tBodies[0].replaceChildren(...rows);
    [...$("points").tHead.rows[0].cells].forEach((head, i) => {
      if (i === order.column) {
        head.setAttribute("aria-sort", order.up ? "ascending" : "descending");
      } else {
        head.removeAttribute("aria-sort");
      }
    });
    $("front").tBodies[0].replaceChildren(...front.map((p, i) => row(p, [[String(i + 1)], [p.method, true], [String(p.bits)], [String(p.clocks)], [whole(p.multipliers)], [time(p.ns)], [percent(p.share)]])));
  }

  function tiles() {
    const shown = scene.points.filter((point) => point.shown);
    const by = (key) => [...shown].sort((a, b) => key(a) - key(b) || a.ns - b.ns || a.multipliers - b.multipliers)[0];
    const exact = scene.software.filter((test) => test.exact).sort((a, b) => a.ns - b.ns)[0];
    const tile = (name, item, number) => {
      const about = item && item.kind === SOFTWARE ? `${item.name}, one core` : item ? named(item) : "no unit fits these settings";
      const rest = item && item.kind === SOFTWARE ? (item.share === 0 ? "nothing undecided or wrong" : `${percent(item.share)} changed by rounding its input`) : item ? `${time(item.ns)} per pair, ${percent(item.share)} undecided, ${item.wrong} wrong` : "";
      const made = element("button", { type: "button" }, element("span", { class: "what" }, name), element("b", {}, item ? number(item) : "none"), element("span", {}, about), element("span", {}, rest));
      made.item = item;
      made.addEventListener("click", () => item && pin(item));
      return made;
    };
    $("tiles").replaceChildren(
      tile("Fastest unit", front[0], (p) => time(p.ns)),
      tile("Fewest undecided pairs", front[front.length - 1], (p) => percent(p.share)),
      tile("Fewest multipliers", by((p) => p.multipliers), (p) => whole(p.multipliers)),
      tile("Exact in software alone", exact, (p) => time(p.ns)),
    );
  }

  function legend() {
    const svg = (kind) => {
      const shapes = { circle: '<circle cx="7" cy="7" r="4.5"/>', diamond: '<path d="M7 1l6 6l-6 6l-6-6z"/>', square: '<rect x="2.5" y="2.5" width="9" height="9"/>', hollow: '<rect x="3" y="3" width="8" height="8" fill="none" stroke="currentColor" stroke-width="2"/>' };
      return `<svg viewBox="0 0 14 14" fill="currentColor" style="color:var(${kind.colour})" aria-hidden="true">${shapes[kind.mark]}</svg>`;
    };
    const there = KINDS.filter((_, kind) => PLOTS[0].items.some((item) => item.kind === kind));
    $("legend").innerHTML = there.map((kind) => `<span>${svg(kind)}${kind.name}</span>`).join("") +
      '<span><svg viewBox="0 0 14 14" aria-hidden="true"><path d="M0 7h14" stroke="currentColor" stroke-width="2.4"/></svg>frontier: no unit is both faster and leaves fewer pairs undecided</span>';
  }

  // What is set, in the address, so that it can be passed on.
  function remember() {
    const set = new URLSearchParams();
    const note = (name, value, usual) => String(value) !== String(usual) && set.set(name, value);
    note("scene", $("scene").value, 0);
    note("part", $("part").value, scene.device);
    Object.entries(settings).forEach(([name, setting]) => note(name, $(name).value, setting.at));
    note("fits", $("fits").checked, true);
    history.replaceState(null, "", set.size > 0 ? "#" + set : location.pathname);
  }

  function recall() {
    const set = new URLSearchParams(location.hash.slice(1));
    $("scene").value = data.scenes[Number(set.get("scene"))] ? Number(set.get("scene")) : 0;
    enter();
    const part = [...$("part").options].find((option) => option.value === set.get("part"));
    $("part").value = part ? part.value : scene.device;
    Object.entries(settings).forEach(([name, setting]) => ($(name).value = set.get(name) || setting.at));
    $("fits").checked = set.get("fits") !== "false";
  }

  // Takes up a scene: its parts of the page, its devices.
  function enter() {
    scene = data.scenes[Number($("scene").value)];
    [hovered, pinned] = [null, null];
    const parts = [...new Set(scene.points.map((point) => point.device))];
    const before = $("part").value;
    $("part").replaceChildren(...parts.map((part) => element("option", { value: part }, part)));
    $("part").value = parts.includes(before) ? before : scene.device;
    for (const section of document.querySelectorAll("[data-scene]")) {
      section.hidden = section.dataset.scene !== $("scene").value;
    }
  }

  function update() {
    reckon();
    Object.entries(settings).forEach(([name, setting]) => ($(name + "-value").textContent = setting.show(value(name))));
    if (pinned && pinned.kind !== SOFTWARE && !pinned.shown) {
      pinned = null;
    }
    PLOTS.forEach((plot) => plot.u.setData(columns(plot)));
    answer();
    tiles();
    table();
    legend();
    rings();
    describe();
    remember();
  }

  function begin() {
    $("scene").replaceChildren(...data.scenes.map((scene, i) => element("option", { value: i }, scene.title)));
    Object.entries(settings).forEach(([name, setting]) => ($(name).max = setting.most));
    recall();
    reckon();
    $("points").tHead.rows[0].replaceChildren(...COLUMNS.map(([name, unit, , , words], i) => {
      const head = element("button", { type: "button" }, name);
      head.addEventListener("click", () => {
        order = { column: i, up: order.column === i ? !order.up : true };
        table();
        rings();
      });
      return element("th", words ? { class: "words" } : {}, head, element("small", {}, unit));
    }));
    PLOTS.forEach(make);
    update();
    $("scene").addEventListener("change", () => (enter(), update()));
    ["part", "fits"].forEach((name) => $(name).addEventListener("change", update));
    Object.keys(settings).forEach((name) => $(name).addEventListener("input", update));
    $("reset").addEventListener("click", () => {
      Object.entries(settings).forEach(([name, setting]) => ($(name).value = setting.at));
      $("part").value = scene.device;
      $("fits").checked = true;
      update();
    });
    const again = () => (PLOTS.forEach(make), rings());
    let width = innerWidth;
    addEventListener("resize", () => innerWidth !== width && ((width = innerWidth), again()));
    matchMedia("(prefers-color-scheme: dark)").addEventListener("change", again);
    addEventListener("hashchange", () => (recall(), update()));
  }
  begin();
})();
