import { Memory } from "./joint";
import { openModule } from "./module";
import type { NamedFile } from "./protocol";

/// The block of a joint, as a report has it, of a dropped joint file and of what was dropped with it. Throws the core's own line. Only the
/// meshes that the joint file names are read.
export async function blockOfJoint(wasm: ArrayBuffer, joint: NamedFile, files: readonly NamedFile[]): Promise<ArrayBuffer> {
  const memory = new Memory(await openModule(wasm)), { core } = memory;
  for (const { path } of files) memory.call(core._condyle_drop_file, path);
  const listed = memory.read({ name: joint.path, bytes: await joint.file.arrayBuffer() }, core._condyle_joint_meshes);
  const needed = new Set(JSON.parse(memory.text(listed)) as string[]);
  for (const { path, file } of files.filter((each) => needed.has(each.path))) {
    const bytes = new Uint8Array(await file.arrayBuffer());
    memory.call(core._condyle_fill_file, path, bytes, bytes.length);
  }
  const block = memory.made(core._condyle_joint_block);
  return core.HEAPU8.slice(block, block + core._condyle_joint_block_bytes()).buffer as ArrayBuffer;
}
