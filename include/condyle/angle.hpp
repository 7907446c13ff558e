#pragma once

#include <compare>
#include <numbers>
#include <string_view>

namespace condyle {

/// An angle that cannot be mistaken for a plain number: say degrees or radians going in and coming out.
class Angle {
 public:
  constexpr Angle() = default;
  [[nodiscard]] static constexpr Angle degrees(double value) noexcept {
    return Angle(value * (std::numbers::pi / 180));
  }
  [[nodiscard]] static constexpr Angle radians(double value) noexcept { return Angle(value); }

  [[nodiscard]] constexpr double degrees() const noexcept { return radians_ * (180 / std::numbers::pi); }
  [[nodiscard]] constexpr double radians() const noexcept { return radians_; }

  [[nodiscard]] constexpr Angle operator-() const noexcept { return Angle(-radians_); }
  [[nodiscard]] constexpr Angle operator+(Angle b) const noexcept { return Angle(radians_ + b.radians_); }
  [[nodiscard]] constexpr Angle operator-(Angle b) const noexcept { return Angle(radians_ - b.radians_); }
  [[nodiscard]] constexpr Angle operator*(double s) const noexcept { return Angle(radians_ * s); }
  constexpr auto operator<=>(const Angle&) const = default;

 private:
  constexpr explicit Angle(double value) : radians_(value) {}
  double radians_ = 0;
};

/// A full turn in radians.
inline constexpr double two_pi = 2 * std::numbers::pi;

/// Sense in which an angle changes. Joint angles: flexion, adduction and internal rotation are positive. About an
/// axis: counter-clockwise seen from the tip of its direction is positive.
enum class RotationSense : signed char { negative = -1, none = 0, positive = 1 };

/// -1, 0 or +1.
[[nodiscard]] constexpr double sign_of(RotationSense sense) noexcept {
  return static_cast<double>(sense);
}

/// As in files: "positive".
[[nodiscard]] constexpr std::string_view name_of(RotationSense sense) noexcept {
  return sense == RotationSense::positive   ? "positive"
         : sense == RotationSense::negative ? "negative"
                                            : "none";
}

}  // namespace condyle
