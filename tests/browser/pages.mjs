// Opens reports and lessons in a browser as a reader does. Usage: node pages.mjs PROGRAM [PICTURES_FOLDER]
// Every check is a line; the first that fails ends the test with 1.
import { chromium } from "playwright-core";
import { execFileSync } from "node:child_process";
import { mkdirSync, mkdtempSync, readFileSync, rmSync, statSync, writeFileSync } from "node:fs";
import { createRequire } from "node:module";
import { tmpdir } from "node:os";
import { join } from "node:path";
import { pathToFileURL } from "node:url";
import { lessons } from "./lessons.mjs";

const [program, pictures] = process.argv.slice(2);
const axe = readFileSync(createRequire(import.meta.url).resolve("axe-core/axe.min.js"), "utf8");
const work = mkdtempSync(join(tmpdir(), "ricochet pages äö "));  // blanks and umlauts in every address
if (pictures) mkdirSync(pictures, { recursive: true });

function check(good, what) {
  if (!good) throw new Error(`not so: ${what}`);
  console.log(`ok: ${what}`);
}

// Runs a script here; the folder of its report.
function run(name, text, ...options) {
  writeFileSync(join(work, `${name}.lua`), text);
  try {
    execFileSync(program, ["run", `${name}.lua`, "--quiet", ...options], { cwd: work, stdio: ["ignore", "ignore", "pipe"] });
  } catch (error) {
    if (error.status !== 3) throw error;  // not one impact finished
  }
  return join(work, "out", name);
}

const browser = await chromium.launch({ executablePath: "/usr/bin/chromium",
  args: ["--no-sandbox", "--disable-gpu", "--enable-unsafe-swiftshader", "--use-angle=swiftshader"] });

// Opens a page, and watches its console and its requests.
async function open(file, { hash = "", scheme = "light", width = 1360, height = 1000 } = {}) {
  const context = await browser.newContext({ viewport: { width, height }, colorScheme: scheme });
  const page = await context.newPage();
  const heard = [], asked = [];
  page.on("console", m => /GL Driver Message|GPU stall/.test(m.text()) || heard.push(`${m.type()}: ${m.text()}`));
  page.on("pageerror", e => heard.push(`error: ${e.message}`));
  page.on("request", r => asked.push(r.url()));
  const began = Date.now();
  await page.goto(pathToFileURL(file).href + hash);
  await until(page, "window.report !== undefined");
  page.took = Date.now() - began;
  page.silent = what => {
    check(heard.length === 0, `${what}: the console is silent ${heard.slice(0, 2).join("; ")}`);
    check(asked.filter(url => !url.startsWith("blob:")).length === 1, `${what}: nothing but the file is asked for`);
  };
  return page;
}

// Until an expression is true in the page. (Playwright's own way of waiting is refused by the page's security policy.)
async function until(page, expression) {
  const end = Date.now() + 60000;
  while (!await page.evaluate(expression)) {
    if (Date.now() > end) throw new Error(`not so within a minute: ${expression}`);
    await new Promise(done => setTimeout(done, 20));
  }
}

// What axe finds wrong.
async function faults(page) {
  await page.evaluate(axe);
  const found = await page.evaluate("axe.run()");
  return found.violations.map(v => `${v.id} (${v.nodes.length}): ${v.nodes[0].html.slice(0, 120)}`);
}

const pixels = (page, selector) => page.locator(selector).screenshot().then(bytes => bytes.toString("base64"));

function readCsv(file) {
  const [head, ...lines] = readFileSync(file, "utf8").trim().split("\n").map(line => line.match(/("([^"]|"")*"|[^,]*)(,|$)/g).slice(0, -1)
    .map(cell => cell.replace(/,$/, "").replace(/^"|"$/g, "").replaceAll('""', '"')));
  return { names: head.map(h => h.replace(/ \[.*\]$/, "")), lines };
}

const scene = (projectile, target, launch) => `return ricochet.scene { projectile = ${projectile}, target = ${target}, launch = ${launch} }`;
const lattices = `-- A hard disk on a soft wall.
local ricochet = require "ricochet"
local sweep = ricochet.sweep { name = "angles", over = { sample = ricochet.range(9), psi1 = { 0, 1, 3 } }, scene = function(at)
  return ricochet.scene { projectile = ricochet.disk { nodes = 200, roughness = 0.03, seed = at.sample },
    target = ricochet.wall { nodes = 800, stiffness = 100, roughness = 0.03, seed = at.sample },
    launch = { speed = 0.1, psi1 = at.psi1 }, accuracy = 1e-2 } end }
local rows = sweep:run()
ricochet.plot { rows = rows, x = "psi1", y = { "e", "contact_time" }, name = "plotted",
  theory = { contact_time = { { name = "a guessed line", f = function(x) return 9 + x / 2 end } },
    e = { { name = "a line that diverges", f = function(x) return 1 / (3.001 - x) end } } },
  published = { e = { { name = "somebody's points", points = { { 0.5, 0.8 }, { 2, 0.85 } } } } } }
ricochet.report { notes = "Soft walls give back slowly.", questions = { "Where is e greatest?" },
  lines = { { of = "mu", label = "rigid friction", x = { 0, 3 }, y = { 0, 0.3 } } } }
`;

