#include "oracle/cgal_oracle.hpp"

#include <CGAL/AABB_traits.h>
#include <CGAL/AABB_tree.h>
#include <CGAL/AABB_triangle_primitive.h>
#include <CGAL/Distance_3/Triangle_3_Triangle_3.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Side_of_triangle_mesh.h>
#include <CGAL/Spatial_sort_traits_adapter_3.h>
#include <CGAL/Surface_mesh.h>
#include <CGAL/hilbert_sort.h>
#include <CGAL/property_map.h>
#include <tbb/enumerable_thread_specific.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <utility>

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

Kernel::Iso_cuboid_3 box_around(const Triangles& triangles, std::size_t first, std::size_t last) {
  CGAL::Bbox_3 box;
  for (std::size_t i = first; i < last; ++i) box += triangles[i].bbox();
  return Kernel::Iso_cuboid_3(box);
}

}  // namespace

TriMesh in_spatial_order(const TriMesh& mesh) {
  using Placed = std::pair<Kernel::Point_3, Triangle>;
  std::vector<Placed> placed;
  for (const Triangle& t : mesh.triangles) placed.emplace_back(point(mesh.vertices[t[0]]), t);
  CGAL::hilbert_sort(placed.begin(), placed.end(),
                     CGAL::Spatial_sort_traits_adapter_3<Kernel, CGAL::First_of_pair_property_map<Placed>>());
  TriMesh sorted = {mesh.vertices, {}};
  for (const auto& [at, t] : placed) sorted.triangles.push_back(t);
  return sorted;
}

struct CgalOracle::Trees {
  explicit Trees(const TriMesh& mesh)
      : surface(surface_mesh(mesh)),
        side(surface),
        triangles(triangles_of(mesh)),
        tree(triangles.begin(), triangles.end()) {
    tree.build();
    side(point(mesh.vertices[0]));  // builds its tree now, before threads ask
  }

  /// visit(number) of the others, on all threads, but for runs of triangles whose box meets none of ours.
  template <class Visit>
  void visit_near(const Triangles& others, const Visit& visit) const {
    constexpr std::size_t run = 32, grain = 8;
    core::parallel_chunks((others.size() + run - 1) / run, grain, [&](std::size_t begin, std::size_t end) {
      for (std::size_t first = run * begin; first < std::min(run * end, others.size()); first += run) {
        const std::size_t last = std::min(first + run, others.size());
        if (!tree.do_intersect(box_around(others, first, last))) continue;
        for (std::size_t i = first; i < last; ++i) visit(i);
      }
    });
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

bool CgalOracle::meets(const TriMesh& other) const {
  const Triangles others = triangles_of(other);
  std::atomic<bool> meets = false;
  trees_->visit_near(others, [&](std::size_t i) {
    if (!meets && trees_->tree.do_intersect(others[i])) meets = true;
  });
  return meets;
}

std::vector<contact::TrianglePair> CgalOracle::pairs(const TriMesh& other) const {
  const Triangles others = triangles_of(other);
  tbb::enumerable_thread_specific<std::vector<contact::TrianglePair>> found;
  trees_->visit_near(others, [&](std::size_t i) {
    std::vector<Triangles::const_iterator> hits;
    trees_->tree.all_intersected_primitives(others[i], std::back_inserter(hits));
    for (const auto& hit : hits) {
      found.local().push_back({static_cast<Index>(hit - trees_->triangles.begin()), static_cast<Index>(i)});
    }
  });
  std::vector<contact::TrianglePair> pairs;
  for (const auto& some : found) pairs.insert(pairs.end(), some.begin(), some.end());
  std::sort(pairs.begin(), pairs.end());
  return pairs;
}

std::vector<double> CgalOracle::distances(PointsView points) const {
  std::vector<double> distances(points.size());
  for (std::size_t i = 0; i < points.size(); ++i)
    distances[i] = std::sqrt(trees_->tree.squared_distance(point(points[i])));
  return distances;
}

double CgalOracle::surface_distance(const TriMesh& other) const {
  double least = min_distance(other.vertices);  // no surface is farther than its vertices
  for (const Kernel::Triangle_3& triangle : triangles_of(other)) {
    const CGAL::Bbox_3 box = triangle.bbox();
    std::vector<Triangles::const_iterator> near;
    trees_->tree.all_intersected_primitives(
        Kernel::Iso_cuboid_3(box.xmin() - least, box.ymin() - least, box.zmin() - least, box.xmax() + least,
                             box.ymax() + least, box.zmax() + least),
        std::back_inserter(near));
    for (const auto& each : near) least = std::min(least, std::sqrt(CGAL::squared_distance(*each, triangle)));
  }
  return least;
}

double CgalOracle::min_distance(PointsView points) const {
  double squared = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < points.size(); ++i) {
    squared = std::min(squared, trees_->tree.squared_distance(point(points[i])));
  }
  return std::sqrt(squared);
}

}  // namespace condyle::test
