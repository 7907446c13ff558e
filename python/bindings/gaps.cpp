#include <fmt/format.h>

#include "arrays.hpp"
#include "bindings.hpp"
#include "condyle/contact_measures.hpp"
#include "condyle/error.hpp"
#include "condyle/reliable_depth.hpp"
#include "joint.hpp"

/// Every vertex, at one pose.

namespace condyle::python {
namespace {

Pose one_pose(const py::object& given) {
  PosesIn in = poses_in(given, "pose");
  if (!in.is_one) throw UsageError("pose: one pose of shape (4, 4) is needed");
  return in.poses.front();
}

py::object optional_vector(const std::optional<Vec3>& vector) {
  if (!vector) return py::none();
  return array_of(*vector);
}
py::object optional_number(const std::optional<double>& number) {
  if (!number) return py::none();
  return py::float_(*number);
}

py::object dict_of(std::optional<RadialResults>& from) {
  if (!from) return py::none();
  py::dict dict;
  dict["state"] = bytes_of(from->state);
  dict["winding"] = array_of(std::move(from->winding));
  dict["gap_mm"] = array_of(std::move(from->radial_gap_mm));
  dict["triangle"] = array_of(std::move(from->triangle));
  dict["ray_to_normal_deg"] = degrees_of(from->ray_to_normal);
  return dict;
}

py::object dict_of(std::optional<TangentialResults>& from) {
  if (!from) return py::none();
  py::dict dict;
  dict["state"] = bytes_of(from->state);
  dict["winding"] = array_of(std::move(from->winding));
  dict["gap_mm"] = array_of(std::move(from->arc_gap_mm));
  dict["gap_deg"] = degrees_of(from->angular_gap);
  dict["triangle"] = array_of(std::move(from->triangle));
  dict["rotation_sense"] = bytes_of(from->rotation_sense);
  return dict;
}

py::tuple radial_gaps(const JointHandle& handle, const py::object& pose) {
  const Pose X_FM = one_pose(pose);
  RadialContact contact = [&] {
    const py::gil_scoped_release released;
    return handle.contact.radial(X_FM);
  }();
  return py::make_tuple(dict_of(contact.mobile_in_fixed), dict_of(contact.fixed_in_mobile));
}

py::tuple tangential_gaps(const JointHandle& handle, const py::object& pose, std::size_t about) {
  const Pose X_FM = one_pose(pose);
  if (const double moved = X_FM.translation().norm(); moved > 0)
    throw UsageError(fmt::format(
        "method tangential: turns about the joint centre, and the pose is translated from it by {:.3f} mm; "
        "method radial answers there",
        moved));
  TangentialContact contact = [&] {
    const py::gil_scoped_release released;
    const CoordinateSystem system = handle.joint().coordinates();
    return handle.contact.tangential(X_FM,
                                     axis_of(all_joint_angles.at(about), system, angles_at(system, X_FM)));
  }();
  return py::make_tuple(dict_of(contact.mobile_in_fixed), dict_of(contact.fixed_in_mobile));
}

py::object dict_of(const std::optional<ContactPatch>& patch) {
  if (!patch) return py::none();
  py::dict dict;
  dict["area_mm2"] = patch->area_mm2;
  dict["mean_depth_mm"] = optional_number(patch->mean_depth_mm);
  dict["centroid"] = optional_vector(patch->centroid);
  return dict;
}

py::dict measures(const JointHandle& handle, const py::object& pose) {
  const Pose X_FM = one_pose(pose);
  bool in_contact = false;
  std::size_t pair_count = 0;
  ContactMeasures found = [&] {
    const py::gil_scoped_release released;
    const RadialContact contact = handle.contact.radial(X_FM);
    in_contact = contact.in_contact;
    pair_count = contact.pairs.size();
    return measure_contact(handle.contact, X_FM, VertexStates(contact));
  }();
  py::dict dict;
  dict["in_contact"] = in_contact;
  dict["intersecting_pairs"] = pair_count;
  dict["mobile_distance_mm"] = array_of(std::move(found.distances.mobile));
  dict["fixed_distance_mm"] = array_of(std::move(found.distances.fixed));
  dict["smallest_gap_mm"] = found.nearest.distance_mm;
  dict["nearest_on_fixed"] = array_of(found.nearest.on_fixed);
  dict["nearest_on_mobile"] = array_of(found.nearest.on_mobile);
  dict["mobile"] = dict_of(found.mobile);
  dict["fixed"] = dict_of(found.fixed);
  dict["volume_mm3"] = optional_number(found.volume_mm3);
  dict["centroid"] = optional_vector(found.centroid);
  return dict;
}

py::object dict_of(std::optional<ReliableDepths>& from) {
  if (!from) return py::none();
  py::dict dict;
  dict["depth_mm"] = array_of(std::move(from->depth_mm));
  dict["way"] = bytes_of(from->way);
  dict["without"] = from->without;
  dict["deepest"] = from->deepest ? py::object(py::int_(from->deepest->vertex)) : py::none();
  return dict;
}

/// As `condyle depth` answers by default.
py::tuple reliable(const JointHandle& handle, const py::object& pose) {
  const Pose X_FM = one_pose(pose);
  const Joint& joint = handle.joint();
  ReliableContact found = [&] {
    const py::gil_scoped_release released;
    const RadialContact contact = handle.contact.radial(X_FM);
    const NearestDistances distances = measure_contact(handle.contact, X_FM, VertexStates(contact)).distances;
    const bool rotated_only = X_FM.translation() == Vec3::Zero();
    return rotated_only ? reliable_depths(handle.contact, joint.kind, joint.coordinates(),
                                          angles_at(joint.coordinates(), X_FM), contact, distances)
                        : reliable_radial_depths(contact, distances);
  }();
  return py::make_tuple(dict_of(found.mobile), dict_of(found.fixed));
}

}  // namespace

void bind_gaps(py::module_& module) {
  module.def("radial_gaps", &radial_gaps);
  module.def("tangential_gaps", &tangential_gaps);
  module.def("contact_measures", &measures);
  module.def("reliable_depths", &reliable);
}

}  // namespace condyle::python
