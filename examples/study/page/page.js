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
const names = { n_buffer: "N-Buffer", mipmap: "mip-map", summed_area: "summed area", r2: "R2", sobol: "Sobol" };
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
const varying = rows => ["method", ...knobNames(rows)].filter(key => valuesOf(rows, key).length > 1);
/** "slices 8, N-Buffer, product, closing": names of numbers, but words alone, and switches only where they are on. */
const knobsOf = (row, keys) => keys.map(key => {
  const value = key === "method" ? row.method : row.knobs[key];
  if (typeof value === "number") return `${plain(key)} ${value}`;
  return value === true ? plain(key) : value ? plain(String(value)) : "";
}).filter(Boolean).join(", ");

const scenes = data.scenes.map((info, index) => {
  const rows = data.rows.filter(row => row.scene === info.name);
  const front = paretoFront(rows);
  return {
    ...info, index, rows, front, id: "scene-" + (index + 1),
    rays: data.rays.filter(row => row.scene === info.name),
    pictures: data.pictures.filter(picture => picture.scene === info.name),
    keys: varying(rows),
    best: front[front.length - 1],
    default: rows.find(row => row.default),
  };
});

// ---------------------------------------------------------------- head and summary

function drawHead() {
  const { study } = data, methods = distinct(data.rows.map(row => row.method));
  const count = (n, what) => `${whole(n)} ${what}${n === 1 ? "" : "s"}`;
  const facts = [["Machine", study.machine], ["Compiler", study.compiler], ["Flags", study.flags], ["Date", study.date],
    ["Truth", `${whole(study.truth_rays)} stratified rays a point`], ["Threads", "one, for the methods and for Embree"]];
  $("#lede").append("What a soft shadow costs, and how far it is from the truth: ",
    el("strong", {}, count(data.rows.length, "setting")), ` of ${methods.map(plain).join(", ")} on `,
    el("strong", {}, count(scenes.length, "scene")), ", beside Embree tracing rays at the same points in the same run.");
  $("#command").textContent = "$ " + study.command;
  for (const [term, text] of facts) if (text) $("#facts").append(el("div", {}, el("dt", {}, term), el("dd", {}, text)));
  const list = el("ul");
  for (const scene of scenes) list.append(el("li", {}, el("a", { href: "#" + scene.id }, scene.name)));
  $("#nav").append(list);
  scenes.forEach((scene, i) => $("#plots").append(i ? ", " : "", el("a", { href: scene.plot }, scene.name)));
}

function drawSummary() {
  const number = (text, more = "") => el("td", { class: "number " + more }, text);
  const three = (row, rule) => row
    ? [number(error(row.rmse), rule), number(digits(row.ns_per_point)), number(speedup(row).text)]
    : [number("–", rule), number("–"), number("–")];
  const heads = rule => [el("th", { scope: "col", class: "number " + rule }, "RMSE"),
    el("th", { scope: "col", class: "number" }, "ns/point"), el("th", { scope: "col", class: "number" }, "speed-up")];
  const withDefault = scenes.some(scene => scene.default);
  $("#summary").append(
    el("thead", {},
      el("tr", {}, el("th", { rowspan: 2, scope: "col" }, "Scene"), el("th", { rowspan: 2, scope: "col", class: "number" }, "triangles"),
        withDefault ? el("th", { colspan: 3, scope: "colgroup", class: "rule" }, "default options") : null,
        el("th", { colspan: 4, scope: "colgroup", class: "rule" }, "smallest error")),
      el("tr", {}, ...(withDefault ? heads("rule") : []), ...heads("rule"), el("th", { scope: "col" }, "at"))),
    el("tbody", {}, ...scenes.map(scene => el("tr", {},
      el("th", { scope: "row" }, el("a", { href: "#" + scene.id }, scene.name)), number(whole(scene.triangles)),
      ...(withDefault ? three(scene.default, "rule") : []), ...three(scene.best, "rule"),
      el("td", { class: "knobs" }, scene.best ? knobsOf(scene.best, scene.keys) : "")))));
  $("#summary-caption").append(el("b", {}, "Table 1. "),
    "Error and time of each scene. Speed-up is against the cheapest of Embree's samplers at the same error.");
  const reading = [
    ["RMSE", "Root-mean-square error of visibility, the fraction of the light that a point sees, from 0 to 1."],
    ["ns/point", "Time of one query, of many in one call, on one thread."],
    ["rays", "How many rays a point Embree's cheapest sampler needs for the same RMSE, interpolated between 4 and 1024."],
    ["speed-up", "What those rays cost, divided by what the method costs. “> 40×” where even the most rays are less accurate than the method, “< 2×” where the fewest are already more accurate."],
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
      `Signed difference of visibility, method − truth; RMSE ${error(picture.rmse)}. Grey: not asked.`);
  };
  if (scene.pictures.length > 1) drawTabs(scene.pictures, tabs, show);
  show(scene.pictures[0]);
  move(50);
}

