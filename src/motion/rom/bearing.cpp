#include "condyle/bearing.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

#include "condyle/error.hpp"
#include "core/formatted.hpp"
#include "kinematics/cut_parts.hpp"
#include "kinematics/flat_ends.hpp"
#include "kinematics/hip_anatomy.hpp"
#include "kinematics/hip_parts.hpp"
#include "kinematics/surface_sag.hpp"
#include "motion/rom/contact_roles.hpp"

namespace condyle::motion {
namespace {

/// The meshes of the mobile body that are called bearing: names, and marks of their triangles.
void mark_bearing_parts(const Body& mobile, BearingSurface& surface) {
  surface.triangles.assign(mobile.mesh.triangles().size(), 0);
  for (const BodyPart& part : mobile.parts) {
    if (part.contact != PartContact::bearing) continue;
    surface.parts.push_back(part.name);
    std::fill_n(surface.triangles.begin() + static_cast<std::ptrdiff_t>(part.first_triangle), part.triangles,
                std::uint8_t{1});
  }
}

TriMesh marked_part(const TriMesh& mesh, const std::vector<std::uint8_t>& marks) {
  TriMesh part{mesh.vertices, {}};
  for (std::size_t t = 0; t < marks.size(); ++t)
    if (marks[t]) part.triangles.push_back(mesh.triangles[t]);
  return part;
}

/// The socket round the head, and the gaps that limit a margin.
void find_socket(const Joint& joint, BearingSurface& surface) {
  const Sphere& head = surface.head;
  const Mesh& fixed = kinematics::uncut_surface(joint.fixed);
  if (joint.is_hip()) {
    if (joint.fixed.head)
      surface.socket = joint.fixed.head;
    else if (const auto socket = kinematics::socket_around(fixed, head);
             *socket && kinematics::fits_into(head, **socket))
      surface.socket = (*socket)->fit.sphere;
    if (const auto rim = kinematics::rim_around(fixed, head); *rim) surface.rim_gap_mm = (*rim)->gap_mm;
    return;
  }
  const auto socket = kinematics::shallow_socket_around(fixed, head);
  if (*socket) {
    surface.rim_gap_mm = (*socket)->rim_gap_mm;
    if (const auto& sphere = (*socket)->sphere; sphere && kinematics::is_socket_of(head, *sphere))
      surface.socket = sphere->fit.sphere;
  }
  if (joint.fixed.head) surface.socket = joint.fixed.head;
  // No rotation about the joint centre brings a point of the head farther from it than this.
  const double farthest = head.radius + head.centre.norm();
  const double beside = kinematics::nearest_beside(fixed, head, *socket) - farthest;
  if (std::isfinite(beside)) surface.beside_gap_mm = beside;
}

struct LimitingGap {
  double gap_mm;
  MarginLimit by;
};

/// Infinite if nothing limits the margin.
LimitingGap limiting_gap(const BearingSurface& surface) {
  constexpr double none = std::numeric_limits<double>::infinity();
  const double rim = surface.rim_gap_mm.value_or(none), beside = surface.beside_gap_mm.value_or(none);
  return beside < rim ? LimitingGap{beside, MarginLimit::beside_socket} : LimitingGap{rim, MarginLimit::rim};
}

std::string no_margin(const Joint& joint, double gap_mm, MarginLimit by) {
  if (by == MarginLimit::rim)
    return core::formatted(
        "head and rim are only %.2f mm apart: no margin to distinguish bearing surfaces by", gap_mm);
  return joint.fixed.name +
         core::formatted(
             " leaves the head only %.2f mm beside its socket: no margin to distinguish bearing surfaces by",
             std::max(gap_mm, 0.0));
}

/// The corners of a staircase stand out of the surface that it shows by up to a voxel's diagonal. An implant is made to its sizes: its surfaces
/// are as rough as their facets.
double narrow_bound(const Joint& joint, const Sphere& head) {
  const auto sag_mm = [&](const Body& body) {
    return kinematics::surface_sag_mm(body.mesh, head.centre,
                                      by_head(usual_bearing_margin_mm, head) + head.radius);
  };
  double bound =
      joint.implant ? sag_mm(joint.fixed) + sag_mm(joint.mobile) : by_head(narrow_bearing_margin_mm, head);
  for (const Body* body : {&joint.fixed, &joint.mobile})
    if (body->image) bound = std::max(bound, body->image->voxel.rowwise().sum().norm());
  return bound;
}

/// The surface alone, or why there is none.
BearingFinding surface_of(const Joint& joint, const BearingOptions& options) {
  BearingFinding found;
  const auto none = [&](std::string why) {
    found.why_none = std::move(why);
    return std::move(found);
  };
  if (!joint.has_head()) return none("bearing contact is not distinguished from impingement in this joint");
  const TriMesh& mobile = joint.mobile.mesh;
  if (options.surface) {
    if (options.surface->triangles.size() != mobile.triangles.size())
      throw UsageError("bearing surface: it is that of another mesh");
    found.surface = options.surface;
    return found;
  }
  BearingSurface surface;
  mark_bearing_parts(joint.mobile, surface);
  const bool has_parts = !surface.parts.empty();
  if (joint.mobile.head && !has_parts) kinematics::keep_head(joint.mobile.mesh, *joint.mobile.head);
  const std::optional<SphericalPatch> head = kinematics::head_near_centre(
      has_parts ? Mesh(marked_part(mobile, surface.triangles)) : joint.mobile.mesh);
  if (!head)
    return none(joint.mobile.name + (has_parts ? ": no part of the meshes named bearing is spherical"
                                               : ": no head was found around the joint centre"));
  surface.head = head->fit.sphere;
  surface.head_coverage = head->coverage;
  const double farthest = by_head(farthest_head_centre_mm, surface.head);
  if (const double off = surface.head.centre.norm(); off > farthest)
    return none(
        joint.mobile.name +
        core::formatted(
            ": the sphere found as its head has its centre %.1f mm from the joint centre, more than %.3g",
            off, farthest));
  find_socket(joint, surface);
  // A bearing cartilage reaches nearly to the rim's, and its own contact is none of impingement: no reserve is kept there.
  const auto [gap, by] = limiting_gap(surface);
  const double room = gap - (has_parts ? 0 : by_head(rim_reserve_mm, surface.head));
  const std::optional<double> stated = options.margin_mm ? options.margin_mm : joint.mobile.bearing_margin_mm;
  surface.margin_mm = stated.value_or(std::min(by_head(usual_bearing_margin_mm, surface.head), room));
  if (!stated && surface.margin_mm < narrow_bound(joint, surface.head))
    found.narrow_margin = {gap, surface.margin_mm, by};
  // Bone under a bearing cartilage is within its sphere, with a margin or without; but what meets an acromion is not bearing.
  if (has_parts && by == MarginLimit::rim) surface.margin_mm = std::max(surface.margin_mm, 0.0);
  if (!(surface.margin_mm >= 0)) return none(no_margin(joint, gap, by));
  const auto within = motion::triangles_within(mobile, surface, stated ? std::nullopt : joint.mobile.image);
  if (has_parts)
    for (std::size_t t = 0; t < within.size(); ++t) surface.triangles[t] |= within[t];
  else
    surface.triangles = within;
  for (const BodyPart& part : joint.mobile.parts)
    if (part.contact == PartContact::soft)
      std::fill_n(surface.triangles.begin() + static_cast<std::ptrdiff_t>(part.first_triangle),
                  part.triangles, std::uint8_t{0});
  if (surface.count() == surface.triangles.size())
    return none(joint.mobile.name + ": all of it would be bearing surface");
  found.surface = std::move(surface);
  return found;
}

/// Where its image ends, and where it ends in a plane; what was found before of another mesh has the first only.
std::vector<ImageCut> ends_of_bone(const Joint& joint, BodyRole body, const BearingOptions& options) {
  const std::optional<BodyImage>& image = (body == BodyRole::fixed ? joint.fixed : joint.mobile).image;
  std::vector<ImageCut> ends = image ? image->cuts : std::vector<ImageCut>{};
  if (options.surface || options.roles) return ends;
  const std::vector<ImageCut> flat = kinematics::flat_ends_near_joint(joint, body);
  ends.insert(ends.end(), flat.begin(), flat.end());
  return ends;
}

}  // namespace

std::size_t BearingSurface::count() const noexcept {
  return static_cast<std::size_t>(std::count(triangles.begin(), triangles.end(), 1));
}

BearingFinding find_bearing_surface(const Joint& joint, const BearingOptions& options) {
  if (options.margin_mm && !(*options.margin_mm >= 0 && std::isfinite(*options.margin_mm)))
    throw UsageError("bearing margin: must be 0 mm or more");
  // Roles that are given say what counts, with a surface or without.
  BearingFinding found = options.roles && !options.surface ? BearingFinding{} : surface_of(joint, options);
  found.roles = options.roles ? *options.roles : motion::contact_roles(joint, found.surface);
  found.fixed_cuts = ends_of_bone(joint, BodyRole::fixed, options);
  found.mobile_cuts = ends_of_bone(joint, BodyRole::mobile, options);
  return found;
}

}  // namespace condyle::motion
