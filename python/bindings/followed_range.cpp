#include <pybind11/stl.h>

#include "arrays.hpp"
#include "bindings.hpp"
#include "motion.hpp"
#include "range_answer.hpp"

namespace condyle::python {
namespace {

/// Frames of a recorded motion, without gaps.
FollowRecord record_in(const Joint& joint, const py::object& poses) {
  FollowRecord record;
  for (const std::optional<Pose>& X_FM : poses_with_gaps_in(poses, "poses"))
    if (X_FM) record.frames.push_back(coordinates_at(joint.coordinates(), *X_FM, joint.translation_frame));
  return record;
}

FollowLoad load_in(const contact::ElasticContact& layers, const py::dict& given) {
  FollowLoad load{.layers = &layers, .step = Angle::degrees(given["step_deg"].cast<double>())};
  load.load.on_mobile.force_n = vector_in(given["force_n"], "force_n");
  load.load.frame = given["frame"].cast<std::string>() == "mobile" ? BodyRole::mobile : BodyRole::fixed;
  const PointsIn directions(given["free_directions"], "free_directions");
  for (std::size_t i = 0; i < directions.size(); ++i)
    load.balance.free_directions.emplace_back(directions.view()[i]);
  return load;
}

/// The request: `layers` is null with poses, and poses are empty with layers. With `only_recorded`, motions that the record does not
/// follow are left out.
RangeRequest followed_request_in(const JointHandle& handle, const py::list& motions, const py::object& poses,
                                 const contact::ElasticContact* layers, const py::dict& given) {
  RangeRequest request{.motions = motions_in(motions), .range = {.bearing = bearing_in(given)}};
  if (layers) {
    request.follow = load_in(*layers, given);
    return request;
  }
  FollowRecord record = record_in(handle.joint(), poses);
  if (given["only_recorded"].cast<bool>())
    // With none the answer is refused, and says why.
    if (std::vector<motion::Motion> led = motions_recorded(request.motions, record); !led.empty())
      request.motions = std::move(led);
  request.follow = std::move(record);
  return request;
}

std::unique_ptr<RangeHandle> followed_range(const JointHandle& handle, const py::list& motions,
                                            const py::object& poses, const contact::ElasticContact* layers,
                                            const py::dict& given, const py::object& progress) {
  return answered_range(handle, followed_request_in(handle, motions, poses, layers, given), progress);
}

}  // namespace

void bind_followed_range(py::module_& module) {
  module.def("followed_range", &followed_range);
}

}  // namespace condyle::python
