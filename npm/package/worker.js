// Runs the command, in a thread of its own: a signal is for the main thread, which answers while this one computes.
import { spawnSync } from "node:child_process";
import { readFileSync, writeSync } from "node:fs";
import { isatty } from "node:tty";
import { workerData } from "node:worker_threads";
import { ZStream, zlibDeflate, zlibDeflateEnd, zlibDeflateInit2, zlibInflate, zlibInflateEnd, zlibInflateInit2, zlibInflateReset } from "pako";
import condyle from "condyle-wasm";
import { folders, state, written } from "./shared.js";

const { words, shared } = workerData;
const at = state(shared), made = folders(shared);
let template = null;

const node = {
  signalled: () => Atomics.load(at, written.signalled),
  watch: (begins) => Atomics.store(at, written.watched, Number(begins)),
  run(joined, showsErrors) {
    const [program, ...rest] = joined.split("\0").slice(0, -1);
    const { status } = spawnSync(program, rest, { stdio: ["inherit", showsErrors ? 2 : "ignore", showsErrors ? 2 : "ignore"], env: { ...process.env, PYTHONSAFEPATH: "1" } });
    return status ?? -1;
  },
  template: () => (template ??= readFileSync(new URL("report_template.html", workerData.folder))),
};

/// Standard output may be a pipe whose reader is slower.
function writtenAtLast(write) {
  return (stream, ...rest) => {
    for (;;) {
      try {
        return write(stream, ...rest);
      } catch (error) {
        if (error.errno !== 6) throw error;  // EAGAIN, as emscripten numbers it
        Atomics.wait(new Int32Array(new SharedArrayBuffer(4)), 0, 0, 1);
      }
    }
  };
}

await condyle({
  wasmBinary: readFileSync(new URL("condyle.wasm", workerData.folder)),
  zlib: { ZStream, zlibDeflate, zlibDeflateEnd, zlibDeflateInit2, zlibInflate, zlibInflateEnd, zlibInflateInit2, zlibInflateReset },
  node, print: (line) => writeSync(1, `${line}\n`), printErr: (line) => writeSync(2, `${line}\n`),
  preRun: [(module) => {
    Object.assign(module.ENV, process.env);
    module.FS.write = writtenAtLast(module.FS.write);
    const { mkdir, rmdir } = module.FS;
    module.FS.mkdir = (path, mode) => {
      const is = mkdir(path, mode);
      made.add(path);
      return is;
    };
    module.FS.rmdir = (path) => {
      const is = rmdir(path);
      made.delete(path);
      return is;
    };
  }],
}).then((module) => {
  for (const stream of [0, 1, 2]) module.FS.streams[stream].tty = isatty(stream);
  module.callMain(words);
});
