"use strict";
// Outcomes of a sweep against what it varied: single impacts, means with standard errors, lines of theory.
const sections = [];
const mostDots = 4000;

// What tells lattices of one kind apart, as sweep_table.hpp has it.
const isSample = name => /(sample|seed)$|^(mirrored|pair)$/.test(name);
const finishedRows = section => {
  const status = section.columns.status;
  return Array.from({ length: section.rows }, (_, i) => i).filter(i => !status || status.values[i] === "finished");
};

// Statistics of a column over some rows. A lattice that was struck from both sides (equal `pair`) is one unit, its mean.
function statisticsOf(section, quantity, rows) {
  const column = section.columns[quantity], { pair } = section.columns, units = new Map();
  for (const i of rows) {
    const value = column ? column.values[i] : null, key = pair ? pair.values[i] : i;
    if (value != null) units.set(key, [...(units.get(key) || []), value]);
  }
  return statistics([...units.values()].map(values => values.reduce((sum, v) => sum + v, 0) / values.length));
}

// Parameters of the sweep that vary and count no samples; numbers first.
function parametersOf(section) {
  return Object.values(section.columns).filter(c => c.parameter && !isSample(c.name) && new Set(c.values).size > 1);
}

function axesOf(section) {
  const parameters = parametersOf(section), numeric = parameters.filter(c => typeof c.values[0] === "number");
  const { columns } = section;
  const fallback = Object.values(columns).find(c => c.parameter && typeof c.values[0] === "number" && new Set(c.values).size > 1);
  const plotted = section.plotted.map(plot => numeric.find(c => scriptName(section, c) === plot.x || c.name === plot.x)).find(c => c);
  section.x = plotted || numeric[0] || fallback || { name: "impact", unit: "", values: Array.from({ length: section.rows }, (_, i) => i + 1) };
  section.by = parameters.find(c => c !== section.x && new Set(c.values).size <= 6) || null;
  const wanted = pageData.plots.length ? pageData.plots : [...section.plotted.flatMap(plot => plot.columns), "e", "mu", "beta"];
  const behind = q => q.startsWith("outcome_") && columns[`over_${q.slice(8)}`] ? q.slice(8) : q;
  section.quantities = [...new Set(wanted.map(behind))].filter(q => columns[q] && columns[q].values.some(v => typeof v === "number"));
  section.curves = [...pageData.lines, ...section.plotted.flatMap(plot => plot.lines)];
}

// [{ key, points: [{ x, rows }] }], one for each value of `by`.
function groupsOf(section) {
  const groups = new Map();
  for (const i of finishedRows(section)) {
    const x = section.x.values[i];
    if (x == null) continue;
    const key = section.by ? section.by.values[i] : "";
    if (!groups.has(key)) groups.set(key, new Map());
    const points = groups.get(key);
    if (!points.has(x)) points.set(x, []);
    points.get(x).push(i);
  }
  const rising = (a, b) => a < b ? -1 : a > b ? 1 : 0;
  return [...groups].sort((a, b) => rising(a[0], b[0])).map(([key, points]) => ({ key,
    points: [...points].sort((a, b) => a[0] - b[0]).map(([x, rows]) => ({ x, rows })) }));
}

const describeRow = (section, i) => {
  const at = Object.values(section.columns).filter(c => c.parameter).map(c => placeText(c, i)).filter(text => text).join(", ");
  const gave = section.quantities.map(q => `${symbolOf(q)} = ${shown(section.columns[q].values[i])}`).join(", ");
  return `${at || `impact ${i + 1}`}\n${gave}${section.replays.has(i) ? "\nclick: plays this impact" : ""}`;
};

// The series of uPlot: x rising, then dots, means and lines.
function dataOf(section, quantity) {
  const tables = [], series = [{}], colours = palette();
  section.groups.forEach((group, g) => {
    const colour = colours[g % colours.length], name = section.by ? `, ${symbolOf(section.by.name)} = ${shown(group.key)}` : "";
    const stats = group.points.map(p => statisticsOf(section, quantity, p.rows));
    tables.push([group.points.map(p => p.x), stats.map(s => s.mean)]);
    series.push({ label: `mean ± standard error${name}`, stroke: colour, paths: () => null, group: g, stats, points: { show: true, size: 8, fill: colour, width: 1 } });
  });
  if (section.show.lines) {
    section.curves.filter(line => line.of === quantity && (!line.against || line.against === scriptName(section, section.x))).forEach((line, i) => {
      const sorted = line.x.map((x, k) => [x, line.y[k]]).sort((a, b) => a[0] - b[0]);
      tables.push([sorted.map(p => p[0]), sorted.map(p => p[1])]);
      series.push(line.marks ? { label: line.label, marks: true, stroke: ink(), paths: () => null, points: { show: true, size: 9, stroke: ink(), fill: "transparent", width: 1.5 } }
        : { label: line.label, stroke: ink(), width: 1.5, spanGaps: true, dash: [[], [6, 4], [2, 3], [8, 3, 2, 3]][i % 4], points: { show: false } });
    });
  }
  return { tables: uPlot.join(tables), series };
}

