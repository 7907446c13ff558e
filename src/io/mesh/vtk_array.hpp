#pragma once

#include <bit>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "io/mesh/parse.hpp"

/// Arrays of numbers as VTK's XML files hold them: text, base64 or raw bytes, plain or in compressed blocks.

namespace condyle::io {

enum class VtkType { i8, u8, i16, u16, i32, u32, i64, u64, f32, f64 };

constexpr bool is_floating(VtkType type) {
  return type == VtkType::f32 || type == VtkType::f64;
}

/// Calls with a zero of the C++ type.
template <class Call>
auto with_type(VtkType type, const Call& call) {
  switch (type) {
    case VtkType::i8:
      return call(std::int8_t{});
    case VtkType::u8:
      return call(std::uint8_t{});
    case VtkType::i16:
      return call(std::int16_t{});
    case VtkType::u16:
      return call(std::uint16_t{});
    case VtkType::i32:
      return call(std::int32_t{});
    case VtkType::u32:
      return call(std::uint32_t{});
    case VtkType::i64:
      return call(std::int64_t{});
    case VtkType::u64:
      return call(std::uint64_t{});
    case VtkType::f32:
      return call(float{});
    case VtkType::f64:
      break;
  }
  return call(double{});
}

enum class Compressor { none, zlib, lz4 };

/// Encoding of all arrays, from the file's first tag.
struct VtkEncoding {
  std::endian order = std::endian::little;
  std::size_t header_word = sizeof(std::uint32_t);  ///< Bytes of one of the lengths before an array.
  Compressor compressor = Compressor::none;
};

/// Place and encoding of an array.
struct VtkArray {
  enum class Format { text, base64, raw };

  std::string label;  ///< For messages: "Points", "Polys connectivity".
  VtkType type;
  Format format;
  std::string_view data;  ///< From its first character on; appended arrays may go on into the next one's.
};

/// The array's numbers. There must be `count` of them: a length in the file that differs is refused before
/// memory is allocated.
std::vector<double> read_coordinates(const VtkArray& array, const VtkEncoding& encoding, std::uint64_t count,
                                     const Source& source);
std::vector<std::int64_t> read_integers(const VtkArray& array, const VtkEncoding& encoding,
                                        std::uint64_t count, const Source& source);

}  // namespace condyle::io
