#include "kinematics/hip_parts.hpp"

#include <array>
#include <cstddef>

#include "condyle/error.hpp"
#include "core/latest_few.hpp"
#include "core/lazy.hpp"
#include "kinematics/cut_parts.hpp"
#include "kinematics/hip_anatomy.hpp"
#include "kinematics/surface_points.hpp"
#include "mesh/findings.hpp"
#include "mesh/surface_pieces.hpp"

namespace condyle::kinematics {
namespace {

/// A head whose centre is near the joint centre lies within this part of the root of its surface's area, 90 mm on a whole femur and 1.3
/// radii if all of it is a ball; fewer vertices to search cost less.
constexpr double reach_of_head = 0.37;

/// The head of a joint, and that of its checks where the two differ, at this pose and the one before.
constexpr std::size_t heads_kept = 4;

/// Centre and radius.
using HeadKey = std::array<double, 4>;
HeadKey key_of(const Sphere& head) noexcept {
  return {head.centre.x(), head.centre.y(), head.centre.z(), head.radius};
}

struct KeptParts {
  core::Lazy<std::optional<SphericalPatch>> fitted_head, head_near_centre, head_anywhere;
  core::LatestFew<HeadKey, std::optional<SphericalPatch>, heads_kept> sockets, stated_sockets;
  core::LatestFew<HeadKey, std::optional<SocketRim>, heads_kept> rims;
  core::LatestFew<HeadKey, std::optional<ShallowSocket>, heads_kept> shallow_sockets;
};

const KeptParts& kept_with(const Mesh& mesh) {
  return mesh::findings_of(mesh).get<KeptParts>();
}

std::optional<SphericalPatch> found_sphere(const Mesh& mesh, const SphereSearch& search) {
  try {
    return find_sphere(mesh, search);
  } catch (const MeshError&) {
    return std::nullopt;
  }
}

}  // namespace

const std::optional<SphericalPatch>& head_near_centre(const Mesh& mobile) {
  return kept_with(mobile).head_near_centre.get([&](std::optional<SphericalPatch>& head) {
    const double reach = reach_of_head * root_of_area(mesh::outer_surface(mobile));
    head = found_sphere(mobile, {.within = Sphere{Vec3::Zero(), reach}});
  });
}

const std::optional<SphericalPatch>& head_anywhere(const Mesh& mobile) {
  return kept_with(mobile).head_anywhere.get(
      [&](std::optional<SphericalPatch>& head) { head = found_sphere(mobile, {}); });
}

void keep_head(const Mesh& mobile, const std::vector<Index>& vertices) {
  const KeptParts& kept = kept_with(mobile);
  const auto& fitted =
      kept.fitted_head.get([&](std::optional<SphericalPatch>& head) { head = patch_of(mobile, vertices); });
  kept.head_near_centre.get([&](std::optional<SphericalPatch>& head) { head = fitted; });
}

void keep_head(const Mesh& mobile, const Sphere& head) {
  kept_with(mobile).head_near_centre.get([&](std::optional<SphericalPatch>& known) {
    known = patch_on(mesh::outer_surface(mobile), head, SphericalPart::head);
  });
}

const std::optional<SphericalPatch>& fitted_head(const Mesh& mobile) {
  return kept_with(mobile).fitted_head.get([](std::optional<SphericalPatch>&) {});
}

std::shared_ptr<const std::optional<SphericalPatch>> socket_around(const Mesh& fixed, const Sphere& head) {
  return kept_with(fixed).sockets.get(key_of(head), [&](std::optional<SphericalPatch>& socket) {
    socket = sphere_around(mesh::outer_surface(fixed), head);
  });
}

std::shared_ptr<const std::optional<SphericalPatch>> socket_of(const Body& fixed, const Sphere& head) {
  const Mesh& surface = uncut_surface(fixed);
  if (!fixed.head) return socket_around(surface, head);
  return kept_with(surface).stated_sockets.get(
      key_of(*fixed.head), [&](std::optional<SphericalPatch>& socket) {
        socket = stated_patch(surface, *fixed.head, SphericalPart::socket);
      });
}

std::shared_ptr<const std::optional<SocketRim>> rim_around(const Mesh& fixed, const Sphere& head) {
  return kept_with(fixed).rims.get(key_of(head), [&](std::optional<SocketRim>& rim) {
    rim = socket_rim(mesh::outer_surface(fixed), head);
  });
}

std::shared_ptr<const std::optional<ShallowSocket>> shallow_socket_around(const Mesh& fixed,
                                                                          const Sphere& head) {
  return kept_with(fixed).shallow_sockets.get(key_of(head), [&](std::optional<ShallowSocket>& socket) {
    socket = find_shallow_socket(mesh::outer_surface(fixed), head);
  });
}

}  // namespace condyle::kinematics
