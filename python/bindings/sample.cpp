#include <pybind11/stl.h>

#include <map>
#include <memory>
#include <string>
#include <vector>

#include "bindings.hpp"
#include "condyle/mesh.hpp"
#include "condyle/sample/cartilages.hpp"
#include "condyle/sample/hip.hpp"
#include "implant.hpp"
#include "interrupts.hpp"
#include "io/result/sample_files.hpp"
#include "joint.hpp"

namespace condyle::python {
namespace {

/// By the names that sample_hip() of Python has checked; angles in degrees.
sample::HipParameters hip_parameters(const std::map<std::string, double>& given) {
  sample::HipParameters hip;
  for (const auto& [name, value] : given)
    if (const sample::HipMeasure* measure = sample::hip_measure_named(name)) measure->set(hip, value);
  return hip;
}

/// A scenario, or numbers of triangles of the fixed and the mobile body, or an edge length; the others are none.
using Counts = std::optional<std::pair<std::size_t, std::size_t>>;

/// Empty if it was stopped.
using Meshes = std::optional<std::pair<Mesh, Mesh>>;

py::tuple pair_of(Meshes&& made) {
  return py::make_tuple(std::move(made->first), std::move(made->second));
}

py::tuple hip(const std::map<std::string, double>& parameters, std::optional<int> scenario,
              const Counts& triangles, std::optional<double> edge_mm, bool is_left) {
  const sample::HipParameters measures = hip_parameters(parameters);
  sample::Resolution resolution = static_cast<sample::Scenario>(scenario.value_or(2));
  if (triangles) resolution = sample::TriangleCounts{triangles->first, triangles->second};
  if (edge_mm) resolution = sample::EdgeLength{*edge_mm};
  return pair_of(with_progress(py::none(), [&](const Control& control) -> Meshes {
    std::optional<sample::SampleHip> made = sample::sample_hip(measures, resolution, control.stop);
    if (!made) return std::nullopt;
    if (is_left) made = sample::mirrored(*made);
    return std::pair(Mesh(std::move(made->hip_bone)), Mesh(std::move(made->femur)));
  }));
}

py::tuple cartilages(const std::map<std::string, double>& parameters, double clearance_mm,
                     double thickness_mm, std::optional<int> scenario, const Counts& triangles,
                     std::optional<double> edge_mm, bool is_left) {
  const sample::HipParameters measures = hip_parameters(parameters);
  sample::CartilageResolution resolution = static_cast<sample::CartilageScenario>(scenario.value_or(5));
  if (triangles) resolution = sample::CartilageCounts{triangles->first, triangles->second};
  if (edge_mm) resolution = sample::EdgeLength{*edge_mm};
  return pair_of(with_progress(py::none(), [&](const Control& control) -> Meshes {
    std::optional<sample::SampleCartilages> made =
        sample::sample_cartilages(measures, {clearance_mm, thickness_mm}, resolution, control.stop);
    if (!made) return std::nullopt;
    if (is_left) made = sample::mirrored(*made);
    return std::pair(Mesh(std::move(made->acetabular)), Mesh(std::move(made->femoral)));
  }));
}

std::vector<std::string> names_of_sizes(bool is_hip) {
  std::vector<std::string> names;
  for (const plan::ImplantParameter& each : plan::implant_parameters(
           is_hip ? plan::Implant(plan::TotalHip{}) : plan::Implant(plan::ReverseShoulder{})))
    names.push_back(std::string(each.name) + "_" + std::string(each.unit));
  return names;
}

/// Names and meshes of the parts of both bodies, the joint of them, the half-angle of neck and liner in degrees or why there is
/// none.
py::tuple implant(bool is_hip, const std::map<std::string, double>& sizes, const std::string& definition,
                  int facets, std::optional<int> scenario, bool is_left) {
  plan::Implant design = is_hip ? plan::Implant(plan::TotalHip{}) : plan::Implant(plan::ReverseShoulder{});
  set_sizes(design, sizes);
  std::visit([&](auto& each) { each.facets = facets; }, design);
  if (is_hip) std::get<plan::TotalHip>(design).cup.definition = cup_definition_named(definition);
  const Side side = is_left ? Side::left : Side::right;
  using Made = std::optional<std::pair<plan::ImplantMeshes, std::unique_ptr<JointHandle>>>;
  Made made = with_progress(py::none(), [&](const Control& control) -> Made {
    std::optional<plan::ImplantMeshes> meshes =
        scenario ? sample::sample_replacement(std::get<plan::TotalHip>(design), {},
                                              static_cast<sample::Scenario>(*scenario), side, control.stop)
                 : plan::implant_meshes(design, side);
    if (!meshes) return std::nullopt;
    auto joint = std::make_unique<JointHandle>(io::sample_implant_joint(*meshes, design, side));
    return std::pair(std::move(*meshes), std::move(joint));
  });
  const auto parts_of = [](std::vector<plan::ImplantMesh>& parts) {
    py::list list;
    for (auto& [part, mesh] : parts) list.append(py::make_tuple(part, Mesh(std::move(mesh))));
    return list;
  };
  const auto pair = plan::revolved_pair(design, side);
  return py::make_tuple(parts_of(made->first.fixed), parts_of(made->first.mobile), std::move(made->second),
                        pair ? py::object(py::float_(pair->half_angle.degrees())) : py::object(py::none()),
                        plan::why_not_revolved(design));
}

}  // namespace

void bind_sample(py::module_& module) {
  module.def("sample_hip", &hip);
  module.def("sample_cartilages", &cartilages);
  module.def("sample_implant", &implant);
  module.def("implant_sizes", &names_of_sizes);
}

}  // namespace condyle::python
