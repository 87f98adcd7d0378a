"use strict";
// Plays a replay: its clock runs in simulated time. Beside it the ledger of energy, force and overlap, linked with it.
const energyParts = [["projectile_translation", "flight of the projectile"], ["projectile_rotation", "its spin"],
  ["projectile_vibration", "its deformation and vibration"], ["target_translation", "flight of the target"],
  ["target_rotation", "the target's spin"], ["target_vibration", "the target's deformation and vibration"],
  ["contact_energy", "pressed contact"], ["effects_energy", "taken by effects (friction, loss, gravity)"]];
// `closed`: only its first moment may be seen. `parts`, `forces`: names of energies and forces; `least`: share of an
// energy that is told; `tell`: what happens at a frame; `link`: a replay in the page's address.
const player = { replay: null, frames: null, at: 0, playing: false, last: 0, paint: null, charts: [], closed: false,
  parts: energyParts, forces: [["force_n", "normal force"], ["force_t", "tangential force"]], least: 1e-9,
  tell: whatHappens, link: replay => replay.place_name };
const cachedFrames = new Map();

const timesOf = replay => replay.series.time;
const shownTime = (replay, time, digits) => withPrefix(time, replay.unit.time, digits, powerOf(timesOf(replay), replay.unit.time));
function frameAt(time) {
  const times = timesOf(player.replay);
  let k = 0;
  while (k < times.length - 2 && times[k + 1] <= time) k++;
  return Math.max(0, Math.min(times.length - 1.001, k + (time - times[k]) / (times[k + 1] - times[k])));
}
function timeNow() {
  const times = timesOf(player.replay), k = Math.min(times.length - 2, Math.floor(player.at));
  return times[k] + (player.at - k) * (times[k + 1] - times[k]);
}
const energyUnit = () => player.replay.unit.total_energy;

// Forces between the moments of the frames, too: without them a peak may be missed, and touches begin late.
const forcesOf = replay => replay.forces || replay.series;

// In contact where the force is more than a thousandth of the greatest: when first and last, when it is greatest, and the
// share of it that counts. Times are null of an impact without a contact.
function contactOf(replay) {
  const { time, force_n } = forcesOf(replay), force = force_n.map(Math.abs), most = force.reduce((a, b) => Math.max(a, b), 0);
  const touching = force.map(f => most > 0 && f > 1e-3 * most), at = k => k < 0 ? null : time[k];
  return { first: at(touching.indexOf(true)), last: at(touching.lastIndexOf(true)), hardest: most > 0 ? time[force.indexOf(most)] : null, floor: 1e-3 * most };
}

function phaseAt(k) {
  const contact = contactOf(player.replay), time = timesOf(player.replay)[k];
  return contact.first == null ? "Free flight" : time < contact.first ? "Before the contact"
    : time > contact.last ? "After the contact" : Math.abs(player.replay.series.force_n[k]) > contact.floor ? "In contact" : "Between two touches";
}

// Of all energy, what deforms and shakes the bodies.
function vibrationShare(k) {
  const { series } = player.replay;
  return ((series.projectile_vibration[k] || 0) + (series.target_vibration[k] || 0)) / (series.total_energy[k] || 1);
}

function whatHappens(k) {
  const { series, unit } = player.replay, phase = phaseAt(k), way = series.vn[k] < 0 ? "approaches" : "leaves";
  const force = phase === "In contact" ? ` Contact pushes it with ${shown(series.force_n[k], 3)} ${pretty(unit.force_n)}.` : "";
  const spin = Math.abs(series.omega[k] || 0) > 1e-6 ? `, spins at ${shown(series.omega[k], 3)} ${unit.omega}` : "";
  return `${phase}. The projectile ${way} at ${shown(Math.abs(series.vn[k]), 3)} ${unit.vn} along the normal` +
    `, slides at ${shown(series.vt[k], 3)} ${unit.vt}${spin}; deformation and vibration hold ${Math.round(100 * vibrationShare(k))} % of the energy.${force}`;
}

function refresh(light) {
  const { replay, frames, paint } = player;
  drawMoment(byId("view"), paint, replay, frames, player.at, { magnify: +byId("magnify").value, field: byId("field").value });
  const times = timesOf(replay), time = timeNow(), text = `t = ${shownTime(replay, time, 4)}`;
  byId("seek").value = Math.round(1000 * (time - times[0]) / (times.at(-1) - times[0]));
  byId("seek").setAttribute("aria-valuetext", text);
  byId("clock").textContent = text;
  byId("now").textContent = player.tell(Math.round(player.at));
  placeLines();
  if (!light) history.replaceState(null, "", linkOf(replay, time));
}

