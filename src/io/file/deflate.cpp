#include "io/file/deflate.hpp"

#include <zlib.h>

#include <algorithm>
#include <cstddef>
#include <new>
#include <utility>

namespace condyle::io {

std::string deflated(std::string_view bytes) {
  // A whole stream is counted in a type of zlib, which need not have 64 bits.
  if (!std::in_range<uLong>(bytes.size())) throw std::bad_alloc();
  uLongf size = compressBound(static_cast<uLong>(bytes.size()));
  std::string out(size, '\0');
  // Given that much room, memory of its own is all that zlib can lack.
  if (compress(reinterpret_cast<Bytef*>(out.data()), &size, reinterpret_cast<const Bytef*>(bytes.data()),
               static_cast<uLong>(bytes.size())) != Z_OK)
    throw std::bad_alloc();
  out.resize(size);
  return out;
}

std::string gzipped(std::string_view bytes) {
  z_stream stream{};
  constexpr int gzip_window = 15 + 16, usual_memory = 8;
  if (deflateInit2(&stream, Z_DEFAULT_COMPRESSION, Z_DEFLATED, gzip_window, usual_memory,
                   Z_DEFAULT_STRATEGY) != Z_OK)
    throw std::bad_alloc();
  std::string out;
  constexpr std::size_t block = std::size_t{1} << 20;
  stream.next_in = reinterpret_cast<Bytef*>(const_cast<char*>(bytes.data()));
  try {
    for (int result = Z_OK; result != Z_STREAM_END;) {
      const std::size_t given = std::min(block, bytes.size());
      if (stream.avail_in == 0) stream.avail_in = static_cast<uInt>(given), bytes.remove_prefix(given);
      out.resize(out.size() + block);
      stream.next_out = reinterpret_cast<Bytef*>(out.data() + out.size() - block);
      stream.avail_out = static_cast<uInt>(block);
      result = deflate(&stream, bytes.empty() ? Z_FINISH : Z_NO_FLUSH);
      out.resize(out.size() - stream.avail_out);
    }
  } catch (...) {
    deflateEnd(&stream);
    throw;
  }
  deflateEnd(&stream);
  // Which system wrote it (RFC 1952): zlib says its own.
  constexpr std::size_t system_at = 9;
  constexpr char of_unix = 3;
  out[system_at] = of_unix;
  return out;
}

}  // namespace condyle::io
