#pragma once

#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "condyle/io/mesh_file.hpp"

/// The only functions by which a file, a folder or an environment variable is read; the test `layers` holds that. What they look at is
/// recorded (input_recorder.hpp), and what fails them for the moment only is a passing failure there.

namespace condyle::io {

/// A regular file that is open for reading. Errors are FileError.
class InputFile {
 public:
  explicit InputFile(const std::filesystem::path& path);
  ~InputFile();
  InputFile(InputFile&& other) noexcept;
  InputFile& operator=(InputFile&& other) noexcept;

  std::uint64_t size() const noexcept { return size_; }
  /// The bytes from a place on, as many as fit; fewer only at the end.
  std::size_t read(std::uint64_t at, std::span<char> out) const;

 private:
  friend std::string read_whole_file(const std::filesystem::path& path, FileDigest* digest);
  struct WithoutDigest {};
  InputFile(const std::filesystem::path& path, WithoutDigest);

  std::filesystem::path path_;
  int stream_ = -1;
  std::uint64_t size_ = 0;
};

/// The bytes of a regular file, and their digest if it is wanted. Raises FileError for a file that is missing, a folder, or cannot be
/// read.
std::string read_whole_file(const std::filesystem::path& path, FileDigest* digest = nullptr);

/// What has a name, links followed.
enum class EntryKind : std::uint8_t { none, file, folder, other };
EntryKind entry_at(const std::filesystem::path& path);

/// Raises FileError for a file that is missing, a folder, or something else that is not a regular file.
void check_is_file(const std::filesystem::path& path);

/// Bytes of a regular file. FileError.
std::uint64_t size_of_file(const std::filesystem::path& path);

/// "there is no file PATH", on one line; empty if there is something of that name.
std::string why_no_file(const std::filesystem::path& path);

/// The names in a folder that are this one but for capitals, in their order; none if there is no such folder.
std::vector<std::string> names_like(const std::filesystem::path& folder, const std::string& name);

}  // namespace condyle::io
