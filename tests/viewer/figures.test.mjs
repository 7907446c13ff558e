// The figures of the page: what they draw and say, against the numbers of the report.
import assert from "node:assert/strict";
import { readFileSync } from "node:fs";
import { test } from "node:test";
import { angleOf, asSaid, has, keep, openFigure, openPage, openTab, pathOf, settled, sharedBrowser, tile, turnTo, type } from "./browser.mjs";
import { readReport, withText } from "./report_block.mjs";

const browser = await sharedBrowser();
const textOf = (name) => readReport(pathOf(name)).text;

/// The free intervals of an angle at a pose, of the core.
const freeOf = (page, at, vary) => page.evaluate(([angles, angle]) => {
  const [columnAngle, rowAngle] = [0, 1, 2].filter((other) => other !== angle);
  return condyle.query({ of: "mapPoint", point: 0, question: { columnAngle, rowAngle, vary: angle, columns: [angles[columnAngle]], rows: [angles[rowAngle]] } });
}, [at, vary]);
const filled = (page) => page.waitForFunction(() => [...document.querySelectorAll(".slider-readout")].every(({ textContent }) => textContent !== ""));
const degrees = (value) => `${value.toFixed(1).replace("-", "\u2212")}°`;

for (const start of [[0, 0, 0], [40, 10, 0], [100, 10, 0]])
  test(`tracks show what is free of the pose ${start}, and no mark of another`, async () => {
    const { page } = await openPage(browser, pathOf("sample"), { fragment: `#flexion=${start[0]}&adduction=${start[1]}&internal_rotation=${start[2]}` });
    await settled(page);
    await filled(page);
    await page.waitForTimeout(500);
    const tracks = await page.evaluate(() => [...document.querySelectorAll(".track-strip")].map((strip) => ({
      free: [...strip.querySelectorAll(".free")].map((rect) => [Number(rect.getAttribute("x")), Number(rect.getAttribute("x")) + Number(rect.getAttribute("width"))]),
      kinds: [...new Set([...strip.children].map((rect) => rect.getAttribute("class")))],
      hidden: [...strip.children].filter((rect) => rect.getBoundingClientRect().width === 0).length,
      low: Number(strip.nextElementSibling.min), high: Number(strip.nextElementSibling.max),
      text: strip.closest(".slider").querySelector(".slider-readout").textContent,
    })));
    assert.equal(tracks.length, 3);
    for (const [vary, { free, kinds, hidden, low, high, text }] of tracks.entries()) {
      const all = await freeOf(page, start, vary);
      const wanted = all.filter(([from, to]) => to >= low && from <= high);
      const x = (deg) => (100 * (Math.min(high, Math.max(low, deg)) - low)) / (high - low);
      assert.equal(free.length, wanted.length);
      wanted.forEach(([from, to], i) => assert.ok(Math.abs(free[i][0] - x(from)) < 1e-6 && Math.abs(free[i][1] - Math.max(x(to), x(from) + 0.3)) < 1e-6));
      const [from, to] = all.find(([least, most]) => least <= start[vary] && start[vary] <= most);
      assert.equal(text, `free ${degrees(from)} to ${degrees(to)}`);
      assert.equal(hidden, 0, "each mark is seen");
      assert.ok(kinds.every((kind) => ["blocked", "free", "band"].includes(kind)), kinds.join());
    }
    await page.context().close();
  });

