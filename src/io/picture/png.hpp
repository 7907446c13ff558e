#pragma once

#include <filesystem>
#include <span>

#include "condyle/io/picture.hpp"

namespace condyle::io {

/// With the texts among these fields; not over a file that was read.
void write_png(const std::filesystem::path& path, const Picture& picture, std::span<const VtpField> fields,
               std::span<const std::filesystem::path> read);

}  // namespace condyle::io
