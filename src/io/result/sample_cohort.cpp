#include <fmt/format.h>

#include <atomic>
#include <exception>
#include <mutex>
#include <string>

#include "condyle/error.hpp"
#include "condyle/io/pose_text.hpp"
#include "condyle/sample/hip.hpp"
#include "condyle/version.hpp"
#include "core/parallel_tasks.hpp"
#include "io/file/csv_fields.hpp"
#include "io/file/whole_file.hpp"
#include "io/result/json.hpp"
#include "io/result/sample_files.hpp"

namespace condyle::io {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t most_hips = 10'000'000;

std::string folder_name(std::size_t k) {
  return fmt::format("hips/{:06}", k);
}

Side side_of(const sample::CohortHip& hip) {
  return hip.is_left ? Side::left : Side::right;
}

/// As a column of the table has it; empty for a hip without a cam.
std::string field_of(const sample::HipMeasure& measure, const sample::HipParameters& of) {
  const auto value = measure.value(of);
  return value ? fmt::format("{:.1f}", *value) : "";
}

std::string table_of(const SampleCohort& cohort) {
  const bool in_files = cohort.meshes == CohortMeshes::in_files;
  std::vector<std::string> header = {"id", in_files ? "joint" : "sample", "side"};
  for (const sample::HipMeasure& measure : sample::hip_measures()) header.emplace_back(measure.name);
  header.emplace_back("bone_alpha_angle_deg");
  std::string text = io::csv_line(header);
  for (std::size_t k = 1; k <= cohort.n; ++k) {
    const sample::CohortHip hip = sample::cohort_hip(cohort.seed, k);
    std::vector<std::string> fields = {
        fmt::format("hip_{:06}", k),
        in_files ? folder_name(k) + "/hip.toml" : fmt::format("{}", static_cast<int>(cohort.scenario)),
        std::string(name_of(side_of(hip)))};
    for (const sample::HipMeasure& measure : sample::hip_measures())
      fields.push_back(field_of(measure, hip.measures));
    fields.push_back(fmt::format("{:.1f}", hip.alpha_angle.degrees()));
    text += io::csv_line(fields);
  }
  return text;
}

std::string description_of(const SampleCohort& cohort) {
  Json json{{"condyle", version},
            {"hips", cohort.n},
            {"seed", cohort.seed},
            {"scenario", static_cast<int>(cohort.scenario)},
            {"meshes", cohort.meshes == CohortMeshes::in_files}};
  for (const sample::MeasureDistribution& d : sample::cohort_distributions())
    json["distributions"].push_back({{"measure", d.measure},
                                     {"unit", d.unit},
                                     {"distribution", "normal, cut off"},
                                     {"mean", d.mean},
                                     {"standard_deviation", d.standard_deviation},
                                     {"low", d.low},
                                     {"high", d.high}});
  return io::document(json);
}

void write_hip(const fs::path& folder, const SampleCohort& cohort, std::size_t k) {
  const sample::CohortHip drawn = sample::cohort_hip(cohort.seed, k);
  sample::SampleHip hip = [&] {
    try {
      return sample::sample_hip(drawn.measures, cohort.scenario);
    } catch (const UsageError&) {
      return sample::SampleHip{};  // these measures together make no hip
    }
  }();
  if (hip.femur.triangles.empty()) return;
  if (drawn.is_left) hip = sample::mirrored(hip);
  OutputFolder out(folder / folder_name(k));
  write_sample_hip(out, hip, side_of(drawn));
  out.commit();
}

/// False if it was stopped.
bool write_hips(const fs::path& folder, const SampleCohort& cohort, const Control& control) {
  std::mutex mutex;
  std::size_t done = 0;
  std::exception_ptr error;
  std::atomic<bool> was_stopped = false;
  core::parallel_tasks(cohort.n, [&](std::size_t i) {
    if (was_stopped || control.stop.stop_requested()) {
      was_stopped = true;
      return;
    }
    try {
      write_hip(folder, cohort, i + 1);
    } catch (...) {
      const std::lock_guard lock(mutex);
      if (!error) error = std::current_exception();
      was_stopped = true;
    }
    const std::lock_guard lock(mutex);
    if (control.progress) control.progress("hips", ++done, cohort.n);
  });
  if (error) std::rethrow_exception(error);
  return !was_stopped;
}

}  // namespace

std::optional<std::vector<fs::path>> write_sample_cohort(const fs::path& folder, const SampleCohort& cohort,
                                                         const Control& control) {
  if (cohort.n < 1 || cohort.n > most_hips)
    throw UsageError(fmt::format("sample cohort: 1 to {} hips can be drawn, not {}", most_hips, cohort.n));
  OutputFolder out(folder);
  if (cohort.meshes == CohortMeshes::in_files && !write_hips(folder, cohort, control)) return std::nullopt;
  io::write_whole_file(out.file("cohort.csv"), table_of(cohort));
  io::write_whole_file(out.file("cohort.json"), description_of(cohort));
  return out.commit();
}

}  // namespace condyle::io
