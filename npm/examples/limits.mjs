// node limits.mjs JOINT.toml: where the motions of a joint end, and what ends them.
import { rangeOfMotion, readJoint } from "condyle";

const joint = await readJoint(process.argv[2]);
const limits = rangeOfMotion(joint);
console.log(`${joint.name}, ${joint.side}`);
for (const { name, limit_deg, reason } of limits.motions) console.log(`${name}: ${reason === "contact" ? "" : "over "}${limit_deg.toFixed(2)} degrees`);
for (const { code, text } of limits.notes) console.error(`note: ${code}: ${text}`);
