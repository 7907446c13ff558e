// Usage: node mujoco.mjs CONDYLE, where the npm package mujoco-js is installed. Limits that `condyle rom --write-limits X.xml` writes, taken in by
// MuJoCo itself: at zero, at each stop and in a pose of all angles its bodies lie where Condyle's formulas (docs/joint-frame.md) put them.
import { execFileSync } from "node:child_process";
import { mkdtempSync, readFileSync, writeFileSync } from "node:fs";
import { tmpdir } from "node:os";
import { join } from "node:path";
import load from "mujoco-js";

const condyle = process.argv[2], folder = mkdtempSync(join(tmpdir(), "mujoco-")), mujoco = await load();
const run = (...words) => execFileSync(condyle, words, { cwd: folder, encoding: "utf8", stdio: ["ignore", "pipe", "ignore"] });
const product = (a, b) => a.map((row, i) => row.map((_, k) => row.reduce((sum, _, j) => sum + a[i][j] * b[j][k], 0)));
const about = (axis, degrees) => {
  const c = Math.cos(degrees * Math.PI / 180), s = Math.sin(degrees * Math.PI / 180), X = [0, 1, 2, 3].map((i) => [0, 1, 2, 3].map((k) => +(i === k)));
  const [i, k] = [(axis + 1) % 3, (axis + 2) % 3];
  [X[i][i], X[i][k], X[k][i], X[k][k]] = [c, -s, s, c];
  return X;
};
const inverse = (X) => X.map((row, i) => i === 3 ? row : [0, 1, 2].map((k) => X[k][i]).concat(-[0, 1, 2].reduce((sum, k) => sum + X[k][i] * X[k][3], 0)));
const names = { hip: ["flexion", "adduction", "internal_rotation"], knee: ["flexion"], ankle: ["dorsiflexion"] };
let worst_deg = 0, worst_mm = 0, poses = 0;
for (const side of ["right", "left"])
  for (const [joint, angles] of Object.entries(names))
    for (const unit of ["degree", "radian"]) {
      run("sample", "hip", "--side", side, "--out", side);
      // The femur in a frame of its own, 50, -30, 20 mm off.
      const ply = readFileSync(join(folder, side, "femur.ply")), begin = ply.indexOf("end_header\n") + 11, count = +ply.toString("latin1").match(/vertex (\d+)/)[1];
      for (let i = 0; i < 3 * count; ++i) ply.writeDoubleLE(ply.readDoubleLE(begin + 8 * i) + [50, -30, 20][i % 3], begin + 8 * i);
      writeFileSync(join(folder, side, "femur.ply"), ply);
      writeFileSync(join(folder, side, "joint.toml"), readFileSync(join(folder, side, "hip.toml"), "utf8")
        .replace(/kind = .*/, joint === "hip" ? "$&" : `kind = "hinge"\njoint = "${joint}"`).replace(/mesh = "femur.ply"/, "$&\npose = { translation = [-50, 30, -20] }")
        .replace(/anterior = .*/, "anterior = [0.8, 0.36, -0.48]").replace(/superior = .*/, "superior = [0, 0.8, 0.6]").replace(/\[reference_pose\].*/, `$&\n${angles[0]} = 4`));
      const said = JSON.parse(run("rom", `${side}/joint.toml`, "--accept-reference-contact", "--json", "--write-limits", `${side}/limits.xml`, "--angle-unit", unit));
      const ends = said.written_limits.coordinates, sign = side === "left" ? -1 : 1, flexes = joint === "knee" ? -1 : 1;
      const from = said.provenance, F_A = from.fixed_mesh.joint_from_source, M_B = from.mobile_mesh.joint_from_source;
      const xml = readFileSync(join(folder, side, "limits.xml"), "utf8"), [, place] = xml.match(/at (pos=.*quat="[^"]*")/);
      mujoco.FS.writeFile("limits.xml", xml);
      mujoco.FS.writeFile("model.xml", `<mujoco><compiler angle="${unit}"/><worldbody><body ${place}><include file="limits.xml"/><geom type="sphere" size="0.01"/></body></worldbody></mujoco>`);
      const model = mujoco.MjModel.loadFromXML("model.xml"), data = new mujoco.MjData(model), scale = Math.PI / 180;
      const stops = ends.flatMap((end, i) => [model.jnt_range[2 * i], model.jnt_range[2 * i + 1]].map((q) => ends.map((_, k) => k === i ? q / scale : 0)));
      for (const [i, end] of ends.entries())
        for (const [k, which] of ["lower", "upper"].entries()) worst_deg = Math.max(worst_deg, Math.abs(model.jnt_range[2 * i + k] / scale - end[which].limit_deg));
      for (const q of [ends.map(() => 0), ...stops, [20, -10, 15].slice(0, ends.length)]) {
        q.forEach((value, i) => { data.qpos[i] = value * scale; });
        mujoco.mj_kinematics(model, data);
        const X_FM = [[2, flexes * q[0]], [0, sign * (q[1] ?? 0)], [1, sign * (q[2] ?? 0)]].map(([axis, degrees]) => about(axis, degrees)).reduce(product);
        const X = product(product(inverse(F_A), X_FM), M_B);
        const trace = [0, 1, 2].reduce((sum, i) => sum + [0, 1, 2].reduce((of, k) => of + X[i][k] * data.xmat[9 + 3 * i + k], 0), 0);
        worst_deg = Math.max(worst_deg, Math.acos(Math.min(1, (trace - 1) / 2)) / scale);
        worst_mm = Math.max(worst_mm, ...[0, 1, 2].map((i) => Math.abs(X[i][3] - 1000 * data.xpos[3 + i])));
        ++poses;
      }
      data.delete(), model.delete();
    }
console.log(`${poses} poses: MuJoCo is off by at most ${worst_deg.toExponential(1)} degrees and ${worst_mm.toExponential(1)} mm`);
process.exit(worst_deg < 0.1 && worst_mm < 0.01 ? 0 : 1);
