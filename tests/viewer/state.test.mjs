// The address of the page remembers what is seen, and brings it back.
import assert from "node:assert/strict";
import { test } from "node:test";
import { keep, openPage, pathOf, pixels, settled, sharedBrowser, turnTo, viewOptions } from "./browser.mjs";

const browser = await sharedBrowser();

test("a slider turns the joint, the address remembers it, and another page opened there shows the same", async () => {
  const { page } = await openPage(browser, pathOf("sample"));
  await turnTo(page, { flexion: 110, adduction: 20, internal_rotation: 40 });
  const answer = await page.locator("#answer").textContent();
  assert.match(answer, /^In contact/);
  await page.waitForFunction(() => location.hash.includes("internal_rotation=40"));
  const fragment = new URL(page.url()).hash;
  const again = await openPage(browser, pathOf("sample"), { fragment });
  await settled(again.page);
  assert.equal(await again.page.locator("#answer").textContent(), answer);
  await page.context().close();
  await again.page.context().close();
});

/// State of the controls.
const controls = (page) => page.evaluate(() => [...document.querySelectorAll("#side input, #side select, #view-options input, #view-options select")].map((control) =>
  `${control.getAttribute("aria-label") ?? control.id ?? control.labels[0]?.textContent}: ${control.type === "checkbox" ? control.checked : control.value}`));

/// Waits for the colours of the pose that was asked for last.
async function coloured(page) {
  await settled(page);
  await page.evaluate(async () => {
    await condyle.query({ of: "values", at: { angles: [0, 0, 0], translation: [0, 0, 0] }, quantity: "gap" });
    await new Promise((drawn) => requestAnimationFrame(() => requestAnimationFrame(drawn)));
  });
}

test("camera, colours, scale, hidden bones, opacity, cut and zone come back with a link, pixel by pixel", async () => {
  const { page } = await openPage(browser, pathOf("zones"));
  await viewOptions(page);
  await page.getByRole("button", { name: "right", exact: true }).click();
  await page.getByLabel("Colour", { exact: true }).selectOption("nearest");
  await page.getByLabel("Scale to").fill("5");
  await page.getByRole("slider", { name: "Opacity of femur" }).fill("0.6");
  await page.getByLabel("Cut away").selectOption("y");
  await page.getByRole("slider", { name: "Cut at" }).fill("20");
  await page.getByLabel("Mark the impingement zone of").selectOption("fadir");
  await turnTo(page, { flexion: 70.123456789, adduction: 5 });
  await page.waitForFunction(() => ["flexion=70.123456789", "adduction=5", "colour=nearest", "scale=5", "mobile_opacity=0.6", "clip=y%3A20",
    "zone=fadir", "camera="].every((field) => location.hash.includes(field)));
  const fragment = new URL(page.url()).hash;
  // A field shows what was typed until it is left.
  await page.evaluate(() => document.activeElement.blur());
  await coloured(page);
  await keep(page, "shared_view");
  const again = await openPage(browser, pathOf("zones"), { fragment });
  await coloured(again.page);
  assert.deepEqual(await controls(again.page), await controls(page));
  const [before, after] = [await pixels(page), await pixels(again.page)];
  assert.deepEqual([after.width, after.height], [before.width, before.height]);
  let other = 0;
  for (let y = 0; y < before.height; ++y)
    for (let x = 0; x < before.width; ++x)
      if (before.at(x, y).some((value, k) => Math.abs(value - after.at(x, y)[k]) > 40)) ++other;
  // The address has the camera to a tenth of a millimetre: edges may move by a pixel.
  assert.ok(other < 0.005 * before.width * before.height, `${other} pixels differ`);
  await page.context().close();
  await again.page.context().close();
});

test("another address in an open page is applied, and what it leaves out is as usual", async () => {
  const { page } = await openPage(browser, pathOf("zones"), { fragment: "#flexion=30&hidden=fixed&fixed_opacity=0.5&clip=x:10&colour=depth&scale=2" });
  await settled(page);
  await viewOptions(page);
  assert.equal(await page.getByLabel("Show hip bone").isChecked(), false);
  assert.equal(await page.getByLabel("Colour", { exact: true }).inputValue(), "depth");
  assert.equal(await page.getByLabel("Scale to").inputValue(), "2");
  await page.evaluate(() => (location.hash = "#adduction=-20&zone=fadir&hidden=mobile"));
  await page.waitForFunction(() => document.querySelector("input[aria-label='adduction, degrees'][role=spinbutton]").getAttribute("aria-valuenow") === "-20");
  assert.equal(await page.getByRole("spinbutton", { name: "flexion, degrees", exact: true }).inputValue(), "0.0");
  assert.equal(await page.getByLabel("Show hip bone").isChecked(), true);
  assert.equal(await page.getByLabel("Show femur").isChecked(), false);
  assert.equal(await page.getByRole("slider", { name: "Opacity of hip bone" }).inputValue(), "1");
  assert.equal(await page.getByLabel("Cut away").inputValue(), "none");
  assert.equal(await page.getByLabel("Colour", { exact: true }).inputValue(), "gap");
  assert.equal(await page.getByLabel("Mark the impingement zone of").inputValue(), "fadir");
  await page.context().close();
});

test("nonsense in the address is as if it were not there", async () => {
  const { page, complaints } = await openPage(browser, pathOf("zones"), {
    fragment: "#flexion=far&colour=purple&scale=-3&mobile_opacity=7&clip=w:1&hidden=nose&zone=none&camera=1,2",
  });
  await settled(page);
  const plain = await openPage(browser, pathOf("zones"));
  assert.deepEqual(await controls(page), await controls(plain.page));
  assert.deepEqual(complaints, []);
  await page.context().close();
  await plain.page.context().close();
});

test("the address is checked as a field is: what none would take is refused in a line, and the rest is applied", async () => {
  const { page } = await openPage(browser, pathOf("sample"), { fragment: "#flexion=500&adduction=10&internal_rotation=1e9&x=9999" });
  await settled(page);
  const said = await page.locator("#messages").textContent();
  for (const line of ["flexion=500 in the address: 500° is not between \u2212180° and 180°: ignored.", "internal_rotation=1e9 in the address: 1000000000° is not between",
    "x=9999 in the address: The joint's centre is held: ignored."]) assert.ok(said.includes(line), said);
  const values = await page.locator("#side input[role=spinbutton]").evaluateAll((fields) => fields.slice(0, 3).map((field) => field.getAttribute("aria-valuenow")));
  assert.deepEqual(values, ["0", "10", "0"]);
  await page.context().close();
});
