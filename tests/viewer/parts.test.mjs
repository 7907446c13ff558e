// Parts of a joint that are turned on the page, against the command with the same values.
import assert from "node:assert/strict";
import { execFileSync } from "node:child_process";
import { mkdtempSync, readFileSync, rmSync } from "node:fs";
import { tmpdir } from "node:os";
import { join } from "node:path";
import { after, test } from "node:test";
import { keep, openPage, openTab, panelsPlaced, pathOf, reports, root, settled, sharedBrowser, type } from "./browser.mjs";
import { readReport } from "./report_block.mjs";

const browser = await sharedBrowser();
const folder = mkdtempSync(join(tmpdir(), "condyle-parts-"));
after(() => rmSync(folder, { recursive: true }));

const table = "Limits as in the report and with parts turned", title = "Turn the parts";
const files = { tilted: "sample/tilts.toml", placed: "placed/hip.toml", turned: "sample/turned.toml" };
const command = (...words) => execFileSync(join(root, "build/release/condyle"), words, { encoding: "utf8", stdio: ["ignore", "pipe", "ignore"] });
const jointFile = (name) => join(reports, files[name]);

async function opened(name, options = {}) {
  const { page, complaints } = await openPage(browser, pathOf(name), { width: 1440, height: 900, reducedMotion: "reduce", ...options });
  await settled(page);
  await openTab(page, "Plan");
  await openFold(page, title);
  return { page, complaints };
}

async function openFold(page, name) {
  const summary = page.locator("summary", { hasText: name });
  if (!(await summary.evaluate((element) => element.parentElement.open))) await summary.click();
}

const panel = (page, name = title) => page.getByRole("region", { name, exact: true });
const field = (page, name) => panel(page).getByRole("spinbutton", { name, exact: true });

/// Does something, and waits until every limit after the last change is there.
async function changed(page, act) {
  const region = panel(page);
  await region.evaluate((element) => delete element.dataset.allAfter);
  await act();
  await page.waitForFunction((element) => element.dataset.allAfter !== undefined, await region.elementHandle());
}

/// Types values into fields, one after the other.
async function set(page, values) {
  for (const [name, value] of Object.entries(values)) await changed(page, () => type(field(page, name), value));
  await settled(page);
}

function questionOf(text, motion) {
  return {
    start: text.coordinates.map(({ name }) => motion.start_deg[name] ?? 0), vary: text.coordinates.findIndex(({ name }) => name === motion.vary),
    positive: motion.sense === "positive", range_deg: motion.range_deg,
  };
}

/// The limits that the core has now, by the names of motions.
async function limitsNow(page, text) {
  const limits = {};
  for (const motion of text.rom.motions)
    limits[motion.name] = (await page.evaluate((limit) => condyle.query({ of: "limit", limit }), questionOf(text, motion))).turned_deg;
  return limits;
}

/// Those of the command.
function limitsOf(name, set) {
  const { motions } = JSON.parse(command("rom", jointFile(name), "--set", set, "--json"));
  return Object.fromEntries(motions.map((motion) => [motion.name, motion.limit_deg]));
}

const reported = ({ rom }) => Object.fromEntries(rom.motions.map(({ name, limit_deg }) => [name, limit_deg]));

function rowsOf(page) {
  return page.getByRole("region", { name: table, exact: true }).locator("tbody tr").evaluateAll((rows) =>
    rows.map((row) => [...row.cells].map(({ textContent }) => textContent)));
}

const vertices = (page, body) => page.evaluate((name) => Array.from(condyle.scene.bodies[name].surface.vertices), body);
const hasGhost = (page, body) => page.evaluate((name) => condyle.scene.bodies[name].hasGhost("parts"), body);

const cases = [
  { name: "tilted", values: { "pelvis tilt, degrees": -7.3 }, set: "pelvis.tilt=-7.3" },
  { name: "placed", values: { "cup inclination, degrees": 47.5, "cup anteversion, degrees": 21, "stem version, degrees": 9.25 },
    set: "cup.inclination=47.5 cup.anteversion=21 stem.version=9.25" },
  { name: "turned", values: { "pelvis frontal, degrees": 3.7, "pelvis tilt, degrees": 4.1, "pelvis version, degrees": -5.3, "pelvis size": 1.004,
    "pelvis lateral, mm": 0.4, "femur version, degrees": 12.6, "femur frontal, degrees": 2.2 },
    set: "pelvis.frontal=3.7 pelvis.tilt=4.1 pelvis.version=-5.3 pelvis.size=1.004 pelvis.lateral=0.4 femur.version=12.6 femur.frontal=2.2" },
];

