#pragma once

#include "condyle/mesh.hpp"
#include "layers.hpp"
#include "radial/exact/direction_map.hpp"

namespace bench {

/// A closed surface seen from the origin, in layers: the rays through the middles of the cells of a cube map,
/// `cells_per_side` along each side of each face, and the radii at which they cross the surface. Cells are
/// those of condyle::radial::CubeMap.
void draw_on_sphere(condyle::PointsView vertices, std::span<const condyle::Triangle> triangles,
                    int cells_per_side, LayeredImage& out);

}  // namespace bench
