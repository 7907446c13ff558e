#include "io/image/byte_source.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "condyle/error.hpp"

namespace condyle::io {

ByteSource::ByteSource(const std::filesystem::path& path)
    : file_(path), name_(path.string()), size_(file_->size()) {}

std::size_t ByteSource::read(std::uint64_t at, std::span<char> out) const {
  if (file_) return file_->read(at, out);
  if (at >= size_) return 0;
  const auto count = static_cast<std::size_t>(std::min<std::uint64_t>(out.size(), size_ - at));
  std::copy_n(memory_.begin() + static_cast<std::ptrdiff_t>(at), count, out.begin());
  return count;
}

void ByteSource::fail(std::string_view what) const {
  throw FileError(fmt::format("{}: {}", name_, what));
}

}  // namespace condyle::io
