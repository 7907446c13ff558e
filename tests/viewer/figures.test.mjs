// The figures of the page: what they draw and say, against the numbers of the report.
import assert from "node:assert/strict";
import { readFileSync } from "node:fs";
import { test } from "node:test";
import { has, keep, openPage, pathOf, settled, sharedBrowser } from "./browser.mjs";
import { readReport, withText } from "./report_block.mjs";

const browser = await sharedBrowser();
const textOf = (name) => readReport(pathOf(name)).text;

test("strips mark contacts and bands, and nothing where only the range ends", async () => {
  const { page } = await openPage(browser, pathOf("sample"));
  await settled(page);
  await page.waitForFunction(() => [...document.querySelectorAll(".told")].every(({ textContent }) => textContent !== ""));
  const { coordinates, rom } = textOf("sample");
  const strips = await page.evaluate(() => [...document.querySelectorAll(".strip")].map((strip) => {
    const marks = (kind) => [...strip.querySelectorAll(`.${kind}`)].map((rect) => {
      const x = Number(rect.getAttribute("x"));
      return [x, x + Number(rect.getAttribute("width"))];
    });
    const input = strip.previousElementSibling;
    return { low: Number(input.min), high: Number(input.max), limits: marks("limit"), bands: marks("band"), free: marks("free") };
  }));
  let ended = 0;
  coordinates.forEach(({ name }, i) => {
    const { low, high, limits, bands, free } = strips[i];
    const x = (deg) => (400 * (Math.min(high, Math.max(low, deg)) - low)) / (high - low);
    const motions = rom.motions.filter(({ vary, start_deg }) => vary === name && Object.values(start_deg).every((start) => start === 0));
    const sign = ({ sense }) => (sense === "positive" ? 1 : -1);
    const near = (found, wanted) => {
      assert.equal(found.length, wanted.length, name);
      found.forEach((ends, k) => ends.forEach((end, m) => assert.ok(Math.abs(end - wanted[k][m]) < 1e-6, `${name}: ${end} and not ${wanted[k][m]}`)));
    };
    const met = motions.filter(({ reason }) => reason === "contact");
    near(limits, met.map((motion) => [x(sign(motion) * motion.limit_deg) - 1, x(sign(motion) * motion.limit_deg) + 1]));
    near(bands, met.map((motion) => {
      const ends = [motion.band.p5_deg, motion.band.p95_deg].map((end) => x(sign(motion) * end)).sort((a, b) => a - b);
      return [ends[0], Math.max(ends[1], ends[0] + 1)];
    }));
    ended += motions.length - met.length;
    assert.equal(free.length, 1);
  });
  assert.equal(ended, 1, "internal rotation goes on to the end of its range");
  await page.context().close();
});

