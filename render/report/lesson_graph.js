"use strict";
// The pupil's graph: results as filled marks, guesses as hollow ones, at the settings tried; or, along the number of
// tries, their mean with its standard error.
const graph = { plot: null, spots: [] };
const shapes = [["●", "circle"], ["■", "square"], ["▲", "triangle"], ["◆", "diamond"], ["▼", "wedge"], ["✚", "cross"]];

// Corners of a mark about (0, 0), as large as a circle of radius 1.
const corners = { square: [[-0.9, -0.9], [0.9, -0.9], [0.9, 0.9], [-0.9, 0.9]], triangle: [[0, -1.15], [1.1, 0.85], [-1.1, 0.85]],
  diamond: [[0, -1.25], [1.1, 0], [0, 1.25], [-1.1, 0]], wedge: [[0, 1.15], [1.1, -0.85], [-1.1, -0.85]],
  cross: [[-0.4, -1.1], [0.4, -1.1], [0.4, -0.4], [1.1, -0.4], [1.1, 0.4], [0.4, 0.4], [0.4, 1.1], [-0.4, 1.1], [-0.4, 0.4], [-1.1, 0.4], [-1.1, -0.4], [-0.4, -0.4]] };

function traceMark(context, shape, x, y, size) {
  context.beginPath();
  if (shape === "circle") return context.arc(x, y, size, 0, 7);
  corners[shape].forEach(([a, b], i) => context[i ? "lineTo" : "moveTo"](x + size * a, y + size * b));
  context.closePath();
}

const countsTries = () => lesson.graph.x === "tries";
const graphSlider = () => lesson.sliders.findIndex(s => s.of === lesson.graph.x);
const groupSlider = () => lesson.sliders.findIndex(s => s.of === lesson.graph.by);
// Where a value of the slider stands along x: itself, or its number if it is a word.
const placeOfValue = (slider, k) => typeof slider.values[k] === "number" ? slider.values[k] : k;

// { x, y, guess, group, row } of each try.
function spotsOf() {
  const axis = lesson.sliders[graphSlider()];
  return tried.map(({ row, guess }, i) => ({ row, guess, y: asked.values[row], group: lesson.graph.by ? lesson.places[row][groupSlider()] : 0,
    x: countsTries() ? i + 1 : placeOfValue(axis, lesson.places[row][graphSlider()]) }));
}

// Means of the first n values, n = 1, 2, ..., with their standard errors.
const runningMeans = () => tried.map((_, i) => ({ x: i + 1, ...statistics(tried.slice(0, i + 1).map(t => asked.values[t.row])) }));

function drawSpots(u) {
  const g = u.ctx, ratio = devicePixelRatio, colours = palette();
  const at = (x, y) => [u.valToPos(x, "x", true), u.valToPos(y, "y", true)];
  g.save();
  g.setLineDash([]);
  g.lineWidth = 1.5 * ratio;
  for (const spot of graph.spots) {
    const shape = shapes[spot.group % shapes.length][1], colour = colours[spot.group % colours.length], [x, y] = at(spot.x, spot.y);
    if (spot.guess != null) {
      g.strokeStyle = isDark() ? "#8a95a3" : "#7a8592";
      const guessed = at(spot.x, spot.guess)[1];
      g.beginPath();
      g.moveTo(x, guessed);
      g.lineTo(x, y);
      g.stroke();
      traceMark(g, shape, x, guessed, 4 * ratio);
      g.fillStyle = isDark() ? "#1b2129" : "#fff";
      g.fill();
      g.stroke();
    }
    traceMark(g, shape, x, y, 5.5 * ratio);
    g.fillStyle = colour;
    g.fill();
    if (spot.row !== rowNow()) continue;
    g.strokeStyle = isDark() ? "#ff8fa3" : "#d7263d";
    g.lineWidth = 2.5 * ratio;
    g.beginPath();
    g.arc(x, y, 10 * ratio, 0, 7);
    g.stroke();
    g.lineWidth = 1.5 * ratio;
  }
  if (countsTries()) drawMeans(g, at, ratio, colours[1]);
  g.restore();
}

function drawMeans(g, at, ratio, colour) {
  g.strokeStyle = colour;
  g.lineWidth = 2 * ratio;
  for (const { x, mean, se } of runningMeans()) {
    if (se == null) continue;
    const [left, low] = at(x + 0.25, mean - se), high = at(x + 0.25, mean + se)[1], middle = at(x, mean)[1], wide = 4 * ratio;
    g.beginPath();
    for (const [a, b, c, d] of [[left, low, left, high], [left - wide, low, left + wide, low], [left - wide, high, left + wide, high], [left - wide, middle, left + wide, middle]]) {
      g.moveTo(a, b);
      g.lineTo(c, d);
    }
    g.stroke();
  }
}