async function wholeReport() {
  const folder = run("angles", lattices), file = join(folder, "report.html");
  check(statSync(file).size < 8e6, `a report of 27 impacts has ${statSync(file).size} bytes`);
  const page = await open(file);
  console.log(`   ready after ${page.took} ms`);
  page.silent("a report of a sweep");
  check((await page.locator("h1").textContent()) === "A hard disk on a soft wall", "the title is the script's first line");
  check(/27 of 27 impacts finished/.test(await page.locator(".lead").textContent()), "the sentence counts the impacts");
  const found = await faults(page);
  check(found.length === 0, `axe finds no fault ${found.join("; ")}`);

  const { names, lines } = readCsv(join(work, "out/angles/results.csv"));
  const columns = await page.evaluate("Object.fromEntries(Object.values(report.sections[0].columns).map(c => [c.name, c.values]))");
  let compared = 0;
  for (let k = 0; k < 50; k++) {
    const row = k * 5 % lines.length, c = k * 7 % names.length, text = lines[row][c], value = columns[names[c]][row];
    check((value == null ? "" : String(value)) === (typeof value === "number" ? String(+text) : text), `cell ${names[c]} of row ${row + 1} is ${text || "empty"}`);
    compared++;
  }
  check(compared === 50, "50 cells of the page equal the results");
  await seesPoints(page);
  await playsByKeyboard(page);
  await linesLeaveRoom(page);
  await togglesChangePixels(page);
  await looksRight(page, "desktop");
  await page.context().close();

  const bare = await open(file, { hash: "#psi1=0&t=2&nogl" });
  bare.silent("a report without WebGL");
  check(await bare.evaluate("report.player.paint === null"), "it draws by paths");
  check(/Ψ₁ = 0/.test(await bare.locator("#which").textContent()) && /t = 2 /.test(await bare.locator("#clock").textContent()), "the link leads to its impact and time");
  await bare.context().close();

  for (const [name, options] of [["phone", { width: 390, height: 844 }], ["dark", { scheme: "dark" }]]) {
    const other = await open(file, options);
    other.silent(name);
    check(await other.evaluate("document.documentElement.scrollWidth <= innerWidth"), `${name}: nothing is wider than the window`);
    const wrong = await faults(other);
    check(wrong.length === 0, `${name}: axe finds no fault ${wrong.join("; ")}`);
    if (pictures) await other.screenshot({ path: join(pictures, `${name}.png`), fullPage: true });
    if (pictures && name === "phone") await other.screenshot({ path: join(pictures, "phone-top.png") });
    await other.context().close();
  }
  const before = readFileSync(file);
  const again = () => execFileSync(program, ["report", "out", "--out", "again.html"], { cwd: work }) && readFileSync(join(work, "again.html"), "utf8");
  const first = again();
  check(first === again(), "the same results give the same bytes");
  check((first.match(/class="replay"/g) || []).length === (before.toString().match(/class="replay" id/g) || []).length, "ricochet report keeps the replays");
}

// Hovers over dots and clicks a ringed one.
async function seesPoints(page) {
  const spots = await page.evaluate(`(() => { const s = report.sections[0], u = s.plots.e; u.over.scrollIntoView({ block: "center" }); const b = u.over.getBoundingClientRect();
    return s.columns.e.values.map((y, row) => ({ row, x: b.left + u.valToPos(s.x.values[row], "x"), y: b.top + u.valToPos(y, "y"), e: y, ringed: s.replays.has(row) })); })()`);
  let read = 0;
  const rows = await page.evaluate(`(() => { const c = report.sections[0].columns, short = e => String(+e.toPrecision(4));
    return c.e.values.map((e, row) => ({ place: \`${"${c.over_psi1.values[row]}"}, sample = ${"${c.sample.values[row]}"}\`, e: short(e) })); })()`);
  for (const spot of spots) {
    await page.mouse.move(spot.x, spot.y);
    const tip = await page.locator("#tip").textContent(), isMean = /mean of/.test(tip);
    const own = rows.find(row => tip.split("\n")[0].endsWith(`= ${row.place}`));
    check(await page.locator("#tip").isVisible() && (isMean || own && tip.includes(`e = ${own.e},`)), `hover tells of impact ${spot.row + 1}: ${tip.split("\n")[1]}`);
    read += !isMean;
  }
  check(read >= 20, `${read} points tell their own values`);
  for (const spot of spots.filter(s => s.ringed)) {
    await page.mouse.move(spot.x, spot.y);
    const told = await page.locator("#tip").textContent();
    check(told.includes(`e = ${+spot.e.toPrecision(4)}`), `the ringed impact ${spot.row + 1} tells its own e: ${told.split("\n")[1]}, ${spot.e}`);
  }
  const before = await page.locator("#which").textContent(), ledger = await page.locator("#ledger").textContent();
  const current = await page.evaluate("report.player.replay.row"), other = spots.find(s => s.ringed && s.row !== current);
  await page.mouse.click(other.x, other.y);
  await until(page, `report.player.replay.row === ${other.row}`);
  check(before !== await page.locator("#which").textContent() && ledger !== await page.locator("#ledger").textContent(), "a click on a ringed impact changes replay and ledger");
}

