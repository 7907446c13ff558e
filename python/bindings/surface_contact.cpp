#include "surface_contact.hpp"

#include <memory>

#include "arrays.hpp"

namespace condyle::python {
namespace {

/// A column of the faces: `data` points into the first of them.
template <class T>
py::array column(const T* data, std::size_t count, const py::object& owner) {
  return view_of(data, {static_cast<py::ssize_t>(count)}, {static_cast<py::ssize_t>(sizeof(FaceContact))},
                 owner);
}

/// Moments divided by what they are weighted with: places, (K, 3).
py::array centres(const std::vector<FaceContact>& faces, Vec3 FaceContact::*moment,
                  double FaceContact::*weight) {
  Points points(faces.size());
  for (std::size_t i = 0; i < faces.size(); ++i) points.set(i, faces[i].*moment / faces[i].*weight);
  return array_of(points);
}

py::object optional_vector(const std::optional<Vec3>& vector) {
  if (!vector) return py::none();
  return array_of(*vector);
}

}  // namespace

py::dict dict_of(const ContactTotals& totals) {
  py::dict dict;
  dict["triangles"] = totals.triangles;
  dict["area_mm2"] = totals.area_mm2;
  dict["mean_depth_mm"] = totals.mean_depth_mm;
  dict["max_depth_mm"] = totals.max_depth_mm;
  dict["centre_of_depth"] = optional_vector(totals.centre_of_depth);
  dict["mean_pressure_mpa"] = totals.mean_pressure_mpa;
  dict["max_pressure_mpa"] = totals.max_pressure_mpa;
  dict["centre_of_pressure"] = optional_vector(totals.centre_of_pressure);
  dict["force_n"] = array_of(totals.force_n);
  dict["moment_nmm"] = array_of(totals.moment_nmm);
  return dict;
}

py::dict dict_of(SurfaceContact&& contact) {
  py::dict dict;
  dict["totals"] = dict_of(contact.totals);
  dict["met_from_front"] = contact.met_from_front;
  dict["rim_faces"] = contact.rim_faces;
  const auto kept = std::make_shared<std::vector<FaceContact>>(std::move(contact.faces));
  dict["centre_of_depth"] = centres(*kept, &FaceContact::overlap_moment, &FaceContact::overlap_mm3);
  const py::capsule owner(new std::shared_ptr<std::vector<FaceContact>>(kept), [](void* pointer) {
    delete static_cast<std::shared_ptr<std::vector<FaceContact>>*>(pointer);
  });
  static const FaceContact none{};
  const FaceContact& first = kept->empty() ? none : kept->front();
  dict["face"] = column(&first.face, kept->size(), owner);
  dict["area_mm2"] = column(&first.area_mm2, kept->size(), owner);
  dict["max_depth_mm"] = column(&first.max_depth_mm, kept->size(), owner);
  dict["overlap_mm3"] = column(&first.overlap_mm3, kept->size(), owner);
  dict["max_pressure_mpa"] = column(&first.max_pressure_mpa, kept->size(), owner);
  dict["load_n"] = column(&first.load_n, kept->size(), owner);
  return dict;
}

py::tuple tuple_of(const Wrench& wrench) {
  return py::make_tuple(array_of(wrench.force_n), array_of(wrench.moment_nmm));
}

Casting casting_in(const std::string& word) {
  return word == "fixed" ? Casting::fixed : word == "mobile" ? Casting::mobile : Casting::both;
}

NormalDepthOptions rays_in(const std::string& rule, double reach_mm) {
  return {rule == "face_centre" ? FaceRule::face_centre : FaceRule::cut_faces, reach_mm};
}

}  // namespace condyle::python
