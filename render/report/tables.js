"use strict";
// Tables of means and of all rows, and what is told of accuracy and provenance.
const rowsShown = 200;

function cell(text, tag = "td") { return element(tag, tag === "th" ? { scope: "col" } : {}, text); }

function meansTable(section) {
  const table = element("table", { className: "numbers" });
  const heads = [symbolOf(section.x.name) + (section.x.unit ? ` [${section.x.unit}]` : "")];
  if (section.by) heads.push(symbolOf(section.by.name));
  heads.push("finished", ...section.quantities.flatMap(q => [`${symbolOf(q)}: mean ± standard error`, "standard deviation"]));
  table.append(element("thead", {}, element("tr", {}, ...heads.map(h => cell(h, "th")))));
  const body = element("tbody");
  for (const group of section.groups) {
    for (const point of group.points.slice(0, 500)) {
      const stats = section.quantities.map(q => statisticsOf(section, q, point.rows));
      body.append(element("tr", {}, element("th", { scope: "row" }, shown(point.x)), section.by ? cell(shown(group.key)) : null,
        cell(String(point.rows.length)), ...stats.flatMap(s => [cell(plusMinus(s)), cell(shown(s.sd, 3))])));
    }
  }
  table.append(body);
  return element("div", { className: "scroll", tabIndex: 0, role: "region", ariaLabel: `Means of ${section.name}` }, table);
}

const firstColumns = ["e", "mu", "beta", "psi1", "psi2", "vn", "vt", "omega", "contact_time", "touches", "indentation",
  "energy_closure", "certified", "folded", "error_step", "error_contact", "status", "reason", "scene_hash"];

function listedColumns(section) {
  const { columns } = section, parameters = Object.values(columns).filter(c => c.parameter);
  const rest = firstColumns.map(name => columns[name]).filter(c => c && !c.parameter && c.values.some(v => v != null && v !== ""));
  return [...parameters, ...rest];
}

// All rows, a page of them at a time; a click on a heading sorts.
function rowsTable(section) {
  const columns = listedColumns(section), table = element("table", { className: "numbers" });
  const state = { order: Array.from({ length: section.rows }, (_, i) => i), sorted: null, rising: true, from: 0 };
  const said = element("span");
  const body = element("tbody");
  const list = () => {
    body.textContent = "";
    for (const i of state.order.slice(state.from, state.from + rowsShown)) {
      const replay = section.replays.get(i);
      const playing = element("button", { onclick: event => { event.stopPropagation(); pickRow(section, i); byId("view").scrollIntoView({ block: "center" }); byId("view").focus(); } }, "▶");
      playing.setAttribute("aria-label", `Replay of impact ${i + 1}`);
      const line = element("tr", { onclick: () => pickRow(section, i) }, cell(replay ? playing : ""), ...columns.map(c => cell(shown(c.values[i], 6))));
      line.dataset.row = i;
      if (i === section.picked) line.className = "on";
      body.append(line);
    }
    said.textContent = ` impacts ${Math.min(state.from + 1, section.rows)} to ${Math.min(state.from + rowsShown, section.rows)} of ${section.rows} `;
  };
  const sortBy = column => {
    state.rising = state.sorted === column ? !state.rising : true;
    state.sorted = column;
    const sign = state.rising ? 1 : -1, v = column.values;
    state.order.sort((a, b) => v[a] === v[b] ? a - b : v[a] == null ? 1 : v[b] == null ? -1 : v[a] < v[b] ? -sign : sign);
    state.from = 0;
    list();
  };
  const head = column => {
    const button = element("button", { onclick: () => sortBy(column), title: column.doc }, withUnit(symbolOf(column.name), column.unit));
    return element("th", { scope: "col" }, button);
  };
  table.append(element("thead", {}, element("tr", {}, cell("replay", "th"), ...columns.map(head))), body);
  const turn = step => { state.from = Math.max(0, Math.min(state.from + step, rowsShown * Math.floor((section.rows - 1) / rowsShown))); list(); };
  const bar = element("p", {}, element("button", { onclick: () => saveCsv(section) }, "Save all columns as CSV"), " ",
    ...(section.rows > rowsShown ? [element("button", { onclick: () => turn(-rowsShown) }, "earlier"), said, element("button", { onclick: () => turn(rowsShown) }, "later")] : [said]));
  list();
  return element("details", { className: "allrows", open: section.rows <= 12 }, element("summary", {}, `All ${section.rows} impacts`), bar,
    element("div", { className: "scroll tall", tabIndex: 0, role: "region", ariaLabel: `All impacts of ${section.name}` }, table));
}

function markRow(section, row) {
  document.querySelectorAll(".allrows tr.on").forEach(line => line.classList.remove("on"));
  const line = section.root.querySelector(`.allrows tr[data-row="${row}"]`);
  if (line) line.classList.add("on");
}

function saveCsv(section) {
  const columns = Object.values(section.columns), rows = Array.from({ length: section.rows }, (_, i) => columns.map(c => c.values[i]));
  saveFile(`${section.name}.csv`, csvOf([columns.map(c => withUnit(c.name, c.unit)), ...rows]), "text/csv");
}

