
#include "arrays.hpp"
#include "bindings.hpp"
#include "condyle/pressure.hpp"
#include "surface_contact.hpp"

namespace condyle::python {
namespace {

contact::ForceOptions force_options_in(const py::dict& given) {
  const auto vector = [&](const char* name) {
    const py::object value = given[name];
    return value.is_none() ? Vec3(Vec3::Zero()) : vector_in(value, name);
  };
  return {.motion = {.velocity_mm_s = vector("velocity_mm_s"),
                     .angular_velocity_rad_s = vector("angular_velocity_rad_s")},
          .friction = given["friction"].cast<double>(),
          .slip_velocity_mm_s = given["slip_velocity"].cast<double>(),
          .damping_s_per_mm = given["damping"].cast<double>(),
          .factor = given["factor"].cast<double>(),
          .vertex_forces = given["vertex_forces"].cast<bool>(),
          .stiffness = given["stiffness"].cast<bool>(),
          .vertex_stiffness = given["vertex_stiffness"].cast<bool>(),
          .patches = given["patches"].cast<bool>()};
}

/// Row by row in memory.
py::object shaped(std::vector<double>&& values, const py::tuple& shape) {
  return array_of(std::move(values)).attr("reshape")(shape);
}

py::tuple vertex_forces_out(const std::vector<contact::VertexForce>& forces) {
  std::vector<Index> vertices;
  std::vector<double> values;
  for (const contact::VertexForce& each : forces) {
    vertices.push_back(each.vertex);
    values.insert(values.end(), each.force_n.begin(), each.force_n.end());
  }
  return py::make_tuple(array_of(std::move(vertices)), shaped(std::move(values), py::make_tuple(-1, 3)));
}

py::tuple vertex_stiffness_out(const std::vector<contact::VertexStiffness>& blocks) {
  std::vector<Index> rows, columns;
  std::vector<double> values;
  for (const contact::VertexStiffness& each : blocks) {
    rows.push_back(each.row);
    columns.push_back(each.column);
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j < 3; ++j) values.push_back(each.block(i, j));
  }
  return py::make_tuple(array_of(std::move(rows)), array_of(std::move(columns)),
                        shaped(std::move(values), py::make_tuple(-1, 3, 3)));
}

py::list patches_of(const contact::ContactForces& forces) {
  py::list list;
  for (const contact::ForcePatch& patch : forces.patches) {
    const auto faces = forces.faces_of(patch);
    py::dict dict;
    dict["casting"] = patch.casting == BodyRole::fixed ? "fixed" : "mobile";
    dict["face"] = array_of(std::vector<Index>(faces.begin(), faces.end()));
    dict["area_mm2"] = patch.area_mm2;
    dict["max_pressure_mpa"] = patch.max_pressure_mpa;
    dict["load_n"] = patch.load_n;
    dict["force_n"] = array_of(patch.on_mobile_body.force_n);
    dict["moment_nmm"] = array_of(patch.on_mobile_body.moment_nmm);
    dict["centre_of_pressure"] = array_of(patch.centre_of_pressure);
    dict["centre_of_area"] = array_of(patch.centre_of_area);
    list.append(dict);
  }
  return list;
}

py::dict forces_at(const contact::ElasticContact& contact, const py::object& pose, const py::dict& given) {
  const Pose X_FM = one_pose(pose, "pose");
  const contact::ForceOptions options = force_options_in(given);
  const contact::ContactForces forces = without_lock([&] { return contact.forces(X_FM, options); });
  py::dict dict;
  dict["force_n"] = array_of(forces.on_mobile_body.force_n);
  dict["moment_nmm"] = array_of(forces.on_mobile_body.moment_nmm);
  dict["energy_nmm"] = forces.energy_nmm;
  dict["friction_power"] = forces.friction_power;
  dict["damping_power"] = forces.damping_power;
  dict["max_strain"] = forces.max_strain;
  dict["factor"] = forces.factor;
  dict["notes"] = notes_of(motion::check_contact(forces));
  dict["stiffness"] = py::none();
  if (options.stiffness) {
    std::vector<double> values;
    for (int i = 0; i < 6; ++i)
      for (int j = 0; j < 6; ++j) values.push_back(forces.stiffness(i, j));
    dict["stiffness"] = shaped(std::move(values), py::make_tuple(6, 6));
  }
  const bool with_vertices = options.vertex_forces || options.vertex_stiffness;
  dict["on_fixed"] = with_vertices ? py::object(vertex_forces_out(forces.on_fixed)) : py::none();
  dict["on_mobile"] = with_vertices ? py::object(vertex_forces_out(forces.on_mobile)) : py::none();
  dict["vertex_stiffness"] =
      options.vertex_stiffness ? py::object(vertex_stiffness_out(forces.vertex_stiffness)) : py::none();
  dict["patches"] = options.patches ? py::object(patches_of(forces)) : py::none();
  return dict;
}

std::unique_ptr<contact::ContactRamp> ramp_of(const contact::ElasticContact& contact, const py::object& start,
                                              double duration_s) {
  const Pose X_FM = one_pose(start, "start");
  const py::gil_scoped_release released;
  return std::make_unique<contact::ContactRamp>(contact, X_FM, duration_s);
}

}  // namespace

void bind_contact_forces(py::module_& module) {
  module.def("forces_at", &forces_at);
  py::class_<contact::ContactRamp>(module, "ContactRamp")
      .def(py::init(&ramp_of))
      .def("factor_at", &contact::ContactRamp::factor_at)
      .def_property_readonly("max_depth_mm", &contact::ContactRamp::max_depth_mm)
      .def_property_readonly("energy_nmm", &contact::ContactRamp::energy_nmm)
      .def_property_readonly("duration_s", &contact::ContactRamp::duration_s);
}

}  // namespace condyle::python