for (const { name, values, set: words } of cases)
  test(`${name}: with parts turned every limit and every vertex is that of the command, to the bit, and back those of the report`, async () => {
    const { page, complaints } = await opened(name);
    const { text, array } = readReport(pathOf(name));
    await set(page, values);
    const expected = limitsOf(name, words), now = await limitsNow(page, text), before = reported(text);
    assert.deepEqual(now, expected);
    assert.notDeepEqual(now, before);
    const rows = await rowsOf(page);
    text.rom.motions.forEach(({ name: motion, reason }, i) => {
      if (reason === "contact") assert.equal(rows[i][1], `${before[motion].toFixed(1)}°`);
      assert.equal(rows[i][2].replace(/^>/, ""), rows[i][2].startsWith(">") ? `${Math.round(expected[motion])}°` : `${expected[motion].toFixed(1)}°`);
    });
    const other = join(folder, `${name}.html`);
    command("report", jointFile(name), "--set", words, "--out", other);
    for (const body of ["fixed", "mobile"])
      assert.deepEqual(await vertices(page, body), [...readReport(other).array(`${body}_vertices`)], body);
    assert.equal(await panel(page).getByLabel("On the command line").inputValue(), `--set "${words}"`);
    await keep(page, `parts_${name}`);
    await changed(page, () => page.getByRole("button", { name: "Back to the report's" }).click());
    await settled(page);
    assert.deepEqual(await limitsNow(page, text), before);
    for (const body of ["fixed", "mobile"]) assert.deepEqual(await vertices(page, body), [...array(`${body}_vertices`)], body);
    for (const [, was, is] of await rowsOf(page)) assert.equal(is, was);
    assert.deepEqual(complaints, []);
    await page.context().close();
  });

test("contact, free angles and colours are of the joint as it is turned", async () => {
  const { page } = await opened("tilted"), { page: other } = await openPage(browser, pathOf("tilted"));
  await settled(other);
  await set(page, { "pelvis tilt, degrees": -10 });
  // The pose of flexion f is that of flexion f + 20 without the tilt: bits differ, contact does not.
  const at = (flexion) => ({ angles: [flexion, 0, 0], translation: [0, 0, 0] });
  const contact = (where, flexion) => where.evaluate((at) => condyle.query({ of: "pose", at }).then(({ inContact }) => inContact), at(flexion));
  const { text } = readReport(pathOf("tilted"));
  const { limit_deg } = text.rom.motions.find(({ name }) => name === "flexion");
  assert.equal(await contact(other, limit_deg + 10), true);
  assert.equal(await contact(page, limit_deg + 10), false);
  assert.equal(await contact(page, limit_deg + 20.1), true);
  await page.context().close();
  await other.context().close();
});

test("what turned is seen where it was, as a ghost, which can be hidden", async () => {
  const { page } = await opened("placed");
  assert.equal(await hasGhost(page, "fixed"), false);
  await set(page, { "cup inclination, degrees": 55 });
  assert.deepEqual([await hasGhost(page, "fixed"), await hasGhost(page, "mobile")], [true, false]);
  await page.getByLabel("Show the report's parts as a ghost").uncheck();
  assert.equal(await hasGhost(page, "fixed"), false);
  await page.getByLabel("Show the report's parts as a ghost").check();
  assert.equal(await hasGhost(page, "fixed"), true);
  await changed(page, () => page.getByRole("button", { name: "Back to the report's" }).click());
  assert.equal(await hasGhost(page, "fixed"), false);
  await page.context().close();
});

test("a value outside of its range is refused in one line, and nothing turns", async () => {
  const { page } = await opened("tilted");
  const { text } = readReport(pathOf("tilted"));
  await type(field(page, "pelvis tilt, degrees"), 20.5);
  assert.equal(await panel(page).locator("[role=status]").textContent(), "20.5° is not between −20° and 20°: ignored.");
  assert.equal(await field(page, "pelvis tilt, degrees").getAttribute("aria-invalid"), "true");
  assert.equal(await field(page, "pelvis tilt, degrees").getAttribute("aria-valuenow"), "10");
  await settled(page);
  assert.deepEqual(await limitsNow(page, text), reported(text));
  await page.context().close();
});

