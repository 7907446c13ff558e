#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "condyle/bearing.hpp"
#include "condyle/joint.hpp"

/// Role of each triangle in contact.

namespace condyle::motion {

/// Marks of the triangles with all three corners within the margin of the head, or with an image on a terrace of its thick slices there.
std::vector<std::uint8_t> triangles_within(const TriMesh& mobile, const BearingSurface& surface,
                                           const std::optional<BodyImage>& image = {});

/// Roles by the words of the meshes and by the bearing surface. Linear in the triangles.
ContactRoles contact_roles(const Joint& joint, const std::optional<BearingSurface>& surface);

/// Kind of the contact of two such triangles.
ContactKind kind_of(ContactRole fixed, ContactRole mobile) noexcept;

}  // namespace condyle::motion
