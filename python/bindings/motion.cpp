#include "motion.hpp"

#include <pybind11/stl.h>

#include "arrays.hpp"
#include "io/joint/given_degrees.hpp"

namespace condyle::python {
namespace {

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
  const auto& [flexion, adduction, internal_rotation] = motion.start;
  return py::make_tuple(motion.name, static_cast<int>(motion.vary), static_cast<int>(motion.sense),
                        std::array{io::given_degrees(flexion), io::given_degrees(adduction),
                                   io::given_degrees(internal_rotation)},
                        io::given_degrees(motion.range));
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
  dict["limit_deg"] = limit.turned.degrees();
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

}  // namespace condyle::python
