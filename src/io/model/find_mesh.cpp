#include "io/model/find_mesh.hpp"

#include <algorithm>

#include "io/file/input_file.hpp"

namespace condyle::io {
namespace {

namespace fs = std::filesystem;

bool is_file(const fs::path& path) {
  return entry_at(path) == EntryKind::file;
}

/// What lies in a folder under a name, its own before the same in other cases of letters, these in their order.
std::vector<fs::path> named_in(const fs::path& folder, const std::string& name) {
  std::vector<fs::path> found;
  for (const std::string& own : names_like(folder, name))
    if (own != name) found.push_back(folder / own);
  if (entry_at(folder / name) != EntryKind::none) found.insert(found.begin(), folder / name);
  return found;
}

/// The first file at that path from the folder, its names in any case of letters.
std::optional<fs::path> in_any_case(const fs::path& folder, const fs::path& file) {
  if (file.empty()) return std::nullopt;
  fs::path rest;
  for (auto part = std::next(file.begin()); part != file.end(); ++part) rest /= *part;
  for (const fs::path& found : named_in(folder, file.begin()->string())) {
    if (rest.empty() && is_file(found)) return found;
    if (rest.empty()) continue;
    if (auto deeper = in_any_case(found, rest)) return deeper;
  }
  return std::nullopt;
}

/// The model's folder Geometry, as Windows would find it.
fs::path geometry_in(const fs::path& folder) {
  if (fs::path usual = folder / "Geometry"; entry_at(usual) == EntryKind::folder) return usual;
  const std::vector<fs::path> found = named_in(folder, "Geometry");
  return found.empty() ? folder / "Geometry" : found.front();
}

}  // namespace

MeshLocation find_mesh(std::string name, const fs::path& folder, std::span<const fs::path> others) {
  std::replace(name.begin(), name.end(), '\\', '/');
  const fs::path file(name);
  if (file.is_absolute()) {
    if (is_file(file)) return {file, {}, false};
    if (auto other = in_any_case(file.parent_path(), file.filename())) return {std::move(other), {}, true};
    return {{}, {file}, false};
  }
  std::vector<fs::path> places{folder, geometry_in(folder)};
  places.insert(places.end(), others.begin(), others.end());
  MeshLocation found;
  for (const fs::path& place : places) found.looked_in.push_back(place / file);
  for (const fs::path& path : found.looked_in)
    if (is_file(path)) return {path, {}, false};
  places[1] = folder;  // Geometry too in any case
  for (std::size_t i = 0; i < places.size(); ++i)
    if (auto other = in_any_case(places[i], i == 1 ? "Geometry" / file : file))
      return {std::move(other), {}, true};
  return found;
}

}  // namespace condyle::io
