#include "condyle/sample/cartilages.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "condyle/error.hpp"
#include "sample/cartilage_shape.hpp"
#include "sample/checked_mesh.hpp"
#include "sample/parameter_checks.hpp"
#include "sample/solid_mesh.hpp"
#include "sample/stoppable.hpp"

namespace condyle::sample {
namespace {

using sample::Cartilage;
using sample::Meshing;

constexpr double least_thickness_mm = 1;

void require_valid(const HipParameters& hip, const CartilageParameters& cartilage) {
  sample::require_valid(hip);
  sample::require_range("clearance_mm", cartilage.clearance_mm, -0.5, 1, "mm");
  sample::require_range("femoral_thickness_mm", cartilage.femoral_thickness_mm, least_thickness_mm, 3, "mm");
  const double left = sample::articular_spheres(hip, cartilage).acetabular_thickness();
  if (left < least_thickness_mm) {
    throw UsageError(fmt::format(
        "sample hip: the joint space leaves {:g} mm for the acetabular cartilage, must be at least {:g} mm",
        left, least_thickness_mm));
  }
}

/// Shorter edges at the borders, which are as sharp as the sheet is thin: coarse triangles make them jagged,
/// and on thin sheets run into each other.
Meshing meshing_for(const Cartilage& cartilage, double thickness) {
  const auto sizing = [border_distance = cartilage.border_distance](const Vec3& p) {
    constexpr double at_border = 0.7, border_mm = 1, transition_mm = 8;
    const double away = std::clamp((border_distance(p) - border_mm) / transition_mm, 0.0, 1.0);
    return at_border + (1 - at_border) * away;
  };
  // The longest contour edges, along the diagonals of lattice cubes, stay below the thickness.
  constexpr double spacing = 0.5;
  // Fewer triangles do not follow the borders well enough to be subdivided.
  constexpr std::size_t least_base = 2000;
  return {sizing, spacing * thickness, least_base};
}

CartilageCounts counts(const CartilageResolution& resolution, const Cartilage& acetabular,
                       const Meshing& acetabular_meshing, const Cartilage& femoral,
                       const Meshing& femoral_meshing) {
  if (const auto* scenario = std::get_if<CartilageScenario>(&resolution)) {
    switch (*scenario) {
      case CartilageScenario::five:
        return {2876, 2824};
      case CartilageScenario::six:
        return {4222, 4338};
      case CartilageScenario::seven:
        return {7870, 7734};
      case CartilageScenario::eight:
        return {14824, 17294};
    }
  }
  if (const auto* counts = std::get_if<CartilageCounts>(&resolution)) return *counts;
  const double edge = std::get<EdgeLength>(resolution).mm;
  sample::require_range("edge_length_mm", edge, 0.3, 3, "mm");
  return {sample::triangles_for(acetabular.solid, acetabular_meshing, edge),
          sample::triangles_for(femoral.solid, femoral_meshing, edge)};
}

/// Throws sample::Stopped.
SampleCartilages made(const HipParameters& hip, const CartilageParameters& cartilage,
                      const CartilageResolution& resolution, const std::stop_token& stop) {
  require_valid(hip, cartilage);
  const ArticularSpheres spheres = sample::articular_spheres(hip, cartilage);
  Cartilage acetabular = sample::acetabular_cartilage_shape(hip, cartilage);
  Cartilage femoral = sample::femoral_cartilage_shape(hip, cartilage);
  for (Cartilage* each : {&acetabular, &femoral})
    each->solid = sample::stoppable(std::move(each->solid), stop);
  const Meshing acetabular_meshing = meshing_for(acetabular, spheres.acetabular_thickness());
  const Meshing femoral_meshing = meshing_for(femoral, spheres.femoral_thickness());

  const CartilageCounts count = counts(resolution, acetabular, acetabular_meshing, femoral, femoral_meshing);
  constexpr std::size_t least = 2000;
  sample::require_count("acetabular cartilage", count.acetabular, least);
  sample::require_count("femoral cartilage", count.femoral, least);
  return {
      sample::checked_mesh("acetabular cartilage", acetabular.solid, acetabular_meshing, count.acetabular, 1),
      sample::checked_mesh("femoral cartilage", femoral.solid, femoral_meshing, count.femoral, 0)};
}

}  // namespace

SampleCartilages sample_cartilages(const HipParameters& hip, const CartilageParameters& cartilage,
                                   const CartilageResolution& resolution) {
  return made(hip, cartilage, resolution, {});
}

std::optional<SampleCartilages> sample_cartilages(const HipParameters& hip,
                                                  const CartilageParameters& cartilage,
                                                  const CartilageResolution& resolution,
                                                  const std::stop_token& stop) {
  try {
    return made(hip, cartilage, resolution, stop);
  } catch (const Stopped&) {
    return std::nullopt;
  }
}

SampleCartilages mirrored(const SampleCartilages& cartilages) {
  return {mirrored(cartilages.acetabular), mirrored(cartilages.femoral)};
}

}  // namespace condyle::sample
