#include <fmt/format.h>
#include <pybind11/stl.h>

#include <limits>
#include <type_traits>

#include "arrays.hpp"
#include "bindings.hpp"
#include "condyle/answer.hpp"
#include "condyle/error.hpp"
#include "joint.hpp"

/// Ligaments of a joint, and what they have in poses.

namespace condyle::python {
namespace {

constexpr double nothing = std::numeric_limits<double>::quiet_NaN();

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
    dict["damping_n_s"] = ligament.damping_n_s;
    dict["ends_at_strain"] = ligament.ends_at_strain;
    dict["wrap"] = wrap_dict(ligament.wrap);
    list.append(dict);
  }
  return list;
}

/// One motion for each pose, of (N, 3) velocities; those that have a NaN are not known.
std::vector<std::optional<RelativeMotion>> velocities_in(const py::object& velocity,
                                                         const py::object& angular_velocity,
                                                         std::size_t count) {
  const PointsIn v(velocity, "velocity_mm_s", NotFinite::leave),
      w(angular_velocity, "angular_velocity_rad_s", NotFinite::leave);
  if (v.size() != count || w.size() != count)
    throw UsageError(fmt::format("velocity_mm_s, angular_velocity_rad_s: {} and {} for {} poses", v.size(),
                                 w.size(), count));
  std::vector<std::optional<RelativeMotion>> motions(count);
  for (std::size_t i = 0; i < count; ++i) {
    const RelativeMotion motion{v.view()[i], w.view()[i]};
    if (motion.velocity_mm_s.allFinite() && motion.angular_velocity_rad_s.allFinite()) motions[i] = motion;
  }
  return motions;
}

/// Per ligament, then per pose; NaN where a length is not known, and for gaps. Damping with the velocities of the mobile body, or with times;
/// both may be None.
py::dict states(const JointHandle& handle, const py::object& poses, const py::object& time,
                const py::object& velocity, const py::object& angular_velocity) {
  const std::vector<std::optional<Pose>> X_FM = poses_with_gaps_in(poses, "poses");
  std::vector<std::optional<RelativeMotion>> motions;
  if (!velocity.is_none()) motions = velocities_in(velocity, angular_velocity, X_FM.size());
  if (!time.is_none()) {
    const std::vector<double> time_s = doubles_in(time, "time_s");
    if (time_s.size() != X_FM.size())
      throw UsageError(fmt::format("time_s: {} for {} poses", time_s.size(), X_FM.size()));
    for (std::size_t i = 1; i < time_s.size(); ++i)
      if (!(time_s[i] > time_s[i - 1])) throw UsageError("time_s: must increase");
    motions = motions_along(X_FM, time_s);
  }
  const std::vector<LigamentAlong> along =
      without_lock([&] { return ligaments_along(handle.joint().ligaments, X_FM, motions); });
  py::dict dict;
  const auto add = [&](const char* name, auto frames, auto member) {
    std::vector<double> values;
    for (const LigamentAlong& ligament : along)
      for (const auto& at : ligament.*frames) {
        if constexpr (std::is_same_v<decltype(member), Vec3 LigamentState::*>)
          for (int axis = 0; axis < 3; ++axis) values.push_back(at ? ((*at).*member)[axis] : nothing);
        else
          values.push_back(at ? (*at).*member : nothing);
      }
    dict[name] = array_of(std::move(values));
  };
  add("length_mm", &LigamentAlong::frames, &LigamentState::length_mm);
  add("strain", &LigamentAlong::frames, &LigamentState::strain);
  add("tension_n", &LigamentAlong::frames, &LigamentState::tension_n);
  add("force_n", &LigamentAlong::frames, &LigamentState::force_n);
  add("moment_nmm", &LigamentAlong::frames, &LigamentState::moment_nmm);
  if (motions.empty()) return dict;
  add("lengthening_mm_s", &LigamentAlong::damping, &LigamentDamping::lengthening_mm_s);
  add("damping_n", &LigamentAlong::damping, &LigamentDamping::damping_n);
  add("total_n", &LigamentAlong::damping, &LigamentDamping::total_n);
  return dict;
}

/// What check_ligaments() says of them in these poses.
py::list ligament_checks_of(const JointHandle& handle, const py::object& poses) {
  const std::vector<std::optional<Pose>> X_FM = poses_with_gaps_in(poses, "poses");
  return notes_of(motion::check_ligaments(ligaments_along(handle.joint().ligaments, X_FM), X_FM));
}

/// Per ligament, then per pose, row by row; NaN where it is not known, and for gaps.
py::array stiffness_of(const JointHandle& handle, const py::object& poses) {
  const std::vector<std::optional<Pose>> X_FM = poses_with_gaps_in(poses, "poses");
  using Rows = Eigen::Matrix<double, 6, 6, Eigen::RowMajor>;
  std::vector<double> values;
  for (const Ligament& ligament : handle.joint().ligaments)
    for (const std::optional<Pose>& X : X_FM) {
      const auto known = X ? ligament_stiffness(ligament, *X) : std::nullopt;
      const Rows rows = known ? Rows(*known) : Rows::Constant(nothing);
      values.insert(values.end(), rows.data(), rows.data() + rows.size());
    }
  return array_of(std::move(values));
}

}  // namespace

void bind_ligaments(py::module_& module) {
  module.def("ligaments_of", &ligaments_of);
  module.def("ligament_states", &states);
  module.def("ligament_checks", &ligament_checks_of);
  module.def("ligament_stiffness", &stiffness_of);
}

}  // namespace condyle::python
