#pragma once

/// The functions of zlib that io::Inflate calls, for the page, which has no zlib: functions in JavaScript (zlib.js), by pako.

using Bytef = unsigned char;
using uInt = unsigned int;

constexpr int Z_NO_FLUSH = 0;
constexpr int Z_OK = 0, Z_STREAM_END = 1, Z_MEM_ERROR = -4, Z_BUF_ERROR = -5;

/// zlib.js knows the order; the rest of a stream is there, under the stream's address.
struct z_stream {
  Bytef* next_in;
  uInt avail_in;
  Bytef* next_out;
  uInt avail_out;
};

extern "C" {
int inflateInit2(z_stream* stream, int window_bits);
int inflate(z_stream* stream, int flush);
int inflateReset(z_stream* stream);
int inflateEnd(z_stream* stream);
}
