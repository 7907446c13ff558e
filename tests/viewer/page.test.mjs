// What the page answers and says, in a browser: against the command line, damaged, with hostile names.
import assert from "node:assert/strict";
import { execFileSync } from "node:child_process";
import { mkdirSync, readFileSync, rmSync, statSync, writeFileSync } from "node:fs";
import { join } from "node:path";
import { test } from "node:test";
import { deflateSync, inflateSync } from "node:zlib";
import { has, keep, openPage, pathOf, pixels, region, reports, root, settled, sharedBrowser, turnTo } from "./browser.mjs";
import { dataElement, readReport } from "./report_block.mjs";

const condyle = join(root, "build/release/condyle");
const browser = await sharedBrowser();

/// As condyle sample writes it: doubles, and triangles as a count and three numbers.
function readPly(path) {
  const bytes = readFileSync(path), end = bytes.indexOf("end_header\n") + 11, head = bytes.toString("latin1", 0, end);
  const [vertexCount, count] = ["vertex", "face"].map((name) => Number(new RegExp(`element ${name} (\\d+)`).exec(head)[1]));
  const vertices = Float64Array.from({ length: 3 * vertexCount }, (_, i) => bytes.readDoubleLE(end + 8 * i));
  const triangles = Int32Array.from({ length: 3 * count }, (_, i) =>
    bytes.readInt32LE(end + 24 * vertexCount + 13 * Math.floor(i / 3) + 1 + 4 * (i % 3)));
  return { vertices, triangles };
}

const textOf = (name) => readReport(pathOf(name)).text;

/// A report whose data block was changed.
function changed(name, change) {
  const path = join(reports, `${name}.html`);
  writeFileSync(path, readFileSync(pathOf("sample"), "utf8").replace(dataElement, (_, before, data, end) =>
    before + change(Buffer.from(data, "base64")).toString("base64") + end));
  return path;
}

/// The same with other text in it; arrays follow the text at a multiple of 8.
function withText(name, change) {
  return changed(name, (zipped) => {
    const block = inflateSync(zipped);
    const end = 16 + block.readUInt32LE(12);
    const said = JSON.parse(block.subarray(16, end));
    change(said);
    let text = Buffer.from(JSON.stringify(said));
    text = Buffer.concat([text, Buffer.alloc((8 - (text.length % 8)) % 8, " ")]);
    const head = Buffer.from(block.subarray(0, 16));
    head.writeUInt32LE(text.length, 12);
    return deflateSync(Buffer.concat([head, text, block.subarray(end)]));
  });
}

for (const name of ["sample", "scenario_3", "vhf_right", "libhip_left"])
  test(`${name} opens from disk, asks nothing of any network and complains of nothing`, { skip: !has(name) && "not made" }, async (t) => {
    const { page, complaints, requests, firstAnswer_ms } = await openPage(browser, pathOf(name));
    await settled(page);
    await keep(page, name);
    assert.deepEqual(requests, []);
    assert.deepEqual(complaints, []);
    const drawn_ms = await page.evaluate(() => document.documentElement.dataset.drawn);
    t.diagnostic(`first picture after ${drawn_ms} ms, first answer after ${firstAnswer_ms.toFixed(0)} ms, ${(statSync(pathOf(name)).size / 1e6).toFixed(2)} MB`);
    await page.context().close();
  });

test("the template and a report of scenario 3 are as small as was promised", () => {
  assert.ok(statSync(join(root, "viewer/report_template.html")).size <= 1.5e6);
  assert.ok(statSync(pathOf("scenario_3")).size <= 6e6);
});

