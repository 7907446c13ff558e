#include "condyle/io/joint_file.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "condyle/error.hpp"
#include "condyle/first_contact.hpp"
#include "condyle/io/mesh_file.hpp"
#include "condyle/io/pose_text.hpp"
#include "condyle/limit_band.hpp"
#include "condyle/make_joint.hpp"
#include "core/rounded.hpp"
#include "core/trigonometry.hpp"
#include "io/joint/proposal.hpp"
#include "io/joint/proposal_lines.hpp"
#include "io/joint/propose_other_joint.hpp"
#include "io/joint/propose_units.hpp"
#include "io/joint/settings_lines.hpp"
#include "kinematics/hip_anatomy.hpp"
#include "kinematics/hip_axes.hpp"
#include "mesh/enclosed_volume.hpp"
#include "mesh/surface_pieces.hpp"

namespace condyle::io {
namespace {

/// A head is seated in a socket whose radius is larger by this at most, mm of a head of 24 mm radius: bone to bone, cartilage between. A socket is
/// looked for this far from the head.
constexpr double widest_space_mm = 8, farthest_seat_mm = 60;
constexpr int most_seatings = 10;
constexpr double seated_within_mm = 0.01;

double degrees(double cosine) {
  return core::arccosine(std::clamp(cosine, -1.0, 1.0)) * 180 / std::numbers::pi;
}

double degrees_forwards(double forwards, double outwards) {
  return core::arctangent(forwards, outwards) * 180 / std::numbers::pi;
}

void add_side(ProposalLines& lines, const std::optional<Stated<Side>>& stated,
              const std::optional<Side>& inferred, const std::string& why_none) {
  if (stated)
    lines.key("side", toml_text(name_of(stated->value)), stated->by);
  else if (inferred)
    lines.key("side", toml_text(name_of(*inferred)), "inferred from the bones, as the axes below");
  else
    lines.missing("side", "\"right\" or \"left\"", why_none);
}

void add_axes(ProposalLines& lines, const kinematics::HipAnatomy& hip,
              const kinematics::AgreeingAxes& inferred) {
  const auto& [axes, side] = inferred;
  const Vec3 lateral = inferred.lateral();
  lines.key("anterior", toml_vector(axes->anterior()),
            fmt::format("{}: of the axes in use the ones that agree", axes->name));
  lines.key("superior", toml_vector(axes->superior()),
            fmt::format("the femur hangs {:.0f} degrees from straight down, the hip bone lies {:.0f} degrees "
                        "from the way to the midline",
                        degrees(-hip.towards_femur.dot(axes->superior())),
                        degrees(-hip.towards_pelvis.dot(lateral))));
  if (hip.opening)
    lines.add(fmt::format(
        "# the socket opens {:.0f} degrees from straight to the side, {} forwards of it",
        degrees(hip.opening->dot(lateral)),
        core::rounded(degrees_forwards(hip.opening->dot(axes->anterior()), hip.opening->dot(lateral)), 0)));
}

void add_kind(ProposalLines& lines, const std::optional<kinematics::HipAnatomy>& hip) {
  if (!hip)
    return lines.missing("kind", "\"ball\" or \"hinge\"",
                         "no head was found on the mobile body in or near a socket of the fixed one");
  lines.key("kind", "\"ball\"",
            fmt::format("inferred from a head of radius {:.2f} mm, {:.0f} % of a sphere{}",
                        hip->head.fit.sphere.radius, 100 * hip->head.coverage,
                        hip->socket
                            ? fmt::format(", in a socket of radius {:.2f} mm", hip->socket->fit.sphere.radius)
                            : std::string(", without a spherical socket round it")));
}

/// The pieces about the head, if the mesh has another bone beside them, as a whole pelvis has and both femora; else empty. A fragment is no bone.
std::optional<TriMesh> half_at(const TriMesh& whole, const Sphere& head) {
  TriMesh half = piece_at(Mesh(whole), head.centre);
  const auto area_of = [](const TriMesh& mesh) {
    double area = 0;
    for (const Triangle& t : mesh.triangles) {
      const Vec3 a = mesh.vertices[t[0]];
      area += (mesh.vertices[t[1]] - a).cross(mesh.vertices[t[2]] - a).norm() / 2;
    }
    return area;
  };
  const double at_joint = area_of(half);
  if (2 * (area_of(whole) - at_joint) < at_joint) return std::nullopt;
  const BoundingBox all = mesh::bounds_of_vertices(whole), at_head = mesh::bounds_of_vertices(half);
  const Vec3 beyond = (at_head.low - all.low).cwiseMax(all.high - at_head.high);
  if (!(beyond.maxCoeff() > head.radius)) return std::nullopt;  // walls within
  return half;
}

/// Whether the bones make a hip with their roles exchanged.
bool are_exchanged(const TriMesh& fixed, const TriMesh& mobile, const ProposalFacts& facts) {
  const auto hip = kinematics::hip_anatomy(mobile, fixed);
  if (!hip) return false;
  return facts.axes_by ? kinematics::side_in(lps_axes, *hip).side.has_value()
                       : !kinematics::hip_axes(mobile, *hip, {}).agreeing.empty();
}

constexpr const char* exchanged = "are the bones exchanged? The hip bone comes first, then the femur";

/// `stated_per_mm`: a piece of a mesh is found by a centre in figures, in the unit of the mesh.
void add_centre(ProposalLines& lines, const std::optional<kinematics::HipAnatomy>& hip,
                std::optional<double> stated_per_mm) {
  if (!hip) return lines.missing("centre", "[x, y, z]", "nothing was fitted");
  const Sphere& head = hip->head.fit.sphere;
  const Vec3 centre = head.centre * stated_per_mm.value_or(1);
  lines.key("centre",
            stated_per_mm ? fmt::format("[{}, {}, {}]", centre.x(), centre.y(), centre.z()) : "\"fit\"",
            fmt::format("the head's centre, {} mm in the frame of the meshes, rms {:.2f} mm{}",
                        core::rounded(head.centre, 2), hip->head.fit.rms_residual,
                        hip->socket ? fmt::format("; the socket's is {:.2f} mm from it",
                                                  (hip->socket->fit.sphere.centre - head.centre).norm())
                                    : std::string()));
}

/// Moves the mobile body so that its head's sphere and the socket's have one centre: the joint space is as even as the spheres fit.
Seating seat(const ProposedBody& fixed, ProposedBody& mobile) {
  const auto found = [](const ProposedBody& body, const SphereSearch& search, const char* what) {
    try {
      return find_sphere(Mesh(body.mesh), search).fit.sphere;
    } catch (const MeshError&) {
      throw MeshError(fmt::format("{}: no {} was found to seat", body.file.string(), what));
    }
  };
  const Sphere head = found(mobile, {}, "head");
  // Of both sockets of a pelvis the nearer one.
  Sphere socket = found(fixed,
                        {.part = SphericalPart::socket,
                         .within = Sphere{head.centre, head.radius + by_head(farthest_seat_mm, head)}},
                        "socket near the head");
  // Answers take the sphere about the head as it lies: that of the new place, until it stays.
  for (int i = 0; i < most_seatings; ++i) {
    const auto around = kinematics::sphere_around(fixed.mesh, {socket.centre, head.radius});
    if (!around) break;
    const Vec3 before = std::exchange(socket, around->fit.sphere).centre;
    if ((socket.centre - before).norm() < seated_within_mm) break;
  }
  const double space = socket.radius - head.radius;
  if (!(space >= 0 && space <= by_head(widest_space_mm, head)))
    throw MeshError(
        fmt::format("{}: its head has a radius of {:.2f} mm and the socket {:.2f}: they do not fit, "
                    "so nothing is seated",
                    mobile.file.string(), head.radius, socket.radius));
  const Vec3 by = socket.centre - head.centre;
  Points& vertices = mobile.mesh.vertices;
  for (std::size_t v = 0; v < vertices.size(); ++v) vertices.set(v, vertices[v] + by);
  const motion::FirstContact contact(Mesh(fixed.mesh), Mesh(mobile.mesh),
                                     AxisFrame(socket.centre, Vec3::UnitZ()));
  return {by, space, !contact.limits(Pose::Identity(), {Angle(), Angle()}).free_at_start()};
}

/// X_WB of a bone that was seated.
void add_pose(ProposalLines& lines, const Seating& seating, double per_mm) {
  const Vec3 by = per_mm * seating.moved_mm;
  lines.key("pose",
            fmt::format("[1, 0, 0, {}, 0, 1, 0, {}, 0, 0, 1, {}, 0, 0, 0, 1]", by.x(), by.y(), by.z()),
            fmt::format("--seat: moved by {} mm, not turned; the spheres leave a space of {:.2f} mm{}",
                        core::rounded(seating.moved_mm, 2), seating.space_mm,
                        seating.overlaps ? "; as seated the bones overlap" : ""));
}

/// The usual deviations are a human's: those of another species are as large a share of the head's radius.
void add_uncertainty(ProposalLines& lines, const Sphere& head, double per_mm) {
  const motion::Uncertainty usual;
  lines.add("\n[uncertainty]  # the share of the head's radius that a human hip has");
  lines.add(fmt::format("centre = {:.3g}\nsurface = {:.3g}", by_head(usual.centre_mm, head) * per_mm,
                        by_head(usual.surface_mm, head) * per_mm));
}

}  // namespace

JointProposal proposal_of(ProposedBody fixed, ProposedBody mobile, const ProposalFacts& facts) {
  if (facts.anatomy && *facts.anatomy != Anatomy::hip)
    return proposal_of_other(std::move(fixed), std::move(mobile), *facts.anatomy, facts);
  ProposalLines lines;
  add_head(lines, fixed, mobile, facts);
  const auto inferred = units_of_hip(fixed, mobile, facts);
  const LengthUnit units = inferred ? inferred->value : LengthUnit::millimetres;
  fixed.mesh = surface_in_mm(fixed, units);
  mobile.mesh = surface_in_mm(mobile, units);
  if (facts.seat) mobile.seating = seat(fixed, mobile);
  auto hip = kinematics::hip_anatomy(fixed.mesh, mobile.mesh);
  for (ProposedBody* body : {&fixed, &mobile})
    if (hip && !body->image)
      if (auto half = half_at(body->mesh, hip->head.fit.sphere)) {
        body->mesh = *std::move(half);
        body->is_piece_at_joint = true;
        hip = kinematics::hip_anatomy(fixed.mesh, mobile.mesh);
      }
  if (!hip && are_exchanged(fixed.mesh, mobile.mesh, facts))
    lines.missing("kind", "\"ball\" or \"hinge\"", exchanged);
  else
    add_kind(lines, hip);

  const std::optional<Side> given = facts.side ? std::optional(facts.side->value) : std::nullopt;
  kinematics::HipAxes axes{{}, "no head was found to infer them from", {}};
  std::optional<Side> side;
  if (hip && facts.axes_by) {
    kinematics::SideInAxes in_axes = kinematics::side_in(lps_axes, *hip);
    side = in_axes.side;
    axes.why_none = "the bones do not speak for one side";
    axes.evidence = std::move(in_axes.evidence);
  } else if (hip) {
    axes = kinematics::hip_axes(fixed.mesh, *hip, given);
    if (axes.agreeing.size() == 1) side = axes.agreeing[0].side;
    if (axes.agreeing.empty() && are_exchanged(fixed.mesh, mobile.mesh, facts)) axes.why_none = exchanged;
  }
  const bool contradicted = facts.axes_by && given && side && *given != *side;
  const std::optional<Side> stated = contradicted ? std::nullopt : given ? given : side;
  if (contradicted)
    lines.missing("side", "\"right\" or \"left\"",
                  fmt::format("{} it is {}, and the bones lie as those of a {} hip", facts.side->by,
                              name_of(*given), name_of(*side)));
  else
    add_side(
        lines, facts.side, side,
        axes.agreeing.empty() ? axes.why_none : "more than one pair of axes and side agrees with the bones");
  add_units(lines, inferred, fixed, mobile);
  if (mobile.seating)
    lines.key(
        "planned",
        toml_text(fmt::format("{} seated, moved by {:.1f} mm", mobile.name, mobile.seating->moved_mm.norm())),
        "every answer says so: the bones were not measured where they are now");

  add_body(lines, "fixed", fixed, facts.joint_file);
  add_body(lines, "mobile", mobile, facts.joint_file);
  if (mobile.seating) add_pose(lines, *mobile.seating, 1 / mm_per(units));

  lines.add("\n[frame]");
  add_centre(
      lines, hip,
      fixed.is_piece_at_joint || mobile.is_piece_at_joint ? std::optional(1 / mm_per(units)) : std::nullopt);
  if (facts.axes_by) {
    lines.key("axes", "\"LPS\"", *facts.axes_by);
  } else if (axes.agreeing.size() == 1) {
    add_axes(lines, *hip, axes.agreeing[0]);
  } else {
    lines.missing("anterior", "[x, y, z]", axes.why_none);
    lines.missing("superior", "[x, y, z]", "as anterior");
  }
  for (const std::string& line : axes.evidence) lines.evidence(line);
  if (hip && !facts.person.is_human()) add_uncertainty(lines, hip->head.fit.sphere, 1 / mm_per(units));
  return std::move(lines).proposal(stated);
}

std::vector<std::size_t> femora_in(const ProposalRequest& request) {
  constexpr double as_large = 3;
  const Mesh femora(read_mesh(request.mobile, request.polygons).mesh);
  const mesh::SurfacePieces& pieces = mesh::pieces_of(femora);
  std::vector<std::size_t> found;
  double largest = 0;
  for (const mesh::SurfacePiece& piece : pieces.all) largest = std::max(largest, piece.area);
  for (std::size_t p = 0; p < pieces.all.size(); ++p)
    if (!pieces.all[p].is_inner() && as_large * pieces.all[p].area >= largest) found.push_back(p);
  if (found.size() < 2) return {};
  const TriMesh hip_bones = read_mesh(request.fixed, request.polygons).mesh;
  std::erase_if(found, [&](std::size_t p) {
    return !kinematics::hip_anatomy(hip_bones, mesh::piece_alone(femora, p));
  });
  return found.size() < 2 ? std::vector<std::size_t>{} : found;
}

JointProposal propose_joint(const ProposalRequest& request) {
  const auto body = [&](const std::filesystem::path& file) {
    return ProposedBody{.mesh = read_mesh(file, request.polygons).mesh,
                        .file = file,
                        .name = file.stem().string(),
                        .polygons = request.polygons};
  };
  ProposalFacts facts{.joint_file = request.joint_file, .from = "the two meshes below"};
  if (request.side) facts.side = {*request.side, "given"};
  if (request.units) facts.units = {*request.units, "given"};
  facts.anatomy = request.anatomy;
  facts.person = request.person;
  facts.seat = request.seat;
  if (facts.seat && facts.anatomy.value_or(Anatomy::hip) != Anatomy::hip)
    throw UsageError("--seat: is for a hip");
  ProposedBody fixed = body(request.fixed), mobile = body(request.mobile);
  if (fixed.mesh.vertices == mobile.mesh.vertices && fixed.mesh.triangles == mobile.mesh.triangles)
    throw UsageError(
        fmt::format("{} and {} are the same mesh: two bones are needed, the one that stays first",
                    request.fixed.string(), request.mobile.string()));
  if (request.mobile_piece) {
    mobile.mesh = mesh::piece_alone(Mesh(std::move(mobile.mesh)), *request.mobile_piece);
    mobile.is_piece_at_joint = true;
  }
  JointProposal proposal = io::proposal_of(std::move(fixed), std::move(mobile), facts);
  proposal.toml += person_text(request.person);
  return proposal;
}

}  // namespace condyle::io
