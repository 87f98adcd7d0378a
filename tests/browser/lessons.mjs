// Works through lessons as pupils and teachers do. Called by pages.mjs with what it uses itself.
import { execFileSync } from "node:child_process";
import { copyFileSync, readdirSync, statSync } from "node:fs";
import { basename, dirname, join } from "node:path";

export async function lessons({ check, open, until, faults, pixels, readCsv, program, work, pictures }) {
  const folder = join(dirname(program), "../..", "examples/lessons");
  const run = (name, ...options) => {
    copyFileSync(join(folder, `${name}.lua`), join(work, `${name}.lua`));
    execFileSync(program, ["run", `${name}.lua`, "--quiet", "--no-report", ...options], { cwd: work, stdio: ["ignore", "ignore", "pipe"] });
    return join(work, "out", name, "lesson.html");
  };
  const rowsOf = name => {
    const { names, lines } = readCsv(join(work, "out", name, "results.csv"));
    return lines.map(line => Object.fromEntries(names.map((n, i) => [n, line[i]])));
  };

  // Moves the sliders to a setting.
  async function setTo(page, row) {
    await page.evaluate(`report.lesson.places[${row}].forEach((k, i) => { const s = document.getElementById("slider-" + i); s.value = k; s.dispatchEvent(new Event("input")); })`);
    await until(page, `report.player.replay.hash === report.hashes[${row}]`);
  }
  async function letGo(page, guess) {
    await page.evaluate(`(() => { const s = document.getElementById("guess"); s.value = ${guess}; s.dispatchEvent(new Event("input")); })()`);
    await page.locator("#go").click();
    await until(page, "!document.getElementById('after').hidden && report.player.charts.length === 2");
  }
  const download = async (page, button) => {
    const [file] = await Promise.all([page.waitForEvent("download"), page.locator(button).click()]);
    const path = join(work, `saved ${file.suggestedFilename()}`);
    await file.saveAs(path);
    return path;
  };

  // Each setting shows the impact of its row: hash, and the velocity at the end of what is played.
  async function settingsShowTheirOwn(page, name, rows) {
    const count = await page.evaluate("report.lesson.places.length");
    check(count >= 12 && count === rows.length, `${name}: ${count} settings`);
    const seen = new Set();
    for (let row = 0; row < count; row++) {
      await setTo(page, row);
      const hash = await page.locator("#hash").getAttribute("title");
      const values = await page.evaluate(`report.lesson.sliders.map((s, i) => [s.of, String(s.values[report.lesson.places[${row}][i]])])`);
      const own = rows[row].scene_hash === hash && values.every(([of, value]) => rows[row][of] === value || +rows[row][of] === +value);
      const [last, unit] = await page.evaluate("[report.player.replay.series.vn.at(-1), report.player.replay.unit.vn]");
      const agrees = Math.abs(last - rows[row].vn) < 2e-3 * Math.abs(rows[row].vn);
      if (!own || !agrees) check(false, `${name}: setting ${row + 1} shows ${hash}, leaving at ${last} ${unit}; its row is ${rows[row].scene_hash}, ${rows[row].vn}`);
      seen.add(hash);
    }
    check(seen.size === count, `${name}: every setting shows its own row's impact, by hash and by the velocity it leaves with`);
  }

  // Numbers in the texts against the results: of columns that are in the table, and of others by `formulas` of a row.
  async function textsTellRows(page, name, rows, formulas = {}) {
    const numbers = await page.evaluate("[...document.querySelectorAll('.number')].map(n => [n.textContent.replace('−', '-'), n.dataset.of, n.dataset.hash])");
    let compared = 0;
    for (const [text, of, hash] of numbers) {
      const row = rows.find(r => r.scene_hash === hash);
      if (row === undefined) check(false, `${name}: the number ${text} (${of}) is of an impact of the grid`);
      if (!(of in row || of in formulas) || Number.isNaN(+text)) continue;
      const decimals = (text.split(".")[1] || "").length, known = of in row ? +row[of] : formulas[of](row);
      check(Math.abs(+text - known) <= 0.5001 * 10 ** -decimals, `${name}: ${of} in the text is ${text}, in the row ${known}`);
      compared++;
    }
    return [numbers.length, compared];
  }

  async function wholeLesson() {
    const name = "01_drop_and_bounce", file = run(name), rows = rowsOf("lesson_drops");
    check(statSync(file).size < 6e6, `a lesson of ${rows.length} settings has ${statSync(file).size} bytes`);
    const page = await open(file);
    console.log(`   ready after ${page.took} ms`);
    check((await faults(page)).length === 0, `lesson: axe finds no fault before a guess ${(await faults(page)).join("; ")}`);
    check(!await page.locator("#after").isVisible() && !await page.locator("#result").isVisible() && !await page.locator("#intuition").isVisible(), "lesson: no result is shown before a guess");
    await page.locator("#view").focus();
    await page.keyboard.press(" ");
    await page.locator("#view").click();
    check(!await page.evaluate("report.player.playing || report.player.at > 0"), "lesson: nothing plays before a guess");
    await page.locator("#go").click();
    check(/guess first/.test(await page.locator("#said").textContent()) && await page.evaluate("report.tried.length") === 0, "lesson: without a guess it asks for one");
    await settingsShowTheirOwn(page, "lesson", rows);

    // By keyboard alone: to the first setting, a guess, and the result.
    await page.evaluate("document.activeElement.blur(); scrollTo(0, 0)");
    const tabTo = async id => {
      for (let k = 0; k < 60 && await page.evaluate("document.activeElement.id") !== id; k++) await page.keyboard.press("Tab");
      check(await page.evaluate("document.activeElement.id") === id, `lesson: Tab reaches ${id}`);
    };
    await tabTo("slider-0");
    await page.keyboard.press("Home");
    await page.keyboard.press("ArrowRight");
    await tabTo("slider-1");
    await page.keyboard.press("Home");
    await until(page, "document.getElementById('hash').title === report.player.replay.hash");
    const row = rows.findIndex(r => +r.height === 0.25 && r.floor === "stone");
    check(await page.locator("#hash").getAttribute("title") === rows[row].scene_hash, "lesson: arrow keys choose the setting");
    await tabTo("guess");
    for (let k = 0; k < 20; k++) await page.keyboard.press("ArrowRight");
    await tabTo("go");
    const bare = await pixels(page, "#graph");
    await page.keyboard.press("Enter");
    await until(page, "!document.getElementById('after').hidden && report.player.charts.length === 2");
    const back = 100 * rows[row].after_projectile_translation / rows[row].before_total;
    check(await page.locator("#said").textContent() === `You guessed 70.0 %. It was ${back.toFixed(1)} %.`, `lesson: ${await page.locator("#said").textContent()}`);
    check(bare !== await pixels(page, "#graph") && await page.evaluate("report.graph.spots.length") === 1, "lesson: the graph has its first point");
    check(!await page.locator("#intuition").isVisible(), "lesson: what many people think is not given away by the first result");
    await until(page, "report.player.playing && report.player.at > 2");
    await page.evaluate("report.play(false)");
    check(true, "lesson: the replay plays once it was let go");
    await tabTo("view");
    await page.keyboard.press("End");
    check(await page.evaluate("report.player.at > report.player.replay.frames - 1.5"), "lesson: the replay is stepped by keys");

    for (const [setting, guess] of [[0, 95], [4, 60], [8, 40], [17, 20]]) {
      await setTo(page, setting);
      await letGo(page, guess);
    }
    check(await page.locator("#intuition").isVisible(), "lesson: what many people think is named after five results");
    check(await page.evaluate("report.graph.spots.length") === 5 && await page.locator("#tries tbody tr").count() === 5, "lesson: five tries are five points and five lines");
    await page.evaluate("report.play(false)");
    const share = column => row => 100 * row[column] / row.before_total;
    const [told, compared] = await textsTellRows(page, "lesson", rows, { back: share("after_projectile_translation"),
      ball: share("after_projectile_vibration"), ground: share("after_target_vibration"), rise: row => row.height * row.e ** 2 });
    check(told >= 10 && compared === told, `lesson: all ${told} numbers in its texts are the rows'`);
    check(await page.locator("details[open]").count() === 0, "lesson: answers are folded");
    await page.locator("#questions summary").first().click();
    check((await faults(page)).length === 0, `lesson: axe finds no fault after five tries ${(await faults(page)).join("; ")}`);

    // A link, a copy and the table keep what was tried.
    const hash = await page.evaluate("location.hash"), title = await page.locator("#which").textContent();
    check(/floor=soft%20mat&tried=2:70,1:95,5:60,9:40,18:20&t=/.test(hash), `lesson: the link holds ${hash}`);
    const named = await page.evaluate(`(() => {
      const slider = lesson.sliders[0], before = slider.of;
      slider.of = "a&tried=b";
      const link = new URLSearchParams(stateText());
      slider.of = before;
      return [link.get("a&tried=b"), String(slider.values[place[0]]), link.getAll("tried").length];
    })()`);
    check(named[0] === named[1] && named[2] === 1, `lesson: a name of any characters stands in the link as itself ${named}`);
    const csv = readCsv(await download(page, "#csv"));
    const fifth = csv.lines[4], last = rows[17];
    check(csv.lines.length === 5 && fifth.at(-1) === last.scene_hash && +fifth[3] === 20, `lesson: the fifth of the pupil's points is ${fifth.slice(0, 5).join(", ")}`);
    const at = csv.names.indexOf("Speed when it leaves");
    check(csv.lines.every(line => Number(line[at]) === +rows.find(r => r.scene_hash === line.at(-1)).vn), "lesson: the pupil's points are the results'");
    const copy = await download(page, "#save");
    page.silent("a lesson");
    if (pictures) await page.screenshot({ path: join(pictures, "lesson.png"), fullPage: true });
    await page.emulateMedia({ media: "print" });
    check(await page.locator("#graph canvas").isVisible() && !await page.locator("#go").isVisible() && !await page.locator("#teacher").isVisible(), "lesson: print has the graph, and neither buttons nor the teacher's part");
    await page.context().close();

    for (const [what, path, options] of [["the link", file, { hash }], ["the copy", copy, {}], ["the link without WebGL", file, { hash: `${hash}&nogl` }]]) {
      const other = await open(path, options);
      check(await other.locator("#which").textContent() === title && await other.evaluate("report.tried.map(t => [t.row + 1, t.guess].join(':')).join()") === "2:70,1:95,5:60,9:40,18:20", `lesson: ${what} opens with what was tried`);
      check(await other.locator("#after").isVisible() && await other.evaluate("report.graph.spots.length") === 5, `lesson: ${what} shows it`);
      if (what.includes("WebGL")) check(await other.evaluate("report.player.paint === null"), "lesson: it draws by paths");
      const before = await pixels(other, ".screen");
      await other.evaluate("report.go(2)");
      check(before !== await pixels(other, ".screen"), `lesson: ${what} moves`);
      other.silent(what);
      await other.context().close();
    }
    const again = await open(copy);
    await setTo(again, 2);
    const second = await open(await download(again, "#save"));
    check(await second.locator("#hash").getAttribute("title") === rows[2].scene_hash, "lesson: the copy of a copy opens at its own setting");
    second.silent("the copy of a copy");
    check(Math.abs(statSync(file).size - statSync(copy).size) < 5000, "lesson: a copy is as large as its original");

    for (const [name, options] of [["phone", { width: 390, height: 844 }], ["dark", { scheme: "dark" }]]) {
      const other = await open(file, { ...options, hash });
      check(await other.evaluate("document.documentElement.scrollWidth <= innerWidth"), `lesson, ${name}: nothing is wider than the window`);
      const wrong = await faults(other);
      check(wrong.length === 0, `lesson, ${name}: axe finds no fault ${wrong.join("; ")}`);
      other.silent(`lesson, ${name}`);
      if (pictures) await other.screenshot({ path: join(pictures, `lesson-${name}.png`), fullPage: true });
      await other.context().close();
    }
    const odd = await open(file, { hash: "#height=7&floor=lava&tried=99:1,-3,x:y,2:nan,2:5&t=never" });
    check(await odd.evaluate("report.tried.length") === 1 && await odd.locator("#hash").getAttribute("title") === rows[0].scene_hash, "lesson: a wrong link is passed over");
    odd.silent("a wrong link");
  }

  async function otherLessons() {
    for (const name of readdirSync(folder).filter(f => f.endsWith(".lua")).map(f => basename(f, ".lua")).slice(1)) {
      const file = run(name), page = await open(file);
      const sweep = await page.evaluate("JSON.parse(document.getElementById('data').textContent).sections[0].name");
      check(statSync(file).size < 6e6, `${name}: ${statSync(file).size} bytes, ready after ${page.took} ms`);
      await settingsShowTheirOwn(page, name, rowsOf(sweep));
      await letGo(page, await page.evaluate("report.lesson.guess.to"));
      await page.evaluate("report.play(false)");
      await textsTellRows(page, name, rowsOf(sweep));
      const wrong = await faults(page);
      check(wrong.length === 0, `${name}: axe finds no fault ${wrong.join("; ")}`);
      await page.locator("#teacher > summary").click();
      await page.locator("#all").click();
      await until(page, "report.tried.length === report.lesson.places.length && report.player.charts.length === 2");
      page.silent(name);
      if (pictures) await page.screenshot({ path: join(pictures, `lesson-${name}.png`), fullPage: true });
      await page.context().close();
    }
  }

  await wholeLesson();
  await otherLessons();
}
