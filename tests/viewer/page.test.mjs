// Answers and texts of the page in a browser, against the command line.
import assert from "node:assert/strict";
import { execFileSync } from "node:child_process";
import { existsSync, readFileSync, statSync } from "node:fs";
import { join } from "node:path";
import { test } from "node:test";
import { angleOf, has, isFemur, keep, openPage, openTab, pathOf, pixels, region, reports, root, settled, sharedBrowser, tile, viewOptions } from "./browser.mjs";
import { readReport } from "./report_block.mjs";

const condyle = join(root, "build/release/condyle");
const browser = await sharedBrowser();

const textOf = (name) => readReport(pathOf(name)).text;

// The page that the README links may be older than the sources.
const opened = { live: join(root, "docs/live.html") };
for (const name of ["sample", "scenario_3", "vhf_right", "libhip_left"]) opened[name] = pathOf(name);
for (const [name, path] of Object.entries(opened))
  test(`${name} opens from disk, asks nothing of any network and complains of nothing`, { skip: !existsSync(path) && "not made" }, async (t) => {
    const { page, complaints, requests, firstAnswer_ms } = await openPage(browser, path);
    await settled(page);
    await keep(page, name);
    assert.deepEqual(requests, []);
    assert.deepEqual(complaints, []);
    const drawn_ms = await page.evaluate(() => document.documentElement.dataset.drawn);
    t.diagnostic(`first picture after ${drawn_ms} ms, first answer after ${firstAnswer_ms.toFixed(0)} ms, ${(statSync(path).size / 1e6).toFixed(2)} MB`);
    await page.context().close();
  });

test("the template and a report of scenario 3 are as small as was promised", () => {
  assert.ok(statSync(join(root, "build/release/report_template.html")).size <= 1.8e6);
  assert.ok(statSync(pathOf("scenario_3")).size <= 6e6);
});

test("the licence of everything in the page is in the page, in full", async () => {
  const { page } = await openPage(browser, pathOf("sample"));
  await openTab(page, "Details");
  await page.getByText("Licences of the software in this page").click();
  await page.waitForFunction(() => document.getElementById("licences").textContent.length > 1000);
  const answer = await page.locator("#licences").textContent();
  const { packages } = JSON.parse(readFileSync(join(root, "viewer/package-lock.json"), "utf8"));
  for (const name of ["three", "d3-scale", "d3-shape", "d3-scale-chromatic", "pako"])
    assert.ok(answer.includes(`${name} ${packages[`node_modules/${name}`].version}: ${packages[`node_modules/${name}`].license}`), name);
  for (const wanted of ["fmt 9.1", "nlohmann/json", "Eigen 3.4", "Highway 1.0.3", "Emscripten 3.1.6", "Copyright © 2010-2026 three.js authors",
    "(C) 1995-2013 Jean-loup Gailly and Mark Adler", "This notice may not be removed or altered from any source distribution",
    "TERMS AND CONDITIONS FOR USE, REPRODUCTION, AND DISTRIBUTION", "9. Accepting Warranty or Additional Liability", "LLVM Exceptions",
    "Mozilla Public License Version 2.0", "Exhibit B - \"Incompatible With Secondary Licenses\" Notice", "Boost Software License"])
    assert.ok(answer.includes(wanted), wanted);
  await page.context().close();
});

for (const name of ["sample", "shifted", "counted", "parts", "knee"])
  test(`limits of ${name} are those of the command line to the bit`, { skip: !has(name) && "not made" }, async () => {
    const { page } = await openPage(browser, pathOf(name));
    const { coordinates, rom } = textOf(name);
    const names = coordinates.map(({ name: angle }) => angle);
    for (const motion of rom.motions) {
      const limit = await page.evaluate((question) => condyle.query({ of: "limit", limit: question }), {
        start: names.map((angle) => motion.start_deg[angle]), vary: names.indexOf(motion.vary), positive: motion.sense === "positive",
        range_deg: motion.range_deg, held: rom.held_translation_mm ?? [0, 0, 0],
      });
      assert.equal(limit.reason, motion.reason);
      assert.equal(limit.turned_deg, motion.limit_deg, motion.name);
    }
    assert.ok(rom.motions.length > 1);
    await page.context().close();
  });