function linkOf(replay, time) {
  const keep = /\bnogl\b/.test(location.hash) ? "&nogl" : "";
  return `#${player.link(replay)}&t=${+time.toPrecision(5)}${keep}`;
}

function go(frame, light) {
  player.at = Math.max(0, Math.min(player.replay.frames - 1.001, frame));
  refresh(light);
}

function play(on) {
  if (player.closed) return;
  player.playing = on;
  byId("play").textContent = on ? "❚❚" : "▶";
  byId("play").setAttribute("aria-label", on ? "Pause" : "Play");
  if (!on) return refresh();
  if (player.at > player.replay.frames - 2) player.at = 0;
  player.last = 0;
  requestAnimationFrame(tick);
}

const secondsOfAll = 10;
function tick(now) {
  if (!player.playing) return;
  const times = timesOf(player.replay), whole = times.at(-1) - times[0];
  if (player.last) {
    const time = timeNow() + (now - player.last) / 1000 * whole / secondsOfAll * +byId("rate").value;
    if (time >= times.at(-1)) {
      go(player.replay.frames - 1.001);
      return play(false);
    }
    go(frameAt(time), true);
  }
  player.last = now;
  requestAnimationFrame(tick);
}

// Line charts of series against time, with a line at the moment shown that can be dragged.
function chart(box, lines, unit, label, series = player.replay.series) {
  box.textContent = "";
  box.classList.add("draggable");
  const { replay } = player, colours = palette().concat("#888", "#555");
  const times = series.time, along = powerOf(times, replay.unit.time), up = powerOf(lines.flatMap(line => series[line[0]]), unit);
  const dashes = [[], [], [6, 4], [2, 3], [8, 3, 2, 3], [], [2, 2], [6, 2]];
  const made = new uPlot({ width: box.clientWidth, height: 210, legend: keyWithDashes,
    cursor: { y: false, drag: { setScale: false, x: false, y: false } }, scales: { x: { time: false } },
    axes: [axisOf(along, { label: withUnit("time", scaledUnit(replay.unit.time, along)), labelSize: 20 }),
      axisOf(up, { label: withUnit(label, scaledUnit(unit, up)), labelSize: 20, size: axisWidth })],
    series: [{}, ...lines.map((line, i) => ({ label: line[1], stroke: colours[i], width: times.length > 200 ? 1 : 2, dash: dashes[i], points: { show: false } }))],
    hooks: { setSize: [() => placeLines()] } }, [times, ...lines.map(line => series[line[0]])], box);
  made.nowLine = made.over.appendChild(element("div", { className: "nowline" }));
  made.root.querySelector("canvas").setAttribute("role", "img");
  made.root.querySelector("canvas").setAttribute("aria-label", `${label} against time: ${lines.map(line => line[1]).join(", ")}`);
  const seek = event => go(frameAt(made.posToVal(event.clientX - made.over.getBoundingClientRect().left, "x")));
  made.over.addEventListener("pointerdown", event => {
    play(false);
    seek(event);
    const end = new AbortController();
    addEventListener("pointermove", seek, { signal: end.signal });
    addEventListener("pointerup", () => end.abort(), { once: true });
  });
  player.charts.push(made);
}

function placeLines() {
  for (const made of player.charts) if (made.nowLine) made.nowLine.style.left = made.valToPos(timeNow(), "x") + "px";
}

function drawCharts() {
  player.charts.forEach(made => made.destroy());
  player.charts = [];
  const { series, unit } = player.replay;
  const most = Math.max(...series.total_energy.map(Math.abs)) || 1;
  const parts = player.parts.filter(([name]) => series[name].some(x => x != null && Math.abs(x) > 1e-4 * most));
  chart(byId("energy"), parts, energyUnit(), "energy");
  chart(byId("force"), player.forces, unit.force_n, "force", forcesOf(player.replay));
  if (byId("overlap")) chart(byId("overlap"), [["overlap", "how much nearer the centres are than at the first touch"]], unit.overlap, "overlap");
  placeLines();
}

