#pragma once

#include <pybind11/pybind11.h>

#include "condyle/normal_depth.hpp"
#include "condyle/pressure.hpp"

namespace condyle::python {

namespace py = pybind11;

/// Faces in contact as columns that keep the list alive, and what they add up to.
py::dict dict_of(SurfaceContact&& contact);
py::dict dict_of(const ContactTotals& totals);
py::tuple tuple_of(const Wrench& wrench);

/// By words that were checked in Python.
Casting casting_in(const std::string& word);
NormalDepthOptions rays_in(const std::string& rule, double reach_mm);

}  // namespace condyle::python