// Along x: { range, splits, texts, log }.
function graphAxis() {
  if (countsTries()) return { range: [0.4, Math.max(8, tried.length) + 0.8], label: "number of tries", incrs: [1, 2, 5, 10, 20, 50] };
  const slider = lesson.sliders[graphSlider()], places = slider.values.map((_, k) => placeOfValue(slider, k));
  const low = Math.min(...places), high = Math.max(...places), log = lesson.graph.log;
  const range = log ? [low / 1.4, high * 1.4] : [low - 0.06 * (high - low), high + 0.06 * (high - low)];
  const texts = new Map(places.map((place, k) => [place, slider.texts[k]]));
  return { range, log, label: withUnit(slider.label, slider.unit), splits: [...places].sort((a, b) => a - b), texts };
}

// Marks that would stand in each other's way are left out.
function axisTexts(u, splits, texts) {
  let last = -Infinity;
  return splits.map(x => {
    const text = texts.get(x), half = 4 * text.length + 3, place = u.valToPos(x, "x");
    if (place - half < last) return "";
    last = place + half;
    return text;
  });
}

function graphTip(spot) {
  const guess = spot.guess == null ? "" : `, guessed ${numberText(spot.guess, asked)}`;
  return `${placeText(spot.row)}\n${asked.label}: ${withUnitOf(asked, spot.y)}${guess}`;
}

function underGraphPointer(u, event) {
  const box = u.over.getBoundingClientRect(), px = event.clientX - box.left, py = event.clientY - box.top;
  let best = null, least = 16 * 16;
  for (const spot of graph.spots) {
    const distance = (u.valToPos(spot.x, "x") - px) ** 2 + (u.valToPos(spot.y, "y") - py) ** 2;
    if (distance < least) [least, best] = [distance, spot];
  }
  return best;
}

function drawGraph() {
  const box = byId("graph"), axis = graphAxis(), { from, to } = lesson.guess, pad = 0.04 * (to - from);
  byId("upwards").textContent = withUnit(asked.label, asked.unit);
  graph.spots = spotsOf();
  if (graph.plot) graph.plot.destroy();
  const along = axis.splits ? { splits: () => axis.splits, filter: (u, splits) => splits, values: (u, splits) => axisTexts(u, splits, axis.texts) } : { incrs: axis.incrs };
  const u = graph.plot = new uPlot({ width: box.clientWidth, height: 300, legend: { show: false }, cursor: { show: false },
    scales: { x: { time: false, distr: axis.log ? 3 : 1, range: axis.range }, y: { range: [from - pad, to + pad] } },
    axes: [axisOf(0, { label: axis.label, labelSize: 22, ...along }), axisOf(0, { size: axisWidth })],
    series: [{}, {}], hooks: { draw: [drawSpots] } }, [axis.range, [null, null]], box);
  u.over.addEventListener("mousemove", event => {
    const spot = underGraphPointer(u, event);
    u.over.style.cursor = spot ? "pointer" : "default";
    spot ? showTip(graphTip(spot), event) : hideTip();
  });
  u.over.addEventListener("mouseleave", hideTip);
  u.over.addEventListener("click", event => {
    const spot = underGraphPointer(u, event);
    if (spot) goTo(spot.row);
  });
  const canvas = u.root.querySelector("canvas");
  canvas.setAttribute("role", "img");
  canvas.setAttribute("aria-label", `${asked.label} against ${axis.label}: ${tried.length} points; they stand in the table below`);
  drawLegend();
}

function drawLegend() {
  const colours = palette(), by = lesson.sliders[groupSlider()], legend = byId("legend");
  const entry = (mark, text, colour) => {
    const sign = element("b", { ariaHidden: "true" }, mark);
    if (colour) sign.style.color = colour;
    return element("span", {}, sign, text);
  };
  legend.replaceChildren(...(by ? by.texts.map((_, k) => entry(shapes[k % shapes.length][0], valueText(by, k), colours[k % colours.length]))
    : [entry(shapes[0][0], "result", colours[0])]), entry("○", "your guess"));
  if (countsTries()) legend.append(entry("I", "mean of your tries, with its standard error", colours[1]));
}
