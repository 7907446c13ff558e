#include "io/image/byte_source.hpp"

#include <fmt/format.h>
#include <sys/types.h>

#include <algorithm>
#include <cerrno>
#include <system_error>

#include "condyle/error.hpp"
#include "io/file/whole_file.hpp"

namespace condyle::io {

ByteSource::ByteSource(const std::filesystem::path& path) : name_(path.string()) {
  check_is_file(path);
  file_.reset(std::fopen(path.c_str(), "rb"));
  if (!file_) fail("cannot be read: " + std::generic_category().message(errno));
  std::error_code error;
  size_ = std::filesystem::file_size(path, error);
  if (error) fail("cannot be read: " + error.message());
}

std::size_t ByteSource::read(std::uint64_t at, std::span<char> out) const {
  if (at >= size_) return 0;
  const auto count = static_cast<std::size_t>(std::min<std::uint64_t>(out.size(), size_ - at));
  if (!file_) {
    std::copy_n(memory_.begin() + static_cast<std::ptrdiff_t>(at), count, out.begin());
    return count;
  }
  if (::fseeko(file_.get(), static_cast<off_t>(at), SEEK_SET) != 0) fail("cannot be read to its end");
  const std::size_t got = std::fread(out.data(), 1, count, file_.get());
  if (std::ferror(file_.get())) fail("cannot be read to its end");
  return got;
}

void ByteSource::fail(std::string_view what) const {
  throw FileError(fmt::format("{}: {}", name_, what));
}

}  // namespace condyle::io
