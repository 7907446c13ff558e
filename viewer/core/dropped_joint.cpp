#include "dropped_joint.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <utility>

#include "answer/exact_limits.hpp"
#include "condyle/error.hpp"
#include "condyle/io/mesh_file.hpp"
#include "condyle/joint_checks.hpp"
#include "condyle/make_joint.hpp"
#include "condyle/version.hpp"
#include "core/rounded.hpp"
#include "io/image/byte_stream.hpp"
#include "io/mesh/uncompress.hpp"
#include "io/result/json.hpp"
#include "io/result/rom_parts.hpp"
#include "kinematics/bone_sizes.hpp"
#include "kinematics/hip_anatomy.hpp"
#include "kinematics/hip_axes.hpp"
#include "mesh/enclosed_volume.hpp"
#include "mesh/scale.hpp"
#include "mesh/surface_pieces.hpp"
#include "page_proposal.hpp"

using namespace condyle;

struct CondyleMesh {
  TriMesh mesh;
  PageFile file;
};

namespace {

using io::Json;

/// The unit in which the head has an adult's size; if it has none, that of the bones' sizes.
LengthUnit inferred_unit(const TriMesh& fixed, const TriMesh& mobile) {
  try {
    if (const auto unit = kinematics::unit_of_head(find_sphere(Mesh(mobile)).fit.sphere.radius)) return *unit;
  } catch (const MeshError&) {
    // Without a head sizes have to do.
  }
  const LikelyUnit of_fixed = likely_unit(fixed), of_mobile = likely_unit(mobile);
  if (!of_mobile.unit || of_fixed.unit != of_mobile.unit)
    throw UsageError("units: the sizes of the meshes do not speak for one unit");
  return *of_mobile.unit;
}

/// Without surfaces that lie inside others.
TriMesh surface_in_mm(TriMesh mesh, LengthUnit unit) {
  mesh::scale(mesh, mm_per(unit));
  return mesh::outer_surface(Mesh(std::move(mesh)));
}

/// The hip with the other side's hip bone, whichever axes the meshes are in.
bool are_of_two_sides(const TriMesh& hip_bone, const kinematics::HipAnatomy& hip) {
  for (const int to_side : {0, 2}) {
    const auto turned = [&](Vec3 v) { return v[to_side] *= -1, v; };
    TriMesh mirrored = hip_bone;
    const Vec3 centre = hip.head.fit.sphere.centre;
    for (std::size_t v = 0; v < mirrored.vertices.size(); ++v)
      mirrored.vertices.set(v, centre + turned(mirrored.vertices[v] - centre));
    kinematics::HipAnatomy other = hip;
    other.towards_pelvis = turned(hip.towards_pelvis), other.hip_bone_end = turned(hip.hip_bone_end);
    if (hip.opening) other.opening = turned(*hip.opening);
    if (kinematics::hip_axes(mirrored, other, std::nullopt).agreeing.size() == 1) return true;
  }
  return false;
}

/// Why bones that have a head show no axes and side.
std::string axes_cause(const kinematics::HipAxes& axes, const TriMesh& hip_bone,
                       const kinematics::HipAnatomy& hip, const std::optional<Side>& given,
                       const CondyleMesh& fixed, const CondyleMesh& mobile) {
  const auto of_either = kinematics::hip_axes(hip_bone, hip, std::nullopt).agreeing;
  if (given && of_either.size() == 1)
    return fmt::format("side: the bones are of a {} hip, and {} is chosen", name_of(of_either[0].side),
                       name_of(*given));
  if (are_of_two_sides(hip_bone, hip))
    return fmt::format("{} and {} are of different sides, one right and one left", fixed.file.name,
                       mobile.file.name);
  return "axes: " + axes.why_none;
}

/// What is wrong with two meshes that make no hip; empty if it is not known.
std::string known_cause(const CondyleMesh& fixed, const CondyleMesh& mobile) {
  for (const CondyleMesh* each : {&fixed, &mobile}) {
    const Mesh mesh(each->mesh);
    if (mesh.is_closed() && mesh::enclosed_volume(mesh) < 0)
      return fmt::format("{} is inside out: its triangles are wound the other way round", each->file.name);
  }
  try {
    const LengthUnit of_mobile = inferred_unit(fixed.mesh, mobile.mesh);
    const TriMesh femur = surface_in_mm(mobile.mesh, of_mobile);
    for (const LengthUnit of_fixed : all_length_units) {
      if (of_fixed == of_mobile) continue;
      if (const auto hip = kinematics::hip_anatomy(surface_in_mm(fixed.mesh, of_fixed), femur);
          hip && hip->socket)
        return fmt::format("{} is in {} and {} in {}: scale one of them", fixed.file.name, name_of(of_fixed),
                           mobile.file.name, name_of(of_mobile));
    }
  } catch (const UsageError&) {
    // The bones have the size of no unit.
  }
  return "";
}

CondyleJoint* proposed_joint(const CondyleMesh& fixed, const CondyleMesh& mobile,
                             const std::optional<Side>& side) {
  const LengthUnit unit = inferred_unit(fixed.mesh, mobile.mesh);
  const TriMesh hip_bone = surface_in_mm(fixed.mesh, unit);
  const auto hip = hip_of(hip_bone, surface_in_mm(mobile.mesh, unit));
  const auto hip_axes = kinematics::hip_axes(hip_bone, hip, side);
  // The cause in the first line, and the votes in those below.
  if (hip_axes.agreeing.size() != 1)
    throw UsageError(fmt::format("{}\n{}", axes_cause(hip_axes, hip_bone, hip, side, fixed, mobile),
                                 fmt::join(hip_axes.evidence, "\n")));
  const auto [axes, inferred_side] = hip_axes.agreeing[0];
  JointDescription description{.name = "dropped joint", .side = inferred_side, .units = unit};
  description.frame.axes = axes->directions;
  PageProposal proposal{.inferred = head_evidence(hip)};
  proposal.inferred.push_back(
      fmt::format("side: {}{}", inferred_side == Side::right ? "right" : "left", side ? ", given" : ""));
  proposal.inferred.push_back(fmt::format("axes: {}", axes->name));
  proposal.inferred.push_back(fmt::format("units: {}", name_of(unit)));
  proposal.inferred.insert(proposal.inferred.end(), hip_axes.evidence.begin(), hip_axes.evidence.end());
  proposal.fixed = fixed.file, proposal.mobile = mobile.file;
  proposal.fixed_name = fixed.file.name, proposal.mobile_name = mobile.file.name;
  return joint_of(std::move(description), {"fixed body", fixed.mesh}, {"mobile body", mobile.mesh},
                  std::move(proposal));
}

/// Its bodies by the names that say what tissue a mesh is of.
Joint named_by_tissue(const CondyleJoint& joint) {
  Joint named = joint.joint;
  named.fixed.name = joint.proposal.fixed_name;
  named.mobile.name = joint.proposal.mobile_name;
  return named;
}

Json file_json(const PageFile& file) {
  return {{"path", file.name}, {"bytes", file.digest.bytes}, {"sha256", file.digest.sha256}};
}

}  // namespace