test("the keyboard alone turns a part by its slider and its field", async () => {
  const { page } = await opened("tilted");
  const slider = page.getByRole("slider", { name: "Slider of pelvis tilt, degrees" });
  await slider.focus();
  await changed(page, () => page.keyboard.press("ArrowRight"));
  assert.equal(await field(page, "pelvis tilt, degrees").getAttribute("aria-valuenow"), "10.5");
  await field(page, "pelvis tilt, degrees").focus();
  await changed(page, () => page.keyboard.press("ArrowDown"));
  await changed(page, () => page.keyboard.press("ArrowDown"));
  assert.equal(await slider.getAttribute("aria-valuetext"), "9.5°");
  await page.context().close();
});

test("of parts, brush and centre one changes the joint at a time, and the others say why they wait", async () => {
  const { page } = await opened("tilted");
  await set(page, { "pelvis tilt, degrees": 5 });
  for (const [name, heading] of [["Resect by brush", "Resect by brush"], ["Move the joint centre", "Move the joint centre"]]) {
    await openFold(page, heading);
    assert.equal(await panel(page, name).count(), 0, name);
    assert.equal(await page.locator(".must-wait:visible").textContent(), "Parts are turned: set them back to the report's values first.");
  }
  await openFold(page, title);
  await changed(page, () => page.getByRole("button", { name: "Back to the report's" }).click());
  await openFold(page, "Resect by brush");
  await page.getByRole("button", { name: "Brush where it ends" }).click();
  await page.waitForFunction(() => /mm³ removed/.test(document.querySelector(".brush-said").textContent));
  await openFold(page, title);
  assert.equal(await panel(page).count(), 0);
  assert.equal(await page.locator(".must-wait:visible").textContent(), "The brush has taken bone: undo its strokes first.");
  await openFold(page, "Resect by brush");
  await page.getByRole("button", { name: "Undo stroke" }).click();
  await page.waitForFunction(() => /^No bone removed yet/.test(document.querySelector(".brush-said").textContent));
  await openFold(page, "Move the joint centre");
  await page.getByRole("button", { name: "+0.5 mm superior" }).click();
  await openFold(page, title);
  assert.equal(await page.locator(".must-wait:visible").textContent(), "The joint centre is moved: set it back first.");
  await openFold(page, "Move the joint centre");
  await page.getByRole("button", { name: "Back to the centre" }).click();
  await openFold(page, title);
  await set(page, { "pelvis tilt, degrees": 3 });
  assert.deepEqual(await limitsNow(page, readReport(pathOf("tilted")).text), limitsOf("tilted", "pelvis.tilt=3"));
  await page.context().close();
});

for (const { name, values } of cases)
  test(`${name}: the saved joint file has the meshes as given and the values as set`, async () => {
    const { page } = await opened(name);
    const { text } = readReport(pathOf(name));
    await set(page, values);
    const downloads = [];
    page.on("download", (download) => downloads.push(download));
    await page.getByRole("button", { name: "Save meshes as given, STL" }).click();
    await page.getByRole("button", { name: "Save joint file" }).click();
    const meshes = ["fixed", "mobile"].reduce((sum, body) => sum + Math.max(1, text.parts[body].length), 0);
    while (downloads.length < meshes + 1) await page.waitForTimeout(50);
    const into = mkdtempSync(join(folder, "saved-"));
    for (const download of downloads) await download.saveAs(join(into, download.suggestedFilename()));
    const now = await limitsNow(page, text);
    // Meshes are kept in single precision: 24 bits of some 100 mm are 1e-5 mm, and limits on a flat contact move by some hundred times that.
    const { motions, provenance } = JSON.parse(command("rom", join(into, "turned.toml"), "--json"));
    assert.equal(provenance.planned, name === "placed" ? "with a total hip" : undefined);
    for (const { name: motion, limit_deg } of motions)
      assert.ok(Math.abs(limit_deg - now[motion]) < 0.01, `${motion}: ${limit_deg} and ${now[motion]}`);
    await page.context().close();
  });

