// Joint files dropped on a page in a browser: the command's limits and depths, the report that stays until another joint is read, lines for what is
// not taken. That the page's data are those of a report is held by joint_file.test.mjs.
import assert from "node:assert/strict";
import { execFileSync } from "node:child_process";
import { cpSync, existsSync, mkdirSync, readFileSync, rmSync, writeFileSync } from "node:fs";
import { join } from "node:path";
import { test } from "node:test";
import { inflateSync } from "node:zlib";
import { angleOf, drop, keep, openPage, openTab, reports, root, settled, sharedBrowser, type } from "./browser.mjs";
import { assertCommandLimits } from "./command_limits.mjs";

const condyle = join(root, "build/release/condyle");
const browser = await sharedBrowser();
const empty = join(root, "build/release/report_template.html"), folder = join(reports, "joint_drops");
mkdirSync(folder, { recursive: true });
const data = process.env.CONDYLE_DATA ?? join(root, "../shared/data");
const sample = (name) => join(reports, "sample", name), meshes = [sample("hip_bone.ply"), sample("femur.ply")];
const answer = (...words) => JSON.parse(execFileSync(condyle, [...words, "--json"], { stdio: ["ignore", "pipe", "ignore"], env: { ...process.env, CONDYLE_DATA: data } }));

function written(name, text) {
  writeFileSync(join(folder, name), text);
  return join(folder, name);
}

/// As a hand does it; folders too.
const shows = (page, title) => page.waitForFunction((wanted) => new RegExp(wanted).test(document.getElementById("title").textContent) && globalThis.condyle, title);
const alerts = (page) => page.getByRole("alert").allTextContents();
const refused = (page, line) => page.waitForFunction((wanted) => [...document.querySelectorAll("[role=alert]")].some(({ textContent }) => textContent === wanted), line);

async function assertLimits(page, { motions }) {
  await settled(page);
  await assertCommandLimits(page, motions);
  assert.equal(await page.locator(".tile").count(), motions.length);
}

/// Deepest depths at poses, of the command and of the page.
async function assertDepths(page, joint, poses) {
  for (const angles of poses) {
    const names = ["flexion", "adduction", "internal_rotation"], pose = angles.map((angle, i) => `${names[i]}=${angle}`).join(" ");
    const said = answer("depth", joint, "--pose", pose);
    const depth = await page.evaluate((at) => condyle.query({ of: "depth", at: { angles: at, translation: [0, 0, 0] } }), angles);
    const { reliable_depth: deepest, contact } = said;
    assert.equal(depth.inContact, said.in_contact);
    assert.deepEqual(depth.deepest && [depth.deepest.depth_mm, depth.deepest.body, depth.deepest.vertex, depth.deepest.point, depth.deepest.nearest_mm],
      deepest && [deepest.depth_mm, deepest.body, deepest.vertex, deepest.point_mm, deepest.nearest_distance_mm]);
    assert.deepEqual([depth.area_mm2.mobile, depth.area_mm2.fixed, depth.volume_mm3], [contact.mobile.area_mm2, contact.fixed.area_mm2, contact.volume_mm3]);
  }
}

test("a joint file dropped with its meshes on the page without a joint shows what condyle report shows", async (t) => {
  const { page, complaints, requests } = await openPage(browser, empty, { answers: false });
  const begun = performance.now();
  await drop(page, [sample("hip.toml"), ...meshes]);
  await shows(page, "^Right hip");
  t.diagnostic(`from drop to limits ${Math.round(performance.now() - begun)} ms`);
  const rom = answer("rom", sample("hip.toml"));
  await assertLimits(page, rom);
  await assertDepths(page, sample("hip.toml"), [[140, 0, 0], [100, -20, 30], [0, 0, 0]]);
  await keep(page, "dropped_joint_file");
  await openTab(page, "Details");
  const side = await page.locator("#side").textContent();
  for (const said of [`By condyle ${rom.provenance.version} in this page, from dropped files`, rom.provenance.joint_file.sha256, rom.provenance.fixed_mesh.sha256, rom.provenance.mobile_mesh.sha256])
    assert.ok(side.includes(said), said);
  assert.deepEqual([await alerts(page), complaints, requests], [[], [], []]);
  await page.context().close();
});

