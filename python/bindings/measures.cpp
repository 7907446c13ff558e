#include "bindings.hpp"
#include "condyle/answer.hpp"
#include "interrupts.hpp"
#include "io/result/json_objects.hpp"
#include "json_object.hpp"
#include "range_answer.hpp"

namespace condyle::python {
namespace {

/// What measure_json() says.
py::object measures_of(const JointHandle& handle, double pelvic_tilt_deg, const py::object& band,
                       const py::object& progress) {
  const MeasureRequest request{Angle::degrees(pelvic_tilt_deg), band_in(band)};
  const MeasureAnswer answer = *with_progress(
      progress, [&](const Control& control) { return answer_measures(handle.loaded, request, control); });
  return object_of(io::measure_object({handle.joint(), answer}));
}

}  // namespace

void bind_measures(py::module_& module) {
  module.def("hip_measures_of", &measures_of);
}

}  // namespace condyle::python
