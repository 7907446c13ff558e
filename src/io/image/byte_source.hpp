#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <string_view>

#include "io/file/input_file.hpp"

namespace condyle::io {

/// The bytes of a file, or of memory, at any place: images are larger than should lie in memory twice.
class ByteSource {
 public:
  /// Borrows the bytes.
  ByteSource(std::string_view bytes, std::string_view name)
      : memory_(bytes), name_(name), size_(bytes.size()) {}
  /// Opens a regular file. Raises FileError.
  explicit ByteSource(const std::filesystem::path& path);

  const std::string& name() const noexcept { return name_; }
  std::uint64_t size() const noexcept { return size_; }
  /// The bytes from a place on, as many as fit; fewer only at the end.
  std::size_t read(std::uint64_t at, std::span<char> out) const;
  /// FileError "name: what".
  [[noreturn]] void fail(std::string_view what) const;

 private:
  std::string_view memory_;
  std::optional<InputFile> file_;
  std::string name_;
  std::uint64_t size_ = 0;
};

}  // namespace condyle::io
