#include <array>
#include <limits>

#include "condyle/io/motion_result.hpp"
#include "condyle/io/pose_text.hpp"
#include "io/joint/recorded_motion_table.hpp"

namespace condyle {
namespace {

constexpr double nothing = std::numeric_limits<double>::quiet_NaN();

/// Curves by name, filled frame by frame.
class Columns {
 public:
  Columns(Curves& curves, std::size_t frames) : curves_(curves), frames_(frames) {}

  /// value(frame) of each frame that has one.
  template <class Value>
  void add(const std::string& name, const std::vector<std::optional<FrameContact>>& frames,
           const Value& value) {
    curves_.names.push_back(name);
    auto& column = curves_.values.emplace_back(frames_, nothing);
    for (std::size_t i = 0; i < frames_; ++i)
      if (frames[i]) column[i] = value(*frames[i]) + 0.0;  // without the sign of 0
  }
  template <class Value>
  void add_vector(const std::string& name, const std::string& unit,
                  const std::vector<std::optional<FrameContact>>& frames, const Value& value) {
    constexpr std::array axes = {"_x", "_y", "_z"};
    for (int axis = 0; axis < 3; ++axis)
      add(name + axes[static_cast<std::size_t>(axis)] + unit, frames,
          [&](const FrameContact& frame) { return value(frame)[axis]; });
  }

 private:
  Curves& curves_;
  std::size_t frames_;
};

Vec3 or_nothing(const std::optional<Vec3>& point) {
  return point.value_or(Vec3::Constant(nothing));
}

/// Of both castings the load is the mean on the mobile body, in its frame; of one, what the casting body carries in its own.
Wrench load_of(const ContactEntry& contact, const FrameContact& frame) {
  if (contact.casting != Casting::both)
    return {frame.surface.totals.force_n, frame.surface.totals.moment_nmm};
  const Eigen::Matrix3d R_MF = frame.X_FM.linear().transpose();
  return {R_MF * frame.on_mobile.force_n, R_MF * frame.on_mobile.moment_nmm};
}

/// What totals and a load say, under names that begin with `prefix`.
template <class Totals, class LoadOf>
void add_contact(const MotionQuestion& question, Columns& columns, const std::string& prefix,
                 const std::vector<std::optional<FrameContact>>& frames, const Totals& totals,
                 const LoadOf& load) {
  columns.add(prefix + "area_mm2", frames, [&](const auto& f) { return totals(f).area_mm2; });
  columns.add(prefix + "mean_depth_mm", frames, [&](const auto& f) { return totals(f).mean_depth_mm; });
  columns.add(prefix + "max_depth_mm", frames, [&](const auto& f) { return totals(f).max_depth_mm; });
  columns.add_vector(prefix + "centre_of_depth", "_mm", frames,
                     [&](const auto& f) { return or_nothing(totals(f).centre_of_depth); });
  if (!question.with_pressure) return;
  const double sign = question.contact.moment_on == MomentOn::casting ? 1 : -1;
  columns.add(prefix + "mean_pressure_mpa", frames,
              [&](const auto& f) { return totals(f).mean_pressure_mpa; });
  columns.add(prefix + "max_pressure_mpa", frames, [&](const auto& f) { return totals(f).max_pressure_mpa; });
  columns.add_vector(prefix + "centre_of_pressure", "_mm", frames,
                     [&](const auto& f) { return or_nothing(totals(f).centre_of_pressure); });
  columns.add_vector(prefix + "force", "_n", frames, [&](const auto& f) { return load(f).force_n; });
  columns.add_vector(prefix + "moment", "_nmm", frames,
                     [&](const auto& f) { return Vec3(sign * load(f).moment_nmm); });
}

}  // namespace

Curves region_curves_of(const MotionQuestion& question, const MotionAnswer& answer) {
  Curves curves;
  curves.axis = question.motion.times.in_seconds ? "time_s" : "frame";
  curves.at = question.motion.times.values;
  Columns columns(curves, answer.frames.size());
  const ContactEntry& contact = question.contact;
  const Mesh& casting =
      contact.casting == Casting::fixed ? question.surfaces.fixed.mesh : question.surfaces.mobile.mesh;
  for (const RegionEntry& region : contact.regions) {
    const auto totals = [&](const FrameContact& frame) {
      return totals_of(faces_within(frame.surface.faces, casting, region.half_spaces), casting,
                       contact.rays.rule);
    };
    add_contact(question, columns, region.name + "_", answer.frames, totals, [&](const FrameContact& frame) {
      const ContactTotals of = totals(frame);
      return Wrench{of.force_n, of.moment_nmm};
    });
  }
  return curves;
}

Curves curves_of(const MotionQuestion& question, const MotionAnswer& answer) {
  const auto& frames = answer.frames;
  Curves curves;
  curves.axis = question.motion.times.in_seconds ? "time_s" : "frame";
  curves.at = question.motion.times.values;
  Columns columns(curves, frames.size());
  add_contact(
      question, columns, "", frames, [](const FrameContact& frame) { return frame.surface.totals; },
      [&](const FrameContact& frame) { return load_of(question.contact, frame); });
  columns.add("in_contact", frames, [](const auto& f) { return f.in_contact ? 1.0 : 0.0; });
  columns.add("intersecting_pairs", frames,
              [](const auto& f) { return static_cast<double>(f.intersecting_pairs); });
  columns.add("smallest_gap_mm", frames, [](const auto& f) { return f.smallest_gap_mm; });
  const Joint& joint = question.joint.joint;
  const auto coordinates = [&](const FrameContact& f) {
    return coordinates_at(joint.coordinates(), f.X_FM, joint.translation_frame);
  };
  for (const JointAngle angle : all_joint_angles) {
    columns.add(std::string(name_of(angle, joint.anatomy)) + "_deg", frames, [&](const auto& f) {
      const JointAngles at = coordinates(f).angles;
      return angle_of(at, angle).degrees();
    });
    if (joint.kind == JointKind::hinge) break;
  }
  if (joint.kind == JointKind::free) {
    for (int axis = 0; axis < 3; ++axis)
      columns.add(std::string(1, static_cast<char>('x' + axis)) + "_mm", frames,
                  [&](const auto& f) { return coordinates(f).translation_mm[axis]; });
  }
  if (!answer.balanced.empty()) {
    curves.names.push_back("balanced");
    auto& column = curves.values.emplace_back(frames.size(), nothing);
    for (std::size_t i = 0; i < frames.size(); ++i)
      if (answer.balanced[i]) column[i] = answer.balanced[i]->outcome == BalanceOutcome::balanced ? 1 : 0;
  }
  return curves;
}

}  // namespace condyle
