#include "surface_contact.hpp"

#include <pybind11/stl.h>

#include "arrays.hpp"
#include "bindings.hpp"

namespace condyle::python {
namespace {

/// A column of the faces: `data` points into the first of them.
template <class T>
py::array column(const T* data, std::size_t count, const py::object& owner) {
  return view_of(data, {static_cast<py::ssize_t>(count)},
                 {static_cast<py::ssize_t>(sizeof(contact::FaceContact))}, owner);
}

/// Moments divided by what they are weighted with: places, (K, 3).
py::array centres(const std::vector<contact::FaceContact>& faces, Vec3 contact::FaceContact::*moment,
                  double contact::FaceContact::*weight) {
  Points points(faces.size());
  for (std::size_t i = 0; i < faces.size(); ++i) points.set(i, faces[i].*moment / faces[i].*weight);
  return array_of(points);
}

}  // namespace

py::dict dict_of(const contact::ContactTotals& totals) {
  py::dict dict;
  dict["triangles"] = totals.triangles;
  dict["area_mm2"] = totals.area_mm2;
  dict["mean_depth_mm"] = totals.mean_depth_mm;
  dict["max_depth_mm"] = totals.max_depth_mm;
  dict["centre_of_depth"] = optional_array(totals.centre_of_depth);
  dict["mean_pressure_mpa"] = totals.mean_pressure_mpa;
  dict["max_pressure_mpa"] = totals.max_pressure_mpa;
  dict["centre_of_pressure"] = optional_array(totals.centre_of_pressure);
  dict["force_n"] = array_of(totals.force_n);
  dict["moment_nmm"] = array_of(totals.moment_nmm);
  return dict;
}

py::dict dict_of(contact::SurfaceContact&& contact, const Mesh& casting, contact::FaceRule rule) {
  py::dict dict;
  dict["totals"] = dict_of(contact.totals);
  dict["met_from_front"] = contact.met_from_front;
  dict["rim_faces"] = contact.rim_faces;
  dict["oblique_area_mm2"] = contact.oblique_area_mm2;
  dict["peak_is_oblique"] = contact.peak_is_oblique;
  dict["max_strain"] = contact.max_strain;
  const py::object owner = py::cast(ContactFaces{std::move(contact.faces), casting, rule});
  const std::vector<contact::FaceContact>& faces = owner.cast<const ContactFaces&>().faces;
  dict["_faces"] = owner;
  dict["centre_of_depth"] =
      centres(faces, &contact::FaceContact::overlap_moment, &contact::FaceContact::overlap_mm3);
  static const contact::FaceContact none{};
  const contact::FaceContact& first = faces.empty() ? none : faces.front();
  dict["face"] = column(&first.face, faces.size(), owner);
  dict["area_mm2"] = column(&first.area_mm2, faces.size(), owner);
  dict["max_depth_mm"] = column(&first.max_depth_mm, faces.size(), owner);
  dict["overlap_mm3"] = column(&first.overlap_mm3, faces.size(), owner);
  dict["max_pressure_mpa"] = column(&first.max_pressure_mpa, faces.size(), owner);
  dict["load_n"] = column(&first.load_n, faces.size(), owner);
  return dict;
}

py::dict dict_of(contact::ElasticContactResults&& results, const contact::ElasticContact& surfaces) {
  const py::list notes = notes_of(motion::check_contact(results));
  const auto of = [&](std::optional<contact::SurfaceContact>& surface, const Mesh& casting) -> py::object {
    if (!surface) return py::none();
    return dict_of(std::move(*surface), casting, surfaces.options().rays.rule);
  };
  py::dict dict;
  dict["notes"] = notes;
  dict["fixed"] = of(results.fixed, surfaces.fixed());
  dict["mobile"] = of(results.mobile, surfaces.mobile());
  dict["force_n"] = array_of(results.on_mobile.force_n);
  dict["moment_nmm"] = array_of(results.on_mobile.moment_nmm);
  dict["energy_nmm"] = results.energy_nmm;
  return dict;
}

py::tuple tuple_of(const contact::Wrench& wrench) {
  return py::make_tuple(array_of(wrench.force_n), array_of(wrench.moment_nmm));
}

namespace {

/// The faces whose centre is in all half-spaces, each (normal, offset_mm), and what they add up to.
py::dict within(const ContactFaces& of, const py::list& region) {
  std::vector<contact::HalfSpace> half_spaces;
  for (const py::handle& half : region) {
    const auto [normal, offset_mm] = half.cast<std::pair<py::object, double>>();
    half_spaces.push_back({vector_in(normal, "region"), offset_mm});
  }
  contact::SurfaceContact found;
  found.faces = contact::faces_within(of.faces, of.casting, half_spaces);
  found.totals = contact::totals_of(found.faces, of.casting, of.rule);
  return dict_of(std::move(found), of.casting, of.rule);
}

}  // namespace

void bind_surface_contact(py::module_& module) {
  py::class_<ContactFaces>(module, "ContactFaces").def("within", &within);
}

contact::Casting casting_in(const std::string& word) {
  return word == "fixed"    ? contact::Casting::fixed
         : word == "mobile" ? contact::Casting::mobile
                            : contact::Casting::both;
}

contact::NormalDepthOptions rays_in(const std::string& rule, double reach_mm) {
  return {rule == "face_centre" ? contact::FaceRule::face_centre : contact::FaceRule::cut_faces, reach_mm};
}

}  // namespace condyle::python
