// Notes of the checks in three grades, and joints that are planned.
import assert from "node:assert/strict";
import { test } from "node:test";
import { axeSource, openPage, openTab, panelsPlaced, pathOf, sharedBrowser, settled } from "./browser.mjs";
import { readReport, withText } from "./report_block.mjs";

const browser = await sharedBrowser();

async function opened(name, change, from) {
  const { page } = await openPage(browser, withText(name, change, from), { answers: false });
  await panelsPlaced(page);
  return page;
}

const wrong = { code: "wrong_side", text: "the side is left, but hip bone lies lateral of its socket" };
const finding = { code: "open_mesh", text: "femur has a boundary" };
const remark = { code: "coarse_mesh", text: "limits may be off by 2.4 degrees" };
const colourOf = (page, selector) => page.locator(selector).first().evaluate((element) => getComputedStyle(element).color);

test("a joint that is set up wrongly says so in place of the sentence, and its numbers are grey, whatever is pressed", async () => {
  const page = await opened("wrong_side", ({ rom }) => rom.notes.push(wrong, finding, remark));
  const sentence = `Set up wrongly, no number holds: ${wrong.text}.`;
  assert.equal(await page.locator("#sentence").textContent(), sentence);
  const quiet = await colourOf(page, ".result-normal");
  assert.equal(await colourOf(page, ".result-value b"), quiet);
  assert.equal(await colourOf(page, ".tile-value b"), quiet);
  await page.locator(".result").first().click();
  await page.locator(".result[aria-current]").waitFor();
  assert.equal(await page.locator("#sentence").textContent(), sentence);
  assert.ok((await page.locator("#paper").textContent()).includes(sentence));
  await page.evaluate(axeSource);
  const { violations } = await page.evaluate(() => axe.run("#strip"));
  assert.deepEqual(violations.map(({ id }) => id), []);
  await page.context().close();
});

test("a finding is amber with its text, and a remark on how exact limits are is a grey word", async () => {
  const both = await opened("finding", ({ rom }) => rom.notes.push(finding, remark));
  assert.match(await both.locator("#noted").textContent(), /^1 note from the checks: femur has a boundary 1 remark on how exact the limits are/);
  assert.equal(await both.locator("#noted.warning").count(), 1);
  assert.match(await both.locator("#sentence").textContent(), / ends at /);
  await both.context().close();
  const page = await opened("remark", ({ rom }) => rom.notes.push(remark, { code: "translation_ends", text: "the record ends before the range" }));
  assert.match(await page.locator("#noted").textContent(), /^2 remarks on how exact the limits are/);
  assert.equal(await page.locator("#noted.warning").count(), 0);
  await page.context().close();
});

test("a comparison says with what, tells files of one name apart, and says planned if the joint after is", async () => {
  const { rom, before } = readReport(pathOf("compared")).text;
  // Both joint files have the same bytes, and both fixed meshes; the femurs differ.
  const of = ({ provenance }) => `hip.toml (femur.ply: SHA-256 ${provenance.mobile_mesh.sha256.slice(0, 8)}…)`;
  assert.notEqual(of(before.rom), of(rom));
  const page = await opened("compared_planned", ({ joint }) => (joint.planned = "without 164.1 mm3 of femur"), "compared");
  assert.ok((await page.locator("#title").textContent()).startsWith(`Planned, without 164.1 mm³ of femur · compared with ${of(before.rom)} · `));
  const plan = await page.locator("#plan-panels").textContent();
  assert.ok(plan.includes(`Before: ${of(before.rom)}. After: ${of(rom)}.`), plan);
  assert.match(await page.locator("#sentence").textContent(), /^Planned: /);
  assert.match(await page.locator(".result").first().textContent(), / now [>\d]/);
  await page.context().close();
});

test("strokes of the brush make the joint a planned one until they are undone", async () => {
  const { page } = await openPage(browser, pathOf("sample"), { reducedMotion: "reduce" });
  await settled(page);
  const [title, sentence] = await Promise.all(["#title", "#sentence"].map((each) => page.locator(each).textContent()));
  await openTab(page, "Plan");
  await page.getByRole("button", { name: "Stroke where it ends" }).click();
  await page.waitForFunction(() => document.getElementById("title").textContent.startsWith("Planned"));
  assert.match(await page.locator("#title").textContent(), /^Planned, by hand without [\d.]+ mm³ of femur · /);
  assert.equal(await page.locator("#sentence").textContent(), `Before the strokes: ${sentence}`);
  await page.getByRole("button", { name: "Undo stroke" }).click();
  await page.waitForFunction((said) => document.getElementById("title").textContent === said, title);
  assert.equal(await page.locator("#sentence").textContent(), sentence);
  await page.context().close();
});
