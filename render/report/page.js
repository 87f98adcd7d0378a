"use strict";
// Puts the page together.

// "height = 0.02 m"; of the two sides from which a lattice was struck the second alone is named.
function placeText(column, row) {
  const value = column.values[row];
  if (column.name === "pair") return "";
  if (column.name === "mirrored") return value === "true" ? "from the other side" : "";
  return `${symbolOf(column.name)} = ${shown(value)}${column.unit ? " " + pretty(column.unit) : ""}`;
}

function addReplays(section, replays) {
  section.replays = new Map();
  const hashes = section.columns.scene_hash;
  if (!hashes) return;
  const rowOf = new Map(hashes.values.map((hash, i) => [hash, i]));
  for (const replay of replays) {
    if (!rowOf.has(replay.hash)) continue;
    const row = rowOf.get(replay.hash);
    Object.assign(replay, { section, row });
    const at = Object.values(section.columns).filter(c => c.parameter);
    const vary = at.filter(c => new Set(c.values).size > 1);
    replay.title = (vary.length ? vary : at).map(c => placeText(c, row)).filter(text => text).join(", ") || `impact ${row + 1}`;
    replay.place_name = [`sweep=${section.index}`, ...vary.map(c => `${plainName(c.name)}=${c.values[row]}`)].join("&");
    section.replays.set(row, replay);
  }
}

function tools(section) {
  const box = (key, text) => {
    const input = element("input", { type: "checkbox", checked: section.show[key], onchange: () => { section.show[key] = input.checked; drawPlots(section); } });
    input.dataset.show = key;
    return element("label", {}, input, " " + text);
  };
  const isAsked = c => {
    const asked = section.columns[`over_${c.name}`];
    return asked && c.values.every((v, i) => v == null || Math.abs(v - asked.values[i]) < 1e-6 * Math.max(1, Math.abs(v)));
  };
  const choices = Object.values(section.columns).filter(c => (c.parameter || !isAsked(c)) && typeof c.values[0] === "number" && new Set(c.values).size > 1 && (c.parameter || ["psi1", "contact_time", "indentation"].includes(c.name)));
  const select = element("select", { onchange: () => {
    section.x = section.columns[select.value];
    section.groups = groupsOf(section);
    drawPlots(section);
  } }, ...choices.map(c => element("option", { value: c.name, selected: c === section.x }, symbolOf(c.name))));
  return element("div", { className: "tools" }, choices.length > 1 ? element("label", {}, "against ", select) : null, box("dots", "single impacts"),
    section.curves.length ? box("lines", "theory and published points") : null, box("log", "logarithmic"));
}

// What the units of these results mean.
function unitsMeaning(section) {
  const units = section.columns.units ? section.columns.units.values[0] : "paper";
  return units === "SI" ? "Numbers are in SI units."
    : "Units: R, the radius of the usual disk; m₀, the mass of one node of it; c, a reference speed (no speed of sound). Times are in R/c.";
}

function showSection(section) {
  const id = `section-${section.index}`, many = pageData.sections.length > 1;
  const heading = element("h2", { id }, many ? `What came out: ${section.name}` : "What came out");
  const plots = element("div", { className: "plots" });
  section.pickedText = element("p", { className: "picked" });
  section.pickedText.setAttribute("role", "status");
  section.root = element("div");
  const results = element("section");
  results.setAttribute("aria-labelledby", id);
  section.boxes = {};
  for (const quantity of section.quantities) plots.append(section.boxes[quantity] = element("div", { className: "plot" }));
  const meaning = element("p", { className: "hint" }, "e: how fast the projectile leaves along the normal, over how fast it came. μ: tangential over normal impulse. β: the same as e, of the sliding of the contact point, with its sign turned. " + unitsMeaning(section));
  if (section.quantities.length) {
    results.append(element("div", { className: "head" }, heading, tools(section)),
      element("p", { className: "hint" }, "Small dots: single impacts. Large dots: means, with bars of one standard error. Rings: impacts with a replay."),
      element("p", { className: "hint howto" }, "Point at a dot to read it, drag to zoom, double-click to undo. Click a ringed dot to play its impact."),
      plots, meaning, section.pickedText, element("h3", {}, "Means"), meansTable(section));
  } else {
    results.append(heading, element("p", {}, section.sentence), section.pickedText);
  }
  if (section.rows) results.append(rowsTable(section));
  const trust = element("section", { className: "two" }, element("div", {}, element("h2", {}, "How far to trust it"),
    element("ul", {}, ...trustLines(section).map(line => element("li", {}, line)))), element("div", {}, element("h2", {}, "Where it came from"), provenanceTable(section.provenance)));
  section.root.append(results, trust);
  byId("results").append(section.root);
  drawPlots(section);
}

