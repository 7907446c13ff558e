#include <zlib.h>

#include <array>
#include <cstdint>

/// What zlib does beside streams that go on: whole streams at once, and the check sum of PNG.

namespace {

constexpr int usual_window = 15, usual_memory = 8;

z_stream stream_between(const Bytef* bytes, uLong size, Bytef* out, uLong room) {
  return {const_cast<Bytef*>(bytes), static_cast<uInt>(size), out, static_cast<uInt>(room)};
}

int ended(int result, const z_stream& stream, uLongf* out_size) {
  *out_size -= stream.avail_out;
  return result == Z_STREAM_END ? Z_OK : result == Z_OK ? Z_BUF_ERROR : result;
}

}  // namespace

int compress(Bytef* out, uLongf* out_size, const Bytef* bytes, uLong size) {
  z_stream stream = stream_between(bytes, size, out, *out_size);
  deflateInit2(&stream, Z_DEFAULT_COMPRESSION, Z_DEFLATED, usual_window, usual_memory, Z_DEFAULT_STRATEGY);
  const int result = deflate(&stream, Z_FINISH);
  deflateEnd(&stream);
  return ended(result, stream, out_size);
}

int uncompress(Bytef* out, uLongf* out_size, const Bytef* bytes, uLong size) {
  z_stream stream = stream_between(bytes, size, out, *out_size);
  inflateInit2(&stream, usual_window);
  const int result = inflate(&stream, Z_FINISH);
  inflateEnd(&stream);
  return ended(result, stream, out_size);
}

uLong crc32_z(uLong sum, const Bytef* bytes, std::size_t size) {
  // PNG 1.2, annex D: the polynomial of degree 32 that Ethernet has, its bits reversed.
  static const auto table = [] {
    std::array<std::uint32_t, 256> remainders{};
    for (std::uint32_t byte = 0; byte < remainders.size(); ++byte) {
      std::uint32_t value = byte;
      for (int bit = 0; bit < 8; ++bit) value = value & 1 ? 0xEDB88320u ^ value >> 1 : value >> 1;
      remainders[byte] = value;
    }
    return remainders;
  }();
  auto value = ~static_cast<std::uint32_t>(sum);
  for (std::size_t i = 0; i < size; ++i) value = table[(value ^ bytes[i]) & 255] ^ value >> 8;
  return static_cast<std::uint32_t>(~value);
}
