#pragma once

#include <array>
#include <cstddef>
#include <span>
#include <vector>

#include "condyle/mesh.hpp"

namespace condyle::io {

/// Samples along a pixel's side: their mean is the pixel.
inline constexpr std::size_t samples = 4;

/// A mesh laid on a grid of samples: x to the right, y down, both in samples, z towards the viewer.
struct FlatMesh {
  Points vertices;
  std::span<const Triangle> triangles;
};

/// The triangle nearest to the viewer at a sample.
struct Hit {
  double z;
  Index triangle = no_index;
};

/// Shares of a triangle's corners at (x, y); the sum is 1. Not finite where it is seen from its edge.
std::array<double, 3> corner_shares(const FlatMesh& mesh, Index triangle, double x, double y) noexcept;

/// Finds what is seen of a mesh, a few rows of samples at a time, so that rows can be drawn by many threads. A
/// sample is at the middle of its square. Of triangles at one depth the first counts: nothing depends on the
/// order of drawing.
class Rasteriser {
 public:
  /// Sorts triangles into strips of `strip_rows` rows. The mesh must outlive it.
  Rasteriser(const FlatMesh& mesh, std::size_t columns, std::size_t rows, std::size_t strip_rows);

  /// The hits of a strip, row by row: strip_rows * columns of them. Triangles of either winding are seen.
  void draw(std::size_t strip, std::span<Hit> hits) const;
  /// Whether a strip has no triangles.
  bool is_empty(std::size_t strip) const noexcept { return strips_[strip].empty(); }

 private:
  const FlatMesh& mesh_;
  std::size_t columns_, strip_rows_;
  std::vector<std::vector<Index>> strips_;
};

}  // namespace condyle::io
