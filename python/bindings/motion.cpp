#include "motion.hpp"

#include <pybind11/stl.h>

#include "arrays.hpp"

namespace condyle::python {
namespace {

std::array<double, 3> degrees_of_angles(const JointAngles& angles) {
  return {angles.flexion.degrees(), angles.adduction.degrees(), angles.internal_rotation.degrees()};
}

py::tuple tuple_of(const Feature& feature) {
  constexpr const char* kinds[] = {"vertex", "edge", "face"};
  const char* kind = kinds[static_cast<std::size_t>(feature.kind)];
  if (feature.kind != FeatureKind::edge) return py::make_tuple(kind, feature.id);
  return py::make_tuple(kind, feature.id, feature.other_end);
}

const char* name_of_reason(LimitReason reason) {
  constexpr const char* names[] = {"contact", "end_of_range", "contact_at_start"};
  return names[static_cast<std::size_t>(reason)];
}

const char* name_of_kind(ContactKind kind) {
  constexpr const char* names[] = {"unknown", "bearing", "impingement"};
  return names[static_cast<std::size_t>(kind)];
}

}  // namespace

JointAngle angle_numbered(std::size_t number) {
  return all_joint_angles.at(number);
}

JointAngles angles_in(const py::object& given, std::string_view name) {
  const Vec3 degrees = vector_in(given, name);
  return {Angle::degrees(degrees[0]), Angle::degrees(degrees[1]), Angle::degrees(degrees[2])};
}

py::tuple tuple_of(const Motion& motion) {
  return py::make_tuple(motion.name, static_cast<int>(motion.vary), static_cast<int>(motion.sense),
                        degrees_of_angles(motion.start), motion.range.degrees());
}

Motion motion_in(const py::tuple& given) {
  return {.name = given[0].cast<std::string>(),
          .vary = angle_numbered(given[1].cast<std::size_t>()),
          .sense = given[2].cast<int>() < 0 ? RotationSense::negative : RotationSense::positive,
          .start = angles_in(given[3], "start"),
          .range = Angle::degrees(given[4].cast<double>())};
}

std::vector<Motion> motions_in(const py::list& given) {
  std::vector<Motion> motions;
  for (const py::handle& motion : given) motions.push_back(motion_in(motion.cast<py::tuple>()));
  return motions;
}

py::object dict_of(const std::optional<ContactWitness>& contact) {
  if (!contact) return py::none();
  py::dict dict;
  dict["fixed_feature"] = tuple_of(contact->fixed_feature);
  dict["mobile_feature"] = tuple_of(contact->mobile_feature);
  dict["fixed_point"] = array_of(contact->fixed_point);
  dict["mobile_point"] = array_of(contact->mobile_point);
  dict["kind"] = name_of_kind(contact->kind);
  return dict;
}

py::dict dict_of(const Limit& limit) {
  py::dict dict;
  dict["turned_deg"] = limit.turned.degrees();
  dict["reason"] = name_of_reason(limit.reason);
  dict["contact"] = dict_of(limit.contact);
  dict["error_bound_deg"] = limit.error_bound.degrees();
  dict["bearing_contact_deg"] =
      limit.bearing_contact ? py::object(py::float_(limit.bearing_contact->turned.degrees())) : py::none();
  return dict;
}

py::dict dict_of(const MotionLimit& limit) {
  py::dict dict = dict_of(limit.end);
  dict["motion"] = tuple_of(limit.motion);
  dict["angles_deg"] = degrees_of_angles(limit.angles_at_limit());
  dict["centre_distance_mm"] = limit.head ? py::cast(limit.head->centre_distance_mm) : py::none();
  dict["joint_space_mm"] = limit.head ? py::cast(limit.head->joint_space_mm) : py::none();
  return dict;
}

}  // namespace condyle::python
