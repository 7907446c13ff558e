#include "kinematics/hip_axes.hpp"

#include <array>

namespace condyle::kinematics {
namespace {

const std::array known_axes{KnownAxes{"RAS (x right, y anterior, z superior)", ras_axes},
                            KnownAxes{"LPS (x left, y posterior, z superior)", lps_axes},
                            KnownAxes{"joint axes (x anterior, y superior, z right)", {}}};

/// Least cosines, for what a hip's bones do whoever they belong to: the femur hangs within 45 degrees of straight down,
/// the hip bone lies at least 17 degrees to the midline, the socket opens at least 17 degrees to the side and 3 forwards.
constexpr double hangs = 0.7, to_midline = 0.3, opens_to_side = 0.3, opens_forwards = 0.05;

bool agrees(const HipAnatomy& hip, const KnownAxes& axes, Side side) {
  const Vec3 lateral = side == Side::right ? axes.right() : Vec3(-axes.right());
  return hip.towards_femur.dot(axes.superior()) < -hangs && hip.towards_pelvis.dot(lateral) < -to_midline &&
         (!hip.opening ||
          (hip.opening->dot(lateral) > opens_to_side && hip.opening->dot(axes.anterior()) > opens_forwards));
}

}  // namespace

std::vector<AgreeingAxes> agreeing_axes(const HipAnatomy& hip, const std::optional<Side>& given) {
  std::vector<AgreeingAxes> found;
  for (const KnownAxes& axes : known_axes)
    for (const Side side : {Side::right, Side::left})
      if ((!given || *given == side) && agrees(hip, axes, side)) found.push_back({&axes, side});
  return found;
}

}  // namespace condyle::kinematics