async function playsByKeyboard(page) {
  await page.evaluate("document.activeElement.blur(); scrollTo(0, 0)");
  for (let k = 0; k < 40 && await page.evaluate("document.activeElement.id") !== "view"; k++) await page.keyboard.press("Tab");
  check(await page.evaluate("document.activeElement.id") === "view", "Tab reaches the replay");
  await page.keyboard.press("Home");
  const start = await page.locator("#clock").textContent();
  await page.keyboard.press("ArrowRight");
  const step = await page.locator("#clock").textContent();
  await page.keyboard.press("End");
  const end = await page.locator("#clock").textContent();
  check(start !== step && step !== end, `Home, right and End step the replay: ${start}, ${step}, ${end}`);
  await page.keyboard.press("Home");
  const shown = await pixels(page, "#view");
  await page.keyboard.press(" ");
  await until(page, "report.player.at > 3");
  await page.keyboard.press(" ");
  check(!await page.evaluate("report.player.playing") && shown !== await pixels(page, "#view"), "space plays and stops");
}

// A line that goes to 1000 leaves the picture instead of flattening the impacts.
async function linesLeaveRoom(page) {
  const [low, high, least, most] = await page.evaluate(`(() => {
    const { min, max } = sections[0].plots.e.scales.y, e = sections[0].columns.e.values;
    return [min, max, Math.min(...e), Math.max(...e)];
  })()`);
  const span = most - least;
  check(low <= least && high >= most + 0.5 * span && high < most + 0.8 * span, `a diverging line widens e's range of ${least} to ${most} to ${low} to ${high}`);
}

async function togglesChangePixels(page) {
  const legends = (await page.locator(".plots .u-legend").allTextContents()).join();
  check(["rigid friction", "a guessed line", "somebody's points"].every(label => legends.includes(label)), "lines of theory and published points of the script's plots are there");
  check(await page.locator(".plots .plot").count() === 4, "a column that the script plotted has a plot beside e, mu and beta");
  for (const [key, plot] of [["dots", 0], ["log", 0], ["lines", 2]]) {
    const selector = `.plots .plot >> nth=${plot}`, box = page.locator(`input[data-show=${key}]`), before = await pixels(page, selector);
    await box.click();
    check(before !== await pixels(page, selector), `"${key}" changes the plot`);
    await box.click();
  }
  const view = await pixels(page, ".screen");
  await page.locator("#field").selectOption("shift");
  check(view !== await pixels(page, ".screen"), "the colour of choice changes the replay");
  await page.locator("#field").selectOption("speed");
}

async function looksRight(page, name) {
  await page.evaluate("scrollTo(0, 0)");
  await page.evaluate("report.go(report.player.replay.frames * 0.45)");
  if (pictures) {
    await page.screenshot({ path: join(pictures, `${name}-top.png`) });
    await page.screenshot({ path: join(pictures, `${name}.png`), fullPage: true });
  }
  await page.emulateMedia({ media: "print" });
  const plots = await page.locator(".plots canvas").count();
  for (let k = 0; k < plots; k++) check(await page.locator(".plots canvas").nth(k).isVisible(), `print has plot ${k + 1}`);
  if (pictures) await page.screenshot({ path: join(pictures, "print.png"), fullPage: true });
  if (pictures) await page.pdf({ path: join(pictures, "print.pdf"), format: "A4", printBackground: true });
  await page.emulateMedia({ media: "screen" });
}

