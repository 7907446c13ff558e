#include "condyle/io/study.hpp"

#include <pybind11/stl.h>

#include "bindings.hpp"
#include "condyle/io/sample_files.hpp"
#include "interrupts.hpp"

namespace condyle::python {
namespace {

/// Of what Study of Python has checked; no bands where there are no samples.
struct Asked {
  std::vector<std::string> motions;
  std::size_t band_samples;
  std::uint64_t band_seed;
  std::string depth_at;
};

StudyOptions options_of(const Asked& asked) {
  StudyOptions options;
  options.motions = asked.motions;
  if (asked.band_samples > 0) options.bands = {asked.band_samples, asked.band_seed, {}};
  if (!asked.depth_at.empty())
    options.depth_at = parse_pose(asked.depth_at, JointKind::ball, options.anatomy);
  return options;
}

py::tuple study(const std::string& table, const std::string& folder, const std::vector<std::string>& motions,
                std::size_t band_samples, std::uint64_t seed, const std::string& depth_at,
                std::optional<std::pair<std::size_t, std::size_t>> shard, bool is_strict,
                const py::object& progress) {
  Study one{table, folder, options_of({motions, band_samples, seed, depth_at}), {}, {}};
  if (shard) one.shard = {shard->first, shard->second};
  if (is_strict) one.bad_joint = BadJoint::ends_run;
  const auto done = followed(progress, [&](const auto& report, const std::stop_token& stop) {
    return run_study(one, {report, stop});
  });
  return py::make_tuple(done->joints, done->failures);
}

py::tuple merge(const std::string& folder) {
  const py::gil_scoped_release released;
  const StudyDone done = merge_study(folder);
  const py::gil_scoped_acquire held;
  return py::make_tuple(done.joints, done.failures);
}

void cohort(const std::string& folder, std::size_t n, std::uint64_t seed, int scenario, bool with_meshes,
            const py::object& progress) {
  const SampleCohort drawn{n, seed, static_cast<Scenario>(scenario),
                           with_meshes ? CohortMeshes::in_files : CohortMeshes::of_measures};
  followed(progress, [&](const auto& report, const std::stop_token& stop) {
    return write_sample_cohort(folder, drawn, {report, stop});
  });
}

}  // namespace

void bind_study(py::module_& module) {
  module.def("run_study", &study);
  module.def("merge_study", &merge);
  module.def("sample_cohort", &cohort);
}

}  // namespace condyle::python
