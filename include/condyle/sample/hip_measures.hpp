#pragma once

#include <optional>
#include <span>
#include <string_view>

#include "condyle/sample/hip_parameters.hpp"

namespace condyle {

/// A measure of the sample hip by the name it has in tables and in Python: "neck_shaft_angle_deg". Values are mm or degrees.
struct HipMeasure {
  std::string_view name, unit, meaning;
  std::optional<double> (*value)(const HipParameters&);
  void (*set)(HipParameters&, double);
};

/// All measures of HipParameters, in their order.
std::span<const HipMeasure> hip_measures() noexcept;

/// Null if no measure has this name.
const HipMeasure* hip_measure_named(std::string_view name) noexcept;

}  // namespace condyle
