#include "kinematics/condylar_line.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>
#include <vector>

#include "core/trigonometry.hpp"
#include "kinematics/hip_anatomy.hpp"

namespace condyle::kinematics {
namespace {

// Lengths are in radii of the head, so that children and animals have condyles too.

/// A whole femur has 17, one cut above its condyles at most 14.
constexpr double shortest_femur = 10;
/// 45 mm where the head has 24: the condyles, and little of the shaft.
constexpr double end_height = 1.875;
/// Cosine of the 60 degrees within which a line faces back.
constexpr double least_back_facing = 0.5;
/// The backs of two condyles are farther apart: edges of a shaft's outline are shorter.
constexpr double least_edge = 0.8;
/// Between the backs of two condyles: 2.1 on the Visible Human's femur.
constexpr double least_apart = 1.4, largest_apart = 3;
/// As a share of that width: 0.26 on the Visible Human's femur, 0.1 and less behind the flare above condyles.
constexpr double least_hollow = 0.15;
/// Half of the part of the line in which the notch is looked for.
constexpr double half_of_middle = 0.1;

struct ViewFromBelow {
  double x, y;  ///< medial to lateral in some sense; anterior
  Index vertex;
};

double cross_of(const ViewFromBelow& o, const ViewFromBelow& a, const ViewFromBelow& b) {
  return (a.x - o.x) * (b.y - o.y) - (a.y - o.y) * (b.x - o.x);
}

/// Counter-clockwise (Andrew 1979).
std::vector<ViewFromBelow> convex_outline(std::vector<ViewFromBelow> points) {
  std::sort(points.begin(), points.end(), [](const ViewFromBelow& a, const ViewFromBelow& b) {
    return a.x != b.x ? a.x < b.x : a.y < b.y;
  });
  std::vector<ViewFromBelow> outline;
  for (const int pass : {0, 1}) {
    const std::size_t first = outline.size();
    for (const ViewFromBelow& p : points) {
      while (outline.size() >= first + 2 && !(cross_of(outline[outline.size() - 2], outline.back(), p) > 0))
        outline.pop_back();
      outline.push_back(p);
    }
    outline.pop_back();
    if (pass == 0) std::reverse(points.begin(), points.end());
  }
  return outline;
}

/// A mark for each vertex that a triangle uses.
std::vector<char> used_vertices(const TriMesh& mesh) {
  std::vector<char> marks(mesh.vertices.size());
  for (const Triangle& t : mesh.triangles)
    for (const Index v : t) marks[v] = 1;
  return marks;
}

/// The corners of the far end, each as often as triangles have it.
std::vector<ViewFromBelow> seen_from_below(const TriMesh& femur, const Sphere& head, const FarEnd& end,
                                           const Vec3& anterior) {
  const Vec3 down = (end.middle - head.centre).normalized();
  const Vec3 front = (anterior - anterior.dot(down) * down).normalized(), side = front.cross(down);
  std::vector<ViewFromBelow> points;
  for (const Triangle& t : femur.triangles)
    for (const Index v : t) {
      const Vec3 p = femur.vertices[v] - head.centre;
      if (p.dot(down) > end.reach_mm - end.height_mm) points.push_back({p.dot(side), p.dot(front), v});
    }
  return points;
}

/// How far in front of an edge of their outline the points lie in its middle; infinite if none does.
double notch_behind(const std::vector<ViewFromBelow>& points, const ViewFromBelow& a,
                    const ViewFromBelow& b) {
  const double length = core::hypotenuse(b.x - a.x, b.y - a.y);
  double least = std::numeric_limits<double>::infinity();
  for (const ViewFromBelow& p : points) {
    const double along = ((p.x - a.x) * (b.x - a.x) + (p.y - a.y) * (b.y - a.y)) / (length * length);
    if (std::abs(along - 0.5) <= half_of_middle) least = std::min(least, cross_of(a, b, p) / length);
  }
  return least;
}

/// Triangles whose middle lies beyond a height along a direction.
std::vector<Index> triangles_beyond(const TriMesh& mesh, const Vec3& from, const Vec3& direction,
                                    double height) {
  std::vector<Index> found;
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t)
    if (((mesh.corner(t, 0) + mesh.corner(t, 1) + mesh.corner(t, 2)) / 3 - from).dot(direction) > height)
      found.push_back(static_cast<Index>(t));
  return found;
}

}  // namespace

