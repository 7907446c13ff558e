// The core compiled to WebAssembly, opened outside of a page.
import { readFileSync } from "node:fs";
import { createRequire } from "node:module";
import { resolve } from "node:path";

/// `zlib`: the package by which the page inflates, where something is to be inflated.
export async function openCore(modulePath, zlib) {
  const wasmBinary = readFileSync(modulePath.replace(/js$/, "wasm"));
  const core = await createRequire(import.meta.url)(resolve(modulePath))({ wasmBinary, zlib });
  const failure = () => new Error(core.UTF8ToString(core._condyle_error()));
  const copied = (array) => {
    const pointer = core._malloc(array.byteLength);
    new Uint8Array(core.HEAPU8.buffer).set(new Uint8Array(array.buffer, array.byteOffset, array.byteLength), pointer);
    return pointer;
  };
  return {
    core,
    copied,
    /// The answer, if it is not an error; else the core's own line is thrown.
    checked(answer) {
      if (answer < 0) throw failure();
      return answer;
    },
    f64: (pointer, count) => new Float64Array(core.HEAPU8.buffer, pointer, count),
    u32: (pointer, count) => new Uint32Array(core.HEAPU8.buffer, pointer, count),
    /// A joint of a right hip; vertices and triangles as they lie in a report.
    jointOf({ fixed, fixedTriangles, mobile, mobileTriangles }) {
      const joint = core._condyle_joint(0, 0, 0, 0, copied(fixed), fixed.length / 3, copied(fixedTriangles), fixedTriangles.length / 3,
        copied(mobile), mobile.length / 3, copied(mobileTriangles), mobileTriangles.length / 3);
      if (!joint) throw failure();
      return joint;
    },
  };
}
