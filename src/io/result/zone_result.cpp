#include "io/result/zone_result.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <utility>

namespace condyle::io {
namespace {

/// VTK's readers take no infinities in text; NaN says "none" in every array of ours.
std::vector<double> finite_or_nan(std::vector<double> values) {
  for (double& value : values)
    if (!std::isfinite(value)) value = std::numeric_limits<double>::quiet_NaN();
  return values;
}

}  // namespace

std::vector<MeshArray> zone_point_arrays(const motion::BodyZone& zone) {
  if (zone.radial_depth_mm.empty()) return {};
  return {{"radial_depth_mm", finite_or_nan(zone.radial_depth_mm)},
          {"ray_to_normal_deg", finite_or_nan(zone.ray_to_normal_deg)},
          {"tangential_depth_deg", finite_or_nan(zone.tangential_depth_deg)},
          {"tangential_depth_mm", finite_or_nan(zone.tangential_depth_mm)}};
}

MeshArray zone_cell_array(const motion::BodyZone& zone, std::size_t triangles) {
  std::vector<std::uint8_t> in_zone(triangles);
  for (const Index t : zone.triangles) in_zone[t] = 1;
  return {"in_zone", std::move(in_zone)};
}

Pose zone_pose(const motion::ImpingementZone& zone, CoordinateSystem system) {
  const motion::Motion& motion = zone.limit.motion;
  const Angle onwards = zone.past * sign_of(motion.sense);
  return pose_at(system, motion::turned_by(zone.limit.angles_at_limit(), motion.vary, onwards));
}

std::string file_name_part(std::string_view motion) {
  constexpr std::size_t longest = 60;
  std::string part(motion.substr(0, longest));
  for (char& c : part) {
    const bool plain =
        (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '-' || c == '_';
    if (!plain) c = '_';
  }
  return part;
}

}  // namespace condyle::io
