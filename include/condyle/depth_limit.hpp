#pragma once

#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "condyle/range_of_motion.hpp"

/// Limits of joints whose meshes overlap a little in every pose: a motion ends if the deepest radial depth exceeds an
/// allowed one. For such joints only; if the meshes are clean, RangeOfMotion is exact.

namespace condyle {

struct AllowedDepth {
  double depth_mm = 0;
  Angle step = Angle::degrees(1);          ///< of the search along the motion
  Angle tolerance = Angle::degrees(1e-3);  ///< of the limit, once bracketed
};

/// The deepest place of two bodies at one pose.
struct DeepestPlace {
  double depth_mm = 0;                         ///< 0 if no vertex is inside
  std::optional<ContactWitness> contact = {};  ///< that vertex, and the face that its ray leaves through
  Angle ray_to_normal = {};                    ///< at that face; beyond 60 degrees the radial depth grazes
};

struct DepthLimit {
  MotionLimit limit = {};      ///< its error bound is here the tolerance of the search
  DeepestPlace at_limit = {};  ///< at the reported angle, where the depth is still allowed
  double start_depth_mm = 0;
  /// Whether every pose tried inside the last step was as deep as the allowed ones before it: if not, the surfaces
  /// are rough at this scale and a limit a little further on would be as good.
  bool depth_grows = true;
};

/// Depth is the radial depth (docs/mathematics/02-radial-method.md) of the deepest vertex of either body in the
/// other, whatever the angle between its ray and the surface. For surfaces that slide on each other, that is the
/// depth. Where a neck runs into a rim the ray grazes the wall and the radial depth is many times the true one, so
/// there a motion ends almost as soon as a vertex is inside: the allowed depth applies to bearing surfaces.
///
/// Not exact, unlike RangeOfMotion: depth is computed at poses one step apart, and only of vertices. Contact that
/// comes and goes between two poses of the search, or of edges and faces without a vertex, is not seen. The first
/// step whose end is too deep is divided into ten parts, and the first too deep part is halved until the tolerance:
/// the reported angle is allowed, and within the tolerance after it the depth is too large.
class DepthRange {
 public:
  /// Throws UsageError for an allowed depth below 0, steps or tolerances that are not above 0, a tolerance
  /// above the step; MeshError if a mesh is open, for depth needs an inside.
  DepthRange(const Joint& joint, const AllowedDepth& allowed);
  ~DepthRange();
  DepthRange(const DepthRange&) = delete;
  DepthRange& operator=(const DepthRange&) = delete;

  DeepestPlace deepest(const JointAngles& at) const;
  /// `contact_at_start` if the depth at the start is too large already.
  DepthLimit limit(const Motion& motion) const;
  std::vector<DepthLimit> limits(std::span<const Motion> motions) const;

  /// The bearing surface that labels contacts: all of them count.
  const BearingFinding& bearing() const noexcept;

 private:
  struct Parts;
  std::unique_ptr<Parts> parts_;
};

}  // namespace condyle