test("in contact there is a way on: the least turn that leaves it, pressed, leaves it", async () => {
  const { page } = await openPage(browser, pathOf("sample"), { reducedMotion: "reduce" });
  const start = [120, 10, 40];
  await turnTo(page, { flexion: start[0], adduction: start[1], internal_rotation: start[2] });
  const way = page.locator("#exit:visible");
  await way.waitFor();
  assert.match(await page.locator("#status-text").textContent(), /^Impinging/);
  await page.waitForFunction(() => /Impinging · [\d.]+ mm, \d+ mm², \d+ mm³/.test(document.getElementById("status-text").textContent));
  let least = Infinity;
  for (const vary of [0, 1, 2])
    for (const [low, high] of await freeOf(page, start, vary)) least = Math.min(least, Math.abs(Math.min(high, Math.max(low, start[vary])) - start[vary]));
  const [, turn] = /^free after ([\d.]+)° of /.exec(await way.textContent());
  assert.ok(Math.abs(Number(turn) - least) <= (least < 10 ? 0.051 : 0.51), `${turn} and not ${least}`);
  await way.click();
  await settled(page);
  await page.waitForFunction(() => document.getElementById("status").dataset.state === "limit");
  await page.getByRole("button", { name: "Undo" }).click();
  await page.waitForFunction((deg) => Number(document.querySelector("input[role=spinbutton]").getAttribute("aria-valuenow")) === deg, start[0]);
  assert.equal(await angleOf(page, "internal_rotation"), start[2]);
  await page.context().close();
});

test("what is typed and is no angle in the range is refused in words, and the joint stays", async () => {
  const { page } = await openPage(browser, pathOf("sample"));
  await turnTo(page, { flexion: 30 });
  const field = page.getByRole("spinbutton", { name: "flexion, degrees", exact: true });
  for (const [typed, says] of [["500", /^500° is not between \u2212180° and 180°: ignored\.$/], ["", /Not a number/], ["far", /Not a number/]]) {
    await type(field, typed);
    assert.match(await page.locator("#refusal").textContent(), says);
    assert.equal(await field.getAttribute("aria-invalid"), "true");
    assert.equal(await angleOf(page, "flexion"), 30);
    await field.blur();
    assert.equal(await field.inputValue(), "30.0");
    // The line is still there to be read.
    assert.match(await page.locator("#refusal").textContent(), says);
  }
  // Digit by digit as a hand types: no part of a number is taken.
  await field.fill("");
  await field.pressSequentially("500");
  assert.equal(await angleOf(page, "flexion"), 30);
  await field.press("Tab");
  assert.match(await page.locator("#refusal").textContent(), /^500° is not between/);
  assert.equal(await angleOf(page, "flexion"), 30);
  await type(field, "\u221212,5");
  assert.equal(await page.locator("#refusal").textContent(), "");
  assert.equal(await angleOf(page, "flexion"), -12.5);
  await field.blur();
  assert.equal(await field.inputValue(), "\u221212.5");
  await page.context().close();
});

