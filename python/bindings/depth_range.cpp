#include <pybind11/stl.h>

#include "arrays.hpp"
#include "bindings.hpp"
#include "condyle/range_of_motion.hpp"
#include "interrupts.hpp"
#include "motion.hpp"
#include "range_answer.hpp"

namespace condyle::python {
namespace {

std::unique_ptr<motion::DepthRange> depth_range(const JointHandle& handle, double depth_mm, double step_deg,
                                                double tolerance_deg) {
  const motion::AllowedDepth allowed{depth_mm, Angle::degrees(step_deg), Angle::degrees(tolerance_deg)};
  const py::gil_scoped_release released;
  return std::make_unique<motion::DepthRange>(handle.joint(), allowed);
}

py::dict place_dict(const motion::DeepestPlace& place) {
  py::dict dict;
  dict["depth_mm"] = place.depth_mm;
  dict["contact"] = dict_of(place.contact);
  dict["ray_to_normal_deg"] = place.ray_to_normal.degrees();
  return dict;
}

py::dict deepest(const motion::DepthRange& range, const py::object& angles_deg) {
  const JointAngles at = angles_in(angles_deg, "angles");
  return place_dict(without_lock([&] { return range.deepest(at); }));
}

py::list limits_by_depth(const motion::DepthRange& range, const JointHandle& handle, const py::list& given,
                         const py::object& progress) {
  const std::vector<motion::Motion> motions = motions_in(given);
  RangeAnswer found{.joint = handle.joint()};
  with_progress(progress, [&](const Control& control) {
    for (const motion::Motion& motion : motions) {
      if (control.stop.stop_requested()) break;
      found.depths.push_back(range.limit(motion));
      found.limits.push_back(found.depths.back().limit);
      control.progress("motions", found.depths.size(), motions.size());
    }
    return true;
  });
  const py::list limits = limits_of(io::rom_result_of(found, {}, nullptr));
  py::list list;
  for (const motion::DepthLimit& limit : found.depths) {
    py::dict dict;
    dict["limit"] = limits[list.size()];
    dict["at_limit"] = place_dict(limit.at_limit);
    dict["start_depth_mm"] = limit.start_depth_mm;
    dict["depth_grows"] = limit.depth_grows;
    list.append(dict);
  }
  return list;
}

}  // namespace

void bind_depth_range(py::module_& module) {
  py::class_<motion::DepthRange>(module, "DepthRange")
      .def(py::init(&depth_range))
      .def("deepest", &deepest)
      .def("limits", &limits_by_depth);
}

}  // namespace condyle::python
