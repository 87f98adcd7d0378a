"use strict";
// Elements, numbers and names as people read them.
function element(tag, properties = {}, ...children) {
  const made = Object.assign(document.createElement(tag), properties);
  made.append(...children.filter(child => child != null));
  return made;
}

function shown(value, digits = 4) {
  if (value == null || typeof value === "number" && !Number.isFinite(value)) return "–";
  if (typeof value !== "number") return String(value);
  const size = Math.abs(value);
  const text = size >= 1e6 || size > 0 && size < 1e-3 ? value.toExponential(Math.min(digits, 3) - 1)
    : String(+value.toPrecision(digits));
  return text.replaceAll("-", "−");
}

// A power of ten that makes numbers of an axis readable, a multiple of 3; 0 for those that are: 20 ms, but 0.02 R.
function powerOf(values, unit) {
  const most = values.reduce((top, v) => Number.isFinite(v) ? Math.max(top, Math.abs(v)) : top, 0);
  const power = most > 0 ? Math.floor(Math.log10(most)) : 0, least = prefixed.includes(unit) ? -1 : -2;
  return power < least || power > 4 ? 3 * Math.floor(power / 3) : 0;
}
const raised = power => [..."" + power].map(c => c === "-" ? "⁻" : "⁰¹²³⁴⁵⁶⁷⁸⁹"[c]).join("");
// "µs", "10⁻⁶ m/s"
const prefixes = { "-9": "n", "-6": "µ", "-3": "m", 3: "k", 6: "M", 9: "G" };
const prefixed = ["s", "m", "N", "J", "Pa"];
const takesPrefix = (unit, power) => power in prefixes && prefixed.includes(unit);
const scaledUnit = (unit, power) => !power ? unit : takesPrefix(unit, power) ? prefixes[power] + unit
  : `10${raised(power)} ${unit || ""}`.trim();
// "2.5 ms", "13.6 R/c": of a list's power of ten, so that all of it is told in one unit.
function withPrefix(value, unit, digits, power) {
  return takesPrefix(unit, power) ? `${shown(value / 10 ** power, digits)} ${prefixes[power]}${unit}` : `${shown(value, digits)} ${unit}`;
}

// An axis of uPlot whose neighbouring marks are told apart, in units of 10^power.
function axisOf(power, properties) {
  const decimals = step => {
    let count = 0;
    while (count < 12 && Math.abs(Math.round(step * 10 ** count) - step * 10 ** count) > 1e-6 * step * 10 ** count) count++;
    return count;
  };
  const values = (u, splits) => {
    const known = splits.filter(v => v != null), step = Math.abs(known[1] - known[0]) / 10 ** power || 1;
    const even = known.every((v, i) => i === 0 || Math.abs((v - known[i - 1]) / 10 ** power - step) < 1e-6 * step);
    return splits.map(v => v == null ? "" : even ? (v / 10 ** power).toFixed(decimals(step)).replace("-", "−") : shown(v / 10 ** power, 3));
  };
  return { stroke: ink(), grid: { stroke: gridInk() }, ticks: { stroke: gridInk() }, values, ...properties };
}
const axisWidth = (u, marks) => Math.max(56, 20 + 7.5 * Math.max(0, ...(marks || []).map(mark => mark.length)));

const isDark = () => matchMedia("(prefers-color-scheme: dark)").matches && !document.documentElement.classList.contains("print");
const ink = () => isDark() ? "#e6eaf0" : "#1c2430";
const gridInk = () => isDark() ? "#2e3641" : "#e6eaee";

// Okabe and Ito's, told apart by the colour-blind; the darker ones for white, the lighter ones for black.
const palette = () => isDark() ? ["#6cb4f5", "#f0a860", "#5fd0ac", "#e6a3cc", "#f0e060", "#8fd3f5"]
  : ["#0b5fa5", "#b3541e", "#00795a", "#a6437c", "#7a6a00", "#3b3b98"];

const names = { e: "coefficient of restitution e", mu: "impulse ratio μ", beta: "tangential restitution β",
  over_psi1: "Ψ₁ (tangent of the angle of incidence)", psi1: "Ψ₁ of the contact (with the spin)", psi2: "Ψ₂ (of the contact point's rebound)",
  vn: "normal velocity after", vt: "tangential velocity after", omega: "spin after", contact_time: "contact time",
  indentation: "greatest indentation", energy_closure: "relative error of the energy balance",
  touches: "number of touches", status: "how it ended", wall_seconds: "computing time",
  certified: "certified: no node can have crossed the other rim", time: "time", speed: "speed of the impact" };