test("one press on the page without a joint opens the files of condyle sample hip, as if they were dropped", async () => {
  const path = join(reports, "empty.html");
  execFileSync(condyle, ["report", "--empty", "--out", path], { stdio: "ignore" });
  const { page, complaints, requests } = await openPage(browser, path, { answers: false });
  for (const name of ["hip.toml", "hip_bone.ply", "femur.ply"]) {
    const packed = await page.locator(`[data-sample="${name}"]`).textContent();
    assert.ok(inflateSync(Buffer.from(packed, "base64")).equals(readFileSync(sample(name))), name);
  }
  const begin = page.getByRole("button", { name: "Try it with a sample hip", exact: true });
  await begin.waitFor();
  await keep(page, "empty_sample");
  await begin.click();
  await shows(page, "^Right hip");
  await assertLimits(page, answer("rom", sample("hip.toml")));
  assert.deepEqual([await begin.count(), await alerts(page), complaints, requests], [0, [], [], []]);
  await page.context().close();
  // Without these files there is nothing to press.
  const other = await openPage(browser, empty, { answers: false });
  await other.page.getByText("This page holds no joint").waitFor();
  assert.equal(await other.page.getByRole("button", { name: /sample/ }).count(), 0);
  await other.page.context().close();
});

test("the parts of a dropped joint turn, with the command's limits, and a motion file plays on it", async () => {
  const { page, complaints } = await openPage(browser, empty, { answers: false, width: 1440, height: 900, reducedMotion: "reduce" });
  const mapping = readFileSync(sample("moves.toml"), "utf8"), joint = written("turned_moves.toml", `${readFileSync(sample("turned.toml"), "utf8")}\n${mapping.slice(mapping.indexOf("[recorded_motion]"))}`);
  for (const path of meshes) cpSync(path, join(folder, path.split("/").at(-1)));
  await drop(page, [joint, ...meshes]);
  await shows(page, "^Right hip");
  await assertLimits(page, answer("rom", joint));
  await assertDepths(page, joint, [[110, 0, 40]]);
  await openTab(page, "Plan");
  await page.locator("summary", { hasText: "Turn the parts" }).click();
  const region = page.getByRole("region", { name: "Turn the parts", exact: true });
  await type(region.getByRole("spinbutton", { name: "femur version, degrees", exact: true }), 10);
  await page.waitForFunction((element) => element.dataset.allAfter !== undefined, await region.elementHandle());
  await assertLimits(page, answer("rom", joint, "--set", "femur.version=10"));
  await drop(page, [sample("moves.csv")]);
  await page.getByRole("status").filter({ hasText: "The dropped file moves.csv plays on this joint: 3 frames. Contact over time" }).waitFor();
  await openTab(page, "Figures");
  await page.getByRole("slider", { name: "Frame", exact: true }).fill("2");
  await openTab(page, "Motion");
  assert.deepEqual([await angleOf(page, "flexion"), await angleOf(page, "internal_rotation")], [40, 10]);
  assert.deepEqual(complaints, []);
  await page.context().close();
});

