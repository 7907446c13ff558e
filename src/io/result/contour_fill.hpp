#pragma once

#include <span>
#include <vector>

#include "io/result/svg_canvas.hpp"

/// Filled contours of a quantity known at the points of a grid.

namespace condyle::io {

/// Values over the points (x[i], y[j]), stored at j * x.size() + i; NaN where there is none. x and y ascend.
struct GridField {
  std::span<const double> x, y, values;
};

/// Where a field is at or above a level.
struct ContourRegion {
  /// Outlines in the field's own coordinates: counter-clockwise (y up) around, clockwise around holes.
  std::vector<Ring> rings;
  /// The parts of the outlines where the field crosses the level: the outlines less what is merely the edge
  /// of the grid or of missing points. Open, or closed with the first point repeated.
  std::vector<Ring> lines;
};

/// Each cell is split into four triangles about its middle, where the field is taken as the mean of the
/// corners, and is linear in each triangle:
///
///     d-------c        Saddles, two opposite corners above the level and two below, have no second
///     | \ ^ / |        reading here: the middle decides, for all levels at once. So the interpolated field
///     | < m > |        is continuous, the regions of rising levels are nested, and painting them one over
///     | / v \ |        the other leaves no seam.
///     a-------b
///
/// A cell with one corner missing keeps the triangle of the other three; with more it is left out. Exact
/// (to rounding) for fields linear in x and y; elsewhere off by the error of linear interpolation.
///
/// A value equal to the level counts as above it.
ContourRegion region_at_or_above(const GridField& field, double level);

}  // namespace condyle::io
