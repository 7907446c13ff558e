#include "motion/rom/contact_roles.hpp"

#include <algorithm>

namespace condyle::motion {
namespace {

ContactRole role_of(PartContact contact) noexcept {
  switch (contact) {
    case PartContact::ends:
      return ContactRole::ends;
    case PartContact::bearing:
      return ContactRole::bearing;
    case PartContact::soft:
      break;
  }
  return ContactRole::soft;
}

std::vector<ContactRole> roles_of_parts(const Body& body) {
  std::vector<ContactRole> roles(body.mesh.triangles().size(), ContactRole::ends);
  for (const BodyPart& part : body.parts)
    std::fill_n(roles.begin() + static_cast<std::ptrdiff_t>(part.first_triangle), part.triangles,
                role_of(part.contact));
  return roles;
}

/// Whether the feature is a corner or an edge of the triangle.
bool uses(const Triangle& corners, const Feature& feature) noexcept {
  const auto has = [&](Index v) { return std::find(corners.begin(), corners.end(), v) != corners.end(); };
  return has(feature.id) && (feature.kind != FeatureKind::edge || has(feature.other_end));
}

/// Role of a feature's triangles together: if they differ, that of the one that ends most.
ContactRole role_of(const TriMesh& mesh, const std::vector<ContactRole>& roles,
                    const Feature& feature) noexcept {
  if (roles.empty()) return ContactRole::ends;
  if (feature.kind == FeatureKind::face) return roles[feature.id];
  std::optional<ContactRole> role;
  for (std::size_t t = 0; t < roles.size(); ++t) {
    if (role == roles[t] || !uses(mesh.triangles[t], feature)) continue;
    if (!role)
      role = roles[t];
    else if (role == ContactRole::ends || roles[t] == ContactRole::ends)
      return ContactRole::ends;
    else
      role = ContactRole::bearing_on_bearing;
  }
  return role.value_or(ContactRole::ends);
}

bool holds(const std::vector<ContactRole>& roles, ContactRole role) noexcept {
  return std::find(roles.begin(), roles.end(), role) != roles.end();
}

}  // namespace

bool ContactRoles::has(ContactRole role) const noexcept {
  return holds(fixed, role) || holds(mobile, role);
}

bool ContactRoles::distinguish_bearing() const noexcept {
  return holds(mobile, ContactRole::bearing) || holds(mobile, ContactRole::bearing_on_bearing);
}

std::vector<std::uint8_t> triangles_within(const TriMesh& mobile, const BearingSurface& surface,
                                           const std::optional<BodyImage>& image) {
  const double radius = surface.head.radius + surface.margin_mm;
  // Thick slices leave terraces on a head that stand out of it by up to their width.
  const auto is_terrace = [&](const BodyImage& of, const Vec3& ray, double distance) {
    const double width = of.voxel_width_mm(ray);
    return width > by_head(usual_bearing_margin_mm, surface.head) && distance <= surface.head.radius + width;
  };
  std::vector<std::uint8_t> near_centre(mobile.vertices.size());
  for (std::size_t v = 0; v < mobile.vertices.size(); ++v) {
    const Vec3 ray = mobile.vertices[v] - surface.head.centre;
    const double distance = ray.norm();
    near_centre[v] = distance <= radius || (image && is_terrace(*image, ray / distance, distance));
  }
  std::vector<std::uint8_t> within(mobile.triangles.size());
  for (std::size_t t = 0; t < mobile.triangles.size(); ++t) {
    const auto [a, b, c] = mobile.triangles[t];
    within[t] = near_centre[a] & near_centre[b] & near_centre[c];
  }
  return within;
}

ContactRoles contact_roles(const Joint& joint, const std::optional<BearingSurface>& surface) {
  const Body &fixed = joint.fixed, &mobile = joint.mobile;
  const auto has_words = [](const Body& body) {
    return has_part(body, PartContact::bearing) || has_part(body, PartContact::soft);
  };
  if (!surface && !has_words(fixed) && !has_words(mobile)) return {};
  ContactRoles roles{roles_of_parts(fixed), roles_of_parts(mobile)};
  if (surface)
    for (std::size_t t = 0; t < roles.mobile.size(); ++t)
      if (surface->triangles[t] && roles.mobile[t] != ContactRole::soft)
        roles.mobile[t] = ContactRole::bearing;
  if (!has_part(fixed, PartContact::bearing)) return roles;
  // Contact with the head is in the socket; cartilage beyond the head slides on cartilage only.
  const std::vector<std::uint8_t> within =
      surface ? triangles_within(mobile.mesh, *surface) : std::vector<std::uint8_t>(roles.mobile.size());
  for (std::size_t t = 0; t < roles.mobile.size(); ++t)
    if (roles.mobile[t] == ContactRole::bearing && !within[t])
      roles.mobile[t] = ContactRole::bearing_on_bearing;
  return roles;
}

ContactKind kind_of(ContactRole fixed, ContactRole mobile) noexcept {
  if (fixed == ContactRole::soft || mobile == ContactRole::soft) return ContactKind::soft;
  const bool slides = mobile == ContactRole::bearing ||
                      (mobile == ContactRole::bearing_on_bearing && fixed == ContactRole::bearing);
  return slides ? ContactKind::bearing : ContactKind::impingement;
}

ContactKind BearingFinding::kind_of(Index fixed_triangle, Index mobile_triangle) const noexcept {
  const ContactRole fixed = roles.fixed.empty() ? ContactRole::ends : roles.fixed[fixed_triangle];
  const ContactRole mobile = roles.mobile.empty() ? ContactRole::ends : roles.mobile[mobile_triangle];
  const ContactKind kind = motion::kind_of(fixed, mobile);
  return kind == ContactKind::impingement && !roles.distinguish_bearing() ? ContactKind::unknown : kind;
}

bool BearingFinding::is_on_cut(const ContactWitness& contact) const noexcept {
  return condyle::is_on_cut(fixed_cuts, contact.fixed_point) ||
         condyle::is_on_cut(mobile_cuts, contact.mobile_point);
}

ContactKind BearingFinding::kind_of(const TriMesh& fixed, const TriMesh& mobile,
                                    const ContactWitness& contact) const noexcept {
  if (is_on_cut(contact)) return ContactKind::cut;
  const ContactKind kind = motion::kind_of(role_of(fixed, roles.fixed, contact.fixed_feature),
                                           role_of(mobile, roles.mobile, contact.mobile_feature));
  return kind == ContactKind::impingement && !roles.distinguish_bearing() ? ContactKind::unknown : kind;
}

}  // namespace condyle::motion
