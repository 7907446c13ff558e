#include "condyle/normal_depth.hpp"
#include "condyle/pressure.hpp"

#include <pybind11/stl.h>

#include <optional>
#include <string>

#include "answer/depth_meshes.hpp"
#include "arrays.hpp"
#include "bindings.hpp"
#include "interrupts.hpp"
#include "joint.hpp"
#include "surface_contact.hpp"

namespace condyle::python {
namespace {

/// For each pose what the rays of the fixed and of the mobile body found, None for one that does not cast.
py::tuple normal(const JointHandle& handle, const py::object& given, const std::string& casting_word,
                 const std::string& rule, double reach_mm, const py::object& progress) {
  const PosesIn in = poses_in(given, "pose");
  const contact::Casting casting = casting_in(casting_word);
  const contact::NormalDepthOptions rays = rays_in(rule, reach_mm);
  const Mesh &fixed = handle.joint().fixed.mesh, &mobile = handle.joint().mobile.mesh;
  std::vector<std::pair<std::optional<contact::SurfaceContact>, std::optional<contact::SurfaceContact>>>
      found;
  Follower follower(progress, in.poses.size());
  {
    const py::gil_scoped_release released;
    answer::require_depth_meshes(handle.joint(), DepthMethod::normal,
                                 {handle.joint().fixed.name, handle.joint().mobile.name});
    std::optional<contact::NormalDepth> from_fixed, from_mobile;
    if (casting != contact::Casting::mobile) from_fixed.emplace(fixed, mobile, rays);
    if (casting != contact::Casting::fixed) from_mobile.emplace(mobile, fixed, rays);
    for (const Pose& X_FM : in.poses) {
      auto& [of_fixed, of_mobile] = found.emplace_back();
      if (from_fixed) of_fixed = from_fixed->at(X_FM);
      if (from_mobile) of_mobile = from_mobile->at(inverted(X_FM));
      follower.poll(found.size());
    }
  }
  py::list answers;
  for (auto& [of_fixed, of_mobile] : found)
    answers.append(py::make_tuple(
        of_fixed ? py::object(dict_of(std::move(*of_fixed), fixed, rays.rule)) : py::none(),
        of_mobile ? py::object(dict_of(std::move(*of_mobile), mobile, rays.rule)) : py::none()));
  return py::make_tuple(in.is_one, answers);
}

py::array thickness(const Mesh& layer, const Mesh& behind, double reach_mm) {
  std::vector<double> values = without_lock([&] { return contact::thickness_to(layer, behind, reach_mm); });
  return array_of(std::move(values));
}

}  // namespace

void bind_normal_contact(py::module_& module) {
  module.def("normal_contact", &normal);
  module.def("thickness_to", &thickness);
}

}  // namespace condyle::python
