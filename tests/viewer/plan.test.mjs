// The shape of a hip and the bone that must go, as the page shows them: against the numbers of the report.
import assert from "node:assert/strict";
import { test } from "node:test";
import { keep, openPage, openTab, pathOf, pixels, region, settled, sharedBrowser, turnTo, viewOptions } from "./browser.mjs";
import { readReport } from "./report_block.mjs";

const browser = await sharedBrowser();
const { text, array } = readReport(pathOf("plan"));

async function opened(options = {}) {
  const { page, complaints } = await openPage(browser, pathOf("plan"), options);
  if (options.answers !== false) await settled(page);
  await openTab(page, "Plan");
  return { page, complaints };
}

const detailsOf = (page, title) => page.locator(".fold", { has: page.locator("h2", { hasText: new RegExp(`^${title}$`) }) });
const panelOf = (page, name) => page.getByRole("region", { name, exact: true });

/// So many pixels of the scene have such a colour.
async function count(page, is) {
  await settled(page);
  return region(await pixels(page), is).count;
}

const minus = (said) => said.replaceAll("-", "\u2212");
const isGreen = (r, g, b) => g > r + 25 && g > b + 5;
const isVermilion = (r, g, b) => r > 170 && r > g + 50 && g > b + 20;

/// Rows of the table with this caption, cell by cell.
function rowsOf(page, caption) {
  return page.locator("table", { has: page.locator("caption", { hasText: new RegExp(`^${caption}$`) }) }).first().evaluate((table) =>
    [...table.tBodies[0].rows].map((row) => [...row.cells].map(({ textContent }) => textContent)));
}

test("targets, gains and what goes are those of the report", async () => {
  const { page, complaints } = await opened();
  const [target] = await rowsOf(page, "Targets");
  const { reach_deg, before, after, confidence_reached } = text.plan.targets[0];
  assert.deepEqual(target.slice(1), [`${before.limit_deg.toFixed(1)}°`, `${reach_deg}°`, `${after.limit_deg.toFixed(1)}°`]);
  assert.ok(after.limit_deg >= reach_deg && confidence_reached >= 0.5);
  const panel = panelOf(page, "Bone to remove");
  const said = (await panel.textContent()) + (await detailsOf(page, "Limits and notes of the plan").textContent());
  const [cut] = text.plan.cuts;
  assert.ok(said.includes(`${cut.volume_mm3.toFixed(1)} mm³ of bone are removed`) && said.includes(`${cut.deepest_mm.toFixed(2)} mm at the deepest`), said);
  for (const { text: note } of text.plan.resection_notes) assert.ok(said.includes(note), note);
  assert.equal(await panel.locator("circle.mark").count(), text.plan.curve.length);
  // Limits of the page are those without the bone.
  const motion = text.rom.motions.find(({ name }) => name === text.plan.targets[0].motion);
  assert.equal(motion.limit_deg, after.limit_deg);
  assert.deepEqual(complaints, []);
  await keep(page, "plan");
  await page.context().close();
});

test("what is planned is said by a ribbon, and in figures and sentence from the limit before, and on paper", async () => {
  const { page } = await opened();
  const [cut] = text.plan.cuts, done = `without ${cut.volume_mm3.toFixed(1)} mm³ of femur`;
  assert.equal(text.joint.planned, done.replace("mm³", "mm3"));
  const first = text.rom.motions.find(({ name }) => name === text.plan.targets[0].motion);
  const nowOf = (motion) => {
    const { limit_deg, reason } = text.plan.limits.find((each) => each.motion === motion.name).before;
    return reason === "end_of_range" ? `>${limit_deg}` : limit_deg.toFixed(1);
  };
  const ribbon = `After a planned cut of ${done.replace("without ", "")}`;
  assert.equal(await page.locator("#ribbon").textContent(), ribbon);
  assert.ok((await page.locator("#sentence").textContent()).startsWith("Planned: "));
  const figures = await page.locator("#results .result").allTextContents();
  assert.ok(figures.some((said) => said.includes(`${nowOf(first)} → `)), figures.join("; "));
  const [sheet] = await page.locator("#paper .sheet").allTextContents();
  for (const wanted of [ribbon, text.plan.targets[0].text.replaceAll(" deg", "°").replaceAll("mm3", "mm³"), `${cut.volume_mm3.toFixed(1)} mm³ of bone are removed`, `${cut.deepest_mm.toFixed(2)} mm at the deepest`, `${nowOf(first)} → `, "Targets"])
    assert.ok(sheet.includes(wanted), wanted);
  await page.context().close();
});

