"use strict";
// A lesson: a setting is chosen with sliders, its result guessed and then shown. What was tried stands in the graph, in the
// link, and in a copy of the page.
const triesBefore = 5;  // what many people think is named once a pupil has had a chance to find out
const pristine = document.documentElement.outerHTML;
const lesson = pageData.lesson, grid = pageData.sections[0];
const asked = lesson.results[lesson.guess.result];
const tried = [];  // { row, guess } in the order of trying; guess is null where none was made
const replays = new Map([...document.querySelectorAll("script.replay")].map(tag => JSON.parse(tag.textContent)).map(r => [r.hash, r]));
const doubts = [];  // of impacts, once the columns are read
let place = lesson.sliders.map(() => 0), hashes = [], hasGuessed = false;

const rowOf = wanted => lesson.places.findIndex(at => at.every((k, i) => k === wanted[i]));
const rowNow = () => rowOf(place);
const tryOf = row => tried.find(t => t.row === row);
// With the decimals of its column, as the answers have it; without a sign if nothing is left of it.
function numberText(value, result) {
  if (value == null) return "–";
  const text = value.toFixed(result.decimals);
  return (/[1-9]/.test(text) ? text : text.replace("-", "")).replace("-", "−");
}
const joinUnit = (text, unit) => `${text}${unit ? (unit.startsWith("°") ? "" : " ") + unit : ""}`;
const withUnitOf = (result, value) => joinUnit(numberText(value, result), result.unit);
const valueText = (slider, k) => joinUnit(slider.texts[k], slider.unit);
const placeText = row => lesson.sliders.map((s, i) => `${s.label} ${valueText(s, lesson.places[row][i])}`).join(", ");

// A text whose numbers were read from the impacts; each of those says which.
function fill(box, parts) {
  box.replaceChildren(...parts.map(part => {
    if (typeof part === "string") return part;
    const number = element("span", { className: "number", title: `${part.of} of impact ${part.hash}` }, part.text);
    Object.assign(number.dataset, { hash: part.hash, of: part.of });
    return number;
  }));
  return box;
}
const paragraphs = (box, list) => box.append(...list.map(parts => fill(element("p"), parts)));

function stateText() {
  const at = lesson.sliders.map((s, i) => `${encodeURIComponent(s.of)}=${encodeURIComponent(s.values[place[i]])}`);
  return [...at, ...(tried.length ? [`tried=${tried.map(t => `${t.row + 1}${t.guess == null ? "" : ":" + t.guess}`).join()}`] : [])].join("&");
}

// The time that the state names. What it says wrongly is passed over.
function readState(text) {
  const want = new URLSearchParams(text);
  lesson.sliders.forEach((s, i) => {
    const k = s.values.findIndex(value => String(value) === want.get(s.of));
    if (k >= 0) place[i] = k;
  });
  for (const entry of (want.get("tried") || "").split(",")) {
    const [row, guess] = entry.split(":"), index = Number(row) - 1;
    if (!lesson.places[index] || tryOf(index)) continue;
    const value = guess === undefined || !Number.isFinite(+guess) ? null : Math.max(lesson.guess.from, Math.min(lesson.guess.to, +guess));
    tried.push({ row: index, guess: value });
    if (value != null) hasGuessed = true;
  }
  return want.has("t") && Number.isFinite(+want.get("t")) ? +want.get("t") : null;
}

function lessonTells(k) {
  const { series, unit } = player.replay, [body] = lesson.names;
  const fastest = Math.max(...series.vn.map((v, i) => Math.hypot(v, series.vt[i]))) || 1, little = 0.03 * fastest;
  const speed = (value, up, down) => Math.abs(value) < little ? "" : `${value < 0 ? down : up} at ${shown(Math.abs(value), 3)} ${unit.vn}`;
  const moves = [speed(series.vn[k], "up", "down"), speed(series.vt[k], "right", "left")].filter(text => text);
  const omega = Math.abs(series.omega[k]), rim = omega * bodyRadius(player.replay, player.frames) * player.replay.length;
  const spins = rim < little ? "" : unit.omega === "1/s" ? `, and makes ${shown(omega / (2 * Math.PI), 2)} turns a second` : `, and turns at ${shown(omega, 2)} ${unit.omega}`;
  const phase = { "Before the contact": "Before the touch", "After the contact": "After the touch", "In contact": "They touch" }[phaseAt(k)] || phaseAt(k);
  const force = phase === "They touch" ? ` The force between them is ${shown(Math.hypot(series.force_n[k], series.force_t[k]), 2)} ${pretty(unit.force_n)}.` : "";
  return `${phase}. The ${body} moves ${moves.join(" and ") || "hardly at all"}${spins}. Squash and wobble hold ${Math.round(100 * vibrationShare(k))} % of the energy.${force}`;
}