test("nothing of the parts scrolls on a window 900 pixels high", async () => {
  for (const { name, values } of cases) {
    const { page } = await opened(name);
    await set(page, values);
    assert.deepEqual(await page.locator("#panel-plan").evaluate((element) => [element.scrollHeight <= element.clientHeight + 1, element.scrollWidth <= element.clientWidth + 1]),
      [true, true], name);
    await page.context().close();
  }
});

test("without parts, and where nothing can be computed, no parts are offered", async () => {
  const { page } = await openPage(browser, pathOf("sample"));
  await settled(page);
  await openTab(page, "Plan");
  assert.equal(await page.locator("summary", { hasText: title }).count(), 0);
  await page.context().close();
  const { page: still } = await openPage(browser, pathOf("tilted"), { script: "delete globalThis.WebAssembly", answers: false });
  await panelsPlaced(still);
  assert.equal(await still.locator("summary", { hasText: title }).count(), 0);
  await still.context().close();
});

/// The designs of the command, the first parameter's values slowest.
function designsOf(name, vary, set) {
  const into = mkdtempSync(join(folder, "swept-"));
  command("sweep", jointFile(name), ...set, "--vary", vary, "--targets", join(reports, "targets.csv"), "--out", into);
  const [head, ...rows] = readFileSync(join(into, "designs.csv"), "utf8").trimEnd().split("\n").map((line) => line.split(","));
  return { margins: rows.map((row) => row[head.indexOf("margin_deg")]), safe: rows.filter((row) => row[head.indexOf("safe")] === "1").length,
    text: JSON.parse(readFileSync(join(into, "sweep.json"), "utf8")), intervals: readFileSync(join(into, "safe.csv"), "utf8").trimEnd().split("\n").slice(1) };
}

async function openedZone(name) {
  const { page, complaints } = await openPage(browser, pathOf(name), { width: 1440, height: 900, reducedMotion: "reduce" });
  await settled(page);
  await openTab(page, "Plan");
  await openFold(page, "Safe zone");
  return { page, complaints };
}

/// As changed(), with the zone's panel open.
async function changedInZone(page, act) {
  const region = page.locator("section.edit-panel", { has: page.locator(".parameter-rows") });
  await region.evaluate((element) => delete element.dataset.allAfter);
  await act();
  await page.waitForFunction((element) => element.dataset.allAfter !== undefined, await region.elementHandle());
  await settled(page);
}

const zones = [
  { name: "swept", of: "placed", vary: "cup.inclination=30:60:5 cup.anteversion=-5:35:5", values: [] },
  { name: "swept_tilt", of: "tilted", vary: "pelvis.tilt=-20:20:4", values: ["--set", "pelvis.tilt=10"] },
];

for (const { name, of, vary, values } of zones)
  test(`${name}: the safe zone has the designs of condyle sweep, to the bit`, () => {
    const { text, array } = readReport(pathOf(name)), designs = designsOf(of, vary, values);
    const margins = [...array(text.sweep.margin_deg)];
    assert.deepEqual(margins.map((margin) => (Number.isNaN(margin) ? "" : String(margin))).map(Number), designs.margins.map((margin) => Number(margin)));
    assert.equal(text.sweep.safe_designs, designs.safe);
    assert.equal(text.sweep.safe_measure, designs.text.safe_measure);
    assert.deepEqual(text.sweep.best.values, designs.text.best.values);
    assert.equal(text.sweep.safe.length, designs.intervals.length);
    text.sweep.safe.forEach(({ low, high }, i) => assert.deepEqual(designs.intervals[i].split(",").map(Number).slice(-4, -2), [low, high]));
  });

