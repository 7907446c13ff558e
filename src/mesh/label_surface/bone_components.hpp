#pragma once

#include <cstddef>

#include "mesh/label_surface/contour.hpp"
#include "mesh/surface_pieces.hpp"

namespace condyle::mesh {

/// Takes pieces of a contour away that are not kept_pieces(), and their vertices; returns how many.
std::size_t drop_components(Contour& contour, const PieceChoice& choice);

}  // namespace condyle::mesh
