#include "io/report/answer_report.hpp"

#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

#include "arrays.hpp"
#include "bindings.hpp"
#include "condyle/error.hpp"
#include "condyle/hip_measures.hpp"
#include "condyle/io/picture.hpp"
#include "interrupts.hpp"
#include "io/file/input_recorder.hpp"
#include "io/result/provenance_forms.hpp"
#include "range_answer.hpp"
#include "resection.hpp"
#include "sweep.hpp"

namespace condyle::python {
namespace {

/// Case, note, date, and whether files are named by their whole paths.
using LabelArguments =
    std::tuple<std::optional<std::string>, std::optional<std::string>, std::optional<std::string>, bool>;

io::ReportLabels report_labels_of(const LabelArguments& given) {
  const auto& [case_name, note, date, whole_paths] = given;
  return {case_name, note, date, whole_paths};
}

/// Nothing where the joint was made of arrays: there are no files to name.
std::optional<io::Provenance> files_of(const io::LoadedJoint& loaded, const char* by) {
  if (loaded.report.file.path.empty()) return std::nullopt;
  return io::provenance_of(loaded, {by});
}

/// Throws UsageError for a sweep of another joint.
void check_sweep_of(const SweepHandle& sweep, const io::LoadedJoint& of_page) {
  io::check_shown_sweep(sweep.request.parameters, sweep.request.targets.size());
  const auto same = [](const Body& a, const Body& b) { return a.mesh.vertices() == b.mesh.vertices(); };
  if (!same(sweep.loaded.joint.fixed, of_page.joint.fixed) ||
      !same(sweep.loaded.joint.mobile, of_page.joint.mobile))
    throw UsageError("sweep: it is that of another joint than the limits");
}

/// What is known already is not asked again: the plan, the sweep, and limits without bands and zones.
io::ReportAnswer known_of(const RangeHandle& range, const io::ReportRequest& request, const PlanHandle* plan,
                          const SweepHandle* sweep) {
  io::ReportAnswer known;
  if (!request.range.bands && !request.range.zones_past) known.range.answer = range.answer;
  if (plan) known.plan = plan->answer;
  if (sweep) known.sweep = sweep->answer;
  return known;
}

/// What is said beside a page.
struct Said {
  std::vector<motion::ContactNote> notes = {};
  std::vector<std::string> remarks = {};
};

/// Notes on motion and layers, and remarks: how the motion was read, and why the joint before has no limits.
py::tuple report(const RangeHandle& range, const JointHandle& handle, const std::filesystem::path& path,
                 const std::optional<std::string>& title, const py::object& band,
                 const std::optional<double>& past_deg, bool with_measures, const PlanHandle* plan,
                 const JointHandle* with, const SweepHandle* sweep,
                 const std::optional<std::filesystem::path>& recorded, bool with_pressure,
                 const LabelArguments& labels, const py::object& progress) {
  const io::LoadedJoint& loaded = plan ? plan->loaded : handle.loaded;
  if (sweep) check_sweep_of(*sweep, loaded);
  if (with)
    io::check_comparable(with->loaded.joint, with->loaded.joint.name, loaded.joint, loaded.joint.name);
  io::ReportRequest request{
      .range = range.request, .with_pressure = with_pressure, .with_measures = with_measures};
  request.range.bands = band_in(band);
  if (past_deg) request.range.zones_past = Angle::degrees(*past_deg);
  if (with) request.before = &with->loaded;
  const char* by =
      range.answer.follows ? "condyle.FollowedRange.write_report" : "condyle.RangeOfMotion.write_report";
  std::optional<io::Provenance> from = files_of(loaded, by), from_before;
  if (with) from_before = files_of(with->loaded, by);
  const auto pointer = [](std::optional<io::Provenance>& to) { return to ? &*to : nullptr; };
  if (from && recorded) from->read.push_back(*recorded);
  io::check_report_file(path, pointer(from));
  if (with) io::check_report_file(path, pointer(from_before));
  const Said said = with_progress(progress, [&](const Control& control) {
    const io::InputRecorder read;
    if (recorded) request.motion = io::read_motion_table(*recorded);
    const auto answer = io::answer_report(loaded, request, control, known_of(range, request, plan, sweep));
    if (!answer) return Said{};
    if (!answer->range.answer) throw MeshError(answer->range.why_none);
    const auto notes_on = [](const io::LoadedJoint& of) {
      return check_joint(of.joint, of.report.placement);
    };
    const std::vector<JointNote> of_joint = notes_on(loaded),
                                 before = with ? notes_on(with->loaded) : std::vector<JointNote>();
    if (from) io::add_other_files(*from, read);
    io::write_report(path, loaded, request, *answer,
                     {.title = title,
                      .labels = report_labels_of(labels),
                      .notes = of_joint,
                      .notes_before = before,
                      .from = pointer(from),
                      .from_before = pointer(from_before)});
    Said beside{answer->contact_notes};
    if (answer->recorded) beside.remarks = answer->recorded->motion.processing;
    if (with && !answer->before.answer)
      beside.remarks.push_back(with->loaded.joint.name + ": no limits: " + answer->before.why_none);
    return beside;
  });
  return py::make_tuple(notes_of(said.notes), said.remarks);
}

io::BodyStyle style_named(const std::string& name) {
  return name == "solid"         ? io::BodyStyle::solid
         : name == "transparent" ? io::BodyStyle::transparent
                                 : io::BodyStyle::hidden;
}

io::PictureColour colour_named(const std::string& name) {
  return name == "depth"     ? io::PictureColour::depth
         : name == "gap"     ? io::PictureColour::gap
         : name == "nearest" ? io::PictureColour::nearest
                             : io::PictureColour::none;
}

/// (height, width, 3), uint8.
py::array_t<std::uint8_t> picture(const JointHandle& handle, const py::object& pose, const std::string& view,
                                  const std::string& colour, const py::object& about,
                                  const std::string& fixed, const std::string& mobile, std::size_t width,
                                  std::size_t height, const std::optional<double>& range_mm,
                                  const std::optional<double>& field_mm, bool with_measures, bool is_plain) {
  const Pose X_FM = one_pose(pose, "pose");
  const Joint& joint = handle.joint();
  io::PictureOptions options{.view = io::view_named(view, joint.side),
                             .colour = colour_named(colour),
                             .about = about.is_none() ? std::nullopt : std::optional(about_in(about)),
                             .fixed = style_named(fixed),
                             .mobile = style_named(mobile),
                             .width = width,
                             .height = height,
                             .range_mm = range_mm,
                             .field_mm = field_mm,
                             .is_annotated = !is_plain};
  const io::Picture drawn = with_progress(py::none(), [&](const Control&) {
    if (with_measures) options.marks = io::measure_marks(measure::measure_hip(joint), X_FM);
    return io::draw_joint(joint, angles_at(joint.coordinates(), X_FM), X_FM, options);
  });
  py::array_t<std::uint8_t> pixels({drawn.height, drawn.width, std::size_t{3}});
  std::copy(drawn.rgb.begin(), drawn.rgb.end(), pixels.mutable_data());
  return pixels;
}

}  // namespace

void bind_report(py::module_& module) {
  module.def("write_report", &report);
  module.def("picture", &picture);
}

}  // namespace condyle::python
