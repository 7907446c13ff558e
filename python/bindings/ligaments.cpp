#include <pybind11/stl.h>

#include <limits>

#include "arrays.hpp"
#include "bindings.hpp"
#include "condyle/answer.hpp"
#include "joint.hpp"

/// Ligaments of a joint, and what they have in poses.

namespace condyle::python {
namespace {

py::array rows_of(const std::vector<Vec3>& points) {
  Points all;
  for (const Vec3& point : points) all.push_back(point);
  return array_of(all);
}

py::object wrap_dict(const std::optional<LigamentWrap>& wrap) {
  if (!wrap) return py::none();
  py::dict dict;
  dict["shape"] = name_of(wrap->shape);
  dict["body"] = wrap->body == BodyRole::fixed ? "fixed" : "mobile";
  dict["centre"] = array_of(wrap->centre);
  if (wrap->shape == WrapShape::ellipsoid) {
    dict["axes"] = rows_of({wrap->axes.col(0), wrap->axes.col(1)});
    dict["radii_mm"] = array_of(wrap->radii_mm);
    return dict;
  }
  dict["radius_mm"] = wrap->radius_mm;
  if (wrap->shape == WrapShape::cylinder) dict["axis"] = array_of(wrap->axis);
  return dict;
}

py::list ligaments_of(const JointHandle& handle) {
  py::list list;
  for (const Ligament& ligament : handle.joint().ligaments) {
    py::dict dict;
    dict["name"] = ligament.name;
    dict["fixed"] = rows_of(ligament.fixed);
    dict["mobile"] = rows_of(ligament.mobile);
    dict["slack_length_mm"] = ligament.slack_length_mm;
    dict["slack_sigma_mm"] = ligament.slack_sigma_mm;
    dict["point_sigma_mm"] = ligament.point_sigma_mm;
    dict["stiffness_n"] = ligament.stiffness_n;
    dict["transition_strain"] = ligament.transition_strain;
    dict["ends_at_strain"] = ligament.ends_at_strain;
    dict["wrap"] = wrap_dict(ligament.wrap);
    list.append(dict);
  }
  return list;
}

/// Per ligament, then per pose; NaN where a length is not known, and for gaps.
py::dict states(const JointHandle& handle, const py::object& poses) {
  const std::vector<std::optional<Pose>> X_FM = poses_with_gaps_in(poses, "poses");
  const std::vector<LigamentAlong> along =
      without_lock([&] { return ligaments_along(handle.joint().ligaments, X_FM); });
  constexpr double nothing = std::numeric_limits<double>::quiet_NaN();
  std::vector<double> length, strain, tension, force, moment;
  for (const LigamentAlong& ligament : along)
    for (const auto& at : ligament.frames) {
      length.push_back(at ? at->length_mm : nothing);
      strain.push_back(at ? at->strain : nothing);
      tension.push_back(at ? at->tension_n : nothing);
      for (int axis = 0; axis < 3; ++axis) {
        force.push_back(at ? at->force_n[axis] : nothing);
        moment.push_back(at ? at->moment_nmm[axis] : nothing);
      }
    }
  py::dict dict;
  dict["length_mm"] = array_of(std::move(length));
  dict["strain"] = array_of(std::move(strain));
  dict["tension_n"] = array_of(std::move(tension));
  dict["force_n"] = array_of(std::move(force));
  dict["moment_nmm"] = array_of(std::move(moment));
  return dict;
}

/// Per ligament, then per pose, row by row; NaN where it is not known, and for gaps.
py::array stiffness_of(const JointHandle& handle, const py::object& poses) {
  const std::vector<std::optional<Pose>> X_FM = poses_with_gaps_in(poses, "poses");
  using Rows = Eigen::Matrix<double, 6, 6, Eigen::RowMajor>;
  std::vector<double> values;
  for (const Ligament& ligament : handle.joint().ligaments)
    for (const std::optional<Pose>& X : X_FM) {
      const auto known = X ? ligament_stiffness(ligament, *X) : std::nullopt;
      const Rows rows = known ? Rows(*known) : Rows::Constant(std::numeric_limits<double>::quiet_NaN());
      values.insert(values.end(), rows.data(), rows.data() + rows.size());
    }
  return array_of(std::move(values));
}

}  // namespace

void bind_ligaments(py::module_& module) {
  module.def("ligaments_of", &ligaments_of);
  module.def("ligament_states", &states);
  module.def("ligament_stiffness", &stiffness_of);
}

}  // namespace condyle::python