function showHeader() {
  const texts = (id, list) => { byId(id).hidden = !list.length; list.forEach(text => byId(id).append(element("li", {}, text))); };
  byId("notes").hidden = !pageData.notes;
  byId("notes").textContent = pageData.notes;
  texts("questions", pageData.questions);
  for (const section of sections) {
    const done = finishedRows(section).length, name = sections.length > 1 ? `${section.name}: ` : "";
    byId("chips").append(element("li", { className: section.rows && done === section.rows ? "ok" : "bad" }, `${name}${done} of ${section.rows} finished`));
    const pressed = section.columns.over_yield ? section.columns.over_yield.values.filter(v => v > 0).length : 0;
    if (pressed) byId("chips").append(element("li", { className: "bad" }, `${name}${pressed} pressed beyond what yields`));
    const folded = section.columns.folded ? section.columns.folded.values.filter(v => v > 0).length : 0;
    if (folded) byId("chips").append(element("li", { className: "bad" }, `${name}${folded} of ${section.rows} folded: see below`));
    const closure = greatest(section.columns.energy_closure);
    if (closure >= 0) byId("chips").append(element("li", { className: closure < 1e-2 ? "ok" : "bad" }, `${name}energy balances to ${shown(closure, 2)}`));
  }
  const from = pageData.sections[0] ? pageData.sections[0].provenance : {};
  if (from.version) byId("chips").append(element("li", {}, `Ricochet ${from.version}, commit ${from.commit}`));
  if (from.start) byId("chips").append(element("li", {}, from.start.replace("T", " ").replace("Z", " UTC")));
  byId("again").textContent = from.script_name ? `ricochet run ${from.script_name} ${(from.arguments || "").trim().replaceAll("\n", " ")}` : "";
  byId("copy").onclick = () => navigator.clipboard.writeText(byId("script").textContent);
  byId("log-box").hidden = !pageData.log;
  byId("log").textContent = pageData.log;
  byId("told").textContent = pageData.sections.map(s => s.told).filter(text => text).join(" ");
}

// The replay that a link like #sweep=0&psi1=3&t=8.25 means: the one that agrees with most of it.
function linkedReplay(replays) {
  const want = Object.fromEntries(new URLSearchParams(location.hash.slice(1)));
  const agrees = replay => Object.entries(want).filter(([name, value]) => {
    if (name === "sweep") return +value === replay.section.index;
    const column = replay.section.columns[name] || replay.section.columns["over_" + name];
    return column && String(column.values[replay.row]) === value;
  }).length;
  const best = replays.reduce((a, b) => agrees(b) > agrees(a) ? b : a, replays[Math.floor((replays.length - 1) / 2)]);
  return { replay: best, time: want.t == null ? null : +want.t };
}

function redrawAll() {
  sections.forEach(drawPlots);
  if (player.replay) drawCharts();
}

async function start() {
  const began = performance.now();
  const replays = [...document.querySelectorAll("script.replay")].map(tag => JSON.parse(tag.textContent));
  for (const [index, raw] of pageData.sections.entries()) {
    const section = { ...raw, index, columns: await readColumns(raw), plotted: raw.plots, plots: {}, picked: null, show: { dots: true, lines: true, log: false } };
    axesOf(section);
    section.groups = groupsOf(section);
    addReplays(section, replays);
    sections.push(section);
  }
  showHeader();
  const known = replays.filter(replay => replay.section).sort((a, b) => a.section.index - b.section.index || a.row - b.row);
  if (!known.length && byId("told").textContent) byId("stage").before(element("p", { className: "warn" }, byId("told").textContent));
  if (known.length) {
    startPlayer(known);
    const { replay, time } = linkedReplay(known);
    replay.section.picked = replay.row;
    sections.forEach(showSection);
    await choose(replay, time);
  } else {
    sections.forEach(showSection);
  }
  redrawOnNewLook(redrawAll);
  window.report = { ready: performance.now() - began, sections, player, go, play, pickRow, readReplay };
}

start().catch(error => tellFailure(error, "report"));
