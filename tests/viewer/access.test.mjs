// The page for everybody: accessibility rules, keyboard, touch, small and large windows, light and dark.
import assert from "node:assert/strict";
import { test } from "node:test";
import { angleOf, axeSource, has, keep, openPage, openTab, pathOf, settled, sharedBrowser, turnTo } from "./browser.mjs";

const browser = await sharedBrowser();

for (const colorScheme of ["light", "dark"])
  for (const name of ["sample", "plan", "compared", "knee", "placed", "swept"])
    test(`axe finds nothing in any tab of ${name} (${colorScheme})`, { skip: !has(name) && "not made" }, async () => {
      const { page } = await openPage(browser, pathOf(name), { colorScheme });
      await settled(page);
      await page.evaluate(axeSource);
      for (const tab of await page.getByRole("tab").allTextContents()) {
        await openTab(page, tab);
        const { violations } = await page.evaluate(() => globalThis.axe.run());
        assert.deepEqual(violations.map(({ id, nodes }) => `${tab}: ${id}: ${nodes.map(({ html }) => html.slice(0, 120)).join(" ")}`), []);
        await keep(page, `${name}_${tab}_${colorScheme}`);
      }
      await page.context().close();
    });

test("everything is reached and moved by the keyboard alone, in few stops of the tabulator", async () => {
  const { page } = await openPage(browser, pathOf("sample"), { reducedMotion: "reduce" });
  await settled(page);
  const focused = () => page.evaluate(() => document.activeElement.getAttribute("aria-label") ?? document.activeElement.textContent);
  const round = async () => {
    const reached = [];
    for (let i = 0; i < 60; ++i) {
      await page.keyboard.press("Tab");
      if (await page.evaluate(() => document.activeElement === document.body)) break;
      reached.push(await focused());
    }
    return reached;
  };
  const motion = await round();
  assert.ok(motion.length <= 30, `${motion.length} stops: ${motion.join(" | ")}`);
  assert.equal(motion[0], "Skip to the motions");
  for (const wanted of [/three dimensions/, /^flexion, degrees/, /^Back to zero/, /^Copy link/, /^View options/, /^Motion$/, /^flexion 1/])
    assert.ok(motion.some((name) => wanted.test(name ?? "")), `${wanted} of ${motion.join(" | ")}`);
  // Slider, tiles, tabs and cells of the map by arrow keys.
  await page.locator("#angle-flexion").focus();
  await page.keyboard.press("End");
  await settled(page);
  assert.match(await page.locator("#answer").textContent(), /^In contact/);
  await page.locator(".tile").first().focus();
  for (let i = 0; i < 3; ++i) await page.keyboard.press("ArrowDown");
  await page.keyboard.press("ArrowRight");
  assert.match(await focused(), /^FADIR/);
  await page.keyboard.press("Enter");
  await settled(page);
  assert.equal(await angleOf(page, "adduction"), 15);
  await page.locator("#tab-motion").focus();
  await page.keyboard.press("ArrowRight");
  assert.equal(await page.locator("#panel-figures").isVisible(), true);
  await page.locator("#side rect.cell").first().focus();
  await page.keyboard.press("ArrowRight");
  await page.keyboard.press("Enter");
  await settled(page);
  assert.equal(await angleOf(page, "flexion"), 10);
  await page.keyboard.press("u");
  assert.equal(await angleOf(page, "adduction"), 15);
  await page.keyboard.press("?");
  assert.equal(await page.locator("#help").evaluate((card) => card.open), true);
  await page.keyboard.press("Escape");
  await page.keyboard.press("1");
  assert.equal(await page.locator("#panel-motion").isVisible(), true);
  const camera = () => page.evaluate(() => location.hash);
  await page.locator("#scene > canvas").first().focus();
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

/// Whether all of it is in the window.
const isSeen = (page, selector) => page.locator(selector).evaluateAll((all) => all.length > 0 && all.every((element) => {
  const { top, bottom, left, right, width } = element.getBoundingClientRect();
  return width > 0 && top >= 0 && left >= 0 && bottom <= innerHeight + 0.5 && right <= innerWidth + 0.5;
}));

for (const [width, height, options] of [[1440, 900, {}], [390, 844, { isMobile: true, hasTouch: true }], [3840, 2160, {}]])
  test(`the first screen of ${width} × ${height} has four results, the sentence and the joint`, async () => {
    const { page } = await openPage(browser, pathOf("sample"), { width, height, ...options });
    await settled(page);
    await keep(page, `first_${width}`);
    assert.equal(await page.locator(".result").count(), 4);
    assert.ok(await isSeen(page, ".result"));
    assert.ok(await isSeen(page, "#sentence"));
    assert.ok(await isSeen(page, "#scene"));
    assert.match(await page.locator("#sentence").textContent(), /^Internal rotation at 90° flexion ends at [\d.]+° \(\d+–\d+\), neck on rim at \d+:\d\d, living hips some 4° earlier; no motion ends before its clinical range or the 27\.9° of simulated healthy hips\.$/);
    if (width > 1000) {
      // Nothing scrolls: neither the page nor a panel but the details.
      for (const tab of ["Motion", "Figures"]) {
        const button = page.getByRole("tab", { name: tab, exact: true });
        if (await button.isVisible()) await button.click();
        assert.deepEqual(await page.evaluate(() => [document.documentElement, ...document.querySelectorAll(".panel:not([hidden])")]
          .filter((element) => element.scrollHeight > element.clientHeight + 1 || element.scrollWidth > element.clientWidth + 1)
          .map((element) => `${element.id || element.tagName} ${element.scrollHeight} of ${element.clientHeight}`)), []);
      }
      if (width > 3000) assert.ok(await isSeen(page, "#panel-figures"), "figures stand beside the motions");
    } else {
      // The scene stays while the sliders go by.
      await page.locator("#angle-internal_rotation").scrollIntoViewIfNeeded();
      await page.evaluate(() => scrollBy(0, 200));
      const { top, height: high } = await page.locator("#scene").evaluate((element) => element.getBoundingClientRect().toJSON());
      assert.ok(Math.abs(top) < 1 && Math.abs(high / height - 0.45) < 0.01, `${top}, ${high}`);
    }
    await page.context().close();
  });

test("pressing everything moves nothing", async () => {
  const { page } = await openPage(browser, pathOf("sample"), { width: 1440, height: 900, reducedMotion: "reduce" });
  await settled(page);
  const boxes = () => page.evaluate(() => [...document.querySelectorAll("header button, .result, #sentence, #scene, [role=tab], .slider, .tile, .motion-row button, #status")]
    .filter((element) => element.getClientRects().length)
    .map((element) => Object.values(element.getBoundingClientRect().toJSON()).join()));
  const before = await boxes();
  assert.ok(before.length > 25);
  const presses = page.locator(".result, .tile, .motion-row button, #view-tools > button");
  const count = await presses.count();
  for (let i = 0; i < count; ++i) {
    if (await presses.nth(i).isDisabled()) continue;
    await presses.nth(i).click();
    await settled(page);
    assert.deepEqual(await boxes(), before, await presses.nth(i).textContent());
  }
  await turnTo(page, { flexion: 120, internal_rotation: 60 });
  await page.locator("#exit:visible").waitFor();
  assert.deepEqual(await boxes(), before);
  await page.context().close();
});

test("fingers turn the joint", async () => {
  const { page } = await openPage(browser, pathOf("sample"), { width: 390, height: 844, isMobile: true, hasTouch: true });
  await settled(page);
  await page.locator("#scene").scrollIntoViewIfNeeded();
  await page.waitForTimeout(400);
  const before = await page.evaluate(() => location.hash);
  const box = await page.locator("#scene > canvas").boundingBox();
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