function namePlayer() {
  const [body, other] = lesson.names;
  document.querySelectorAll(".body-name").forEach(span => { span.textContent = body; });
  player.parts = [["projectile_translation", `movement of the ${body}`], ["projectile_rotation", `spin of the ${body}`],
    ["projectile_vibration", `squash and wobble of the ${body}`], ["target_translation", `movement of the ${other}`],
    ["target_rotation", `spin of the ${other}`], ["target_vibration", `squash and wobble of the ${other}`],
    ["contact_energy", "squeezed between them"], ["effects_energy", "taken by friction"]];
  player.forces = [["force_n", `straight off the ${other}`], ["force_t", `along the ${other}`]];
  player.least = 5e-4;
  player.tell = lessonTells;
  player.link = stateText;
}

// Shows the setting of the sliders: its first moment, or all of it once it was tried.
async function present(time = null) {
  const row = rowNow(), done = tryOf(row), replay = replays.get(hashes[row]);
  lesson.sliders.forEach((s, i) => {
    const input = byId(`slider-${i}`), text = valueText(s, place[i]);
    input.value = place[i];
    input.setAttribute("aria-valuetext", text);
    byId(`value-${i}`).textContent = text;
  });
  byId("count").replaceChildren(`Setting ${row + 1} of ${lesson.places.length}, ${tried.length} tried. Impact `, element("code", { id: "hash", title: hashes[row] }, hashes[row].slice(0, 8)));
  byId("ask").hidden = Boolean(done);
  for (const id of ["result", "after"]) byId(id).hidden = !done;
  for (const bar of document.querySelectorAll("#stage .bar")) bar.hidden = !done;
  byId("waiting").hidden = Boolean(done);
  byId("intuition").hidden = tried.length < Math.min(triesBefore, lesson.places.length);
  byId("next").hidden = tried.length === lesson.places.length;
  byId("more").hidden = byId("next").hidden || !countsTries();
  byId("said").textContent = !done ? "" : done.guess == null ? `${asked.label}: ${withUnitOf(asked, asked.values[row])}.`
    : `You guessed ${withUnitOf(asked, done.guess)}. It was ${withUnitOf(asked, asked.values[row])}.`;
  const careful = doubts.filter(doubt => done && doubt.rows.has(row)).map(doubt => doubt.text);
  byId("careful").hidden = !careful.length;
  byId("careful").textContent = `Careful: here ${careful.join("; and ")}.`;
  if (done) byId("result").replaceChildren(element("table", {}, ...lesson.results.map(r => element("tr", {}, element("th", { scope: "row" }, r.label), element("td", {}, withUnitOf(r, r.values[row]))))));
  drawGraph();
  drawTries();
  await choose(replay, done ? time : null, !done);
}

function drawTries() {
  const heads = ["try", ...lesson.sliders.map(s => withUnit(s.label, s.unit)), "your guess", withUnit(asked.label, asked.unit)];
  byId("tries-box").hidden = !tried.length;
  byId("tries").replaceChildren(element("thead", {}, element("tr", {}, ...heads.map(text => element("th", { scope: "col" }, text)))),
    element("tbody", {}, ...tried.map(({ row, guess }, i) => element("tr", { className: row === rowNow() ? "on" : "" }, element("td", {}, String(i + 1)),
      ...lesson.sliders.map((s, k) => element("td", {}, s.texts[lesson.places[row][k]])), element("td", {}, guess == null ? "–" : numberText(guess, asked)),
      element("td", {}, numberText(asked.values[row], asked))))));
  byId("mean").hidden = !countsTries() || tried.length < 2;
  const { mean, sd, se } = statistics(tried.map(t => asked.values[t.row])), unit = asked.unit;
  byId("mean").textContent = `After ${tried.length} tries: mean ${withUnitOf(asked, mean)}, standard error ${joinUnit(shown(se, 2), unit)}. Single tries scatter by ${joinUnit(shown(sd, 2), unit)}.`;
}

function goTo(row) {
  place = [...lesson.places[row]];
  return present();
}

async function letGo(guess) {
  const row = rowNow();
  if (!tryOf(row)) tried.push({ row, guess });
  await present(replays.get(hashes[row]).series.time[0]);
  if (innerWidth <= 980) byId("stage").scrollIntoView();  // where the sections stand below each other
  if (!matchMedia("(prefers-reduced-motion: reduce)").matches) play(true);
}

const untried = () => lesson.places.findIndex((_, row) => !tryOf(row));

