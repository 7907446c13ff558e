#include "condyle/io/output_folder.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cassert>
#include <string>
#include <system_error>
#include <utility>

#include "condyle/error.hpp"

namespace condyle {
namespace {

namespace fs = std::filesystem;

/// The folders on the way to `folder` that are not there yet, outermost first.
std::vector<fs::path> missing_folders(const fs::path& folder) {
  std::vector<fs::path> missing;
  std::error_code ignored;
  for (fs::path at = folder; !at.empty() && !fs::exists(at, ignored); at = at.parent_path())
    missing.push_back(at);
  std::reverse(missing.begin(), missing.end());
  return missing;
}

void remove_empty(const std::vector<fs::path>& folders) noexcept {
  std::error_code ignored;
  for (auto folder = folders.rbegin(); folder != folders.rend(); ++folder) fs::remove(*folder, ignored);
}

}  // namespace

OutputFolder::OutputFolder(const fs::path& folder)
    : OutputFolder(folder, [](std::string_view) { return false; }) {}

OutputFolder::OutputFolder(const fs::path& folder, OfCommand of_command)
    : folder_(folder), of_command_(std::move(of_command)) {
  if (folder.empty()) throw FileError("output folder: no name given");
  // "a/b/" and "a/b" are one folder; the empty last name would be created on its own.
  if (!folder_.has_filename()) folder_ = folder_.parent_path();
  created_ = missing_folders(folder_);
  std::error_code error;
  fs::create_directories(folder_, error);
  if (!error && !fs::is_directory(folder_)) error = std::make_error_code(std::errc::not_a_directory);
  std::string aside = (folder_ / ".condyle-XXXXXX").string();
  if (!error && ::mkdtemp(aside.data()) == nullptr) error = {errno, std::generic_category()};
  if (error) {
    remove_empty(created_);
    throw FileError(fmt::format("{}: cannot be written to: {}", folder_.string(), error.message()));
  }
  aside_ = aside;
}

OutputFolder::~OutputFolder() {
  std::error_code ignored;
  fs::remove_all(aside_, ignored);
  if (!committed_) remove_empty(created_);
}

fs::path OutputFolder::file(std::string_view name) {
  const fs::path path(name);
  assert(path.filename() == path && !path.empty());
  assert(std::find(names_.begin(), names_.end(), path) == names_.end());
  names_.push_back(path);
  return aside_ / path;
}

std::vector<fs::path> OutputFolder::left_by_earlier_runs() const {
  std::vector<fs::path> left;
  for (const auto& entry : fs::directory_iterator(folder_)) {
    const fs::path name = entry.path().filename();
    if (entry.is_regular_file() && of_command_(name.string()) &&
        std::find(names_.begin(), names_.end(), name) == names_.end())
      left.push_back(entry.path());
  }
  return left;
}

std::vector<fs::path> OutputFolder::commit() {
  // What would stop a move is looked for before the first one.
  for (const fs::path& name : names_)
    if (fs::is_directory(folder_ / name))
      throw FileError(fmt::format("{}: is a folder", (folder_ / name).string()));
  std::vector<fs::path> written;
  for (const fs::path& name : names_) {
    std::error_code error;
    fs::rename(aside_ / name, folder_ / name, error);
    if (error)
      throw FileError(fmt::format("{}: cannot be written: {}", (folder_ / name).string(), error.message()));
    written.push_back(folder_ / name);
    committed_ = true;
  }
  for (const fs::path& file : left_by_earlier_runs()) {
    std::error_code error;
    fs::remove(file, error);
    if (error)
      throw FileError(
          fmt::format("{}: left by an earlier run, cannot be removed: {}", file.string(), error.message()));
  }
  return written;
}

}  // namespace condyle
