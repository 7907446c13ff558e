#include "plan/exact_reach.hpp"

namespace condyle::plan {

ExactReach::ExactReach(const Joint& joint, BodyRole cut, const Mesh& other, const Motion& motion)
    : tree_(other), turning_(joint, cut, motion), table_(tree_, turning_.axis) {}

std::optional<std::vector<motion::FeatureContact>> ExactReach::in_the_way(const motion::FeatureTree& cut,
                                                                          Angle reach) const {
  using motion::FeatureContact;
  motion::RotatingBody turning(cut);
  turning.start_at(turning_.axis, turning_.at_start);
  const bool forwards = turning_.sense > 0;
  const RotationLimits both = motion::first_contact(
      table_, turning, forwards ? RotationRange{Angle(), reach} : RotationRange{-reach, Angle()});
  const Limit& first = forwards ? both.positive : both.negative;
  if (first.reason == LimitReason::end_of_range) return std::vector<FeatureContact>();
  if (!first.contact) return std::nullopt;
  if (first.reason == LimitReason::contact_at_start)
    return std::vector{
        FeatureContact{first.contact->mobile_feature, first.turned, first.contact->mobile_point}};
  return motion::feature_contacts(table_, turning,
                                  forwards ? RotationSense::positive : RotationSense::negative, reach);
}

}  // namespace condyle::plan