FarEnd far_end(const TriMesh& femur, const Sphere& head) {
  constexpr int rounds = 5;  // the line moves by less than 0.01 degrees in the last
  std::vector<Vec3> corners;
  for (std::size_t v = 0; const char is_used : used_vertices(femur)) {
    if (is_used) corners.push_back(femur.vertices[v]);
    ++v;
  }
  FarEnd end{area_centroid(femur), 0, end_height * head.radius};
  // The end's triangles, and as many again above it: the line turns little once it goes there.
  constexpr double least_cosine_of_list = 0.995;
  Vec3 listed_along = Vec3::Zero();
  std::vector<Index> listed;
  for (int round = 0; round < rounds; ++round) {
    const Vec3 down = (end.middle - head.centre).normalized();
    end.reach_mm = 0;
    for (const Vec3& p : corners) end.reach_mm = std::max(end.reach_mm, (p - head.centre).dot(down));
    if (listed_along.dot(down) < least_cosine_of_list) {
      listed_along = down;
      listed = triangles_beyond(femur, head.centre, down, end.reach_mm - 3 * end.height_mm);
    }
    Vec3 moment = Vec3::Zero();
    double area = 0;
    for (const Index t : listed) {
      const Vec3 a = femur.corner(t, 0), b = femur.corner(t, 1), c = femur.corner(t, 2);
      const Vec3 middle = (a + b + c) / 3;
      if (!((middle - head.centre).dot(down) > end.reach_mm - end.height_mm)) continue;
      const double size = (b - a).cross(c - a).norm() / 2;
      area += size;
      moment += size * middle;
    }
    if (!(area > 0)) return {end.middle, 0, end.height_mm};
    end.middle = moment / area;
  }
  return end;
}

bool reaches_knee(const FarEnd& end, const Sphere& head) noexcept {
  return end.reach_mm >= shortest_femur * head.radius;
}

bool may_reach_knee(const TriMesh& femur, const Sphere& head) noexcept {
  const double reach = shortest_femur * head.radius;
  for (std::size_t v = 0; v < femur.vertices.size(); ++v)
    if ((femur.vertices[v] - head.centre).squaredNorm() >= reach * reach) return true;
  return false;
}

std::optional<CondylarLine> condylar_line(const TriMesh& femur, const Sphere& head, const Vec3& anterior,
                                          const Vec3& along) {
  const FarEnd end = far_end(femur, head);
  if (!reaches_knee(end, head)) return std::nullopt;
  const std::vector<ViewFromBelow> points = seen_from_below(femur, head, end, anterior);
  const std::vector<ViewFromBelow> outline = convex_outline(points);
  std::optional<std::array<ViewFromBelow, 2>> found;
  double longest = least_edge * head.radius;
  for (std::size_t i = 0; i < outline.size(); ++i) {
    const ViewFromBelow &a = outline[i], &b = outline[(i + 1) % outline.size()];
    // Counter-clockwise, so that outwards is (dy, -dx).
    const double dx = b.x - a.x, length = core::hypotenuse(dx, b.y - a.y);
    if (dx < least_back_facing * length || length <= longest) continue;
    longest = length, found = {a, b};
  }
  if (!found) return std::nullopt;
  const auto& [a, b] = *found;
  Vec3 first = femur.vertices[a.vertex], last = femur.vertices[b.vertex];
  if ((last - first).dot(along) < 0) std::swap(first, last);
  return CondylarLine{end.middle, first, last, longest, notch_behind(points, a, b)};
}

bool touches_condyles(const CondylarLine& line, const Sphere& head) noexcept {
  return line.width_mm >= least_apart * head.radius && line.width_mm <= largest_apart * head.radius &&
         line.notch_mm >= least_hollow * line.width_mm;
}

}  // namespace condyle::kinematics
