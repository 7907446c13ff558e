#include "condyle/tangential/circle_filter.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace condyle {
namespace {

constexpr float unit = 0x1p-24f;  // rounding to single precision, relative

/// Far above the numbers that lose digits to underflow, 1e-38: what comes near them is not decided here.
constexpr float least_told = 1e-30f;

/// Booleans as numbers: combined without a branch, in loops that compilers turn into vector code.
constexpr int flag(bool value) noexcept {
  return static_cast<int>(value);
}

}  // namespace

void CircleFilter::begin(const Circle& circle) noexcept {
  z_ = circle.point.z();
  x_ = static_cast<float>(circle.point.x());
  y_ = static_cast<float>(circle.point.y());
  squared_radius_ = static_cast<float>(circle.squared_radius);
  doubt_ = 64 * unit * static_cast<float>(circle.scale * circle.scale);
  slack_ = 4 * unit * static_cast<float>(circle.scale);
}

/// Where the edge from a to b, at heights d_a and d_b over the circle on either side of 0, meets the circle's
/// height, times d = d_b - d_a:   (X, Y) = (a_x d_b - b_x d_a, a_y d_b - b_y d_a),   and
///
///     f = X^2 + Y^2 - rho^2 d^2
///
/// is d^2 times what that end of the cut lies outside the circle by. |d_a| + |d_b| = |d|, so with all |x|,
/// |y| within the scale M the roundings of f (u' = 2^-24, the numbers' own included) stay below 34u' M^2 d^2;
/// `doubt` is 64u' M^2.
///
/// Both ends inside: no crossing. Both outside: a chord would have its middle at most half the cut away from
/// the nearer end, so none where both are outside by more than a quarter of the longest edge squared.
CircleFilter::Verdict CircleFilter::judge(std::size_t count) const noexcept {
  Lanes<int> cut{}, crossing{}, holding{};
  for (std::size_t i = 0; i < width; ++i) {
    float longest2 = 0;
    int cuts = 0, all_inside = 1, all_far = 1;
    for (std::size_t k = 0; k < 3; ++k) {
      const std::size_t l = (k + 1) % 3;
      const float ax = corner_x_[k][i], bx = corner_x_[l][i], ay = corner_y_[k][i], by = corner_y_[l][i];
      longest2 = std::max(longest2, (bx - ax) * (bx - ax) + (by - ay) * (by - ay));
    }
    for (std::size_t k = 0; k < 3; ++k) {
      const std::size_t l = (k + 1) % 3;
      const float da = height_[k][i], db = height_[l][i], d = db - da, d2 = d * d;
      const float X = corner_x_[k][i] * db - corner_x_[l][i] * da;
      const float Y = corner_y_[k][i] * db - corner_y_[l][i] * da;
      const float f = (X * X + Y * Y) - squared_radius_ * d2;
      const int crosses = flag((da >= 0) != (db >= 0));
      const float inner = -doubt_ * d2, outer = (doubt_ + 0.26f * longest2) * d2;
      const int told = flag(d2 > least_told) & flag(-inner > least_told);
      const int inside = told & flag(f < inner), far = told & flag(f > outer);
      cuts |= crosses, all_inside &= inside | flag(crosses == 0), all_far &= far | flag(crosses == 0);
    }
    const auto around = [&](const std::array<Lanes<float>, 3>& v, float at) -> int {
      const float low = std::min(v[0][i], std::min(v[1][i], v[2][i]));
      const float high = std::max(v[0][i], std::max(v[1][i], v[2][i]));
      return flag(at >= low - slack_) & flag(at <= high + slack_);
    };
    const int reaches_down = flag(height_[0][i] <= 0) | flag(height_[1][i] <= 0) | flag(height_[2][i] <= 0);
    const int reaches_up = flag(height_[0][i] >= 0) | flag(height_[1][i] >= 0) | flag(height_[2][i] >= 0);
    const int level = reaches_down & reaches_up;
    cut[i] = cuts, crossing[i] = cuts & flag((all_inside | all_far) == 0);
    holding[i] = level & around(corner_x_, x_) & around(corner_y_, y_);
  }
  Verdict verdict;
  for (std::size_t i = 0; i < count; ++i) {
    const auto bit = [&](int set) { return static_cast<unsigned>(set) << i; };
    verdict.cut |= bit(cut[i]), verdict.may_cross |= bit(crossing[i]), verdict.may_hold |= bit(holding[i]);
  }
  return verdict;
}

}  // namespace condyle
