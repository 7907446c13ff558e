// What stands where: on every tab of every report, in windows from a phone's to a large screen's. CONDYLE_LONG_TESTS=1 takes all reports.
import assert from "node:assert/strict";
import { readdirSync } from "node:fs";
import { test } from "node:test";
import { axeSource, has, keep, openPage, openTab, pathOf, reports, settled, sharedBrowser, viewOptions } from "./browser.mjs";

const browser = await sharedBrowser();
const all = readdirSync(reports).filter((name) => name.endsWith(".html") && !name.startsWith(".")).map((name) => name.replace(/\.html$/, ""));
const names = process.env.CONDYLE_LONG_TESTS ? all : ["sample", "plan", "swept", "knee", "vhf_right"].filter(has);
const desktops = [[1024, 768], [1280, 800], [1366, 768], [1440, 900], [3840, 2160]], upright = [[390, 844], [768, 1024]];

/// Nothing here depends on what the scene draws, which takes a machine without a graphics card long on a large screen.
const withoutDrawing = "for (const draw of ['drawElements', 'drawArrays']) WebGL2RenderingContext.prototype[draw] = () => undefined;";

async function opened(name, options = {}) {
  const { page } = await openPage(browser, pathOf(name), { reducedMotion: "reduce", script: withoutDrawing, ...options });
  page.setDefaultTimeout(90000);
  await settled(page);
  return page;
}

/// Goes through what can be seen: each tab, each figure, each fold of the plan.
async function everywhere(page, look) {
  for (const tab of await page.getByRole("tab").allTextContents()) {
    const button = page.getByRole("tab", { name: tab, exact: true });
    if (!(await button.isVisible())) continue;
    await openTab(page, tab);
    const inside = tab === "Figures" ? page.locator(".segments input") : tab === "Plan" ? page.locator("#plan-panels > .fold > summary") : null;
    const count = inside ? await inside.count() : 0;
    await page.evaluate(() => new Promise((drawn) => requestAnimationFrame(() => requestAnimationFrame(drawn))));
    if (count === 0) await look(tab);
    for (let i = 0; i < count; ++i) {
      const each = inside.nth(i), said = tab === "Plan" ? await each.textContent() : await each.inputValue();
      if (tab === "Plan") await each.evaluate((summary) => (summary.parentElement.open = true));
      else await each.check({ force: true });
      await page.evaluate(() => new Promise((drawn) => requestAnimationFrame(() => requestAnimationFrame(drawn))));
      await look(`${tab}, ${said}`);
    }
  }
}

/// What has more in it than it shows, by its own scroll bar or without one; sideways a table's box may have.
const scrolling = (page) => page.evaluate(() => [document.documentElement, ...document.querySelectorAll("#screen *")].filter((element) => {
  if (!element.checkVisibility() || element.closest("#panel-details, svg, #scene")) return false;
  const { overflowY, overflowX } = getComputedStyle(element), isRoot = element === document.documentElement;
  return ((isRoot || /auto|scroll/.test(overflowY)) && element.scrollHeight > element.clientHeight + 1) ||
    ((isRoot || /auto|scroll/.test(overflowX)) && element.scrollWidth > element.clientWidth + 1);
}).map((element) => `${element.tagName} ${element.id || element.className}: ${element.scrollWidth} × ${element.scrollHeight} in ${element.clientWidth} × ${element.clientHeight}`));

/// Letters smaller than 11 pixels as they are on the screen, those of scaled pictures too.
const smallLetters = (page) => page.evaluate(() => {
  const found = [], walker = document.createTreeWalker(document.getElementById("screen"), NodeFilter.SHOW_TEXT);
  while (walker.nextNode()) {
    const element = walker.currentNode.parentElement;
    if (!walker.currentNode.data.trim() || !element.checkVisibility({ visibilityProperty: true }) || element.getBoundingClientRect().width < 2) continue;
    if (element.closest("title, option, script")) continue;
    const size = parseFloat(getComputedStyle(element).fontSize) * (element.ownerSVGElement ? Math.abs(element.getScreenCTM().d || element.getScreenCTM().b) : 1);
    if (size < 10.95) found.push(`${size.toFixed(1)} px: ${walker.currentNode.data.trim().slice(0, 40)}`);
  }
  return found;
});

