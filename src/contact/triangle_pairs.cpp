#include "contact/triangle_pairs.hpp"

#include <tbb/enumerable_thread_specific.h>

#include <algorithm>

#include "core/parallel.hpp"
#include "mesh/triangle_intersection.hpp"

namespace condyle {
namespace {

constexpr std::size_t triangles_per_chunk = 64;

mesh::TriangleCorners corners_of(const TriMesh& mesh, Index t) {
  return {mesh.corner(t, 0), mesh.corner(t, 1), mesh.corner(t, 2)};
}

struct Box {
  Vec3 low, high;

  explicit Box(const mesh::TriangleCorners& t)
      : low(t[0].cwiseMin(t[1]).cwiseMin(t[2])), high(t[0].cwiseMax(t[1]).cwiseMax(t[2])) {}
  bool meets(const Box& other) const noexcept {
    return (low.array() <= other.high.array()).all() && (other.low.array() <= high.array()).all();
  }
};

/// What one thread gathers. Candidates come once per shared cell: `asked_for` remembers, per fixed triangle,
/// the last mobile triangle that it was tested against.
struct Gathered {
  std::vector<TrianglePair> pairs;
  std::vector<Index> asked_for;
};

}  // namespace

std::vector<TrianglePair> intersecting_pairs(const RadialTable& fixed, const TriMesh& posed_mobile) {
  const TriMesh& fixed_mesh = fixed.mesh();
  tbb::enumerable_thread_specific<Gathered> per_thread([&] {
    return Gathered{{}, std::vector<Index>(fixed_mesh.triangles.size(), no_index)};
  });

  core::parallel_chunks(
      posed_mobile.triangles.size(), triangles_per_chunk, [&](std::size_t first, std::size_t last) {
        Gathered& gathered = per_thread.local();
        for (auto m = static_cast<Index>(first); m < last; ++m) {
          const mesh::TriangleCorners mobile = corners_of(posed_mobile, m);
          const Box mobile_box(mobile);
          fixed.visit_candidates({mobile[0], mobile[1], mobile[2]}, [&](Index f) {
            if (gathered.asked_for[f] == m) return;
            gathered.asked_for[f] = m;
            const mesh::TriangleCorners candidate = corners_of(fixed_mesh, f);
            if (Box(candidate).meets(mobile_box) && mesh::triangles_intersect(candidate, mobile)) {
              gathered.pairs.push_back({f, m});
            }
          });
        }
      });

  std::vector<TrianglePair> pairs;
  for (const auto& gathered : per_thread)
    pairs.insert(pairs.end(), gathered.pairs.begin(), gathered.pairs.end());
  std::sort(pairs.begin(), pairs.end());
  return pairs;
}

}  // namespace condyle
