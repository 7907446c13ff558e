import { lineOf } from "./core/error_line";
import { textOf } from "./dom";
import { bytesOf, inflated } from "./packed";

/// Whether the browser runs the core.
export const canCompute = typeof WebAssembly !== "undefined";

/// The part of the file that computes cannot be read.
class CoreDamage extends Error {}

/// The core as the file of this page has it.
export async function wasmBytes(): Promise<ArrayBuffer> {
  try {
    return await inflated(bytesOf(textOf("core") ?? ""), "gzip");
  } catch {
    throw new CoreDamage();
  }
}

export function isCoreDamage(error: unknown): boolean {
  return error instanceof CoreDamage || /Aborted|WebAssembly|CompileError/.test(lineOf(error));
}
