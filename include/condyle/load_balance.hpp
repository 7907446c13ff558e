#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "condyle/make_joint.hpp"
#include "condyle/pressure.hpp"

/// The position in which the contact carries a load: docs/mathematics/07-contact-pressure.md.
///
///     const Load stance{.on_mobile = {.force_n = {-150, 1900, 300}}};
///     const BalancedPose hip = balance(cartilages, X_FM, stance);
///     if (hip.outcome == BalanceOutcome::balanced) use(hip.X_FM, hip.contact);

namespace condyle {

/// The external loads on the mobile body.
struct Load {
  /// Force and moment about the origin of M. Moments count with free rotations only.
  Wrench on_mobile;
  /// The frame of both: held in F, or going along with M.
  BodyRole frame = BodyRole::fixed;
};

struct BalanceOptions {
  /// Directions in F that the mobile body may be translated in, of any length but zero and independent: all where empty. The
  /// load counts along them only.
  std::vector<Vec3> free_directions = {};
  /// Rotations about the origin of M are unknowns too, and moments are balanced.
  bool free_rotations = false;
  /// Largest residual of the force, N, and of the moment, N mm, in a balanced pose.
  double force_tolerance_n = 1e-6, moment_tolerance_nmm = 1e-4;
  /// How far the mobile body may go from where it starts.
  double farthest_mm = 20;
  int most_steps = 100;
  /// Largest residual, as a fraction of the load, 0 to 1, if no step reduces it: BalanceOutcome::at_jump.
  double most_left_at_jump = 0.02;
};

/// Whether nothing of a load acts along what the balance leaves free: no pose is the one that carries it.
bool is_zero_along(const Load& load, const Pose& X_FM, const BalanceOptions& options);

enum class BalanceOutcome {
  balanced,
  at_jump,  ///< all but a little of the load is carried, and the force jumps just beyond, or no step was found that leaves less
  pulled_apart,  ///< along the load the bodies do not meet, or they part
  over_the_rim,  ///< in contact, and nowhere near was a pose found in which the contact carries the load
  too_large,  ///< compressed by nine tenths of their thickness or more, the layers carry less than the load
  unstable,   ///< in balance, but pushed on if moved along some direction: contact by itself does not hold it
  free_direction,  ///< the contact holds the mobile body in no place along a direction: prescribe it
};

/// "balanced", "at_jump", "pulled_apart", "over_the_rim", "too_large", "unstable", "free_direction".
std::string_view name_of(BalanceOutcome outcome) noexcept;

struct BalancedPose {
  BalanceOutcome outcome;
  /// The pose found; else the last one looked at, or one where the bodies are apart if less of the load is left there, or, of loads
  /// that are too large, one that carries most.
  Pose X_FM;
  Wrench residual;  ///< what contact and load add up to along what is free, in F, about the origin of M
  int steps = 0;    ///< of Newton's method
  Vec3 direction = Vec3::Zero();  ///< the direction of outcomes that have one, of length 1, in F
  ElasticContactResults contact;  ///< at X_FM

  /// The contact carries the load at X_FM: balanced, unstable, or at a jump up to the residual. Else X_FM is only where the
  /// search ended.
  bool carries_load() const noexcept;
};

/// One line that says why there is no balance, or what is wrong with it; empty if nothing is.
std::string reason_of(const BalancedPose& pose);

/// From a start nearby, with its rotation held unless rotations are free: Newton's method on the load of the contact, of each
/// step as much as leaves less of the load and stores no more energy than the load gives. A start without contact is moved along the load to
/// where the contact carries that part of it. What is called balanced is stable: the contact pushes back whichever way the
/// body is moved. The contact's force jumps where a ray begins or ceases to meet the other surface, at a rim or a side wall: a
/// load of which little is left just before a jump, or of which no step leaves less, is taken to lie within it, and reported with
/// what is left. Of a refused load no more is left than was applied, unless the contact pushes along it as far as is searched.
///
/// UsageError if a share is not from 0 to 1, the load is zero or not finite along what is free, or directions depend on each other. Some ten times
/// the cost of a pose.
BalancedPose balance(const ElasticContact& contact, const Pose& start, const Load& load,
                     const BalanceOptions& options = {});

}  // namespace condyle
