#pragma once

#include <pybind11/pybind11.h>

#include <string>
#include <vector>

#include "condyle/motion_contact.hpp"
#include "condyle/normal_depth.hpp"
#include "condyle/pressure.hpp"

namespace condyle::python {

namespace py = pybind11;

/// Faces in contact of a surface, to select those within a region.
struct ContactFaces {
  std::vector<contact::FaceContact> faces;
  Mesh casting;
  contact::FaceRule rule;
};

/// Faces in contact as columns that keep the list alive, "faces", and what they add up to.
py::dict dict_of(contact::SurfaceContact&& contact, const Mesh& casting, contact::FaceRule rule);
py::dict dict_of(const contact::ContactTotals& totals);
/// Results of what each body casts.
py::dict dict_of(contact::ElasticContactResults&& results, const contact::ElasticContact& surfaces);
py::tuple tuple_of(const contact::Wrench& wrench);
/// By words that were checked in Python.
contact::Casting casting_in(const std::string& word);
contact::NormalDepthOptions rays_in(const std::string& rule, double reach_mm);

}  // namespace condyle::python
