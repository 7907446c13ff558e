#include "motion/recorded/screw_contacts.hpp"

#include <algorithm>
#include <utility>

#include "condyle/contact.hpp"
#include "motion/recorded/lasting_contact.hpp"

namespace condyle::motion {
namespace {

/// Rounding of fractions of the way; what is known of them is shortened by it.
constexpr double fraction_slack = 1e-12;

/// State at one pose: contact or not, and for how much of the segment on either side.
struct Known {
  bool in_contact;
  double lasts_for;
  std::optional<ContactWitness> contact = {};
};

class ScrewSearch {
 public:
  ScrewSearch(const PosedBodies& bodies, const ScrewMotion& motion, double resolution)
      : bodies_(bodies), motion_(motion), resolution_(resolution) {}

  ScrewContacts run() {
    decide(0, 1);
    return std::move(found_);
  }

 private:
  /// Adds what is between two fractions of the way, in ascending order. Each rest is at most half as long, so this
  /// goes as deep as the resolution has binary digits.
  void decide(double from, double to) {
    const bool is_short = to - from < resolution_;
    const double middle = from + (to - from) / 2;
    Known known = at(middle);
    const double lasts_for = std::max(0.0, known.lasts_for - fraction_slack);
    const bool to_ends = lasts_for >= (to - from) / 2;
    // The middle decides a short remainder, or nothing does.
    if (is_short && !to_ends && !known.in_contact) return add_undecided(from, to);
    const double low = to_ends ? from : middle - lasts_for, high = to_ends ? to : middle + lasts_for;
    const auto rest = [&](double first, double last) {
      if (to_ends) return;
      is_short ? add_undecided(first, last) : decide(first, last);
    };
    rest(from, low);
    if (known.in_contact) add_contact(low, high, std::move(known.contact));
    rest(high, to);
  }

  void add_undecided(double from, double to) {
    ContactPart& part = part_from(from);
    part.undecided += to - from, part.exit = to;
  }

  void add_contact(double from, double to, std::optional<ContactWitness> contact) {
    ContactPart& part = part_from(from);
    if (!part.proven) part.proven = ContactPart::Proven{from, to}, part.at_entry = contact;
    part.proven->last = part.exit = to;
    part.at_exit = std::move(contact);
  }

  Known at(double s) {
    ++found_.poses;
    const Pose X_FM = motion_.at(s);
    const Speed& speed = motion_.speed();
    if (bodies_.contact.in_contact(X_FM)) {
      if (const auto pairs = bodies_.contact.pairs(X_FM); !pairs.empty()) {
        const LastingContact lasting =
            lasting_contact(bodies_.contact.fixed(), bodies_.contact.mobile(), X_FM, pairs, speed);
        return {true, lasting.lasts_for, lasting.witness};
      }
      return {true, apart_for(X_FM)};
    }
    return {false, apart_for(X_FM)};
  }

  /// As long as the surfaces do not meet, a body inside the other stays there, and one outside too.
  double apart_for(const Pose& X_FM) const {
    const auto nearest = clearance(bodies_.fixed, bodies_.mobile, X_FM, whole_segment, motion_.speed());
    return nearest ? nearest->free_for : whole_segment;
  }

  /// The last interval if it reaches to here or nearly so, else a new one. A part that is free for less than the
  /// resolution counts as undecided: near a contact it alternates with undecided parts.
  ContactPart& part_from(double from) {
    auto& contacts = found_.contacts;
    if (contacts.empty() || from - contacts.back().exit >= resolution_) {
      contacts.emplace_back().entry = from;
      contacts.back().exit = from;
    } else {
      contacts.back().undecided += from - contacts.back().exit;
    }
    return contacts.back();
  }

  static constexpr double whole_segment = 1;

  const PosedBodies& bodies_;
  const ScrewMotion& motion_;
  double resolution_;
  ScrewContacts found_;
};

}  // namespace

ScrewContacts screw_contacts(const PosedBodies& bodies, const ScrewMotion& motion, double resolution) {
  return ScrewSearch(bodies, motion, resolution).run();
}

}  // namespace condyle::motion