function drawLedger() {
  const { series } = player.replay, last = player.replay.frames - 1, table = byId("ledger");
  const total = series.total_energy;
  table.textContent = "";
  table.append(element("caption", {}, `Energy before and after [${pretty(energyUnit())}]`));
  table.append(element("tr", {}, ...["where", "before", "after", "share after"].map(h => element("th", { scope: "col" }, h))));
  for (const [name, text] of player.parts) {
    const [before, after] = [series[name][0], series[name][last]].map(x => Math.abs(x) < player.least * Math.abs(total[0]) ? 0 : x);
    if (before === 0 && after === 0) continue;
    table.append(element("tr", {}, element("td", {}, text), element("td", {}, shown(before, 5)), element("td", {}, shown(after, 5)),
      element("td", {}, (100 * after / total[last]).toFixed(1) + " %")));
  }
  const off = Math.abs(total[last] - total[0]) / Math.abs(total[0]);
  table.append(element("tr", { className: "sum" }, element("td", {}, "all"), element("td", {}, shown(total[0], 5)),
    element("td", {}, shown(total[last], 5)), element("td", {}, `differ by ${shown(100 * off, 2)} %`)));
}

function drawStrip() {
  const { replay, frames } = player, contact = contactOf(replay), times = timesOf(replay);
  const moments = [[times[0], "start"], [contact.first, "first touch"], [contact.hardest, "greatest force"], [contact.last, "last touch"], [times.at(-1), "end"]]
    .map(([time, name]) => [time == null ? 0 : frameAt(time), name, time == null ? times[0] : time]);
  byId("strip").textContent = "";
  for (const [frame, name, time] of moments) {
    const canvas = element("canvas", { width: 380, height: 222 });
    const text = `${name}, t = ${shownTime(replay, time, 3)}`;
    byId("strip").append(element("button", { onclick: () => { play(false); go(frame); } }, canvas, element("small", {}, text)));
    drawMoment(canvas, null, replay, frames, frame, { scales: false });
  }
  return moments;
}

// Shows a replay, at a time if one is given; `closed`: its first moment alone.
async function choose(replay, time, closed = false) {
  if (player.playing) play(false);
  Object.assign(player, { wanted: replay, closed });
  if (!cachedFrames.has(replay.hash)) cachedFrames.set(replay.hash, await readReplay(replay));
  if (player.wanted !== replay) return;  // another one was chosen meanwhile
  Object.assign(player, { replay, frames: cachedFrames.get(replay.hash) });
  byId("which").textContent = replay.title;
  byId("view").setAttribute("aria-label", `Replay of the impact at ${replay.title}`);
  for (const button of byId("chooser").children) button.setAttribute("aria-pressed", button.dataset.hash === replay.hash);
  byId("collided").textContent = replay.collided;
  byId("scene").textContent = replay.scene;
  if (closed) {
    player.charts.forEach(made => made.destroy());
    player.charts = [];
    return go(0);
  }
  const moments = drawStrip();
  player.at = time == null || !Number.isFinite(time) ? moments[2][0] : frameAt(time);
  drawCharts();
  drawLedger();
  showColours(replay, player.frames, byId("field").value);
  refresh();
}

function startPlayer(replays) {
  byId("stage").hidden = false;
  byId("scene-box").hidden = false;
  for (const id of ["under", "view"]) Object.assign(byId(id), { width: 960, height: 548 });
  player.paint = makeGlPainter(byId("under"));
  for (const replay of replays) {
    const button = element("button", { onclick: () => pickRow(replay.section, replay.row) }, `▶ ${replay.title}`);
    button.dataset.hash = replay.hash;
    byId("chooser").append(button);
  }
  byId("play").onclick = byId("view").onclick = () => play(!player.playing);
  byId("seek").oninput = event => {
    if (player.playing) play(false);
    const times = timesOf(player.replay);
    go(frameAt(times[0] + event.target.value / 1000 * (times.at(-1) - times[0])));
  };
  byId("magnify").onchange = () => refresh();
  byId("field").onchange = () => {
    showColours(player.replay, player.frames, byId("field").value);
    refresh();
  };
  addEventListener("keydown", onKey);
}

function onKey(event) {
  if (player.closed || /INPUT|SELECT|BUTTON|SUMMARY|PRE/.test(event.target.tagName) || event.ctrlKey || event.altKey || event.metaKey) return;
  const actions = { " ": () => play(!player.playing), ArrowRight: () => go(Math.floor(player.at + 1e-6) + 1),
    ArrowLeft: () => go(Math.ceil(player.at - 1e-6) - 1), Home: () => go(0), End: () => go(player.replay.frames) };
  if (!actions[event.key]) return;
  event.preventDefault();
  if (event.key !== " " && player.playing) play(false);
  actions[event.key]();
}
