// Draws the page from the study's data. No framework; Chart.js for the plots, and a picture where it is missing.
"use strict";

(() => {
const data = JSON.parse(document.getElementById("data").textContent);
const $ = (selector, root = document) => root.querySelector(selector);

// ---------------------------------------------------------------- text

/** An element with attributes and children; strings become text, never markup. */
function el(tag, attributes = {}, ...children) {
  const element = document.createElement(tag);
  for (const [key, value] of Object.entries(attributes))
    if (value !== undefined && value !== false) element.setAttribute(key, value === true ? "" : value);
  element.append(...children.filter(child => child !== null && child !== undefined));
  return element;
}

const digits = x => x >= 99.95 || Number.isInteger(x) ? Math.round(x).toLocaleString("en-US") : x.toPrecision(3);
const error = x => x.toFixed(4);
const whole = x => x.toLocaleString("en-US");
const bytes = x => x >= 1 << 20 ? digits(x / (1 << 20)) + " MiB" : digits(x / 1024) + " KiB";
const knobText = value => value === true ? "yes" : value === false ? "no" : value === undefined ? "" : String(value);
const names = {
  n_buffer: "N-Buffer", d_buffer: "D-buffer", mipmap: "mip-map", summed_area: "summed area", rectangles: "rectangles (the paper)",
  r2: "R2", sobol: "Sobol", "r2 coherent": "R2 coherent", "sobol coherent": "Sobol coherent",
};
const plain = name => names[name] ?? name.replaceAll("_", " ");

/** A figure that may only be bounded, with the value it sorts by. */
function figure(row, known, limit, unit) {
  if (row[known] !== null) return { text: digits(row[known]) + unit, value: row[known] };
  if (row.ray_ns_bound === null || limit === null) return { text: "–", value: NaN };
  return { text: (row.ray_ns_bound === "lower" ? "> " : "< ") + digits(limit) + unit, value: limit };
}
const speedup = row => figure(row, "speedup", row.ray_ns_limit === null ? null : row.ray_ns_limit / row.ns_per_point, "×");
const rays = row => figure(row, "rays_at_equal_rmse", row.rays_limit, "");

// ---------------------------------------------------------------- data

/** The rows that none beats in RMSE and time both, fastest first. */
function paretoFront(rows) {
  const front = [];
  for (const row of [...rows].sort((a, b) => a.ns_per_point - b.ns_per_point || a.rmse - b.rmse))
    if (!front.length || row.rmse < front[front.length - 1].rmse) front.push(row);
  return front;
}

const distinct = values => [...new Set(values)];
const knobNames = rows => distinct(rows.flatMap(row => Object.keys(row.knobs)));
const valueOf = (row, key) => key === "method" ? row.method : knobText(row.knobs[key]);
const valuesOf = (rows, key) => distinct(rows.map(row => valueOf(row, key)));
const ofMethod = (rows, method) => rows.filter(row => row.method === method);
const varying = rows => knobNames(rows).filter(key => valuesOf(rows, key).length > 1);
/** "slices 8, N-Buffer, product, closing": names of numbers, but words alone, and switches only where they are on. */
const knobsOf = (row, keys) => keys.map(key => {
  const value = row.knobs[key];
  if (typeof value === "number") return `${plain(key)} ${value}`;
  return value === true ? plain(key) : value ? plain(String(value)) : "";
}).filter(Boolean).join(", ");

const scenes = data.scenes.map((info, index) => {
  const rows = data.rows.filter(row => row.scene === info.name);
  const methods = distinct(rows.map(row => row.method)).map(name => {
    const own = ofMethod(rows, name), front = paretoFront(own);
    return { name, rows: own, keys: varying(own), best: front[front.length - 1], default: own.find(row => row.default) };
  });
  const knobs = distinct(methods.flatMap(method => method.keys));
  return {
    ...info, index, rows, methods, front: paretoFront(rows), id: "scene-" + (index + 1),
    rays: data.rays.filter(row => row.scene === info.name),
    pictures: data.pictures.filter(picture => picture.scene === info.name),
    triplet: data.triplets.find(triplet => triplet.scene === info.name),
    parts: data.parts.find(parts => parts.scene === info.name),
    keys: methods.length > 1 ? ["method", ...knobs] : knobs,
    best: paretoFront(rows).pop(),
  };
});
/** What a row's own method varies on the scene. */
const ownKnobs = (scene, row) => knobsOf(row, scene.methods.find(method => method.name === row.method).keys);

const costFigures = data.cost_figures.map(figure => ({ ...figure, costs: data.costs.filter(cost => cost.figure === figure.name) }));

// ---------------------------------------------------------------- head and summary

function drawHead() {
  const { study } = data, methods = distinct(data.rows.map(row => row.method));
  const count = (n, what) => `${whole(n)} ${what}${n === 1 ? "" : "s"}`;
  const facts = [["Machine", study.machine], ["Compiler", study.compiler], ["Flags", study.flags], ["Date", study.date],
    ["Truth", `${whole(study.truth_rays)} stratified rays a point`], ["Threads", "one, for the methods and for Embree"]];
  if (data.rows.length) $("#lede").append("What a soft shadow costs, and how far it is from the truth: ",
    el("strong", {}, count(data.rows.length, "setting")), ` of ${methods.map(plain).join(" and ")} on `,
    el("strong", {}, count(scenes.length, "scene")), ", beside Embree tracing rays at the same points in the same run.");
  else $("#lede").append("What a soft shadow costs as its scene grows.");
  $("#command").textContent = "$ " + study.command;
  for (const [term, text] of facts) if (text) $("#facts").append(el("div", {}, el("dt", {}, term), el("dd", {}, text)));
  const list = el("ul");
  if (costFigures.length) list.append(el("li", {}, el("a", { href: "#cost" }, "cost against size")));
  for (const scene of scenes) list.append(el("li", {}, el("a", { href: "#" + scene.id }, scene.name)));
  $("#nav").append(list);
  [...costFigures.map(({ counts, plot }) => ({ name: "cost against " + counts, plot })), ...scenes].forEach((it, i) => $("#plots").append(i ? ", " : "", el("a", { href: it.plot }, it.name)));
}

function drawSummary() {
  const number = (text, more = "") => el("td", { class: "number " + more }, text);
  const three = (row, rule) => row
    ? [number(error(row.rmse), rule), number(digits(row.ns_per_point)), number(speedup(row).text)]
    : [number("–", rule), number("–"), number("–")];
  const heads = rule => [el("th", { scope: "col", class: "number " + rule }, "RMSE"),
    el("th", { scope: "col", class: "number" }, "ns/point"), el("th", { scope: "col", class: "number" }, "speed-up")];
  if (!scenes.length) return $("#results").remove();
  const lines = scenes.flatMap(scene => scene.methods.map((method, i) => el("tr", { class: i ? "same" : "" },
    i ? null : el("th", { scope: "row", rowspan: scene.methods.length }, el("a", { href: "#" + scene.id }, scene.name)),
    i ? null : el("td", { class: "number", rowspan: scene.methods.length }, whole(scene.triangles)),
    el("td", {}, plain(method.name)), ...three(method.default, "rule"), ...three(method.best, "rule"),
    el("td", { class: "knobs" }, method.best === method.default ? "default options" : knobsOf(method.best, method.keys)))));
  $("#summary").append(
    el("thead", {},
      el("tr", {}, el("th", { rowspan: 2, scope: "col" }, "Scene"), el("th", { rowspan: 2, scope: "col", class: "number" }, "triangles"),
        el("th", { rowspan: 2, scope: "col" }, "method"),
        el("th", { colspan: 3, scope: "colgroup", class: "rule" }, "default options"),
        el("th", { colspan: 4, scope: "colgroup", class: "rule" }, "smallest error")),
      el("tr", {}, ...heads("rule"), ...heads("rule"), el("th", { scope: "col" }, "at"))),
    el("tbody", {}, ...lines));
  $("#summary-caption").append(el("b", {}, "Table 1. "),
    "Error and time of each scene. Speed-up is against the cheapest of Embree's samplers at the same error.");
  const reading = [
    ["RMSE", "Root-mean-square error of visibility, the fraction of the light that a point sees, from 0 to 1."],
    ["ns/point", "Time of one query, of many in one call, on one thread."],
    ["rays", "How many rays a point Embree's cheapest sampler needs for the same RMSE, interpolated between 4 and 1024."],
    ["speed-up", "What those rays cost, divided by what the method costs. “> 40×” where even the most rays are less accurate than the method, “< 2×” where the fewest are already more accurate."],
    ["overlap", "RMSE at the points from which casters hide the same part of the light, more than 1 % of it."],
    ["bias", "Mean of method − truth: positive is too bright, negative too dark."],
    ["best for its time", "No other setting beats it in error and time both."],
  ];
  for (const [term, text] of reading) $("#reading").append(el("dt", {}, term), el("dd", {}, text));
}

// ---------------------------------------------------------------- pictures

function drawPictures(scene, root) {
  const pair = $(".pair", root);
  if (!scene.pictures.length) return pair.remove();
  const slider = $(".slider", root), handle = $(".handle", root), tabs = $(".tabs", root);
  let at = 50;
  const move = percent => {
    at = Math.min(100, Math.max(0, percent));
    slider.style.setProperty("--at", at + "%");
    handle.setAttribute("aria-valuenow", Math.round(at));
    handle.setAttribute("aria-valuetext", `${Math.round(at)} % method, ${Math.round(100 - at)} % truth`);
    $(".tag.left", slider).classList.toggle("gone", at < 14);
    $(".tag.right", slider).classList.toggle("gone", at > 86);
  };
  const follow = event => {
    const box = slider.getBoundingClientRect();
    move((event.clientX - box.left) / box.width * 100);
  };
  slider.addEventListener("pointerdown", event => {
    if (event.button !== 0) return;
    slider.setPointerCapture(event.pointerId);
    follow(event);
  });
  slider.addEventListener("pointermove", event => slider.hasPointerCapture(event.pointerId) && follow(event));
  slider.addEventListener("dragstart", event => event.preventDefault());
  handle.addEventListener("keydown", event => {
    const step = { ArrowLeft: -2, ArrowDown: -2, ArrowRight: 2, ArrowUp: 2, PageDown: -20, PageUp: 20, Home: -100, End: 100 }[event.key];
    if (step === undefined) return;
    event.preventDefault();
    move(at + step);
  });
  handle.setAttribute("aria-label", `How much of the picture of ${scene.name} shows the method rather than the truth`);

  const show = picture => {
    for (const [image, file, what] of [[".truth", picture.truth, "ray-traced truth"], [".method", picture.method, picture.title]]) {
      $(image, slider).src = file;
      $(image, slider).alt = `${scene.name}, ${what}`;
    }
    const difference = $(".difference", root);
    $("a", difference).href = $("img", difference).src = picture.difference;
    $("img", difference).alt = `${scene.name}, method minus truth: blue is too dark, red is too bright`;
    $(".compare figcaption", root).replaceChildren(el("b", {}, `Figure ${scene.index + 1}a. `), `${picture.title}, and `,
      `truth. Drag the handle, or focus it and use the arrow keys.`);
    $("figcaption", difference).replaceChildren(el("b", {}, `Figure ${scene.index + 1}b. `),
      `Signed difference of visibility, method − truth; RMSE ${error(picture.rmse)}. Specks are noise of the picture's truth. Grey: not asked.`);
  };
  if (scene.pictures.length > 1) drawTabs(scene.pictures, tabs, show);
  show(scene.pictures[0]);
  move(50);
}

/** A group of radio buttons: arrow keys choose, Tab leaves. */
function drawTabs(pictures, tabs, show) {
  const buttons = pictures.map((picture, i) => {
    const button = el("button", { type: "button", role: "radio" }, picture.label);
    button.addEventListener("click", () => choose(i));
    return button;
  });
  const choose = chosen => {
    buttons.forEach((button, i) => {
      button.setAttribute("aria-checked", i === chosen);
      button.tabIndex = i === chosen ? 0 : -1;
    });
    show(pictures[chosen]);
  };
  tabs.addEventListener("keydown", event => {
    const step = { ArrowLeft: -1, ArrowUp: -1, ArrowRight: 1, ArrowDown: 1 }[event.key];
    if (!step) return;
    event.preventDefault();
    const next = (buttons.indexOf(document.activeElement) + step + buttons.length) % buttons.length;
    choose(next);
    buttons[next].focus();
  });
  tabs.append(...buttons);
  choose(0);
}

// ---------------------------------------------------------------- plot

const shapes = ["circle", "rect", "triangle", "rectRot", "star"];
const shapePaths = ["M12 3.6a4 4 0 1 0 .01 0z", "M8.4 4h7.2v7.2H8.4z", "M12 3.2l4.6 8H7.4z", "M12 2.6l5 5-5 5-5-5z", "M12 2.6v10M7.7 5.1l8.6 5M7.7 10.1l8.6-5"];
const dashes = { stratified: [], r2: [7, 4], sobol: [2, 3] };
const hueCount = 10;
/** Which shape stands for a value: with one key for colour and shape, shapes tell apart what shares a colour. */
const shapeOf = (state, forms, form) => (state.shape === state.hue ? Math.floor(forms.indexOf(form) / hueCount) : forms.indexOf(form)) % shapes.length;
const css = name => getComputedStyle(document.documentElement).getPropertyValue(name).trim();

/** A button (or plain text) of the plot's key, with a small drawing of what it stands for. */
function keyEntry(text, drawing, onToggle) {
  const svg = document.createElementNS("http://www.w3.org/2000/svg", "svg");
  svg.setAttribute("viewBox", "0 0 24 15");
  svg.setAttribute("aria-hidden", "true");
  for (const attributes of [drawing].flat()) {
    const path = document.createElementNS("http://www.w3.org/2000/svg", "path");
    for (const [key, value] of Object.entries(attributes)) path.setAttribute(key, value);
    svg.append(path);
  }
  if (!onToggle) return el("span", { class: "key" }, svg, text);
  const button = el("button", { type: "button", class: "key", "aria-pressed": "true" }, svg, text);
  button.addEventListener("click", () => {
    const on = button.getAttribute("aria-pressed") !== "true";
    button.setAttribute("aria-pressed", on);
    onToggle(on);
  });
  return button;
}

function rayCurves(scene) {
  return distinct(scene.rays.map(row => row.sampler + "|" + row.packet)).map(key => {
    const [sampler, packet] = key.split("|");
    const [pattern, coherent] = sampler.split(" "), packets = Number(packet);
    const ink = coherent ? "ink" : packets > 1 ? "soft" : "faint";
    return {
      label: `${plain(sampler)}, ${packets > 1 ? "packets of " + packets : "single"}`, packets, ink, dash: dashes[pattern],
      short: coherent ? plain(sampler) : `${plain(sampler)}, ${packets > 1 ? "packets" : "single"}`, width: { ink: 1.9, soft: 1.5, faint: 1.1 }[ink],
      points: scene.rays.filter(row => row.sampler === sampler && row.packet === Number(packet)),
    };
  });
}

const point = row => ({ x: row.ns_per_point, y: row.rmse, row });

function datasets(scene, state, size) {
  const accent = css("--accent");
  const hues = valuesOf(scene.rows, state.hue), forms = valuesOf(scene.rows, state.shape);
  const sets = hues.map((hue, i) => {
    const rows = scene.rows.filter(row => valueOf(row, state.hue) === hue), color = css("--hue-" + i % hueCount);
    const styles = rows.map(row => shapes[shapeOf(state, forms, valueOf(row, state.shape))]);
    return {
      kind: "rows", label: hue, data: rows.map(point), showLine: false, order: 1, pointStyle: styles,
      pointRadius: rows.map((row, k) => size * ((styles[k] === "circle" ? 3.6 : 4.4) + (row.default ? 2.5 : 0))),
      pointHoverRadius: 7, pointHitRadius: 6, borderColor: color, backgroundColor: color + "b0", borderWidth: 1,
    };
  });
  sets.push({
    kind: "front", label: "best for its time", data: scene.front.map(point), stepped: true, order: 3, borderColor: accent,
    borderWidth: 1.8, pointRadius: 6.5 * size, pointHoverRadius: 6.5 * size, pointHitRadius: 0, pointStyle: "circle",
    pointBorderColor: accent, pointBackgroundColor: "transparent", pointBorderWidth: 1.2,
  });
  for (const curve of rayCurves(scene))
    sets.push({
      kind: "rays", label: curve.label, data: curve.points.map(point), order: 4, borderDash: curve.dash,
      borderColor: css("--" + curve.ink), borderWidth: curve.width, pointRadius: curve.width, pointBackgroundColor: css("--" + curve.ink),
      pointBorderWidth: 0, pointHitRadius: 5,
    });
  return sets;
}

function tooltip(scene, item) {
  const row = item.raw.row;
  if (row.sampler) return ["Embree, " + item.dataset.label, `${row.rays} rays a point`, `RMSE ${error(row.rmse)}, ${digits(row.ns_per_point)} ns/point`];
  return [plain(row.method) + (row.default ? " (default)" : ""), ...Object.entries(row.knobs).map(([key, value]) => `${plain(key)}: ${plain(knobText(value))}`),
    `RMSE ${error(row.rmse)}, ${digits(row.ns_per_point)} ns/point`, `${rays(row).text} rays, ${speedup(row).text}`];
}

function options(scene) {
  const all = [...scene.rows, ...scene.rays];
  const range = values => ({ min: Math.min(...values) / 1.35, max: Math.max(...values) * 1.35 });
  const axis = (title, values, format) => ({
    type: "logarithmic", ...range(values.filter(value => value > 0)), grid: { color: css("--line"), borderColor: css("--faint"), tickColor: "transparent" },
    title: { display: true, text: title, color: css("--soft") },
    ticks: {
      color: css("--soft"), maxRotation: 0, autoSkip: false,
      callback(value) {
        const leading = Number((value / 10 ** Math.floor(Math.log10(value) + 1e-9)).toPrecision(2));
        const wanted = this.axis === "x" && this.chart.width < 640 ? [1] : [1, 2, 5];
        return wanted.includes(leading) ? format(value) : null;
      },
    },
  });
  return {
    animation: false, maintainAspectRatio: false, font: { family: css("--sans") },
    interaction: { mode: "nearest", intersect: true },
    scales: {
      x: axis("time per point", all.map(row => row.ns_per_point), value => value >= 1e6 ? value / 1e6 + " ms" : value >= 1e3 ? value / 1e3 + " µs" : value + " ns"),
      y: axis("RMSE of visibility", all.map(row => row.rmse), value => Number(value.toPrecision(2)) + ""),
    },
    plugins: {
      legend: { display: false },
      tooltip: {
        displayColors: false, backgroundColor: css("--ink"), bodyColor: css("--paper"), padding: 10, cornerRadius: 2,
        filter: (item, i, items) => items.findIndex(other => other.raw.row === item.raw.row) === i,
        callbacks: { title: () => "", label: item => tooltip(scene, item) },
      },
    },
  };
}

/** The plot; returns a function that lights up a row's point, or null for none. */
function drawPlot(scene, root) {
  const figure = $(".plot", root), tools = $(".plot-tools", figure), canvas = $("canvas", figure);
  const caption = $("figcaption", figure), packets = distinct(rayCurves(scene).map(curve => curve.packets)).filter(n => n > 1);
  caption.append(el("b", {}, `Figure ${scene.index + 1}c. `), `Error against time on ${scene.name}: lower and further left is better. ` +
    `Each mark is one setting, the largest a default; each line is one of Embree's samplers, from few rays to many` +
    `${packets.length ? `, alone or in packets of ${packets.join(" or ")}` : ""}.`);
  if (!window.Chart) {
    $(".canvas", figure).replaceWith(el("img", { src: scene.plot, alt: caption.textContent }));
    figure.prepend(el("p", { class: "note" }, "Chart.js was missing when this page was made, so the plot is a picture (Debian package libjs-chart.js)."));
    return () => {};
  }
  const keys = scene.keys.length ? scene.keys : ["method"];
  const pick = wanted => wanted.find(key => keys.includes(key)) ?? keys[0];
  const state = { hue: pick(["method", "mode", "overlap", "filter"]), shape: pick(["method", "layers", "silhouette", "transition", "combination"]), hidden: new Set() };
  Chart.defaults.font.family = css("--sans");
  const chart = new Chart(canvas, { type: "line", data: { datasets: datasets(scene, state, canvas.parentElement.clientWidth < 640 ? 0.65 : 1) }, options: options(scene) });
  canvas.setAttribute("aria-label", caption.textContent + " Arrow keys step through the settings that are best for their time; all figures are in the table below.");

  const toggle = label => on => {
    on ? state.hidden.delete(label) : state.hidden.add(label);
    redraw(false);
  };
  const redraw = keysToo => {
    if (keysToo) state.hidden.clear();
    chart.data.datasets = datasets(scene, state, canvas.parentElement.clientWidth < 640 ? 0.65 : 1);
    chart.data.datasets.forEach(set => { set.hidden = state.hidden.has(set.label); });
    chart.options = options(scene);
    chart.update("none");
    if (keysToo) drawKey();
  };
  const chooser = (name, text) => {
    const select = el("select", { "aria-label": text });
    for (const key of keys) select.append(el("option", { value: key, selected: state[name] === key }, plain(key)));
    select.addEventListener("change", () => { state[name] = select.value; redraw(true); });
    return el("label", {}, text + " ", select);
  };
  const drawKey = () => {
    const group = (...children) => el("span", { class: "group" }, ...children);
    const line = curve => ({ d: "M0 7.5h24", fill: "none", stroke: `var(--${curve.ink})`, "stroke-width": curve.width, "stroke-dasharray": curve.dash.join(" ") });
    tools.replaceChildren(
      group(chooser("hue", "colour"), ...valuesOf(scene.rows, state.hue).map((hue, i) =>
        keyEntry(plain(hue) || "none", { d: shapePaths[0], fill: `var(--hue-${i % hueCount})` }, toggle(hue)))),
      group(chooser("shape", "shape"), ...(state.shape === state.hue ? [] : valuesOf(scene.rows, state.shape).map((form, i) =>
        keyEntry(plain(form) || "none", { d: shapePaths[i % shapes.length], fill: "var(--soft)", stroke: "var(--soft)" })))),
      group(keyEntry("best for its time", { d: "M0 3h12v9h12", fill: "none", stroke: "var(--accent)", "stroke-width": 2.2 }, toggle("best for its time")), el("span", {}, "Embree"), ...rayCurves(scene).map(curve => keyEntry(curve.short, line(curve), toggle(curve.label)))));
  };
  drawKey();

  const light = row => {
    const active = [];
    chart.data.datasets.forEach((set, datasetIndex) => {
      const index = row && set.kind === "rows" && !set.hidden ? set.data.findIndex(p => p.row === row) : -1;
      if (index >= 0) active.push({ datasetIndex, index });
    });
    chart.setActiveElements(active);
    chart.tooltip.setActiveElements(active, { x: 0, y: 0 });
    chart.update("none");
  };
  let at = -1;
  canvas.addEventListener("keydown", event => {
    const step = { ArrowLeft: -1, ArrowRight: 1 }[event.key];
    if (!step) return;
    event.preventDefault();
    at = Math.min(scene.front.length - 1, Math.max(0, at + step));
    light(scene.front[at]);
    const row = scene.front[at];
    $(".read-out", figure).textContent = `${plain(row.method)}, ${ownKnobs(scene, row)}: RMSE ${error(row.rmse)}, ${digits(row.ns_per_point)} ns/point, ${speedup(row).text}`;
  });
  canvas.addEventListener("blur", () => { at = -1; light(null); $(".read-out", figure).textContent = ""; });
  matchMedia("(prefers-color-scheme: dark)").addEventListener("change", () => redraw(false));
  return light;
}

// ---------------------------------------------------------------- table

/** With one method a column for each knob, else one for all knobs. */
function columnsOf(scene, method) {
  const number = (head, value, text) => ({ head, number: true, value, text: row => text(value(row), row) });
  const knobs = method ? method.keys.map(key => ({
    head: plain(key), number: method.rows.some(row => typeof row.knobs[key] === "number"), value: row => row.knobs[key] ?? "",
    text: row => plain(valueOf(row, key)),
  })) : [
    { head: "method", value: row => row.method, text: row => plain(row.method) },
    { head: "knobs", wide: true, value: row => ownKnobs(scene, row), text: row => ownKnobs(scene, row) },
  ];
  const overlap = number("overlap", row => row.overlap_rmse ?? NaN, x => Number.isNaN(x) ? "–" : error(x));
  return [
    { head: "", value: () => 0, text: row => row.default ? "default" : "" }, ...knobs,
    number("RMSE", row => row.rmse, error), number("ns/point", row => row.ns_per_point, digits),
    number("rays", row => rays(row).value, (x, row) => rays(row).text),
    number("speed-up", row => speedup(row).value, (x, row) => speedup(row).text),
    number("max", row => row.max_error, x => x.toFixed(3)),
    number("bias", row => row.bias, x => (x < 0 ? "−" : "+") + error(Math.abs(x))),
    ...(scene.overlap_points ? [overlap] : []),
    number("build, ms", row => row.build_ms, digits), number("memory", row => row.bytes, bytes),
  ];
}

function compare(a, b) {
  if (typeof a === "number" && typeof b === "number") return (Number.isNaN(a) ? 1 : 0) - (Number.isNaN(b) ? 1 : 0) || a - b;
  return String(a).localeCompare(String(b), "en", { numeric: true });
}

function drawTable(scene, root, light) {
  const box = $(".rows", root), one = scene.methods.length === 1, table = $("table", box), caption = $(".caption", box);
  const state = { method: one ? scene.methods[0] : null, sorted: "RMSE", up: true, all: false };
  const draw = () => {
    const { method } = state, columns = columnsOf(scene, method), rows = method ? method.rows : scene.rows;
    const front = new Set(paretoFront(rows)), bests = scene.methods.map(each => each.best);
    const column = columns.find(each => each.head === state.sorted) ?? columns.find(each => each.head === "RMSE");
    const head = el("tr", {}, ...columns.map(each => {
      if (!each.head) return el("td");
      const button = el("button", { type: "button" }, each.head);
      button.addEventListener("click", () => {
        state.up = state.sorted === each.head ? !state.up : true;
        state.sorted = each.head;
        draw();
        [...table.querySelectorAll("thead button")].find(other => other.textContent === each.head).focus();
      });
      return el("th", { scope: "col", class: each.number ? "number" : "", "aria-sort": each !== column ? "none" : state.up ? "ascending" : "descending" }, button);
    }));
    const shown = state.all ? rows : rows.filter(row => front.has(row) || row.default || bests.includes(row));
    const sign = state.up ? 1 : -1;
    const lines = [...shown].sort((a, b) => sign * compare(column.value(a), column.value(b))).map(row => {
      const line = el("tr", { class: front.has(row) ? "front" : "" });
      for (const each of columns) line.append(el("td", { class: each.number ? "number" : each.wide ? "knobs" : each.head ? "" : "unit" },
        !each.head && bests.includes(row) ? el("span", { class: "star" }, row === scene.best ? "★ " : "☆ ") : null, each.text(row)));
      line.addEventListener("pointerenter", () => { line.classList.add("lit"); light(row); });
      line.addEventListener("pointerleave", () => { line.classList.remove("lit"); light(null); });
      return line;
    });
    table.replaceChildren(el("thead", {}, head), el("tbody", { class: "live" }, ...lines));
    const same = scene.methods.filter(each => !method || each === method).map(each =>
      [each, knobsOf(each.rows[0], knobNames(each.rows).filter(key => !each.keys.includes(key)))]).filter(([, text]) => text);
    caption.replaceChildren(el("b", {}, `Table ${scene.index + 2}. `), `Settings of ${method ? plain(method.name) : "all methods"}; `,
      `the bar at the left marks those that are best for their time, ★ the smallest RMSE, ☆ that of its method. `,
      ...same.map(([each, text]) => `The same for all of ${plain(each.name)}: ${text}. `));
    buttons.forEach(([button, all]) => button.setAttribute("aria-pressed", String(all === state.all)));
    buttons[1][0].textContent = `All ${whole(rows.length)} settings`;
  };
  const buttons = ["Best for their time", "All settings"].map((text, i) => {
    const button = el("button", { type: "button" }, text), all = i === 1;
    button.addEventListener("click", () => { state.all = all; draw(); });
    return [button, all];
  });
  $(".rows-tools", box).append(...buttons.map(([button]) => button));
  if (!one) {
    const select = el("select", { "aria-label": "Method" }, el("option", { value: "" }, "all methods"),
      ...scene.methods.map(method => el("option", { value: method.name }, plain(method.name))));
    select.addEventListener("change", () => { state.method = scene.methods.find(method => method.name === select.value) ?? null; draw(); });
    $(".rows-tools", box).append(el("label", {}, " of ", select));
  }
  $(".scroll", box).setAttribute("aria-label", `Settings measured on ${scene.name}`);
  draw();
}

// ---------------------------------------------------------------- rows of pictures

/** What a figure of a method's paper compares. */
function drawTriplet(scene, root) {
  const figure = $(".triplet:not(.parts)", root), { triplet } = scene;
  if (!triplet) return figure.remove();
  showRow(scene, figure, triplet.picture, "d", triplet.caption);
}

/** Where light, penumbra and umbra lie. */
function drawParts(scene, root) {
  const figure = $(".parts", root), { parts } = scene;
  if (!parts) return figure.remove();
  const percent = x => (100 * x).toFixed(2) + " %";
  const right = parts.agreements.map(one => `${one.setting}: ${percent(one.right)} of the points right, ${percent(one.right_in_shadow)} of those in shadow`);
  showRow(scene, figure, parts.picture, "d", `Light, penumbra and umbra, from bright to dark, as rays find them and as a method does: ` +
    `all of the light seen, some, or none. Where a method is wrong, red is too bright and blue too dark. ${right.join("; ")}.`);
}

function showRow(scene, figure, picture, letter, caption) {
  $("a", figure).href = $("img", figure).src = picture;
  $("img", figure).alt = caption;
  $("figcaption", figure).append(el("b", {}, `Figure ${scene.index + 1}${letter}. `), caption);
}

function drawCosts() {
  const root = $("#cost");
  if (!costFigures.length) return root.remove();
  for (const figure of costFigures) {
    const { costs, about } = figure, sizes = distinct(costs.map(cost => cost.x)), series = distinct(costs.map(cost => cost.series));
    // what rays are compared with is there in full
    const compared = costs.some(cost => cost.speedup !== null || cost.ray_ns_bound !== null);
    const rows = [["ns/point", cost => (cost.at_least ? "> " : "") + digits(cost.ns_per_point)],
      ...(compared ? [["RMSE", cost => error(cost.rmse)], ["speed-up", cost => speedup(cost).text], ["build, ms", cost => digits(cost.build_ms)]] : [])];
    const cell = (name, x, text) => {
      const cost = costs.find(each => each.series === name && each.x === x);
      return el("td", { class: "number" }, cost ? text(cost) : "–");
    };
    root.append(el("figure", { class: "plot" }, el("img", { src: figure.plot, alt: about }), el("figcaption", {}, about)),
      el("div", { class: "scroll", tabindex: 0, role: "region", "aria-label": "Cost of each " + figure.counts }, el("table", {},
        el("thead", {}, el("tr", {}, el("th", { scope: "col" }, figure.counts), el("th", { scope: "col" }, ""), ...sizes.map(x => el("th", { scope: "col", class: "number" }, whole(x))))),
        el("tbody", {}, ...series.flatMap(name => rows.map(([head, text], i) =>
          el("tr", { class: i ? "same" : "" }, i ? null : el("th", { scope: "row", rowspan: rows.length }, name), el("td", {}, head),
            ...sizes.map(x => cell(name, x, text)))))))));
  }
}

// ---------------------------------------------------------------- page

function drawScene(scene) {
  const root = $("#scene").content.cloneNode(true).firstElementChild;
  root.id = scene.id;
  const title = $("h2", root);
  title.textContent = scene.name;
  title.id = scene.id + "-title";
  root.setAttribute("aria-labelledby", title.id);
  $(".about", root).textContent = scene.about;
  $(".meta", root).textContent = [`${whole(scene.triangles)} triangles`, scene.light, `${whole(scene.points)} points`,
    `noise of the truth ${scene.truth_noise.toPrecision(2)}`].filter(Boolean).join(" · ");
  $("#scenes").append(root);
  drawPictures(scene, root);
  drawTriplet(scene, root);
  drawParts(scene, root);
  if (!scene.rows.length) return;
  drawTable(scene, root, drawPlot(scene, root));
}

/** The link of the scene in view is marked. */
function followScroll() {
  const links = new Map([...$("#nav").querySelectorAll("a")].map(link => [link.hash.slice(1), link]));
  const observer = new IntersectionObserver(entries => {
    for (const entry of entries) entry.isIntersecting ? links.get(entry.target.id).setAttribute("aria-current", "true") : links.get(entry.target.id).removeAttribute("aria-current");
  }, { rootMargin: "-30% 0px -69% 0px" });
  document.querySelectorAll(".scene, #cost").forEach(section => observer.observe(section));
}

drawHead();
drawSummary();
drawCosts();
scenes.forEach(drawScene);
followScroll();
})();
