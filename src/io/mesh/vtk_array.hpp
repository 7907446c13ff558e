#pragma once

#include <bit>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "io/file/number_type.hpp"
#include "io/mesh/parse.hpp"

/// Arrays of numbers as VTK's XML files hold them: text, base64 or raw bytes, plain or in compressed blocks.

namespace condyle::io {

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
  NumberType type;
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
