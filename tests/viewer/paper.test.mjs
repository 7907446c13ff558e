// The page on paper, and what is saved from it.
import assert from "node:assert/strict";
import { readFileSync } from "node:fs";
import { join } from "node:path";
import { test } from "node:test";
import { asSaid, has, openFigure, openPage, openTab, pathOf, reports, settled, sharedBrowser } from "./browser.mjs";
import { readReport } from "./report_block.mjs";

const browser = await sharedBrowser();

/// Contents of the page while it is printed, and the smallest letters, also those in the picture, as shares of its width.
const whilePrinted = `
const { fillText } = CanvasRenderingContext2D.prototype, { toDataURL } = HTMLCanvasElement.prototype, smallest = new WeakMap(), inPicture = {};
CanvasRenderingContext2D.prototype.fillText = function (...args) {
  const share = parseFloat(/[\\d.]+(?=px)/.exec(this.font)[0]) * this.getTransform().a / this.canvas.width;
  smallest.set(this.canvas, Math.min(share, smallest.get(this.canvas) ?? Infinity));
  return fillText.apply(this, args);
};
HTMLCanvasElement.prototype.toDataURL = function (...args) {
  const source = toDataURL.apply(this, args);
  inPicture[source] = smallest.get(this);
  return source;
};
const letters = () => {
  const sizes = [], walker = document.createTreeWalker(document.getElementById("paper"), NodeFilter.SHOW_TEXT);
  while (walker.nextNode()) {
    const { data, parentElement: of } = walker.currentNode;
    if (data.trim() && of.checkVisibility()) sizes.push([parseFloat(getComputedStyle(of).fontSize) * (of.ownerSVGElement?.getScreenCTM().a ?? 1), data]);
  }
  const image = document.querySelector("#paper img"), { width, height } = image.getBoundingClientRect();
  sizes.push([inPicture[image.src] * Math.min(width, height * image.naturalWidth / image.naturalHeight), "the picture"]);
  return sizes;
};
matchMedia("print").addEventListener("change", ({ matches }) => {
  if (!matches) return;
  const image = document.querySelector("#paper img");
  globalThis.printed = {
    picture: [image.naturalWidth, image.naturalHeight, image.getBoundingClientRect().height], caption: image.alt,
    text: [...document.querySelectorAll("#paper .plot text")].slice(0, 1).map((text) => getComputedStyle(text).fill).join(), heading: getComputedStyle(document.querySelector("#paper h1")).color,
    controls: [...document.querySelectorAll("button, select, input")].filter((e) => e.getClientRects().length > 0).map((e) => e.outerHTML.slice(0, 80)),
    screen: document.querySelector("#screen").getClientRects().length, letters: letters(),
  };
});`;

const pagesOf = (path) => (readFileSync(path, "latin1").match(/\/Type\s*\/Page\b/g) ?? []).length;

// A plan has measures, too.
for (const [name, sheets] of [["sample", 2], ["plan", 3], ["compared", 2], ["vhf_right", 2], ["swept", 2], ["knee", 2]])
  for (const colorScheme of ["light", "dark"])
    test(`${name} printed from a ${colorScheme} page is ${sheets} sheets, in black on white, without controls and without letters below 11 pixels`, { skip: !has(name) && "not made" }, async () => {
      const { page } = await openPage(browser, pathOf(name), { colorScheme, script: whilePrinted });
      await settled(page);
      // The picture of the limit is drawn while nobody waits.
      if (name !== "knee") await page.waitForFunction(() => document.querySelector("#paper img").src !== "", undefined, { timeout: 20000 });
      const path = join(reports, "seen", `${name}_${colorScheme}.pdf`);
      await page.pdf({ path, format: "A4" });
      assert.equal(pagesOf(path), sheets);
      const { picture, caption, text, heading, controls, screen, letters } = await page.evaluate(() => globalThis.printed);
      assert.ok(picture[0] > 300 && picture[1] > 200 && picture[2] > 100, String(picture));
      if (name !== "knee") assert.equal(caption, await page.locator("#sentence").textContent());
      if (name !== "knee") assert.equal(text, "rgb(27, 31, 36)");
      assert.equal(heading, "rgb(27, 31, 36)");
      assert.deepEqual(controls, []);
      assert.equal(screen, 0);
      assert.ok(letters.length > 50);
      // A line that fits to within a thousandth is that of 11 pixels.
      assert.deepEqual(letters.filter(([size]) => !(size > 10.99)), []);
      await page.context().close();
    });

