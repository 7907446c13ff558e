#include "io/file/replaced_files.hpp"

#include <algorithm>
#include <iterator>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "condyle/error.hpp"
#include "io/file/file_calls.hpp"
#include "io/file/input_recorder.hpp"

namespace condyle::io {
namespace {

namespace fs = std::filesystem;

std::optional<FileId> id_of(const fs::path& path) noexcept {
  FileStatus status;
  if (look_at(path, status) != 0) return std::nullopt;
  return status.id;
}

/// At least one stands near the beginning of every file with words of its own: provenance, joint files, documents, pages, limits.
constexpr std::string_view own_marks[] = {"condyle_version",       "condyle = ",
                                          "\"condyle\": ",         std::string_view("CONDYLE\0", 8),
                                          "The Condyle authors",   "limits of each coordinate by itself",
                                          "name=\"condyle_limit_", "name=\"condyle_stop_"};
constexpr std::size_t bytes_looked_at = 1 << 20;

/// A mesh has no words: the header of ours has no comment, in which other programs name themselves.
bool has_header_of_mesh(std::string_view bytes) {
  return bytes.starts_with("ply\nformat binary_little_endian 1.0\nelement vertex ");
}

}  // namespace

void check_is_own(const fs::path& path) {
  int stream = 0;
  if (what_has_the_name(path) != NameTaken::replaceable || open_to_read(path, stream) != 0) return;
  std::string bytes(bytes_looked_at, '\0');
  std::size_t got = 0;
  const int error = read_at(stream, 0, bytes, got);
  close_stream(stream);
  bytes.resize(error == 0 ? got : 0);
  if (bytes.empty() || has_header_of_mesh(bytes) ||
      std::any_of(std::begin(own_marks), std::end(own_marks),
                  [&](std::string_view mark) { return bytes.find(mark) != bytes.npos; }))
    return;
  throw FileError(path.string() +
                  ": is there, was not written by condyle and is not replaced: name another, or remove it");
}

void check_replaces_none(std::span<const fs::path> written, std::span<const fs::path> read) {
  std::vector<FileId> known;
  for (const fs::path& path : read)
    if (const auto id = id_of(path)) known.push_back(*id);
  std::sort(known.begin(), known.end());
  for (const fs::path& path : written) {
    const auto id = id_of(path);
    if (id && (std::binary_search(known.begin(), known.end(), *id) || InputRecorder::has_read(*id)))
      throw FileError(path.string() + ": is read for this answer, which would be written over it");
  }
}

NameTaken what_has_the_name(const fs::path& path) {
  FileStatus status;
  if (look_at(path, status) != 0) return NameTaken::replaceable;
  switch (status.kind) {
    case FileStatus::Kind::file:
      return NameTaken::replaceable;
    case FileStatus::Kind::folder:
      return NameTaken::folder;
    case FileStatus::Kind::characters:
      return NameTaken::written_into;
    case FileStatus::Kind::other:
      break;
  }
  return NameTaken::refused;
}

}  // namespace condyle::io
