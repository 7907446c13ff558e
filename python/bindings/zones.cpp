#include <pybind11/stl.h>

#include "arrays.hpp"
#include "bindings.hpp"
#include "condyle/impingement_zone.hpp"
#include "motion.hpp"
#include "range_answer.hpp"

namespace condyle::python {
namespace {

py::dict zone_dict(motion::BodyZone&& zone, const std::optional<Vec3>& centroid) {
  py::dict dict;
  dict["radial_depth_mm"] = array_of(std::move(zone.radial_depth_mm));
  dict["ray_to_normal_deg"] = array_of(std::move(zone.ray_to_normal_deg));
  dict["tangential_depth_deg"] = array_of(std::move(zone.tangential_depth_deg));
  dict["tangential_depth_mm"] = array_of(std::move(zone.tangential_depth_mm));
  dict["triangles"] = array_of(std::move(zone.triangles));
  dict["area_mm2"] = zone.area_mm2;
  dict["centroid"] = optional_array(centroid);
  return dict;
}

py::object degrees(const std::optional<Angle>& angle) {
  return angle ? py::object(py::float_(angle->degrees())) : py::none();
}

py::list zones_of(const RangeHandle& handle, const py::list& given, double past_deg,
                  const py::object& progress) {
  RangeAnswer found = further_answered(
      handle, {.motions = motions_in(given), .zones_past = Angle::degrees(past_deg)}, progress);
  const py::list limit_dicts = limits_of(io::rom_result_of(found, {}, nullptr));
  const io::AnswerFrame frame = io::frame_of(handle.result());
  py::list list;
  for (std::size_t i = 0; i < found.zones.size(); ++i) {
    std::optional<motion::ImpingementZone>& zone = found.zones[i];
    if (!zone) {
      list.append(py::none());
      continue;
    }
    py::dict dict;
    dict["limit"] = limit_dicts[i];
    dict["past_deg"] = zone->past.degrees();
    const std::optional<Vec3> mobile = zone->mobile.centroid_mm;
    std::optional<Vec3> fixed = zone->fixed.centroid_mm;
    if (fixed) fixed = frame.fixed_point(*fixed);
    dict["fixed"] = zone_dict(std::move(zone->fixed), fixed);
    dict["mobile"] = zone_dict(std::move(zone->mobile), mobile);
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
