#include <pybind11/stl.h>

#include "arrays.hpp"
#include "bindings.hpp"
#include "condyle/answer.hpp"
#include "condyle/io/pose_text.hpp"
#include "interrupts.hpp"
#include "joint.hpp"
#include "json_object.hpp"
#include "vertex_gaps.hpp"

/// Every vertex, at one pose or many.

namespace condyle::python {

static py::dict dict_of(contact::ReliableDepths&& depths) {
  py::dict dict;
  dict["depth_mm"] = array_of(std::move(depths.depth_mm));
  dict["kind"] = bytes_of(depths.kind);
  dict["without"] = depths.without;
  dict["deepest"] = depths.deepest ? py::object(py::int_(depths.deepest->vertex)) : py::none();
  return dict;
}

namespace {

/// Results of a body that is held against a closed one.
template <class Results>
py::object optional_dict(std::optional<Results>& results) {
  if (!results) return py::none();
  return dict_of(std::move(*results));
}

py::tuple radial_gaps(const JointHandle& handle, const py::object& pose) {
  const Pose X_FM = one_pose(pose, "pose");
  contact::RadialContact contact = [&] {
    const py::gil_scoped_release released;
    return handle.contact.radial(X_FM);
  }();
  return py::make_tuple(optional_dict(contact.mobile_in_fixed), optional_dict(contact.fixed_in_mobile));
}

py::tuple tangential_gaps(const JointHandle& handle, const py::object& pose, const py::object& given) {
  const Pose X_FM = one_pose(pose, "pose");
  const contact::ArcsAbout about = about_in(given);
  check_depth_request(handle.joint(), {.X_FM = X_FM, .method = DepthMethod::tangential, .about = about});
  contact::TangentialContact contact = [&] {
    const py::gil_scoped_release released;
    const CoordinateSystem system = handle.joint().coordinates();
    return handle.contact.tangential(X_FM, line_of(about, system, angles_at(system, X_FM)));
  }();
  return py::make_tuple(optional_dict(contact.mobile_in_fixed), optional_dict(contact.fixed_in_mobile));
}

py::object patch_dict(const std::optional<contact::ContactPatch>& patch) {
  if (!patch) return py::none();
  py::dict dict;
  dict["area_mm2"] = patch->area_mm2;
  dict["mean_depth_mm"] = optional_number(patch->mean_depth_mm);
  dict["centroid"] = optional_array(patch->centroid);
  return dict;
}

py::dict measures_dict(contact::ContactMeasures&& found, const contact::RadialContact& contact) {
  py::dict dict;
  dict["in_contact"] = contact.in_contact;
  dict["intersecting_pairs"] = contact.pairs.size();
  dict["mobile_distance_mm"] = array_of(std::move(found.distances.mobile));
  dict["fixed_distance_mm"] = array_of(std::move(found.distances.fixed));
  dict["smallest_gap_mm"] = found.nearest.distance_mm;
  dict["nearest_on_fixed"] = array_of(found.nearest.on_fixed);
  dict["nearest_on_mobile"] = array_of(found.nearest.on_mobile);
  dict["mobile"] = patch_dict(found.mobile);
  dict["fixed"] = patch_dict(found.fixed);
  dict["volume_mm3"] = optional_number(found.volume_mm3);
  dict["volume_error_mm3"] = found.volume_error_mm3;
  dict["mobile_covered_again_mm3"] = found.mobile_covered_again_mm3;
  dict["fixed_covered_again_mm3"] = found.fixed_covered_again_mm3;
  dict["centroid"] = optional_array(found.centroid);
  return dict;
}

/// answer_depth() at each of the poses, as `wrap` gives it to Python: whether it was one pose, and a list.
template <class Wrap>
py::tuple answers(const JointHandle& handle, const py::object& given, const py::object& progress,
                  const DepthRequest& request, const Wrap& wrap) {
  const PosesIn in = poses_in(given, "pose");
  Follower follower(progress, in.poses.size());
  py::list list;
  for (std::size_t n = 0; n < in.poses.size(); ++n) {
    DepthAnswer answer = [&] {
      const py::gil_scoped_release released;
      DepthRequest here = request;
      here.X_FM = in.poses[n];
      DepthAnswer found = answer_depth(handle.contact, handle.joint(), here);
      follower.poll(n + 1);
      return found;
    }();
    list.append(wrap(std::move(answer)));
  }
  return py::make_tuple(in.is_one, list);
}

py::tuple measures(const JointHandle& handle, const py::object& poses, const py::object& progress) {
  return answers(handle, poses, progress,
                 {.method = DepthMethod::radial, .distances = contact::DistancesOf::all_vertices},
                 [](DepthAnswer&& answer) {
                   return measures_dict(std::move(answer.measures),
                                        std::get<RayDepths>(answer.depths).contact);
                 });
}

/// As `condyle depth` answers by default: of each pose both bodies, and the caveats.
py::tuple reliable(const JointHandle& handle, const py::object& poses, const py::object& progress) {
  const DepthRequest request{.measures = MeasuresOf::distances_only,
                             .deepest_place = true,
                             .limits = without_lock([&] { return handle.limits(); })};
  return answers(handle, poses, progress, request, [&](DepthAnswer&& answer) {
    contact::ReliableContact& found = std::get<RayDepths>(answer.depths).reliable;
    return py::make_tuple(optional_dict(found.mobile), optional_dict(found.fixed), py::cast(answer.caveats),
                          answer.deepest_place ? answer.deepest_place->depth_mm : 0,
                          standing_of(answer.standing, handle.joint().anatomy));
  });
}

}  // namespace

void bind_gaps(py::module_& module) {
  module.def("radial_gaps", &radial_gaps);
  module.def("tangential_gaps", &tangential_gaps);
  module.def("contact_measures", &measures);
  module.def("reliable_depths", &reliable);
}

}  // namespace condyle::python
