#include "sample/checked_mesh.hpp"

#include <fmt/format.h>

#include <optional>

#include "condyle/error.hpp"
#include "sample/self_intersection.hpp"

namespace condyle::sample {
namespace {

/// The fault of a mesh, if any.
std::optional<std::string> defect(const TriMesh& mesh, int wanted_genus) {
  if (const int found = genus(mesh); found != wanted_genus) {
    return fmt::format("has {} holes through it, not {}", found, wanted_genus);
  }
  if (const auto pair = first_self_intersection(mesh)) {
    return fmt::format("runs into itself near {}", place(mesh.corner(pair->first, 0)));
  }
  return std::nullopt;
}

}  // namespace

std::string place(const Vec3& p) {
  return fmt::format("({:.3g}, {:.3g}, {:.3g}) mm", p.x(), p.y(), p.z());
}

TriMesh checked_mesh(const char* name, const Solid& solid, Meshing meshing, std::size_t triangles,
                     int wanted_genus) {
  constexpr int attempts = 4;
  constexpr double finer = 0.9;
  std::string why;
  for (int attempt = 0; attempt < attempts; ++attempt) {
    try {
      TriMesh mesh = meshed(solid, meshing, triangles);
      const auto found = defect(mesh, wanted_genus);
      if (!found) return mesh;
      why = *found;
    } catch (const MeshError& error) {
      why = fmt::format("cannot be meshed: {}", error.what());
    }
    meshing.contour_spacing *= finer;
  }
  throw UsageError(fmt::format("sample hip: with these parameters the {} {}", name, why));
}

}  // namespace condyle::sample
