#include "plan/exact_reach.hpp"

namespace condyle::plan {

ExactReach::ExactReach(const Joint& joint, BodyRole cut, const Mesh& other, const Motion& motion)
    : tree_(other), turning_(joint, cut, motion), table_(tree_, turning_.axis) {}

Limit ExactReach::limit(const Mesh& cut, Angle reach) const {
  const motion::FeatureTree tree(cut);
  motion::RotatingBody turning(tree);
  turning.start_at(turning_.axis, turning_.at_start);
  const bool forwards = turning_.sense > 0;
  const RotationLimits both = motion::first_contact(
      table_, turning, forwards ? RotationRange{Angle(), reach} : RotationRange{-reach, Angle()});
  return forwards ? both.positive : both.negative;
}

}  // namespace condyle::plan
