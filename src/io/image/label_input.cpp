#include "io/image/label_input.hpp"

#include <fmt/format.h>

#include <system_error>

#include "condyle/error.hpp"
#include "io/file/in_quotes.hpp"

namespace condyle::io {
namespace {

/// Links and ".." resolved, so that neither leads out of a folder unseen.
bool is_below(const std::filesystem::path& folder, const std::filesystem::path& file) {
  std::error_code error;
  const auto top = std::filesystem::weakly_canonical(folder, error);
  if (error) return false;
  const auto place = std::filesystem::weakly_canonical(file, error);
  if (error) return false;
  const auto relative = place.lexically_relative(top);
  return !relative.empty() && *relative.begin() != "..";
}

}  // namespace

ByteSource LabelInput::open_data(std::string_view key, const std::filesystem::path& named) const {
  if (path.empty())
    header.fail(fmt::format("{}: the data lie in another file, {}", key, in_quotes(named.string())));
  if (named.native().find('\0') != std::string::npos)
    header.fail(fmt::format("{}: {} is no name of a file", key, in_quotes(named.string())));
  auto folder = path.parent_path();
  if (folder.empty()) folder = ".";
  const auto file = folder / named;
  if (!options.outside_folder && !is_below(folder, file))
    header.fail(fmt::format("{}: {} lies outside the folder of the header", key, in_quotes(named.string())));
  try {
    return ByteSource(file);
  } catch (const FileError&) {
    header.fail(fmt::format("{}: {} cannot be opened or is no regular file", key, in_quotes(named.string())));
  }
}

}  // namespace condyle::io
