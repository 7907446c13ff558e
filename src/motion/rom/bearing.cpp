#include "condyle/bearing.hpp"

#include <algorithm>
#include <cmath>
#include <string>

#include "condyle/error.hpp"
#include "core/formatted.hpp"
#include "kinematics/hip_anatomy.hpp"
#include "kinematics/hip_parts.hpp"

namespace condyle {
namespace {

std::vector<std::uint8_t> triangles_within(const TriMesh& mesh, const Vec3& centre, double radius) {
  std::vector<std::uint8_t> near_centre(mesh.vertices.size());
  for (std::size_t v = 0; v < mesh.vertices.size(); ++v)
    near_centre[v] = (mesh.vertices[v] - centre).norm() <= radius;
  std::vector<std::uint8_t> within(mesh.triangles.size());
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    const auto [a, b, c] = mesh.triangles[t];
    within[t] = near_centre[a] & near_centre[b] & near_centre[c];
  }
  return within;
}

/// The meshes of the mobile body that are called bearing: names, and marks of their triangles.
void mark_bearing_parts(const Body& mobile, BearingSurface& surface) {
  surface.triangles.assign(mobile.mesh.triangles().size(), 0);
  for (const BodyPart& part : mobile.parts) {
    if (!part.is_bearing) continue;
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

}  // namespace

std::size_t BearingSurface::count() const noexcept {
  return static_cast<std::size_t>(std::count(triangles.begin(), triangles.end(), 1));
}

bool BearingSurface::holds(const TriMesh& mobile, const Feature& feature) const noexcept {
  if (feature.kind == FeatureKind::face) return triangles[feature.id] != 0;
  bool used = false;
  for (std::size_t t = 0; t < triangles.size(); ++t) {
    const Triangle& corners = mobile.triangles[t];
    const auto has = [&](Index v) { return std::find(corners.begin(), corners.end(), v) != corners.end(); };
    if (!has(feature.id) || (feature.kind == FeatureKind::edge && !has(feature.other_end))) continue;
    if (!triangles[t]) return false;
    used = true;
  }
  return used;
}

bool BearingFinding::is_on_cut(const ContactWitness& contact) const noexcept {
  return condyle::is_on_cut(fixed_cuts, contact.fixed_point) ||
         condyle::is_on_cut(mobile_cuts, contact.mobile_point);
}

ContactKind BearingFinding::kind_of(const TriMesh& mobile, const ContactWitness& contact) const noexcept {
  if (is_on_cut(contact)) return ContactKind::cut;
  if (!surface) return ContactKind::unknown;
  return surface->holds(mobile, contact.mobile_feature) ? ContactKind::bearing : ContactKind::impingement;
}

BearingFinding find_bearing_surface(const Joint& joint, const BearingOptions& options) {
  BearingFinding found;
  if (joint.fixed.image) found.fixed_cuts = joint.fixed.image->cuts;
  if (joint.mobile.image) found.mobile_cuts = joint.mobile.image->cuts;
  const auto none = [&](std::string why) {
    found.why_none = std::move(why);
    return std::move(found);
  };
  if (options.margin_mm && !(*options.margin_mm >= 0 && std::isfinite(*options.margin_mm)))
    throw UsageError("bearing margin: must be 0 mm or more");
  if (!joint.is_hip()) return none("bearing contact is not told apart in this joint");
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
  const std::optional<SphericalPatch> head = kinematics::head_near_centre(
      has_parts ? Mesh(marked_part(mobile, surface.triangles)) : joint.mobile.mesh);
  if (!head)
    return none(joint.mobile.name + (has_parts ? ": nothing of the meshes called bearing is spherical"
                                               : ": no head was found around the joint centre"));
  surface.head = head->fit.sphere;
  surface.head_coverage = head->coverage;
  if (const double off = surface.head.centre.norm(); off > farthest_head_centre_mm)
    return none(
        joint.mobile.name +
        core::formatted(": the sphere found as its head has its centre %.1f mm from the joint centre, "
                        "more than %g",
                        off, farthest_head_centre_mm));
  if (const auto socket = kinematics::socket_around(joint.fixed.mesh, surface.head);
      *socket && kinematics::fits_into(surface.head, **socket))
    surface.socket = (*socket)->fit.sphere;
  if (const auto rim = kinematics::rim_around(joint.fixed.mesh, surface.head); *rim)
    surface.rim_gap_mm = (*rim)->gap_mm;
  // A bearing cartilage reaches nearly to the rim's, and its own contact is none of impingement: no reserve is kept there.
  const double reserve = has_parts ? 0 : rim_reserve_mm;
  surface.margin_mm = options.margin_mm.value_or(std::min(
      usual_bearing_margin_mm, surface.rim_gap_mm.value_or(usual_bearing_margin_mm + reserve) - reserve));
  if (!options.margin_mm && !has_parts && surface.margin_mm < narrow_bearing_margin_mm)
    found.narrow_margin = {*surface.rim_gap_mm, surface.margin_mm};
  // Bone under a bearing cartilage is within its sphere, with a margin or without.
  if (has_parts) surface.margin_mm = std::max(surface.margin_mm, 0.0);
  if (!(surface.margin_mm >= 0))
    return none(core::formatted("head and rim are only %.2f mm apart: no margin to tell bearing surfaces by",
                                *surface.rim_gap_mm));
  const auto within = triangles_within(mobile, surface.head.centre, surface.head.radius + surface.margin_mm);
  if (has_parts)
    for (std::size_t t = 0; t < within.size(); ++t) surface.triangles[t] |= within[t];
  else
    surface.triangles = within;
  if (surface.count() == surface.triangles.size())
    return none(joint.mobile.name + ": all of it would be bearing surface");
  found.surface = std::move(surface);
  return found;
}

}  // namespace condyle
