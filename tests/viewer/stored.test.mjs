// The page in a browser without WebAssembly: poses that the report holds, and nothing that looks as if it computed.
import assert from "node:assert/strict";
import { test } from "node:test";
import { has, angleOf, isFemur, keep, openPage, openTab, pathOf, pixels, region, sharedBrowser, tile, viewOptions } from "./browser.mjs";
import { readReport } from "./report_block.mjs";

const browser = await sharedBrowser();

async function openStored(name) {
  const opened = await openPage(browser, pathOf(name), { script: "delete globalThis.WebAssembly", answers: false, reducedMotion: "reduce" });
  await opened.page.getByText("does not run WebAssembly").waitFor();
  return opened;
}

const shownAngle = angleOf;

test("without WebAssembly there are precomputed poses and a notice", async () => {
  const { page, complaints } = await openStored("sample");
  const poses = page.getByRole("combobox", { name: "Poses" });
  await poses.selectOption({ label: "flexion" });
  assert.ok((await shownAngle(page, "flexion")) > 90);
  assert.deepEqual(complaints, []);
  await keep(page, "without_webassembly");
  await page.context().close();
});

test("without WebAssembly motions and figures go to stored poses, colours and bones with them", async () => {
  const { page } = await openStored("sample");
  const { motions } = readReport(pathOf("sample")).text.rom;
  const motion = (wanted) => motions.find(({ name }) => name === wanted);
  const femur = async () => region(await pixels(page), (r, g, b) => b > r + 8);
  const before = await femur();
  await tile(page, "flexion").click();
  assert.equal(await shownAngle(page, "flexion"), motion("flexion").at_limit_deg.flexion);
  assert.equal(await page.getByRole("combobox", { name: "Poses" }).inputValue(), "flexion");
  await page.waitForTimeout(200);
  assert.ok((await femur()).y < before.y - 0.05, "the femur is up");
  await tile(page, "FADIR").click();
  assert.equal(await shownAngle(page, "internal rotation"), motion("fadir").at_limit_deg.internal_rotation);
  await page.getByRole("button", { name: "Back to zero" }).click();
  assert.equal(await shownAngle(page, "flexion"), 0);
  await page.context().close();
});

test("without WebAssembly what would have to be computed cannot be asked for", async () => {
  const { page } = await openStored("zones");
  await viewOptions(page);
  const inputs = await page.locator(".slider input").all();
  assert.ok(inputs.length >= 6);
  for (const input of inputs) assert.equal(await input.isDisabled(), true);
  assert.equal(await page.getByRole("button", { name: "Compute a map" }).count(), 0);
  assert.deepEqual(await page.getByLabel("Colour", { exact: true }).locator("option").allTextContents(), ["radial gap", "none"]);
  assert.equal(await page.getByLabel("Mark triangles in contact").count(), 0);
  await page.context().close();
});

test("without WebAssembly a recorded motion plays by its stored poses", { skip: !has("walk") && "not made" }, async () => {
  const { page } = await openStored("walk");
  await viewOptions(page);
  await page.getByLabel("Colour", { exact: true }).selectOption("none");
  await page.getByRole("button", { name: "right", exact: true }).click();
  await viewOptions(page, false);
  await openTab(page, "Figures");
  await page.getByRole("slider", { name: "Frame", exact: true }).fill("0");
  await page.waitForTimeout(200);
  const first = region(await pixels(page), isFemur);
  await page.getByRole("slider", { name: "Frame", exact: true }).fill("30");
  await page.waitForTimeout(200);
  const later = region(await pixels(page), isFemur);
  assert.ok(Math.abs(later.x - first.x) > 0.01, `${first.x} and ${later.x}`);
  await page.context().close();
});
