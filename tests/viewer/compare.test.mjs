// A joint beside the one before: against the numbers of condyle rom of each, and with the bodies before seen through.
import assert from "node:assert/strict";
import { execFileSync } from "node:child_process";
import { readFileSync } from "node:fs";
import { join } from "node:path";
import { test } from "node:test";
import { keep, openPage, openTab, pathOf, pixels, reports, root, settled, sharedBrowser, turnTo } from "./browser.mjs";
import { readReport, withText } from "./report_block.mjs";

const browser = await sharedBrowser();
const { text, array } = readReport(pathOf("compared"));

function romOf(joint) {
  return JSON.parse(execFileSync(join(root, "build/release/condyle"), ["rom", join(reports, joint), "--band=20", "--json"], { stdio: ["ignore", "pipe", "ignore"] }));
}

const before = romOf("cam/hip.toml"), after = romOf("sample/hip.toml");

async function opened(options = {}) {
  const { page, complaints } = await openPage(browser, pathOf("compared"), options);
  if (options.answers !== false) await settled(page);
  await openTab(page, "Plan");
  return { page, complaints };
}

const minus = (said) => said.replace("-", "\u2212");
const endOf = ({ limit_deg, reason }) => (reason === "end_of_range" ? `>${Number(limit_deg.toFixed(1))}°` : `${limit_deg.toFixed(1)}°`);
const signed = (degrees) => {
  const tenths = Number(degrees.toFixed(1));
  return tenths > 0 ? `+${degrees.toFixed(1)}` : tenths === 0 ? "0.0" : minus(degrees.toFixed(1));
};
const comparison = (page) => page.getByRole("region", { name: "Compared with before", exact: true }).locator("table", { has: page.locator("caption", { hasText: /^Limits before and after$/ }) });
const ghostBox = (page) => page.getByLabel("Show the joint before, transparent");

function rowsOf(page) {
  return comparison(page).evaluate((table) => [...table.tBodies[0].rows].map((row) => [...row.cells].map(({ textContent }) => textContent)));
}

/// So many pixels of two pictures differ.
function countOfDifferent(a, b) {
  let count = 0;
  for (let y = 0; y < a.height; ++y)
    for (let x = 0; x < a.width; ++x) {
      const one = a.at(x, y), other = b.at(x, y);
      if (one.some((channel, i) => Math.abs(channel - other[i]) > 2)) ++count;
    }
  return count;
}

test("limits and bands are those of condyle rom of each joint, and differences are theirs", async () => {
  assert.deepEqual(text.before.rom.motions, before.motions);
  assert.deepEqual(text.rom.motions, after.motions);
  const { page, complaints } = await opened();
  const rows = await rowsOf(page);
  assert.equal(rows.length, after.motions.length);
  let exact = 0;
  after.motions.forEach((now, i) => {
    const then = before.motions[i], [, beforeCell, afterCell, difference, verdict] = rows[i], { band } = text.before.differences[i];
    assert.ok(beforeCell.startsWith(endOf(then)), `${beforeCell}, ${endOf(then)}`);
    assert.ok(afterCell.startsWith(endOf(now)), `${afterCell}, ${endOf(now)}`);
    if (then.reason !== "contact" || now.reason !== "contact") return;
    ++exact;
    const by = now.limit_deg - then.limit_deg;
    assert.equal(difference, `${signed(by)}° (${signed(band.p5_deg)} to ${signed(band.p95_deg)})`);
    assert.equal(verdict, band.p5_deg >= 0.05 || band.p95_deg <= -0.05 ? "beyond the band" : "within the band");
  });
  assert.ok(exact >= 6);
  // A cam ends internal rotation in flexion, and no abduction.
  const verdictOf = (name) => rows[after.motions.findIndex((motion) => motion.name === name)][4];
  assert.equal(verdictOf("internal_rotation_at_90_flexion"), "beyond the band");
  assert.ok(rows.some(([, , , , verdict]) => verdict === "within the band"));
  assert.deepEqual(complaints, []);
  await keep(page, "compared");
  await page.context().close();
});

test("figures of the strip and tiles go from the limit before to that after, those of a report of one joint have no other", async () => {
  const { page } = await opened();
  const found = await page.locator(".result b").allTextContents(), tiles = await page.locator(".tile-value").allTextContents();
  assert.equal(found.length, 4);
  assert.equal(found[0], `${before.motions[0].limit_deg.toFixed(1)} → ${after.motions[0].limit_deg.toFixed(1)}°`);
  after.motions.forEach((motion, i) => {
    const then = endOf(before.motions[i]), now = endOf(motion);
    assert.ok(tiles[i].trim().startsWith(then === now ? now : `${then.replace("°", "")} → ${now}`), tiles[i]);
  });
  await page.context().close();
  const { page: single } = await openPage(browser, pathOf("sample"));
  await settled(single);
  assert.doesNotMatch(await single.locator("#results, .tiles").first().textContent(), /→/);
  assert.equal(await comparison(single).count(), 0);
  await single.context().close();
});

