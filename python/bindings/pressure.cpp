#include "condyle/pressure.hpp"

#include <pybind11/stl.h>

#include "arrays.hpp"
#include "bindings.hpp"
#include "interrupts.hpp"
#include "joint.hpp"
#include "surface_contact.hpp"

namespace condyle::python {
namespace {

std::optional<contact::ElasticLayer> layer_in(const py::object& given) {
  if (given.is_none()) return std::nullopt;
  const auto dict = given.cast<py::dict>();
  contact::ElasticLayer layer{dict["youngs_modulus_mpa"].cast<double>(), dict["poisson_ratio"].cast<double>(),
                              0.0};
  const py::object thickness = dict["thickness_mm"];
  if (py::isinstance<py::float_>(thickness))
    layer.thickness_mm = thickness.cast<double>();
  else
    layer.thickness_mm = doubles_in(thickness, "thickness_mm");
  return layer;
}

std::unique_ptr<contact::ElasticContact> elastic(const Mesh& fixed, const Mesh& mobile,
                                                 const py::object& fixed_layer,
                                                 const py::object& mobile_layer, const std::string& casting,
                                                 const std::string& rule, double reach_mm,
                                                 bool is_logarithmic) {
  contact::ElasticContactOptions options{
      .casting = casting_in(casting),
      .rays = rays_in(rule, reach_mm),
      .law = is_logarithmic ? contact::PressureLaw::logarithmic : contact::PressureLaw::linear,
      .fixed = layer_in(fixed_layer),
      .mobile = layer_in(mobile_layer)};
  const py::gil_scoped_release released;
  return std::make_unique<contact::ElasticContact>(fixed, mobile, std::move(options));
}

/// As the joint file's [contact] says.
std::unique_ptr<contact::ElasticContact> elastic_of_file(const JointHandle& handle) {
  const auto& entry = handle.loaded.report.file.contact;
  if (!entry) return nullptr;
  const py::gil_scoped_release released;
  const io::ContactSurfaces surfaces = io::surfaces_of(*entry, handle.joint());
  return std::make_unique<contact::ElasticContact>(surfaces.fixed.mesh, surfaces.mobile.mesh,
                                                   io::elastic_options(*entry, surfaces, handle.loaded));
}

py::tuple results_at(const contact::ElasticContact& contact, const py::object& given,
                     const py::object& progress) {
  const PosesIn in = poses_in(given, "pose");
  std::vector<contact::ElasticContactResults> found;
  Follower follower(progress, in.poses.size());
  {
    const py::gil_scoped_release released;
    for (const Pose& X_FM : in.poses) {
      found.push_back(contact.at(X_FM));
      follower.poll(found.size());
    }
  }
  py::list answers;
  for (contact::ElasticContactResults& results : found) answers.append(dict_of(std::move(results), contact));
  return py::make_tuple(in.is_one, answers);
}

}  // namespace

void bind_pressure(py::module_& module) {
  py::class_<contact::ElasticContact>(module, "ElasticContact")
      .def(py::init(&elastic))
      .def("at", &results_at)
      .def("cut_off_by_reach",
           [](const contact::ElasticContact& contact, const py::object& pose) {
             const Pose X_FM = one_pose(pose, "pose");
             const py::gil_scoped_release released;
             return contact.cut_off_by_reach(X_FM);
           })
      .def("refined_force_n",
           [](const contact::ElasticContact& contact, const py::object& pose) -> py::object {
             const Pose X_FM = one_pose(pose, "pose");
             const auto force = without_lock([&] { return contact.refined_force_n(X_FM); });
             return force ? py::object(array_of(*force)) : py::none();
           })
      .def("notes",
           [](const contact::ElasticContact& contact) { return notes_of(motion::check_layers(contact)); })
      .def("update",
           [](contact::ElasticContact& contact, bool is_fixed, const py::object& given) {
             const PointsIn vertices(given, "vertices");
             const py::gil_scoped_release released;
             contact.update(is_fixed ? BodyRole::fixed : BodyRole::mobile, vertices.view());
           })
      .def("update_some",
           [](contact::ElasticContact& contact, bool is_fixed, const py::object& moved,
              const py::object& given) {
             const PointsIn positions(given, "vertices");
             const std::vector<Index> vertices = vertices_in(moved, "moved", positions.size());
             const py::gil_scoped_release released;
             contact.update(is_fixed ? BodyRole::fixed : BodyRole::mobile, vertices, positions.view());
           })
      .def_property_readonly("fixed", &contact::ElasticContact::fixed)
      .def_property_readonly("mobile", &contact::ElasticContact::mobile);
  module.def("elastic_of_file", &elastic_of_file);
}

}  // namespace condyle::python
