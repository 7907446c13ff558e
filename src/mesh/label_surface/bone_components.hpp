#pragma once

#include <cstddef>

#include "mesh/label_surface/contour.hpp"

namespace condyle::mesh {

struct ComponentChoice {
  bool all_pieces, keep_cavities;
};

/// Takes components of a contour away, and their vertices; returns how many. Of the solids that lie in no other the one
/// of most volume stays, or all; of what lies directly in a solid that stays, its cavities if they are kept; of what
/// lies in such a cavity, solids if all are kept; and so on.
std::size_t drop_components(Contour& contour, const ComponentChoice& choice);

}  // namespace condyle::mesh