function startSetup() {
  byId("question").textContent = lesson.guess.question;
  lesson.sliders.forEach((s, i) => {
    const input = element("input", { id: `slider-${i}`, type: "range", min: 0, max: s.values.length - 1, step: 1,
      oninput: () => { place[i] = +input.value; present(); } });
    byId("sliders").append(element("div", { className: "slider" }, element("label", { htmlFor: input.id }, s.label), element("output", { id: `value-${i}`, htmlFor: input.id }), input));
  });
  const guess = byId("guess"), { from, to, step } = lesson.guess;
  Object.assign(guess, { min: from, max: to, step, value: (from + to) / 2 });
  const say = () => {
    const text = hasGuessed ? withUnitOf(asked, +guess.value) : "?";
    byId("guessed").textContent = text;
    guess.setAttribute("aria-valuetext", hasGuessed ? text : "no guess yet");
  };
  guess.oninput = () => { hasGuessed = true; say(); };
  say();
  byId("go").onclick = () => {
    if (!hasGuessed) {
      byId("said").textContent = "Move the slider to your guess first.";
      return guess.focus();
    }
    return letGo(+guess.value);
  };
  byId("next").onclick = async () => {
    await goTo(untried());
    byId("go").focus();
  };
  byId("more").onclick = () => {
    for (let k = 0; k < 4 && untried() >= 0; k++) {
      place = [...lesson.places[untried()]];
      tried.push({ row: rowNow(), guess: null });
    }
    return present();
  };
}

function startTexts() {
  byId("minutes").textContent = lesson.minutes;
  paragraphs(byId("intro"), lesson.intro);
  fill(byId("wrong"), lesson.intuition.wrong);
  fill(byId("right"), lesson.intuition.right);
  byId("questions").append(...lesson.questions.map(q => element("li", {}, fill(element("div"), q.ask),
    element("details", {}, element("summary", {}, "Answer"), fill(element("p"), q.answer)))));
  paragraphs(byId("teacher-text"), lesson.teacher);
  const from = grid.provenance, lines = [`The script states ${shown(lesson.processor_time)} s of one processor core for its ${grid.rows} impacts and their replays.`,
    from.version ? `Ricochet ${from.version}, commit ${from.commit}: ricochet run ${from.script_name} ${(from.arguments || "").trim().replaceAll("\n", " ")}` : ""];
  byId("made").textContent = lines.join(" ");
}

// What the columns of the rows doubt, as the report has it: { text, rows }.
function findDoubts(columns) {
  const radius = row => replays.get(hashes[row]).length;
  const kinds = [["over_yield", v => v > 0, "the pressure passes what starts to yield, and nothing yields in the computation: the rebound is too fast"],
    ["penetration", (v, row) => v > 0.01 * radius(row), `a body stood deeper inside the other than a hundredth of the radius of the ${lesson.names[0]}: the contact is too soft`],
    ["folded", v => v > 0, "a body folded over itself, which takes energy that no solid would: the numbers mean less than they say"]];
  for (const [name, test, text] of kinds) {
    const rows = new Set(hashes.keys());
    for (const row of rows) if (!columns[name] || !test(columns[name].values[row], row)) rows.delete(row);
    if (rows.size) doubts.push({ text, rows });
  }
  byId("doubts").hidden = !doubts.length;
  byId("doubts").querySelector("ul").append(...doubts.map(({ text, rows }) => element("li", {}, `In ${rows.size} of ${hashes.length} impacts ${text}.`)));
  byId("log-box").hidden = !pageData.log;
  byId("log").textContent = pageData.log;
}

function startKeeping() {
  byId("save").onclick = () => {
    const root = element("html", { lang: "en" });
    root.dataset.state = linkOf(player.replay, timeNow()).slice(1);
    const open = root.outerHTML.replace("</html>", "");
    saveFile("lesson.html", `<!doctype html>\n${pristine.replace(/^<html[^>]*>/, () => open)}`, "text/html");
  };
  byId("csv").onclick = () => saveFile("my_points.csv", csvOf([
    ["try", ...lesson.sliders.map(s => withUnit(s.label, s.unit)), `guess of ${withUnit(asked.label, asked.unit)}`, ...lesson.results.map(r => withUnit(r.label, r.unit)), "impact"],
    ...tried.map(({ row, guess }, i) => [i + 1, ...lesson.sliders.map((s, k) => s.values[lesson.places[row][k]]), guess, ...lesson.results.map(r => r.values[row]), hashes[row]])]), "text/csv");
  byId("again").onclick = () => {
    tried.length = 0;
    return present();
  };
  byId("all").onclick = () => {
    lesson.places.forEach((_, row) => { if (!tryOf(row)) tried.push({ row, guess: null }); });
    return present();
  };
}

function redrawAll() {
  drawGraph();
  if (tryOf(rowNow())) drawCharts();
}

async function start() {
  const began = performance.now();
  const columns = await readColumns(grid);
  hashes = columns.scene_hash.values;
  const time = readState(location.hash.slice(1) || document.documentElement.dataset.state || "");
  for (const [row, hash] of hashes.entries()) Object.assign(replays.get(hash), { section: grid, row, title: placeText(row) });
  namePlayer();
  findDoubts(columns);
  startTexts();
  startSetup();
  startKeeping();
  startPlayer([]);
  await present(time);
  redrawOnNewLook(redrawAll);
  window.report = { ready: performance.now() - began, lesson, tried, hashes, player, graph, go, play, present };
}

start().catch(error => tellFailure(error, "lesson"));
