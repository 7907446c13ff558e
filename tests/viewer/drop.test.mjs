// Meshes and label maps dropped on the page that holds no joint: the same answers and the same errors as on the command line.
import assert from "node:assert/strict";
import { execFileSync } from "node:child_process";
import { mkdirSync, readFileSync, rmSync, writeFileSync } from "node:fs";
import { join } from "node:path";
import { test } from "node:test";
import { deflateSync } from "node:zlib";
import { angleOf, axeSource, drop, keep, openPage, reports, root, settled, sharedBrowser } from "./browser.mjs";
import { assertCommandLimits } from "./command_limits.mjs";
import { makeLabelMaps } from "./label_maps.mjs";

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

const empty = join(root, "build/release/report_template.html");

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
  // The clock face, and the caveats of the numbers.
  assert.equal(await page.locator("#side .plot .mark").count(), motions.filter(({ clock_hour }) => clock_hour !== null).length);
  assert.equal(await page.locator("#side .normal-mark").count(), motions.filter(({ normal_range_deg }) => normal_range_deg !== null).length);
  const text = await page.locator("#side").textContent();
  for (const words of [provenance.version, provenance.fixed_mesh.sha256, provenance.mobile_mesh.sha256, String(provenance.mobile_mesh.bytes),
    normal_range_source, `radius ${bearing.head.radius_mm.toFixed(2)} mm`, `reaches ${bearing.margin_mm.toFixed(2)} mm`, "centre: the head's",
    scope.slice(1), ...motions.flatMap(({ caveats }) => caveats.map(({ text }) => text))])
    assert.ok(text.includes(words), words);
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

test("meshes compressed as VTK compresses them are read, and damaged ones reported as on the command line", async () => {
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
    let text = "";
    try {
      execFileSync(condyle, ["inspect", path], { stdio: "pipe" });
    } catch (error) {
      text = String(error.stderr).trim().replace(`condyle: ${path}`, "damaged.vtp");
    }
    assert.match(text, /^damaged.vtp: .*block/);
    await page.locator("#files").setInputFiles([files[0], path]);
    await page.waitForFunction((line) => document.querySelector("[role=alert]")?.textContent === line, text);
  }
  await page.context().close();
});

test("a wrong dropped file is reported as on the command line, and the page takes another", async () => {
  const path = join(reports, "broken.ply");
  writeFileSync(path, "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\nend_header\n0 0\n1 0\n0 1\n");
  let text = "";
  try {
    execFileSync(condyle, ["inspect", path], { stdio: "pipe" });
  } catch (error) {
    text = String(error.stderr).trim().replace(`condyle: ${path}`, "broken.ply");
  }
  assert.match(text, /^broken.ply: /);
  const { page } = await openPage(browser, empty, { answers: false });
  const files = ["hip_bone.ply", "femur.ply"].map((name) => join(reports, "sample", name));
  await page.locator("#files").setInputFiles([path, files[1]]);
  await page.getByRole("alert").waitFor();
  assert.equal(await page.getByRole("alert").textContent(), text);
  await page.locator("#files").setInputFiles([files[0]]);
  await page.getByText("now add the mobile one").waitFor();
  await page.locator("#files").setInputFiles([files[1]]);
  await page.waitForFunction(() => Number(document.documentElement.dataset.answered) > 0);
  assert.equal(await page.getByRole("alert").count(), 0);
  await page.context().close();
});

const sampleFiles = ["hip_bone.ply", "femur.ply"].map((name) => join(reports, "sample", name));
const answered = (page) => page.waitForFunction(() => Number(document.documentElement.dataset.answered) > 0);

/// As a hand does it, file by file or all at once.
test("a side that is given counts, and one that the bones speak against is refused with their side, the votes of init folded away", async () => {
  const { page } = await openPage(browser, empty, { answers: false });
  const side = page.getByLabel("Side", { exact: true });
  await side.selectOption("left");
  await page.locator("#files").setInputFiles(sampleFiles);
  await page.getByRole("alert").waitFor();
  const text = await page.getByRole("alert").textContent();
  await keep(page, "given_side");
  const joint = join(reports, "given_side.toml");
  rmSync(joint, { force: true });
  execFileSync(condyle, ["init", ...sampleFiles, "--side", "left", "--out", joint], { stdio: "ignore" });
  assert.equal(text, "side: the bones are of a right hip, and left is chosen");
  const proposed = readFileSync(joint, "utf8"), votes = page.locator("#messages details");
  assert.equal(await votes.evaluate(({ open }) => open), false);
  await votes.locator("summary").click();
  const said = await votes.locator("li").allTextContents();
  assert.ok(said.length > 4);
  for (const vote of said) assert.ok(proposed.includes(vote), vote);
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
    assert.match(await page.getByRole("alert").textContent(), /reload it before dropping others/);
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
  assert.match(refused, /still reading the files/);
  // What was wrong with the first pair; then the page takes another.
  await page.waitForFunction(() => /^[ab].stl: /.test(document.querySelector("[role=alert]").textContent));
  assert.equal(await page.getByRole("alert").count(), 1);
  await drop(page, sampleFiles);
  await answered(page);
  assert.equal(await page.locator("#scene > canvas").count(), 1);
  await page.context().close();
});

