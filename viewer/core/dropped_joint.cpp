#include "dropped_joint.hpp"

#include <emscripten.h>
#include <fmt/format.h>

#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <string_view>

#include "condyle/error.hpp"
#include "condyle/io/mesh_file.hpp"
#include "condyle/io/rom_result.hpp"
#include "condyle/joint_checks.hpp"
#include "condyle/make_joint.hpp"
#include "io/mesh/uncompress.hpp"
#include "kinematics/hip_anatomy.hpp"
#include "kinematics/hip_axes.hpp"
#include "mesh/scale.hpp"
#include "page_joint.hpp"

using namespace condyle;

struct CondyleMesh {
  TriMesh mesh;
};

namespace {

using Json = nlohmann::ordered_json;

/// In mm, by what their sizes say.
LengthUnit told_unit(const TriMesh& fixed, const TriMesh& mobile) {
  const LikelyUnit of_fixed = likely_unit(fixed), of_mobile = likely_unit(mobile);
  if (!of_mobile.unit || of_fixed.unit != of_mobile.unit)
    throw UsageError("units: the sizes of the meshes do not speak for one unit");
  return *of_mobile.unit;
}

TriMesh in_mm(TriMesh mesh, LengthUnit unit) {
  mesh::scale(mesh, mm_per(unit));
  return mesh;
}

kinematics::AgreeingAxes told_axes(const kinematics::HipAnatomy& hip, const std::optional<Side>& side) {
  const auto found = kinematics::agreeing_axes(hip, side);
  if (found.size() == 1) return found[0];
  throw UsageError(found.empty() ? "axes: the bones agree with none of the axes in use"
                                 : "axes: the bones agree with more than one of the axes in use");
}

CondyleJoint* proposed_joint(const TriMesh& fixed, const TriMesh& mobile, const std::optional<Side>& side) {
  const LengthUnit unit = told_unit(fixed, mobile);
  const auto hip = kinematics::hip_anatomy(in_mm(fixed, unit), in_mm(mobile, unit));
  if (!hip)
    throw UsageError("no head was found on the mobile body near the fixed one: the page proposes hips");
  const auto [axes, told_side] = told_axes(*hip, side);
  JointDescription description{.name = "dropped joint", .side = told_side, .units = unit};
  description.frame.centre = CentreFit{};
  description.frame.axes = axes->directions;
  PlacedJoint placed = make_joint(description, {"fixed body", fixed}, {"mobile body", mobile});
  PageProposal proposal;
  proposal.told = {
      fmt::format("a head of radius {:.2f} mm, {:.0f} % of a sphere", hip->head.fit.sphere.radius,
                  100 * hip->head.coverage),
      fmt::format("side: {}", told_side == Side::right ? "right" : "left"),
      fmt::format("axes: {}", axes->name),
      fmt::format("units: {}", unit == LengthUnit::metres ? "m" : "mm"),
  };
  proposal.notes = check_joint(placed.joint, placed.placement);
  JointContact bodies(placed.joint);
  return new CondyleJoint{
      .joint = std::move(placed.joint), .bodies = std::move(bodies), .proposal = std::move(proposal)};
}

Json angles_json(const JointAngles& angles) {
  Json json;
  for (const JointAngle angle : all_joint_angles)
    json[coordinate_names(Anatomy::hip)[static_cast<std::size_t>(angle)].positive] =
        angle_of(angles, angle).degrees();
  return json;
}

Json motion_json(const MotionLimit& limit) {
  const auto& contact = limit.end.contact;
  const auto& bearing = limit.end.bearing_contact;
  const auto vary = static_cast<std::size_t>(limit.motion.vary);
  Json point = nullptr;
  if (contact) point = {contact->fixed_point.x(), contact->fixed_point.y(), contact->fixed_point.z()};
  return {
      {"name", limit.motion.name},
      {"limit_deg", limit.end.turned.degrees()},
      {"reason", name_of(limit.end.reason)},
      {"contact_kind", limit.end.kind() == ContactKind::impingement ? Json("impingement") : Json(nullptr)},
      {"bearing_contact_deg", bearing ? Json(bearing->turned.degrees()) : Json(nullptr)},
      {"contact_point_mm", point},
      {"clock_hour", nullptr},
      {"vary", coordinate_names(Anatomy::hip)[vary].positive},
      {"sense", limit.motion.sense == RotationSense::positive ? "positive" : "negative"},
      {"range_deg", limit.motion.range.degrees()},
      {"start_deg", angles_json(limit.motion.start)},
      {"at_limit_deg", angles_json(limit.angles_at_limit())},
      {"normal_range_deg", nullptr},
      {"band", nullptr}};
}

}  // namespace

