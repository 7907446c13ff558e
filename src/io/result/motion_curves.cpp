#include <algorithm>
#include <array>
#include <limits>

#include "condyle/io/pose_text.hpp"
#include "io/joint/coordinate_name.hpp"
#include "io/result/coordinate_at.hpp"
#include "io/result/motion_result.hpp"

namespace condyle::io {
namespace {

constexpr double nothing = std::numeric_limits<double>::quiet_NaN();

/// Curves by name, filled frame by frame.
class CurveColumns {
 public:
  CurveColumns(Curves& curves, std::size_t frames) : curves_(curves), frames_(frames) {}

  /// value(frame) of each frame that has one.
  template <class Frame, class Value>
  void add(const std::string& name, const std::vector<std::optional<Frame>>& frames, const Value& value) {
    curves_.names.push_back(name);
    auto& column = curves_.values.emplace_back(frames_, nothing);
    for (std::size_t i = 0; i < frames_; ++i)
      if (frames[i]) column[i] = value(*frames[i]) + 0.0;  // without the sign of 0
  }
  template <class Frame, class Value>
  void add_vector(const std::string& name, const std::string& unit,
                  const std::vector<std::optional<Frame>>& frames, const Value& value) {
    constexpr std::array axes = {"_x", "_y", "_z"};
    for (int axis = 0; axis < 3; ++axis)
      add(name + axes[static_cast<std::size_t>(axis)] + unit, frames,
          [&](const Frame& frame) { return value(frame)[axis]; });
  }
  void add_wrench(const std::string& of, const std::string& in,
                  const std::vector<std::optional<contact::Wrench>>& frames) {
    add_vector(of + "force" + in, "_n", frames, [](const contact::Wrench& w) { return w.force_n; });
    add_vector(of + "moment" + in, "_nmm", frames, [](const contact::Wrench& w) { return w.moment_nmm; });
  }