test("the bone that went is a colour, in every pose, and a surface over the cut", async () => {
  const { page } = await opened({ fragment: "#hidden=fixed" });
  await viewOptions(page);
  assert.equal(await page.getByLabel("Colour", { exact: true }).inputValue(), "removed");
  const deepest = text.plan.cuts[0].deepest_mm, depths = array(text.plan.surfaces.mobile.depth_mm), vertices = array(text.plan.surfaces.mobile.lowered);
  const vertex = vertices[depths.indexOf(Math.max(...depths))];
  const readout = async () => {
    await viewOptions(page);
    await page.getByLabel("Vertex of").selectOption("mobile");
    await page.getByLabel("Number of a vertex").fill(String(vertex));
    await page.getByRole("button", { name: "Show vertex" }).click();
    return page.locator("#hover").textContent();
  };
  assert.match(await readout(), new RegExp(`vertex ${vertex}: ${deepest.toFixed(2)}`));
  await openTab(page, "Motion");
  await turnTo(page, { flexion: 60 });
  await openTab(page, "Plan");
  assert.match(await readout(), new RegExp(`vertex ${vertex}: ${deepest.toFixed(2)}`));
  await viewOptions(page, false);
  assert.equal(await count(page, isGreen), 0);
  await page.getByLabel("Show the removed bone").check();
  assert.ok(await count(page, isGreen) > 20);
  await keep(page, "plan_removed");
  await page.getByLabel("Show the removed bone").uncheck();
  assert.equal(await count(page, isGreen), 0);
  await page.context().close();
});

test("measures have their values, bands, reasons and definitions, and are drawn", async () => {
  const { page, complaints } = await opened({ fragment: "#fixed_opacity=0.4&colour=none" });
  await page.locator("summary", { hasText: "Shape of the hip" }).click();
  const panel = panelOf(page, "Shape of the hip");
  const said = (await panel.textContent()) + (await detailsOf(page, "Measures of the hip").textContent());
  for (const [part, caption] of [["femur", "Femur"], ["acetabulum", "Acetabulum"], ["both", "Both bones"]]) {
    const measures = text.measures.measures.filter((measure) => measure.part === part);
    const rows = await rowsOf(page, caption);
    assert.equal(rows.length, measures.length);
    measures.forEach(({ value, band, unit }, i) => {
      const digits = unit === "1" ? 3 : unit === "h" ? 2 : 1;
      if (value === null) assert.equal(rows[i][1], "–");
      else assert.ok(rows[i][1].startsWith(minus(value.toFixed(digits))), rows[i].join());
      if (band?.p5 != null) assert.equal(rows[i][2], minus(`${band.p5.toFixed(digits)} to ${band.p95.toFixed(digits)}`));
    });
  }
  for (const { value, why_none, note, definition } of text.measures.measures) {
    if (value === null) assert.ok(said.includes(why_none), why_none);
    if (note) assert.ok(said.includes(note), note);
    assert.ok(said.includes(definition), definition);
  }
  for (const sentence of text.measures.left_out) assert.ok(said.includes(sentence), sentence);
  assert.equal(await count(page, isVermilion), 0);
  await page.getByLabel("Draw axes, rim and alpha points on the bones").check();
  assert.ok(await count(page, isVermilion) > 50);
  await keep(page, "shape");
  assert.deepEqual(complaints, []);
  await page.context().close();
});

test("without WebAssembly the plan is there too", async () => {
  const { page } = await opened({ script: "delete globalThis.WebAssembly", answers: false });
  await panelOf(page, "Bone to remove").waitFor();
  await viewOptions(page);
  assert.equal(await page.getByLabel("Colour", { exact: true }).inputValue(), "removed");
  await page.context().close();
});
