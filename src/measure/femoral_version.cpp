#include "measure/femoral_version.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "condyle/error.hpp"
#include "core/formatted.hpp"
#include "kinematics/corners.hpp"
#include "kinematics/find_condyles.hpp"
#include "kinematics/hip_anatomy.hpp"
#include "measure/degree.hpp"

namespace condyle::measure {
namespace {

/// In radii of the head: a whole femur has 17, one cut above its condyles at most 14.
constexpr double shortest_femur = 10;
/// The end of the bone that is evaluated, mm.
constexpr double condyle_height = 45;
/// Cosine of the 60 degrees within which a line faces back.
constexpr double least_facing = 0.5;
/// mm: the backs of two condyles are farther apart.
constexpr double least_width = 20;

/// The last 45 mm of a bone along the line from a point to the centroid, by area, of these 45 mm.
struct BoneEnd {
  Vec3 middle;
  double reach;  ///< along the line
};

BoneEnd end_of(const TriMesh& bone, const Vec3& from) {
  constexpr int rounds = 5;  // the line moves by less than 0.01 degrees in the last
  BoneEnd end{kinematics::area_centroid(bone), 0};
  for (int round = 0; round < rounds; ++round) {
    const Vec3 down = (end.middle - from).normalized();
    end.reach = 0;
    kinematics::for_each_corner(
        bone, [&](const Vec3& p) { end.reach = std::max(end.reach, (p - from).dot(down)); });
    TriMesh last{bone.vertices, {}};
    for (std::size_t t = 0; t < bone.triangles.size(); ++t)
      if (((bone.corner(t, 0) + bone.corner(t, 1) + bone.corner(t, 2)) / 3 - from).dot(down) >
          end.reach - condyle_height)
        last.triangles.push_back(bone.triangles[t]);
    end.middle = kinematics::area_centroid(last);
  }
  return end;
}

struct ViewFromBelow {
  double x, y;  ///< medial to lateral in some sense; anterior
  Index vertex;
};

double turn(const ViewFromBelow& o, const ViewFromBelow& a, const ViewFromBelow& b) {
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
      while (outline.size() >= first + 2 && !(turn(outline[outline.size() - 2], outline.back(), p) > 0))
        outline.pop_back();
      outline.push_back(p);
    }
    outline.pop_back();
    if (pass == 0) std::reverse(points.begin(), points.end());
  }
  return outline;
}

Vec3 square_to(const Vec3& v, const Vec3& axis) {
  return v - v.dot(axis) * axis;
}

/// By how much -neck is in front of `medial`, both seen along an axis.
double forward_deg(const Vec3& neck, const Vec3& medial, const Vec3& anterior) {
  return std::atan2(-neck.dot(anterior), -neck.dot(medial)) / degree;
}

}  // namespace

std::string why_no_condyles(const TriMesh& femur, const Sphere& head) {
  const BoneEnd end = end_of(femur, head.centre);
  if (!(end.reach >= shortest_femur * head.radius))
    return core::formatted("the mesh ends above the knee, %.0f mm from the head", end.reach);
  try {
    kinematics::find_condyles(femur, end.middle, (head.centre - end.middle).normalized());
    return {};
  } catch (const MeshError& error) {
    return std::string("the mesh shows no condyles: ") + error.what();
  }
}

std::optional<CondyleGeometry> condyle_geometry(const TriMesh& femur, const Sphere& head,
                                                const BodyAxes& axes) {
  const auto [middle, reach] = end_of(femur, head.centre);
  const Vec3 down = (middle - head.centre).normalized();
  const Vec3 front = square_to(axes.anterior, down).normalized(), side = front.cross(down);
  std::vector<ViewFromBelow> points;
  for (const Triangle& t : femur.triangles)
    for (const Index v : t) {
      const Vec3 p = femur.vertices[v] - head.centre;
      if (p.dot(down) > reach - condyle_height) points.push_back({p.dot(side), p.dot(front), v});
    }
  const auto outline = convex_outline(std::move(points));
  std::optional<std::array<Index, 2>> found;
  double longest = least_width;
  for (std::size_t i = 0; i < outline.size(); ++i) {
    const ViewFromBelow &a = outline[i], &b = outline[(i + 1) % outline.size()];
    // Counter-clockwise, so that outwards is (dy, -dx).
    const double dx = b.x - a.x, dy = b.y - a.y, length = std::hypot(dx, dy);
    if (dx < least_facing * length || length <= longest) continue;
    longest = length, found = {a.vertex, b.vertex};
  }
  if (!found) return std::nullopt;
  Vec3 medial = femur.vertices[(*found)[0]], lateral = femur.vertices[(*found)[1]];
  if ((lateral - medial).dot(axes.lateral) < 0) std::swap(medial, lateral);
  return CondyleGeometry{middle, medial, lateral};
}

double femoral_version_deg(const CondyleGeometry& condyles, const Sphere& head, const Vec3& neck) {
  const Vec3 down = (condyles.middle - head.centre).normalized();
  const Vec3 medial = square_to(condyles.medial - condyles.lateral, down).normalized();
  Vec3 front = down.cross(medial);
  // Behind the middle lies the line.
  if (front.dot(condyles.middle - condyles.medial) < 0) front = -front;
  return forward_deg(neck, medial, front);
}

double torsion_deg(const Vec3& neck, const Vec3& down, const BodyAxes& axes) {
  const Vec3 medial = -square_to(axes.lateral, down).normalized();
  Vec3 front = down.cross(medial);
  if (front.dot(axes.anterior) < 0) front = -front;
  return forward_deg(neck, medial, front);
}

}  // namespace condyle::measure
