import pageCore, { type PageCore } from "page-core";
import { ZStream, zlibInflate, zlibInflateEnd, zlibInflateInit2, zlibInflateReset } from "pako";

/// The compiled core with its inflate library: viewer/core/zlib.js.
export function openModule(wasm: ArrayBuffer): Promise<PageCore> {
  return pageCore({ wasmBinary: wasm, zlib: { ZStream, zlibInflate, zlibInflateEnd, zlibInflateInit2, zlibInflateReset } });
}