/** A group of radio buttons: arrow keys choose, Tab leaves. */
function drawTabs(pictures, tabs, show) {
  const buttons = pictures.map((picture, i) => {
    const button = el("button", { type: "button", role: "radio" }, picture.title);
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
const dashes = [[], [7, 4], [2, 3]];
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
  const samplers = distinct(scene.rays.map(row => row.sampler));
  return distinct(scene.rays.map(row => row.sampler + "|" + row.packet)).map(key => {
    const [sampler, packet] = key.split("|");
    return {
      label: `${plain(sampler)}, ${packet > 1 ? "packets of " + packet : "single"}`,
      short: `${plain(sampler)}, ${packet > 1 ? "packets" : "single"}`, packets: Number(packet), dash: dashes[samplers.indexOf(sampler) % dashes.length],
      points: scene.rays.filter(row => row.sampler === sampler && row.packet === Number(packet)),
    };
  });
}

const point = row => ({ x: row.ns_per_point, y: row.rmse, row });

function datasets(scene, state, size) {
  const ink = css("--soft"), faint = css("--faint"), accent = css("--accent");
  const hues = valuesOf(scene.rows, state.hue), forms = valuesOf(scene.rows, state.shape);
  const sets = hues.map((hue, i) => {
    const rows = scene.rows.filter(row => valueOf(row, state.hue) === hue), color = css("--hue-" + i % 5);
    const styles = rows.map(row => shapes[forms.indexOf(valueOf(row, state.shape)) % shapes.length]);
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
      borderColor: curve.packets > 1 ? ink : faint, borderWidth: curve.packets > 1 ? 1.8 : 1.1, pointRadius: curve.packets > 1 ? 2 : 1.4,
      pointBackgroundColor: curve.packets > 1 ? ink : faint, pointBorderWidth: 0, pointHitRadius: 5,
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
    `Each mark is one setting, the largest the default; each line is one of Embree's samplers, from few rays to many` +
    `${packets.length ? `, alone or in packets of ${packets.join(" or ")}` : ""}.`);
  if (!window.Chart) {
    $(".canvas", figure).replaceWith(el("img", { src: scene.plot, alt: caption.textContent }));
    figure.prepend(el("p", { class: "note" }, "Chart.js was missing when this page was made, so the plot is a picture (Debian package libjs-chart.js)."));
    return () => {};
  }
  const keys = scene.keys.length ? scene.keys : ["method"];
  const pick = (wanted, other) => keys.includes(wanted) ? wanted : keys.find(key => key !== other) ?? keys[0];
  const state = { hue: pick("filter"), hidden: new Set() };
  state.shape = pick("combination", state.hue);
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
    const line = curve => ({ d: "M0 7.5h24", fill: "none", stroke: curve.packets > 1 ? "var(--soft)" : "var(--faint)", "stroke-width": curve.packets > 1 ? 2 : 1.3, "stroke-dasharray": curve.dash.join(" ") });
    tools.replaceChildren(
      group(chooser("hue", "colour"), ...valuesOf(scene.rows, state.hue).map((hue, i) =>
        keyEntry(plain(hue) || "none", { d: shapePaths[0], fill: `var(--hue-${i % 5})` }, toggle(hue)))),
      group(chooser("shape", "shape"), ...valuesOf(scene.rows, state.shape).map((form, i) =>
        keyEntry(plain(form) || "none", { d: shapePaths[i % 5], fill: "var(--soft)", stroke: "var(--soft)" }))),
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
    $(".read-out", figure).textContent = `${knobsOf(row, keys)}: RMSE ${error(row.rmse)}, ${digits(row.ns_per_point)} ns/point, ${speedup(row).text}`;
  });
  canvas.addEventListener("blur", () => { at = -1; light(null); $(".read-out", figure).textContent = ""; });
  matchMedia("(prefers-color-scheme: dark)").addEventListener("change", () => redraw(false));
  return light;
}

// ---------------------------------------------------------------- table

function columnsOf(scene) {
  const number = (head, value, text) => ({ head, number: true, value, text: row => text(value(row), row) });
  return [
    { head: "", value: () => 0, text: row => row.default ? "default" : "" },
    ...scene.keys.map(key => ({
      head: plain(key), number: scene.rows.some(row => typeof row.knobs[key] === "number"),
      value: row => key === "method" ? row.method : row.knobs[key] ?? "", text: row => plain(valueOf(row, key)),
    })),
    number("RMSE", row => row.rmse, error), number("ns/point", row => row.ns_per_point, digits),
    number("rays", row => rays(row).value, (x, row) => rays(row).text),
    number("speed-up", row => speedup(row).value, (x, row) => speedup(row).text),
    number("max", row => row.max_error, x => x.toFixed(3)),
    number("bias", row => row.bias, x => (x < 0 ? "−" : "+") + error(Math.abs(x))),
    number("build, ms", row => row.build_ms, digits), number("memory", row => row.bytes, bytes),
  ];
}

function compare(a, b) {
  if (typeof a === "number" && typeof b === "number") return (Number.isNaN(a) ? 1 : 0) - (Number.isNaN(b) ? 1 : 0) || a - b;
  return String(a).localeCompare(String(b), "en", { numeric: true });
}

function drawTable(scene, root, light) {
  const box = $(".rows", root), columns = columnsOf(scene), front = new Set(scene.front);
  const state = { column: columns.findIndex(column => column.head === "RMSE"), up: true, all: false };
  const body = el("tbody", { class: "live" });
  const heads = columns.map((column, i) => {
    if (!column.head) return el("td");
    const button = el("button", { type: "button" }, column.head);
    button.addEventListener("click", () => {
      state.up = state.column === i ? !state.up : true;
      state.column = i;
      draw();
    });
    return el("th", { scope: "col", class: column.number ? "number" : "" }, button);
  });
  const draw = () => {
    const column = columns[state.column], sign = state.up ? 1 : -1;
    const shown = state.all ? scene.rows : scene.rows.filter(row => front.has(row) || row.default);
    heads.forEach((head, i) => columns[i].head && head.setAttribute("aria-sort", i !== state.column ? "none" : state.up ? "ascending" : "descending"));
    body.replaceChildren(...[...shown].sort((a, b) => sign * compare(column.value(a), column.value(b))).map(row => {
      const line = el("tr", { class: front.has(row) ? "front" : "" });
      for (const c of columns) line.append(el("td", { class: c.number ? "number" : c.head ? "" : "unit" },
        !c.head && row === scene.best ? el("span", { class: "star" }, "★ ") : null, c.text(row)));
      line.addEventListener("pointerenter", () => { line.classList.add("lit"); light(row); });
      line.addEventListener("pointerleave", () => { line.classList.remove("lit"); light(null); });
      return line;
    }));
  };
  const buttons = [["Best for their time", false], [`All ${whole(scene.rows.length)} settings`, true]].map(([text, all]) => {
    const button = el("button", { type: "button", "aria-pressed": String(all === state.all) }, text);
    button.addEventListener("click", () => {
      state.all = all;
      buttons.forEach(other => other.setAttribute("aria-pressed", String(other === button)));
      draw();
    });
    return button;
  });
  $(".rows-tools", box).append(...buttons);
  $("table", box).append(el("thead", {}, el("tr", {}, ...heads)), body);
  $(".scroll", box).setAttribute("aria-label", `Settings measured on ${scene.name}`);
  const same = knobNames(scene.rows).filter(key => !scene.keys.includes(key));
  $(".caption", box).append(el("b", {}, `Table ${scene.index + 2}. `), `Settings of ${valuesOf(scene.rows, "method").map(plain).join(", ")}; the bar at the left marks those that are best for their time, ★ the smallest RMSE. `,
    same.length ? "The same for all: " + knobsOf(scene.rows[0], same) + "." : "");
  draw();
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
  if (!scene.rows.length) return;
  drawTable(scene, root, drawPlot(scene, root));
}

/** The link of the scene in view is marked. */
function followScroll() {
  const links = new Map(scenes.map((scene, i) => [scene.id, $("#nav").querySelectorAll("a")[i]]));
  const observer = new IntersectionObserver(entries => {
    for (const entry of entries) entry.isIntersecting ? links.get(entry.target.id).setAttribute("aria-current", "true") : links.get(entry.target.id).removeAttribute("aria-current");
  }, { rootMargin: "-30% 0px -69% 0px" });
  document.querySelectorAll(".scene").forEach(section => observer.observe(section));
}

drawHead();
drawSummary();
scenes.forEach(drawScene);
followScroll();
})();
