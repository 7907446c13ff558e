#pragma once

#include <array>
#include <optional>

#include "condyle/io/picture.hpp"

namespace condyle::io {

/// Red, green, blue, 0 to 255.
using Rgb = std::array<double, 3>;

inline constexpr Rgb white = {255, 255, 255}, black = {0, 0, 0};
inline constexpr Rgb fixed_bone = {230, 218, 192}, mobile_bone = {190, 205, 225};
/// Colours of hatching, for values that are only bounds.
inline constexpr Rgb hatch_dark = {70, 70, 70}, hatch_light = {150, 150, 150};

/// Colours over mm, the same as the page's: of one hue's scale by lightness, for all eyes.
///
///     gap, nearest   striped | -range  dark red ... orange | 0 | dark blue ... pale yellow  range | plain bone
///     depth                          0  yellow ... dark violet  range | striped
struct ColourScale {
  PictureColour colour;
  double range_mm;
  /// Values may be beyond the end: it was not chosen to hold them all.
  bool may_end_within = true;

  double low_mm() const noexcept { return colour == PictureColour::depth ? 0 : -range_mm; }
  bool is_plain_above() const noexcept { return colour != PictureColour::depth; }
  /// Beyond an end where values mean something: striped.
  bool is_beyond(double mm) const noexcept { return mm < -range_mm || (!is_plain_above() && mm > range_mm); }
  /// Values beyond the scale have the colour of its end; empty for values above it that need no colour.
  std::optional<Rgb> at(double mm) const noexcept;
};

}  // namespace condyle::io
