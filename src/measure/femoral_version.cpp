#include "measure/femoral_version.hpp"

#include <cmath>

#include "condyle/error.hpp"
#include "core/formatted.hpp"
#include "core/trigonometry.hpp"
#include "kinematics/bone_sizes.hpp"
#include "kinematics/condylar_line.hpp"
#include "kinematics/find_condyles.hpp"
#include "measure/degree.hpp"
#include "mesh/scale.hpp"

namespace condyle::measure {
namespace {

Vec3 square_to(const Vec3& v, const Vec3& axis) {
  return v - v.dot(axis) * axis;
}

/// By how much -neck is in front of `medial`, both seen along an axis.
double forward_deg(const Vec3& neck, const Vec3& medial, const Vec3& anterior) {
  return core::arctangent(-neck.dot(anterior), -neck.dot(medial)) / degree;
}

}  // namespace

std::string why_no_condyles(const TriMesh& femur, const Sphere& head) {
  const kinematics::FarEnd end = kinematics::far_end(femur, head);
  if (!kinematics::reaches_knee(end, head))
    return core::formatted("the mesh ends above the knee, %.0f mm from the head", end.reach_mm);
  // Condyles are looked for in the sizes of adults: other femora are scaled to one.
  const bool is_adult = kinematics::unit_of_head(head.radius) == LengthUnit::millimetres;
  const double to_adult = is_adult ? 1 : usual_head_radius_mm / head.radius;
  TriMesh adult = femur;
  mesh::scale(adult, to_adult);
  try {
    kinematics::find_condyles(adult, to_adult * end.middle, (head.centre - end.middle).normalized());
    return {};
  } catch (const MeshError& error) {
    return std::string("the mesh shows no condyles: ") + error.what();
  }
}

std::optional<CondyleGeometry> condyle_geometry(const TriMesh& femur, const Sphere& head,
                                                const BodyAxes& axes) {
  const auto line = kinematics::condylar_line(femur, head, axes.anterior, axes.lateral);
  if (!line) return std::nullopt;
  return CondyleGeometry{line->middle, line->first, line->last};
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
