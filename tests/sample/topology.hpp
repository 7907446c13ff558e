#pragma once

#include <vector>

#include "condyle/mesh.hpp"

namespace condyle::test {

/// Basic checks of a mesh before any other test; every count is plain and independent of the library.
struct Topology {
  bool is_closed_and_consistent;  ///< every directed edge once, and once in the other direction
  bool has_manifold_vertices;     ///< the triangles at each vertex form one ring
  int components;
  int genus;             ///< of a closed connected mesh
  double signed_volume;  ///< positive when wound outwards
};
Topology topology(const TriMesh& mesh);

/// One closed manifold of this genus, wound outwards.
void expect_sound(const TriMesh& mesh, int genus);

/// The smallest angle of every triangle in degrees, ascending.
std::vector<double> smallest_angles_deg(const TriMesh& mesh);

}  // namespace condyle::test