test("a folder is dropped whole: its joint file finds meshes by their paths, and what lies beside them is left", async () => {
  const whole = join(folder, "whole");
  rmSync(whole, { recursive: true, force: true });
  for (const [from, to] of [[sample("hip.toml"), "joint/hip.toml"], [meshes[0], "bones/right/hip_bone.ply"], [meshes[1], "bones/right/femur.ply"], [meshes[0], "bones/left/femur.ply"], [meshes[1], "bones/left/hip_bone.ply"]])
    cpSync(from, join(whole, to));
  writeFileSync(join(whole, "joint/hip.toml"), readFileSync(sample("hip.toml"), "utf8").replaceAll(/mesh = "/g, 'mesh = "../bones/right/'));
  writeFileSync(join(whole, "readme.txt"), "nothing of a joint");
  const { page, complaints } = await openPage(browser, empty, { answers: false });
  await drop(page, [whole]);
  await shows(page, "^Right hip");
  await assertLimits(page, answer("rom", sample("hip.toml")));
  assert.deepEqual([await alerts(page), complaints], [[], []]);
  await page.context().close();
});

test("a mesh that lies elsewhere than the joint file says is taken by its name, and a line says so", async () => {
  const left = join(folder, "left");
  rmSync(left, { recursive: true, force: true });
  for (const path of meshes) cpSync(path, join(left, path.split("/").at(-1)));
  writeFileSync(join(left, "hip.toml"), readFileSync(sample("hip.toml"), "utf8").replace('mesh = "femur.ply"', 'mesh = "../right/femur.ply"'));
  const { page, complaints } = await openPage(browser, empty, { answers: false });
  await drop(page, [left]);
  await shows(page, "^Right hip");
  await page.getByText("left/femur.ply was taken for right/femur.ply, which was not dropped.").waitFor();
  assert.equal(await page.getByText("was taken for").count(), 1);
  await assertLimits(page, answer("rom", sample("hip.toml")));
  assert.deepEqual([await alerts(page), complaints], [[], []]);
  await page.context().close();
});

test("files that make no joint are refused in one line each, and the page takes another", async () => {
  const { page, complaints } = await openPage(browser, empty, { answers: false });
  const unknown = written("unknown.toml", readFileSync(sample("hip.toml"), "utf8").replace("side =", 'sied = "left"\nside ='));
  const lines = [
    [[sample("hip.toml"), meshes[0]], "hip.toml: mobile.mesh: femur.ply was not dropped beside it"],
    [[sample("hip.toml"), unknown, ...meshes], "Two joint files were dropped, hip.toml and unknown.toml: drop one with its meshes."],
    [[sample("hip.toml"), written("hip_bone.ply", readFileSync(meshes[0])), ...meshes], "Two files named hip_bone.ply were dropped: drop the folder that has both, so that their paths distinguish them."],
    [[sample("hip.toml"), ...meshes, written("hip_bone.ply", readFileSync(meshes[0]))], "hip_bone.ply and hip_bone (1).ply were dropped, which may be two files of one name: drop the folder that has both, or one of them."],
    [[unknown, ...meshes], /^unknown.toml: line \d+: .*sied: unknown key/],
    [[written("broken.toml", "condyle = = 1\n"), ...meshes], /^broken.toml: line 1: not TOML: /],
  ];
  let before = null;
  for (const [files, line] of lines) {
    // Two files of one name stay so in a choice; Chromium numbers the second one of a drag.
    if (line.startsWith?.("Two files")) await page.locator("#files").setInputFiles(files);
    else await drop(page, files);
    await page.waitForFunction((last) => ![null, undefined, last].includes(document.querySelector("[role=alert]")?.textContent), before);
    before = await page.getByRole("alert").textContent();
    if (typeof line === "string") assert.equal(before, line);
    else assert.match(before, line);
    assert.equal(await page.getByRole("alert").count(), 1);
    assert.equal(await page.locator("#files").count(), 1);
  }
  await page.locator("#files").setInputFiles([sample("hip.toml"), ...meshes]);
  await shows(page, "^Right hip");
  assert.deepEqual([await alerts(page), complaints], [[], []]);
  await page.context().close();
});

test("on a report a joint file takes its place once that is confirmed and its files are read; until then the report stays", async () => {
  const { page, complaints, requests } = await openPage(browser, join(reports, "sample.html"), { width: 1440, height: 900, fragment: "#flexion=40" });
  await settled(page);
  const heading = await page.locator("#title").textContent(), open = page.getByRole("button", { name: "Open in its place" });
  await drop(page, [sample("shifted.toml"), meshes[0]]);
  await open.click();
  await refused(page, "shifted.toml: mobile.mesh: femur.ply was not dropped beside it");
  assert.equal(await page.locator("#title").textContent(), heading);
  assert.equal(await angleOf(page, "flexion"), 40);
  assert.equal(await page.locator("#scene > canvas").count(), 1);
  await drop(page, [sample("shifted.toml"), ...meshes]);
  await open.click();
  await page.getByText("What is shown is no longer the report of this file").first().waitFor();
  await shows(page, "^Right hip");
  await assertLimits(page, answer("rom", sample("shifted.toml")));
  assert.equal(await angleOf(page, "flexion"), 0);
  assert.equal(await page.getByRole("button", { name: "Save copy" }).count(), 0);
  assert.equal(await page.locator("#scene > canvas").count(), 1);
  assert.match(await page.locator("#scope").textContent(), /no longer the report/);
  // Another takes the place of this one, and bare meshes after it.
  await drop(page, [sample("hip.toml"), ...meshes]);
  await open.click();
  await page.waitForFunction(() => document.querySelectorAll("#messages [role=status]").length === 1 && /no longer/.test(document.getElementById("messages").textContent));
  await assertLimits(page, answer("rom", sample("hip.toml")));
  await drop(page, meshes);
  await open.click();
  await shows(page, "femur.ply / hip_bone.ply");
  assert.deepEqual([complaints, requests], [[], []]);
  await page.reload();
  await page.waitForFunction((wanted) => document.getElementById("title").textContent === wanted, heading);
  await page.context().close();
});

test("a knee that is in contact says why it has no limits, and what of its file is for the command", { skip: !existsSync(join(data, "knee_lenhart2015_right")) && "the knee of the test data is not there" }, async () => {
  const { page, complaints } = await openPage(browser, empty, { answers: false });
  await drop(page, [join(root, "tests/support/knee_by_hand/tibiofemoral.toml"), ...["femur", "tibia"].map((bone) => join(data, "knee_lenhart2015_right", `${bone}_cartilage.ply`))]);
  await shows(page, "^Right knee");
  await page.getByText("Pressure by the table [contact] of the joint file is for condyle report --load.").waitFor();
  await openTab(page, "Details");
  assert.match(await page.locator("#side").textContent(), /in contact in the reference pose/);
  assert.deepEqual([await alerts(page), complaints], [[], []]);
  await page.context().close();
});

for (const [name, side, source] of [["vhf_right", "Right", "hip_vhf_right"], ["libhip_left", "Left", "hip_libhip_m1_left"]])
  test(`the real hip ${name} opens with the command's limits and depths`, { skip: !existsSync(join(reports, `${name}.toml`)) && "not made" }, async (t) => {
    const { page, complaints } = await openPage(browser, empty, { answers: false }), joint = join(reports, `${name}.toml`);
    const begun = performance.now();
    await drop(page, [joint, ...["hip_bone", "femur"].map((bone) => join(data, source, `${bone}.ply`))]);
    await shows(page, `^${side} hip`);
    t.diagnostic(`from drop to limits ${Math.round(performance.now() - begun)} ms`);
    await page.waitForFunction(() => Number(document.documentElement.dataset.answered) > 0);
    t.diagnostic(`to the first pose ${Math.round(performance.now() - begun)} ms`);
    await assertLimits(page, answer("rom", joint));
    await assertDepths(page, joint, [[130, 0, 30]]);
    assert.deepEqual([await alerts(page), complaints], [[], []]);
    await page.context().close();
  });

test("a shoulder with an implant, which is no hip, opens with the command's limits", async () => {
  const shoulder = join(folder, "shoulder"), joint = join(shoulder, "shoulder.toml");
  execFileSync(condyle, ["sample", "reverse-shoulder", "--facets", "72", "--out", shoulder], { stdio: "ignore" });
  const { page, complaints } = await openPage(browser, empty, { answers: false });
  await drop(page, [joint, ...["head", "pillar", "liner", "stem"].map((name) => join(shoulder, `${name}.ply`))]);
  await shows(page, "^Right shoulder");
  await assertLimits(page, answer("rom", joint));
  assert.deepEqual([await alerts(page), complaints], [[], []]);
  await page.context().close();
});
