#pragma once

/// The function of LZ4 that io::uncompress() calls, since there is no library of it for WebAssembly.

/// Takes a block apart: tokens with lengths of literals and of copies (github.com/lz4/lz4, doc/lz4_Block_format.md). Returns the bytes
/// written; below 0 for a block that is damaged or does not fit.
int LZ4_decompress_safe(const char* block, char* out, int block_bytes, int out_bytes);