test("the joint before is seen through in the same pose, and is hidden by a box that the address remembers", async () => {
  assert.equal(text.before.surfaces.fixed, null, "the hip bone is the same");
  const { vertices } = text.before.surfaces.mobile;
  assert.notDeepEqual(array(vertices), array("mobile_vertices"));
  const { page } = await opened({ fragment: "#hidden=fixed&colour=none&flexion=60", reducedMotion: "reduce" });
  // Shade comes after the first answer, and shadows at rest.
  const drawn = async () => {
    await settled(page);
    for (let last = await pixels(page); ;) {
      await page.waitForTimeout(700);
      const now = await pixels(page);
      if (countOfDifferent(last, now) === 0) return now;
      last = now;
    }
  };
  const shown = await drawn();
  await keep(page, "compared_ghost");
  await ghostBox(page).uncheck();
  const hidden = await drawn();
  assert.ok(countOfDifferent(shown, hidden) > 30, `${countOfDifferent(shown, hidden)} pixels`);
  await page.waitForFunction(() => new URLSearchParams(location.hash.slice(1)).get("hidden") === "fixed,before");
  await openTab(page, "Motion");
  await turnTo(page, { flexion: 20 });
  await turnTo(page, { flexion: 60 });
  await openTab(page, "Plan");
  await ghostBox(page).check();
  assert.ok(countOfDifferent(shown, await drawn()) < 10, "the same picture");
  await page.context().close();
  const { page: linked } = await opened({ fragment: "#hidden=before" });
  assert.equal(await ghostBox(linked).isChecked(), false);
  await linked.context().close();
});

test("saved limits have columns of the joint before, to the last digit", async () => {
  const { page } = await openPage(browser, pathOf("compared"));
  await settled(page);
  const [download] = await Promise.all([page.waitForEvent("download"), page.getByRole("button", { name: "Save limits, CSV" }).click()]);
  const [head, ...rows] = readFileSync(await download.path(), "utf8").trimEnd().split("\n").map((line) => line.split(","));
  const cell = (row, name) => row[head.indexOf(name)];
  rows.forEach((row, i) => {
    const { difference_deg, difference_is, band, beyond_band } = text.before.differences[i];
    assert.equal(Number(cell(row, "before_limit_deg")), before.motions[i].limit_deg);
    assert.equal(cell(row, "before_reason"), before.motions[i].reason);
    assert.equal(Number(cell(row, "before_p95_deg")), before.motions[i].band.p95_deg);
    assert.equal(cell(row, "difference_deg"), difference_deg === null ? "" : String(difference_deg));
    assert.equal(cell(row, "difference_is"), difference_is ?? "");
    assert.equal(cell(row, "difference_p5_deg"), band === null ? "" : String(band.p5_deg));
    assert.equal(cell(row, "beyond_band"), beyond_band === null ? "" : String(beyond_band));
  });
  assert.equal(rows.length, after.motions.length);
  await page.context().close();
});

test("nothing scrolls at 1440 × 900 but the details, which have the files of both", async () => {
  const { page } = await openPage(browser, pathOf("compared"), { width: 1440, height: 900 });
  await settled(page);
  for (const tab of ["Motion", "Figures", "Plan"]) {
    await openTab(page, tab);
    await keep(page, `compared_1440_${tab}`);
    assert.deepEqual(await page.evaluate(() => [document.documentElement, ...document.querySelectorAll(".panel:not([hidden]), .panel:not([hidden]) .scroll")]
      .filter((element) => element.scrollHeight > element.clientHeight + 1 || element.scrollWidth > element.clientWidth + 1)
      .map((element) => `${element.id || element.className} ${element.scrollWidth} × ${element.scrollHeight} of ${element.clientWidth} × ${element.clientHeight}`)), [], tab);
  }
  await openTab(page, "Details");
  const details = await page.locator("#panel-details").textContent();
  for (const { provenance } of [before, after])
    for (const { sha256 } of [provenance.joint_file, provenance.mobile_mesh]) assert.ok(details.includes(sha256), sha256);
  await page.context().close();
});

test("paper has the comparison on its first sheet and the files of both on its second", async () => {
  const { page } = await openPage(browser, pathOf("compared"));
  await settled(page);
  const [first, second] = await page.locator("#paper .sheet").allTextContents();
  for (const wanted of ["Limits before and after", "beyond the band", endOf(before.motions[0])]) assert.ok(first.includes(wanted), wanted);
  for (const { provenance } of [before, after]) assert.ok(second.includes(provenance.mobile_mesh.sha256));
  await page.context().close();
});

test("a joint before without limits is shown, and the page says why it has none", async () => {
  const path = withText("compared_without", (said) => {
    said.before.rom = null;
    said.before.rom_error = "the bones are in contact";
    said.before.differences = [];
  }, "compared");
  const { page, complaints } = await openPage(browser, path);
  await settled(page);
  await openTab(page, "Plan");
  assert.match(await page.locator("#panel-plan").textContent(), /The joint before has no limits: the bones are in contact/);
  assert.equal(await comparison(page).count(), 0);
  assert.doesNotMatch(await page.locator("#results").textContent(), /→/);
  assert.equal(await ghostBox(page).isChecked(), true);
  assert.deepEqual(complaints, []);
  await page.context().close();
});

test("a comparison that is damaged is named in a line", async () => {
  const path = withText("compared_damaged", (said) => (said.before.differences = 5), "compared");
  const { page } = await openPage(browser, path, { answers: false });
  await page.getByRole("alert").filter({ hasText: "before.differences" }).waitFor();
  await page.context().close();
});

test("without WebAssembly the comparison is there too", async () => {
  const { page } = await opened({ script: "delete globalThis.WebAssembly", answers: false });
  assert.equal((await rowsOf(page)).length, after.motions.length);
  await page.context().close();
});