// Numbers of SI, tiny and huge: every mark of an axis differs from the next, units are told, and so is yielding.
async function readsInMetres(page) {
  const axes = await page.evaluate(`[...report.player.charts, ...Object.values(report.sections[0].plots)].flatMap(u => u.axes.map(a => [a.label || "", a._values]))`);
  for (const [label, marks] of axes) check(marks.every((m, i) => i === 0 || m !== marks[i - 1]), `metres: marks of ${label || "an outcome"} differ: ${marks.join(" ")}`);
  const labels = axes.map(([label]) => label).join();
  check(labels.includes("time [µs]") && labels.includes("height [m]"), `metres: axes tell their units: ${labels}`);
  const height = +/height = ([\d.]+) m$/.exec(await page.locator("#which").textContent())[1];
  const speed = +/meet at ([\d.]+) m\/s along the normal/.exec(await page.locator("#collided").textContent())[1];
  check(Math.abs(speed / Math.sqrt(2 * 9.81 * height) - 1) < 5e-3, `metres: after a fall of ${height} m they meet at ${speed} m/s`);
  check((await page.locator("#chips").textContent()).includes("3 pressed beyond what yields"), "metres: yielding is told at the top");
}

// The four forms of a sweep, kinds of bodies, and odd scripts: each opens without a word.
async function otherRuns() {
  const sweep = (name, count, body) => `local ricochet = require "ricochet"
ricochet.sweep { name = "${name}", over = { sample = ricochet.range(${count}) }, scene = function(at) ${body} end }:run()\n`;
  const plain = scene("ricochet.disk { nodes = 100, seed = at.sample }", "ricochet.plane {}", "{ speed = 0.1 }");
  const never = scene("ricochet.disk { nodes = 60, seed = at.sample }", "ricochet.plane {}", "{ speed = 0.1 }, time_limit = 1e-3");
  const cases = [
    ["none", sweep("none", 2, never), /None of the 2 impacts finished/, 0],
    ["one", sweep("one", 1, plain), /no error bar/, 1],
    ["few", sweep("few", 3, plain), /lies between/, 1],
    ["elements", sweep("elements", 1, scene('ricochet.disk { nodes = 300, interior = "elements", E = 1e4, nu = 0.3 }', "ricochet.plane {}", "{ speed = 0.1 }")), /1 of 1/, 1],
    ["modes", sweep("modes", 1, scene('ricochet.disk { nodes = 200, interior = "modes", E = 1e4, nu = 0.3 }', "ricochet.plane {}", "{ speed = 0.05 }")), /1 of 1/, 1],
    ["axis", sweep("axis", 1, scene('ricochet.sphere { E = 1e4, nu = 0.3, h_min = 0.1, h_max = 0.2 }', "ricochet.plane {}", "{ speed = 0.05 }")), /1 of 1/, 1],
    ["metres", `local ricochet = require "ricochet"
local rows = ricochet.sweep { name = "metres", over = { height = { 0.02, 0.05, 0.1 } }, units = { height = "m" }, scene = function(at)
  return ricochet.scene { units = "SI", projectile = ricochet.sphere { radius = 0.005, material = ricochet.materials.steel, h_min = 1e-4, h_max = 1e-3 },
    target = ricochet.plane {}, launch = { speed = 0, height = at.height }, effects = { ricochet.gravity { g = 9.81 } } } end }:run()\nricochet.report { rows = rows }\n`, /3 of 3/, 3],
    ["odd", `-- </script><script>window.hit = 1</script> <!-- "\n${sweep("odd", 2, plain)}-- </script><img src=x onerror="window.hit=1"> <!--\n-- ä\xff\n` + `-- ${"x".repeat(100)}\n`.repeat(10000), /2 of 2/, 1],
  ];
  for (const [name, text, sentence, replays] of cases) {
    const page = await open(join(run(name, text), "report.html"));
    page.silent(name);
    check(sentence.test(await page.locator(".lead").textContent()), `${name}: ${(await page.locator(".lead").textContent()).trim().slice(0, 90)}`);
    check(await page.evaluate("document.querySelectorAll('script.replay').length") >= replays, `${name}: has its replays`);
    check(await page.evaluate("window.hit === undefined"), `${name}: nothing of the script is executed`);
    if (name === "metres") await readsInMetres(page);
    if (name === "odd") check((await page.locator("#script").textContent()).includes('</script><img src=x onerror="window.hit=1"> <!--'), "odd: the script is shown as it is");
    if (pictures) await page.screenshot({ path: join(pictures, `case-${name}.png`) });
    await page.context().close();
  }
}

try {
  await wholeReport();
  await otherRuns();
  await lessons({ check, open, until, faults, pixels, readCsv, program, work, pictures });
  console.log("all pages are right");
} catch (error) {
  console.error(error.message);
  process.exitCode = 1;
} finally {
  await browser.close();
  rmSync(work, { recursive: true });
}