test("the reports that limits are compared in differ by the contact that counts", () => {
  const [counted, shifted] = ["counted", "shifted"].map((name) => textOf(name).rom.motions);
  assert.ok(shifted.some(({ bearing_contact_deg, limit_deg }, i) => bearing_contact_deg !== null && counted[i].limit_deg < limit_deg));
});

test("free angles of a map of ten degrees are those of the command line to the bit", async () => {
  const { page } = await openPage(browser, pathOf("sample"));
  const { coordinates, rom, map } = textOf("sample");
  const names = coordinates.map(({ name }) => name);
  for (const axis of [map.columns, map.rows]) assert.deepEqual(axis.values_deg, axis.values_deg.map((_, i) => axis.values_deg[0] + 10 * i));
  let points = 0;
  for (const [point, intervals] of map.intervals.entries()) {
    const found = await page.evaluate((question) => condyle.query(question), {
      of: "mapPoint", point, question: {
        columnAngle: names.indexOf(map.columns.angle), rowAngle: names.indexOf(map.rows.angle), vary: names.indexOf(map.vary),
        columns: map.columns.values_deg, rows: map.rows.values_deg,
      },
    });
    assert.deepEqual(found.flat(), intervals.flat(), `point ${point}`);
    ++points;
  }
  assert.equal(points, map.columns.values_deg.length * map.rows.values_deg.length);
  await page.context().close();
});

test("depths, pairs and contact are those of condyle depth", async () => {
  const { page } = await openPage(browser, pathOf("sample"));
  let inside = 0, deep = 0;
  for (let i = 0; i < 24; ++i) {
    const angles = [(37 * i) % 140, ((23 * i) % 90) - 45, ((41 * i) % 130) - 65];
    const pose = `flexion=${angles[0]} adduction=${angles[1]} internal_rotation=${angles[2]}`;
    const answer = JSON.parse(execFileSync(condyle, ["depth", join(reports, "sample/hip.toml"), "--pose", pose, "--json"],
      { stdio: ["ignore", "pipe", "ignore"] }));
    const shown = await page.evaluate((at) => condyle.query({ of: "pose", at }), { angles, translation: [0, 0, 0] });
    assert.equal(shown.inContact, answer.in_contact);
    // The depth that the command leads with, where and along what, areas and volume: to the bit.
    const depth = await page.evaluate((at) => condyle.query({ of: "depth", at }), { angles, translation: [0, 0, 0] });
    const reliable = answer.reliable_depth, axes = ["flexion", "adduction", "internal_rotation"];
    assert.equal(depth.deepest === null, reliable === null);
    if (reliable) {
      const { depth_mm, about, depth_deg, body, vertex, nearest_mm, point } = depth.deepest;
      assert.deepEqual(
        { depth_mm, about: about === null ? null : axes[about], depth_deg, body, vertex, nearest_distance_mm: nearest_mm, point_mm: point },
        Object.fromEntries(["depth_mm", "about", "depth_deg", "body", "vertex", "nearest_distance_mm", "point_mm"]
          .map((key) => [key, reliable[key]])));
      ++deep;
    }
    assert.equal(depth.withoutDepth, answer.vertices_without_depth);
    assert.deepEqual(
      [depth.volume_mm3, depth.volumeError_mm3, depth.area_mm2.mobile, depth.area_mm2.fixed],
      [answer.contact.volume_mm3, answer.contact.volume_error_mm3, answer.contact.mobile.area_mm2, answer.contact.fixed.area_mm2]);
    const flat = (typed) => Object.values(typed);
    const gaps = await page.evaluate((at) => condyle.query({ of: "values", at, quantity: "gap" }), { angles, translation: [0, 0, 0] });
    assert.equal(flat(shown.pairs).length / 2, answer.triangle_pairs);
    for (const [body, found] of [["mobile", shown.mobileInFixed], ["fixed", shown.fixedInMobile]]) {
      const depths = flat(found.depths_mm).filter((depth) => depth > 0);
      assert.equal(depths.length, answer.bodies[body].vertices_inside);
      assert.equal(depths.length ? Math.max(...depths) : 0, answer.bodies[body].max_radial_depth_mm ?? 0);
      const negative = flat(gaps[body].shown).filter((gap) => gap < 0);
      assert.deepEqual(negative.map((gap) => -gap).sort(), depths.map(Math.fround).sort(), "coloured as deep as they are");
      inside += depths.length;
    }
  }
  assert.ok(inside > 100, `${inside} vertices inside`);
  assert.ok(deep > 5, `${deep} poses with a depth`);
  await page.context().close();
});

