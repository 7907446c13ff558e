#include "range_answer.hpp"

#include <pybind11/stl.h>

#include <memory>
#include <utility>

#include "interrupts.hpp"
#include "io/result/rom_parts.hpp"
#include "json_object.hpp"
#include "motion.hpp"

namespace condyle::python {
motion::BearingOptions bearing_in(const py::dict& given) {
  motion::BearingOptions bearing;
  if (given["count_bearing"].cast<bool>()) bearing.rule = motion::BearingRule::count;
  bearing.margin_mm = given["bearing_margin_mm"].cast<std::optional<double>>();
  return bearing;
}

std::optional<BandRequest> band_in(const py::object& given) {
  if (given.is_none()) return std::nullopt;
  const auto band = given.cast<py::tuple>();
  const auto sigma = [&](std::size_t i) { return band[i].cast<std::optional<double>>(); };
  return BandRequest{.samples = band[0].cast<std::size_t>(),
                     .seed = band[1].cast<std::optional<std::uint64_t>>(),
                     .centre_mm = sigma(2),
                     .axes_deg = sigma(3),
                     .surface_mm = sigma(4)};
}

std::unique_ptr<RangeHandle> answered_range(const JointHandle& handle, RangeRequest request,
                                            const py::object& progress) {
  Case asked = handle.loaded;
  RangeAnswer answer =
      *with_progress(progress, [&](const Control& control) { return answer_range(asked, request, control); });
  request.follow.reset();
  return std::make_unique<RangeHandle>(RangeHandle{std::move(asked), std::move(request), std::move(answer)});
}

RangeAnswer further_answered(const RangeHandle& handle, RangeRequest beside, const py::object& progress) {
  beside.range = handle.request.range;
  return *with_progress(progress, [&](const Control& control) {
    return further_answer(handle.asked, handle.answer, beside, control);
  });
}

py::list limits_of(const io::RomResult& result) {
  py::list list;
  for (std::size_t i = 0; i < result.answer.limits.size(); ++i) {
    const auto& soft = result.answer.limits[i].end.soft_contact;
    py::dict dict;
    dict["said"] = object_of(io::motion_json(result, i));
    dict["soft_contact"] = soft ? dict_of(soft->contact, io::frame_of(result)) : py::none();
    list.append(dict);
  }
  return list;
}

py::list limits_of(const Joint& joint, std::span<const motion::MotionLimit> limits) {
  const RangeAnswer answer{.joint = joint, .limits = {limits.begin(), limits.end()}};
  return limits_of(io::rom_result_of(answer, {}, nullptr));
}

py::dict answer_dict(const io::RomResult& result) {
  io::Json json = io::rom_object(result);
  json.erase("motions");
  py::dict dict = object_of(std::move(json));
  dict["limits"] = limits_of(result);
  return dict;
}

}  // namespace condyle::python
