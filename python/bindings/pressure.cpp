#include "condyle/pressure.hpp"

#include <pybind11/stl.h>

#include "arrays.hpp"
#include "bindings.hpp"
#include "condyle/error.hpp"
#include "condyle/load_balance.hpp"
#include "condyle/motion_contact.hpp"
#include "interrupts.hpp"
#include "joint.hpp"
#include "surface_contact.hpp"

namespace condyle::python {
namespace {

std::optional<ElasticLayer> layer_in(const py::object& given) {
  if (given.is_none()) return std::nullopt;
  const auto dict = given.cast<py::dict>();
  ElasticLayer layer{dict["youngs_modulus_mpa"].cast<double>(), dict["poisson_ratio"].cast<double>(), 0.0};
  const py::object thickness = dict["thickness_mm"];
  if (py::isinstance<py::float_>(thickness))
    layer.thickness_mm = thickness.cast<double>();
  else
    layer.thickness_mm = doubles_in(thickness, "thickness_mm");
  return layer;
}

std::unique_ptr<ElasticContact> elastic(const Mesh& fixed, const Mesh& mobile, const py::object& fixed_layer,
                                        const py::object& mobile_layer, const std::string& casting,
                                        const std::string& rule, double reach_mm, bool is_logarithmic) {
  ElasticContactOptions options{.casting = casting_in(casting),
                                .rays = rays_in(rule, reach_mm),
                                .law = is_logarithmic ? PressureLaw::logarithmic : PressureLaw::linear,
                                .fixed = layer_in(fixed_layer),
                                .mobile = layer_in(mobile_layer)};
  const py::gil_scoped_release released;
  return std::make_unique<ElasticContact>(fixed, mobile, std::move(options));
}

/// As the joint file's [contact] says.
std::unique_ptr<ElasticContact> elastic_of_file(const JointHandle& handle) {
  const auto& entry = handle.loaded.report.file.contact;
  if (!entry) return nullptr;
  const py::gil_scoped_release released;
  const ContactSurfaces surfaces = surfaces_of(*entry, handle.joint());
  return std::make_unique<ElasticContact>(surfaces.fixed.mesh, surfaces.mobile.mesh,
                                          elastic_options(*entry, surfaces, handle.loaded));
}

py::object optional_dict(std::optional<SurfaceContact>& surface) {
  if (!surface) return py::none();
  return dict_of(std::move(*surface));
}

py::dict dict_of_results(ElasticContactResults&& results) {
  py::dict dict;
  dict["fixed"] = optional_dict(results.fixed);
  dict["mobile"] = optional_dict(results.mobile);
  dict["force_n"] = array_of(results.on_mobile.force_n);
  dict["moment_nmm"] = array_of(results.on_mobile.moment_nmm);
  dict["energy_nmm"] = results.energy_nmm;
  return dict;
}

py::tuple at(const ElasticContact& contact, const py::object& given, const py::object& progress) {
  const PosesIn in = poses_in(given, "pose");
  std::vector<ElasticContactResults> found;
  Follower follower(progress, in.poses.size());
  {
    const py::gil_scoped_release released;
    for (const Pose& X_FM : in.poses) {
      found.push_back(contact.at(X_FM));
      follower.look(found.size());
    }
  }
  py::list answers;
  for (ElasticContactResults& results : found) answers.append(dict_of_results(std::move(results)));
  return py::make_tuple(in.is_one, answers);
}

const char* name_of(BalanceOutcome outcome) {
  switch (outcome) {
    case BalanceOutcome::balanced:
      return "balanced";
    case BalanceOutcome::at_jump:
      return "at_jump";
    case BalanceOutcome::pulled_apart:
      return "pulled_apart";
    case BalanceOutcome::over_the_rim:
      return "over_the_rim";
    case BalanceOutcome::unstable:
      return "unstable";
    case BalanceOutcome::free_direction:
      break;
  }
  return "free_direction";
}

py::dict dict_of_balance(BalancedPose&& found) {
  py::dict dict;
  dict["outcome"] = name_of(found.outcome);
  dict["reason"] = reason_of(found);
  dict["X_FM"] = array_of(found.X_FM);
  dict["residual"] = tuple_of(found.residual);
  dict["steps"] = found.steps;
  dict["contact"] = dict_of_results(std::move(found.contact));
  return dict;
}

BalanceOptions options_in(const py::object& free_directions, bool free_rotations) {
  BalanceOptions options;
  options.free_rotations = free_rotations;
  const PointsIn directions(free_directions, "free_directions");
  for (std::size_t i = 0; i < directions.size(); ++i) options.free_directions.push_back(directions.view()[i]);
  return options;
}

py::dict balanced(const ElasticContact& contact, const py::object& start, const py::object& force_n,
                  const py::object& moment_nmm, bool goes_along, const py::object& free_directions,
                  bool free_rotations) {
  const PosesIn in = poses_in(start, "start");
  if (!in.is_one) throw UsageError("start: one pose of shape (4, 4) is needed");
  const Load load{{vector_in(force_n, "force_n"), vector_in(moment_nmm, "moment_nmm")},
                  goes_along ? BodyRole::mobile : BodyRole::fixed};
  const BalanceOptions options = options_in(free_directions, free_rotations);
  return dict_of_balance(followed(py::none(), [&](const auto&, const std::stop_token&) {
    return balance(contact, in.poses.front(), load, options);
  }));
}

/// Forces and moments have a row for all frames, or one for each.
py::list balanced_along(const ElasticContact& contact, const py::object& poses, const py::object& force_n,
                        const py::object& moment_nmm, bool goes_along, const py::object& free_directions,
                        bool free_rotations, const py::object& progress) {
  const PosesIn in = poses_in(poses, "poses");
  const PointsIn forces(force_n, "force_n"), moments(moment_nmm, "moment_nmm");
  if (forces.size() != moments.size()) throw UsageError("moment_nmm: as many rows as force_n has are needed");
  std::vector<Load> loads;
  for (std::size_t i = 0; i < forces.size(); ++i)
    loads.push_back({{forces.view()[i], moments.view()[i]}, goes_along ? BodyRole::mobile : BodyRole::fixed});
  const BalanceOptions options = options_in(free_directions, free_rotations);
  const std::vector<std::optional<Pose>> X_FM(in.poses.begin(), in.poses.end());
  auto found = followed(progress, [&](const auto& report, const std::stop_token& stop) {
    return balance_along(contact, X_FM, loads, options, {.progress = report, .stop = stop});
  });
  py::list answers;
  for (std::optional<BalancedPose>& pose : *found) answers.append(dict_of_balance(std::move(*pose)));
  return answers;
}

}  // namespace

void bind_pressure(py::module_& module) {
  py::class_<ElasticContact>(module, "ElasticContact")
      .def(py::init(&elastic))
      .def("at", &at)
      .def("balance", &balanced)
      .def("balance_along", &balanced_along)
      .def("cut_off_by_reach",
           [](const ElasticContact& contact, const py::object& pose) {
             const PosesIn in = poses_in(pose, "pose");
             if (!in.is_one) throw UsageError("pose: one pose of shape (4, 4) is needed");
             const py::gil_scoped_release released;
             return contact.cut_off_by_reach(in.poses.front());
           })
      .def_property_readonly("fixed", &ElasticContact::fixed)
      .def_property_readonly("mobile", &ElasticContact::mobile);
  module.def("elastic_of_file", &elastic_of_file);
}

}  // namespace condyle::python
