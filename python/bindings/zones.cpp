#include <pybind11/stl.h>

#include "arrays.hpp"
#include "bindings.hpp"
#include "condyle/impingement_zone.hpp"
#include "interrupts.hpp"
#include "motion.hpp"

namespace condyle::python {
namespace {

py::dict zone_dict(motion::BodyZone&& zone) {
  py::dict dict;
  dict["radial_depth_mm"] = array_of(std::move(zone.radial_depth_mm));
  dict["ray_to_normal_deg"] = array_of(std::move(zone.ray_to_normal_deg));
  dict["tangential_depth_deg"] = array_of(std::move(zone.tangential_depth_deg));
  dict["tangential_depth_mm"] = array_of(std::move(zone.tangential_depth_mm));
  dict["triangles"] = array_of(std::move(zone.triangles));
  dict["area_mm2"] = zone.area_mm2;
  dict["centroid"] = optional_array(zone.centroid_mm);
  return dict;
}

py::object degrees(const std::optional<Angle>& angle) {
  return angle ? py::object(py::float_(angle->degrees())) : py::none();
}

py::list zones_of(const RangeHandle& handle, const py::list& given, double past_deg,
                  const py::object& progress) {
  const std::vector<motion::Motion> motions = motions_in(given);
  auto zones = followed(progress, [&](const auto& report, const std::stop_token& stop) {
    const motion::ZoneFinder finder(handle.joint, motion::ZoneOptions{.bearing = handle.options.bearing,
                                                                      .past = Angle::degrees(past_deg)});
    std::vector<std::optional<motion::ImpingementZone>> found;
    each_limit(handle.range, motions, stop, [&](motion::MotionLimit&& limit) {
      found.push_back(finder.zone(limit));
      report(found.size(), motions.size());
    });
    return found;
  });
  py::list list;
  for (std::optional<motion::ImpingementZone>& zone : zones) {
    if (!zone) {
      list.append(py::none());
      continue;
    }
    py::dict dict;
    dict["limit"] = dict_of(zone->limit);
    dict["past_deg"] = zone->past.degrees();
    dict["fixed"] = zone_dict(std::move(zone->fixed));
    dict["mobile"] = zone_dict(std::move(zone->mobile));
    dict["contact_hour"] = zone->contact_hour;
    dict["zone_hour"] = zone->zone_hour;
    dict["contact_neck_angle_deg"] = degrees(zone->contact_neck_angle);
    dict["zone_neck_angle_deg"] = degrees(zone->zone_neck_angle);
    list.append(dict);
  }
  return list;
}

}  // namespace

void bind_zones(py::module_& module) {
  module.def("impingement_zones", &zones_of);
}

}  // namespace condyle::python
