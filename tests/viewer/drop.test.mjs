// Meshes dropped on the page that holds no joint: the same answers and the same errors as on the command line.
import assert from "node:assert/strict";
import { execFileSync } from "node:child_process";
import { mkdirSync, readFileSync, rmSync, writeFileSync } from "node:fs";
import { join } from "node:path";
import { test } from "node:test";
import { deflateSync } from "node:zlib";
import { keep, openPage, reports, root, settled, sharedBrowser } from "./browser.mjs";

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

const empty = join(root, "viewer/report_template.html");

test("two meshes dropped on the empty page answer as the same files do on the command line", async () => {
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
  const { motions, provenance, bearing, normal_range_source, scope } = JSON.parse(run("rom", joint, "--json"));
  for (const [i, motion] of motions.entries()) {
    const limit = await page.evaluate((question) => condyle.query({ of: "limit", limit: question }), {
      start: Object.values(motion.start_deg), vary: Object.keys(motion.start_deg).indexOf(motion.vary),
      positive: motion.sense === "positive", range_deg: motion.range_deg,
    });
    assert.equal(limit.turned_deg, motion.limit_deg, motion.name);
    const row = await page.locator(".tile").nth(i).textContent();
    assert.ok(row.includes(motion.reason === "end_of_range" ? `>${motion.limit_deg.toFixed(0)}°` : motion.limit_deg.toFixed(1)), row);
  }
  assert.equal(motions.length, 12);
  // The clock face, and what the numbers are told with.
  assert.equal(await page.locator("#side .plot .mark").count(), motions.filter(({ clock_hour }) => clock_hour !== null).length);
  assert.equal(await page.locator("#side .normal-mark").count(), motions.filter(({ normal_range_deg }) => normal_range_deg !== null).length);
  const told = await page.locator("#side").textContent();
  for (const words of [provenance.version, provenance.fixed_mesh.sha256, provenance.mobile_mesh.sha256, String(provenance.mobile_mesh.bytes),
    normal_range_source, `radius ${bearing.head.radius_mm.toFixed(2)} mm`, `reaches ${bearing.margin_mm.toFixed(2)} mm`, "centre: the head's",
    scope.slice(1), ...motions.flatMap(({ caveats }) => caveats.map(({ text }) => text))])
    assert.ok(told.includes(words), words);
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
    const limits = await page.locator(".tile").allTextContents();
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

const sampleFiles = ["hip_bone.ply", "femur.ply"].map((name) => join(reports, "sample", name));
const answered = (page) => page.waitForFunction(() => Number(document.documentElement.dataset.answered) > 0);

/// As a hand does it, file by file or all at once.
async function drop(page, files) {
  const client = await page.context().newCDPSession(page);
  for (const type of ["dragEnter", "dragOver", "drop"])
    await client.send("Input.dispatchDragEvent", { type, x: 300, y: 300, data: { items: [], files, dragOperationsMask: 1 } });
}

test("a side that is given counts, and one that the bones speak against is refused as init refuses its axes", async () => {
  const { page } = await openPage(browser, empty, { answers: false });
  const side = page.getByLabel("Side", { exact: true });
  await side.selectOption("left");
  await page.locator("#files").setInputFiles(sampleFiles);
  await page.getByRole("alert").waitFor();
  const told = await page.getByRole("alert").textContent();
  await keep(page, "given_side");
  const joint = join(reports, "given_side.toml");
  rmSync(joint, { force: true });
  execFileSync(condyle, ["init", ...sampleFiles, "--side", "left", "--out", joint], { stdio: "ignore" });
  assert.match(told, /^axes: /);
  const proposed = readFileSync(joint, "utf8");
  for (const said of told.replace("axes: ", "").split("; ")) assert.ok(proposed.includes(said), said);
  await side.selectOption("right");
  await page.locator("#files").setInputFiles(sampleFiles);
  await answered(page);
  assert.ok((await page.locator("#side").textContent()).includes("side: right, given"));
  await page.context().close();
});

test("files dropped into the scene make a joint, and others after them are refused in one line", async () => {
  const { page, complaints } = await openPage(browser, empty, { answers: false });
  await page.getByText("Drop the meshes of a hip on this page").waitFor();
  await keep(page, "empty");
  await drop(page, sampleFiles);
  await answered(page);
  await settled(page);
  assert.equal(await page.getByText("Drop the meshes of a hip on this page").count(), 0);
  assert.match(await page.locator("#title").textContent(), /^Right hip · femur.ply \/ hip_bone.ply/);
  for (let again = 0; again < 2; ++again) {
    await drop(page, sampleFiles);
    await page.getByRole("alert").waitFor();
    assert.match(await page.getByRole("alert").textContent(), /reload it, then drop others/);
    assert.equal(await page.getByRole("alert").count(), 1);
  }
  assert.equal(await page.locator("#scene > canvas").count(), 1);
  assert.equal(await page.getByRole("tab", { name: "Motion", exact: true }).count(), 1);
  assert.deepEqual(complaints, []);
  await page.context().close();
});

test("files dropped while others are read, or three at once, are refused in one line", async () => {
  const { page } = await openPage(browser, empty, { answers: false });
  await page.getByText("Drop the meshes of a hip on this page").waitFor();
  await drop(page, [...sampleFiles, sampleFiles[0]]);
  await page.getByText("A joint has two meshes").waitFor();
  // Both within one turn: the first pair is still being read.
  const refused = await page.evaluate(() => {
    const transfer = new DataTransfer();
    for (const name of ["a.stl", "b.stl"]) transfer.items.add(new File(["solid\nendsolid\n"], name));
    for (let i = 0; i < 2; ++i) document.body.dispatchEvent(new DragEvent("drop", { bubbles: true, cancelable: true, dataTransfer: transfer }));
    return document.querySelector("[role=alert]").textContent;
  });
  assert.match(refused, /still reading the meshes/);
  // What was wrong with the first pair; then the page takes another.
  await page.waitForFunction(() => /^[ab].stl: /.test(document.querySelector("[role=alert]").textContent));
  assert.equal(await page.getByRole("alert").count(), 1);
  await drop(page, sampleFiles);
  await answered(page);
  assert.equal(await page.locator("#scene > canvas").count(), 1);
  await page.context().close();
});
