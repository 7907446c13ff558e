#pragma once

#include <string>
#include <vector>

#include "condyle/io/mesh_file.hpp"

/// Meshes as the bytes of files, in every way that other programs write them: what the readers are tested on.

namespace condyle::test {

struct MeshBytes {
  std::string name;  ///< "ply binary big-endian, double": for the messages of a failing test.
  io::MeshFormat format;
  bool exact;  ///< Whether the writer wrote every bit of the coordinates, if these are floats.
  std::string bytes;
};

/// Written here, number by number.
std::vector<MeshBytes> stl_files(const TriMesh& mesh);
std::vector<MeshBytes> obj_files(const TriMesh& mesh);
std::vector<MeshBytes> ply_files(const TriMesh& mesh);

/// Written by VTK: XML in every data mode, compressor, length type, byte order and coordinate type; legacy as
/// text and binary, with the cells of version 4.2 and of 5.1.
std::vector<MeshBytes> vtp_files(const TriMesh& mesh);
std::vector<MeshBytes> legacy_vtk_files(const TriMesh& mesh);

/// All of these.
std::vector<MeshBytes> all_files(const TriMesh& mesh);

/// The mesh that VTK's own reader makes of a .vtp or .vtk file.
TriMesh as_vtk_reads(const MeshBytes& file);

}  // namespace condyle::test