/// A mesh of the sample with its vertices and triangles changed.
function writeChanged(name, from, { vertex = (x) => x, turned = false }) {
  const { vertices, triangles } = readPly(join(reports, "sample", from)), folder = join(reports, "wrong_bones"), path = join(folder, name);
  mkdirSync(folder, { recursive: true });
  const points = Array.from({ length: vertices.length / 3 }, (_, i) => vertex([...vertices.subarray(3 * i, 3 * i + 3)]).join(" "));
  const faces = Array.from({ length: triangles.length / 3 }, (_, i) => [...triangles.subarray(3 * i, 3 * i + 3)]);
  writeFileSync(path, `${["ply", "format ascii 1.0", `element vertex ${points.length}`, "property double x", "property double y", "property double z",
    `element face ${faces.length}`, "property list uchar int vertex_indices", "end_header", ...points,
    ...faces.map(([a, b, c]) => `3 ${(turned ? [a, c, b] : [a, b, c]).join(" ")}`)].join("\n")}\n`);
  return path;
}

function writeOther(name, bytes) {
  const folder = join(reports, "wrong_bones");
  mkdirSync(folder, { recursive: true });
  writeFileSync(join(folder, name), bytes);
  return join(folder, name);
}

const isRead = "is not read here: drop a joint file (.toml), meshes (.stl, .obj, .ply, .vtp, .vtk), label maps (.nii, .nii.gz, .nrrd, .mha) or a motion file (.mot, .sto, .csv).";

test("files that make no hip are refused with their cause in one line, which names them once, and the page takes another", async () => {
  const { page, complaints } = await openPage(browser, empty, { answers: false });
  const [hipBone, femur] = sampleFiles, mirrored = ([x, y, z]) => [x, y, -z];
  const causes = [
    ...["pic.png", "scan.pdf", "rom.json", "plan.html", "notes"].map((name) => [[writeOther(name, "no mesh")], `${name} ${isRead}`]),
    [[hipBone, writeOther("pic.png", "no mesh")], `pic.png ${isRead}`],
    [[writeOther("walk.mot", "time\thip\n0\t1\n")], "walk.mot is a motion file, which plays on a joint: drop the joint first."],
    [[hipBone, writeOther("curves.csv", "time,flexion\n0,1\n")], "curves.csv is a motion file, which plays on a joint: drop the joint first."],
    [[hipBone, writeChanged("femur_inside_out.ply", "femur.ply", { turned: true })], "femur_inside_out.ply is inside out: its triangles are wound the other way round"],
    [[writeChanged("hip_inside_out.ply", "hip_bone.ply", { turned: true }), writeChanged("femur_inside_out.ply", "femur.ply", { turned: true })],
      "hip_inside_out.ply is inside out: its triangles are wound the other way round"],
    [[writeChanged("left_hip_bone.ply", "hip_bone.ply", { vertex: mirrored, turned: true }), femur], "left_hip_bone.ply and femur.ply are of different sides, one right and one left"],
    [[writeChanged("hip_bone_cm.ply", "hip_bone.ply", { vertex: (p) => p.map((x) => x / 10) }), femur], "hip_bone_cm.ply is in cm and femur.ply in mm: scale one of them"],
    [[hipBone, writeOther("hip_bone_again.ply", readFileSync(hipBone))], "hip_bone.ply and hip_bone_again.ply are the same mesh: drop the hip bone and the femur"],
  ];
  for (const [files, cause] of causes) {
    await page.evaluate(() => document.getElementById("messages").replaceChildren());
    await drop(page, files);
    const alert = page.getByRole("alert");
    await alert.waitFor();
    assert.deepEqual(await alert.allTextContents(), [cause]);
    for (const fold of await page.locator("#messages details").all()) assert.equal(await fold.evaluate(({ open }) => open), false);
    assert.doesNotMatch(await page.locator("#drop-progress").textContent(), /bone/);
  }
  await keep(page, "wrong_bones");
  await drop(page, [writeOther("empty_femur.ply", ""), hipBone]);
  await page.waitForFunction(() => /^empty_femur.ply: /.test(document.querySelector("[role=alert]")?.textContent));
  await drop(page, [femur]);
  await page.getByText("femur.ply is the mobile bone; now add the fixed one.").waitFor();
  await drop(page, [hipBone]);
  await answered(page);
  assert.equal(await page.getByRole("alert").count(), 0);
  // On a report they are refused by their names too.
  const report = await openPage(browser, join(reports, "sample.html"));
  await drop(report.page, [writeOther("pic.png", "no mesh")]);
  await report.page.getByRole("alert").waitFor();
  assert.equal(await report.page.getByRole("alert").textContent(), `pic.png ${isRead}`);
  assert.deepEqual(complaints, []);
  await report.page.context().close();
  await page.context().close();
});

