#include "io/file/replaced_files.hpp"

#include <algorithm>
#include <optional>
#include <utility>
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

}  // namespace

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
