#include "condyle/motion_contact.hpp"

#include <algorithm>
#include <limits>
#include <mutex>
#include <string>

#include "condyle/error.hpp"
#include "core/parallel.hpp"
#include "core/per_thread.hpp"
#include "core/turned.hpp"
#include "mesh/surface_to_surface.hpp"
#include "motion/recorded/screw_motion.hpp"

namespace condyle::motion {
namespace {

/// Counts frames done and reports them, one thread at a time.
class ProgressCount {
 public:
  ProgressCount(const Control& control, std::string_view stage, std::size_t total)
      : control_(control), stage_(stage), total_(total) {}

  bool stopped() const { return control_.stop.stop_requested(); }
  void one_done() {
    if (!control_.progress) return;
    const std::lock_guard lock(mutex_);
    control_.progress(stage_, ++done_, total_);
  }

 private:
  const Control& control_;
  std::string_view stage_;
  std::size_t total_, done_ = 0;
  std::mutex mutex_;
};

template <class Answer>
auto named(std::size_t frame, const Answer& answer) {
  const auto with_frame = [&](const std::exception& error) {
    return "frame " + std::to_string(frame) + ": " + error.what();
  };
  try {
    return answer();
  } catch (const MeshError& error) {
    throw MeshError(with_frame(error));
  } catch (const UsageError& error) {
    throw UsageError(with_frame(error));
  }
}

/// Whether rays may be cut off by the reach: FrameContact::cut_off_by_reach.
bool may_cut_off(const FrameContact& frame, double max_depth_mm, double reach_mm, bool both_closed) {
  return max_depth_mm > 0 ? max_depth_mm > reach_mm / 2 : frame.in_contact || !both_closed;
}

void ask(const contact::ElasticContact& surfaces, BodyRole, FrameContact& frame) {
  contact::ElasticContactResults results = surfaces.at(frame.X_FM);
  double max_depth_mm = 0;
  for (const auto* surface : {&results.fixed, &results.mobile})
    if (*surface) max_depth_mm = std::max(max_depth_mm, (*surface)->totals.max_depth_mm);
  const bool closed = surfaces.fixed().is_closed() && surfaces.mobile().is_closed();
  if (may_cut_off(frame, max_depth_mm, surfaces.options().rays.reach_mm, closed))
    frame.cut_off_by_reach = surfaces.cut_off_by_reach(frame.X_FM);
  frame.surface = std::move(results.mobile ? *results.mobile : *results.fixed);
  frame.on_mobile = results.on_mobile;
}
void ask(const contact::NormalDepth& surfaces, BodyRole casting, FrameContact& frame) {
  const Pose X_CT = casting == BodyRole::fixed ? frame.X_FM : inverted(frame.X_FM);
  surfaces.at(X_CT, frame.surface);
  const bool closed = surfaces.casting().is_closed() && surfaces.target().is_closed();
  if (may_cut_off(frame, frame.surface.totals.max_depth_mm, surfaces.options().reach_mm, closed))
    frame.cut_off_by_reach = surfaces.cut_off_by_reach(X_CT);
}

/// The smallest gap, frame after frame: where the surfaces were nearest before they are near now.
class SmallestGap {
 public:
  SmallestGap(const mesh::TriangleTree& fixed, const mesh::TriangleTree& mobile)
      : fixed_(fixed), mobile_(mobile) {}

  std::optional<double> at(const Pose& X_FM) {
    double at_most = std::numeric_limits<double>::infinity();
    if (nearest_) {
      const double known = (nearest_->on_fixed - X_FM * nearest_->on_mobile).norm();
      // Distances and these points round by 1e-12 of the coordinates: a millionth is more, and adds little work.
      at_most = known + 1e-6 * (1 + nearest_->on_fixed.norm() + known);
    }
    const auto found = mesh::closest_points(fixed_, mobile_, X_FM, at_most);
    if (!found) return std::nullopt;
    nearest_ = {found->a_point, inverted(X_FM) * found->b_point};
    return found->distance_mm;
  }