const greatest = column => column ? column.values.reduce((most, v) => v != null && Math.abs(v) > most ? Math.abs(v) : most, -Infinity) : -Infinity;

// How far a place of a replay may be off, over R: half of the coarsest grid.
const placesTo = section => Math.max(...[...section.replays.values()].map(replay => replay.grid)) / 2;

// R in the unit of the rows, by the indentation's: 1 on paper, unknown without a replay in SI.
const lengthOfR = section => {
  const replay = [...section.replays.values()][0];
  return replay ? replay.length : section.columns.units && section.columns.units.values[0] === "SI" ? Infinity : 1;
};

// At which points most impacts folded, and the mean e without them: ": at Ψ₁ = 0: 66 of 100 (e = 0.82 ± 0.01 without them, 0.76 ± 0.01 with)".
function foldedWhere(section) {
  const { folded, e } = section.columns;
  if (!e || section.by) return "";
  const points = section.groups.flatMap(g => g.points).map(p => ({ ...p, sound: p.rows.filter(i => !(folded.values[i] > 0)) }))
    .filter(p => p.sound.length < p.rows.length).sort((a, b) => a.sound.length / a.rows.length - b.sound.length / b.rows.length).slice(0, 3);
  const texts = points.map(p => `at ${symbolOf(section.x.name)} = ${shown(p.x)}: ${p.rows.length - p.sound.length} of ${p.rows.length}` +
    (p.sound.length > 1 ? ` (e = ${plusMinus(statisticsOf(section, "e", p.sound))} without them, ${plusMinus(statisticsOf(section, "e", p.rows))} with)` : ""));
  return texts.length ? `; most ${texts.join(", ")}` : "";
}

// The four parts of the error, each with what is known of it, and what did not finish and why.
function trustLines(section) {
  const { columns } = section, done = finishedRows(section), lines = [];
  const part = (name, column, nothing) => {
    const most = greatest(column);
    lines.push(`${name}: ${most >= 0 ? `estimated at up to ${shown(most, 2)}` : nothing}.`);
  };
  part("Time step", columns.error_step, "no estimate; the script chose the step and asked for no accuracy");
  part("Softness of the contact", columns.error_contact, "no estimate in these results");
  lines.push("Lattice or mesh: not estimated here; a run with twice the nodes would tell.");
  const errors = section.groups.flatMap(g => g.points.map(p => statisticsOf(section, "e", p.rows).se)).filter(s => s != null);
  lines.push(errors.length ? `Chance of the random lattices: standard errors of the mean e are up to ${shown(Math.max(...errors), 2)}; they are the bars of the plots.`
    : "Chance of the random lattices: one impact a point, so there is no error bar.");
  const closure = greatest(columns.energy_closure);
  if (closure >= 0) lines.push(`Energy: before and after agree to ${shown(closure, 2)} (relative) or better.`);
  const count = (name, test) => columns[name] ? columns[name].values.filter(test).length : null;
  const certified = count("certified", v => v === 1), folded = count("folded", v => v > 0);
  const overYield = count("over_yield", v => v > 0), deep = count("penetration", v => v > 0.01 * lengthOfR(section));
  if (certified) lines.push(`In ${certified} of ${section.rows} impacts it is certain that no node crossed the other body's rim${certified < section.rows ? "; the others were watched for it" : ""}.`);
  if (overYield) lines.push(`In ${overYield} impacts the estimated pressure passes what starts to yield, and nothing yields here: their e is too high.`);
  if (deep) lines.push(`In ${deep} impacts a node stood deeper inside the other body than a hundredth of the projectile's radius: the contact is too soft for them.`);
  if (folded) lines.push(`${folded} impacts folded triangles of a body: their numbers mean less than they say${foldedWhere(section)}.`);
  if (done.length < section.rows) {
    const reasons = new Map();
    for (let i = 0; i < section.rows; i++) {
      const status = columns.status.values[i];
      if (status === "finished") continue;
      const known = reasons.get(status) || { count: 0, why: columns.reason ? columns.reason.values[i] : "" };
      reasons.set(status, { count: known.count + 1, why: known.why });
    }
    for (const [status, { count, why }] of reasons) lines.push(`Not averaged: ${count} ended ${status.replaceAll("_", " ")}${why ? `, the first because: ${why}` : ""}.`);
  }
  if (section.mainOnly) lines.push("So many rows are kept here in single precision and with their main columns only; results.h5 has all.");
  if (section.rows > mostDots) lines.push(`Plots show ${mostDots} of the single impacts, spread evenly; means are of all.`);
  if (section.replays.size) lines.push(`Replays: places to ${shown(placesTo(section), 2)} R; between stored moments they are interpolated.`);
  return lines;
}

function provenanceTable(provenance) {
  const table = element("table", { className: "prov" });
  for (const [name, value] of Object.entries(provenance)) {
    if (!value) continue;
    const text = name === "required_files" ? value.trim().split("\n").map(l => l.split("/").at(-1)).join(", ") : value.trim();
    table.append(element("tr", {}, element("th", { scope: "row" }, name.replaceAll("_", " ")), cell(text)));
  }
  return table;
}
