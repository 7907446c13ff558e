#pragma once

#include <cstddef>
#include <optional>
#include <stop_token>

#include "mesh/label_surface/contour.hpp"

namespace condyle::mesh {

struct Simplified {
  Contour surface;
  /// Largest distance of a vertex of the surface before from the one after.
  double largest_error = 0;
};

/// A surface of about as many triangles as wanted, fewer by one at most; of more where no edge is left to be collapsed.
/// By the errors of Garland and Heckbert (1997): edges are collapsed, the least error first. Genus and manifold stay.
/// Vertices of a cap stay in its plane, those of its rim on the rim, up to straightening. A triangle turns by less than
/// 70 degrees at each step.
///
/// The result has no self-crossings if the surface before has none: triangles that would cross are kept from being made by
/// leaving the surface about them as it was, and the surface is returned as it was if that does not help.
///
/// Empty if it was stopped.
std::optional<Simplified> simplified(const Contour& contour, std::size_t triangles,
                                     const std::stop_token& stop = {});

}  // namespace condyle::mesh
