#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "condyle/inspect.hpp"
#include "condyle/io/joint_file.hpp"

/// Reports as text for people and as JSON for programs, whole documents that end with a newline. Keys of the
/// JSON are listed in docs/joint-file.md and docs/formats.md.

namespace condyle {

/// One inspected mesh file.
struct MeshInspection {
  std::filesystem::path path;
  std::size_t welded_vertices;  ///< corners of an STL file that became one vertex
  std::vector<RepairDone> repairs;
  MeshReport report;
};
std::string to_text(std::span<const MeshInspection> meshes);
std::string to_json(std::span<const MeshInspection> meshes);

std::string to_text(const LoadedJoint& joint);
std::string to_json(const LoadedJoint& joint);

}  // namespace condyle
