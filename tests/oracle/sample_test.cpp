#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Polygon_mesh_processing/self_intersections.h>
#include <CGAL/Surface_mesh.h>

#include "condyle/sample/hip.hpp"
#include "sample/self_intersection.hpp"
#include "support/test.hpp"

namespace condyle {
namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using CgalMesh = CGAL::Surface_mesh<Kernel::Point_3>;
using Pair = std::pair<Index, Index>;

CgalMesh to_cgal(const TriMesh& mesh) {
  CgalMesh other;
  std::vector<CgalMesh::Vertex_index> vertex;
  for (std::size_t v = 0; v < mesh.vertices.size(); ++v) {
    vertex.push_back(other.add_vertex({mesh.vertices.x[v], mesh.vertices.y[v], mesh.vertices.z[v]}));
  }
  for (const auto& [a, b, c] : mesh.triangles) other.add_face(vertex[a], vertex[b], vertex[c]);
  return other;
}

std::optional<Pair> first_by_cgal(const TriMesh& mesh) {
  const CgalMesh other = to_cgal(mesh);
  std::vector<std::pair<CgalMesh::Face_index, CgalMesh::Face_index>> pairs;
  CGAL::Polygon_mesh_processing::self_intersections(other, std::back_inserter(pairs));
  std::optional<Pair> first;
  for (const auto& [s, t] : pairs) {
    const Pair pair = std::minmax<Index>(s, t);
    first = std::min(first.value_or(pair), pair);
  }
  return first;
}

TEST(SampleOracle, NoScenarioOfTheSampleHipRunsIntoItselfByCgal) {
  for (const sample::Scenario scenario :
       {sample::Scenario::one, sample::Scenario::two, sample::Scenario::three, sample::Scenario::four}) {
    const sample::SampleHip hip = sample::sample_hip({}, scenario);
    EXPECT_EQ(first_by_cgal(hip.femur), std::nullopt);
    EXPECT_EQ(first_by_cgal(hip.hip_bone), std::nullopt);
  }
}

TEST(SampleOracle, FirstSelfIntersectionOfShakenMeshesIsThatOfCgal) {
  const sample::SampleHip hip = sample::sample_hip({}, sample::Scenario::one);
  std::mt19937 random(2);
  int clean = 0, broken = 0;
  for (int round = 0; round < 60; ++round) {
    // From a shake that breaks nothing to one that breaks a lot.
    const double amplitude_mm = 0.1 * round;
    std::uniform_real_distribution<double> shake(-amplitude_mm, amplitude_mm);
    TriMesh mesh = round % 2 ? hip.femur : hip.hip_bone;
    for (std::size_t v = 0; v < mesh.vertices.size(); ++v) {
      mesh.vertices.set(v, mesh.vertices[v] + Vec3(shake(random), shake(random), shake(random)));
    }
    const auto expected = first_by_cgal(mesh);
    EXPECT_EQ(sample::first_self_intersection(mesh), expected) << round;
    ++(expected ? broken : clean);
  }
  EXPECT_GT(clean, 5);
  EXPECT_GT(broken, 20);
}

}  // namespace
}  // namespace condyle
