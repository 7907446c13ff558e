#include "plan/exact_reach.hpp"

namespace condyle::plan {

ExactReach::ExactReach(const Joint& joint, BodyRole cut, const Mesh& other, const motion::Motion& motion)
    : tree_(other), rotating_(joint, cut, motion), table_(tree_, rotating_.axis) {}

std::optional<std::vector<motion::FeatureContact>> ExactReach::obstructions(const motion::FeatureTree& cut,
                                                                            Angle reach) const {
  using motion::FeatureContact;
  motion::RotatingBody rotating(cut);
  rotating.start_at(rotating_.axis, rotating_.at_start);
  const bool forwards = rotating_.sense > 0;
  const motion::RotationLimits both = motion::first_contact(
      table_, rotating,
      forwards ? motion::RotationRange{Angle(), reach} : motion::RotationRange{-reach, Angle()});
  const motion::Limit& first = forwards ? both.positive : both.negative;
  if (first.reason == motion::LimitReason::end_of_range) return std::vector<FeatureContact>();
  if (!first.contact) return std::nullopt;
  if (first.reason == motion::LimitReason::contact_at_start)
    return std::vector{
        FeatureContact{first.contact->mobile_feature, first.turned, first.contact->mobile_point}};
  return motion::feature_contacts(table_, rotating,
                                  forwards ? RotationSense::positive : RotationSense::negative, reach);
}

}  // namespace condyle::plan
