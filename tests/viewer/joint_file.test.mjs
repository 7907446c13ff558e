// Joint files dropped on a page with their meshes: the blocks of condyle report, and its lines for bad files.
import assert from "node:assert/strict";
import { execFileSync } from "node:child_process";
import { existsSync, mkdirSync, readFileSync, writeFileSync } from "node:fs";
import { basename, join } from "node:path";
import { test } from "node:test";
import { reports, root } from "./browser.mjs";
import { droppedJoint } from "./dropped_core.mjs";
import { readBlock, readReport } from "./report_block.mjs";

const condyle = join(root, "build/release/condyle");
const data = process.env.CONDYLE_DATA ?? join(root, "../shared/data");
const folder = join(reports, "joint_files");
mkdirSync(folder, { recursive: true });
const run = (...words) => execFileSync(condyle, words, { stdio: ["ignore", "pipe", "pipe"], env: { ...process.env, CONDYLE_DATA: data } });

function written(name, text) {
  writeFileSync(join(folder, name), text);
  return join(folder, name);
}

/// By their names in the drop.
const named = (paths) => Object.fromEntries(paths.map((path) => [basename(path), path]));
const sample = (name) => join(reports, "sample", name);
const sampleFiles = [sample("hip_bone.ply"), sample("femur.ply")];

/// What both blocks have; the command and the poses for pages without a core are of the report only.
function common({ text, array }) {
  const { arrays, poses, only_in_reports, taken_by_name, ...rest } = structuredClone(text);
  if (rest.rom) rest.rom.provenance.command = [];
  const names = Object.keys(arrays).filter((name) => !name.startsWith("pose_"));
  return { rest, names: names.sort(), bytes: Object.fromEntries(names.map((name) => [name, Buffer.from(array(name).buffer)])) };
}

/// Numbers beside the limits whose last bits are those of the C library's functions: points, distances, hours, fitted spheres and closed forms, of lengths and
/// coordinates below 64 mm and angles below 1 rad.
const nearly = /^(clock_hour|joint_space_mm|rim_gap_mm|centre_distance_mm|(bearing_|soft_)?contact_point(_mobile)?_mm|closed_form|between_axes_deg|femur_deg|bearing)$/, rounding = 8 * 64 * Number.EPSILON;

/// The paths at which two JSON values differ.
function differences(here, of, path = "", isNear = false) {
  if (Object.is(here, of) || (isNear && Math.abs(here - of) <= rounding)) return [];
  if (typeof here !== "object" || here === null || typeof of !== "object" || of === null) return [`${path}: ${here} and ${of}`];
  const keys = new Set([...Object.keys(here), ...Object.keys(of)]);
  return [...keys].flatMap((key) => differences(here[key], of[key], `${path}.${key}`, isNear || nearly.test(key)));
}

/// The block that the page makes is the report's, number by number and array by array.
async function assertReported(joint, files, jointPath = undefined) {
  const page = join(folder, "made.html");
  run("report", joint, "--out", page);
  const dropped = readBlock(await droppedJoint(joint, files, jointPath)), of = common(readReport(page)), here = common(dropped);
  assert.deepEqual(differences(here.rest, of.rest), []);
  assert.deepEqual(here.names, of.names);
  for (const name of of.names) assert.ok(here.bytes[name].equals(of.bytes[name]), name);
  return dropped.text;
}

const placed = ["fixed_bone", "liner", "mobile_bone", "head", "neck", "stem"].map((name) => join(reports, "placed", `${name}.ply`));

