#include "io/file/output_file.hpp"

#include "condyle/error.hpp"
#include "condyle/io/output_folder.hpp"
#include "io/file/whole_file.hpp"

namespace condyle::io {
namespace {

std::filesystem::path folder_of(const std::filesystem::path& path) {
  return path.has_parent_path() ? path.parent_path() : std::filesystem::path(".");
}

}  // namespace

void check_output_file(const std::filesystem::path& path) {
  if (!path.has_filename() || std::filesystem::is_directory(path))
    throw FileError(path.string() + ": is a folder, not a file");
  OutputFolder{folder_of(path)};
}

void write_output_file(const std::filesystem::path& path, std::string_view bytes) {
  OutputFolder out(folder_of(path));
  write_whole_file(out.file(path.filename().string()), bytes);
  out.commit();
}

}  // namespace condyle::io
