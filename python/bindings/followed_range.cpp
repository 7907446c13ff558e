#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

#include "arrays.hpp"
#include "bindings.hpp"
#include "io/report/report.hpp"
#include "motion.hpp"
#include "range_answer.hpp"
#include "report_labels.hpp"

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

py::dict followed_limits(const JointHandle& handle, const py::list& motions, const py::object& poses,
                         const contact::ElasticContact* layers, const py::dict& given,
                         const py::object& progress) {
  const RangeAnswer answer =
      answered_range(handle, followed_request_in(handle, motions, poses, layers, given), progress);
  return answer_dict(io::rom_result_of(answer, {}, nullptr));
}

void write_followed_report(const JointHandle& handle, const std::filesystem::path& path,
                           const std::optional<std::string>& title, const py::list& motions,
                           const py::object& poses, const contact::ElasticContact* layers,
                           const py::dict& given, const LabelArguments& labels, const py::object& progress) {
  const io::LoadedJoint& loaded = handle.loaded;
  std::optional<io::Provenance> from;
  if (!loaded.report.file.path.empty())
    from = io::provenance_of(loaded, {"condyle.FollowedRange.write_report"});
  io::check_report_file(path, from ? &*from : nullptr);
  const RangeAnswer answer =
      answered_range(handle, followed_request_in(handle, motions, poses, layers, given), progress);
  const py::gil_scoped_release released;
  const std::vector<JointNote> notes = check_joint(loaded.joint, loaded.report.placement);
  const io::RomResult rom = io::rom_result_of(answer, notes, from ? &*from : nullptr);
  io::write_report(path, {.title = title.value_or(loaded.joint.name),
                          .joint = loaded.joint,
                          .reference_pose = loaded.report.placement.reference_pose,
                          .rom = &rom,
                          .labels = report_labels_of(labels)});
}

}  // namespace

void bind_followed_range(py::module_& module) {
  module.def("followed_limits", &followed_limits);
  module.def("write_followed_report", &write_followed_report);
}

}  // namespace condyle::python