 private:
  Curves& curves_;
  std::size_t frames_;
};

/// The body that the forces of an answer act on, in whose joint frame they are, as in names of columns: "_in_mobile".
std::string frame_word(const ContactEntry& contact) {
  return contact.casting == contact::Casting::fixed ? "_in_fixed" : "_in_mobile";
}

/// A wrench on the mobile body in F, its moment about the origin of M, as one on that body, in its frame, about its origin.
contact::Wrench on_body_of_forces(const ContactEntry& contact, const Pose& X_FM, const contact::Wrench& of) {
  if (contact.casting == contact::Casting::fixed)
    return {-of.force_n, -of.moment_nmm - X_FM.translation().cross(of.force_n)};
  const Eigen::Matrix3d R_MF = X_FM.linear().transpose();
  return {R_MF * of.force_n, R_MF * of.moment_nmm};
}

/// With both castings, the mean load on the mobile body; with one, the load on the casting body.
contact::Wrench load_of(const ContactEntry& contact, const motion::FrameContact& frame) {
  if (contact.casting != contact::Casting::both)
    return {frame.surface.totals.force_n, frame.surface.totals.moment_nmm};
  return on_body_of_forces(contact, frame.X_FM, frame.on_mobile);
}

/// A frame's totals, of all faces or of a region's, and the load that goes with them.
struct FrameTotals {
  contact::ContactTotals totals;
  contact::Wrench load;
};

/// Adds their values, under names that begin with `prefix`.
void add_contact(const MotionQuestion& question, CurveColumns& columns, const std::string& prefix,
                 const std::vector<std::optional<FrameTotals>>& frames) {
  const auto add = [&](const char* name, double contact::ContactTotals::*value) {
    columns.add(prefix + name, frames, [&](const FrameTotals& f) { return f.totals.*value; });
  };
  const auto add_centre = [&](const char* name, std::optional<Vec3> contact::ContactTotals::*centre) {
    columns.add_vector(prefix + name, "_mm", frames, [&](const FrameTotals& f) {
      return (f.totals.*centre).value_or(Vec3::Constant(nothing));
    });
  };
  add("area_mm2", &contact::ContactTotals::area_mm2);
  add("mean_depth_mm", &contact::ContactTotals::mean_depth_mm);
  add("max_depth_mm", &contact::ContactTotals::max_depth_mm);
  add_centre("centre_of_depth", &contact::ContactTotals::centre_of_depth);
  if (!question.with_pressure) return;
  add("mean_pressure_mpa", &contact::ContactTotals::mean_pressure_mpa);
  add("max_pressure_mpa", &contact::ContactTotals::max_pressure_mpa);
  add_centre("centre_of_pressure", &contact::ContactTotals::centre_of_pressure);
  const double sign = question.contact.moment_on == MomentOn::casting ? 1 : -1;
  const std::string in = frame_word(question.contact);
  columns.add_vector(prefix + "force" + in, "_n", frames,
                     [](const FrameTotals& f) { return f.load.force_n; });
  columns.add_vector(prefix + "moment" + in, "_nmm", frames,
                     [&](const FrameTotals& f) { return Vec3(sign * f.load.moment_nmm); });
}

/// totals_of(frame) of each frame that has an answer.
template <class TotalsOf>
std::vector<std::optional<FrameTotals>> totals_of_frames(const MotionAnswer& answer,
                                                         const TotalsOf& totals_of) {
  std::vector<std::optional<FrameTotals>> totals(answer.frames.size());
  for (std::size_t i = 0; i < totals.size(); ++i)
    if (answer.frames[i]) totals[i] = totals_of(*answer.frames[i]);
  return totals;
}

}  // namespace

Curves region_curves_of(const MotionQuestion& question, const MotionAnswer& answer) {
  Curves curves;
  curves.axis = question.motion.times.in_seconds ? "time_s" : "frame";
  curves.at = question.motion.times.values;
  CurveColumns columns(curves, answer.frames.size());
  const ContactEntry& contact = question.contact;
  const Mesh& casting = contact.casting == contact::Casting::fixed ? question.surfaces.fixed.mesh
                                                                   : question.surfaces.mobile.mesh;
  for (const RegionEntry& region : contact.regions) {
    const auto totals = totals_of_frames(answer, [&](const motion::FrameContact& frame) {
      const contact::ContactTotals of_region =
          totals_of(contact::faces_within(frame.surface.faces, casting, region.half_spaces), casting,
                    contact.rays.rule);
      return FrameTotals{of_region, {of_region.force_n, of_region.moment_nmm}};
    });
    add_contact(question, columns, region.name + "_", totals);
    if (!question.with_pressure) continue;
    std::vector<std::optional<double>> shares(totals.size());
    for (std::size_t i = 0; i < totals.size(); ++i)
      if (totals[i]) {
        const Vec3& whole_n = answer.frames[i]->surface.totals.force_n;
        shares[i] = 100 * totals[i]->load.force_n.dot(whole_n) / whole_n.squaredNorm();
      }
    columns.add(region.name + "_share_percent", shares, [](double share) { return share; });
  }
  return curves;
}

Curves curves_of(const MotionQuestion& question, const MotionAnswer& answer) {
  const auto& frames = answer.frames;
  Curves curves;
  curves.axis = question.motion.times.in_seconds ? "time_s" : "frame";
  curves.at = question.motion.times.values;
  CurveColumns columns(curves, frames.size());
  add_contact(question, columns, "", totals_of_frames(answer, [&](const motion::FrameContact& frame) {
                return FrameTotals{frame.surface.totals, load_of(question.contact, frame)};
              }));
  columns.add("in_contact", frames, [](const auto& f) { return f.in_contact ? 1.0 : 0.0; });
  columns.add("intersecting_pairs", frames,
              [](const auto& f) { return static_cast<double>(f.intersecting_pairs); });
  columns.add("smallest_gap_mm", frames, [](const auto& f) { return f.smallest_gap_mm; });
  if (!answer.standings.empty()) {
    columns.add("state", answer.standings,
                [](const PoseStanding& at) { return static_cast<double>(at.state); });
    columns.add("clearance_mm", answer.standings, [](const PoseStanding& at) { return at.clearance_mm; });
    if (question.to_limits)
      columns.add("to_limit_deg", answer.standings, [](const PoseStanding& at) { return at.to_limit_deg(); });
  }
  if (!answer.screws.empty()) {
    const auto& steps = answer.screws;
    const contact::AxisLine none{Vec3::Constant(nothing), Vec3::Constant(nothing)};
    columns.add("screw_rotation_deg", steps, [](const auto& of) { return of.rotation.degrees(); });
    columns.add("screw_is_slide", steps, [](const auto& of) { return of.is_slide() ? 1.0 : 0.0; });
    columns.add_vector("screw_axis", "", steps,
                       [&](const auto& of) { return of.axis.value_or(none).direction; });
    columns.add_vector("screw_point", "_mm", steps,
                       [&](const auto& of) { return of.axis.value_or(none).point; });
    columns.add("screw_depth_deg", steps,
                [](const auto& of) { return of.depth ? of.depth->degrees() : nothing; });
    columns.add("screw_depth_mm", steps, [](const auto& of) { return of.depth_mm.value_or(nothing); });
  }
  columns.add("oblique_area_mm2", frames, [](const auto& f) { return f.surface.oblique_area_mm2; });
  const Joint& joint = question.joint.joint;
  const std::vector<CoordinateName> coordinates = io::coordinate_names_of(joint.kind, joint.anatomy);
  for (std::size_t i = 0; i < coordinates.size(); ++i)
    columns.add(coordinates[i].name + (coordinates[i].kind == CoordinateKind::angle ? "_deg" : "_mm"), frames,
                [&](const motion::FrameContact& f) { return io::coordinate_at(joint, f.X_FM, i); });
  if (!answer.balanced.empty()) {
    columns.add("balanced", answer.balanced, [](const contact::BalancedPose& pose) {
      return pose.outcome == contact::BalanceOutcome::balanced ? 1.0 : 0.0;
    });
    columns.add("residual_n", answer.balanced,
                [](const contact::BalancedPose& pose) { return pose.residual.force_n.norm(); });
    std::vector<std::optional<contact::Wrench>> loads(frames.size());
    for (std::size_t i = 0; i < frames.size(); ++i)
      if (frames[i] && answer.loads[i])
        loads[i] = on_body_of_forces(question.contact, frames[i]->X_FM, *answer.loads[i]);
    columns.add_wrench("load_", frame_word(question.contact), loads);
  }
  return curves;
}

Curves ligament_curves_of(const MotionQuestion& question, const MotionAnswer& answer, LigamentNames names) {
  const bool as_here = names == LigamentNames::ours;
  Curves curves;
  curves.axis = !as_here ? "time" : question.motion.times.in_seconds ? "time_s" : "frame";
  curves.at = question.motion.times.values;
  CurveColumns columns(curves, answer.frames.size());
  for (const LigamentAlong& ligament : answer.ligaments) {
    std::string name = ligament.name;
    if (!as_here) std::replace(name.begin(), name.end(), ' ', '_');
    columns.add(name + (as_here ? "_length_mm" : ".length"), ligament.frames,
                [&](const LigamentState& at) { return as_here ? at.length_mm : at.length_mm / 1000; });
    columns.add(name + (as_here ? "_strain" : ".strain"), ligament.frames,
                [](const LigamentState& at) { return at.strain; });
    columns.add(name + (as_here ? "_tension_n" : ".force_spring"), ligament.frames,
                [](const LigamentState& at) { return at.tension_n; });
    if (ligament.damping.empty()) continue;
    columns.add(name + (as_here ? "_lengthening_mm_s" : ".lengthening_speed"), ligament.damping,
                [&](const LigamentDamping& at) {
                  return as_here ? at.lengthening_mm_s : at.lengthening_mm_s / 1000;
                });
    columns.add(name + (as_here ? "_damping_n" : ".force_damping"), ligament.damping,
                [](const LigamentDamping& at) { return at.damping_n; });
    columns.add(name + (as_here ? "_total_n" : ".force_total"), ligament.damping,
                [](const LigamentDamping& at) { return at.total_n; });
  }
  if (!as_here) return curves;
  // The sum over all ligaments exists in frames in which each has a length.
  std::vector<std::optional<contact::Wrench>> sums(answer.frames.size());
  for (std::size_t i = 0; i < sums.size(); ++i) {
    contact::Wrench& sum = sums[i].emplace();
    for (const LigamentAlong& ligament : answer.ligaments) {
      if (!ligament.frames[i]) {
        sums[i].reset();
        break;
      }
      sum.force_n += ligament.frames[i]->force_n;
      sum.moment_nmm += ligament.frames[i]->moment_nmm;
    }
    if (!answer.frames[i]) sums[i].reset();
    if (!sums[i]) continue;
    const Pose& X_FM = answer.frames[i]->X_FM;
    sum.moment_nmm -= X_FM.translation().cross(sum.force_n);
    sum = on_body_of_forces(question.contact, X_FM, sum);
  }
  columns.add_wrench("ligaments_", frame_word(question.contact), sums);
  return curves;
}

}  // namespace condyle::io
