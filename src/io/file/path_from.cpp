#include "io/file/path_from.hpp"

#include <fmt/format.h>

#include "condyle/error.hpp"

namespace condyle::io {
namespace {

std::filesystem::path real_folder_of(const std::filesystem::path& file) {
  return std::filesystem::weakly_canonical(std::filesystem::absolute(file).parent_path());
}

}  // namespace

std::string path_from(const std::filesystem::path& from, const std::filesystem::path& file) {
  const std::filesystem::path real = real_folder_of(file) / file.filename();
  const std::filesystem::path relative = real.lexically_relative(real_folder_of(from));
  std::string text = (relative.empty() ? real : relative).generic_string();
  if (text.find("${") != text.npos)
    throw FileError(fmt::format("{}: a joint file would take ${{ in its path for an environment variable",
                                file.string()));
  return text;
}

}  // namespace condyle::io