test("a hip and hips with parts, a bearing mesh and a recorded motion are those of condyle report to the bit", async () => {
  const { rom, joint, only_in_reports } = await assertReported(sample("hip.toml"), named(sampleFiles));
  assert.deepEqual([rom.motions.length, joint.anatomy, only_in_reports], [12, "hip", []]);
  assert.equal((await assertReported(sample("tilts.toml"), named(sampleFiles))).posed.parts[0].name, "pelvis");
  assert.equal((await assertReported(sample("turned.toml"), named(sampleFiles))).posed.parts[1].parameters.length, 2);
  const cartilage = join(reports, "cartilages/femoral_cartilage.ply");
  assert.equal((await assertReported(sample("parts.toml"), named([...sampleFiles, cartilage]))).parts.mobile[1].contact, "bearing");
  assert.equal((await assertReported(sample("moves.toml"), named(sampleFiles))).recorded_motion.by, "columns");
  assert.equal((await assertReported(join(reports, "placed/hip.toml"), named(placed))).rom.implant.fixed_part, "liner");
});

test("clinical ranges, motions, units, scales, poses and repairs of the joint file count", async () => {
  const joint = written("all.toml", readFileSync(sample("hip.toml"), "utf8")
    .replace('mesh = "hip_bone.ply"', 'mesh = "hip_bone.ply"\nrepair = ["weld"]\nscale = [1, 1, 1.01]').replace('mesh = "femur.ply"', 'mesh = "femur.ply"\npose = { flexion = 5, adduction = 2, translation = [0.5, -1, 0.25] }')
    .replace(/^\[reference_pose\].*$/m, "[reference_pose]\nflexion = -3") +
    '\n[[motion]]\nname = "squat"\nvary = "internal_rotation"\nrange = [0, 60]\nflexion = 100\n[uncertainty]\ncentre = 1\n');
  for (const path of sampleFiles) written(basename(path), readFileSync(path));
  const { rom, reference_deg } = await assertReported(joint, named(sampleFiles));
  assert.equal(rom.motions.at(-1).name, "squat");
  const oblique = readFileSync(sample("hip.toml"), "utf8").replace('units = "mm"', 'units = "m"').replaceAll(/mesh = "(.*)"/g, 'mesh = "$1"\nscale = [0.001, 0.001, 0.001]')
    .replace(/^anterior = .*/m, "anterior = [0.64, 0.48, -0.6]").replace(/^superior = .*/m, "superior = [-0.6, 0.8, 0]").replace(/^centre = .*/m, 'centre = "fit"');
  assert.match((await assertReported(written("oblique.toml", oblique), named(sampleFiles))).rom.notes.map(({ code }) => code).join(), /./);
  assert.deepEqual(reference_deg, [-3, 0, 0]);
});

test("a shoulder with an implant, a knee held at a translation and one in contact are no hips, and as reported", async (t) => {
  const shoulder = join(folder, "shoulder");
  run("sample", "reverse-shoulder", "--facets", "72", "--out", shoulder);
  const meshes = [...readFileSync(join(shoulder, "shoulder.toml"), "utf8").matchAll(/mesh = "(.*?)"/g)].map(([, name]) => join(shoulder, name));
  assert.equal((await assertReported(join(shoulder, "shoulder.toml"), named(meshes))).joint.anatomy, "shoulder");

  const knee = join(root, "tests/support/knee_by_hand/tibiofemoral.toml"), text = readFileSync(knee, "utf8");
  if (!existsSync(join(data, "knee_lenhart2015_right"))) return t.skip("the knee of the test data is not there");
  const cartilages = named(["femur", "tibia"].map((bone) => join(data, "knee_lenhart2015_right", `${bone}_cartilage.ply`)));
  const touching = await assertReported(knee, cartilages);
  assert.match(touching.rom_error, /in contact in the reference pose/);
  assert.deepEqual(touching.only_in_reports, ["contact"]);
  const apart = await assertReported(written("apart.toml", text.replace('tibia_cartilage.ply"', 'tibia_cartilage.ply"\npose = { translation = [0, -15, 0] }')), cartilages);
  assert.deepEqual([apart.rom.held_translation_mm, apart.joint.kind, apart.joint.anatomy], [[0, 0, 0], "free", "knee"]);
});

