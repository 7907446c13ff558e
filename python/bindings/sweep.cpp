#include "sweep.hpp"

#include <fmt/format.h>
#include <pybind11/stl.h>

#include <array>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "arrays.hpp"
#include "bindings.hpp"
#include "condyle/answer.hpp"
#include "interrupts.hpp"
#include "io/joint/given_degrees.hpp"
#include "io/sweep/load_quantities.hpp"
#include "io/sweep/sweep_files.hpp"
#include "io/sweep/target_table.hpp"
#include "motion.hpp"
#include "range_answer.hpp"

namespace condyle::python {
namespace {

/// (name, first, last, step) of each, read as the command reads them: its words for what is wrong are these.
std::vector<plan::SweptParameter> parameters_in(const py::list& given) {
  std::vector<plan::SweptParameter> swept;
  for (const py::handle each : given) {
    const auto axis = each.cast<py::tuple>();
    for (plan::SweptParameter& parameter :
         plan::parse_sweep(fmt::format("{}={}:{}:{}", axis[0].cast<std::string>(), axis[1].cast<double>(),
                                       axis[2].cast<double>(), axis[3].cast<double>())))
      swept.push_back(std::move(parameter));
  }
  return swept;
}

/// The path of a table, or (name, motion, reach_deg, pelvic_tilt_deg, source, weight) of each.
std::vector<plan::SweepTarget> sweep_targets_in(const JointHandle& handle, const py::object& given) {
  const Joint& joint = handle.joint();
  if (py::isinstance<py::str>(given))
    return io::read_targets(given.cast<std::string>(), Case(handle.loaded).motions(), joint.kind,
                            joint.anatomy);
  std::vector<plan::SweepTarget> targets;
  for (const py::handle each : given) {
    const auto target = each.cast<py::tuple>();
    targets.push_back({target[0].cast<std::string>(), motion_in(target[1].cast<py::tuple>()),
                       Angle::degrees(target[2].cast<double>()), Angle::degrees(target[3].cast<double>()),
                       target[4].cast<std::string>(), target[5].cast<double>()});
  }
  return targets;
}

py::dict dict_of_limits(std::span<const plan::DesignLimit> limits) {
  std::vector<double> turned;
  std::vector<std::int8_t> reason, known_by;
  std::vector<std::int32_t> pair;
  for (const plan::DesignLimit& limit : limits) {
    turned.push_back(limit.turned_deg);
    reason.push_back(static_cast<std::int8_t>(limit.reason));
    known_by.push_back(static_cast<std::int8_t>(limit.by));
    pair.push_back(limit.pair == plan::DesignLimit::no_pair ? -1 : limit.pair);
  }
  py::dict dict;
  dict["limits_deg"] = array_of(std::move(turned));
  dict["reason"] = array_of(std::move(reason));
  dict["known_by"] = array_of(std::move(known_by));
  dict["ended_by"] = array_of(std::move(pair));
  return dict;
}

py::list list_of(const std::vector<plan::SafeInterval>& safe) {
  py::list list;
  for (const plan::SafeInterval& each : safe)
    list.append(py::make_tuple(each.line, each.low, each.high, each.low_target, each.high_target));
  return list;
}

py::dict sweep(const JointHandle& handle, const py::list& vary, const py::object& targets,
               const py::dict& given, const py::object& progress) {
  SweepRequest request{.parameters = parameters_in(vary), .targets = sweep_targets_in(handle, targets)};
  if (given["least_change"].cast<bool>()) request.best_by = BestDesign::least_change;
  request.range.bearing = bearing_in(given);
  if (given["accept_reference_contact"].cast<bool>())
    request.range.overlap.reference_contact = motion::ReferenceContact::accept;
  request.bands = band_in(given["band"]);
  if (const auto keys = given["measures"].cast<std::vector<std::string>>(); !keys.empty())
    request.quantities.push_back(measured_quantities(keys, Case(handle.loaded).measure_options()));
  if (const auto pose = given["load"].cast<std::optional<std::string>>()) {
    io::StudyLoad load{io::study_pose(*pose, handle.joint().anatomy), {}, {}};
    if (const auto force = given["force_n"].cast<std::optional<std::array<double, 3>>>())
      load.force_n = Vec3((*force)[0], (*force)[1], (*force)[2]);
    request.quantities.push_back(io::load_quantities(handle.loaded, load));
  }
  SweepAnswer answer = *with_progress(
      progress, [&](const Control& control) { return answer_sweep(handle.loaded, request, control); });
  py::list axes, described, pairs;
  for (const plan::SweptParameter& each : answer.parameters) {
    std::vector<double> values(each.count());
    for (std::size_t i = 0; i < values.size(); ++i) values[i] = each.value(i);
    axes.append(py::make_tuple(each.name, array_of(std::move(values))));
  }
  for (const plan::SweepTarget& each : answer.targets)
    described.append(py::make_tuple(each.name, tuple_of(each.motion), io::given_degrees(each.reach),
                                    io::given_degrees(each.pelvic_tilt), each.source, each.weight));
  for (const plan::EndingPair& each : answer.pairs) pairs.append(py::make_tuple(each.fixed, each.mobile));
  py::dict dict = dict_of_limits(answer.limits);
  dict["axes"] = axes;
  dict["targets"] = described;
  dict["pairs"] = pairs;
  dict["margin_deg"] = array_of(std::vector<double>(answer.margin_deg));
  dict["probability"] =
      request.bands ? py::object(array_of(std::vector<double>(answer.probability))) : py::none();
  dict["quantity_names"] = answer.quantity_names;
  dict["quantities"] = array_of(std::vector<double>(answer.quantities));
  dict["quantities_here"] = answer.quantities_here;
  dict["safe_intervals"] = list_of(answer.safe);
  dict["safe_measure"] = answer.safe_measure;
  dict["window_measure"] = answer.window_measure;
  dict["best"] = answer.best;
  dict["here"] = py::make_tuple(answer.here, dict_of_limits(answer.limits_here));
  dict["notes"] = notes_of(answer.notes) + notes_of(answer.limit_notes);
  dict["caveats"] = answer.caveats;
  dict["sweep"] =
      std::make_unique<SweepHandle>(SweepHandle{handle.loaded, std::move(request), std::move(answer)});
  return dict;
}

std::vector<std::string> write(const SweepHandle& handle, const std::string& folder) {
  const py::gil_scoped_release released;
  const io::SweepResult result = io::sweep_result_of(handle.loaded, handle.answer, {}, nullptr);
  std::vector<std::string> written;
  for (const auto& path : io::write_sweep(folder, result, {}, nullptr)) written.push_back(path.string());
  return written;
}

}  // namespace

void bind_sweep(py::module_& module) {
  py::class_<SweepHandle>(module, "Sweep").def("write", &write);
  module.def("sweep", &sweep);
}

}  // namespace condyle::python
