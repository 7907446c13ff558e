#include "bindings.hpp"
#include "condyle/version.hpp"
#include "errors.hpp"

PYBIND11_MODULE(_native, module) {
  using namespace condyle::python;
  module.attr("version") = std::string(condyle::version);
  bind_errors(module);
  bind_mesh(module);
  bind_inspect(module);
  bind_fit(module);
  bind_labels(module);
  bind_model(module);
  bind_joint(module);
  bind_penetration(module);
  bind_gaps(module);
  bind_tables(module);
  bind_sample(module);
  bind_study(module);
  bind_range_of_motion(module);
  bind_followed_range(module);
  bind_measures(module);
  bind_resection(module);
  bind_implant(module);
  bind_sweep(module);
  bind_motion_map(module);
  bind_zones(module);
  bind_first_contact(module);
  bind_depth_range(module);
  bind_clock_face(module);
  bind_surface_contact(module);
  bind_normal_contact(module);
  bind_pressure(module);
  bind_contact_forces(module);
  bind_motion_contact(module);
  bind_recorded_motion(module);
  bind_report(module);
}
