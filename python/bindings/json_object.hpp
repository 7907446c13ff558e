#pragma once

#include <pybind11/pybind11.h>

#include <optional>
#include <utility>

#include "io/result/json.hpp"
#include "io/result/pose_state.hpp"

namespace condyle::python {

/// A document as Python reads it: numbers to the last bit.
inline pybind11::object object_of(io::Json json) {
  return pybind11::module_::import("json").attr("loads")(io::document(std::move(json)));
}

/// Its keys in documents, as a dict; None if a pose was not judged.
inline pybind11::object standing_of(const std::optional<PoseStanding>& standing, Anatomy joint) {
  if (!standing) return pybind11::none();
  io::Json json;
  io::add_standing(json, standing, joint);
  return object_of(std::move(json));
}

}  // namespace condyle::python
