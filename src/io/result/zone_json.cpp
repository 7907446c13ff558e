#include "io/result/zone_json.hpp"

#include <algorithm>
#include <cmath>

namespace condyle::io {
namespace {

Json in_degrees(const std::optional<Angle>& angle) {
  return angle ? Json(angle->degrees()) : Json(nullptr);
}

Json body_json(const motion::BodyZone& zone, const std::optional<Vec3>& centroid) {
  const auto deepest = [](const std::vector<double>& depths) -> Json {
    double most = 0;
    for (const double depth : depths)
      if (std::isfinite(depth)) most = std::max(most, depth);
    return depths.empty() ? Json(nullptr) : Json(most);
  };
  return {{"triangles", zone.triangles.size()},
          {"area_mm2", zone.area_mm2},
          {"centroid_mm", centroid ? numbers(*centroid) : Json(nullptr)},
          {"max_radial_depth_mm", deepest(zone.radial_depth_mm)},
          {"max_tangential_depth_deg", deepest(zone.tangential_depth_deg)},
          {"max_tangential_depth_mm", deepest(zone.tangential_depth_mm)}};
}

}  // namespace

Json zone_json(const std::optional<motion::ImpingementZone>& zone, const AnswerFrame& frame) {
  if (!zone) return nullptr;
  const auto &of_fixed = zone->fixed.centroid_mm, &of_mobile = zone->mobile.centroid_mm;
  Json fixed = body_json(zone->fixed, of_fixed ? std::optional(frame.fixed_point(*of_fixed)) : std::nullopt);
  Json mobile =
      body_json(zone->mobile, of_mobile ? std::optional(frame.mobile_point(*of_mobile)) : std::nullopt);
  fixed["clock_hour"] = nullable(zone->zone_hour);
  mobile["neck_angle_deg"] = in_degrees(zone->zone_neck_angle);
  return {{"past_deg", zone->past.degrees()},
          {"contact_neck_angle_deg", in_degrees(zone->contact_neck_angle)},
          {"fixed", std::move(fixed)},
          {"mobile", std::move(mobile)}};
}

}  // namespace condyle::io