test("a figure goes where it is pressed", async () => {
  const { page } = await openPage(browser, pathOf("sample"), { reducedMotion: "reduce" });
  const fadir = textOf("sample").rom.motions.find(({ name }) => name === "fadir");
  await tile(page, "FADIR").click();
  await settled(page);
  assert.equal(await angleOf(page, "internal rotation"), fadir.at_limit_deg.internal_rotation);
  await openTab(page, "Figures");
  await page.getByRole("button", { name: "flexion 60°, adduction 0°" }).click();
  await settled(page);
  await openTab(page, "Motion");
  assert.equal(await angleOf(page, "flexion"), 60);
  await page.context().close();
});

test("a figure pressed shows where bone meets bone once the joint has turned there, and the zone around it", async () => {
  const { page } = await openPage(browser, pathOf("zones"));
  await viewOptions(page);
  await page.getByLabel("Colour", { exact: true }).selectOption("none");
  await page.getByLabel("Mark triangles in contact").uncheck();
  await page.getByLabel("Show femur").uncheck();
  const fadir = textOf("zones").rom.motions.find(({ name }) => name === "fadir");
  await viewOptions(page, false);
  await tile(page, "FADIR").click();
  await page.waitForFunction((deg) => Number(document.querySelector("input[aria-label='internal rotation, degrees'][role=spinbutton]").getAttribute("aria-valuenow")) === deg,
    fadir.at_limit_deg.internal_rotation);
  assert.equal(await page.getByLabel("Mark the impingement zone of").inputValue(), "fadir");
  await settled(page);
  const seen = await pixels(page);
  const isContactPoint = (r, g, b) => Math.hypot(r - 153, g - 51, b - 255) < 12, isZone = (r, g, b) => r > g + 25 && b > g + 15 && r > b - 40;
  await keep(page, "zone");
  assert.ok(region(seen, isContactPoint).count > 10, "the contact point");
  // The ring of the pin stands around the contact point.
  const ring = page.locator("#scene .scene-pin-drawing circle");
  const [x, y] = await page.evaluate((point) => condyle.scene.project(point), fadir.contact_point_mm);
  assert.ok(Math.hypot(Number(await ring.getAttribute("cx")) - x, Number(await ring.getAttribute("cy")) - y) < 1, "the pin");
  assert.ok(region(seen, isZone).count > 10, "the zone");
  await viewOptions(page);
  await page.getByLabel("Mark the impingement zone of").selectOption("none");
  await settled(page);
  assert.equal(region(await pixels(page), isZone).count, 0);
  await page.context().close();
});

