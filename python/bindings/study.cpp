#include "condyle/io/study.hpp"

#include <pybind11/stl.h>

#include <array>

#include "bindings.hpp"
#include "condyle/io/sample_files.hpp"
#include "interrupts.hpp"
#include "surface_contact.hpp"

namespace condyle::python {
namespace {

/// Of what StudyLoad of Python has checked.
StudyLoad load_in(const py::dict& given) {
  const auto numbers = [&](const char* name) { return given[name].cast<std::vector<double>>(); };
  StudyLoad load;
  load.at = parse_pose(given["at"].cast<std::string>(), JointKind::ball, Anatomy::hip);
  load.contact.youngs_modulus_mpa = numbers("youngs_modulus_mpa");
  load.contact.poisson_ratio = numbers("poisson_ratio");
  load.contact.thickness_mm = numbers("thickness_mm");
  if (const py::object casting = given["casting"]; !casting.is_none())
    load.contact.casting = casting_in(casting.cast<std::string>());
  if (const py::object rule = given["rule"]; !rule.is_none())
    load.contact.rule = rays_in(rule.cast<std::string>(), NormalDepthOptions().reach_mm).rule;
  load.contact.reach_mm = given["reach_mm"].cast<std::optional<double>>();
  if (const py::object law = given["law"]; !law.is_none())
    load.contact.law =
        law.cast<std::string>() == "logarithmic" ? PressureLaw::logarithmic : PressureLaw::linear;
  for (const auto& direction : given["free_directions"].cast<std::vector<std::array<double, 3>>>())
    load.free_directions.emplace_back(direction[0], direction[1], direction[2]);
  if (const std::vector<double> force = numbers("force_n"); !force.empty())
    load.force_n = Vec3(force.at(0), force.at(1), force.at(2));
  return load;
}

/// Of what run_study() of Python has checked; no bands where there are no samples.
struct Asked {
  std::vector<std::string> motions;
  std::size_t band_samples;
  std::optional<std::uint64_t> band_seed;
  std::string depth_at;
  std::optional<py::dict> load;
};

StudyOptions options_of(const Asked& asked) {
  StudyOptions options;
  options.motions = asked.motions;
  if (asked.band_samples > 0) options.bands = {asked.band_samples, asked.band_seed, {}};
  if (!asked.depth_at.empty())
    options.depth_at = parse_pose(asked.depth_at, JointKind::ball, options.anatomy);
  if (asked.load) options.load = load_in(*asked.load);
  return options;
}

py::tuple study(const std::string& table, const std::string& folder, const std::vector<std::string>& motions,
                std::size_t band_samples, std::optional<std::uint64_t> seed, const std::string& depth_at,
                const std::optional<py::dict>& load, std::optional<std::pair<std::size_t, std::size_t>> shard,
                bool is_strict, const py::object& progress) {
  Study one{table, folder, options_of({motions, band_samples, seed, depth_at, load}), {}, {}};
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
