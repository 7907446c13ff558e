// Holds the core compiled to WebAssembly against the same functions compiled natively, bit for bit:
//   page_core_answers FOLDER && node same_bits.mjs page_core.js FOLDER
// Angles and poses, which rest on the sine and arctangent of two C libraries, may differ by one unit in the last place; the point of
// a limit's contact, 100 mm from the centre and turned by such an angle, by some 100 of the 1e-14 mm it rounds to.
import { readFileSync } from "node:fs";
import { createRequire } from "node:module";
import { join, resolve } from "node:path";

const [modulePath, folder] = process.argv.slice(2);
const wasmBinary = readFileSync(modulePath.replace(/js$/, "wasm"));
const core = await createRequire(import.meta.url)(resolve(modulePath))({ wasmBinary });

const file = readFileSync(join(folder, "scene.bin"));
const bytes = file.buffer.slice(file.byteOffset, file.byteOffset + file.length);
const [nFixed, nMobile, nQuestions, , nFixedTriangles, nMobileTriangles] = new Int32Array(bytes, 0, 6);
let at = 24;
const doubles = (count) => new Float64Array(bytes, (at += 8 * count) - 8 * count, count);
const words = (count) => new Uint32Array(bytes, (at += 4 * count) - 4 * count, count);
const fixed = doubles(nFixed), mobile = doubles(nMobile), questions = doubles(nQuestions);
const fixedTriangles = words(nFixedTriangles), mobileTriangles = words(nMobileTriangles);

const copied = (array) => {
  const pointer = core._malloc(array.byteLength);
  new Uint8Array(core.HEAPU8.buffer).set(new Uint8Array(array.buffer, array.byteOffset, array.byteLength), pointer);
  return pointer;
};
const joint = core._condyle_joint(0, 0, 0, copied(fixed), nFixed / 3, copied(fixedTriangles), nFixedTriangles / 3,
  copied(mobile), nMobile / 3, copied(mobileTriangles), nMobileTriangles / 3);
if (!joint) throw new Error(core.UTF8ToString(core._condyle_error()));

const bits = (value) => {
  const view = new DataView(new ArrayBuffer(8));
  view.setFloat64(0, value);
  return view.getBigUint64(0).toString(16).padStart(16, "0");
};
const fromBits = (text) => {
  const view = new DataView(new ArrayBuffer(8));
  view.setBigUint64(0, BigInt("0x" + text));
  return view.getFloat64(0);
};
const f64 = (pointer, count) => new Float64Array(core.HEAPU8.buffer, pointer, count);
const u32 = (pointer, count) => new Uint32Array(core.HEAPU8.buffer, pointer, count);
const penetrations = (pose, ofFixed) => {
  const count = core._condyle_penetrations(joint, pose, ofFixed);
  if (count < 0) throw new Error(core.UTF8ToString(core._condyle_error()));
  const vertices = count ? u32(core._condyle_penetrating_vertices(joint), count) : [];
  const depths = count ? f64(core._condyle_depths(joint), count) : [];
  return [count, ...Array.from(vertices, (v, i) => `${v}:${bits(depths[i])}`)].join(" ");
};
const nextTo = (a, b) => {
  const ulp = Math.max(Math.abs(a), Number.MIN_VALUE) * 2 ** -52;
  return Object.is(a, b) || Math.abs(a - b) <= Math.max(ulp, 2 ** -53);
};

const posePointer = core._malloc(128), angles = core._malloc(24), translation = core._malloc(24), limit = core._malloc(56);
const lines = readFileSync(join(folder, "answers.txt"), "utf8").trimEnd().split("\n");
const wrong = [];
const count = { answers: 0, equalPoses: 0, poses: 0, equalLimits: 0, limits: 0, penetrating: 0 };
let question = 0;
for (const line of lines) {
  const [kind, ...fields] = line.split(" ");
  ++count.answers;
  let here = null;
  if (kind === "pose") {
    f64(angles, 3).set(questions.subarray(6 * question, 6 * question + 3));
    f64(translation, 3).set(questions.subarray(6 * question + 3, 6 * question + 6));
    ++question;
    core._condyle_pose(joint, angles, translation, posePointer);
    const native = fields.map(fromBits), page = Array.from(f64(posePointer, 16));
    ++count.poses;
    count.equalPoses += native.every((value, i) => Object.is(value, page[i]));
    if (!native.every((value, i) => nextTo(value, page[i]))) wrong.push(`pose ${question}: ${page} and not ${native}`);
    f64(posePointer, 16).set(native);  // what follows is asked of the same pose
    continue;
  }
  if (kind === "mobile" || kind === "fixed") here = penetrations(posePointer, kind === "fixed" ? 1 : 0);
  if (kind === "contact") here = `${core._condyle_in_contact(joint, posePointer)}`;
  if (kind === "pairs") {
    const pairs = core._condyle_pairs(joint, posePointer);
    here = pairs ? Array.from(u32(core._condyle_pair_triangles(joint), 2 * pairs)).join(" ") : "";
  }
  if (kind === "limit") {
    f64(angles, 3).set(fields.slice(2, 5).map(fromBits));
    const state = core._condyle_limit(joint, Number(fields[0]), Number(fields[1]), angles, fromBits(fields[5]), limit);
    if (state !== 0) throw new Error(core.UTF8ToString(core._condyle_error()));
    const native = fields.slice(6).map(fromBits), page = Array.from(f64(limit, 7));
    ++count.limits;
    count.equalLimits += native.every((value, i) => Object.is(value, page[i]));
    // The contact's point is turned by the limit's angle.
    const close = (value, i) => i < 4 ? nextTo(value, page[i]) : Object.is(value, page[i]) || Math.abs(value - page[i]) <= 1e-12;
    if (!native.every(close)) wrong.push(`limit ${line}: ${page} and not ${native}`);
    continue;
  }
  if (kind === "mobile" || kind === "fixed") count.penetrating += Number(fields[0]);
  if (here !== fields.join(" ")) wrong.push(`${kind} of pose ${question}: '${here.slice(0, 200)}' and not '${fields.join(" ").slice(0, 200)}'`);
}
console.log(`${count.answers} answers, ${count.penetrating} penetrating vertices, ${wrong.length} wrong; ` +
  `${count.equalPoses} of ${count.poses} poses and ${count.equalLimits} of ${count.limits} limits equal to the bit`);
for (const text of wrong.slice(0, 5)) console.error(text);
process.exit(wrong.length || count.penetrating === 0 || count.limits !== 12 || question !== 1000 ? 1 : 0);