test("a limit keeps all of its digits, and shows as many as mean something", async () => {
  const { page } = await openPage(browser, pathOf("sample"), { reducedMotion: "reduce" });
  const { motions } = textOf("sample").rom;
  await tile(page, "flexion").click();
  await settled(page);
  assert.equal(await angleOf(page, "flexion"), motions[0].limit_deg);
  assert.equal(await page.getByRole("spinbutton", { name: "flexion, degrees", exact: true }).inputValue(), motions[0].limit_deg.toFixed(1));
  assert.match(await page.locator("#status-text").textContent(), /^At the limit, first contact: /);
  const seen = await page.locator("#screen").innerText();
  assert.doesNotMatch(seen, /\d\.\d{4}/);
  assert.doesNotMatch(seen, /(^|[ (])-\d/m);
  await page.context().close();
});

test("where the range ends without contact every figure says so in the same way", async () => {
  const { page } = await openPage(browser, pathOf("sample"));
  const faber = textOf("sample").rom.motions.find(({ name }) => name === "faber");
  assert.equal(faber.reason, "end_of_range");
  const says = `>${Number(faber.limit_deg.toFixed(1))}°`;
  assert.ok((await tile(page, "FABER").textContent()).includes(says));
  for (const selector of ["#section-limits + *, [aria-labelledby=section-limits]", "#paper"]) {
    const said = (await page.locator(selector).allTextContents()).join();
    assert.ok(said.includes(says) && !/over \d/.test(said), said);
  }
  await page.context().close();
});

/// Pairs of texts that lie on each other.
const overlaps = (page, selector) => page.evaluate((wanted) => {
  const boxes = [...document.querySelectorAll(wanted)].map((text) => [text.textContent, text.getBoundingClientRect()]);
  return boxes.flatMap(([a, one], i) => boxes.slice(i + 1).filter(([, other]) =>
    Math.min(one.right, other.right) - Math.max(one.left, other.left) > 0.5 &&
    Math.min(one.bottom, other.bottom) - Math.max(one.top, other.top) > 2.5).map(([b]) => `${a} and ${b}`));
}, selector);

for (const name of ["sample", "vhf_right", "libhip_left"])
  test(`no label of the figures of ${name} lies on another`, { skip: !has(name) && "not made" }, async () => {
    const { page } = await openPage(browser, pathOf(name));
    await settled(page);
    await openFigure(page, "Clock");
    assert.deepEqual(await overlaps(page, "#side .clock text"), []);
    // All labels lie within their pictures.
    assert.deepEqual(await page.evaluate(() => [...document.querySelectorAll("#side .plot text")].filter((text) => {
      const box = text.getBoundingClientRect(), picture = text.closest("svg").getBoundingClientRect();
      return box.width > 0 && (box.left < picture.left - 0.5 || box.right > picture.right + 0.5);
    }).map(({ textContent }) => textContent)), []);
        await keep(page, `clock_${name}`);
    await page.context().close();
  });

test("the clock says in which plane it is, and a contact pressed moves the joint there", async () => {
  const { page } = await openPage(browser, pathOf("sample"), { reducedMotion: "reduce" });
  await openFigure(page, "Clock");
  assert.equal(await page.locator("#side").getByText(/^Sagittal clock position/).count(), 1);
  assert.equal(await page.locator("#side").getByText("socket's rim").count(), 0);
  const { motions } = textOf("sample").rom;
  await page.getByRole("button", { name: /^ER90, Go to the end of/ }).locator("text").click();
  await settled(page);
  const [wanted] = motions.filter(({ name }) => name === "external_rotation_at_90_flexion");
  for (const angle of ["flexion", "internal_rotation"]) assert.equal(await angleOf(page, angle), wanted.at_limit_deg[angle]);
  // Contacts without an hour are named.
  const without = motions.filter(({ reason, clock_hour }) => reason === "contact" && clock_hour === null);
  assert.ok(without.length > 0);
  const caption = await page.locator("#side figure:has(.clock) figcaption").textContent();
  for (const { name } of without) assert.ok(caption.split("Without an hour")[1].includes(asSaid(name)), name);
  await page.context().close();
  const rim = await openPage(browser, withText("rim", (text) => (text.rom.clock_plane = "rim")));
  assert.equal(await rim.page.locator("#side").getByText(/^Where on the socket's rim each motion ends/).count(), 1);
  await rim.page.context().close();
});

test("cells of the map have their angles as text for screen readers, and the outlines are explained", async () => {
  const { page } = await openPage(browser, pathOf("sample"));
  const { map } = textOf("sample");
  const labels = await page.locator("#side rect.cell").evaluateAll((cells) => cells.map((cell) => cell.getAttribute("aria-label")));
  const sign = (value) => String(value).replace("-", "\u2212");
  assert.deepEqual(labels, map.intervals.map((list, point) => {
    const held = `flexion ${sign(map.columns.values_deg[point % map.columns.values_deg.length])}°, adduction ` +
      `${sign(map.rows.values_deg[Math.floor(point / map.columns.values_deg.length)])}°`;
    const free = list.map(([low, high]) => `free from ${degrees(low)} to ${degrees(high)}`).join(", ");
    return `${held}: internal rotation ${free || "nowhere free"}`;
  }));
  assert.equal(await page.locator("#side").getByText("more than one free interval").count(), 1);
  // Degrees stand in the cells.
  const numbers = await page.locator("#side .cell-number").allTextContents();
  const from = (list) => list.find(([low, high]) => low <= map.start_deg && map.start_deg <= high);
  assert.deepEqual(numbers, map.intervals.map((list) => (from(list) ? (from(list)[1] - map.start_deg).toFixed(0) : "")));
  // The cross is where the joint is, and drags it.
  await openTab(page, "Figures");
  const cell = async (place) => page.locator("#side rect.cell").nth(place).boundingBox();
  const [a, b] = [await cell(0), await cell(map.columns.values_deg.length + 3)];
  await page.mouse.move(a.x + a.width / 2, a.y + a.height / 2);
  await page.mouse.down();
  await page.mouse.move(b.x + b.width / 2, b.y + b.height / 2, { steps: 5 });
  await page.mouse.up();
  await settled(page);
  assert.ok(Math.abs((await angleOf(page, "flexion")) - map.columns.values_deg[3]) < 0.5);
  assert.ok(Math.abs((await angleOf(page, "adduction")) - map.rows.values_deg[1]) < 0.5);
  const cross = await page.locator("#side .cross").boundingBox();
  assert.ok(Math.abs(cross.x + cross.width / 2 - b.x - b.width / 2) < 3 && Math.abs(cross.y + cross.height / 2 - b.y - b.height / 2) < 3);
  await page.context().close();
});

test("a map with translations has millimetres, and a cell pressed takes the joint to where its free interval ends in contact", async () => {
  const { page, complaints } = await openPage(browser, pathOf("translated"), { reducedMotion: "reduce" });
  const { map } = textOf("translated"), across = map.columns.values_mm.length, cell = 2 * across + 3;
  const labels = await page.locator("#side rect.cell").evaluateAll((cells) => cells.map((each) => each.getAttribute("aria-label")));
  const said = (mm) => `${mm.toFixed(2).replace("-", "\u2212")} mm`;
  const free = map.intervals[cell].map(([low, high]) => `free from ${said(low)} to ${said(high)}`).join(", ");
  assert.equal(labels[cell], `x 0.5 mm, flexion 60°: y ${free}`);
  await openFigure(page, "Map");
  const texts = await page.locator("#side svg.map > g text").allTextContents();
  for (const wanted of ["x, mm", "flexion", "\u22120.5", "30°"]) assert.ok(texts.includes(wanted), `${wanted} of ${texts}`);
  assert.match(await page.locator("#side .map-legend").textContent(), /^0 mm.*10 mm or more.*5 mm/);
  await keep(page, "figure_map_mm");
  await page.locator("#side rect.cell").nth(cell).click();
  await settled(page);
  await openTab(page, "Motion");
  const mmOf = async (axis) => Number(await page.getByLabel(`${axis}, mm`).getAttribute("aria-valuenow"));
  assert.deepEqual([await angleOf(page, "flexion"), await angleOf(page, "adduction"), await mmOf("x"), await mmOf("y")], [60, 5, 0.5, 0]);
  const [, end_mm, , byContact] = map.intervals[cell].find(([low, high]) => low <= 0 && high >= 0);
  assert.equal(byContact, 1);
  const touches = (y) => page.evaluate(async (mm) => (await condyle.query({ of: "pose", at: { angles: [60, 5, 0], translation: [0.5, mm, 0] } })).inContact, y);
  assert.deepEqual([await touches(end_mm - 1e-6), await touches(end_mm + 1e-6)], [false, true]);
  // In contact after a slide, about which nothing turns.
  await turnTo(page, { flexion: 140 });
  await type(page.getByLabel("x, mm"), 0.3);
  await page.getByText("the last movement slides", { exact: true }).waitFor();
  assert.deepEqual(complaints, []);
  await page.context().close();
});

test("a walk that touches nothing draws its gap, and says what is zero or empty", { skip: !has("walk") && "not made" }, async () => {
  const { page } = await openPage(browser, pathOf("walk"));
  const { text, array } = readReport(pathOf("walk"));
  const finite = ({ values }) => Array.from(array(values)).filter(Number.isFinite);
  const gap = text.recorded.curves.find(({ name }) => name === "smallest_gap_mm");
  assert.ok(finite(gap).every((mm) => mm > 0), "nothing touches");
  await openTab(page, "Figures");
  const lanes = await page.locator("#side .curve-plot text").allTextContents();
  assert.equal(lanes[0], "smallest gap, mm");
  assert.equal(await page.locator("#side .curve-plot path.curve").count(), 4);
  assert.ok(lanes.includes("time, s"));
  const said = (await page.locator(".silent").allTextContents()).join();
  for (const curve of text.recorded.curves) {
    const title = curve.name.replace(/_(mm2|mm|deg)$/, "").replaceAll("_", " ");
    const isSilent = finite(curve).every((value) => value === 0);
    if (isSilent) assert.ok(said.includes(title), title);
  }
  await page.locator("summary", { hasText: "Quantities" }).click();
  await page.getByLabel("flexion, °").uncheck();
  assert.equal(await page.locator("#side .curve-plot path.curve").count(), 3);
  await keep(page, "curves");
  await page.context().close();
});

test("a curve is pressed and moved through by arrow keys", { skip: !has("walk") && "not made" }, async () => {
  const { page } = await openPage(browser, pathOf("walk"));
  const frame = async () => Number(await page.getByRole("slider", { name: "Frame", exact: true }).inputValue());
  await openTab(page, "Figures");
  await settled(page);  // curves that the core has answered are drawn with the others anew
  const curve = page.locator("#side .curve-plot");
  // From end to end of the axis of time.
  const box = await curve.locator("line.grid").first().boundingBox();
  const last = readReport(pathOf("walk")).array(textOf("walk").recorded.times_s).length - 1;
  await page.mouse.click(box.x + box.width / 2, box.y + 20);
  assert.ok(Math.abs((await frame()) - last / 2) <= 2, String(await frame()));
  await curve.focus();
  const before = await frame();
  await page.keyboard.press("ArrowRight");
  await page.keyboard.press("ArrowRight");
  await page.keyboard.press("ArrowLeft");
  assert.equal(await frame(), before + 1);
  assert.equal(await curve.getAttribute("aria-valuenow"), String(before + 1));
  const flexion = readReport(pathOf("walk")).array(textOf("walk").recorded.coordinates_deg)[3 * (before + 1)];
  assert.equal(await angleOf(page, "flexion"), flexion);
  await page.keyboard.press("End");
  assert.equal(await frame(), last);
  await page.context().close();
});

test("a motion recorded without times plays frame by frame and says so", { skip: !has("walk") && "not made" }, async () => {
  const path = withText("frames", (text) => {
    text.recorded.axis = "frame";
    text.recorded.times_s = "frame_numbers";
    // As many numbers that ascend: those of the time serve.
    text.arrays.frame_numbers = text.arrays[readReport(pathOf("walk")).text.recorded.times_s];
  }, "walk");
  const { page } = await openPage(browser, path);
  await openTab(page, "Figures");
  assert.equal(await page.locator("#side .curve-plot").getByText("frame", { exact: true }).count(), 1);
  assert.equal(await page.getByText("time, s").count(), 0);
  const count = readReport(pathOf("walk")).array(textOf("walk").recorded.times_s).length;
  assert.equal(await page.getByText(`: ${count} frames`).count(), 1);
  const [download] = await Promise.all([page.waitForEvent("download"),
    page.locator("section", { has: page.getByRole("heading", { name: "Recorded motion" }) }).last().getByRole("button", { name: "Save data" }).first().click()]);
  assert.match(readFileSync(await download.path(), "utf8"), /^frame,/);
  await page.context().close();
});

test("the numbers say how they were found: bounds, bands, bearing contact, clinical ranges", async () => {
  const { page } = await openPage(browser, pathOf("sample"));
  const { rom } = textOf("sample");
  const panel = page.locator("#panel-details");
  const text = await panel.textContent();
  for (const wanted of ["free before it, in contact at it or past it by at most its error bound", `of ${rom.band.samples} varied joints, seed ${rom.band.seed}`,
    `centre ${rom.band.sigma.centre_mm} mm, axes ${rom.band.sigma.axes_deg}°, surfaces ${rom.band.sigma.surface_mm} mm`,
    "Contact of the bearing surface does not end a motion", `radius ${rom.bearing.head.radius_mm.toFixed(2)} mm`,
    `radius ${rom.bearing.socket.radius_mm.toFixed(2)} mm`, `reaches ${rom.bearing.margin_mm.toFixed(2)} mm`, "Clinical ranges: AAOS 1965", "right, ball joint",
    `${rom.scope.slice(1)}.`, ...rom.motions.flatMap(({ caveats, living }) => caveats.filter(({ code }) => !living?.gap || code === "labrum_not_modelled").map(({ text, source }) => source === null ? text : `${text} (${source})`))])
    assert.ok(text.includes(wanted), wanted);
  const rows = await panel.locator("[aria-labelledby=section-limits] table").locator("tbody tr").evaluateAll((all) => all.map((row) => [...row.cells].map((cell) => cell.textContent)));
  rows.forEach((cells, i) => {
    const motion = rom.motions[i];
    assert.equal(cells[0], asSaid(motion.name));
    assert.ok(cells[1].includes(motion.reason === "contact" ? motion.limit_deg.toFixed(1) : `>${motion.limit_deg.toFixed(0)}°`), cells[1]);
    assert.equal(cells[3], motion.reason === "contact" ? "contact (impingement)" : "end of range");
    assert.equal(cells[6], motion.reason === "contact" ? `${motion.error_bound_deg.toPrecision(2)}°` : "–");
  });
  await openTab(page, "Details");
  await page.locator("summary", { hasText: /^Limits$/ }).click();
  const heights = await panel.locator("tbody tr").evaluateAll((all) => all.map((row) => row.getBoundingClientRect().height));
  assert.ok(Math.max(...heights) < 75, `a row of ${Math.max(...heights)} pixels`);
  await page.context().close();
});

test("parameters of parts that are not as in the joint file are named, and their uncertainty in the bands", async () => {
  const { page, complaints } = await openPage(browser, pathOf("tilted"));
  const said = await page.locator("body").textContent();
  assert.ok(said.includes("Changed from the joint file: pelvis.tilt 10 deg instead of 0."), said);
  assert.match(said, /surfaces 0\.25 mm, pelvis\.tilt 3\./);
  assert.deepEqual(complaints, []);
  await page.context().close();
});

test("every frame of a motion is saved as a picture, each of its own pose, or none if it is stopped", async () => {
  const { page, complaints } = await openPage(browser, pathOf("moves"));
  await settled(page);
  await openTab(page, "Figures");
  const downloads = [];
  page.on("download", (download) => downloads.push(download));
  const [download] = await Promise.all([page.waitForEvent("download"), page.getByRole("button", { name: "Save every frame, PNG" }).click()]);
  const bytes = readFileSync(await download.path()), text = bytes.toString("latin1");
  const names = [...text.matchAll(/PK\x01\x02.{42}(frame_\d{5}\.png)/gs)].map(([, name]) => name);
  assert.deepEqual(names, ["frame_00000.png", "frame_00001.png", "frame_00002.png"]);
  const pictures = text.split("\x89PNG").slice(1);
  assert.equal(pictures.length, 3);
  assert.equal(new Set(pictures.map((picture) => picture.split("PK\x03\x04")[0])).size, 3, "no two are the same");
  await page.evaluate(() => {
    const save = [...document.querySelectorAll("button")].find(({ textContent }) => textContent === "Save every frame, PNG");
    save.click();
    save.click();
  });
  await page.getByRole("button", { name: "Save every frame, PNG" }).waitFor();
  assert.equal(downloads.length, 1, "nothing is saved of what was stopped");
  assert.deepEqual(complaints, []);
  await page.context().close();
});