for (const name of ["sample", "shifted", "counted", "parts", "knee"])
  test(`limits of ${name} are those of the command line, within their error bound`, { skip: !has(name) && "not made" }, async () => {
    const { page } = await openPage(browser, pathOf(name));
    const { coordinates, rom } = textOf(name);
    const names = coordinates.map(({ name: angle }) => angle);
    for (const motion of rom.motions) {
      const limit = await page.evaluate((question) => condyle.query({ of: "limit", limit: question }), {
        start: names.map((angle) => motion.start_deg[angle]), vary: names.indexOf(motion.vary), positive: motion.sense === "positive",
        range_deg: motion.range_deg, held: rom.held_translation_mm ?? [0, 0, 0],
      });
      assert.equal(limit.reason, motion.reason);
      assert.ok(Math.abs(limit.turned_deg - motion.limit_deg) <= motion.error_bound_deg, `${motion.name}: ${limit.turned_deg}`);
    }
    assert.ok(rom.motions.length > 1);
    await page.context().close();
  });

test("the reports that limits are compared in differ by the contact that counts", () => {
  const [counted, shifted] = ["counted", "shifted"].map((name) => textOf(name).rom.motions);
  assert.ok(shifted.some(({ bearing_contact_deg, limit_deg }, i) => bearing_contact_deg !== null && counted[i].limit_deg < limit_deg));
});

test("free angles of a map are those of the command line, within the error bound of limits", async (t) => {
  const { page } = await openPage(browser, pathOf("sample"));
  const { coordinates, rom, map } = textOf("sample");
  const names = coordinates.map(({ name }) => name);
  // They rest on the sines and arctangents of two C libraries.
  const bound = Math.max(...rom.motions.map(({ error_bound_deg }) => error_bound_deg));
  assert.ok(bound < 1e-10);
  let equal = 0, asked = 0;
  const one = (a, b) => {
    assert.ok(Math.abs(a - b) <= bound, `${a} and not ${b}`);
    equal += a === b;
    ++asked;
  };
  let points = 0;
  for (const [point, intervals] of map.intervals.entries()) {
    const found = await page.evaluate((question) => condyle.query(question), {
      of: "mapPoint", point, question: {
        columnAngle: names.indexOf(map.columns.angle), rowAngle: names.indexOf(map.rows.angle), vary: names.indexOf(map.vary),
        columns: map.columns.values_deg, rows: map.rows.values_deg,
      },
    });
    assert.equal(found.length, intervals.length);
    found.flat().forEach((value, i) => one(value, intervals.flat()[i]));
    ++points;
  }
  t.diagnostic(`${equal} of ${asked} equal to the bit`);
  assert.equal(points, map.columns.values_deg.length * map.rows.values_deg.length);
  await page.context().close();
});

test("depths, pairs and contact are those of condyle depth", async () => {
  const { page } = await openPage(browser, pathOf("sample"));
  let inside = 0;
  for (let i = 0; i < 24; ++i) {
    const angles = [(37 * i) % 140, ((23 * i) % 90) - 45, ((41 * i) % 130) - 65];
    const pose = `flexion=${angles[0]} adduction=${angles[1]} internal_rotation=${angles[2]}`;
    const told = JSON.parse(execFileSync(condyle, ["depth", join(reports, "sample/hip.toml"), "--method", "radial", "--pose", pose, "--json"],
      { stdio: ["ignore", "pipe", "ignore"] }));
    const shown = await page.evaluate((at) => condyle.query({ of: "pose", at }), { angles, translation: [0, 0, 0] });
    assert.equal(shown.inContact, told.in_contact);
    const flat = (typed) => Object.values(typed);
    const gaps = await page.evaluate((at) => condyle.query({ of: "values", at, quantity: "gap" }), { angles, translation: [0, 0, 0] });
    assert.equal(flat(shown.pairs).length / 2, told.triangle_pairs);
    for (const [body, found] of [["mobile", shown.mobileInFixed], ["fixed", shown.fixedInMobile]]) {
      const depths = flat(found.depths_mm).filter((depth) => depth > 0);
      assert.equal(depths.length, told.bodies[body].vertices_inside);
      assert.equal(depths.length ? Math.max(...depths) : 0, told.bodies[body].max_radial_depth_mm ?? 0);
      const negative = flat(gaps[body].shown).filter((gap) => gap < 0);
      assert.deepEqual(negative.map((gap) => -gap).sort(), depths.map(Math.fround).sort(), "coloured as deep as they are");
      inside += depths.length;
    }
  }
  assert.ok(inside > 100, `${inside} vertices inside`);
  await page.context().close();
});

