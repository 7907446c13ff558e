// Files that are damaged or incomplete, and text that nobody expects: one clear message, and text stays text.
import assert from "node:assert/strict";
import { readFileSync, writeFileSync } from "node:fs";
import { join } from "node:path";
import { test } from "node:test";
import { deflateSync, inflateSync } from "node:zlib";
import { angleOf, drop, keep, openPage, pathOf, reports, settled, sharedBrowser, tile } from "./browser.mjs";
import { changed, withText } from "./report_block.mjs";

const browser = await sharedBrowser();

for (const [what, change, says] of [
  ["cut short", (zipped) => zipped.subarray(0, zipped.length / 2), /incomplete or was changed/],
  ["one byte changed", (zipped) => (zipped[Math.floor(zipped.length / 2)] ^= 1, zipped), /cannot be read/],
  ["not a block", () => deflateSync(Buffer.from("something else that is longer than a head")), /does not begin like a Condyle data block/],
  ["of a later version", (zipped) => {
    const block = inflateSync(zipped);
    block.writeUInt32LE(2, 8);
    return deflateSync(block);
  }, /version is 2/],
  ["without its arrays", (zipped) => deflateSync(inflateSync(zipped).subarray(0, 16 + inflateSync(zipped).readUInt32LE(12))), /ends before/],
])
  test(`a data block ${what} is reported in one line`, async () => {
    const { page, complaints } = await openPage(browser, changed("damaged", change), { answers: false });
    const warning = page.getByRole("alert");
    await warning.waitFor();
    assert.match(await warning.textContent(), says);
    assert.equal(await warning.count(), 1);
    assert.deepEqual(complaints, []);
    await page.context().close();
  });

const hostile = '<img src=x onerror="globalThis.broken=1"><script>globalThis.broken=1</script> & "quotes" \u202eעברית العربية';

test("names stay text: markup, scripts, a megabyte, right to left", async () => {
  const path = withText("hostile", (text) => {
    text.title = hostile;
    text.joint.fixed = hostile;
    text.joint.mobile = "x".repeat(1e6);
    text.rom.motions[0].name = hostile;
    text.rom.notes.push({ code: "wrong_side", text: hostile });
  });
  const { page, complaints } = await openPage(browser, path);
  await settled(page);
  assert.ok((await page.locator("#title").textContent()).includes('<img src=x onerror="globalThis.broken=1">'));
  assert.equal(await page.evaluate(() => globalThis.broken), undefined);
  assert.equal(await page.locator("#screen img").count(), 0);
  assert.deepEqual(complaints, []);
  assert.ok(await page.evaluate(() => document.documentElement.scrollWidth <= innerWidth));
  await keep(page, "hostile");
  await page.context().close();
});

test("a megabyte of text leaves the page as long as it was", async () => {
  const long = "many words ".repeat(1e5);
  const usual = await openPage(browser, pathOf("sample"));
  const height = (page) => page.evaluate(() => document.documentElement.scrollHeight);
  const before = await height(usual.page);
  await usual.page.context().close();
  const path = withText("long", (text) => {
    text.title = text.joint.fixed = text.joint.mobile = long;
    text.rom.motions[1].name = long;
    text.rom.notes.push({ code: "long", text: long });
    text.rom.caveats.push(long);
    text.rom.provenance.command.push(long);
    text.rom.provenance.joint_file.path = long;
  });
  const { page } = await openPage(browser, path);
  await settled(page);
  const after = await height(page);
  assert.ok(after < before + 2500, `${before} pixels became ${after}`);
  assert.ok(await page.evaluate(() => document.documentElement.scrollWidth <= innerWidth));
  await page.context().close();
});

test("a name that runs from right to left does not turn the sentence around it", async () => {
  const path = withText("right_to_left", (text) => {
    text.joint.fixed = "עצם \u202eהירך (1)";
    text.joint.mobile = "عظم الفخذ 2";
  });
  const { page } = await openPage(browser, path);
  assert.match(await page.locator("#title").textContent(), /^Right hip · \u2068عظم الفخذ 2\u2069 \/ \u2068עצם הירך \(1\)\u2069 · condyle/);
  // Each of them in its place, from left to right.
  const lefts = await page.evaluate(() => {
    const [text] = document.getElementById("title").childNodes;
    const left = (from, to) => {
      const range = document.createRange();
      range.setStart(text, from);
      range.setEnd(text, to);
      return range.getBoundingClientRect().left;
    };
    const at = (wanted) => text.data.indexOf(wanted);
    return [left(0, 5), left(at("عظم"), at("عظم") + 9), left(at(" / "), at(" / ") + 3), left(at("עצם"), at("עצם") + 5), left(at("condyle"), text.length)];
  });
  assert.deepEqual(lefts, [...lefts].sort((a, b) => a - b));
  await page.context().close();
});

