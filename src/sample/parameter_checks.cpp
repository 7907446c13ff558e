#include "sample/parameter_checks.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "condyle/error.hpp"
#include "sample/femur_shape.hpp"

namespace condyle::sample {

void require_range(const char* name, double value, double low, double high, const char* unit) {
  if (value >= low && value <= high) return;
  throw UsageError(
      fmt::format("sample hip: {} is {:g}, must be {:g} to {:g} {}", name, value, low, high, unit));
}

void require_range(const char* name, Angle value, Angle low, Angle high) {
  if (value >= low && value <= high) return;
  throw UsageError(fmt::format("sample hip: {} is {:g}, must be {:g} to {:g} degrees", name, value.degrees(),
                               low.degrees(), high.degrees()));
}

void require_count(const char* mesh, std::size_t triangles, std::size_t low) {
  constexpr std::size_t high = 4'000'000;
  if (triangles % 2 == 0 && triangles >= low && triangles <= high) return;
  throw UsageError(
      fmt::format("sample hip: {} cannot have {} triangles, must be an even number from {} to {}", mesh,
                  triangles, low, high));
}

void require_valid(const HipParameters& hip) {
  require_range("head_radius_mm", hip.head_radius_mm, 18, 32, "mm");
  require_range("joint_space_mm", hip.joint_space_mm, 2, 6, "mm");
  require_range("neck_shaft_angle", hip.neck_shaft_angle, Angle::degrees(110), Angle::degrees(145));
  require_range("femoral_anteversion", hip.femoral_anteversion, Angle::degrees(-15), Angle::degrees(45));
  require_range("neck_radius_mm", hip.neck_radius_mm, 8, 0.8 * hip.head_radius_mm, "mm");
  require_range("neck_length_mm", hip.neck_length_mm, 40, 65, "mm");
  require_range("shaft_length_mm", hip.shaft_length_mm, 60, 250, "mm");
  if (hip.alpha_angle) {
    // On necks so slender that they make less than 50 degrees, the smallest bump stands out above alpha.
    constexpr Angle most = Angle::degrees(90), least_for_bump = Angle::degrees(50);
    const Angle native = native_alpha_angle(hip);
    if (native > most) {
      throw UsageError(
          fmt::format("sample hip: alpha_angle cannot be set: so wide a neck makes it {:g} degrees by itself",
                      native.degrees()));
    }
    require_range("alpha_angle", *hip.alpha_angle, std::max(native, least_for_bump), most);
  }
  require_range("acetabular_inclination", hip.acetabular_inclination, Angle::degrees(35), Angle::degrees(65));
  require_range("acetabular_version", hip.acetabular_version, Angle::degrees(-10), Angle::degrees(35));
  require_range("lateral_centre_edge_angle", hip.lateral_centre_edge_angle, Angle::degrees(15),
                Angle::degrees(45));
}

}  // namespace condyle::sample