test("a slider turns the joint, the address remembers it, and another page opened there shows the same", async () => {
  const { page } = await openPage(browser, pathOf("sample"));
  await turnTo(page, { flexion: 110, adduction: 20, internal_rotation: 40 });
  const answer = await page.locator("#answer").textContent();
  assert.match(answer, /^In contact/);
  await page.waitForFunction(() => location.hash.includes("internal_rotation=40"));
  const fragment = new URL(page.url()).hash;
  const again = await openPage(browser, pathOf("sample"), { fragment });
  await settled(again.page);
  assert.equal(await again.page.locator("#answer").textContent(), answer);
  await page.context().close();
  await again.page.context().close();
});

test("a figure goes where it is pressed", async () => {
  const { page } = await openPage(browser, pathOf("sample"), { reducedMotion: "reduce" });
  const fadir = textOf("sample").rom.motions.find(({ name }) => name === "fadir");
  await page.getByRole("button", { name: /^Go to the end of fadir/ }).first().click();
  await settled(page);
  const turned = await page.getByRole("spinbutton", { name: "internal rotation, degrees" }).inputValue();
  assert.equal(Number(turned), fadir.at_limit_deg.internal_rotation);
  await page.getByRole("button", { name: "flexion 60°, adduction 0°" }).click();
  await settled(page);
  assert.equal(await page.getByRole("spinbutton", { name: "flexion, degrees", exact: true }).inputValue(), "60");
  await page.context().close();
});

test("a figure pressed shows where bone meets bone once the joint has turned there, and the zone around it", async () => {
  const { page } = await openPage(browser, pathOf("zones"));
  await page.getByLabel("Colour", { exact: true }).selectOption("none");
  await page.getByLabel("Mark triangles in contact").uncheck();
  await page.getByLabel("Show femur").uncheck();
  const fadir = textOf("zones").rom.motions.find(({ name }) => name === "fadir");
  await page.getByRole("button", { name: "fadir", exact: true }).click();
  await page.waitForFunction((deg) => Number(document.querySelector("input[aria-label='internal rotation, degrees'][type=number]").value) === deg,
    fadir.at_limit_deg.internal_rotation);
  assert.equal(await page.getByLabel("Mark the impingement zone of").inputValue(), "fadir");
  await settled(page);
  const seen = await pixels(page);
  const isContactPoint = (r, g, b) => r > 200 && g > 90 && g < 150 && b < 60, isZone = (r, g, b) => b > g + 20 && r > g + 10;
  await keep(page, "zone");
  assert.ok(region(seen, isContactPoint).count > 10, "the contact point");
  assert.ok(region(seen, isZone).count > 10, "the zone");
  await page.getByLabel("Mark the impingement zone of").selectOption("none");
  await settled(page);
  assert.equal(region(await pixels(page), isZone).count, 0);
  await page.context().close();
});

test("where a layer carries load its pressure is shown, in MPa, on open sheets too", { skip: !has("knee") && "not made" }, async () => {
  const { page, complaints } = await openPage(browser, pathOf("knee"));
  await page.getByLabel("Colour", { exact: true }).selectOption("pressure");
  await settled(page);
  await page.getByRole("button", { name: "above", exact: true }).click();
  await page.getByLabel("Show femoral cartilage").uncheck();
  await page.getByLabel("Mark triangles in contact").uncheck();
  await settled(page);
  await keep(page, "pressure");
  const loaded = region(await pixels(page), (r, g, b) => Math.max(r, g, b) - Math.min(r, g, b) > 60);
  assert.ok(loaded.count > 100, `${loaded.count} pixels under pressure`);
  assert.match(await page.locator("#legend").textContent(), /^pressure, MPa/);
  assert.deepEqual(complaints, []);
  await page.context().close();
});

