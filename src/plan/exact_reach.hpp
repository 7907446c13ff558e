#pragma once

#include <vector>

#include "motion/rom/overlap.hpp"
#include "motion/search/first_contact.hpp"
#include "plan/sweep.hpp"

namespace condyle::plan {

/// Exact first contact of a bone that is cut again and again with another that stays, along one motion.
class ExactReach {
 public:
  /// `other`: what of the other body ends motions.
  ExactReach(const Joint& joint, BodyRole cut, const Mesh& other, const Motion& motion);

  /// How far the motion goes, `reach` at most. In its witness the features are those of the meshes given: fixed the other's,
  /// mobile the cut bone's.
  Limit limit(const Mesh& cut, Angle reach) const;

 private:
  motion::FeatureTree tree_;
  TurningBone turning_;
  motion::RotationTable table_;
};

}  // namespace condyle::plan
