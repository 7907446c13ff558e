#include "io/file/replaced_files.hpp"

#include <sys/stat.h>

#include <algorithm>
#include <optional>
#include <utility>
#include <vector>

#include "condyle/error.hpp"
#include "io/file/input_recorder.hpp"

namespace condyle::io {
namespace {

namespace fs = std::filesystem;

std::optional<FileId> id_of(const fs::path& path) noexcept {
  struct stat status {};
  if (::stat(path.c_str(), &status) != 0) return std::nullopt;
  return FileId{status.st_dev, status.st_ino};
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
  struct stat status {};
  if (::stat(path.c_str(), &status) != 0 || S_ISREG(status.st_mode)) return NameTaken::replaceable;
  if (S_ISDIR(status.st_mode)) return NameTaken::folder;
  return S_ISFIFO(status.st_mode) || S_ISCHR(status.st_mode) ? NameTaken::written_into : NameTaken::refused;
}

}  // namespace condyle::io