std::optional<Side> given_side(int side) {
  return side < 0 ? std::nullopt : std::optional(side == 0 ? Side::right : Side::left);
}

kinematics::HipAnatomy hip_of(const TriMesh& fixed, const TriMesh& mobile) {
  auto hip = kinematics::hip_anatomy(fixed, mobile);
  if (!hip)
    throw UsageError(
        "no head of a femur was found near a hip bone: the page makes hips of meshes, other joints of joint "
        "files");
  return std::move(*hip);
}

std::vector<std::string> head_evidence(const kinematics::HipAnatomy& hip) {
  const auto& [head, rms] = std::pair(hip.head.fit.sphere, hip.head.fit.rms_residual);
  return {
      fmt::format("a head of radius {:.2f} mm, {:.0f} % of a sphere", head.radius, 100 * hip.head.coverage),
      fmt::format("centre: the head's, {} mm in the frame of the meshes, rms {:.2f} mm",
                  core::rounded(head.centre, 2), rms)};
}

CondyleJoint* joint_of(JointDescription description, Body fixed, Body mobile, PageProposal proposal) {
  description.frame.centre = CentreFit{};
  PlacedJoint placed = make_joint(description, std::move(fixed), std::move(mobile));
  proposal.notes = check_joint(placed.joint, placed.placement);
  contact::JointContact bodies(placed.joint);
  return new CondyleJoint{
      .joint = std::move(placed.joint), .bodies = std::move(bodies), .proposal = std::move(proposal)};
}