test("the point of the zone drags and moves by arrow keys, the parts turn along, and limits are those of the command there", async () => {
  const { page, complaints } = await openedZone("swept");
  const { text, array } = readReport(pathOf("swept"));
  const map = page.locator("#panel-plan .sweep-map");
  assert.equal(await map.locator(".sweep-safe").count(), text.sweep.safe_designs);
  assert.equal(await map.locator(".sweep-line").count(), text.sweep.safe.length);
  assert.match(await map.getAttribute("aria-valuetext"), /^cup inclination 40°, cup anteversion 15°\. Nearest design: safe, [\d.]+° to spare of pivoting\.$/);
  await map.focus();
  await changedInZone(page, () => page.keyboard.press("ArrowRight"));
  await changedInZone(page, () => page.keyboard.press("ArrowDown"));
  const margin = array(text.sweep.margin_deg)[3 * 9 + 3], target = text.sweep.targets[array(text.sweep.least_target)[3 * 9 + 3]].name;
  assert.equal(await map.getAttribute("aria-valuetext"),
    `cup inclination 45°, cup anteversion 10°. Nearest design: safe, ${margin.toFixed(1)}° to spare of ${target}.`);
  const expected = limitsOf("placed", "cup.inclination=45 cup.anteversion=10");
  assert.deepEqual(await limitsNow(page, text), expected);
  const rows = await page.getByRole("region", { name: "Limits as in the report and at the point", exact: true }).locator("tbody tr").evaluateAll((all) =>
    all.map((row) => row.cells[2].textContent));
  assert.equal(rows[0], `${expected.flexion.toFixed(1)}°`);
  await keep(page, "safe_zone");
  const box = await map.boundingBox();
  await changedInZone(page, async () => {
    await page.mouse.move(box.x + box.width / 2, box.y + box.height / 2);
    await page.mouse.down();
    await page.mouse.move(box.x + box.width / 4, box.y + box.height / 4, { steps: 4 });
    await page.mouse.up();
  });
  await openFold(page, title);
  const [inclination, anteversion] = [await field(page, "cup inclination, degrees").getAttribute("aria-valuenow"), await field(page, "cup anteversion, degrees").getAttribute("aria-valuenow")];
  assert.ok(Number(inclination) < 45 && Number(anteversion) > 15, `${inclination}, ${anteversion}`);
  assert.deepEqual(await limitsNow(page, text), limitsOf("placed", `cup.inclination=${inclination} cup.anteversion=${anteversion}`));
  assert.deepEqual(complaints, []);
  await page.context().close();
});

test("over one parameter the zone is a strip, and outside of it the joint has no point", async () => {
  const { page } = await openedZone("swept_tilt");
  const map = page.locator("#panel-plan .sweep-map");
  assert.equal(await map.locator("rect[class^=sweep]").count(), 11);
  await map.focus();
  await changedInZone(page, () => page.keyboard.press("ArrowLeft"));
  assert.match(await map.getAttribute("aria-valuetext"), /^pelvis tilt 6°\. Nearest design:/);
  await page.context().close();
});

test("notes of the sweep stand under the zone", async () => {
  for (const { name } of zones) {
    const { text } = readReport(pathOf(name)), { page } = await openedZone(name);
    const shown = await page.getByRole("region", { name: "Safe zone", exact: true }).innerText();
    for (const note of text.sweep.sweep_notes) assert.ok(shown.includes(`Note: ${note.text}.`), `${name}: ${note.text}`);
    await page.context().close();
  }
  assert.ok(zones.some(({ name }) => readReport(pathOf(name)).text.sweep.sweep_notes.length > 0), "one has a note");
});

test("nothing of the zone scrolls on a window 900 pixels high", async () => {
  for (const { name } of zones) {
    const { page } = await openedZone(name);
    assert.deepEqual(await page.locator("#panel-plan").evaluate((element) => [element.scrollHeight <= element.clientHeight + 1, element.scrollWidth <= element.clientWidth + 1]),
      [true, true], name);
    await page.context().close();
  }
});

test("a sweep that a page does not show is refused in one line", () => {
  const refused = (...words) => {
    try {
      execFileSync(join(root, "build/release/condyle"), ["report", jointFile("placed"), "--out", join(folder, "no.html"), ...words], { encoding: "utf8", stdio: ["ignore", "pipe", "pipe"] });
    } catch ({ status, stderr }) {
      assert.equal(status, 2);
      return stderr.trimEnd().split("\n").at(-1);
    }
    return null;
  };
  const targets = ["--targets", join(reports, "targets.csv")];
  assert.match(refused("--sweep", "cup.inclination=30:40:5 cup.anteversion=0:10:5 stem.version=0:10:5", ...targets), /a page shows a sweep over one or two parameters/);
  assert.match(refused("--sweep", "cup.inclination=30:100:5", ...targets), /cup\.inclination: 100 deg is outside of its range/);
  assert.match(refused("--sweep", "cup.inclination=30:40:5"), /--sweep requires --targets/);
});
