// Times the core of the page alone, without a browser: node bench/page_core_speed.mjs build/page_core/page_core.js REPORT.html
// It reports the mean over poses of the shortest time of each, in milliseconds: the time of an undisturbed answer.
import { openCore } from "../tests/viewer/core_module.mjs";
import { readReport } from "../tests/viewer/report_block.mjs";

const [modulePath, path] = process.argv.slice(2);
const { core, checked, f64, jointOf } = await openCore(modulePath);
const { array } = readReport(path);
const fixed = array("fixed_vertices"), mobile = array("mobile_vertices");
const joint = jointOf({ fixed, mobile, fixedTriangles: array("fixed_triangles"), mobileTriangles: array("mobile_triangles") });
const most = Math.max(fixed.length, mobile.length) / 3;
const pose = core._malloc(128), angles = core._malloc(24), translation = core._malloc(24);
const values = core._malloc(4 * most), marks = core._malloc(most);
f64(translation, 3).fill(0);

const poses = 40, seconds = 3;
const mean = (i) => [3 * i, (3 * i % 40) - 20, (3 * i % 60) - 30], deep = (i) => [100 + (i % 11), 15, 30 + (i % 10)];
const both = (question) => () => [0, 1].forEach((ofFixed) => checked(question(ofFixed)));
const penetrations = both((ofFixed) => core._condyle_penetrations(joint, pose, ofFixed));
const contact = () => checked(core._condyle_in_contact(joint, pose)) && checked(core._condyle_pairs(joint, pose));
const shown = (quantity) => both((ofFixed) => core._condyle_shown(joint, pose, quantity, ofFixed, values, marks));
const withContact = () => (penetrations(), contact());

for (const [what, anglesOf, question] of [
  ["vertices inside of both bodies, mean poses", mean, penetrations],
  ["vertices inside of both bodies, deep poses", deep, penetrations],
  ["the same with contact and pairs, mean poses", mean, withContact],
  ["the same with contact and pairs, deep poses", deep, withContact],
  ["gap of every vertex of both bodies", mean, shown(0)],
  ["depth of every vertex of both bodies", mean, shown(1)],
]) {
  const least = new Array(poses).fill(Infinity), end = performance.now() + 1000 * seconds;
  for (let i = 0; performance.now() < end; i = (i + 1) % poses) {
    f64(angles, 3).set(anglesOf(i));
    checked(core._condyle_pose(joint, angles, translation, pose));
    const begun = performance.now();
    question();
    least[i] = Math.min(least[i], performance.now() - begun);
  }
  console.log(`${what}: ${(least.reduce((sum, one) => sum + one) / poses).toFixed(3)} ms`);
}
