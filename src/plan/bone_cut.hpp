#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "condyle/resection.hpp"
#include "plan/cut_for.hpp"
#include "plan/cut_surface.hpp"
#include "plan/exact_reach.hpp"
#include "plan/sweep.hpp"

namespace condyle::plan {

/// A target as one bone's cut sees it.
struct CutTarget {
  std::size_t number;  ///< in the request
  motion::Motion motion;
  Angle reach;
  Angle now;  ///< where it ends as the joint is
};

/// Where kept bone stops a target.
struct StoppedAt {
  Angle reach;  ///< as far as the motion can be planned
  Blocked by;
};

/// Whether contact of a triangle may end a motion: not that of soft meshes, nor, if bearing contact does not count, of meshes of the mobile
/// body that are named bearing.
struct Included {
  bool leaves_out_bearing;

  bool operator()(const Body& body, std::size_t triangle) const;
};

/// One bone, cut for some targets.
class BoneCut {
 public:
  /// The targets must be free at their start. Of the depths that they take `share` is cut. Throws MeshError if the other body is not
  /// closed.
  BoneCut(const Joint& joint, BodyRole cut, const ResectionOptions& request, std::vector<CutTarget> targets,
          double share);

  /// The joint with this bone as it is cut now.
  Joint joint() const;
  CutBone cut_bone(CutFacts facts) const;
  bool removes_any() const;
  /// Whether a target is reached that was not, though nothing goes: fewer of the smaller triangles lie partly in the bearing ball.
  bool reaches_by_smaller_triangles() const;
  /// Whether the other bone sweeps over bearing surface of this one.
  bool sweeps_bearing() const;
  /// As far as each target goes; in the order of the targets.
  const std::vector<Angle>& reach() const noexcept { return reach_; }
  const std::vector<std::optional<StoppedAt>>& stopped() const noexcept { return stopped_; }

 private:
  Included included(BodyRole role) const;
  std::vector<SweepTo> sweeps_to_reach() const;
  std::vector<std::uint8_t> to_cut(const TriMesh& pieces, const std::vector<Index>& before,
                                   const std::vector<std::uint8_t>& asked) const;
  std::vector<std::optional<KeptBy>> kept_vertices(const Body& body) const;
  const KeptBone& kept() const;
  void refine();
  bool refine_to_edge();
  void want_too(const std::vector<Place>& places);
  struct Failure {
    std::string why;
    bool folds = false;
  };
  void cut();
  std::optional<Failure> cut_at_edge();
  bool cut_with_shorter_edges();
  std::size_t turned(const TriMesh& mesh) const;
  void refuse_many_folds() const;
  std::string fault() const;
  std::string asked(std::size_t target) const;
  bool lower_for_reach();
  std::vector<Met> what_meets(const std::vector<Index>& triangles) const;
  bool may_all_go(const std::vector<Met>& met);
  bool correct();
  bool finish();
  void refuse_too_deep(const std::vector<Obstruction>& left) const;
  bool stop(std::size_t target, Angle at, KeptBy by, const Vec3& point);

  const Joint& joint_;
  BodyRole role_;
  const Body& bone_;
  const ResectionOptions& request_;
  std::vector<CutTarget> targets_;
  double share_;
  std::optional<motion::BearingSurface> bearing_;
  std::optional<BearingBall> ball_;
  std::vector<std::unique_ptr<Sweep>> sweeps_;
  std::vector<std::unique_ptr<ExactReach>> exact_;
  std::vector<Angle> reach_;
  std::vector<std::optional<StoppedAt>> stopped_;
  std::vector<Place> met_;              ///< where bone has to go that no search for it found
  std::vector<Index> triangle_before_;  ///< of the refined triangles
  double edge_mm_;                      ///< as requested, or larger or smaller
  EdgeReason edge_reason_ = EdgeReason::requested;
  static constexpr double first_smoothing_mm = 3;
  double smoothing_mm_ = first_smoothing_mm;
  std::optional<CutSurface> surface_;
  double before_burr_mm3_ = 0;  ///< what goes for the targets alone
  double burr_in_kept_mm_ = 0;
};

}  // namespace condyle::plan
