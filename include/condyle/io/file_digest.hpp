#pragma once

#include <cstdint>
#include <string>
#include <string_view>

namespace condyle {

/// Identifies a file by its contents, whatever its name and date.
struct FileDigest {
  std::uintmax_t bytes = 0;
  std::string sha256;  ///< 64 hexadecimal digits, as `sha256sum` prints them

  friend bool operator==(const FileDigest&, const FileDigest&) = default;
};

/// Digest of a file's whole contents. Some 3 ms per MB.
FileDigest digest_of(std::string_view contents);

}  // namespace condyle