for (const name of names) {
  test(`nothing of ${name} scrolls but details, and no letter is below 11 pixels`, async () => {
    const page = await opened(name);
    const said = [];
    for (const [width, height] of [...desktops, ...upright]) {
      await page.setViewportSize({ width, height });
      await everywhere(page, async (where) => {
        const note = (lines) => said.push(...lines.map((line) => `${width} × ${height}, ${where}: ${line}`));
        note(await smallLetters(page));
        // A page that is upright goes by under its scene.
        if (!where.startsWith("Details")) note((await scrolling(page)).filter((line) => width > 900 || !line.startsWith("HTML ") || Number(/: (\d+)/.exec(line)[1]) > width));
      });
      if (name === names[0] || process.env.CONDYLE_LONG_TESTS) await keep(page, `layout_${name}_${width}`);
    }
    assert.deepEqual(said, []);
    await page.context().close();
  });

  test(`no name of ${name} is that of a file or a program`, async () => {
    const page = await opened(name);
    const said = [];
    await everywhere(page, async (where) => {
      if (where.startsWith("Details")) return;
      const texts = await page.evaluate(() => [document.getElementById("screen").innerText, document.getElementById("paper").querySelector(".sheet").textContent,
        ...[...document.querySelectorAll("#screen [aria-label], #screen [title], #screen svg title, #screen option")].filter((e) => !e.closest("#panel-details")).flatMap(
          (e) => [e.getAttribute("aria-label") ?? "", e.getAttribute("title") ?? "", /^(title|option)$/i.test(e.tagName) ? e.textContent : ""])]);
      for (const text of texts) for (const word of text.match(/[\w.]*_[\w.]*/g) ?? []) if (!/\.\w{2,4}$/.test(word)) said.push(`${where}: ${word}`);
      if (/\b(fadir|faber)\b/.test(texts.join(" "))) said.push(`${where}: fadir`);
    });
    assert.deepEqual([...new Set(said)], []);
    await page.context().close();
  });
}

for (const [width, height] of [[1024, 768], [390, 844]])
  test(`pressing everything moves nothing in a window of ${width} × ${height}`, async () => {
    const page = await opened("sample", { width, height });
    const boxes = () => page.evaluate(() => [...document.querySelectorAll("header button, .result, #sentence, #view, [role=tab], #side")].filter((e) => e.getClientRects().length)
      .map((e) => `${e.id || e.textContent.slice(0, 30)} ${[e.getBoundingClientRect()].map(({ x, y, width: wide }) => [x, y + scrollY, wide].map((v) => v.toFixed(1)).join())}`));
    await page.evaluate(() => scrollTo(0, 0));
    const before = await boxes(), moved = [];
    for (const selector of ["[role=tab]", ".result", ".tile", ".motion-row button"]) {
      await openTab(page, "Motion");
      for (const press of await page.locator(selector).all()) {
        if (!(await press.isVisible()) || (await press.isDisabled())) continue;
        const said = await press.textContent();
        await press.click();
        await settled(page);
        await page.evaluate(() => scrollTo(0, 0));
        const now = await boxes();
        moved.push(...now.filter((box, i) => box !== before[i]).map((box) => `${said}: ${box}`));
      }
    }
    assert.deepEqual(moved, []);
    await page.context().close();
  });

test("the motions have their room at the height of a laptop: chip, tiles and boxes are as large as they are meant to be", async () => {
  const page = await opened("sample", { width: 1024, height: 768 });
  const heights = (selector) => page.locator(selector).evaluateAll((all) => all.map((e) => Math.round(e.getBoundingClientRect().height)));
  assert.deepEqual(await heights("#status"), [36]);
  assert.ok(Math.min(...await heights(".tile")) >= 52);
  // With less room they are as low as they get.
  await page.setViewportSize({ width: 1024, height: 730 });
  await page.waitForFunction(() => Math.min(...[...document.querySelectorAll(".tile")].map((tile) => tile.clientHeight)) < 56);
  assert.ok(Math.min(...await heights(".tile")) >= 52);
  const bottom = await page.locator("#panel-motion").evaluate((panel) => panel.getBoundingClientRect().bottom);
  for (const tile of await page.locator(".tile").all()) assert.ok((await tile.boundingBox()).y + 52 <= bottom);
  // No name of a motion is cut off, and no value.
  assert.deepEqual(await page.locator(".tile-name, .tile-value b").evaluateAll((all) => all.filter((e) => e.scrollHeight > e.clientHeight + 1 && getComputedStyle(e).display !== "inline" ||
    e.getBoundingClientRect().right > e.closest(".tile").getBoundingClientRect().right).map((e) => e.textContent)), []);
  await viewOptions(page);
  assert.deepEqual([...new Set(await heights("input[type=checkbox]:visible"))], [24]);
  await page.context().close();
});

for (const name of ["sample", "plan", "compared"].filter(has))
  test(`a tile of ${name} shows each of its lines in full or not at all, and the limit itself always`, async () => {
    const page = await opened(name);
    const said = [];
    for (const [width, height] of [[1280, 800], [1366, 768], [1024, 768], [1024, 730], [1440, 900], [390, 844]]) {
      await page.setViewportSize({ width, height });
      await page.evaluate(() => new Promise((drawn) => requestAnimationFrame(() => requestAnimationFrame(drawn))));
      said.push(...await page.locator(".tile-value").evaluateAll((values, size) => values.flatMap((value) => {
        const place = value.getBoundingClientRect(), { top, bottom } = value.closest(".tile").getBoundingClientRect();
        return [...value.children].flatMap((part) => {
          const box = part.getBoundingClientRect(), isAway = box.left >= place.right || box.top >= place.bottom - 1 || box.width === 0;
          const isSeen = box.top >= place.top - 1 && box.bottom <= place.bottom + 1 && box.right <= place.right + 1 && box.top >= top && box.bottom <= bottom;
          return isSeen || (isAway && part.tagName !== "B") ? [] : [`${size}: ${value.closest(".tile").textContent}: ${part.textContent}`];
        });
      }), `${width} × ${height}`));
    }
    assert.deepEqual(said, []);
    await page.context().close();
  });

