#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "condyle/angle.hpp"
#include "condyle/first_contact.hpp"
#include "condyle/range_of_motion.hpp"

/// Sweeps: the limits of a joint over a grid of values of its parts' parameters, and the designs that leave every target motion free.
/// docs/sweeps.md.

namespace condyle::plan {

/// Values of one parameter: first, first + step, ... up to last.
struct SweptParameter {
  std::string name;  ///< "cup.inclination"
  double first = 0, last = 0, step = 1;

  /// Values on the axis; the last one counts if it is a whole number of steps away to a millionth of one.
  [[nodiscard]] std::size_t count() const;
  /// Whether the last one is none of the values.
  [[nodiscard]] bool ends_early() const;
  [[nodiscard]] double value(std::size_t i) const noexcept { return first + static_cast<double>(i) * step; }
};

/// Swept parameters of "cup.inclination=30:50:1 cup.anteversion=0:30:1". Throws UsageError for other text, a step that is not above 0, an
/// axis that ends before it begins, and a name that is given twice.
[[nodiscard]] std::vector<SweptParameter> parse_sweep(std::string_view text);

/// A motion that a design has to leave free.
struct SweepTarget {
  std::string name;
  motion::Motion motion = {};
  Angle reach = {};         ///< how far it has to turn from its start, up to the motion's range
  Angle pelvic_tilt = {};   ///< of the posture, forwards: of a hip
  std::string source = {};  ///< of the angle, as its table has it
  double weight =
      1;  ///< above 0: to find the best design its margin counts divided by this, and a miss times this

  /// The motion as the joint file's pelvis sees it: a pose of flexion f at an anterior tilt t is that of flexion f + t without.
  [[nodiscard]] motion::Motion without_tilt() const noexcept;
};

/// How a limit was decided.
enum class LimitKnownBy : std::uint8_t {
  meshes,       ///< The exact first contact of the meshes.
  closed_form,  ///< Liner and neck as bodies of revolution: meshes end the motion on the same side of the target.
};

/// As in files: "meshes".
[[nodiscard]] std::string_view name_of(LimitKnownBy by) noexcept;

/// Where one target motion ends with one design.
struct DesignLimit {
  /// From the motion's start; 0 if in contact there, NaN of a design in contact in its reference pose.
  double turned_deg = 0;
  motion::LimitReason reason = motion::LimitReason::end_of_range;
  LimitKnownBy by = LimitKnownBy::meshes;
  /// The meshes that end it, as numbers of SweepAnswer::pairs; none at the end of the range.
  static constexpr std::uint16_t no_pair = 0xFFFF;
  std::uint16_t pair = no_pair;
};

/// Which mesh of either body ends a motion.
struct EndingPair {
  std::string fixed, mobile;
};

/// Designs side by side along the last swept parameter between which every target is free: all values from `low` to `high`.
struct SafeInterval {
  std::size_t line;  ///< designs of equal values of all other parameters, counted as the designs are
  double low, high;
  /// Which target ends it there, by its number; empty at the end of the axis.
  std::optional<std::size_t> low_target = {}, high_target = {};
};

/// Past this many designs a sweep is refused.
inline constexpr std::size_t most_designs = 10'000'000;

/// Ends of safe intervals are found to so much of a step.
inline constexpr double border_share = 0.01;

}  // namespace condyle::plan
