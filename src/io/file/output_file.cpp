#include "io/file/output_file.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <string>
#include <system_error>

#include "condyle/error.hpp"
#include "io/file/file_calls.hpp"
#include "io/file/output_folder.hpp"
#include "io/file/replaced_files.hpp"
#include "io/file/whole_file.hpp"
#include "io/mesh/parse.hpp"

namespace condyle::io {
namespace {

namespace fs = std::filesystem;

fs::path folder_of(const fs::path& path) {
  return path.has_parent_path() ? path.parent_path() : fs::path(".");
}

/// Throws if no file can have this name.
NameTaken checked(const fs::path& path) {
  if (path.empty()) throw FileError("output file: no name given");
  // Links in a circle, or a name that is too long: later the name of a temporary file would be what fails.
  std::error_code error;
  if (fs::status(path, error).type() == fs::file_type::none)
    throw FileError(fmt::format("{}: cannot be written: {}", path.string(), error.message()));
  const NameTaken taken = what_has_the_name(path);
  if (!path.has_filename() || taken == NameTaken::folder)
    throw FileError(path.string() + ": is a folder, not a file");
  if (taken == NameTaken::refused)
    throw FileError(path.string() + ": is neither a file nor can it be written into, and is not replaced");
  return taken;
}

void check_ending(const fs::path& path, const FileKind& kind) {
  const std::string ending = lower_case(path.extension().string());
  std::error_code ignored;
  // The name of a link, such as /dev/stdout, is not that of the file.
  if (kind.endings.empty() || fs::is_symlink(path, ignored) ||
      std::find(kind.endings.begin(), kind.endings.end(), ending) != kind.endings.end())
    return;
  throw UsageError(
      fmt::format("{}: {} is written, FILE{}{}", path.string(), kind.what, kind.endings.front(), kind.hint));
}

}  // namespace

void check_output_file(const fs::path& path, std::span<const fs::path> read, const FileKind& kind) {
  const NameTaken taken = checked(path);
  check_replaces_none({&path, 1}, read);
  if (taken == NameTaken::replaceable) {
    check_ending(path, kind);
    check_is_own(path);
    OutputFolder{folder_of(end_of_links(path))};
  } else if (const int error = why_not_writable(path)) {
    throw FileError(
        fmt::format("{}: cannot be written: {}", path.string(), std::generic_category().message(error)));
  }
}

void write_output_file(const fs::path& path, std::string_view bytes) {
  check_replaces_none({&path, 1}, {});
  if (checked(path) == NameTaken::written_into) return write_whole_file(path, bytes);
  const fs::path file = end_of_links(path);
  OutputFolder out(folder_of(file));
  write_whole_file(out.file(file.filename().string()), bytes);
  out.commit();
}

}  // namespace condyle::io
