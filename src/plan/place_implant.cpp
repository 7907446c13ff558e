#include "plan/place_implant.hpp"

#include <algorithm>
#include <array>
#include <limits>
#include <utility>

#include "condyle/error.hpp"
#include "core/one_line.hpp"
#include "mesh/cut_mesh.hpp"
#include "mesh/surface_distance.hpp"
#include "plan/joined_body.hpp"
#include "plan/planned.hpp"

namespace condyle::plan {
namespace {

bool is_bone(const BodyPart& part) {
  return part.contact == PartContact::ends;
}

/// A bone called as a mesh of the implant would be taken for it.
std::string bone_name(const std::string& name) {
  return is_implant_mesh(name) ? name + " bone" : name;
}

/// The meshes of a body that are bones.
std::vector<ImplantMesh> bones_of(const Body& body) {
  if (body.parts.empty()) return {{bone_name(body.name), body.mesh.arrays()}};
  std::vector<ImplantMesh> bones;
  for (const BodyPart& part : body.parts)
    if (is_bone(part)) bones.push_back({bone_name(part.name), mesh_of_part(body, part.name).arrays()});
  if (bones.empty())
    throw UsageError("implant: " + core::one_line(body.name) +
                     " has meshes called bearing or soft only: its bone is needed");
  return bones;
}

std::vector<std::string> meshes_left_out(const Joint& joint) {
  std::vector<std::string> names;
  for (const Body* body : {&joint.fixed, &joint.mobile})
    for (const BodyPart& part : body->parts)
      if (!is_bone(part)) names.push_back(part.name);
  return names;
}

void move(std::vector<ImplantMesh>& bones, const Vec3& by) {
  for (ImplantMesh& bone : bones)
    for (std::size_t v = 0; v < bone.mesh.vertices.size(); ++v)
      bone.mesh.vertices.set(v, bone.mesh.vertices[v] + by);
}

std::optional<BodyImage> moved(std::optional<BodyImage> image, const Vec3& by) {
  if (image)
    for (ImageCut& cut : image->cuts) cut.offset_mm += cut.normal.dot(by);
  return image;
}

std::size_t vertices_within(const TriMesh& mesh, const Sphere& sphere) {
  std::size_t count = 0;
  for (std::size_t v = 0; v < mesh.vertices.size(); ++v)
    count += (mesh.vertices[v] - sphere.centre).norm() < sphere.radius;
  return count;
}

/// The bone that has most vertices around the head.
ImplantMesh& bone_with(std::vector<ImplantMesh>& bones, const Sphere& head) {
  constexpr double around = 1.1;  // in radii: the surface of the head lies on its sphere, inside and outside
  const Sphere ball{head.centre, around * head.radius};
  return *std::max_element(bones.begin(), bones.end(), [&](const ImplantMesh& a, const ImplantMesh& b) {
    return vertices_within(a.mesh, ball) < vertices_within(b.mesh, ball);
  });
}

mesh::CutMesh cut_across(const ImplantMesh& bone, const NeckCut& cut) {
  const std::array planes{mesh::CuttingPlane{cut.offset_mm * cut.normal, cut.normal}};
  try {
    return mesh::cut_by_planes(Mesh(bone.mesh), core::one_line(bone.part), planes);
  } catch (const UsageError& error) {
    throw UsageError("implant: the neck cannot be cut across where neck and stem meet: " +
                     std::string(error.what()));
  }
}

/// Pieces beside the largest stay: of a mesh with the wall of its marrow, much of the head.
void require_no_head(const ImplantMesh& bone, const Sphere& head, const NeckCut& cut) {
  for (std::size_t v = 0; v < bone.mesh.vertices.size(); ++v) {
    const Vec3 p = bone.mesh.vertices[v];
    const double short_of_plane = cut.offset_mm - cut.normal.dot(p);
    if (short_of_plane > mesh::on_plane_mm && (p - head.centre).norm() < head.radius)
      throw UsageError("implant: the cut across the neck leaves bone of the head of " +
                       core::one_line(bone.part) + ", in another piece of its mesh");
  }
}

/// Cuts the head off, and gives its volume, mm^3.
double cut_head_off(std::vector<ImplantMesh>& bones, const Sphere& head, const NeckCut& cut) {
  ImplantMesh& bone = bone_with(bones, head);
  mesh::CutMesh sides = cut_across(bone, cut);
  bone.mesh = std::move(sides.outer.mesh);
  require_no_head(bone, head, cut);
  return sides.inner_mm3;
}

/// Where the stem points, as implant_meshes() takes it: of a right joint.
Vec3 stem_down(const PlacedBy& by, Side side) {
  if (!by.shaft) return -Vec3::UnitY();
  Vec3 down = by.shaft->down;
  if (side == Side::left) down.z() = -down.z();
  return down;
}

Vec3 shift_of(const TotalHip& hip, const PlacedBy& by, const NeckCut& cut) {
  if (!by.shaft) return {0, -hip.leg_length_mm, 0};
  return femur_shift({by.shaft->point - by.centre, by.shaft->down}, hip, cut);
}

void append(std::vector<ImplantMesh>& bones, std::vector<ImplantMesh>&& implant) {
  std::move(implant.begin(), implant.end(), std::back_inserter(bones));
}

}  // namespace

Vec3 femur_shift(const ShaftLine& shaft, const TotalHip& hip, const NeckCut& cut) noexcept {
  const Vec3 to_stem = cut.stem_axis_point - shaft.point;
  return to_stem - (to_stem.y() + hip.leg_length_mm) / shaft.down.y() * shaft.down;
}

double nearest_along(const Vec3& point, const Vec3& direction, const ShaftLine& other) noexcept {
  const double cosine = direction.dot(other.down);
  const Vec3 between = other.point - point;
  return (between.dot(direction) - cosine * between.dot(other.down)) / ((1 - cosine) * (1 + cosine));
}

double distance_to_bone(const Joint& joint, const Vec3& point) {
  double nearest = std::numeric_limits<double>::infinity();
  for (const ImplantMesh& bone : bones_of(joint.fixed))
    if (!bone.mesh.triangles.empty()) nearest = std::min(nearest, mesh::SurfaceDistance(bone.mesh)(point));
  return nearest;
}

PlacedHip place_total_hip(const TotalHip& hip, const Joint& joint, const PlacedBy& by) {
  if (!joint.ligaments.empty())
    throw UsageError("implant: the joint has ligaments, and which of them an operation leaves is not known");
  const Side side = joint.side;
  const NeckCut cut = neck_cut(hip, side);
  const Vec3 shift = shift_of(hip, by, cut), of_femur = shift - by.centre;
  ImplantMeshes implant = implant_meshes(hip, side, stem_down(by, side));
  std::vector<ImplantMesh> fixed = bones_of(joint.fixed), mobile = bones_of(joint.mobile);
  move(fixed, -by.centre);
  move(mobile, of_femur);
  const double removed = cut_head_off(mobile, {by.head.centre + of_femur, by.head.radius}, cut);
  append(fixed, std::move(implant.fixed));
  append(mobile, std::move(implant.mobile));
  Joint placed{joint.name, JointKind::ball, side, joined_body(joint.fixed.name, fixed),
               joined_body(joint.mobile.name, mobile)};
  placed.fixed.image = moved(joint.fixed.image, -by.centre);
  placed.mobile.image = moved(joint.mobile.image, of_femur);
  placed.implant = implant_in_joint(hip, placed);
  placed.planned = joint.planned;
  placed.person = joint.person;
  add_planned(placed, "with a total hip");
  return {std::move(placed), cut, shift, removed, meshes_left_out(joint)};
}

}  // namespace condyle::plan
