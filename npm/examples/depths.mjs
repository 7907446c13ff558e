// node depths.mjs JOINT.toml: how deep the bones of a hip are in each other along internal rotation at 90 degrees of flexion, as CSV.
import { depth, readJoint } from "condyle";

const joint = await readJoint(process.argv[2]);
console.log("internal_rotation_deg,in_contact,depth_mm,volume_mm3");
for (let internal_rotation = 0; internal_rotation <= 70; internal_rotation += 10) {
  const { inContact, deepest, volume_mm3 } = depth(joint, { flexion: 90, internal_rotation });
  console.log([internal_rotation, inContact, deepest?.depth_mm ?? "", volume_mm3 ?? ""].join(","));
}
