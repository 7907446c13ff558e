#include "condyle/sample/hip.hpp"

#include <algorithm>

namespace condyle::sample {
namespace {

template <double HipParameters::*member>
constexpr HipMeasure length(std::string_view name, std::string_view meaning) {
  return {name, "mm", meaning, [](const HipParameters& hip) { return std::optional(hip.*member); },
          [](HipParameters& hip, double value) { hip.*member = value; }};
}

template <Angle HipParameters::*member>
constexpr HipMeasure angle(std::string_view name, std::string_view meaning) {
  return {name, "deg", meaning,
          [](const HipParameters& hip) { return std::optional((hip.*member).degrees()); },
          [](HipParameters& hip, double value) { hip.*member = Angle::degrees(value); }};
}

constexpr HipMeasure alpha = {
    "alpha_angle_deg", "deg", "alpha angle of a cam at half past one around the neck; empty: no cam",
    [](const HipParameters& hip) {
      return hip.alpha_angle ? std::optional(hip.alpha_angle->degrees()) : std::nullopt;
    },
    [](HipParameters& hip, double value) { hip.alpha_angle = Angle::degrees(value); }};

using Hip = HipParameters;
constexpr HipMeasure measures[] = {
    length<&Hip::head_radius_mm>("head_radius_mm", "radius of the femoral head"),
    length<&Hip::joint_space_mm>("joint_space_mm", "radius of the socket less radius of the head"),
    angle<&Hip::neck_shaft_angle>("neck_shaft_angle_deg", "between the axes of neck and shaft"),
    angle<&Hip::femoral_anteversion>("femoral_anteversion_deg", "by which the neck points forward"),
    length<&Hip::neck_radius_mm>("neck_radius_mm", "half the narrowest front-to-back width of the neck"),
    length<&Hip::neck_length_mm>("neck_length_mm", "from the head's centre to the shaft's axis"),
    length<&Hip::shaft_length_mm>("shaft_length_mm", "from the neck's axis to the lower end"),
    alpha,
    angle<&Hip::acetabular_inclination>("acetabular_inclination_deg",
                                        "of the socket's opening, from the vertical"),
    angle<&Hip::acetabular_version>("acetabular_version_deg", "of the socket's opening, forward of lateral"),
    angle<&Hip::lateral_centre_edge_angle>("lateral_centre_edge_angle_deg", "lateral coverage of the head"),
};

}  // namespace

std::span<const HipMeasure> hip_measures() noexcept {
  return measures;
}

const HipMeasure* hip_measure_named(std::string_view name) noexcept {
  const auto* found =
      std::find_if(std::begin(measures), std::end(measures), [&](const auto& m) { return m.name == name; });
  return found == std::end(measures) ? nullptr : found;
}

}  // namespace condyle::sample
