#include <pybind11/stl.h>

#include <map>
#include <string>

#include "bindings.hpp"
#include "condyle/mesh.hpp"
#include "condyle/sample/cartilages.hpp"
#include "condyle/sample/hip.hpp"
#include "interrupts.hpp"

namespace condyle::python {
namespace {

/// By the names that sample_hip() of Python has checked; angles in degrees.
HipParameters hip_parameters(const std::map<std::string, double>& given) {
  HipParameters hip;
  for (const auto& [name, value] : given)
    if (const HipMeasure* measure = hip_measure_named(name)) measure->set(hip, value);
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
  const HipParameters measures = hip_parameters(parameters);
  Resolution resolution = static_cast<Scenario>(scenario.value_or(2));
  if (triangles) resolution = TriangleCounts{triangles->first, triangles->second};
  if (edge_mm) resolution = EdgeLength{*edge_mm};
  return pair_of(followed(py::none(), [&](const auto&, const std::stop_token& stop) -> Meshes {
    std::optional<SampleHip> made = sample_hip(measures, resolution, stop);
    if (!made) return std::nullopt;
    if (is_left) made = mirrored(*made);
    return std::pair(Mesh(std::move(made->hip_bone)), Mesh(std::move(made->femur)));
  }));
}

py::tuple cartilages(const std::map<std::string, double>& parameters, double clearance_mm,
                     double thickness_mm, std::optional<int> scenario, const Counts& triangles,
                     std::optional<double> edge_mm, bool is_left) {
  const HipParameters measures = hip_parameters(parameters);
  CartilageResolution resolution = static_cast<CartilageScenario>(scenario.value_or(5));
  if (triangles) resolution = CartilageCounts{triangles->first, triangles->second};
  if (edge_mm) resolution = EdgeLength{*edge_mm};
  return pair_of(followed(py::none(), [&](const auto&, const std::stop_token& stop) -> Meshes {
    std::optional<SampleCartilages> made =
        sample_cartilages(measures, {clearance_mm, thickness_mm}, resolution, stop);
    if (!made) return std::nullopt;
    if (is_left) made = mirrored(*made);
    return std::pair(Mesh(std::move(made->acetabular)), Mesh(std::move(made->femoral)));
  }));
}

}  // namespace

void bind_sample(py::module_& module) {
  module.def("sample_hip", &hip);
  module.def("sample_cartilages", &cartilages);
}

}  // namespace condyle::python