function dotsOf(section, quantity) {
  const values = section.columns[quantity].values, dots = [];
  section.groups.forEach((group, g) => group.points.forEach(p => p.rows.forEach(i => {
    if (values[i] != null) dots.push({ row: i, x: p.x, y: values[i], group: g });
  })));
  if (dots.length <= mostDots) return dots;
  const every = dots.length / mostDots;
  return Array.from({ length: mostDots }, (_, k) => dots[Math.floor(k * every)]);
}

// The range along y: impacts, means and marks; a line widens it by half of that at most, as it may diverge.
function yRange(dots, { tables, series }, log) {
  const [along, back] = log ? [Math.log, Math.exp] : [y => y, y => y];
  const usable = y => y != null && Number.isFinite(y) && !(log && y <= 0);
  let low = Infinity, high = -Infinity;
  const widen = (y, from = -Infinity, to = Infinity) => {
    if (usable(y)) [low, high] = [Math.min(low, Math.max(from, along(y))), Math.max(high, Math.min(to, along(y)))];
  };
  dots.forEach(dot => widen(dot.y));
  series.forEach((one, i) => {
    if (one.stats) one.stats.forEach(({ mean, se }) => [mean, mean - (se || 0), mean + (se || 0)].forEach(y => widen(y)));
    if (one.marks) tables[i].forEach(y => widen(y));
  });
  const some = low <= high, room = (high - low) / 2, [from, to] = some ? [low - room, high + room] : [-Infinity, Infinity];
  series.forEach((one, i) => { if (i > 0 && !one.stats && !one.marks) tables[i].forEach(y => widen(y, from, to)); });
  return low <= high ? [back(low), back(high)] : [0, 1];
}

// Canvas drawing above the series: dots, error bars, rings of impacts with a replay.
function drawMarks(u, section, quantity, marks) {
  const g = u.ctx, ratio = devicePixelRatio, colours = palette();
  const at = (x, y) => [u.valToPos(x, "x", true), u.valToPos(y, "y", true)];
  g.save();
  g.beginPath();
  g.rect(u.bbox.left, u.bbox.top, u.bbox.width, u.bbox.height);
  g.clip();
  g.setLineDash([]);
  if (section.show.dots) {
    g.globalAlpha = marks.dots.length > 300 ? 0.3 : 0.55;
    for (const dot of marks.dots) {
      g.fillStyle = colours[dot.group % colours.length];
      g.beginPath();
      g.arc(...at(dot.x, dot.y), 2.2 * ratio, 0, 7);
      g.fill();
    }
    g.globalAlpha = 1;
  }
  for (const series of marks.series.filter(s => s.stats)) {
    g.strokeStyle = series.stroke;
    g.lineWidth = 2 * ratio;
    section.groups[series.group].points.forEach((p, k) => {
      const { mean, se } = series.stats[k];
      if (mean == null || se == null) return;
      const low = u.scales.y.distr === 3 ? Math.max(mean - se, mean / 100) : mean - se;
      const [x, y0] = at(p.x, low), y1 = at(p.x, mean + se)[1], wide = 4 * ratio;
      g.beginPath();
      for (const [a, b, c, d] of [[x, y0, x, y1], [x - wide, y0, x + wide, y0], [x - wide, y1, x + wide, y1]]) {
        g.moveTo(a, b);
        g.lineTo(c, d);
      }
      g.stroke();
    });
  }
  for (const [row] of new Map([...section.replays, ...(section.picked == null ? [] : [[section.picked]])])) {
    const y = section.columns[quantity].values[row], x = section.x.values[row];
    if (y == null || x == null) continue;
    const picked = row === section.picked;
    g.strokeStyle = picked ? "#d7263d" : isDark() ? "#ffd166" : "#8a5a00";
    g.lineWidth = (picked ? 3 : 2) * ratio;
    g.beginPath();
    g.arc(...at(x, y), (picked ? 9 : 7) * ratio, 0, 7);
    g.stroke();
  }
  g.restore();
}

