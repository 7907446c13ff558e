// Joint files read by the core outside of a page, as a page reads those that are dropped on it.
import { readFileSync } from "node:fs";
import { createRequire } from "node:module";
import { basename, join } from "node:path";
import { root } from "./browser.mjs";
import { openCore } from "./core_module.mjs";

const pako = createRequire(join(root, "viewer/package.json"))("pako");
// Each module listens to the process.
process.setMaxListeners(0);

/// The block of a joint file, as it is in a report before compression. `files`: paths in the drop, and where they are. Throws the core's line.
export async function droppedJoint(joint, files, jointPath = basename(joint)) {
  const { core, copied } = await openCore(join(root, "build/page_core/page_core.js"), pako);
  const failure = () => new Error(core.UTF8ToString(core._condyle_error()));
  const text = (said) => copied(Buffer.from(`${said}\0`)), bytesAt = (path) => {
    const bytes = readFileSync(path);
    return [copied(bytes), bytes.length];
  };
  for (const path of Object.keys(files)) core._condyle_drop_file(text(path));
  const listed = core._condyle_joint_meshes(text(jointPath), ...bytesAt(joint));
  if (!listed) throw failure();
  for (const path of JSON.parse(core.UTF8ToString(listed))) core._condyle_fill_file(text(path), ...bytesAt(files[path]));
  const at = core._condyle_joint_block();
  if (!at) throw failure();
  return Buffer.from(core.HEAPU8.slice(at, at + core._condyle_joint_block_bytes()));
}
