#include "measure/centre_edge.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "core/trigonometry.hpp"
#include "measure/axis_sections.hpp"
#include "measure/degree.hpp"
#include "measure/rim.hpp"

namespace condyle::measure {
namespace {

/// Wall that is interrupted by less goes on: a fold of a rough surface faces away over so much.
constexpr double widest_fold = 2 * degree;
/// A roof that ends farther to the other side is none.
constexpr double farthest_behind = 60 * degree;

/// Angles from superior that the wall covers, and the place of the larger one.
struct CoveredArc {
  double begin, end;
  Vec2 at_end;
  bool mesh_ends;
};

std::vector<CoveredArc> seen(const Contour& section, double reach) {
  std::vector<CoveredArc> out;
  for (ContourPiece piece : section) {
    if (!clip_to_circle(piece, Vec2::Zero(), reach)) continue;
    const double a = core::arctangent(piece.from.y(), piece.from.x()),
                 b = core::arctangent(piece.to.y(), piece.to.x());
    if (std::abs(a - b) > std::numbers::pi) continue;  // straight below: no roof
    out.push_back(a < b ? CoveredArc{a, b, piece.to, piece.to_end}
                        : CoveredArc{b, a, piece.from, piece.from_end});
  }
  std::sort(out.begin(), out.end(),
            [](const CoveredArc& a, const CoveredArc& b) { return a.begin < b.begin; });
  return out;
}

}  // namespace

CentreEdgeFinding centre_edge(const SocketWall& wall, const Sphere& head, const Vec3& superior,
                              const Vec3& direction) {
  const AxisSections sections(wall.mesh, head.centre, superior, direction, superior.cross(direction),
                              wall.ends);
  std::optional<CoveredArc> roof;
  for (const CoveredArc& next : seen(sections.at(0), head.radius + by_head(farthest_wall_mm, head))) {
    if (roof && next.begin <= roof->end + widest_fold) {
      if (next.end > roof->end) roof = CoveredArc{roof->begin, next.end, next.at_end, next.mesh_ends};
      continue;
    }
    if (next.begin > 0) break;
    roof = next;
  }
  if (!roof || roof->end < -farthest_behind) return {{}, "no roof is above the head in this plane"};
  if (roof->mesh_ends) return {{}, "the mesh ends where the roof goes on"};
  return {CentreEdge{roof->end / degree, sections.point(0, roof->at_end)}, {}};
}

}  // namespace condyle::measure
