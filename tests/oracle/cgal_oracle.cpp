#include "oracle/cgal_oracle.hpp"

#include <CGAL/AABB_traits.h>
#include <CGAL/AABB_tree.h>
#include <CGAL/AABB_triangle_primitive.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Side_of_triangle_mesh.h>
#include <CGAL/Surface_mesh.h>
#include <tbb/enumerable_thread_specific.h>

#include <algorithm>
#include <cmath>

#include "core/parallel.hpp"

namespace condyle::test {
namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using CgalMesh = CGAL::Surface_mesh<Kernel::Point_3>;
using Triangles = std::vector<Kernel::Triangle_3>;
using Tree = CGAL::AABB_tree<
    CGAL::AABB_traits<Kernel, CGAL::AABB_triangle_primitive<Kernel, Triangles::const_iterator>>>;

Kernel::Point_3 point(const Vec3& p) {
  return {p.x(), p.y(), p.z()};
}

Triangles triangles_of(const TriMesh& mesh) {
  Triangles triangles;
  for (Index t = 0; t < mesh.triangles.size(); ++t) {
    triangles.emplace_back(point(mesh.corner(t, 0)), point(mesh.corner(t, 1)), point(mesh.corner(t, 2)));
  }
  return triangles;
}

CgalMesh surface_mesh(const TriMesh& mesh) {
  CgalMesh out;
  std::vector<CgalMesh::Vertex_index> vertex;
  for (std::size_t i = 0; i < mesh.vertices.size(); ++i)
    vertex.push_back(out.add_vertex(point(mesh.vertices[i])));
  for (const auto& [a, b, c] : mesh.triangles) out.add_face(vertex[a], vertex[b], vertex[c]);
  return out;
}

}  // namespace

struct CgalOracle::Trees {
  explicit Trees(const TriMesh& mesh)
      : surface(surface_mesh(mesh)),
        side(surface),
        triangles(triangles_of(mesh)),
        tree(triangles.begin(), triangles.end()) {
    tree.build();
    side(point(mesh.vertices[0]));  // builds its tree now, before threads ask
  }

  CgalMesh surface;
  CGAL::Side_of_triangle_mesh<CgalMesh, Kernel> side;
  Triangles triangles;
  Tree tree;
};

CgalOracle::CgalOracle(const TriMesh& mesh) : trees_(std::make_unique<Trees>(mesh)) {}
CgalOracle::~CgalOracle() = default;
CgalOracle::CgalOracle(CgalOracle&&) noexcept = default;

std::vector<PointState> CgalOracle::states(PointsView points) const {
  std::vector<PointState> states(points.size());
  core::parallel_chunks(points.size(), 256, [&](std::size_t first, std::size_t last) {
    for (std::size_t i = first; i < last; ++i) {
      const CGAL::Bounded_side side = trees_->side(point(points[i]));
      states[i] = side == CGAL::ON_BOUNDED_SIDE ? PointState::inside
                  : side == CGAL::ON_BOUNDARY   ? PointState::on_surface
                                                : PointState::outside;
    }
  });
  return states;
}

std::vector<TrianglePair> CgalOracle::pairs(const TriMesh& other) const {
  const Triangles others = triangles_of(other);
  tbb::enumerable_thread_specific<std::vector<TrianglePair>> found;
  core::parallel_chunks(others.size(), 256, [&](std::size_t first, std::size_t last) {
    std::vector<Triangles::const_iterator> hits;
    auto& mine = found.local();
    for (std::size_t i = first; i < last; ++i) {
      hits.clear();
      trees_->tree.all_intersected_primitives(others[i], std::back_inserter(hits));
      for (const auto& hit : hits) {
        mine.push_back({static_cast<Index>(hit - trees_->triangles.begin()), static_cast<Index>(i)});
      }
    }
  });
  std::vector<TrianglePair> pairs;
  for (const auto& some : found) pairs.insert(pairs.end(), some.begin(), some.end());
  std::sort(pairs.begin(), pairs.end());
  return pairs;
}

double CgalOracle::min_distance(PointsView points) const {
  double squared = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < points.size(); ++i) {
    squared = std::min(squared, trees_->tree.squared_distance(point(points[i])));
  }
  return std::sqrt(squared);
}

}  // namespace condyle::test