namespace condyle::io {

/// Thrown for a file compressed by a method that the page cannot undo.
struct UnknownCompression {};

bool uncompress(Compressor compressor, const std::string& block, std::span<char> out) {
  if (compressor != Compressor::zlib) throw UnknownCompression();
  const ByteSource source(block, "block");
  if (is_gzip(source)) return false;
  try {
    Inflate inflate(source, 0);
    char more = 0;
    return inflate.read(out) == out.size() && inflate.read({&more, 1}) == 0;
  } catch (const FileError&) {
    return false;
  }
}

}  // namespace condyle::io

CondyleMesh* condyle_read_mesh(const char* name, const std::uint8_t* bytes, int count) {
  return guarded(static_cast<CondyleMesh*>(nullptr), [&] {
    const std::string_view contents(reinterpret_cast<const char*>(bytes), static_cast<std::size_t>(count));
    try {
      return new CondyleMesh{io::read_mesh(contents, io::mesh_format_of(name), name).mesh,
                             {name, io::digest_of(contents)}};
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
    if (fixed->file.digest.sha256 == mobile->file.digest.sha256)
      throw UsageError(fixed->file.name + " and " + mobile->file.name +
                       " are the same mesh: drop the hip bone and the femur");
    try {
      return proposed_joint(*fixed, *mobile, given_side(side));
    } catch (const UsageError& error) {
      const std::string cause = known_cause(*fixed, *mobile);
      if (cause.empty()) throw;
      throw UsageError(cause + "\n" + error.what());
    }
  });
}

int condyle_side(const CondyleJoint* joint) {
  return joint->joint.side == Side::right ? 0 : 1;
}

int condyle_vertex_count(const CondyleJoint* joint, int of_fixed) {
  return static_cast<int>(body_of(*joint, of_fixed).mesh.vertices().size());
}

int condyle_triangle_count(const CondyleJoint* joint, int of_fixed) {
  return static_cast<int>(body_of(*joint, of_fixed).mesh.triangles().size());
}

void condyle_mesh(const CondyleJoint* joint, int of_fixed, double* vertices, std::uint32_t* triangles) {
  const Mesh& mesh = body_of(*joint, of_fixed).mesh;
  put_points(mesh.vertices(), vertices);
  for (const Triangle& triangle : mesh.triangles())
    triangles = std::copy(triangle.begin(), triangle.end(), triangles);
}

const char* condyle_description(CondyleJoint* joint) {
  return guarded(static_cast<const char*>(nullptr), [&] {
    const PageProposal& proposal = joint->proposal;
    RangeRequest request{.motions = motion::hip_motions(), .range = {.bearing = joint->bearing}};
    request.range.overlap.reference_contact = motion::ReferenceContact::accept;
    const RangeAnswer answer = answer::exact_limits({.joint = named_by_tissue(*joint)}, request);
    joint->range = answer.range, joint->range_held_at = Vec3::Zero();
    Json rom = io::rom_object(io::rom_result_of(answer, proposal.notes, nullptr));
    Json notes = Json::array();
    const auto is_the_joints = [&](const io::LabelNote& note) {
      return std::any_of(proposal.notes.begin(), proposal.notes.end(),
                         [&](const JointNote& other) { return other.text == note.text; });
    };
    for (const io::LabelNote& note : proposal.of_images)
      if (!is_the_joints(note)) notes.push_back({{"code", name_of(note.code)}, {"text", note.text}});
    rom["notes"].insert(rom["notes"].begin(), notes.begin(), notes.end());
    rom["caveats"] = proposal.inferred;
    rom["provenance"] = {{"version", version},
                         {"fixed_mesh", file_json(proposal.fixed)},
                         {"mobile_mesh", file_json(proposal.mobile)}};
    joint->description = rom.dump(-1, ' ', false, Json::error_handler_t::replace);
    return joint->description.c_str();
  });
}
