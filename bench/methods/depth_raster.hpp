#pragma once

#include "condyle/mesh.hpp"
#include "layers.hpp"

namespace bench {

/// An image plane: pixel (i, j) looks along `axis` through
/// (low[0] + (i + 1/2) pixel[0], low[1] + (j + 1/2) pixel[1]), which are the coordinates after the axis, in
/// turn: (y, z) for x, (z, x) for y, (x, y) for z.
struct ImagePlane {
  int axis = 2;
  double low[2] = {0, 0}, pixel[2] = {1, 1};
  int size[2] = {0, 0};

  int column_axis() const noexcept { return (axis + 1) % 3; }
  int row_axis() const noexcept { return (axis + 2) % 3; }
  condyle::Index cell(int column, int row) const noexcept {
    return static_cast<condyle::Index>(row * size[0] + column);
  }
};

/// A closed surface drawn into layers, where the line through the middle of each pixel crosses it, as
/// graphics hardware would draw it, but in double. Keeps its room from one drawing to the next.
class DepthRaster {
 public:
  /// Surface beyond `far` along the axis is left out.
  void draw(condyle::PointsView vertices, std::span<const condyle::Triangle> triangles,
            const ImagePlane& plane, double far, LayeredImage& out);

 private:
  condyle::Points seen_;  ///< in pixels across, in mm along the axis
};

}  // namespace bench
