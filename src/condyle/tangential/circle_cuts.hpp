#pragma once

#include <array>
#include <cstddef>

#include "condyle/core/vec3.hpp"
#include "condyle/tangential/circle_crossing.hpp"

namespace condyle {

/// What vectors of doubles say about a circle and a triangle.
enum class CutVerdict : signed char {
  leaves = static_cast<signed char>(Passage::leaves),  ///< One crossing, where the circle leaves the solid.
  none = 0,                                            ///< No crossing, and the point is not on the triangle.
  enters = static_cast<signed char>(Passage::enters),  ///< One crossing, where it enters.
  undecided = 2  ///< To be decided by `add_crossings`: too close to call, or two crossings.
};

/// Pairs of a circle and a triangle side by side: doubles by place.
struct CutColumns {
  static constexpr std::size_t most = 64;
  using Column = std::array<double, most>;

  /// Corners at the ends of the cut: lower and upper of p, lower and upper of q (see CircleCut).
  alignas(64) std::array<Column, 4> x{}, y{}, z{};
  /// Of the circle.
  alignas(64) Column point_x{}, point_y{}, height{}, squared_radius{};
  /// Answers; verdicts as numbers.
  alignas(64) Column angle{}, verdict{};
};

/// Triangles cut at the height of circles, many at a time: what `add_crossings` does one by one, wherever its
/// decisions are certain in double by far. The same bits as there, on every instruction set.
class CircleCuts {
 public:
  /// `scale` is at least every |x| and |y| of the triangles, and 2/3 of those of the points.
  explicit CircleCuts(double scale) noexcept : scale_(1.5 * scale) {}

  std::size_t size() const noexcept { return count_; }
  bool full() const noexcept { return count_ == CutColumns::most; }
  void clear() noexcept { count_ = 0; }

  /// Puts a pair behind the others, of which the caller keeps what it is about; must not be full. Leaves it
  /// out, and returns false, where the triangle does not reach the circle's height.
  bool put(const Vec3& point, double squared_radius, const TriangleRef& triangle) noexcept {
    const double h = point.z();
    const std::array<double, 3> z = {triangle[0]->z(), triangle[1]->z(), triangle[2]->z()};
    const auto bit = [](bool set, unsigned place) { return static_cast<unsigned>(set) << place; };
    const unsigned above = bit(z[0] >= h, 0) | bit(z[1] >= h, 1) | bit(z[2] >= h, 2);
    const bool touches = (z[0] == h) | (z[1] == h) | (z[2] == h);
    for (std::size_t k = 0; k < 4; ++k) {
      const Vec3& p = *triangle[end_corners[above][k]];
      columns_.x[k][count_] = p.x(), columns_.y[k][count_] = p.y(), columns_.z[k][count_] = p.z();
    }
    columns_.point_x[count_] = point.x(), columns_.point_y[count_] = point.y();
    columns_.height[count_] = h, columns_.squared_radius[count_] = squared_radius;
    const bool reaches = (above != 0) & ((above != 7) | touches);
    count_ += reaches;
    return reaches;
  }

  /// Decides about all pairs put.
  void decide() noexcept;

  CutVerdict verdict(std::size_t i) const noexcept {
    return static_cast<CutVerdict>(static_cast<signed char>(columns_.verdict[i]));
  }
  /// Of the crossing, where there is one: as in CircleCrossing.
  double angle(std::size_t i) const noexcept { return columns_.angle[i]; }

 private:
  /// Corners at the ends of the cut, by which corners are at its height or above, as bits. The ends of no cut
  /// are all one corner.
  static constexpr std::array<std::array<unsigned char, 4>, 8> end_corners = {{{0, 0, 0, 0},
                                                                               {1, 0, 2, 0},
                                                                               {2, 1, 0, 1},
                                                                               {2, 1, 2, 0},
                                                                               {0, 2, 1, 2},
                                                                               {1, 0, 1, 2},
                                                                               {0, 2, 0, 1},
                                                                               {0, 0, 0, 0}}};

  double scale_;
  std::size_t count_ = 0;
  CutColumns columns_;
};

}  // namespace condyle
