#include "io/report/report.hpp"

#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

#include "arrays.hpp"
#include "bindings.hpp"
#include "condyle/hip_measures.hpp"
#include "condyle/io/picture.hpp"
#include "interrupts.hpp"
#include "io/joint/measure_request.hpp"
#include "range_answer.hpp"
#include "report_labels.hpp"
#include "resection.hpp"
#include "sweep.hpp"

namespace condyle::python {
namespace {

/// Nothing where the joint was made of arrays: there are no files to name.
std::optional<io::Provenance> files_of(const io::LoadedJoint& loaded) {
  if (loaded.report.file.path.empty()) return std::nullopt;
  return io::provenance_of(loaded, {"condyle.RangeOfMotion.write_report"});
}

/// The same question for the joint before: without a map and zones, and a free joint is held where its own reference pose has it if
/// that of the page is.
RangeRequest request_before(RangeRequest request, const JointPlacement& of_page) {
  request.zones_past.reset();
  if (request.translation_mm == of_page.reference_pose.translation_mm) request.translation_mm.reset();
  return request;
}

/// The joint before, with its limits or why it has none. What a report takes of it refers to its members.
struct JointBefore {
  explicit JointBefore(const io::LoadedJoint& joint)
      : loaded(joint), notes(check_joint(joint.joint, joint.report.placement)), from(files_of(joint)) {}
  JointBefore(const JointBefore&) = delete;
  JointBefore& operator=(const JointBefore&) = delete;

  /// False if stopped.
  bool answer_range_request(const RangeRequest& request, const AnswerControl& control) {
    try {
      answer = answer_range(loaded.joint, loaded.report.placement, request, control);
      if (answer) rom.emplace(io::rom_result_of(*answer, notes, from ? &*from : nullptr));
      return answer.has_value();
    } catch (const MeshError& failed) {
      error = failed.what();
      return true;
    }
  }

  io::ReportedBefore reported() const {
    return {.joint = loaded.joint,
            .file = loaded.report.file.path,
            .rom = rom ? &*rom : nullptr,
            .rom_error = error};
  }

  const io::LoadedJoint& loaded;
  std::vector<JointNote> notes;
  std::optional<io::Provenance> from;
  std::optional<RangeAnswer> answer;
  std::optional<io::RomResult> rom;
  std::string error;
};

/// The sweep of a page; throws UsageError for one of another joint.
io::SweepResult shown_sweep(const SweepHandle& sweep, const io::LoadedJoint& of_page) {
  io::check_shown_sweep(sweep.query.parameters, sweep.query.targets.size());
  const auto same = [](const Body& a, const Body& b) { return a.mesh.vertices() == b.mesh.vertices(); };
  if (!same(sweep.loaded.joint.fixed, of_page.joint.fixed) ||
      !same(sweep.loaded.joint.mobile, of_page.joint.mobile))
    throw UsageError("sweep: it is that of another joint than the limits");
  return io::sweep_result_of(sweep.loaded, sweep.answer, sweep.query, {}, nullptr);
}

void report(const RangeHandle& range, const JointHandle& handle, const std::filesystem::path& path,
            const std::optional<std::string>& title, std::size_t band_samples,
            std::optional<std::uint64_t> seed, const std::optional<double>& past_deg, bool with_measures,
            const PlanHandle* plan, const JointHandle* with, const SweepHandle* sweep,
            const LabelArguments& labels, const py::object& progress) {
  const io::LoadedJoint& loaded = handle.loaded;
  std::optional<io::SweepResult> swept;
  if (sweep) swept = shown_sweep(*sweep, loaded);
  if (with)
    io::check_comparable(with->loaded.joint, with->loaded.joint.name, loaded.joint, loaded.joint.name);
  const io::JointFile& file = loaded.report.file;
  RangeRequest request = range.request;
  if (band_samples > 0)
    request.bands = {
        .sigma = file.uncertainty, .samples = band_samples, .seed = seed.value_or(file.band_seed)};
  if (past_deg) request.zones_past = Angle::degrees(*past_deg);
  std::optional<io::Provenance> from = files_of(loaded);
  io::check_report_file(path, from ? &*from : nullptr);
  if (with) {
    const std::optional<io::Provenance> before = files_of(with->loaded);
    io::check_report_file(path, before ? &*before : nullptr);
  }
  followed(progress, [&](const auto& follow, const std::stop_token& stop) {
    const auto by_stage = [&](std::string_view, std::size_t done, std::size_t total) { follow(done, total); };
    const auto answer = answer_range(loaded.joint, loaded.report.placement, request, {by_stage, stop});
    if (!answer) return true;
    const std::vector<JointNote> notes = check_joint(loaded.joint, loaded.report.placement);
    io::Provenance* const provenance = from ? &*from : nullptr;
    const io::RomResult rom = io::rom_result_of(*answer, notes, provenance);
    io::Report page{.title = title.value_or(loaded.joint.name),
                    .joint = loaded.joint,
                    .reference_pose = loaded.report.placement.reference_pose,
                    .rom = &rom,
                    .bearing_margin_mm = request.range.bearing.margin_mm,
                    .labels = report_labels_of(labels)};
    if (file.recorded_motion) page.recorded_motion = &*file.recorded_motion;
    if (swept) page.sweep = &*swept;
    std::optional<MeasureAnswer> measures;
    std::optional<io::MeasureResult> shape;
    if (with_measures) {
      measures =
          answer_measures(loaded.joint, {io::measure_request_of(loaded), request.bands}, {by_stage, stop});
      if (!measures) return true;
      page.measures = &shape.emplace(io::MeasureResult{loaded.joint, *measures, notes, provenance});
    }
    std::optional<io::ResectionResult> cut;
    if (plan)
      page.plan = &cut.emplace(io::ResectionResult{plan->loaded.joint, plan->answer, notes, provenance,
                                                   &plan->loaded.report.file});
    std::optional<JointBefore> before;
    if (with) {
      before.emplace(with->loaded);
      const RangeRequest asked = request_before(request, loaded.report.placement);
      if (!before->answer_range_request(asked, {by_stage, stop})) return true;
      page.before.emplace(before->reported());
    }
    io::write_report(path, page);
    return true;
  });
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
                                  const std::string& colour, const std::string& fixed,
                                  const std::string& mobile, std::size_t width, std::size_t height,
                                  const std::optional<double>& range_mm,
                                  const std::optional<double>& field_mm, bool with_measures, bool is_plain) {
  const Pose X_FM = one_pose(pose, "pose");
  const Joint& joint = handle.joint();
  io::PictureOptions options{.view = io::view_named(view, joint.side),
                             .colour = colour_named(colour),
                             .fixed = style_named(fixed),
                             .mobile = style_named(mobile),
                             .width = width,
                             .height = height,
                             .range_mm = range_mm,
                             .field_mm = field_mm,
                             .is_annotated = !is_plain};
  const io::Picture drawn = followed(py::none(), [&](const auto&, const std::stop_token&) {
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
