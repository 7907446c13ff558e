#pragma once

#include <optional>
#include <vector>

#include "motion/rom/overlap.hpp"
#include "motion/search/first_contact.hpp"
#include "plan/sweep.hpp"

namespace condyle::plan {

/// Exact contacts of a bone that is cut again and again with another that stays, along one motion.
class ExactReach {
 public:
  /// `other`: what of the other body ends motions.
  ExactReach(const Joint& joint, BodyRole cut, const Mesh& other, const motion::Motion& motion);

  /// Every obstructing feature of the cut bone, with a point of it, in the bone's own frame; none if the motion goes as far as
  /// `reach`. Of bodies that are in contact at the start one feature, or empty if no surfaces meet there: one is inside the other.
  std::optional<std::vector<motion::FeatureContact>> obstructions(const motion::FeatureTree& cut,
                                                                  Angle reach) const;

 private:
  motion::FeatureTree tree_;
  RotatingBone rotating_;
  motion::RotationTable table_;
};

}  // namespace condyle::plan