const symbols = { e: "e", mu: "μ", beta: "β", over_psi1: "Ψ₁", psi1: "Ψ₁ of the contact", over_step: "step asked for",
  seed: "seed of the projectile", psi2: "Ψ₂", omega: "ω", vn: "vₙ", vt: "vₜ" };
// A sweep's own values that have the name of another column are over_NAME; to scripts they are NAME, and it outcome_NAME.
const plainName = name => /^over_(psi1|seed|step|units)$/.test(name) ? name.slice(5) : name;
const scriptName = (section, column) => column.parameter ? plainName(column.name)
  : section.columns[`over_${column.name}`] ? `outcome_${column.name}` : column.name;
const symbolOf = name => symbols[name] || plainName(name).replaceAll("_", " ");
// "m0 c^2/R" as it is printed.
const pretty = unit => unit.replaceAll("m0", "m₀").replaceAll("^2", "²").replaceAll("^3", "³");
const withUnit = (text, unit) => unit ? `${text} [${pretty(unit)}]` : text;
const labelOf = (column, power = 0) =>
  withUnit(names[column.name] || symbolOf(column.name), scaledUnit(column.unit, power));

// Mean, standard deviation and standard error of what is defined.
function statistics(values) {
  const known = values.filter(v => v != null);
  const count = known.length;
  if (count === 0) return { count, mean: null, sd: null, se: null };
  const mean = known.reduce((sum, v) => sum + v, 0) / count;
  if (count === 1) return { count, mean, sd: null, se: null };
  const sd = Math.sqrt(known.reduce((sum, v) => sum + (v - mean) ** 2, 0) / (count - 1));
  return { count, mean, sd, se: sd / Math.sqrt(count) };
}

const plusMinus = s => s.mean == null ? "–" : s.se == null ? `${shown(s.mean, 6)}` : `${shown(s.mean)} ± ${shown(s.se, 2)}`;

// Leaves a file with the reader.
function saveFile(name, text, type) {
  const link = element("a", { href: URL.createObjectURL(new Blob([text], { type })), download: name });
  link.click();
  URL.revokeObjectURL(link.href);
}
// The first line names the columns.
function csvOf(lines) {
  const quoted = text => /[,"\n]/.test(text) ? `"${text.replaceAll('"', '""')}"` : text;
  return lines.map(line => line.map(value => quoted(String(value ?? ""))).join()).join("\n") + "\n";
}

function showTip(text, event) {
  const tip = byId("tip");
  tip.textContent = text;
  tip.hidden = false;
  tip.style.left = Math.max(4, Math.min(innerWidth - tip.offsetWidth - 8, event.clientX + 14)) + "px";
  tip.style.top = Math.max(4, Math.min(innerHeight - tip.offsetHeight - 8, event.clientY + 14)) + "px";
}
const hideTip = () => { byId("tip").hidden = true; };

// Calls what draws when the window's width, the colours, or the medium change.
function redrawOnNewLook(redraw) {
  let width = innerWidth, waiting;
  addEventListener("resize", () => {
    if (innerWidth === width) return;
    width = innerWidth;
    clearTimeout(waiting);
    waiting = setTimeout(redraw, 120);
  });
  matchMedia("(prefers-color-scheme: dark)").addEventListener("change", redraw);
  addEventListener("beforeprint", () => { document.documentElement.classList.add("print"); redraw(); });
  addEventListener("afterprint", () => { document.documentElement.classList.remove("print"); redraw(); });
}

function tellFailure(error, page) {
  document.body.prepend(element("p", { className: "warn" }, `This ${page} could not be drawn: ${error.message} (a browser of 2023 or later is needed)`));
  throw error;
}

// Keys of plots tell dashes as their lines do.
const keyWithDashes = { live: false, markers: { width: 2, dash: (u, i) => {
  const dash = u.series[i].dash || [];
  return !dash.length ? "solid" : dash[0] < 4 ? "dotted" : "dashed";
} } };
