#include "sample/section.hpp"

#include <algorithm>
#include <map>
#include <utility>

namespace condyle::test {
namespace {

using Edge = std::pair<Index, Index>;

/// The cut through one triangle, from one mesh edge to another, the solid on its left seen against the
/// normal.
struct Segment {
  Vec3 from, to;
  Edge from_edge, to_edge;
};

std::vector<Segment> triangle_cuts(const TriMesh& mesh, const Vec3& normal, double offset) {
  std::vector<Segment> found;
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    Segment cut;
    int ends = 0;
    for (int k = 0; k < 3; ++k) {
      const Vec3 p = mesh.corner(t, k), q = mesh.corner(t, (k + 1) % 3);
      const double above_p = p.dot(normal) - offset, above_q = q.dot(normal) - offset;
      if ((above_p < 0) == (above_q < 0)) continue;
      const Vec3 at = p + above_p / (above_p - above_q) * (q - p);
      const Edge edge = std::minmax(mesh.triangles[t][k], mesh.triangles[t][(k + 1) % 3]);
      // Counter-clockwise corners seen from outside leave the half above the plane where the cut starts.
      if (above_p < 0) {
        cut.to = at, cut.to_edge = edge;
      } else {
        cut.from = at, cut.from_edge = edge;
      }
      ++ends;
    }
    if (ends == 2) found.push_back(cut);
  }
  return found;
}

}  // namespace

std::vector<SectionLoop> section(const TriMesh& mesh, const Vec3& normal, double offset) {
  const auto segments = triangle_cuts(mesh, normal, offset);
  std::map<Edge, std::size_t> starting_at;
  for (std::size_t i = 0; i < segments.size(); ++i) starting_at[segments[i].from_edge] = i;

  std::vector<SectionLoop> loops;
  std::vector<bool> used(segments.size());
  for (std::size_t first = 0; first < segments.size(); ++first) {
    if (used[first]) continue;
    // Twice the area and its moment: triangles between the loop's segments and a point of the plane.
    const Vec3 base = segments[first].from;
    double area = 0;
    Vec3 moment = Vec3::Zero();
    for (std::size_t i = first; !used[i]; i = starting_at.at(segments[i].to_edge)) {
      used[i] = true;
      const double twice = (segments[i].from - base).cross(segments[i].to - base).dot(normal);
      area += twice / 2;
      moment += twice / 2 * (base + segments[i].from + segments[i].to) / 3;
    }
    loops.push_back({area, moment / area});
  }
  return loops;
}

SectionLoop section_near(const TriMesh& mesh, const Vec3& normal, const Vec3& p) {
  const auto loops = section(mesh, normal, p.dot(normal));
  return *std::min_element(loops.begin(), loops.end(), [&](const SectionLoop& a, const SectionLoop& b) {
    return (a.centroid - p).squaredNorm() < (b.centroid - p).squaredNorm();
  });
}

}  // namespace condyle::test