test("meshes of a body are shown one by one", async () => {
  const { page } = await openPage(browser, pathOf("parts"));
  const isFemur = (r, g, b) => b > r + 8;
  await page.getByLabel("Colour", { exact: true }).selectOption("none");
  await page.getByLabel("Show hip bone").uncheck();
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
  await page.getByRole("button", { name: "Compute a map" }).click();
  await page.getByText(/^Computing the map: \d+ of 120 points$/).waitFor();
  await page.waitForFunction(() => document.getElementById("map-progress").textContent === "", undefined, { timeout: 120000 });
  assert.equal(await page.locator("rect.cell").count(), 120);
  assert.equal(await page.locator("rect.cell[fill=none]").count(), 0);
  await keep(page, "map");
  await page.context().close();
});

test("a recorded motion plays, with a cursor in its curves", { skip: !has("walk") && "not made" }, async () => {
  const { page } = await openPage(browser, pathOf("walk"));
  await settled(page);
  const frame = page.getByRole("slider", { name: "Frame" });
  const flexion = async () => Number(await page.getByRole("spinbutton", { name: "flexion, degrees", exact: true }).inputValue());
  await frame.fill("0");
  // As the file has it in its first row.
  assert.ok(Math.abs((await flexion()) - 19.56730088) < 1e-9, String(await flexion()));
  const cursor = page.locator(".cursor").first();
  const before = Number(await cursor.getAttribute("x1"));
  await page.getByRole("button", { name: "Play" }).click();
  await page.waitForFunction(() => Number(document.querySelector("input[aria-label=Frame]").value) > 10);
  assert.ok(Number(await cursor.getAttribute("x1")) > before);
  assert.notEqual(await flexion(), 19.56730088);
  await keep(page, "walk");
  await page.context().close();
});

for (const [what, change, says] of [
  ["cut short", (zipped) => zipped.subarray(0, zipped.length / 2), /incomplete or was changed/],
  ["one byte changed", (zipped) => (zipped[Math.floor(zipped.length / 2)] ^= 1, zipped), /cannot be read/],
  ["not a block", () => deflateSync(Buffer.from("something else that is longer than a head")), /does not begin as a block/],
  ["of a later version", (zipped) => {
    const block = inflateSync(zipped);
    block.writeUInt32LE(2, 8);
    return deflateSync(block);
  }, /version is 2/],
  ["without its arrays", (zipped) => deflateSync(inflateSync(zipped).subarray(0, 16 + inflateSync(zipped).readUInt32LE(12))), /ends before/],
])
  test(`a data block ${what} is told in one line`, async () => {
    const { page, complaints } = await openPage(browser, changed("damaged", change), { answers: false });
    const warning = page.getByRole("alert");
    await warning.waitFor();
    assert.match(await warning.textContent(), says);
    assert.equal(await warning.count(), 1);
    assert.deepEqual(complaints, []);
    await page.context().close();
  });

const empty = join(root, "viewer/report_template.html");

