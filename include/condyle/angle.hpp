#pragma once

#include <compare>
#include <numbers>

namespace condyle {

/// An angle that cannot be mistaken for a plain number: say degrees or radians going in and coming out.
class Angle {
 public:
  constexpr Angle() = default;
  static constexpr Angle degrees(double value) noexcept { return Angle(value * (std::numbers::pi / 180)); }
  static constexpr Angle radians(double value) noexcept { return Angle(value); }

  constexpr double degrees() const noexcept { return radians_ * (180 / std::numbers::pi); }
  constexpr double radians() const noexcept { return radians_; }

  constexpr Angle operator-() const noexcept { return Angle(-radians_); }
  constexpr Angle operator+(Angle b) const noexcept { return Angle(radians_ + b.radians_); }
  constexpr Angle operator-(Angle b) const noexcept { return Angle(radians_ - b.radians_); }
  constexpr Angle operator*(double s) const noexcept { return Angle(radians_ * s); }
  constexpr auto operator<=>(const Angle&) const = default;

 private:
  constexpr explicit Angle(double value) : radians_(value) {}
  double radians_ = 0;
};

/// A full turn in radians.
inline constexpr double two_pi = 2 * std::numbers::pi;

}  // namespace condyle
