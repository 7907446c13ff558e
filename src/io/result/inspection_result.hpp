#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "condyle/inspect.hpp"
#include "condyle/io/mesh_file.hpp"

/// Results of `condyle inspect`. Keys of the JSON are listed in docs/mesh-files.md.

namespace condyle::io {

/// One inspected mesh file.
struct MeshInspection {
  std::filesystem::path path;
  FileDigest digest;
  std::size_t welded_vertices;  ///< duplicate corners of an STL file that were merged
  std::size_t split_polygons;
  std::size_t guessed_polygons;  ///< of these, as MeshFile has it
  double guessed_within;         ///< likewise
  std::vector<RepairDone> repairs;
  MeshReport report;  ///< after the repairs
};

struct InspectedMesh {
  TriMesh mesh;  ///< as read and repaired
  MeshInspection inspection;
};

/// Reads a mesh, makes the repairs in their order and inspects what came of it. Throws FileError, and
/// MeshError if a repair cannot be made.
InspectedMesh inspect_file(const std::filesystem::path& path, const std::vector<Repair>& repairs,
                           PolygonRule polygons = PolygonRule::refuse);

/// For people, and for programs: whole documents that end with a newline. `command`: the command line word by word, without
/// the program; empty if there is none.
std::string to_text(std::span<const MeshInspection> meshes);
std::string inspection_json(std::span<const MeshInspection> meshes,
                            const std::vector<std::string>& command = {});

}  // namespace condyle::io