const maps = makeLabelMaps(condyle, join(reports, "dropped_labels"), 2);

/// Limits of the command for the same bones.
function limitsOfLabels(name, ...words) {
  const joint = join(reports, "dropped_labels", name, "hip.toml");
  rmSync(join(reports, "dropped_labels", name), { recursive: true, force: true });
  execFileSync(condyle, ["init", ...words, "--out", joint], { stdio: "ignore" });
  return JSON.parse(execFileSync(condyle, ["rom", joint, "--json"], { stdio: ["ignore", "pipe", "ignore"] })).motions;
}

/// And for the meshes of the sample.
function limitsOfMeshes() {
  const joint = join(reports, "replaced.toml");
  rmSync(joint, { force: true });
  execFileSync(condyle, ["init", ...sampleFiles, "--out", joint], { stdio: "ignore" });
  return JSON.parse(execFileSync(condyle, ["rom", joint, "--json"], { stdio: ["ignore", "pipe", "ignore"] })).motions;
}

async function assertLimits(page, motions) {
  await answered(page);
  await settled(page);
  await assertCommandLimits(page, motions);
  assert.equal(await page.locator(".result").count(), 4);
}

test("a label map whose names say which bones it has becomes their joint, with the command's limits", async () => {
  const { page, complaints, requests } = await openPage(browser, empty, { answers: false });
  await page.evaluate(() => {
    globalThis.said = [];
    const place = document.getElementById("drop-progress");
    new MutationObserver(() => said.push(place.textContent)).observe(place, { childList: true, characterData: true, subtree: true });
  });
  await drop(page, [maps.named]);
  await assertLimits(page, limitsOfLabels("named", maps.named, "--fixed", "hip_right", "--mobile", "femur_right"));
  assert.deepEqual((await page.evaluate(() => said)).filter(Boolean),
    ["Reading named.seg.nrrd…", "Surface of hip_right…", "Surface of femur_right…", "Joint and limits…"]);
  assert.match(await page.locator("#title").textContent(), /^Right hip · femur right \/ hip right/);
  const side = await page.locator("#side").textContent();
  for (const said of ["side: right, by the names of the labels", "axes: LPS, by the image's header", "hip_right: label 78 of named.seg.nrrd", "voxels of 2 x 2 x 2 mm"])
    assert.ok(side.includes(said), said);
  await keep(page, "dropped_labels");
  assert.deepEqual(complaints, []);
  assert.deepEqual(requests, []);
  await page.context().close();
});