test("how far an angle is free from here is what the core says of this pose", async () => {
  const { page } = await openPage(browser, pathOf("sample"), { fragment: "#flexion=40&adduction=10" });
  await settled(page);
  await page.waitForFunction(() => [...document.querySelectorAll(".told")].every(({ textContent }) => textContent !== ""));
  const told = await page.locator(".told").allTextContents();
  const start = [40, 10, 0];
  for (const [vary, name] of ["flexion", "adduction", "internal rotation"].entries()) {
    const ends = [];
    for (const positive of [false, true]) {
      const limit = await page.evaluate((question) => condyle.query({ of: "limit", limit: question }), { start, vary, positive, range_deg: 180 });
      ends.push(`${(start[vary] + (positive ? 1 : -1) * limit.turned_deg).toFixed(1)}° (${limit.reason.replaceAll("_", " ")})`);
    }
    assert.equal(told[vary], `${name} is free from ${ends[0]} to ${ends[1]} from here`);
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
    assert.deepEqual(await overlaps(page, ".clock text"), []);
    assert.deepEqual(await overlaps(page, "[aria-labelledby=section-limits] text"), []);
    // All labels lie within their pictures.
    assert.deepEqual(await page.evaluate(() => [...document.querySelectorAll(".plot text")].filter((text) => {
      const box = text.getBoundingClientRect(), picture = text.closest("svg").getBoundingClientRect();
      return box.width > 0 && (box.left < picture.left - 0.5 || box.right > picture.right + 0.5);
    }).map(({ textContent }) => textContent)), []);
    await page.locator(".clock").scrollIntoViewIfNeeded();
    await keep(page, `clock_${name}`);
    await page.context().close();
  });

test("the clock says in which plane it is, and a contact pressed moves the joint there", async () => {
  const { page } = await openPage(browser, pathOf("sample"), { reducedMotion: "reduce" });
  assert.equal(await page.getByText(/^Sagittal clock position/).count(), 1);
  assert.equal(await page.getByText("socket's rim").count(), 0);
  const { motions } = textOf("sample").rom;
  await page.getByRole("button", { name: /^ER90, Go to the end of/ }).locator("text").click();
  await settled(page);
  const [wanted] = motions.filter(({ name }) => name === "external_rotation_at_90_flexion");
  for (const angle of ["flexion", "internal_rotation"])
    assert.equal(Number(await page.getByRole("spinbutton", { name: `${angle.replace("_", " ")}, degrees`, exact: true }).inputValue()),
      wanted.at_limit_deg[angle]);
  await page.context().close();
  const rim = await openPage(browser, withText("rim", (text) => (text.rom.clock_plane = "rim")));
  assert.equal(await rim.page.getByText(/^Where on the socket's rim each motion ends/).count(), 1);
  await rim.page.context().close();
});

test("cells of the map tell their angles to who does not see them, and the outlines are explained", async () => {
  const { page } = await openPage(browser, pathOf("sample"));
  const { map } = textOf("sample");
  const labels = await page.locator("rect.cell").evaluateAll((cells) => cells.map((cell) => cell.getAttribute("aria-label")));
  assert.deepEqual(labels, map.intervals.map((list, point) => {
    const held = `flexion ${map.columns.values_deg[point % map.columns.values_deg.length]}°, adduction ` +
      `${map.rows.values_deg[Math.floor(point / map.columns.values_deg.length)]}°`;
    const free = list.map(([low, high]) => `free from ${low.toFixed(1)}° to ${high.toFixed(1)}°`).join(", ");
    return `${held}: internal rotation ${free || "nowhere free"}`;
  }));
  assert.equal(await page.getByText("more than one free interval").count(), 1);
  await page.context().close();
});

test("curves that change come first, those that are zero or empty are one line", { skip: !has("walk") && "not made" }, async () => {
  const { page } = await openPage(browser, pathOf("walk"));
  const { text, array } = readReport(pathOf("walk"));
  const kind = ({ values }) => {
    const finite = Array.from(array(values)).filter(Number.isFinite);
    return finite.length === 0 ? "empty" : finite.every((value) => value === 0) ? "zero" : "changes";
  };
  const count = (wanted) => text.recorded.curves.filter((curve) => kind(curve) === wanted).length;
  assert.ok(count("zero") > 0, "a walk of a hip that touches nothing has curves that are zero");
  assert.equal(await page.locator(".curve-plot:visible").count(), count("changes"));
  assert.match(await page.locator("details.folded summary").first().textContent(), /^Zero throughout: /);
  assert.equal(await page.locator("details.folded").count(), Number(count("zero") > 0) + Number(count("empty") > 0));
  assert.equal(await page.locator(".curve-plot:visible").first().getByText("time, s").count(), 1);
  await page.locator("details.folded").last().scrollIntoViewIfNeeded();
  await keep(page, "curves");
  await page.context().close();
});

test("a curve is pressed and moved through by arrow keys", { skip: !has("walk") && "not made" }, async () => {
  const { page } = await openPage(browser, pathOf("walk"));
  const frame = async () => Number(await page.getByRole("slider", { name: "Frame" }).inputValue());
  const curve = page.locator(".curve-plot:visible").first();
  await curve.scrollIntoViewIfNeeded();
  const box = await curve.boundingBox();
  const last = readReport(pathOf("walk")).array(textOf("walk").recorded.times_s).length - 1;
  // Half way between the ends of the axis, 52 and 442 of 460.
  await page.mouse.click(box.x + (247 / 460) * box.width, box.y + box.height / 2);
  assert.ok(Math.abs((await frame()) - last / 2) <= 2, String(await frame()));
  await curve.focus();
  const before = await frame();
  await page.keyboard.press("ArrowRight");
  await page.keyboard.press("ArrowRight");
  await page.keyboard.press("ArrowLeft");
  assert.equal(await frame(), before + 1);
  assert.equal(await curve.getAttribute("aria-valuenow"), String(before + 1));
  const flexion = readReport(pathOf("walk")).array(textOf("walk").recorded.coordinates_deg)[3 * (before + 1)];
  assert.equal(Number(await page.getByRole("spinbutton", { name: "flexion, degrees", exact: true }).inputValue()), flexion);
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
  assert.equal(await page.locator(".curve-plot:visible").first().getByText("frame", { exact: true }).count(), 1);
  assert.equal(await page.getByText("time, s").count(), 0);
  const count = readReport(pathOf("walk")).array(textOf("walk").recorded.times_s).length;
  assert.equal(await page.getByText(`: ${count} frames`).count(), 1);
  const [download] = await Promise.all([page.waitForEvent("download"),
    page.locator("section", { has: page.getByRole("heading", { name: "Recorded motion" }) }).getByRole("button", { name: "Save data" }).first().click()]);
  assert.match(readFileSync(await download.path(), "utf8"), /^frame,/);
  await page.context().close();
});

test("the numbers say how they were found: bounds, bands, bearing contact, normal ranges", async () => {
  const { page } = await openPage(browser, pathOf("sample"));
  const { rom } = textOf("sample");
  const panel = page.locator("[aria-labelledby=section-numbers]");
  const told = await panel.textContent();
  for (const wanted of ["free before it, in contact at it or past it by at most its error bound", `of ${rom.band.samples} displaced joints, seed ${rom.band.seed}`,
    `centre ${rom.band.sigma.centre_mm} mm, axes ${rom.band.sigma.axes_deg}°, surfaces ${rom.band.sigma.surface_mm} mm`,
    "Contact of the bearing surface does not end a motion", `radius ${rom.bearing.head.radius_mm.toFixed(2)} mm`,
    `radius ${rom.bearing.socket.radius_mm.toFixed(2)} mm`, `reaches ${rom.bearing.margin_mm.toFixed(2)} mm`, "Normal ranges: AAOS 1965", "right, ball joint",
    `${rom.scope.slice(1)}.`, ...rom.motions.flatMap(({ caveats }) => caveats.map(({ text, source }) => source === null ? text : `${text} (${source})`))])
    assert.ok(told.includes(wanted), wanted);
  const rows = await panel.locator("table").nth(1).locator("tbody tr").evaluateAll((all) => all.map((row) => [...row.cells].map((cell) => cell.textContent)));
  rows.forEach((cells, i) => {
    const motion = rom.motions[i];
    assert.equal(cells[0], motion.name.replaceAll("_", " "));
    assert.ok(cells[1].includes(motion.limit_deg.toFixed(1)), cells[1]);
    assert.equal(cells[3], motion.reason === "contact" ? "contact (impingement)" : "end of range");
    assert.equal(cells[6], motion.reason === "contact" ? `${motion.error_bound_deg.toPrecision(2)}°` : "–");
  });
  const heights = await panel.locator("tbody tr").evaluateAll((all) => all.map((row) => row.getBoundingClientRect().height));
  assert.ok(Math.max(...heights) < 75, `a row of ${Math.max(...heights)} pixels`);
  await page.context().close();
});

test("parameters of parts that are not as in the joint file are named, and their uncertainty in the bands", async () => {
  const { page, complaints } = await openPage(browser, pathOf("tilted"));
  const said = await page.locator("body").textContent();
  assert.ok(said.includes("Not as in the joint file: pelvis.tilt 10 deg instead of 0."), said);
  assert.match(said, /surfaces 0\.25 mm, pelvis\.tilt 3\./);
  assert.deepEqual(complaints, []);
  await page.context().close();
});
