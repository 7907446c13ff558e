// What a page judges limits by, and what a joint under load answers first.
import assert from "node:assert/strict";
import { execFileSync } from "node:child_process";
import { join } from "node:path";
import { test } from "node:test";
import { has, keep, openPage, openTab, pathOf, reports, root, settled, sharedBrowser } from "./browser.mjs";
import { readReport } from "./report_block.mjs";

const browser = await sharedBrowser();
const condyle = join(root, "build/release/condyle");
const run = (...words) => execFileSync(condyle, words, { encoding: "utf8", stdio: ["ignore", "pipe", "ignore"] });

test("a loaded knee opens on its largest pressure, in that frame, with area, force and the share of either side", { skip: !has("knee") && "not made" }, async () => {
  const { page, complaints } = await openPage(browser, pathOf("knee"), { reducedMotion: "reduce" });
  await settled(page);
  const { text, array } = readReport(pathOf("knee")), { curves, times_s } = text.recorded;
  const curve = (name) => array(curves.find((each) => each.name === name).values), pressure = curve("max_pressure_mpa");
  const frame = pressure.indexOf(Math.max(...pressure)), at = `${array(times_s)[frame].toFixed(2)} s`;
  const [medial, lateral] = ["medial", "lateral"].map((side) => curve(`${side}_share_percent`)[frame]);
  const force = Math.hypot(...["x", "y", "z"].map((axis) => curve(`force_${axis}_n`)[frame]));
  assert.ok(Math.abs(medial + lateral - 100) < 1e-9);
  const sentence = await page.locator("#sentence").textContent();
  assert.equal(sentence, `Peak pressure ${pressure[frame].toFixed(2)} MPa at ${at}: ${curve("area_mm2")[frame].toFixed(0)} mm² in contact carry ${force.toFixed(0)} N, ` +
    `medial : lateral ${medial.toFixed(0)} : ${lateral.toFixed(0)}.`);
  assert.deepEqual(await page.locator(".result-name").allTextContents(), ["peak pressure", "area then", "force then", "medial : lateral"]);
  assert.equal(await page.locator("input[aria-label=Frame]").inputValue(), String(frame));
  assert.ok((await page.locator("#paper").textContent()).includes(sentence));
  await keep(page, "loaded_knee");
  assert.deepEqual(complaints, []);
  await page.context().close();
});

test("limits of a loaded knee stand under the place in which it is held, and never in place of the load", { skip: !has("knee") && "not made" }, async () => {
  const data = process.env.CONDYLE_DATA ?? join(root, "../shared/data"), path = join(reports, "knee_apart.html");
  run("report", join(root, "tests/support/knee_by_hand/tibiofemoral.toml"), "--translation", "y=-3", "--load", "--out", path,
    "--motion", join(data, "knee_lenhart2015_right/passive_flexion_states.sto"));
  const { page, complaints } = await openPage(browser, path, { reducedMotion: "reduce" });
  await settled(page);
  assert.match(await page.locator("#sentence").textContent(), /^Peak pressure /);
  assert.match(await page.locator("#paper").textContent(), /Limits held in the scan's place/);
  await openTab(page, "Motion");
  await page.getByRole("heading", { name: "Limits held in the scan's place", exact: true }).waitFor();
  await page.locator(".tile", { hasText: /^flexion / }).click();
  await page.waitForFunction(() => /^Flexion ends at [\d.]+°, held in the scan's place, no clinical range known, /.test(document.getElementById("sentence").textContent));
  assert.deepEqual(complaints, []);
  await page.context().close();
});
