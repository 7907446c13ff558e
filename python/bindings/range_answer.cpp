#include "range_answer.hpp"

#include <pybind11/stl.h>

#include "interrupts.hpp"
#include "io/result/rom_parts.hpp"
#include "motion.hpp"

namespace condyle::python {
namespace {

/// As Python reads it: numbers to the last bit.
py::object object_of(io::Json json) {
  return py::module_::import("json").attr("loads")(io::document(std::move(json)));
}

}  // namespace

motion::BearingOptions bearing_in(const py::dict& given) {
  motion::BearingOptions bearing;
  if (given["count_bearing"].cast<bool>()) bearing.rule = motion::BearingRule::count;
  bearing.margin_mm = given["bearing_margin_mm"].cast<std::optional<double>>();
  return bearing;
}

RangeAnswer answered_range(const JointHandle& handle, const RangeRequest& request,
                           const py::object& progress) {
  return *followed(progress, [&](const auto& report, const std::stop_token& stop) {
    return answer_range(
        handle.joint(), handle.loaded.report.placement, request,
        {[&](std::string_view, std::size_t done, std::size_t total) { report(done, total); }, stop});
  });
}

py::list limits_of(const io::RomResult& result) {
  py::list list;
  for (std::size_t i = 0; i < result.limits.size(); ++i) {
    py::dict dict = dict_of(result.limits[i], io::frame_of(result));
    dict["said"] = object_of(io::motion_json(result, i));
    list.append(dict);
  }
  return list;
}

py::list limits_of(const Joint& joint, std::span<const motion::MotionLimit> limits) {
  return limits_of({.joint = joint, .limits = limits});
}

py::dict answer_dict(const io::RomResult& result) {
  io::Json json = io::rom_object(result);
  json.erase("motions");
  py::dict dict = object_of(std::move(json));
  dict["limits"] = limits_of(result);
  return dict;
}

}  // namespace condyle::python