for (const [name, source] of [["libhip_left", "hip_libhip_m1_left"], ["vhf_right", "hip_vhf_right"]])
  test(`the real hip ${name} is as reported`, { skip: !existsSync(join(reports, `${name}.toml`)) && "not made" }, async () => {
    const { joint } = await assertReported(join(reports, `${name}.toml`), named(["hip_bone", "femur"].map((bone) => join(data, source, `${bone}.ply`))));
    assert.equal(joint.side, name.split("_")[1]);
  });

test("meshes are found by their paths in a folder, else by their names, and two of a name are both named", async () => {
  const cartilage = join(reports, "cartilages/femoral_cartilage.ply"), joint = sample("parts.toml");
  const there = { "a/sample/hip_bone.ply": sampleFiles[0], "a/sample/femur.ply": sampleFiles[1], "a/cartilages/femoral_cartilage.ply": cartilage };
  // Others of these names are not meant.
  const others = { "a/femur.ply": cartilage, "a/sample/other/hip_bone.ply": cartilage };
  await assertReported(joint, { ...there, ...others }, "a/sample/parts.toml");
  const refused = (files, path, line) => assert.rejects(droppedJoint(joint, files, path), new Error(line));
  await refused({ "a/sample/hip_bone.ply": sampleFiles[0], "a/one/femur.ply": cartilage, "a/two/femur.ply": cartilage, "a/femoral_cartilage.ply": cartilage },
    "a/sample/parts.toml", "a/sample/parts.toml: mobile.meshes[0].mesh: femur.ply may be a/one/femur.ply or a/two/femur.ply, which were dropped both");
  await refused(named(sampleFiles), undefined, "parts.toml: mobile.meshes[1].mesh: femoral_cartilage.ply was not dropped beside it");
  await refused({}, undefined, "parts.toml: fixed.mesh: hip_bone.ply was not dropped beside it");
});

test("bad joint files and bad meshes are refused with the command's line", async () => {
  const text = readFileSync(sample("hip.toml"), "utf8"), half = readFileSync(sampleFiles[1]).subarray(0, 5000);
  for (const path of sampleFiles) written(basename(path), readFileSync(path));
  written("cut.ply", half);
  written("ball.ply", readFileSync(join(reports, "placed/head.ply")));
  const bad = {
    "broken.toml": "condyle = 1\nname = \"a\nkind = 3\n", "empty.toml": "", "model.toml": "<?xml version=\"1.0\"?>\n<OpenSimDocument/>",
    "deep.toml": `a = ${"[".repeat(40)}${"]".repeat(40)}\n`, "key.toml": text.replace("[frame]", "sied = \"left\"\n[frame]"),
    "later.toml": text.replace("condyle = 1", "condyle = 99"), "kind.toml": text.replace('"ball"', '"bal"'), "number.toml": text.replace(/^centre = .*/m, "centre = [0, 0]"),
    "cut.toml": text.replace("femur.ply", "cut.ply"), "ending.toml": text.replace("femur.ply", "femur.xyz"),
    "fit.toml": text.replace(/^centre = .*/m, 'centre = "fit"').replace("femur.ply", "hip_bone.ply"), "parallel.toml": text.replace(/^superior = .*/m, "superior = [1, 0, 0]"),
    "part.toml": `${text}\n[[part]]\nname = "pelvis"\nbody = "fixed"\nmeshes = ["ilium"]\n`,
  };
  written("femur.xyz", "1 2 3\n");
  const files = Object.fromEntries(["hip_bone.ply", "femur.ply", "cut.ply", "femur.xyz"].map((name) => [name, join(folder, name)]));
  let count = 0;
  for (const [name, content] of Object.entries(bad)) {
    const path = written(name, content);
    let line = "";
    try {
      run("report", path, "--out", join(folder, "none.html"));
    } catch (error) {
      line = String(error.stderr).trim().split("\n").at(-1).replace("condyle: ", "").replaceAll(`${folder}/`, "");
    }
    assert.ok(line, `${name} is taken`);
    await assert.rejects(droppedJoint(path, files), new Error(line));
    ++count;
  }
  assert.equal(count, 13);
});
