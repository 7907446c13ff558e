#include "io/joint/propose_units.hpp"

#include <fmt/format.h>

#include "condyle/error.hpp"
#include "condyle/fit.hpp"
#include "condyle/inspect.hpp"
#include "kinematics/bone_sizes.hpp"
#include "mesh/scale.hpp"
#include "mesh/surface_pieces.hpp"

namespace condyle::io {
namespace {

std::optional<double> radius_on(const TriMesh& mesh, SphericalPart part) {
  try {
    return find_sphere(Mesh(mesh), {.part = part}).fit.sphere.radius;
  } catch (const MeshError&) {
    return std::nullopt;
  }
}

std::string by_radius(std::string_view what, double radius, LengthUnit unit) {
  return fmt::format("inferred from a {} of radius {:.4g}: an adult's in {}", what, radius, plural_of(unit));
}

}  // namespace

std::optional<Stated<LengthUnit>> units_by_size(const ProposedBody& fixed, const ProposedBody& mobile,
                                                const ProposalFacts& facts) {
  if (facts.units) return facts.units;
  if (!facts.person.is_human())
    return Stated<LengthUnit>{LengthUnit::millimetres,
                              "as written: sizes of another species than human speak for no unit"};
  const LikelyUnit of_fixed = likely_unit(fixed.mesh), of_mobile = likely_unit(mobile.mesh);
  if (!of_mobile.unit || of_fixed.unit != of_mobile.unit) return std::nullopt;
  return Stated<LengthUnit>{*of_mobile.unit, "inferred from the size of the meshes: " + of_mobile.reason};
}

std::optional<Stated<LengthUnit>> units_of_hip(ProposedBody& fixed, ProposedBody& mobile,
                                               const ProposalFacts& facts) {
  const auto by_size = units_by_size(fixed, mobile, facts);
  if (facts.units || !facts.person.is_human()) return by_size;
  const auto head = radius_on(mobile.mesh, SphericalPart::head);
  const auto of_head = head ? kinematics::unit_of_head(*head) : std::nullopt;
  if (!of_head) return by_size;
  // What looks like an adult's in millimetres is.
  if (by_size && by_size->value == *of_head) return by_size;
  const auto socket = radius_on(fixed.mesh, SphericalPart::socket);
  const auto of_socket = socket ? kinematics::unit_of_head(*socket) : std::nullopt;
  if (of_socket && *of_socket != *of_head) {
    const bool scale_mobile = mm_per(*of_head) > mm_per(*of_socket);
    ProposedBody& scaled = scale_mobile ? mobile : fixed;
    const LengthUnit unit = scale_mobile ? *of_socket : *of_head,
                     other = scale_mobile ? *of_head : *of_socket;
    scaled.scale = mm_per(other) / mm_per(unit);
    scaled.scale_by = by_radius(scale_mobile ? "head" : "socket", scale_mobile ? *head : *socket, other);
    return Stated<LengthUnit>{
        unit, by_radius(scale_mobile ? "socket" : "head", scale_mobile ? *socket : *head, unit)};
  }
  return Stated<LengthUnit>{*of_head, by_radius("head", *head, *of_head)};
}

TriMesh surface_in_mm(const ProposedBody& body, LengthUnit units) {
  TriMesh mesh = body.mesh;
  mesh::scale(mesh, body.scale);
  mesh::scale(mesh, mm_per(units));
  return mesh::outer_surface(Mesh(std::move(mesh)));
}

}  // namespace condyle::io