test("two meshes dropped on the empty page answer as the same files do on the command line", async (t) => {
  const { page, complaints, requests } = await openPage(browser, empty, { answers: false });
  await page.getByText("This page holds no joint").waitFor();
  const files = ["hip_bone.ply", "femur.ply"].map((name) => join(reports, "sample", name));
  await page.locator("#files").setInputFiles(files);
  await page.waitForFunction(() => Number(document.documentElement.dataset.answered) > 0);
  await settled(page);
  const joint = join(reports, "dropped.toml");
  const run = (...words) => execFileSync(condyle, words, { stdio: ["ignore", "pipe", "ignore"] });
  rmSync(joint, { force: true });
  run("init", ...files, "--out", joint);
  const { motions } = JSON.parse(run("rom", joint, "--json"));
  const bound = Math.max(...motions.map(({ error_bound_deg }) => error_bound_deg));
  let equal = 0;
  for (const [i, motion] of motions.entries()) {
    const limit = await page.evaluate((question) => condyle.query({ of: "limit", limit: question }), {
      start: Object.values(motion.start_deg), vary: Object.keys(motion.start_deg).indexOf(motion.vary),
      positive: motion.sense === "positive", range_deg: motion.range_deg,
    });
    assert.ok(Math.abs(limit.turned_deg - motion.limit_deg) <= bound, `${motion.name}: ${limit.turned_deg} and not ${motion.limit_deg}`);
    equal += limit.turned_deg === motion.limit_deg;
    const row = await page.locator(".plot title").nth(i).textContent();
    assert.ok(row.includes(motion.limit_deg.toFixed(1)), row);
  }
  t.diagnostic(`${equal} of ${motions.length} limits equal to the bit`);
  await keep(page, "dropped");
  assert.deepEqual(complaints, []);
  assert.deepEqual(requests, []);
  await page.context().close();
});

/// A mesh of condyle sample as VTK writes VTP: numbers in base64, compressed by zlib in blocks of 32 kB.
function writeCompressedVtp(name, path) {
  const { vertices, triangles } = readPly(join(reports, "sample", name));
  const array = (numbers) => {
    const bytes = Buffer.from(numbers.buffer), blocks = [];
    for (let at = 0; at < bytes.length; at += 32768) blocks.push(bytes.subarray(at, at + 32768));
    const packed = blocks.map((block) => deflateSync(block));
    const header = Uint32Array.of(blocks.length, 32768, bytes.length % 32768, ...packed.map(({ length }) => length));
    return Buffer.from(header.buffer).toString("base64") + Buffer.concat(packed).toString("base64");
  };
  const data = (type, attributes, numbers) => `<DataArray type="${type}" ${attributes} format="binary">${array(numbers)}</DataArray>`;
  const count = triangles.length / 3;
  writeFileSync(path, `<?xml version="1.0"?>
<VTKFile type="PolyData" version="0.1" byte_order="LittleEndian" header_type="UInt32" compressor="vtkZLibDataCompressor"><PolyData>
<Piece NumberOfPoints="${vertices.length / 3}" NumberOfVerts="0" NumberOfLines="0" NumberOfStrips="0" NumberOfPolys="${count}">
<Points>${data("Float64", 'Name="Points" NumberOfComponents="3"', vertices)}</Points>
<Polys>${data("Int32", 'Name="connectivity"', triangles)}${data("Int32", 'Name="offsets"', Int32Array.from({ length: count }, (_, t) => 3 * t + 3))}</Polys>
</Piece></PolyData></VTKFile>
`);
}

test("meshes compressed as VTK compresses them are read, and damaged ones told as on the command line", async () => {
  const folder = join(reports, "compressed");
  mkdirSync(folder, { recursive: true });
  const files = ["hip_bone", "femur"].map((name) => {
    writeCompressedVtp(`${name}.ply`, join(folder, `${name}.vtp`));
    return join(folder, `${name}.vtp`);
  });
  const limitsOf = async (dropped) => {
    const { page } = await openPage(browser, empty, { answers: false });
    await page.locator("#files").setInputFiles(dropped);
    await page.waitForFunction(() => Number(document.documentElement.dataset.answered) > 0);
    await settled(page);
    const limits = await page.locator(".plot title").allTextContents();
    await page.context().close();
    return limits;
  };
  assert.deepEqual(await limitsOf(files), await limitsOf(["hip_bone.ply", "femur.ply"].map((name) => join(reports, "sample", name))));

  // A bit of the sum that ends the last block of the points, and one of what is compressed.
  const whole = readFileSync(files[1], "utf8"), [before, text] = /^[^]*?NumberOfComponents="3" format="binary">([^<]*)/.exec(whole);
  const end = before.length;
  assert.ok(text.length > 1000);
  const { page } = await openPage(browser, empty, { answers: false });
  for (const back of [2, 200]) {
    const bytes = Buffer.from(whole), last = end - 4 - back;
    bytes[last] = bytes[last] === 65 ? 66 : 65;
    const path = join(folder, "damaged.vtp");
    writeFileSync(path, bytes);
    let told = "";
    try {
      execFileSync(condyle, ["inspect", path], { stdio: "pipe" });
    } catch (error) {
      told = String(error.stderr).trim().replace(`condyle: ${path}`, "damaged.vtp");
    }
    assert.match(told, /^damaged.vtp: .*block/);
    await page.locator("#files").setInputFiles([files[0], path]);
    await page.waitForFunction((line) => document.querySelector("[role=alert]")?.textContent === line, told);
  }
  await page.context().close();
});

