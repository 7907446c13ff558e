// Label maps in the page's core, outside of a page: the surfaces, places and limits of condyle init LABELS and condyle rom, bit for bit.
import assert from "node:assert/strict";
import { execFileSync } from "node:child_process";
import { readFileSync, rmSync, writeFileSync } from "node:fs";
import { basename, join } from "node:path";
import { test } from "node:test";
import { constants, gunzipSync, gzipSync } from "node:zlib";
import { reports, require, root } from "./browser.mjs";
import { openCore } from "./core_module.mjs";
import { makeLabelMaps } from "./label_maps.mjs";
import { readReport } from "./report_block.mjs";

const condyle = join(root, "build/release/condyle");
const files = makeLabelMaps(condyle, join(reports, "labels"), 2);
const { core, copied, f64, u32 } = await openCore(join(root, "build/page_core/page_core.js"), require("pako"));

const text = (words) => copied(new TextEncoder().encode(`${words}\0`));
const made = (answer) => {
  if (!answer) throw new Error(core.UTF8ToString(core._condyle_error()));
  return answer;
};
const readLabels = (name, bytes) => made(core._condyle_read_labels(text(name), copied(bytes), bytes.length));
const labelsIn = (path) => readLabels(basename(path), readFileSync(path));
const listed = (labels) => JSON.parse(core.UTF8ToString(made(core._condyle_labels(labels))));
const bone = (labels, label, task = "") => made(core._condyle_bone(labels, text(label), text(task)));
const meshOf = (joint, ofFixed) => {
  const vertexCount = core._condyle_vertex_count(joint, ofFixed), count = core._condyle_triangle_count(joint, ofFixed);
  const vertices = core._malloc(24 * vertexCount), triangles = core._malloc(12 * count);
  core._condyle_mesh(joint, ofFixed, vertices, triangles);
  return { vertices: f64(vertices, 3 * vertexCount).slice(), triangles: u32(triangles, 3 * count).slice() };
};

/// The command's results for the same labels: the arrays of its report, and the limits in it.
function commanded(name, ...words) {
  const folder = join(reports, "labels", name), joint = join(folder, "hip.toml"), report = join(folder, "report.html");
  rmSync(folder, { recursive: true, force: true });
  execFileSync(condyle, ["init", ...words, "--out", joint], { stdio: "ignore" });
  execFileSync(condyle, ["report", joint, "--out", report], { stdio: "ignore" });
  const rom = JSON.parse(execFileSync(condyle, ["rom", joint, "--json"], { stdio: ["ignore", "pipe", "ignore"] }));
  return { ...readReport(report), rom };
}

function compare(joint, { array, rom }) {
  for (const [body, ofFixed] of [["fixed", 1], ["mobile", 0]]) {
    const { vertices, triangles } = meshOf(joint, ofFixed);
    assert.deepEqual(vertices, array(`${body}_vertices`), `${body} vertices`);
    assert.deepEqual(triangles, array(`${body}_triangles`), `${body} triangles`);
  }
  const described = JSON.parse(core.UTF8ToString(made(core._condyle_description(joint))));
  const figures = ({ motions }) => motions.map((motion) => Object.fromEntries(
    ["name", "limit_deg", "reason", "contact_kind", "bearing_contact_deg", "contact_point_mm", "error_bound_deg", "at_limit_deg"]
      .map((key) => [key, motion[key]])));
  assert.equal(described.motions.length, 12);
  assert.deepEqual(figures(described), figures(rom));
  // By the arctangent of the C library, whose last bit is its own.
  rom.motions.forEach(({ clock_hour }, i) => assert.ok(Math.abs(described.motions[i].clock_hour - clock_hour) < 1e-12));
  return described;
}

test("two labels of every form of a label map: surfaces and limits to the bit", () => {
  const native = commanded("total", files.nifti, "--task", "total", "--fixed", "hip_right", "--mobile", "femur_right");
  for (const path of [files.nifti, files.raw, files.nrrd, files.metaimage]) {
    const labels = labelsIn(path), { labels: list, pairs } = listed(labels);
    assert.deepEqual(list.map(({ choice, name }) => [choice, name]), [["76", ""], ["78", ""]]);
    assert.ok(list.every(({ voxels }) => voxels > 20000));
    assert.deepEqual(pairs.map(({ side, task, fixed, mobile }) => [side, task, fixed.choice, mobile.choice]), [["right", "total", "78", "76"]]);
    const joint = made(core._condyle_join(bone(labels, "hip_right", "total"), bone(labels, "femur_right", "total"), -1));
    assert.equal(core._condyle_side(joint), 0);
    const { caveats } = compare(joint, native);
    assert.ok(caveats.includes("side: right, by the names of the labels"), caveats.join("\n"));
    core._condyle_free(joint);
  }
});

test("names of the file, masks of one bone and bare numbers: as the command", () => {
  const named = labelsIn(files.named);
  assert.deepEqual(listed(named).pairs.map(({ task, fixed }) => [task, fixed.label]), [[null, "hip_right"]]);
  compare(made(core._condyle_join(bone(named, "hip_right"), bone(named, "femur_right"), -1)),
    commanded("named", files.named, "--fixed", "hip_right", "--mobile", "femur_right"));

  const masks = [files.hipMask, files.femurMask].map(labelsIn).map((labels) => bone(labels, ""));
  assert.deepEqual(masks.map((mask) => core.UTF8ToString(core._condyle_bone_name(mask))), ["hip_right", "femur_right"]);
  compare(made(core._condyle_join(...masks, -1)), commanded("masks", files.hipMask, files.femurMask));

  const numbers = labelsIn(files.nifti);
  const { notes } = compare(made(core._condyle_join(bone(numbers, "78"), bone(numbers, "76"), 0)),
    commanded("numbers", files.nifti, "--fixed", "78", "--mobile", "76", "--side", "right"));
  assert.ok(notes.some(({ code }) => code === "label_tables"));
});

