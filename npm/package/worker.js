// Runs the command, in a thread of its own: a signal is for the main thread, which answers while this one computes.
import { createHash } from "node:crypto";
import { fstatSync, readFileSync, writeSync } from "node:fs";
import { join } from "node:path";
import { setFlagsFromString } from "node:v8";
import { workerData } from "node:worker_threads";
import { ZStream, zlibDeflate, zlibDeflateEnd, zlibDeflateInit2, zlibInflate, zlibInflateEnd, zlibInflateInit2, zlibInflateReset } from "pako";
import condyle from "condyle-wasm";
import { folders, state, written } from "./shared.js";
import { nameFilesOf, outside, wordWithin } from "./windows.js";

const { words, shared } = workerData;
const at = state(shared), made = folders(shared);
const beside = (name) => readFileSync(join(__dirname, name));
const hashes = [];
let template = null;

const node = {
  signalled: () => Atomics.load(at, written.signalled),
  watch: (begins) => Atomics.store(at, written.watched, Number(begins)),
  run(joined, showsErrors) {
    const [program, ...rest] = joined.split("\0").slice(0, -1);
    const { status } = require("node:child_process").spawnSync(program, rest, { stdio: ["inherit", showsErrors ? 2 : "ignore", showsErrors ? 2 : "ignore"], env: { ...process.env, PYTHONSAFEPATH: "1" } });
    return status ?? -1;
  },
  hashBegin: () => hashes.push(createHash("sha256")) - 1,
  hash: (number) => hashes[number],
  template: () => (template ??= beside("report_template.html")),
};

/// Node's module for terminals, and that for programs above, bring those for networks: they are loaded when they are needed.
function isTerminal(stream) {
  try {
    return fstatSync(stream).isCharacterDevice() && require("node:tty").isatty(stream);
  } catch {
    return false;  // It is closed.
  }
}

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

// Flags come when node has loaded what is its own, whose cached code other flags make worthless. Functions are looked through and compiled when
// they are first called: most never are. Those that have run through so many bytes are optimised, which takes V8 longer than a short command has.
// V8 names on standard error a flag that it does not know.
const terminals = [0, 1, 2].map(isTerminal);
if (parseInt(process.versions.node) <= 24)
  for (const flag of ["--wasm-lazy-compilation", "--wasm-lazy-validation", "--wasm-tiering-budget=2000000000"]) setFlagsFromString(flag);
condyle({
  wasmBinary: beside("condyle.wasm"),
  zlib: { ZStream, zlibDeflate, zlibDeflateEnd, zlibDeflateInit2, zlibInflate, zlibInflateEnd, zlibInflateInit2, zlibInflateReset },
  node, print: (line) => writeSync(1, `${line}\n`), printErr: (line) => writeSync(2, `${line}\n`),
  preRun: [(module) => {
    Object.assign(module.ENV, process.env);
    nameFilesOf(module.FS);
    module.FS.write = writtenAtLast(module.FS.write);
    const { mkdir, rmdir } = module.FS;
    module.FS.mkdir = (path, mode) => {
      const is = mkdir(path, mode);
      made.add(outside(path));
      return is;
    };
    module.FS.rmdir = (path) => {
      const is = rmdir(path);
      made.delete(outside(path));
      return is;
    };
  }],
}).then((module) => {
  for (const stream of [0, 1, 2]) module.FS.streams[stream].tty = terminals[stream];
  module.callMain(words.map(wordWithin));
});
