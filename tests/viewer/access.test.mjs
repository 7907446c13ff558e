// The page for everybody: accessibility rules, keyboard, touch, small and large windows, light and dark.
import assert from "node:assert/strict";
import { test } from "node:test";
import { axeSource, keep, openPage, pathOf, settled, sharedBrowser } from "./browser.mjs";

const browser = await sharedBrowser();

for (const colorScheme of ["light", "dark"])
  test(`axe finds nothing serious (${colorScheme})`, async () => {
    const { page } = await openPage(browser, pathOf("sample"), { colorScheme });
    await settled(page);
    await page.evaluate(axeSource);
    const { violations } = await page.evaluate(() => globalThis.axe.run());
    const serious = violations.filter(({ impact }) => ["serious", "critical"].includes(impact));
    assert.deepEqual(serious.map(({ id, nodes }) => `${id}: ${nodes.map(({ html }) => html.slice(0, 120)).join(" ")}`), []);
    await keep(page, `whole_${colorScheme}`, { fullPage: true });
    await page.context().close();
  });

test("everything is reached and moved by the keyboard alone", async () => {
  const { page } = await openPage(browser, pathOf("sample"), { reducedMotion: "reduce" });
  const focused = () => page.evaluate(() => document.activeElement.getAttribute("aria-label") ?? document.activeElement.textContent);
  const reached = [];
  for (let i = 0; i < 120; ++i) {
    await page.keyboard.press("Tab");
    const name = await focused();
    reached.push(name);
    if (/^flexion, degrees/.test(name) && (await page.evaluate(() => document.activeElement.type)) === "range") {
      await page.keyboard.press("End");
      await settled(page);
      assert.match(await page.locator("#answer").textContent(), /^In contact/);
      await page.keyboard.press("Home");
    }
    if (/^Go to the end of fadir/.test(name)) {
      await page.keyboard.press("Enter");
      await settled(page);
    }
  }
  for (const wanted of [/three dimensions/, /^flexion, degrees/, /^Back to zero/, /^fadir/, /^front/, /^Go to the end of fadir/, /Save as SVG/])
    assert.ok(reached.some((name) => wanted.test(name ?? "")), String(wanted));
  assert.equal(await page.getByRole("spinbutton", { name: "adduction, degrees" }).inputValue(), "15");
  const camera = () => page.evaluate(() => location.hash);
  await page.locator("#scene canvas").focus();
  await page.waitForTimeout(400);
  const before = await camera();
  for (let i = 0; i < 4; ++i) await page.keyboard.press("ArrowLeft");
  await page.waitForFunction((was) => location.hash !== was, before);
  await page.context().close();
});

for (const [name, size] of [["phone", { width: 390, height: 844, isMobile: true, hasTouch: true, deviceScaleFactor: 2 }], ["4k", { width: 3840, height: 2160 }]])
  test(`nothing is cut off on a window like that of a ${name}`, async () => {
    const { page } = await openPage(browser, pathOf("sample"), size);
    await settled(page);
    await keep(page, name);
    assert.ok(await page.evaluate(() => document.documentElement.scrollWidth <= innerWidth));
    const scene = await page.locator("#scene").boundingBox();
    assert.ok(scene.width > 0.5 * Math.min(size.width, 600) && scene.height > 200);
    await page.context().close();
  });

test("all of the scene, its scale and what the pointer tells are on the first screen", async () => {
  const { page } = await openPage(browser, pathOf("sample"));
  await settled(page);
  for (const part of ["#scene", "#legend", "#hover"]) {
    const { y, height } = await page.locator(part).evaluate((element) => element.getBoundingClientRect().toJSON());
    assert.ok(y >= 0 && y + height <= 800, `${part} ends at ${y + height} of 800`);
  }
  await page.context().close();
});

test("on a large screen letters are larger and panels take their share", async () => {
  const { page } = await openPage(browser, pathOf("sample"), { width: 3840, height: 2160 });
  await settled(page);
  const [scene, panels] = [await page.locator("#scene").boundingBox(), await page.locator("#panels").boundingBox()];
  assert.ok(panels.width > 0.6 * scene.width, `${panels.width} beside ${scene.width}`);
  assert.ok(Number.parseFloat(await page.evaluate(() => getComputedStyle(document.body).fontSize)) >= 20);
  const [motion, map] = await page.evaluate(() => ["motion", "range-of-motion-map"].map((name) =>
    document.querySelector(`[aria-labelledby=section-${name}]`).getBoundingClientRect().left));
  assert.ok(map > motion + 400, "in two columns");
  await page.context().close();
});

test("fields show all digits of a limit", async () => {
  const { page } = await openPage(browser, pathOf("sample"), { reducedMotion: "reduce" });
  await page.getByRole("button", { name: "flexion", exact: true }).click();
  await settled(page);
  const field = page.getByRole("spinbutton", { name: "flexion, degrees", exact: true });
  assert.ok((await field.inputValue()).length > 12);
  assert.ok(await field.evaluate((input) => {
    const context = document.createElement("canvas").getContext("2d");
    context.font = getComputedStyle(input).font;
    // The stepper takes a sixth of an inch.
    return context.measureText(input.value).width < input.clientWidth - 16 - 16;
  }));
  await page.context().close();
});

test("fingers turn the joint", async () => {
  const { page } = await openPage(browser, pathOf("sample"), { width: 390, height: 844, isMobile: true, hasTouch: true });
  await settled(page);
  await page.locator("#scene").scrollIntoViewIfNeeded();
  await page.waitForTimeout(400);
  const before = await page.evaluate(() => location.hash);
  const box = await page.locator("#scene canvas").boundingBox();
  const client = await page.context().newCDPSession(page);
  const touch = (type, x) => client.send("Input.dispatchTouchEvent", {
    type, touchPoints: type === "touchEnd" ? [] : [{ x, y: box.y + box.height / 2 }],
  });
  await touch("touchStart", box.x + 100);
  for (let x = 100; x <= 220; x += 20) await touch("touchMove", box.x + x);
  await touch("touchEnd");
  await page.waitForFunction((was) => location.hash !== was, before);
  await page.context().close();
});