test("the sheets have what was promised: limits with normals, clock face, scope; map, method, files", async () => {
  const { page } = await openPage(browser, pathOf("sample"));
  await settled(page);
  const [first, second] = await page.locator("#paper .sheet").allTextContents();
  const { rom, scope } = readReport(pathOf("sample")).text;
  for (const { name } of rom.motions) assert.ok(first.includes(asSaid(name)), name);
  assert.equal(await page.locator("#paper .plot .normal").count(), rom.motions.filter(({ normal_range_deg }) => normal_range_deg !== null).length);
  assert.ok(first.includes(scope.slice(1)) && first.includes("Sagittal clock position"));
  for (const wanted of ["Method and data", "Source files", rom.provenance.fixed_mesh.sha256, "Clinical ranges: AAOS 1965"]) assert.ok(second.includes(wanted), wanted);
  assert.ok((await page.locator("#paper rect.cell").count()) > 50);
  // What else a report has: cost and measures of a plan, curves of a motion, differences of a comparison, the safe zone.
  for (const [name, ...wanted] of [["plan", "Volume to remove for each target", "Measures of the hip", "Alpha angle by the hour", "Targets"], ["walk", "smallest gap, mm"],
    ["compared", "difference"], ["swept", "Safe zone"], ["knee", "max pressure, MPa"]]) {
    if (!has(name)) continue;
    const other = await openPage(browser, pathOf(name));
    const said = await other.page.locator("#paper").textContent();
    for (const each of wanted) assert.ok(said.includes(each), `${each} of ${name}`);
    await other.page.context().close();
  }
  // Names of files, not where they lie.
  const paths = second.replaceAll(/doi 10\.\S+/g, "");
  assert.ok(second.includes("hip_bone.ply") && !paths.includes("/"), paths.match(/.{40}\/.{40}/)?.[0]);
  await page.context().close();
});

async function saved(page, what, of) {
  const [download] = await Promise.all([page.waitForEvent("download"), page.locator("section", { has: page.getByRole("heading", { name: of }) }).last()
    .getByRole("button", { name: what }).click()]);
  return { name: download.suggestedFilename(), text: readFileSync(await download.path(), "utf8") };
}

test("a figure saved as SVG is the same from a dark page as from a light one, and shows itself", async () => {
  const files = [];
  for (const colorScheme of ["light", "dark"]) {
    const { page } = await openPage(browser, pathOf("sample"), { colorScheme });
    await settled(page);
    await openFigure(page, "Clock");
    const clock = await saved(page, "Save as SVG", "Contacts on the clock face");
    await openFigure(page, "Map");
    files.push([clock, await saved(page, "Save as SVG", "Range-of-motion map")]);
    await page.context().close();
  }
  const [light, dark] = files;
  assert.deepEqual(dark, light);
  assert.deepEqual(light.map(({ name }) => name), ["clock.svg", "map.svg"]);
  const { page } = await openPage(browser, pathOf("sample"));
  for (const { name, text } of light) {
    const { root, black, colours } = await page.evaluate((source) => {
      const svg = new DOMParser().parseFromString(source, "image/svg+xml");
      const fills = (selector) => [...svg.querySelectorAll(selector)].map((element) => element.getAttribute("fill"));
      return { root: svg.documentElement.nodeName, black: fills("text"), colours: fills("rect") };
    }, text);
    assert.equal(root, "svg", name);
    assert.ok(black.every((colour) => ["rgb(27, 31, 36)", "rgb(255, 255, 255)"].includes(colour)) && black.includes("rgb(27, 31, 36)"), name);
    assert.ok(!text.includes("var(") && !text.includes("rgba(0, 0, 0, 0)") && !text.includes("class="), name);
    if (name === "map.svg") assert.ok(new Set(colours).size > 1, name);
  }
  await page.context().close();
});

test("a figure saved as data has the numbers of the report, to the last digit", async () => {
  const { page } = await openPage(browser, pathOf("sample"));
  await settled(page);
  const { rom, map } = readReport(pathOf("sample")).text;
  const [download] = await Promise.all([page.waitForEvent("download"), page.getByRole("button", { name: "Save limits, CSV" }).click()]);
  const limits = { name: download.suggestedFilename(), text: readFileSync(await download.path(), "utf8") };
  assert.equal(limits.name, "limits.csv");
  const [head, ...rows] = limits.text.trimEnd().split("\n").map((line) => line.split(","));
  assert.deepEqual(head.slice(0, 3), ["motion", "limit_deg", "reason"]);
  assert.deepEqual(rows.map(([name, limit, reason]) => [name, Number(limit), reason]),
    rom.motions.map(({ name, limit_deg, reason }) => [name, limit_deg, reason]));
  await openTab(page, "Figures");
  const cells = (await saved(page, "Save data", "Range-of-motion map")).text.trimEnd().split("\n").slice(1).map((line) => line.split(",").map(Number));
  assert.deepEqual(cells, map.intervals.flatMap((list, point) => list.map((interval) => [
    map.columns.values_deg[point % map.columns.values_deg.length],
    map.rows.values_deg[Math.floor(point / map.columns.values_deg.length)], ...interval, 0, 0])));  // no ligament ends any
  await page.context().close();
});