test("a wrong dropped file is told as on the command line, and the page takes another", async () => {
  const path = join(reports, "broken.ply");
  writeFileSync(path, "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\nend_header\n0 0\n1 0\n0 1\n");
  let told = "";
  try {
    execFileSync(condyle, ["inspect", path], { stdio: "pipe" });
  } catch (error) {
    told = String(error.stderr).trim().replace(`condyle: ${path}`, "broken.ply");
  }
  assert.match(told, /^broken.ply: /);
  const { page } = await openPage(browser, empty, { answers: false });
  const files = ["hip_bone.ply", "femur.ply"].map((name) => join(reports, "sample", name));
  await page.locator("#files").setInputFiles([path, files[1]]);
  await page.getByRole("alert").waitFor();
  assert.equal(await page.getByRole("alert").textContent(), told);
  await page.locator("#files").setInputFiles([files[0]]);
  await page.getByText("now the one that moves").waitFor();
  await page.locator("#files").setInputFiles([files[1]]);
  await page.waitForFunction(() => Number(document.documentElement.dataset.answered) > 0);
  assert.equal(await page.getByRole("alert").count(), 0);
  await page.context().close();
});

test("names stay text: markup, scripts, a megabyte, right to left", async () => {
  const hostile = '<img src=x onerror="globalThis.broken=1"><script>globalThis.broken=1</script> & "quotes" ‮עברית العربية';
  const path = withText("hostile", (text) => {
    text.title = hostile;
    text.joint.fixed = hostile;
    text.joint.mobile = "x".repeat(1e6);
    text.rom.motions[0].name = hostile;
    text.rom.notes.push({ code: "wrong_side", text: hostile });
  });
  const { page, complaints } = await openPage(browser, path);
  await settled(page);
  assert.equal(await page.locator("#title").textContent(), hostile);
  assert.equal(await page.evaluate(() => globalThis.broken), undefined);
  assert.equal(await page.locator("img").count(), 0);
  assert.deepEqual(complaints, []);
  assert.ok(await page.evaluate(() => document.documentElement.scrollWidth <= innerWidth));
  await keep(page, "hostile");
  await page.context().close();
});

test("ten thousand steps leave memory as it was", async (t) => {
  const { page } = await openPage(browser, pathOf("scenario_3"));
  const used = async () => (await page.evaluate(async (steps) => {
    for (let i = 0; i < steps; ++i) await condyle.query({ of: "pose", at: { angles: [i % 120, (i % 40) - 20, (i % 60) - 30], translation: [0, 0, 0] } });
    return condyle.query({ of: "memory" });
  }, 2500));
  const first = await used();
  for (let i = 0; i < 3; ++i) await used();
  const last = await used();
  t.diagnostic(`module memory ${(first / 1e6).toFixed(1)} MB, after 10,000 more steps ${(last / 1e6).toFixed(1)} MB`);
  assert.equal(last, first);
  await page.context().close();
});
