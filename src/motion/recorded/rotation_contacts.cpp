#include "motion/recorded/rotation_contacts.hpp"

#include <algorithm>
#include <cassert>
#include <utility>

#include "core/predicates.hpp"
#include "motion/search/contact_set.hpp"
#include "motion/search/first_contact.hpp"

namespace condyle::motion {
namespace {

/// Narrower ones may be what rounding leaves between two contacts, and are none.
constexpr double narrowest_gap = 1e-9;

/// Error of ends that only the contact set gives: twice the largest error of an event.
constexpr double contact_set_error = 2 * worst_event_error;

/// A gap is given by start and width, in radians below 4: its end is off by two roundings at most.
constexpr double gap_rounding = 4 * 2 * core::rounding_unit;

/// One end of a free gap; without contact where the sample is free.
struct GapEnd {
  double angle;
  bool in_contact;
  double error;
  std::optional<ContactWitness> contact = {};
};

struct FreeGap {
  GapEnd low, high;
};

/// Bodies of a rotation, the mobile one at any angle of it.
class Rotation {
 public:
  Rotation(RotatingBody& fixed, RotatingBody& mobile, const ScrewMotion& motion)
      : fixed_(fixed), mobile_(mobile), motion_(motion), axis_(Vec3::Zero(), motion.axis()) {
    Pose X_MF = Pose::Identity();
    X_MF.translation() = -motion.at(0).translation();
    fixed_.start_at(axis_, X_MF);
  }

  double whole() const noexcept { return motion_.rotation().radians(); }

  RotationLimits limits_from(double angle, double low, double high) {
    start_at(angle);
    return first_contact(fixed_, mobile_, {Angle::radians(low - angle), Angle::radians(high - angle)});
  }

  /// Where the surfaces do not meet, as far as is not known.
  std::vector<core::Arc> gaps(const std::vector<core::Arc>& known) {
    start_at(0);
    return contact_set(fixed_, mobile_, core::ArcSet(known)).complement().arcs();
  }

 private:
  void start_at(double angle) {
    Pose turned = Pose::Identity();
    turned.linear() = motion_.at(angle / whole()).linear();
    mobile_.start_at(axis_, turned);
  }

  RotatingBody &fixed_, &mobile_;
  const ScrewMotion& motion_;
  AxisFrame axis_;
};

GapEnd gap_end(double angle, Limit limit) {
  return {angle, limit.reason == LimitReason::contact, limit.error_bound.radians(), std::move(limit.contact)};
}

/// The gap of the contact set from low to high; empty if one body is inside the other there. The search goes a
/// little past the gap, since its angles are of poses rounded anew; what it does not find there the set has found.
std::optional<FreeGap> free_gap(Rotation& rotation, double low, double high) {
  const double whole = rotation.whole(), middle = (low + high) / 2;
  RotationLimits both =
      rotation.limits_from(middle, std::max(0.0, low - narrowest_gap), std::min(whole, high + narrowest_gap));
  if (!both.free_at_start()) return std::nullopt;
  FreeGap gap{gap_end(std::max(0.0, middle - both.negative.turned.radians()), std::move(both.negative)),
              gap_end(std::min(whole, middle + both.positive.turned.radians()), std::move(both.positive))};
  if (!gap.low.in_contact && low > 0) gap.low = {low, true, contact_set_error};
  if (!gap.high.in_contact && high < whole - gap_rounding) gap.high = {high, true, contact_set_error};
  return gap;
}

std::vector<FreeGap> free_gaps(Rotation& rotation) {
  const double whole = rotation.whole();
  std::vector<FreeGap> free;
  std::vector<core::Arc> known{{Angle::radians(whole), Angle::radians(two_pi - whole)}};
  // Most segments are free: one search decides.
  if (RotationLimits start = rotation.limits_from(0, 0, whole); start.free_at_start()) {
    const Angle first = start.positive.turned;
    free.push_back({{0, false, 0}, gap_end(std::min(whole, first.radians()), std::move(start.positive))});
    if (!free.back().high.in_contact) return free;
    known.push_back({Angle(), first});
  }
  for (const core::Arc& arc : rotation.gaps(known)) {
    const double low = arc.start.radians(), high = std::min(whole, low + arc.width.radians());
    if (!(high - low > narrowest_gap)) continue;
    if (auto gap = free_gap(rotation, low, high)) free.push_back(std::move(*gap));
  }
  return free;
}

}  // namespace

ContactParts rotation_contacts(RotatingBody& fixed, RotatingBody& mobile, const ScrewMotion& motion) {
  assert(motion.holds_origin() && motion.rotation() > Angle());
  Rotation rotation(fixed, mobile, motion);
  const double whole = rotation.whole();
  const std::vector<FreeGap> free = free_gaps(rotation);
  ContactParts contacts;
  // Between the gap before and the one behind; at the ends of the way between a sample and a gap.
  const auto add = [&](const GapEnd& from, const GapEnd& to) {
    const double entry = from.angle, exit = std::max(from.angle, to.angle);
    const ContactPart::Proven proven{std::min(entry + from.error, exit), std::max(exit - to.error, entry)};
    contacts.push_back({entry / whole, exit / whole,
                        ContactPart::Proven{proven.first / whole, proven.last / whole}, 0, from.contact,
                        to.contact});
  };
  const GapEnd first_sample{0, true, 0}, last_sample{whole, true, 0};
  const GapEnd* from = &first_sample;
  for (const FreeGap& gap : free) {
    if (gap.low.in_contact) add(*from, gap.low);
    from = &gap.high;
  }
  if (from->in_contact) add(*from, last_sample);
  return contacts;
}

}  // namespace condyle::motion
