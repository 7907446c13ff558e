// The page on paper, and what is saved from it.
import assert from "node:assert/strict";
import { readFileSync } from "node:fs";
import { join } from "node:path";
import { test } from "node:test";
import { keep, openPage, pathOf, reports, settled, sharedBrowser } from "./browser.mjs";
import { readReport } from "./report_block.mjs";

const browser = await sharedBrowser();

/// Boxes and colours as they are while the page is printed.
const whilePrinted = `matchMedia("print").addEventListener("change", ({ matches }) => {
  if (!matches) return;
  const box = (selector) => {
    const { x, y, width, height } = document.querySelector(selector).getBoundingClientRect();
    return { x, y, width, height };
  };
  const canvas = document.querySelector("#scene canvas");
  globalThis.printed = {
    scene: box("#scene"), canvas: box("#scene canvas"), fit: getComputedStyle(canvas).objectFit, drawn: [canvas.width, canvas.height],
    text: getComputedStyle(document.querySelector(".plot text")).fill, paragraph: getComputedStyle(document.querySelector("#title")).color,
    controls: [...document.querySelectorAll("button, select, input:not([type=number])")].filter((e) => e.getClientRects().length > 0)
      .map((e) => e.outerHTML.slice(0, 80)),
  };
});`;

const paper = { a4: { format: "A4" }, wide: { width: "500mm", height: "300mm" } };
for (const [name, size] of Object.entries(paper))
  for (const colorScheme of ["light", "dark"])
    test(`printed on ${name} from a ${colorScheme} page the whole picture is there, in black on white, without controls`, async () => {
      const { page } = await openPage(browser, pathOf("sample"), { colorScheme, script: whilePrinted });
      await settled(page);
      await page.pdf({ path: join(reports, "seen", `${name}_${colorScheme}.pdf`), ...size });
      const { scene, canvas, fit, drawn, text, paragraph, controls } = await page.evaluate(() => globalThis.printed);
      // 12 cm, at 96 pixels to 2.54 cm.
      assert.ok(Math.abs(scene.height - (12 / 2.54) * 96) < 1, `${scene.height} pixels high`);
      assert.deepEqual(canvas, scene, "no part of the picture is outside what shows it");
      assert.equal(fit, "contain");
      assert.ok(drawn[0] > 300 && drawn[1] > 300, String(drawn));
      assert.equal(text, "rgb(27, 31, 36)");
      assert.equal(paragraph, "rgb(27, 31, 36)");
      assert.deepEqual(controls, []);
      await page.context().close();
    });

test("on paper the pose is told, and there are no buttons", async () => {
  const { page } = await openPage(browser, pathOf("sample"), { fragment: "#flexion=20" });
  await settled(page);
  await page.emulateMedia({ media: "print" });
  assert.equal(await page.getByRole("button", { name: "Save as SVG" }).first().isVisible(), false);
  assert.equal(await page.getByRole("heading", { name: "Scene" }).isVisible(), false);
  assert.equal(await page.getByRole("spinbutton", { name: "flexion, degrees", exact: true }).isVisible(), true);
  assert.equal(await page.getByRole("heading", { name: "Numbers" }).isVisible(), true);
  await keep(page, "paper", { fullPage: true });
  await page.context().close();
});

async function saved(page, what, of) {
  const [download] = await Promise.all([page.waitForEvent("download"), page.locator("section", { has: page.getByRole("heading", { name: of }) })
    .getByRole("button", { name: what }).click()]);
  return { name: download.suggestedFilename(), text: readFileSync(await download.path(), "utf8") };
}

test("a figure saved as SVG is the same from a dark page as from a light one, and shows itself", async () => {
  const files = [];
  for (const colorScheme of ["light", "dark"]) {
    const { page } = await openPage(browser, pathOf("sample"), { colorScheme });
    await settled(page);
    files.push([await saved(page, "Save as SVG", "Limits"), await saved(page, "Save as SVG", "Range-of-motion map")]);
    await page.context().close();
  }
  const [light, dark] = files;
  assert.deepEqual(dark, light);
  assert.deepEqual(light.map(({ name }) => name), ["limits.svg", "map.svg"]);
  const { page } = await openPage(browser, pathOf("sample"));
  for (const { name, text } of light) {
    const { root, black, colours } = await page.evaluate((source) => {
      const svg = new DOMParser().parseFromString(source, "image/svg+xml");
      const fills = (selector) => [...svg.querySelectorAll(selector)].map((element) => element.getAttribute("fill"));
      return { root: svg.documentElement.nodeName, black: fills("text"), colours: fills("rect") };
    }, text);
    assert.equal(root, "svg", name);
    assert.deepEqual([...new Set(black)], ["rgb(27, 31, 36)"], name);
    assert.ok(!text.includes("var(") && !text.includes("rgba(0, 0, 0, 0)") && !text.includes("class="), name);
    assert.ok(new Set(colours).size > 1, name);
  }
  await page.context().close();
});

test("a figure saved as data has the numbers of the report, to the last digit", async () => {
  const { page } = await openPage(browser, pathOf("sample"));
  await settled(page);
  const { rom, map } = readReport(pathOf("sample")).text;
  const limits = await saved(page, "Save data", "Limits");
  assert.equal(limits.name, "limits.csv");
  const [head, ...rows] = limits.text.trimEnd().split("\n").map((line) => line.split(","));
  assert.deepEqual(head.slice(0, 3), ["motion", "limit_deg", "reason"]);
  assert.deepEqual(rows.map(([name, limit, reason]) => [name, Number(limit), reason]),
    rom.motions.map(({ name, limit_deg, reason }) => [name, limit_deg, reason]));
  const cells = (await saved(page, "Save data", "Range-of-motion map")).text.trimEnd().split("\n").slice(1).map((line) => line.split(",").map(Number));
  assert.deepEqual(cells, map.intervals.flatMap((list, point) => list.map((interval) => [
    map.columns.values_deg[point % map.columns.values_deg.length],
    map.rows.values_deg[Math.floor(point / map.columns.values_deg.length)], ...interval])));
  await page.context().close();
});
