#include "io/file/output_folder.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cassert>
#include <cerrno>
#include <iterator>
#include <string>
#include <system_error>
#include <utility>

#include "condyle/error.hpp"
#include "io/file/file_calls.hpp"
#include "io/file/replaced_files.hpp"
#include "io/file/temporary_folder.hpp"

namespace condyle::io {
namespace {

namespace fs = std::filesystem;

std::string reason_of(int error) {
  return std::generic_category().message(error);
}

/// "a/b/" and "a/b" are one folder; the empty last name would be created on its own.
fs::path without_last_slash(const fs::path& folder) {
  if (folder.empty()) throw FileError("output folder: no name given");
  return folder.has_filename() ? folder : folder.parent_path();
}

/// The command's files in the folder; none if there is no folder.
std::vector<fs::path> files_of_command(const fs::path& folder, const OutputFolder::OfCommand& of_command) {
  std::vector<fs::path> files;
  std::error_code error;
  for (fs::directory_iterator entry(folder, error), end; !error && entry != end; entry.increment(error))
    if (of_command(entry->path().filename().string())) files.push_back(entry->path());
  return files;
}

/// Throws FileError if one of these files belongs to the answer of another command: that has a document there, and this one has none.
void check_are_of_no_other_answer(const std::vector<fs::path>& there,
                                  const OutputFolder::OfCommand& of_command) {
  if (there.empty()) return;
  constexpr std::string_view documents[] = {"depth.json",  "implant.json",   "load.json", "measures.json",
                                            "motion.json", "resection.json", "rom.json",  "study.json",
                                            "sweep.json",  "touch.json"};
  const fs::path folder = there.front().parent_path();
  std::string_view other;
  for (const std::string_view name : documents) {
    std::error_code ignored;
    if (!fs::exists(folder / name, ignored)) continue;
    if (of_command(name)) return;
    other = name;
  }
  if (!other.empty())
    throw FileError(fmt::format("{}: is there beside {}, the answer of another command: name another folder",
                                there.front().string(), other));
}

/// Whether a run was killed here while its files got their names: its folder aside is left.
bool has_aside(const fs::path& folder) {
  return !files_of_command(folder, [](std::string_view name) {
            return name.starts_with(aside_prefix);
          }).empty();
}

/// Tables of numbers and images have no words that say whose they are.
bool says_whose(const fs::path& path) {
  constexpr std::string_view endings[] = {".toml", ".ply", ".json", ".html", ".png", ".osim", ".xml"};
  return std::find(std::begin(endings), std::end(endings), path.extension().string()) != std::end(endings);
}

void check_is_replaceable(const fs::path& path) {
  const NameTaken taken = io::what_has_the_name(path);
  if (taken == NameTaken::written_into || taken == NameTaken::refused)
    throw FileError(path.string() + ": is no regular file and is not replaced");
}

}  // namespace

std::vector<fs::path> files_below(const fs::path& folder) {
  std::vector<fs::path> files;
  std::error_code error;
  for (fs::recursive_directory_iterator entry(folder, error), end; !error && entry != end;
       entry.increment(error))
    if (entry->is_regular_file()) files.push_back(entry->path().lexically_relative(folder));
  if (error) throw FileError(fmt::format("{}: cannot be listed: {}", folder.string(), error.message()));
  std::sort(files.begin(), files.end());
  return files;
}

OutputFolder::OutputFolder(const fs::path& folder)
    : OutputFolder(folder, [](std::string_view) { return false; }) {}

OutputFolder::OutputFolder(const fs::path& folder, OfCommand of_command, std::span<const fs::path> read,
                           std::string document)
    : folder_(without_last_slash(folder)),
      of_command_(std::move(of_command)),
      document_(std::move(document)) {
  const std::vector<fs::path> there = files_of_command(folder_, of_command_);
  io::check_replaces_none(there, read);
  check_are_of_no_other_answer(there, of_command_);
  std::error_code none;
  const bool was_here = document_.empty() || fs::exists(folder_ / document_, none) || has_aside(folder_);
  for (const fs::path& file : there) {
    check_is_replaceable(file);
    if (!was_here) check_is_own(file);
  }
  aside_ = std::make_unique<TemporaryFolder>(folder_);
}

OutputFolder::~OutputFolder() = default;

fs::path OutputFolder::file(std::string_view name) {
  const fs::path path(name);
  assert(path.filename() == path && !path.empty());
  assert(std::find(names_.begin(), names_.end(), path) == names_.end());
  names_.push_back(path);
  return fs::path(aside_->path()) / path;
}

fs::path OutputFolder::aside() const {
  return aside_->path();
}

std::vector<fs::path> OutputFolder::left_by_earlier_runs() const {
  std::error_code none;
  if (!document_.empty() && !fs::exists(folder_ / document_, none)) return {};
  std::vector<fs::path> left = files_of_command(folder_, of_command_);
  std::erase_if(left, [&](const fs::path& file) {
    std::error_code ignored;
    return !fs::is_regular_file(file, ignored) ||
           std::find(names_.begin(), names_.end(), file.filename()) != names_.end();
  });
  return left;
}

std::vector<fs::path> OutputFolder::commit() {
  // Checks before the first move everything that would stop one, and allocates all memory: between two moves only the
  // file system can then fail.
  std::vector<fs::path> from, to;
  for (const fs::path& name : names_) {
    from.push_back(fs::path(aside_->path()) / name);
    to.push_back(folder_ / name);
    std::error_code ignored;
    if (fs::is_directory(to.back(), ignored)) throw FileError(to.back().string() + ": is a folder");
    check_is_replaceable(to.back());
    if (document_.empty() && says_whose(name)) check_is_own(to.back());
  }
  const std::vector<fs::path> left = left_by_earlier_runs();
  // What was read since the folder was made.
  io::check_replaces_none(to, {});
  io::check_replaces_none(left, {});
  for (std::size_t i = 0; i < from.size(); ++i)
    if (const int error = move_file(from[i], to[i]))
      throw FileError(fmt::format("{}: cannot be written: {}", to[i].string(), reason_of(error)));
  for (const fs::path& file : left)
    if (const int error = remove_file(file); error != 0 && error != ENOENT)
      throw FileError(
          fmt::format("{}: left by an earlier run, cannot be removed: {}", file.string(), reason_of(error)));
  return to;
}

}  // namespace condyle::io
