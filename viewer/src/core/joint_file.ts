import { Memory } from "./joint";
import { openModule } from "./module";
import type { NamedFile } from "./protocol";

/// The block of a joint, as a report has it, of a dropped joint file and of what was dropped with it. Throws the core's own line. Only the
/// meshes that the joint file names are read.
export async function blockOfJoint(wasm: ArrayBuffer, joint: NamedFile, files: readonly NamedFile[]): Promise<ArrayBuffer> {
  const memory = new Memory(await openModule(wasm)), { core } = memory;
  for (const { path } of files) {
    const place = memory.copiedText(path);
    core._condyle_drop_file(place);
    memory.free(place);
  }
  const bytesOf = async ({ path, file }: NamedFile) => ({ name: path, bytes: await file.arrayBuffer() });
  const listed = memory.read(await bytesOf(joint), core._condyle_joint_meshes);
  const needed = new Set(JSON.parse(core.UTF8ToString(listed)) as string[]);
  for (const file of files)
    if (needed.has(file.path)) memory.read(await bytesOf(file), (path, bytes, count) => core._condyle_fill_file(path, bytes, count) + 1);
  const block = core._condyle_joint_block();
  if (!block) throw memory.error();
  return core.HEAPU8.slice(block, block + core._condyle_joint_block_bytes()).buffer as ArrayBuffer;
}
