#pragma once

#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace condyle::io {

/// Where a mesh of a model was found, or was looked for.
struct MeshLocation {
  std::optional<std::filesystem::path> path;
  std::vector<std::filesystem::path> looked_in;
  bool in_another_case = false;  ///< found by a name whose letters are of another case
};

/// Looks for a file as a model names it, \ for / too: itself if its path is absolute, else in the folder, in its Geometry
/// (geometry, if there is no other), and in the other folders, in this order; then once more in any case of letters, of folders
/// in its name too.
MeshLocation find_mesh(std::string name, const std::filesystem::path& folder,
                       std::span<const std::filesystem::path> others);

}  // namespace condyle::io
