#include "motion.hpp"

#include <pybind11/stl.h>

#include "arrays.hpp"
#include "io/result/rom_result.hpp"

namespace condyle::python {
namespace {

std::array<double, 3> degrees_of_angles(const JointAngles& angles) {
  return {angles.flexion.degrees(), angles.adduction.degrees(), angles.internal_rotation.degrees()};
}

py::tuple feature_tuple(const motion::Feature& feature) {
  constexpr const char* kinds[] = {"vertex", "edge", "face"};
  const char* kind = kinds[static_cast<std::size_t>(feature.kind)];
  if (feature.kind != motion::FeatureKind::edge) return py::make_tuple(kind, feature.id);
  return py::make_tuple(kind, feature.id, feature.other_end);
}

}  // namespace

JointAngles angles_in(const py::object& given, std::string_view name) {
  const Vec3 degrees = vector_in(given, name);
  return {Angle::degrees(degrees[0]), Angle::degrees(degrees[1]), Angle::degrees(degrees[2])};
}

py::tuple tuple_of(const motion::Motion& motion) {
  return py::make_tuple(motion.name, static_cast<int>(motion.vary), static_cast<int>(motion.sense),
                        degrees_of_angles(motion.start), motion.range.degrees());
}

motion::Motion motion_in(const py::tuple& given) {
  return {.name = given[0].cast<std::string>(),
          .vary = angle_numbered(given[1].cast<std::size_t>()),
          .sense = given[2].cast<int>() < 0 ? RotationSense::negative : RotationSense::positive,
          .start = angles_in(given[3], "start"),
          .range = Angle::degrees(given[4].cast<double>())};
}

std::vector<motion::Motion> motions_in(const py::list& given) {
  std::vector<motion::Motion> motions;
  for (const py::handle& motion : given) motions.push_back(motion_in(motion.cast<py::tuple>()));
  return motions;
}

py::object dict_of(const std::optional<motion::ContactWitness>& contact, const io::AnswerFrame& frame) {
  if (!contact) return py::none();
  py::dict dict;
  dict["fixed_feature"] = feature_tuple(contact->fixed_feature);
  dict["mobile_feature"] = feature_tuple(contact->mobile_feature);
  dict["fixed_point"] = array_of(frame.fixed_point(contact->fixed_point));
  dict["mobile_point"] = array_of(frame.mobile_point(contact->mobile_point));
  dict["kind"] = name_of(contact->kind);
  return dict;
}

py::dict dict_of(const motion::Limit& limit, const io::AnswerFrame& frame) {
  py::dict dict;
  dict["turned_deg"] = limit.turned.degrees();
  dict["reason"] = name_of(limit.reason);
  dict["contact"] = dict_of(limit.contact, frame);
  dict["error_bound_deg"] = limit.error_bound.degrees();
  const auto degrees = [](const std::optional<motion::EarlierContact>& contact) {
    return contact ? py::object(py::float_(contact->turned.degrees())) : py::none();
  };
  dict["bearing_contact_deg"] = degrees(limit.bearing_contact);
  dict["soft_contact_deg"] = degrees(limit.soft_contact);
  dict["soft_contact"] = limit.soft_contact ? dict_of(limit.soft_contact->contact, frame) : py::none();
  return dict;
}

py::dict dict_of(const motion::MotionLimit& limit, const io::AnswerFrame& frame) {
  py::dict dict = dict_of(limit.end, frame);
  dict["motion"] = tuple_of(limit.motion);
  dict["angles_deg"] = degrees_of_angles(limit.angles_at_limit());
  dict["centre_distance_mm"] = limit.head ? optional_number(limit.head->centre_distance_mm) : py::none();
  dict["joint_space_mm"] = limit.head ? optional_number(limit.head->joint_space_mm) : py::none();
  dict["translation_mm"] = optional_array(limit.translation_mm);
  dict["translation_ends"] = limit.translation_ends;
  return dict;
}

}  // namespace condyle::python