test("an oblique image that cuts the femur: surfaces, limits and the note", () => {
  const labels = labelsIn(files.oblique);
  const native = commanded("oblique", files.oblique, "--task", "total", "--fixed", "hip_right", "--mobile", "femur_right");
  const { notes } = compare(made(core._condyle_join(bone(labels, "hip_right", "total"), bone(labels, "femur_right", "total"), -1)), native);
  assert.ok(notes.some(({ code, text }) => code === "cut_by_view" && /^femur_right ends at the first voxels/.test(text)), JSON.stringify(notes));
});

/// The command's line, its path cut to the file's name.
function lineOf(...words) {
  try {
    execFileSync(condyle, words, { stdio: "pipe" });
  } catch (error) {
    return String(error.stderr).trim().replace("condyle: ", "").replaceAll(`${reports}/labels/`, "");
  }
  return "";
}

test("what is wrong is said in the command's line", () => {
  const whole = readFileSync(files.nifti), damaged = join(reports, "labels", "damaged.nii.gz");
  const wrong = [whole.subarray(0, whole.length >> 1), whole.subarray(0, 200), whole.subarray(0, whole.length - 3), Buffer.from("no image"), Buffer.alloc(0)];
  for (const place of [30, whole.length >> 1, whole.length - 6]) {
    const bytes = Buffer.from(whole);
    bytes[place] ^= 16;
    wrong.push(bytes);
  }
  for (const bytes of wrong) {
    writeFileSync(damaged, bytes);
    const said = lineOf("inspect", damaged);
    assert.match(said, /^damaged\.nii\.gz: /);
    assert.throws(() => readLabels("damaged.nii.gz", bytes), { message: said });
  }
  const labels = labelsIn(files.nifti), out = join(reports, "labels", "refused", "hip.toml");
  const init = (...words) => lineOf("init", files.nifti, ...words, "--out", out);
  assert.throws(() => bone(labels, "75"), { message: init("--fixed", "75", "--mobile", "76") });
  assert.throws(() => bone(labels, "femur"), { message: init("--fixed", "femur", "--mobile", "76") });
  assert.throws(() => core._condyle_join(bone(labels, "76"), bone(labels, "76"), -1) || made(0), { message: init("--fixed", "76", "--mobile", "76") });
  assert.throws(() => made(core._condyle_join(bone(labels, "hip_right", "total"), bone(labels, "femur_right", "total"), 1)),
    { message: init("--task", "total", "--fixed", "hip_right", "--mobile", "femur_right", "--side", "left") });
  // The bones lie as those of a right hip, and exchanged no head is found.
  assert.throws(() => made(core._condyle_join(bone(labels, "78"), bone(labels, "76"), 1)), /^Error: side: given it is left, and the bones lie as those of a right hip/);
  assert.throws(() => made(core._condyle_join(bone(labels, "76"), bone(labels, "78"), -1)), /head|side/);
});

/// A label map of 4,000 voxels with these values.
function niftiOf(valueAt) {
  const bytes = Buffer.from(gunzipSync(readFileSync(files.nifti)).subarray(0, 352 + 4000));
  [20, 20, 10].forEach((size, i) => bytes.writeInt16LE(size, 42 + 2 * i));
  for (let i = 0; i < 4000; ++i) bytes[352 + i] = valueAt(i);
  return bytes;
}

test("what zlib inflates the core inflates, and what it refuses the core refuses", () => {
  // Numbers of a linear congruential generator: the same in every run.
  let state = 1;
  const random = (below) => Math.floor(((state = (Math.imul(state, 1664525) + 1013904223) >>> 0) / 2 ** 32) * below);
  const { Z_DEFAULT_STRATEGY, Z_FILTERED, Z_HUFFMAN_ONLY, Z_RLE, Z_FIXED } = constants;
  const maps = [() => random(256), () => 7, (i) => (i >> 4) % 5, (i) => (random(9) ? 0 : i & 3), () => 1 + random(2)].map(niftiOf);
  let whole = 0, damaged = 0, refused = 0;
  for (const map of maps) {
    const expected = listed(readLabels("map.nii", map)).labels;
    for (const level of [0, 1, 6, 9])
      for (const strategy of [Z_DEFAULT_STRATEGY, Z_FILTERED, Z_HUFFMAN_ONLY, Z_RLE, Z_FIXED]) {
        const packed = gzipSync(map, { level, strategy });
        const cut = 1 + random(map.length - 1), members = [map.subarray(0, cut), map.subarray(cut)].map((part) => gzipSync(part, { level, strategy }));
        for (const bytes of [packed, Buffer.concat(members), Buffer.concat([packed, Buffer.from("behind it")])]) {
          assert.deepEqual(listed(readLabels("map.nii.gz", bytes)).labels, expected);
          ++whole;
        }
        for (let i = 0; i < 20; ++i) {
          const bytes = Buffer.from(packed), at = 2 + random(bytes.length - 2);
          bytes[at] ^= 1 << random(8);
          const isCut = random(4) === 0, given = isCut ? bytes.subarray(0, at) : bytes;
          let isWhole = true;
          try {
            gunzipSync(given);
          } catch {
            isWhole = false;
          }
          ++damaged;
          if (isWhole) assert.deepEqual(listed(readLabels("map.nii.gz", given)).labels, expected);
          else assert.throws(() => readLabels("map.nii.gz", given), /^Error: map\.nii\.gz: /), ++refused;
        }
      }
  }
  assert.equal(whole, 300);
  assert.ok(refused > 0.9 * damaged && refused < damaged, `${refused} of ${damaged}`);
});
