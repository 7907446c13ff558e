// Holds the core compiled to WebAssembly against the same functions compiled natively, bit for bit:
//   page_core_answers --sample FOLDER && node same_bits.mjs page_core.js FOLDER
import { readFileSync } from "node:fs";
import { join } from "node:path";
import { bits, fromBits, readAnswers, readScene } from "./answers.mjs";
import { openCore } from "./core_module.mjs";

const [modulePath, folder] = process.argv.slice(2);
const { core, copied, checked, f64, u32, jointOf } = await openCore(modulePath);
const { fixed, mobile, questions, fixedTriangles, mobileTriangles } = readScene(join(folder, "scene.bin"));
const shownNatively = readFileSync(join(folder, "shown.bin"));

const vertexCount = [mobile.length / 3, fixed.length / 3], triangleCount = [mobileTriangles.length / 3, fixedTriangles.length / 3];
const joint = jointOf({ fixed, fixedTriangles, mobile, mobileTriangles });
for (const ofFixed of [0, 1])
  checked(core._condyle_surface(joint, ofFixed, 0, vertexCount[ofFixed], 0, triangleCount[ofFixed], 10, 0.45,
    copied(new Float64Array(vertexCount[ofFixed]).fill(2))));
checked(core._condyle_elastic(joint, 2, 0, 1, 20));

const penetrations = (ofFixed) => {
  const count = checked(core._condyle_penetrations(joint, pose, ofFixed));
  const vertices = count ? u32(core._condyle_penetrating_vertices(joint), count) : [];
  const depths = count ? f64(core._condyle_depths(joint), count) : [];
  return [count, ...Array.from(vertices, (v, i) => `${v}:${bits(depths[i])}`)].join(" ");
};
const equal = (native, page) => native.length === page.length && native.every((value, i) => Object.is(value, page[i]));

const pose = core._malloc(128), before = core._malloc(128), angles = core._malloc(24), translation = core._malloc(24), limit = core._malloc(64), depth = core._malloc(128);
const values = core._malloc(4 * Math.max(...vertexCount)), marks = core._malloc(Math.max(...vertexCount));
const wrong = [], states = new Set();
const count = {
  answers: 0, poses: 0, depths: 0, screws: 0, limits: 0, penetrating: 0, shown: 0, coloured: 0, mapPoints: 0, intervals: 0,
};
let shownAt = 0;

/// Values of all vertices at the pose, against the next bytes of the native answers.
function compareShown() {
  for (let quantity = 0; quantity <= 3; ++quantity)
    for (const ofFixed of [0, 1]) {
      checked(quantity === 3 ? core._condyle_pressure(joint, pose, ofFixed, values, marks)
        : core._condyle_shown(joint, pose, quantity, ofFixed, values, marks));
      const n = vertexCount[ofFixed];
      for (const [pointer, bytes] of [[values, 4 * n], [marks, n]]) {
        const here = Buffer.from(core.HEAPU8.subarray(pointer, pointer + bytes));
        if (!here.equals(shownNatively.subarray(shownAt, shownAt + bytes)))
          wrong.push(`pose ${count.poses}: what ${ofFixed ? "fixed" : "mobile"} vertices show, quantity ${quantity}`);
        shownAt += bytes;
      }
      ++count.shown;
      if (quantity === 3) count.coloured += core.HEAPU8.subarray(marks, marks + n).reduce((sum, mark) => sum + mark, 0);
    }
}

