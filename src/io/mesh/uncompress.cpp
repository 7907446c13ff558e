#include "io/mesh/uncompress.hpp"

#include <lz4.h>
#include <zlib.h>

#include <limits>
#include <utility>

namespace condyle::io {
namespace {

bool inflate_into(std::span<char> out, const std::string& block) {
  if (!std::in_range<uLong>(block.size()) || !std::in_range<uLong>(out.size())) return false;
  auto size = static_cast<uLongf>(out.size());
  return ::uncompress(reinterpret_cast<Bytef*>(out.data()), &size,
                      reinterpret_cast<const Bytef*>(block.data()),
                      static_cast<uLong>(block.size())) == Z_OK &&
         size == out.size();
}

bool decompress_lz4_into(std::span<char> out, const std::string& block) {
  constexpr std::size_t largest = std::numeric_limits<int>::max();
  if (block.size() > largest || out.size() > largest) return false;
  return LZ4_decompress_safe(block.data(), out.data(), static_cast<int>(block.size()),
                             static_cast<int>(out.size())) == static_cast<int>(out.size());
}

}  // namespace

bool uncompress(Compressor compressor, const std::string& block, std::span<char> out) {
  return compressor == Compressor::zlib ? inflate_into(out, block) : decompress_lz4_into(out, block);
}

}  // namespace condyle::io
