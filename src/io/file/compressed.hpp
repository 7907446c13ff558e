#pragma once

#include <string_view>

namespace condyle::io {

/// The program whose packed files begin so: "gzip", "zip", "bzip2", "xz" or "zstd"; empty for every other file.
std::string_view packed_by(std::string_view bytes) noexcept;

}  // namespace condyle::io
