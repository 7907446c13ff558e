#pragma once

#include <cstdint>
#include <optional>
#include <span>

#include "io/image/byte_source.hpp"
#include "io/image/inflate.hpp"

namespace condyle::io {

/// How the bytes of a stream lie in the file; deflated: as gzip, in one member or several, or as zlib.
enum class Packing { none, deflated };

/// Bytes of a source one after the other, inflated on the way. Memory is that of a block, however many bytes come.
class ByteStream {
 public:
  ByteStream(const ByteSource& source, std::uint64_t at, Packing packing);

  /// The next bytes, as many as fit; fewer only at the end. Raises FileError for compressed data that are damaged or cut off.
  std::size_t read(std::span<char> out);
  /// Passes over so many bytes; false if there are fewer.
  bool skip(std::uint64_t bytes);
  /// Whether any bytes follow. Compressed data are read on, for as many bytes as given: their checksum stands at the end.
  bool has_more(std::uint64_t read_at_most);
  /// Whether so many more bytes can follow: exact without compression, and otherwise what deflate can make of the file.
  bool may_hold(std::uint64_t bytes) const noexcept;
  /// Raises FileError "name: what".
  [[noreturn]] void fail(std::string_view what) const { source_.fail(what); }

 private:
  const ByteSource& source_;
  std::uint64_t at_;
  std::optional<Inflate> inflate_;
};

/// Whether gzip begins at a byte of the source.
bool is_gzip(const ByteSource& source, std::uint64_t at = 0);

}  // namespace condyle::io
