#include "answer/living_limit.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <span>

#include "answer/limit_facts.hpp"
#include "condyle/joint_checks.hpp"
#include "core/formatted.hpp"
#include "core/trigonometry.hpp"

namespace condyle {
namespace {

constexpr JointAngle by_flexion = JointAngle::flexion, by_adduction = JointAngle::adduction,
                     by_rotation = JointAngle::internal_rotation;
constexpr RotationSense up = RotationSense::positive, down = RotationSense::negative;
constexpr double adult_years = 18;

// In full: docs/range-of-motion.md.
constexpr std::string_view cadavers = "hip BROM and FROM, a cadaver study", soucie = "Soucie 2011",
                           kouyoumdjian = "Kouyoumdjian 2012", athletic = "PMC6089031, table 1";

/// A motion that turns one angle from where the other two are 0, but for flexion, which is between two values: both included.
struct PureMotion {
  JointAngle vary;
  RotationSense sense;
  double flexion_from_deg = 0, flexion_to_deg = 0;

  [[nodiscard]] bool is(const motion::Motion& motion) const {
    constexpr double slip_deg = 1e-9;
    const double at_deg = angle_of(motion.start, by_flexion).degrees();
    return vary == motion.vary && sense == motion.sense && flexion_from_deg - slip_deg <= at_deg &&
           at_deg <= flexion_to_deg + slip_deg && angle_of(motion.start, by_adduction) == Angle{} &&
           angle_of(motion.start, by_rotation) == Angle{};
  }
};

struct GapRow {
  PureMotion motion;
  Closeness closeness;
  double mean_deg, sd_deg;
};
// The first row that fits is taken: the abstract has internal rotation "in deep (>70) flexion", external "at flexion>30" and "at extension>20".
constexpr std::array gaps{GapRow{{by_flexion, up}, Closeness::close, 3.1, 3.9},
                          GapRow{{by_flexion, down}, Closeness::weak, 51.9, 14.4},
                          GapRow{{by_adduction, down}, Closeness::weak, 18.6, 11.3},
                          GapRow{{by_rotation, up, 0, 70}, Closeness::weak, 37.1, 9.4},
                          GapRow{{by_rotation, up, 70, 180}, Closeness::close, 4.3, 4.6},
                          GapRow{{by_rotation, up, -90, 0}, Closeness::weak, 79.6, 4.8},
                          GapRow{{by_rotation, down, 0, 30}, Closeness::moderate, 10.3, 5.8},
                          GapRow{{by_rotation, down, 30, 180}, Closeness::weak, 45.9, 11.3},
                          GapRow{{by_rotation, down, -20, 0}, Closeness::moderate, 11.7, 7.2},
                          GapRow{{by_rotation, down, -90, -20}, Closeness::weak, 15.8, 4.8}};
constexpr int cadaver_hips = 9;

/// Whose hips were measured.
struct People {
  std::string_view who;
  double age_from, age_to;  ///< years; up to the next birthday
  std::optional<Sex> sex;
  bool if_age_is_unknown;
  std::optional<int> count;
  std::string_view source;
};
// Soucie's other ages were not at hand.
constexpr People girls{"girls of 2 to 8 years", 2, 9, Sex::female, false, {}, soucie};
constexpr People boys{"boys of 2 to 8 years", 2, 9, Sex::male, false, {}, soucie};
constexpr People children{"boys and girls of 2 to 8 years", 2, 9, {}, false, {}, soucie};
constexpr People lying{"adults of 20 to 60 years, supine and prone", 20, 61, {}, false, 120, kouyoumdjian};
constexpr People sitting{"adults of 20 to 60 years, sitting", 20, 61, {}, true, 120, kouyoumdjian};
constexpr People ten_groups{"ten groups of active adults", adult_years, 200, {}, true, 517, athletic};
constexpr People nine_groups{"nine groups of active adults", adult_years, 200, {}, true, 499, athletic};

struct PeopleRow {
  PureMotion motion;
  double low_deg, high_deg;
  const People* of;
};
// The first row that fits is taken.
constexpr std::array people_rows{
    PeopleRow{{by_flexion, up}, 140.8, 140.8, &girls}, PeopleRow{{by_flexion, up}, 131.1, 131.1, &boys},
    PeopleRow{{by_flexion, up}, 131.1, 140.8, &children}, PeopleRow{{by_flexion, down}, 26.2, 26.2, &girls},
    PeopleRow{{by_flexion, down}, 28.3, 28.3, &boys}, PeopleRow{{by_flexion, down}, 26.2, 28.3, &children},
    PeopleRow{{by_rotation, up}, 29.6, 35.2, &lying}, PeopleRow{{by_rotation, down}, 38.5, 41.8, &lying},
    PeopleRow{{by_rotation, up, 90, 90}, 37.9, 37.9, &sitting},
    // The abstract prints the sum of both, 78.5, in its place.
    PeopleRow{{by_rotation, down, 90, 90}, 40.6, 40.6, &sitting},
    PeopleRow{{by_rotation, up}, 29, 50.2, &ten_groups},
    PeopleRow{{by_rotation, down}, 23, 56.3, &nine_groups}};

bool are_like(const People& people, const Person& person) {
  return (person.age_years ? people.age_from <= *person.age_years && *person.age_years < people.age_to
                           : people.if_age_is_unknown) &&
         (!people.sex || people.sex == person.sex);
}

double sd_deg(std::span<const Angle> values) {
  const auto count = static_cast<double>(values.size());
  double mean = 0, squares = 0;
  for (const Angle value : values) mean += value.degrees() / count;
  for (const Angle value : values) squares += (value.degrees() - mean) * (value.degrees() - mean);
  return std::sqrt(squares / (count - 1));
}

}  // namespace

std::string_view name_of(Closeness closeness) noexcept {
  constexpr std::string_view names[] = {"close", "moderate", "weak"};
  return names[static_cast<std::size_t>(closeness)];
}

std::optional<LivingLimit> living_limit(const Joint& joint, const motion::MotionLimit& limit,
                                        const motion::LimitBand* band) {
  if (!joint.is_hip() || !joint.person.is_human() || joint.implant || !zero_pose(joint).is_neutral())
    return std::nullopt;
  LivingLimit living;
  const auto is_of = [&](const auto& row) { return row.motion.is(limit.motion); };
  if (const auto gap = std::find_if(gaps.begin(), gaps.end(), is_of); gap != gaps.end())
    living.gap = {gap->closeness, Angle::degrees(gap->mean_deg), Angle::degrees(gap->sd_deg), cadaver_hips,
                  cadavers};
  const bool is_grown = joint.person.age_years.value_or(adult_years) >= adult_years;
  const auto row = std::find_if(people_rows.begin(), people_rows.end(), [&](const PeopleRow& each) {
    return is_of(each) && are_like(*each.of, joint.person);
  });
  if (row != people_rows.end())
    living.people = {Angle::degrees(row->low_deg), Angle::degrees(row->high_deg), row->of->who,
                     row->of->count, row->of->source};
  else if (const auto clinical = normal_range(joint, limit); clinical && is_grown)
    living.people = {*clinical, *clinical, "clinical estimate", {}, normal_hip_range_source};
  if (!living.gap && !living.people) return std::nullopt;
  const bool may_expect = living.gap && living.gap->closeness == Closeness::close &&
                          limit.end.reason == motion::LimitReason::contact && limit.end.contact &&
                          limit.end.kind() == motion::ContactKind::impingement && is_grown &&
                          joint.planned.empty();
  if (may_expect && limit.end.turned > living.gap->mean) {
    living.expected = limit.end.turned - living.gap->mean;
    living.expected_sd = Angle::degrees(core::hypotenuse(
        living.gap->sd.degrees(), band && band->turned.size() > 1 ? sd_deg(band->turned) : 0));
  }
  return living;
}

std::optional<LivingLimit> living_limit(const RangeAnswer& answer, std::size_t i) {
  auto living =
      living_limit(answer.joint, answer.limits[i], answer.bands.empty() ? nullptr : &answer.bands[i]);
  if (living && !answer.depths.empty()) living->expected = living->expected_sd = std::nullopt;
  return living;
}

std::string text_of(const std::optional<LivingLimit>& living) {
  if (living && living->expected)
    return core::formatted("some %.0f (SD %.0f)", living->expected->degrees(),
                           living->expected_sd->degrees());
  if (!living || !living->people) return "-";
  const double low = living->people->low.degrees(), high = living->people->high.degrees();
  if (living->people->source == normal_hip_range_source) return core::formatted("clinical %.0f", low);
  return low == high ? core::formatted("mean %.0f", low)
                     : core::formatted("groups' means %.0f–%.0f", low, high);
}

}  // namespace condyle