// What is under the pointer: a dot (those with a replay first), or a mean.
function underPointer(u, section, quantity, marks, event) {
  const box = u.over.getBoundingClientRect(), px = event.clientX - box.left, py = event.clientY - box.top;
  let best = null, least = 12 * 12;
  const consider = (x, y, what, weight = 1) => {
    if (y == null) return;
    const distance = ((u.valToPos(x, "x") - px) ** 2 + (u.valToPos(y, "y") - py) ** 2) * weight;
    if (distance < least) [least, best] = [distance, what];
  };
  const values = section.columns[quantity].values;
  for (const row of section.replays.keys()) consider(section.x.values[row], values[row], { row }, 0.3);
  if (best && least < 0.3 * 6 * 6) return best;  // within a ring, whatever dots lie there too
  if (section.show.dots) for (const dot of marks.dots) consider(dot.x, dot.y, { row: dot.row });
  for (const series of marks.series.filter(s => s.stats)) {
    section.groups[series.group].points.forEach((p, k) => consider(p.x, series.stats[k].mean, { stats: series.stats[k], x: p.x }, 0.7));
  }
  return best;
}

function drawPlot(section, quantity) {
  const box = section.boxes[quantity], column = section.columns[quantity], { tables, series } = dataOf(section, quantity);
  box.textContent = "";
  const marks = { series, dots: dotsOf(section, quantity) }, log = section.show.log;
  const up = powerOf(marks.dots.map(d => d.y), column.unit);
  const { x } = section, along = powerOf(x.values, x.unit), name = names[x.name] || symbolOf(x.name);
  const canLog = log && marks.dots.every(d => d.y > 0);
  const [from, to] = yRange(marks.dots, { tables, series }, canLog);
  const pad = 0.06 * (to - from) || 0.1 * Math.abs(to) || 0.1, whole = canLog ? [from / 1.1, to * 1.1] : [from - pad, to + pad];
  const u = new uPlot({ width: box.clientWidth, height: 300, title: labelOf(column, up), series, legend: keyWithDashes,
    cursor: { drag: { x: true, y: true, uni: 20 }, points: { show: false } },
    scales: { x: { time: false, range: (_, a, b) => { const pad = 0.05 * (b - a) || 1; return section.zoom ? [a, b] : [a - pad, b + pad]; } },
      y: { distr: canLog ? 3 : 1, range: (u, a, b) => u.zoomed ? [a, b] : whole } },
    axes: [axisOf(along, { label: withUnit(name, scaledUnit(x.unit, along)), labelSize: 22 }), axisOf(up, { size: axisWidth })],
    hooks: { draw: [u => drawMarks(u, section, quantity, marks)], setSelect: [u => { u.zoomed = u.select.width > 0; section.zoom = u.zoomed; }] } }, tables, box);
  u.over.addEventListener("dblclick", () => { u.zoomed = section.zoom = false; });
  u.over.addEventListener("mousemove", event => {
    const found = underPointer(u, section, quantity, marks, event);
    u.over.style.cursor = found && found.row != null ? "pointer" : "crosshair";
    if (!found) return hideTip();
    showTip(found.row != null ? describeRow(section, found.row)
      : `${symbolOf(section.x.name)} = ${shown(found.x)}: mean of ${found.stats.count}\n${symbolOf(quantity)} = ${plusMinus(found.stats)}`, event);
  });
  u.over.addEventListener("mouseleave", hideTip);
  u.over.addEventListener("click", event => {
    const found = underPointer(u, section, quantity, marks, event);
    if (found && found.row != null) pickRow(section, found.row);
  });
  const canvas = u.root.querySelector("canvas");
  canvas.setAttribute("role", "img");
  canvas.setAttribute("aria-label", `${labelOf(column)} against ${labelOf(section.x)}; the values stand in the table of means`);
  section.plots[quantity] = u;
}

function drawPlots(section) {
  for (const quantity of section.quantities) {
    if (section.plots[quantity]) section.plots[quantity].destroy();
    drawPlot(section, quantity);
  }
}

function pickRow(section, row) {
  sections.forEach(other => { other.picked = other === section ? row : null; });
  sections.forEach(other => Object.values(other.plots).forEach(u => u.redraw(false, false)));
  markRow(section, row);
  const replay = section.replays.get(row);
  section.pickedText.textContent = describeRow(section, row).split("\n").slice(0, 2).join(": ") +
    (replay ? ". Its replay is above." : ". No replay of it is kept in this page.");
  return replay ? choose(replay) : null;
}
