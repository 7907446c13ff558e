#include <pybind11/stl.h>

#include "arrays.hpp"
#include "bindings.hpp"
#include "condyle/answer.hpp"
#include "interrupts.hpp"
#include "motion.hpp"

namespace condyle::python {
namespace {

/// Frames of a recorded motion, without gaps.
FollowRecord record_in(const Joint& joint, const py::object& poses) {
  FollowRecord record;
  for (const std::optional<Pose>& X_FM : poses_with_gaps_in(poses, "poses"))
    if (X_FM) record.frames.push_back(coordinates_at(joint.coordinates(), *X_FM, joint.translation_frame));
  return record;
}

FollowLoad load_in(const ElasticContact& layers, const py::dict& given) {
  FollowLoad load{.layers = &layers, .step = Angle::degrees(given["step_deg"].cast<double>())};
  load.load.on_mobile.force_n = vector_in(given["force_n"], "force_n");
  load.load.frame = given["frame"].cast<std::string>() == "mobile" ? BodyRole::mobile : BodyRole::fixed;
  const PointsIn directions(given["free_directions"], "free_directions");
  for (std::size_t i = 0; i < directions.size(); ++i)
    load.balance.free_directions.emplace_back(directions.view()[i]);
  return load;
}

/// Limits, (code, text) of notes, caveats. `layers` is null with poses, and poses are none with layers. Motions that a record does
/// not lead along are left out where `only_recorded`.
py::tuple followed_limits(const JointHandle& handle, const py::list& motions, const py::object& poses,
                          const ElasticContact* layers, const py::dict& given, const py::object& progress) {
  RangeRequest request;
  request.motions = motions_in(motions);
  if (given["count_bearing"].cast<bool>()) request.range.bearing.rule = BearingRule::count;
  request.range.bearing.margin_mm = given["bearing_margin_mm"].cast<std::optional<double>>();
  if (layers) {
    request.follow = load_in(*layers, given);
  } else {
    FollowRecord record = record_in(handle.joint(), poses);
    if (given["only_recorded"].cast<bool>()) request.motions = motions_recorded(request.motions, record);
    request.follow = std::move(record);
  }
  const RangeAnswer answer = followed(progress, [&](const auto& report, const std::stop_token& stop) {
    auto found = answer_range(
        handle.joint(), handle.loaded.report.placement, request,
        {[&](std::string_view, std::size_t done, std::size_t total) { report(done, total); }, stop});
    return found ? *found : RangeAnswer{.joint = handle.joint()};
  });
  py::list limits, notes;
  for (const MotionLimit& limit : answer.limits) limits.append(dict_of(limit));
  for (const RangeNote& note : answer.notes)
    notes.append(py::make_tuple(std::string(name_of(note.code)), note.text));
  return py::make_tuple(limits, notes, answer.caveats);
}

}  // namespace

void bind_followed_range(py::module_& module) {
  module.def("followed_limits", &followed_limits);
}

}  // namespace condyle::python