async function onlyMessage(path) {
  const { page, complaints } = await openPage(browser, path, { answers: false });
  await page.getByRole("alert").waitFor();
  const lines = await page.getByRole("alert").allTextContents();
  assert.equal(lines.length, 1);
  assert.deepEqual(complaints, []);
  await page.context().close();
  return lines[0];
}

for (const [what, change, names] of [
  ["without a key", (text) => delete text.coordinates, "coordinates"],
  ["with a key of another type", (text) => (text.rom.motions[3].limit_deg = "far"), "rom.motions[3].limit_deg"],
  ["with a word that is not one of the known", (text) => (text.joint.kind = "saddle"), "joint.kind"],
  ["with an array before its place", (text) => (text.arrays.fixed_vertices.offset = -8), "arrays.fixed_vertices.offset"],
  ["with half an element", (text) => (text.arrays.mobile_triangles.length += 0.5), "arrays.mobile_triangles.length"],
  ["with an array of another type", (text) => (text.arrays.mobile_triangles.type = "f64"), "arrays.mobile_triangles"],
  ["with a pose that names no array", (text) => (text.poses[1].fixed_gaps = "toString"), "poses[1].fixed_gaps"],
  ["with fewer gaps than vertices", (text) => (text.arrays[text.poses[1].mobile_gaps].length -= 1), "arrays.pose_1_mobile_gaps"],
  ["with a map of other points", (text) => text.map.intervals.pop(), "map.intervals"],
  ["with a map without a start", (text) => delete text.map.start_deg, "map.start_deg"],
  ["with a map that slides and holds nothing", (text) => (text.map.start_mm = 0), "map.held_mm"],
])
  test(`a data block ${what} is reported by its key`, async () => {
    const line = await onlyMessage(withText("damaged", change));
    assert.equal(line, `The data of this report cannot be read: ${names} is missing or has the wrong type.`);
  });

test("a data block whose text is not JSON is reported in one line", async () => {
  const path = changed("damaged", (zipped) => {
    const block = inflateSync(zipped);
    block[16] = "[".charCodeAt(0);
    return deflateSync(block);
  });
  assert.match(await onlyMessage(path), /its text is not JSON/);
});

test("a report whose core is damaged says so, once, and shows the poses that it holds", async () => {
  const path = join(reports, "damaged_core.html");
  writeFileSync(path, readFileSync(pathOf("sample"), "utf8").replace(/(id="core">)([^<]{5000})[^<]{40}/, (_, head, before) => `${head}${before}${"A".repeat(40)}`));
  const { page, complaints } = await openPage(browser, path, { answers: false });
  await page.getByRole("alert").waitFor();
  assert.match(await page.getByRole("alert").textContent(), /^The computing part of this file is damaged/);
  assert.equal(await page.getByRole("alert").count(), 1);
  assert.equal(await page.locator("#scene > canvas").count(), 1);
  await tile(page, "flexion").click();
  assert.ok((await angleOf(page, "flexion")) > 90);
  for (const input of await page.locator(".slider input").all()) assert.equal(await input.isDisabled(), true);
  assert.deepEqual(complaints, []);
  await page.context().close();
});

test("a file dropped on a report leaves the page, and is answered in a line", async () => {
  const { page } = await openPage(browser, pathOf("sample"));
  await drop(page, [join(reports, "targets.csv"), join(reports, "sample/femur.ply")]);
  await page.getByRole("alert").waitFor();
  assert.match(await page.getByRole("alert").textContent(), /^This page shows a joint .*or another joint: a joint file \(\.toml\) with its meshes/);
  assert.ok(page.url().split("#")[0].endsWith("sample.html"));
  assert.equal(await page.locator("#scene > canvas").count(), 1);
  await page.context().close();
});

for (const share of [0.3, 0.7, 0.99])
  test(`a file cut at ${100 * share} % says that it is incomplete`, async () => {
    const whole = readFileSync(pathOf("sample"));
    const path = join(reports, "cut.html");
    writeFileSync(path, whole.subarray(0, Math.floor(share * whole.length)));
    const { page } = await openPage(browser, path, { answers: false });
    await page.getByText("This file is incomplete").waitFor({ state: "visible", timeout: 10000 });
    assert.equal(await page.locator("noscript p").count(), 0);
    await page.context().close();
  });

test("with scripts off the page says so, once", async () => {
  const { page } = await openPage(browser, pathOf("sample"), { answers: false, javaScriptEnabled: false });
  await page.locator("noscript p").waitFor({ state: "visible" });
  assert.equal(await page.getByText("This file is incomplete").isVisible(), false);
  await page.context().close();
});

test("a whole report says nothing of the kind", async () => {
  const { page } = await openPage(browser, pathOf("sample"));
  assert.equal(await page.getByText("This file is incomplete").count(), 0);
  assert.equal(await page.locator("noscript p").count(), 0);
  await page.context().close();
});
