#pragma once

#include <string>
#include <string_view>

namespace condyle::io {

/// The bytes compressed as a zlib stream. The same bytes for the same input and version of zlib. Throws std::bad_alloc.
std::string deflated(std::string_view bytes);

/// The same as a gzip file, without name and date.
std::string gzipped(std::string_view bytes);

}  // namespace condyle::io
