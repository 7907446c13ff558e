#include "condyle/io/study.hpp"

#include <pybind11/stl.h>

#include <array>

#include "bindings.hpp"
#include "interrupts.hpp"
#include "io/joint/grid_text.hpp"
#include "io/result/sample_files.hpp"
#include "range_answer.hpp"
#include "resection.hpp"
#include "surface_contact.hpp"

namespace condyle::python {
namespace {

// These read what StudyLoad of Python has checked.

io::ContactChanges contact_in(const py::dict& given) {
  const auto numbers = [&](const char* name) { return given[name].cast<std::vector<double>>(); };
  io::ContactChanges contact;
  contact.youngs_modulus_mpa = numbers("youngs_modulus_mpa");
  contact.poisson_ratio = numbers("poisson_ratio");
  contact.thickness_mm = numbers("thickness_mm");
  if (const py::object casting = given["casting"]; !casting.is_none())
    contact.casting = casting_in(casting.cast<std::string>());
  if (const py::object rule = given["rule"]; !rule.is_none())
    contact.rule = rays_in(rule.cast<std::string>(), contact::NormalDepthOptions().reach_mm).rule;
  contact.reach_mm = given["reach_mm"].cast<std::optional<double>>();
  if (const py::object law = given["law"]; !law.is_none())
    contact.law = law.cast<std::string>() == "logarithmic" ? contact::PressureLaw::logarithmic
                                                           : contact::PressureLaw::linear;
  return contact;
}

std::vector<Vec3> directions_in(const py::dict& given) {
  std::vector<Vec3> directions;
  for (const auto& direction : given["free_directions"].cast<std::vector<std::array<double, 3>>>())
    directions.emplace_back(direction[0], direction[1], direction[2]);
  return directions;
}

std::optional<Vec3> force_in(const py::dict& given) {
  const auto force = given["force_n"].cast<std::vector<double>>();
  return force.empty() ? std::nullopt : std::optional(Vec3(force.at(0), force.at(1), force.at(2)));
}

io::StudyLoad load_in(const py::dict& given, Anatomy anatomy) {
  return {io::study_pose(given["at"].cast<std::string>(), anatomy), contact_in(given), force_in(given),
          directions_in(given)};
}

io::StudyFollowLoad follow_load_in(const py::dict& given) {
  return {force_in(given).value(), directions_in(given), contact_in(given)};
}

motion::MapGrid grid_in(const py::tuple& given, Anatomy anatomy) {
  const py::object vary = given[2];
  motion::MapGrid grid =
      io::parse_grid(std::array{given[0].cast<std::string>(), given[1].cast<std::string>()},
                     vary.is_none() ? std::string() : vary.cast<std::string>(), anatomy);
  motion::check_grid(grid, JointKind::free);
  if (grid.translates()) throw UsageError("map: a study has maps of angles only");
  return grid;
}

/// Options that run_study() of Python has checked.
io::StudyOptions study_options_in(const py::dict& given) {
  io::StudyOptions options;
  for (const Anatomy anatomy : all_anatomies)
    if (given["anatomy"].cast<std::string>() == name_of(anatomy)) options.anatomy = anatomy;
  options.motions = given["motions"].cast<std::vector<std::string>>();
  options.bearing = bearing_in(given);
  if (given["accept_reference_contact"].cast<bool>())
    options.reference_contact = motion::ReferenceContact::accept;
  if (given["exclude_reference_contacts"].cast<bool>()) options.leave_out_reference_contacts.emplace();
  if (const py::object map = given["map"]; !map.is_none())
    options.map = grid_in(map.cast<py::tuple>(), options.anatomy);
  options.bands = band_in(given["band"]);
  if (const auto pose = given["depth_at"].cast<std::string>(); !pose.empty())
    options.depth_at = io::study_pose(pose, options.anatomy);
  options.measures = given["measures"].cast<bool>();
  if (const py::object given_cut = given["resection"]; !given_cut.is_none()) {
    const auto cut = given_cut.cast<py::dict>();
    options.resection.emplace();
    for (const auto& [motion, degrees, is_gain] :
         cut["reach"].cast<std::vector<std::tuple<std::string, double, bool>>>())
      options.resection->targets.push_back({motion, Angle::degrees(degrees), is_gain});
    options.resection->cut = cut_in(cut);
  }
  if (const py::object load = given["load"]; !load.is_none())
    options.load = load_in(load.cast<py::dict>(), options.anatomy);
  if (const py::object load = given["follow_load"]; !load.is_none())
    options.follow_load = follow_load_in(load.cast<py::dict>());
  return options;
}

/// Names and codes.
std::vector<std::pair<std::string, std::string>> noted(const io::StudyDone& done) {
  std::vector<std::pair<std::string, std::string>> joints;
  for (const io::NotedJoint& joint : done.noted) joints.emplace_back(joint.id, joint.codes);
  return joints;
}

std::vector<std::pair<std::string, std::string>> study(
    const std::string& table, const std::string& folder, const py::dict& options,
    std::optional<std::pair<std::size_t, std::size_t>> shard, bool is_strict,
    const std::optional<std::string>& crate_date, const py::object& progress) {
  io::Study one{table, folder, study_options_in(options), {}, {}, crate_date};
  if (shard) one.shard = {shard->first, shard->second};
  if (is_strict) one.bad_joint = io::BadJoint::ends_run;
  const auto done =
      with_progress(progress, [&](const Control& control) { return io::run_study(one, control); });
  if (!shard) io::require_answered(*done, one.table);
  return noted(*done);
}

std::vector<std::pair<std::string, std::string>> merge(const std::string& folder,
                                                       const std::optional<std::string>& crate_date) {
  const io::StudyDone done = without_lock([&] { return io::merge_study(folder, crate_date); });
  io::require_answered(done, folder);
  return noted(done);
}

void cohort(const std::string& folder, std::size_t n, std::uint64_t seed, int scenario, bool with_meshes,
            const py::object& progress) {
  const io::SampleCohort drawn{n, seed, static_cast<sample::Scenario>(scenario),
                               with_meshes ? io::CohortMeshes::in_files : io::CohortMeshes::of_measures};
  with_progress(progress,
                [&](const Control& control) { return io::write_sample_cohort(folder, drawn, control); });
}

}  // namespace

void bind_study(py::module_& module) {
  module.def("run_study", &study);
  module.def("merge_study", &merge);
  module.def("sample_cohort", &cohort);
}

}  // namespace condyle::python
