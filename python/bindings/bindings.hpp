#pragma once

#include <pybind11/pybind11.h>

/// Each adds its part to the module condyle._native, which the Python files of condyle/ give their names, units and words.

namespace condyle::python {

namespace py = pybind11;

/// The result of `work`, which takes no Python objects, done without the interpreter's lock.
template <class Work>
auto without_lock(const Work& work) {
  const py::gil_scoped_release released;
  return work();
}

/// The library's exceptions as Python's.
void bind_errors(py::module_& module);
void bind_mesh(py::module_& module);
void bind_inspect(py::module_& module);
void bind_fit(py::module_& module);
void bind_labels(py::module_& module);
void bind_model(py::module_& module);
void bind_joint(py::module_& module);
void bind_ligaments(py::module_& module);
void bind_penetration(py::module_& module);
void bind_gaps(py::module_& module);
void bind_tables(py::module_& module);
void bind_sample(py::module_& module);
void bind_study(py::module_& module);
void bind_followed_range(py::module_& module);
void bind_measures(py::module_& module);
void bind_resection(py::module_& module);
void bind_implant(py::module_& module);
void bind_sweep(py::module_& module);
void bind_range_of_motion(py::module_& module);
void bind_motion_map(py::module_& module);
void bind_zones(py::module_& module);
void bind_first_contact(py::module_& module);
void bind_depth_range(py::module_& module);
void bind_clock_face(py::module_& module);
void bind_surface_contact(py::module_& module);
void bind_normal_contact(py::module_& module);
void bind_pressure(py::module_& module);
void bind_contact_forces(py::module_& module);
void bind_motion_contact(py::module_& module);
void bind_recorded_motion(py::module_& module);
void bind_report(py::module_& module);
void bind_touch(py::module_& module);

}  // namespace condyle::python
