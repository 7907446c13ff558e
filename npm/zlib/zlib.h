#pragma once

/// The functions of zlib that condyle_io calls: functions in JavaScript (viewer/core/zlib.js), by pako.

#include "../../viewer/core/zlib/zlib.h"

#include <cstddef>

using uLong = unsigned long;
using uLongf = uLong;

constexpr int Z_FINISH = 4, Z_DEFLATED = 8, Z_DEFAULT_COMPRESSION = -1, Z_DEFAULT_STRATEGY = 0;

extern "C" {
int deflateInit2(z_stream* stream, int level, int method, int window_bits, int memory, int strategy);
int deflate(z_stream* stream, int flush);
int deflateEnd(z_stream* stream);
}

/// At least as many bytes as a stream of these takes; zlib's own bound.
inline uLong compressBound(uLong bytes) {
  return bytes + (bytes >> 12) + (bytes >> 14) + (bytes >> 25) + 13;
}

uLong crc32_z(uLong sum, const Bytef* bytes, std::size_t size);
int compress(Bytef* out, uLongf* out_size, const Bytef* bytes, uLong size);
int uncompress(Bytef* out, uLongf* out_size, const Bytef* bytes, uLong size);