// zlib is the worker's, viewer/src/core/unzip.ts.
// clang-format off
EM_JS(int, page_unzip, (const char* from, int size, char* to, int capacity), {
  return Module["unzip"](HEAPU8.subarray(from, from + size), HEAPU8.subarray(to, to + capacity)) ? 1 : 0;
});
// clang-format on

namespace condyle::io {

/// What compressed a file that the page cannot undo.
struct UnknownCompression {};

bool uncompress(Compressor compressor, const std::string& block, std::span<char> out) {
  if (compressor != Compressor::zlib) throw UnknownCompression();
  return page_unzip(block.data(), static_cast<int>(block.size()), out.data(), static_cast<int>(out.size())) !=
         0;
}

}  // namespace condyle::io

CondyleMesh* condyle_read_mesh(const char* name, const std::uint8_t* bytes, int count) {
  return guarded(static_cast<CondyleMesh*>(nullptr), [&] {
    const std::string_view contents(reinterpret_cast<const char*>(bytes), static_cast<std::size_t>(count));
    try {
      return new CondyleMesh{read_mesh(contents, mesh_format_of(name), name).mesh};
    } catch (const io::UnknownCompression&) {
      throw FileError(std::string(name) +
                      ": compressed by LZ4: the page reads VTP compressed by zlib or not at all");
    }
  });
}

void condyle_free_mesh(CondyleMesh* mesh) {
  delete mesh;
}

CondyleJoint* condyle_propose(const CondyleMesh* fixed, const CondyleMesh* mobile, int side) {
  return guarded(static_cast<CondyleJoint*>(nullptr), [&] {
    const std::optional<Side> given =
        side < 0 ? std::nullopt : std::optional(side == 0 ? Side::right : Side::left);
    return proposed_joint(fixed->mesh, mobile->mesh, given);
  });
}

int condyle_side(const CondyleJoint* joint) {
  return joint->joint.side == Side::right ? 0 : 1;
}

int condyle_vertex_count(const CondyleJoint* joint, int of_fixed) {
  return static_cast<int>((of_fixed ? joint->joint.fixed : joint->joint.mobile).mesh.vertices().size());
}

int condyle_triangle_count(const CondyleJoint* joint, int of_fixed) {
  return static_cast<int>((of_fixed ? joint->joint.fixed : joint->joint.mobile).mesh.triangles().size());
}

void condyle_mesh(const CondyleJoint* joint, int of_fixed, double* vertices, std::uint32_t* triangles) {
  const Mesh& mesh = (of_fixed ? joint->joint.fixed : joint->joint.mobile).mesh;
  for (std::size_t v = 0; v < mesh.vertices().size(); ++v)
    for (int i = 0; i < 3; ++i) vertices[3 * v + static_cast<std::size_t>(i)] = mesh.vertices()[v][i];
  for (const Triangle& triangle : mesh.triangles())
    triangles = std::copy(triangle.begin(), triangle.end(), triangles);
}

const char* condyle_description(CondyleJoint* joint) {
  return guarded(static_cast<const char*>(nullptr), [&] {
    Json notes = Json::array(), motions = Json::array();
    for (const JointNote& note : joint->proposal.notes)
      notes.push_back({{"code", name_of(note.code)}, {"text", note.text}});
    for (const MotionLimit& limit : range_of(*joint).limits(hip_motions()))
      motions.push_back(motion_json(limit));
    joint->description =
        Json{{"told", joint->proposal.told}, {"notes", std::move(notes)}, {"motions", std::move(motions)}}
            .dump();
    return joint->description.c_str();
  });
}