for (const [width, height] of [[1280, 800], [390, 844], [3840, 2160]])
  test(`view options leave the scene free in a window of ${width} × ${height}, and end in it`, async () => {
    const page = await opened("sample", { width, height });
    await viewOptions(page);
    // An upright page goes by.
    await page.locator("#view").evaluate((view) => view.scrollIntoView());
    const box = (selector) => page.locator(selector).evaluate((e) => e.getBoundingClientRect().toJSON());
    const scene = await box("#scene"), options = await box("#view-options > :not(summary)");
    await keep(page, `view_options_${width}`);
    assert.ok(options.left >= scene.right - 0.5 || options.top >= scene.bottom - 0.5, JSON.stringify([scene, options]));
    assert.ok(options.right <= width + 0.5 && options.bottom <= height + 0.5 && options.height > 150, JSON.stringify(options));
    await page.context().close();
  });

test("one figure at a time, the clock over the socket, the map to 60° with a line at 30°", async () => {
  const page = await opened("sample");
  await openTab(page, "Figures");
  for (const [figure, others] of [["Map", ".clock"], ["Clock", ".map"]]) {
    await page.locator(".segments label", { hasText: figure }).click();
    assert.equal(await page.locator(`#side ${others}`).isVisible(), false);
    const high = (await page.locator("#panel-figures .picture:visible").boundingBox()).height;
    assert.ok(high > 250, `${high} pixels of ${figure}`);
    await keep(page, `figure_${figure}`);
  }
  // The picture is the dial's, and has bone in it.
  const [dial, socket] = [await page.locator("#side .dial").boundingBox(), await page.locator("#side .socket").boundingBox()];
  for (const side of ["x", "y", "width"]) assert.ok(Math.abs(dial[side] - socket[side]) < 3, `${side}: ${dial[side]} and ${socket[side]}`);
  const painted = await page.evaluate(async () => {
    const image = new Image();
    image.src = document.querySelector("#side .socket").getAttribute("href");
    await image.decode();
    const canvas = document.createElement("canvas");
    [canvas.width, canvas.height] = [image.width, image.height];
    const context = canvas.getContext("2d");
    context.drawImage(image, 0, 0);
    const { data } = context.getImageData(0, 0, canvas.width, canvas.height);
    return data.filter((value, i) => i % 4 === 3 && value > 0).length / (data.length / 4);
  });
  assert.ok(painted > 0.3, `${painted} of the picture`);
  // The line crosses between a cell below 30 degrees and one above.
  await page.locator(".segments label", { hasText: "Map" }).click();
  assert.match(await page.locator("#side .map-legend").textContent(), /60° or more.*30°/);
  const far = await page.evaluate(() => {
    const cells = [...document.querySelectorAll("#side rect.cell")], numbers = [...document.querySelectorAll("#side .cell-number")].map(({ textContent }) => Number(textContent));
    const [, ...starts] = document.querySelector("#side .map-line").getAttribute("d").split("M").map((step) => step.split("L")[0].split(" ").map(Number));
    const at = cells.map((cell) => ["x", "y"].map((k) => Number(cell.getAttribute(k)) + Number(cell.getAttribute(k === "x" ? "width" : "height")) / 2));
    return starts.map(([x, y]) => {
      const near = at.map(([a, b], i) => [Math.hypot(a - x, b - y), numbers[i]]).sort(([a], [b]) => a - b).slice(0, 2).map(([, value]) => value);
      return [Math.min(...near), Math.max(...near)];
    });
  });
  assert.ok(far.length > 3);
  for (const [low, high] of far) assert.ok(low <= 30 && high >= 30, `${low} and ${high}`);
  await page.context().close();
});

for (const colorScheme of process.env.CONDYLE_LONG_TESTS ? ["light", "dark"] : ["dark"])
  for (const [width, height] of process.env.CONDYLE_LONG_TESTS ? [[1280, 800], [390, 844]] : [[390, 844]])
    for (const name of names)
      test(`axe finds nothing anywhere on ${name} (${colorScheme}, ${width})`, async () => {
        const page = await opened(name, { colorScheme, width, height });
        await page.evaluate(axeSource);
        const found = [];
        await everywhere(page, async (where) => {
          const { violations } = await page.evaluate(() => globalThis.axe.run());
          found.push(...violations.map(({ id, nodes }) => `${where}: ${id}: ${nodes.map(({ html, any }) => `${html.slice(0, 120)} ${any[0]?.message ?? ""}`).join(" | ")}`));
        });
        assert.deepEqual(found, []);
        await page.context().close();
      });