const answerers = {
  pose(fields) {
    const at = 6 * count.poses;
    f64(before, 16).set(count.poses ? f64(pose, 16) : [1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1]);
    f64(angles, 3).set(questions.subarray(at, at + 3));
    f64(translation, 3).set(questions.subarray(at + 3, at + 6));
    checked(core._condyle_pose(joint, angles, translation, pose));
    const native = fields.map(fromBits), page = Array.from(f64(pose, 16));
    if (!equal(native, page)) wrong.push(`pose ${count.poses}: ${page} and not ${native}`);
    if (count.poses % 50 === 0) compareShown();
    ++count.poses;
  },
  mobile(fields) {
    count.penetrating += Number(fields[0]);
    return penetrations(0);
  },
  fixed(fields) {
    count.penetrating += Number(fields[0]);
    return penetrations(1);
  },
  // Depth at the last pose; its angles are where they were.
  depth() {
    checked(core._condyle_depth(joint, pose, angles, depth));
    ++count.depths;
    return Array.from(f64(depth, 16), (value) => (Number.isNaN(value) ? "none" : bits(value))).join(" ");
  },
  screw() {
    checked(core._condyle_screw(joint, before, pose, depth));
    ++count.screws;
    return Array.from(f64(depth, 9), (value) => (Number.isNaN(value) ? "none" : bits(value))).join(" ");
  },
  // Distances are rounded to 1e-12 of coordinates, which are below 1,000 mm; of triangles that share the nearest point any is named.
  nearest(fields) {
    const native = fields.map(fromBits), page = [0, 1].flatMap((counted) => {
      checked(core._condyle_nearest(joint, pose, counted, depth));
      return Array.from(f64(depth, 7));
    });
    if (!native.every((value, i) => [1, 2, 3].includes(i % 7) || Math.abs(value - page[i]) <= 1e-9)) wrong.push(`nearest of pose ${count.poses}: ${page} and not ${native}`);
  },
  standing() {
    checked(core._condyle_standing(joint, angles, translation, depth));
    const said = Array.from(f64(depth, 4));
    states.add(said[0]);
    return said.join(" ");
  },
  contact: () => `${checked(core._condyle_in_contact(joint, pose))}`,
  pairs() {
    const pairs = checked(core._condyle_pairs(joint, pose));
    return Array.from(pairs ? u32(core._condyle_pair_triangles(joint), 2 * pairs) : []).join(" ");
  },
  limit(fields) {
    f64(angles, 3).set(fields.slice(2, 5).map(fromBits));
    f64(translation, 3).fill(0);
    checked(core._condyle_limit(joint, Number(fields[0]), Number(fields[1]), angles, translation, fromBits(fields[5]), limit));
    const native = fields.slice(6).map(fromBits), page = Array.from(f64(limit, 8));
    ++count.limits;
    if (!equal(native, page)) wrong.push(`limit ${fields}: ${page} and not ${native}`);
  },
  free(fields) {
    f64(angles, 3).set([Number(fields[0]), Number(fields[1]), 0]);
    f64(translation, 3).fill(0);
    const found = checked(core._condyle_free_angles(joint, 2, angles, translation, 180, 180));
    const native = fields.slice(2).map(fromBits), page = Array.from(found ? f64(core._condyle_intervals(joint), 4 * found) : []);
    ++count.mapPoints;
    count.intervals += found;
    if (!equal(native, page))
      wrong.push(`free ${fields.slice(0, 2)}: ${page} and not ${native}`);
  },
};

for (const [kind, ...fields] of readAnswers(join(folder, "answers.txt"))) {
  ++count.answers;
  const here = answerers[kind](fields);
  if (here !== undefined && here !== fields.join(" "))
    wrong.push(`${kind} of pose ${count.poses}: '${here.slice(0, 200)}' and not '${fields.join(" ").slice(0, 200)}'`);
}
console.log(`${count.answers} answers, ${count.penetrating} penetrating vertices, ${count.shown} surfaces shown, ${count.coloured} ` +
  `vertices under pressure, ${count.mapPoints} points of a map with ${count.intervals} intervals, ` +
  `${count.poses} poses, ${count.limits} limits: ${wrong.length} wrong`);
for (const text of wrong.slice(0, 5)) console.error(text);
const complete = count.penetrating > 0 && count.coloured > 0 && count.limits === 12 && count.poses === 1000 && count.depths === 100 && count.screws === 100 && count.mapPoints === 120 && states.size >= 2 &&
  shownAt === shownNatively.length;
process.exit(wrong.length || !complete ? 1 : 0);
