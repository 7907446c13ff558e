#include <algorithm>

#include "bindings.hpp"
#include "condyle/version.hpp"

namespace condyle::python {
namespace {

/// Protocols 0 and 1 of pickle call a class between these and object, which pybind11 has and nobody can make: that ends the
/// process. Protocol 2 works for all of them, or raises TypeError, and its answer may be written by the older ones.
void pickle_by_protocol_2(const py::module_& module) {
  const py::object reduce = py::module_::import("builtins").attr("object").attr("__reduce_ex__");
  for (const auto& [name, value] : module.attr("__dict__").cast<py::dict>()) {
    if (!PyType_Check(value.ptr()) ||
        !py::detail::get_type_info(reinterpret_cast<PyTypeObject*>(value.ptr())))
      continue;
    value.attr("__reduce_ex__") = py::cpp_function(
        [reduce](const py::object& self, int protocol) { return reduce(self, std::max(protocol, 2)); },
        py::name("__reduce_ex__"), py::is_method(value));
  }
}

}  // namespace
}  // namespace condyle::python

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
  bind_ligaments(module);
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
  bind_touch(module);
  pickle_by_protocol_2(module);
}