test("where a layer carries load its pressure is shown, in MPa, on open sheets too", { skip: !has("knee") && "not made" }, async () => {
  const { page, complaints } = await openPage(browser, pathOf("knee"));
  await settled(page);
  await viewOptions(page);
  assert.equal(await page.getByLabel("Colour", { exact: true }).inputValue(), "pressure");
  await page.getByRole("button", { name: "above", exact: true }).click();
  await page.getByLabel("Show femoral cartilage").uncheck();
  await page.getByLabel("Mark triangles in contact").uncheck();
  await settled(page);
  await keep(page, "pressure");
  const loaded = region(await pixels(page), (r, g, b) => Math.max(r, g, b) - Math.min(r, g, b) > 60);
  assert.ok(loaded.count > 100, `${loaded.count} pixels under pressure`);
  assert.match(await page.locator(".scene-legend").textContent(), /^pressure, MPa/);
  assert.deepEqual(complaints, []);
  await page.context().close();
});

test("meshes of a body are shown one by one", async () => {
  const { page } = await openPage(browser, pathOf("parts"));
  await viewOptions(page);
  await page.getByLabel("Colour", { exact: true }).selectOption("none");
  await page.getByLabel("Show hip bone").uncheck();
  await page.getByRole("button", { name: "Fit all" }).click();
  await settled(page);
  const whole = region(await pixels(page), isFemur);
  await keep(page, "parts");
  await page.getByLabel("Show bone", { exact: true }).uncheck();
  await settled(page);
  const cartilage = region(await pixels(page), isFemur);
  // A cap on the head, which is above all else of a femur.
  assert.ok(cartilage.count > 100 && cartilage.count < whole.count / 3, `${cartilage.count} of ${whole.count}`);
  assert.ok(cartilage.y < whole.y);
  await page.getByLabel("Show cartilage", { exact: true }).uncheck();
  await settled(page);
  assert.equal(region(await pixels(page), isFemur).count, 0);
  await page.context().close();
});

test("a map is computed in the page where the report has none, and says how far it is", async () => {
  const { page } = await openPage(browser, pathOf("zones"));
  assert.equal(textOf("zones").map, null);
  await openTab(page, "Figures");
  await page.evaluate(() => {
    globalThis.progressSeen = [];
    new MutationObserver(() => progressSeen.push(document.getElementById("map-progress")?.textContent)).observe(document.body, { childList: true, characterData: true, subtree: true });
  });
  await page.getByRole("button", { name: "Compute a map" }).click();
  // Cells that are not known yet are no black ones.
  assert.ok(await page.locator("rect.cell.unknown").evaluateAll((cells) => cells.every((cell) => getComputedStyle(cell).fill !== "rgb(0, 0, 0)")));
  await page.waitForFunction(() => progressSeen.some((text) => /^Computing the map: \d+ of 120 points$/.test(text)));
  await page.waitForFunction(() => document.getElementById("map-progress").textContent === "", undefined, { timeout: 120000 });
  assert.equal(await page.locator("#side rect.cell").count(), 120);
  assert.equal(await page.locator("#side rect.cell.unknown").count(), 0);
  await keep(page, "map");
  await page.context().close();
});

test("a recorded motion plays, with a cursor in its curves", { skip: !has("walk") && "not made" }, async () => {
  const { page } = await openPage(browser, pathOf("walk"));
  await settled(page);
  await openTab(page, "Figures");
  const frame = page.getByRole("slider", { name: "Frame", exact: true });
  const flexion = async () => Number(await page.locator("input[aria-label='flexion, degrees'][role=spinbutton]").getAttribute("aria-valuenow"));
  await frame.fill("0");
  // As the file has it in its first row.
  assert.ok(Math.abs((await flexion()) - 19.56730088) < 1e-9, String(await flexion()));
  const cursor = page.locator("#side .cursor").first();
  const before = Number(await cursor.getAttribute("x1"));
  await page.getByRole("button", { name: "Play" }).click();
  await page.waitForFunction(() => Number(document.querySelector("input[aria-label=Frame]").value) > 10);
  assert.ok(Number(await cursor.getAttribute("x1")) > before);
  assert.notEqual(await flexion(), 19.56730088);
  await keep(page, "walk");
  await page.context().close();
});