test("labels that no name settles are asked for, by keyboard too, and wrong ones are refused in one line", async () => {
  const { page } = await openPage(browser, empty, { answers: false });
  await page.locator("#files").setInputFiles([maps.nifti]);
  const stays = page.getByLabel("Bone that stays", { exact: true }), moves = page.getByLabel("Bone that moves", { exact: true });
  await stays.waitFor();
  await keep(page, "asked_labels");
  assert.match(await stays.locator("option:checked").textContent(), /^hip_right \(78 in TotalSegmentator's total\), 4\d,\d{3} voxels$/);
  assert.match(await moves.locator("option:checked").textContent(), /^femur_right \(76 in TotalSegmentator's total\)/);
  assert.equal(await stays.locator("option").count(), 4);
  await page.evaluate(axeSource);
  assert.deepEqual((await page.evaluate(() => globalThis.axe.run("#side"))).violations.map(({ id }) => id), []);
  const right = await moves.inputValue();
  await moves.selectOption(await stays.inputValue());
  await page.getByRole("button", { name: "Make the joint" }).click();
  await page.getByRole("alert").waitFor();
  assert.equal(await page.getByRole("alert").textContent(), "labels.nii.gz: label 78 is given for both bodies");
  await moves.selectOption(right);
  await page.getByLabel("Side", { exact: true }).selectOption("left");
  await page.getByRole("button", { name: "Make the joint" }).click();
  await page.waitForFunction(() => /^side: left is given/.test(document.querySelector("[role=alert]")?.textContent));
  assert.equal(await page.getByRole("alert").count(), 1);
  await page.getByLabel("Side", { exact: true }).selectOption("right");
  await stays.focus();
  for (const key of ["Tab", "Tab", "Enter"]) await page.keyboard.press(key);
  await assertLimits(page, limitsOfLabels("asked", maps.nifti, "--task", "total", "--fixed", "hip_right", "--mobile", "femur_right"));
  await page.context().close();
});

test("a mask of each bone makes a joint, one after the other or both at once", async () => {
  const motions = limitsOfLabels("masks", maps.hipMask, maps.femurMask);
  for (const first of [[maps.hipMask], [maps.femurMask, maps.hipMask]]) {
    const { page } = await openPage(browser, empty, { answers: false });
    await drop(page, first);
    if (first.length === 1) {
      await page.getByText("hip_right.nii.gz holds one bone: now add the other one.").waitFor();
      await drop(page, [maps.femurMask]);
    }
    await assertLimits(page, motions);
    await page.context().close();
  }
});

test("damaged label maps, images that are none, and a mesh beside one are refused in one line; the page takes another", async () => {
  const folder = join(reports, "dropped_labels"), whole = readFileSync(maps.nifti), wrong = {
    "cut.nii.gz": whole.subarray(0, whole.length >> 1),
    "ct.nrrd": Buffer.concat([Buffer.from("NRRD0004\ntype: short\ndimension: 3\nspace: LPS\nsizes: 2 2 2\nspace directions: (1,0,0) (0,1,0) (0,0,1)\n" +
      "endian: little\nencoding: raw\nspace origin: (0,0,0)\n\n"), Buffer.from(Int16Array.of(-1000, 3, 2, 1, 0, 1, 2, 3).buffer)]),
    "empty.nii": Buffer.alloc(0),
  };
  const { page } = await openPage(browser, empty, { answers: false });
  for (const [name, bytes] of Object.entries(wrong)) {
    const path = join(folder, name);
    writeFileSync(path, bytes);
    let said = "";
    try {
      execFileSync(condyle, ["inspect", path], { stdio: "pipe" });
    } catch (error) {
      said = String(error.stderr).trim().replace(`condyle: ${path}`, name);
    }
    assert.match(said, new RegExp(`^${name}: `));
    await drop(page, [path]);
    await page.waitForFunction((line) => document.querySelector("[role=alert]")?.textContent === line, said);
    assert.equal(await page.getByRole("alert").count(), 1);
  }
  await drop(page, [maps.named, sampleFiles[0]]);
  await page.waitForFunction(() => /not one of each/.test(document.querySelector("[role=alert]")?.textContent));
  await drop(page, [maps.hipMask, maps.femurMask, maps.named]);
  await page.getByText("A joint has two meshes").waitFor();
  await drop(page, [maps.named]);
  await answered(page);
  assert.equal(await page.getByRole("alert").count(), 0);
  await page.context().close();
});

test("meshes dropped on a report take its place once that is confirmed, with the command's limits, and the page says so until it is reloaded", async () => {
  const { page, complaints, requests } = await openPage(browser, join(reports, "shifted.html"), { width: 1440, height: 900, fragment: "#flexion=40" });
  await settled(page);
  const heading = await page.locator("#title").textContent(), motions = limitsOfMeshes();
  await drop(page, sampleFiles);
  const open = page.getByRole("button", { name: "Open in its place" });
  await open.waitFor();
  assert.equal(await page.locator("#title").textContent(), heading);
  await open.click();
  await page.waitForFunction(() => /femur.ply/.test(document.getElementById("title").textContent));
  await page.waitForFunction(() => globalThis.condyle && document.querySelectorAll(".tile").length === 12);
  await settled(page);
  await assertLimits(page, motions);
  for (const place of ["#messages", "#scope"]) assert.match(await page.locator(place).textContent(), /What is shown is no longer the report of this file/);
  assert.equal(await page.getByRole("button", { name: "Save copy" }).count(), 0);
  assert.equal(await page.locator("#scene > canvas").count(), 1);
  assert.equal(await angleOf(page, "flexion"), 0);
  await keep(page, "replaced");
  await drop(page, sampleFiles);
  await page.getByRole("alert").waitFor();
  assert.match(await page.getByRole("alert").textContent(), /reload it before dropping others/);
  assert.deepEqual(complaints, []);
  assert.deepEqual(requests, []);
  await page.reload();
  await page.waitForFunction((wanted) => document.getElementById("title").textContent === wanted, heading);
  await page.context().close();
});
