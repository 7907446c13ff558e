#!/usr/bin/env node
// The command condyle: its work in a worker, signals here.
import { rmSync, rmdirSync, writeSync } from "node:fs";
import { join } from "node:path";
import { Worker } from "node:worker_threads";
import { folders, sharedMemory, state, written } from "./shared.js";

const interrupted = 130, patience_ms = 500, poll_ms = 20;
const shared = sharedMemory(), at = state(shared);
const worker = new Worker(join(__dirname, "worker.cjs"), {
  workerData: { words: process.argv.slice(2), shared }, stdin: false, resourceLimits: { stackSizeMb: 16 },
});
worker.on("error", (error) => {
  writeSync(2, `condyle: internal error: ${error.message ?? error}\n`);
  process.exitCode = 5;
});
worker.on("exit", (code) => { process.exitCode ??= code; });

/// Ends the work where it is. Folders that it made aside are taken away with their files, those on their way if they are empty.
async function end(line) {
  await worker.terminate();
  for (const path of folders(shared).read().reverse()) {
    try {
      if (/(^|\/)\.condyle-[^/]{6}$/.test(path)) rmSync(path, { recursive: true, force: true });
      else rmdirSync(path);
    } catch {
      // It is not empty: an answer is in it.
    }
  }
  writeSync(2, `condyle: ${line}\n`);
  process.exit(interrupted);
}

const isWriting = () => folders(shared).read().some((path) => /(^|\/)\.condyle-[^/]{6}$/.test(path));
for (const signal of ["SIGINT", "SIGTERM", "SIGHUP"])
  process.on(signal, () => {
    if (Atomics.exchange(at, written.signalled, 1) || !Atomics.load(at, written.watched)) return void end("interrupted; nothing more is written");
    let waited_ms = 0;
    setInterval(() => {
      waited_ms += poll_ms;
      if (waited_ms >= patience_ms && !isWriting()) void end("interrupted; nothing is written");
    }, poll_ms).unref();
  });
