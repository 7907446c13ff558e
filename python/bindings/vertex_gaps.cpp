#include "vertex_gaps.hpp"

#include "arrays.hpp"

namespace condyle::python {

py::dict dict_of(radial::RadialResults&& results) {
  py::dict dict;
  dict["state"] = bytes_of(results.state);
  dict["winding"] = array_of(std::move(results.winding));
  dict["gap_mm"] = array_of(std::move(results.radial_gap_mm));
  dict["triangle"] = array_of(std::move(results.triangle));
  dict["ray_to_normal_deg"] = degrees_of(results.ray_to_normal);
  return dict;
}

py::dict dict_of(tangential::TangentialResults&& results) {
  py::dict dict;
  dict["state"] = bytes_of(results.state);
  dict["winding"] = array_of(std::move(results.winding));
  dict["gap_mm"] = array_of(std::move(results.arc_gap_mm));
  dict["gap_deg"] = degrees_of(results.angular_gap);
  dict["triangle"] = array_of(std::move(results.triangle));
  dict["rotation_sense"] = bytes_of(results.rotation_sense);
  return dict;
}

}  // namespace condyle::python