 private:
  struct Points {
    Vec3 on_fixed, on_mobile;  ///< in F and in M
  };
  const mesh::TriangleTree &fixed_, &mobile_;
  std::optional<Points> nearest_;
};

/// Adds the depths of one body's vertices, which are given in the frame of the other one, `solid`; returns how many are inside it. The table
/// serves one frame: those that JointContact keeps are not lost for it.
std::size_t add_depths(ScrewStep& step, const Mesh& solid, const AxisFrame& axis, PointsView vertices) {
  if (!solid.is_closed()) return 0;
  const auto summary = contact::summarise(tangential::RingTable(solid, axis).query(vertices));
  if (summary.largest_angle) {
    step.depth = std::max(step.depth.value_or(Angle()), summary.largest_angle->depth);
    step.depth_mm = std::max(step.depth_mm.value_or(0), summary.deepest->depth_mm);
  }
  return summary.vertices_inside;
}

ScrewStep step_into(const FrameContact& frame, const Pose& before, const contact::JointContact& joint,
                    double reach_mm) {
  const ScrewMotion motion(before, frame.X_FM, reach_mm);
  ScrewStep step{.rotation = motion.rotation()};
  if (step.is_slide() || step.rotation > most_rotation) return step;
  const contact::AxisLine axis = step.axis.emplace(contact::AxisLine{motion.axis(), motion.point()});
  std::size_t inside = 0;
  if (frame.in_contact) {
    const Pose X_MF = inverted(frame.X_FM);
    inside += add_depths(step, joint.fixed(), {axis.point, axis.direction},
                         posed(frame.X_FM, joint.mobile().vertices()));
    inside += add_depths(step, joint.mobile(), {posed(X_MF, axis.point), core::turned(X_MF, axis.direction)},
                         posed(X_MF, joint.fixed().vertices()));
  }
  if (inside == 0) step.depth = Angle(), step.depth_mm = 0;
  return step;
}

}  // namespace

std::optional<std::vector<std::optional<FrameContact>>> contact_along(
    const contact::JointContact& joint, const SurfaceQuestion& surfaces,
    std::span<const std::optional<Pose>> X_FM, BodyRole casting, const Control& control) {
  const mesh::TriangleTree fixed(joint.fixed()), mobile(joint.mobile());
  std::vector<std::optional<FrameContact>> frames(X_FM.size());
  ProgressCount progress(control, "frames", frames.size());
  core::PerThread<SmallestGap> gaps([&] { return SmallestGap(fixed, mobile); });
  core::parallel_chunks(frames.size(), 1, [&](std::size_t first, std::size_t last) {
    SmallestGap& gap = gaps.local();
    for (std::size_t i = first; i < last && !progress.stopped(); ++i) {
      if (X_FM[i]) {
        FrameContact& frame = frames[i].emplace(FrameContact{.X_FM = *X_FM[i]});
        frame.intersecting_pairs = joint.pairs(frame.X_FM).size();
        frame.in_contact = frame.intersecting_pairs > 0 || joint.in_contact(frame.X_FM);
        if (frame.intersecting_pairs == 0)
          if (const auto smallest = gap.at(frame.X_FM)) frame.smallest_gap_mm = *smallest;
        named(i, [&] { std::visit([&](const auto* of) { ask(*of, casting, frame); }, surfaces); });
      }
      progress.one_done();
    }
  });
  if (progress.stopped()) return std::nullopt;
  return frames;
}

std::optional<std::vector<std::optional<ScrewStep>>> screws_along(
    const contact::JointContact& joint, std::span<const std::optional<FrameContact>> frames,
    const Control& control) {
  if (!joint.fixed().is_closed() && !joint.mobile().is_closed())
    throw UsageError("screws: arcs need an inside, and both surfaces are open");
  const double reach_mm = reach_of(joint.mobile());
  std::vector<std::optional<ScrewStep>> steps(frames.size());
  ProgressCount progress(control, "steps", frames.size());
  core::parallel_chunks(frames.size(), 1, [&](std::size_t first, std::size_t last) {
    for (std::size_t i = first; i < last && !progress.stopped(); ++i) {
      if (i > 0 && frames[i - 1] && frames[i])
        steps[i] = step_into(*frames[i], frames[i - 1]->X_FM, joint, reach_mm);
      progress.one_done();
    }
  });
  if (progress.stopped()) return std::nullopt;
  return steps;
}

std::optional<std::vector<std::optional<contact::BalancedPose>>> balance_along(
    const contact::ElasticContact& surfaces, std::span<const std::optional<Pose>> X_FM,
    std::span<const contact::Load> loads, const contact::BalanceOptions& how, const Control& control) {
  if (loads.size() != 1 && loads.size() != X_FM.size())
    throw UsageError(std::to_string(loads.size()) + " loads for " + std::to_string(X_FM.size()) + " frames");
  std::vector<std::optional<contact::BalancedPose>> frames(X_FM.size());
  ProgressCount progress(control, "balanced frames", frames.size());
  // How the load moved the body at the last frame, and how that changes from frame to frame where it does so smoothly.
  Vec3 moved = Vec3::Zero(), change = Vec3::Zero();
  bool was_balanced = false;
  for (std::size_t i = 0; i < frames.size(); ++i) {
    if (progress.stopped()) return std::nullopt;
    if (X_FM[i]) {
      Pose start = *X_FM[i];
      start.translation() += moved + change;
      frames[i] =
          named(i, [&] { return contact::balance(surfaces, start, loads[loads.size() == 1 ? 0 : i], how); });
    }
    const bool balanced = frames[i] && frames[i]->outcome == contact::BalanceOutcome::balanced;
    change.setZero();
    if (frames[i] && frames[i]->carries_load()) {
      const Vec3 here = frames[i]->X_FM.translation() - X_FM[i]->translation();
      if (balanced && was_balanced) change = here - moved;
      moved = here;
    }
    was_balanced = balanced;
    progress.one_done();
  }
  return frames;
}

}  // namespace condyle::motion
