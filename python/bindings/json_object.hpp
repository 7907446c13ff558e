#pragma once

#include <pybind11/pybind11.h>

#include <utility>

#include "io/result/json.hpp"

namespace condyle::python {

/// A document as Python reads it: numbers to the last bit.
inline pybind11::object object_of(io::Json json) {
  return pybind11::module_::import("json").attr("loads")(io::document(std::move(json)));
}

}  // namespace condyle::python
