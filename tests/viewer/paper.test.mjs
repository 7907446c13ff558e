// The page on paper, and what is saved from it.
import assert from "node:assert/strict";
import { join } from "node:path";
import { test } from "node:test";
import { keep, openPage, pathOf, reports, settled, sharedBrowser } from "./browser.mjs";

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
