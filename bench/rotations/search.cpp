#include <algorithm>

#include "condyle/first_contact.hpp"
#include "rotations/rotation_methods.hpp"

namespace bench {
namespace {

using condyle::TriMesh;
using condyle::Vec3;

/// One triangle, without area where corners repeat: the search then has only the edge or the vertex to find.
TriMesh triangle(const Point& a, const Point& b, const Point& c) {
  TriMesh mesh;
  for (const Point& p : {a, b, c}) mesh.vertices.push_back(Vec3(p.x, p.y, p.z));
  mesh.triangles = {{0, 1, 2}};
  return mesh;
}

}  // namespace

bool meet_by_search(const RotationQuery& query) {
  const auto& [a, b, c, d] = query.points;
  const bool vertex = query.features == RotationQuery::Features::vertex_face;
  const condyle::Mesh mobile(vertex ? triangle(a, a, a) : triangle(a, b, b));
  const condyle::Mesh fixed(vertex ? triangle(b, c, d) : triangle(c, d, d));
  const condyle::motion::FirstContact search(fixed, mobile, condyle::AxisFrame(Vec3::Zero(), Vec3::UnitZ()));
  condyle::motion::RotationRange range;
  range.negative = condyle::Angle();
  range.positive = condyle::Angle::radians(std::min(query.angle, condyle::two_pi));
  const auto limit = search.limits(condyle::Pose::Identity(), range).positive;
  return limit.reason != condyle::motion::LimitReason::end_of_range;
}

}  // namespace bench
