#include "io/model/find_mesh.hpp"

#include <algorithm>
#include <system_error>

#include "io/mesh/parse.hpp"

namespace condyle::io {
namespace {

namespace fs = std::filesystem;

bool is_file(const fs::path& path) {
  std::error_code ignored;
  return fs::is_regular_file(path, ignored);
}

/// The file beside it whose name differs in case only; the first of several in the order of their names.
std::optional<fs::path> in_any_case(const fs::path& path) {
  std::error_code failed;
  const std::string wanted = io::lower_case(path.filename().string());
  std::vector<fs::path> found;
  for (fs::directory_iterator at(path.parent_path(), failed), end; !failed && at != end; at.increment(failed))
    if (io::lower_case(at->path().filename().string()) == wanted && is_file(at->path()))
      found.push_back(at->path());
  if (found.empty()) return std::nullopt;
  return *std::min_element(found.begin(), found.end());
}

}  // namespace

MeshLocation find_mesh(std::string name, const fs::path& folder, std::span<const fs::path> others) {
  std::replace(name.begin(), name.end(), '\\', '/');
  const fs::path file(name);
  MeshLocation found;
  if (file.is_absolute()) {
    found.looked_in = {file};
  } else {
    found.looked_in = {folder / file, folder / "Geometry" / file};
    for (const fs::path& other : others) found.looked_in.push_back(other / file);
  }
  for (const fs::path& path : found.looked_in)
    if (is_file(path)) return {path, {}, false};
  for (const fs::path& path : found.looked_in)
    if (auto other = in_any_case(path)) return {std::move(other), {}, true};
  return found;
}

}  // namespace condyle::io
