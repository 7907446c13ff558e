#include "condyle/range_of_motion.hpp"

#include <pybind11/stl.h>

#include "arrays.hpp"
#include "bindings.hpp"
#include "interrupts.hpp"
#include "motion.hpp"
#include "range_answer.hpp"

namespace condyle::python {
namespace {

motion::RangeOptions options_in(const JointHandle& handle, const py::dict& given) {
  motion::RangeOptions options{.bearing = bearing_in(given)};
  options.overlap.reference_pose = handle.loaded.report.placement.reference_pose.angles;
  if (given["accept_reference_contact"].cast<bool>())
    options.overlap.reference_contact = motion::ReferenceContact::accept;
  if (const auto rings = given["leave_out_rings"].cast<std::optional<int>>())
    options.overlap.leave_out_reference_contacts = motion::LeaveOutReferenceContacts{*rings};
  return options;
}

std::unique_ptr<RangeHandle> range_of_motion(const JointHandle& handle, const py::list& motions,
                                             const py::object& translation_mm, bool is_by_rim,
                                             const py::dict& given) {
  RangeRequest request{.motions = motions_in(motions), .range = options_in(handle, given)};
  if (!translation_mm.is_none()) request.translation_mm = vector_in(translation_mm, "translation_mm");
  if (is_by_rim) request.clock = motion::ClockPlane::rim;
  return answered_range(handle, std::move(request), py::none());
}

py::list limits(const RangeHandle& handle, const py::list& motions) {
  const RangeAnswer found = further_answered(handle, {.motions = motions_in(motions)}, py::none());
  return limits_of(io::rom_result_of(found, {}, nullptr));
}

py::dict free_angles(const RangeHandle& handle, std::size_t vary, const py::object& start,
                     double negative_deg, double positive_deg) {
  const JointAngles from = angles_in(start, "start");
  const motion::RotationRange range{Angle::degrees(negative_deg), Angle::degrees(positive_deg)};
  const motion::FreeAngles found =
      without_lock([&] { return handle.answer.range->free_angles(angle_numbered(vary), from, range); });
  const io::AnswerFrame frame = io::frame_of(handle.result());
  py::list intervals;
  for (const motion::FreeInterval& interval : found.intervals)
    intervals.append(py::make_tuple(interval.low.degrees(), interval.high.degrees(),
                                    dict_of(interval.at_low, frame), dict_of(interval.at_high, frame)));
  py::dict dict;
  dict["negative"] = dict_of(found.from_start.negative, frame);
  dict["positive"] = dict_of(found.from_start.positive, frame);
  dict["intervals"] = intervals;
  return dict;
}

py::list built_in(const JointHandle& handle) {
  py::list list;
  for (const motion::Motion& motion : Case(handle.loaded).motions()) list.append(tuple_of(motion));
  return list;
}

py::dict path_limit(const JointHandle& handle, const py::object& given, double tolerance_deg,
                    const py::dict& options) {
  const PointsIn degrees(given, "waypoints");
  std::vector<JointAngles> waypoints;
  for (std::size_t i = 0; i < degrees.size(); ++i) {
    const Vec3 at = degrees.view()[i];
    waypoints.push_back({Angle::degrees(at[0]), Angle::degrees(at[1]), Angle::degrees(at[2])});
  }
  const motion::RangeOptions range = options_in(handle, options);
  const motion::PathLimit limit = with_progress(py::none(), [&](const Control&) {
    return motion::PathFinder(handle.joint(), range).limit(waypoints, Angle::degrees(tolerance_deg));
  });
  py::dict dict;
  dict["segment"] = limit.segment;
  dict["fraction"] = limit.fraction;
  dict["angles_deg"] = std::array{limit.at.flexion.degrees(), limit.at.adduction.degrees(),
                                  limit.at.internal_rotation.degrees()};
  dict["reason"] = name_of(limit.reason);
  dict["contact"] = dict_of(limit.contact);
  dict["distance_mm"] = limit.distance_mm;
  return dict;
}

}  // namespace

void bind_range_of_motion(py::module_& module) {
  py::class_<RangeHandle>(module, "RangeOfMotion")
      .def("answer", [](const RangeHandle& handle) { return answer_dict(handle.result()); })
      .def("limits", &limits)
      .def("free_angles", &free_angles)
      .def_property_readonly("bearing_triangles",
                             [](const RangeHandle& handle) {
                               return array_of(std::vector(handle.answer.bearing.surface.value().triangles));
                             })
      .def_property_readonly("left_out", [](const RangeHandle& handle) {
        const motion::LeftOut& left_out = handle.answer.range->left_out();
        return py::make_tuple(left_out.fixed_triangles, left_out.mobile_triangles);
      });
  module.def("range_of_motion", &range_of_motion);
  module.def("motions", &built_in);
  module.def("path_limit", &path_limit);
}

}  // namespace condyle::python
