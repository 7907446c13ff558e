#pragma once

#include <cstdint>
#include <memory>
#include <span>

#include "io/image/byte_source.hpp"

namespace condyle::io {

/// The bytes that a source holds deflated from a place on: as gzip, in one member or several, or as zlib. By zlib, in the page of
/// a report by its port pako (viewer/core/zlib.js). Memory is that of a block, however many bytes come.
class Inflate {
 public:
  Inflate(const ByteSource& source, std::uint64_t at);
  ~Inflate();
  Inflate(const Inflate&) = delete;
  Inflate& operator=(const Inflate&) = delete;

  /// The next bytes, as many as fit; fewer only at the end. Raises FileError for compressed data that are damaged or cut off.
  std::size_t read(std::span<char> out);
  /// Compressed bytes that no byte was made of yet.
  std::uint64_t left() const noexcept;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace condyle::io
