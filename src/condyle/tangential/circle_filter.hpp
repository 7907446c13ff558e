#pragma once

#include <array>
#include <cstddef>
#include <limits>

#include "condyle/tangential/circle_crossing.hpp"

namespace condyle {

/// Triangles beside a circle, some at a time: first all are fetched, then all are looked at without a branch,
/// in single precision. Fetching and deciding one by one would wait for memory at every wrong guess.
class CircleFilter {
 public:
  static constexpr std::size_t width = 8;

  /// Asks about this circle from now on; no triangle is put yet.
  void begin(const Circle& circle) noexcept;

  /// Takes the place of the triangle that was there.
  void put(std::size_t place, const TriangleRef& triangle) noexcept {
    constexpr float least = std::numeric_limits<float>::min();
    for (std::size_t k = 0; k < 3; ++k) {
      const Vec3& p = *triangle[k];
      const double height = p.z() - z_;
      corner_x_[k][place] = static_cast<float>(p.x());
      corner_y_[k][place] = static_cast<float>(p.y());
      // No difference is lost that tells above from below.
      height_[k][place] = static_cast<float>(height) - least * static_cast<float>(height < 0);
    }
  }

  /// What is known of each of the first triangles put, as bits by place.
  struct Verdict {
    unsigned cut = 0;        ///< Reaches both sides of the circle's height: exactly.
    unsigned may_cross = 0;  ///< May have a crossing with the circle; what may not, has none.
    unsigned may_hold = 0;   ///< May hold the circle's point; what may not, does not.
  };
  Verdict judge(std::size_t count) const noexcept;

 private:
  template <class Value>
  using Lanes = std::array<Value, width>;

  double z_ = 0;
  float x_ = 0, y_ = 0, squared_radius_ = 0, doubt_ = 0, slack_ = 0;
  /// Of each corner: x, y, and the height over the circle, negative exactly where it is below.
  alignas(64) std::array<Lanes<float>, 3> corner_x_{}, corner_y_{}, height_{};
};

}  // namespace condyle
