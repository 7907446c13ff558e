#pragma once

#include <optional>
#include <vector>

#include "condyle/bearing.hpp"
#include "condyle/joint.hpp"
#include "condyle/make_joint.hpp"
#include "condyle/range_of_motion.hpp"
#include "condyle/tangential.hpp"

/// The bone that a motion cannot do without losing: what the other bone sweeps over. docs/mathematics/12-resection.md.

namespace condyle::plan {

/// Around the bearing surface, in M: contact of what is within counts for nothing.
struct BearingBall {
  Vec3 centre;
  double radius_mm;

  explicit BearingBall(const motion::BearingSurface& surface)
      : centre(surface.head.centre), radius_mm(surface.head.radius + surface.margin_mm) {}

  bool holds(const Vec3& p) const noexcept { return (p - centre).norm() <= radius_mm; }
};

/// One motion as the bone that is cut sees it: the other bone rests, and the cut one turns about an axis in it.
struct RotatingBone {
  AxisFrame axis;  ///< in the other bone
  Pose at_start;   ///< of the cut bone in the other one
  double sense;    ///< of its turn about the axis: -1 or 1

  RotatingBone(const Joint& joint, BodyRole cut, const motion::Motion& motion);
};

/// Angles at which points of a bone are inside the other one while a motion goes on.
///
///       p -  -  .        The point runs on a circle through the other bone at rest: it is lost from the begin of the
///              +-.-+     first arc in it.
///       axis   | . |
///         o    |.  |
///
/// A ring table is built once; any points and any reach are asked of it. Exact but for rounding, as OccupiedArcs: no angle is
/// sampled.
class Sweep {
 public:
  /// The other bone must be closed. With a ball, bone of the mobile body within it counts for nothing, whichever body is cut.
  Sweep(const Joint& joint, BodyRole cut, const Mesh& other, const motion::Motion& motion,
        const std::optional<BearingBall>& ball);
  /// The same without the ball.
  Sweep including_all() const;

  /// For each point of the cut bone, in its frame: the angle from the motion's start, rad, at which it is first inside the other
  /// bone; infinity if that is beyond `reach`.
  std::vector<double> first_inside(PointsView points, Angle reach) const;

 private:
  double first_of(const Vec3& started, std::span<const tangential::OccupiedArc> arcs, double reach) const;

  BodyRole cut_;
  RotatingBone rotating_;
  tangential::RingTable rings_;
  std::optional<BearingBall> ball_;
};

}  // namespace condyle::plan
