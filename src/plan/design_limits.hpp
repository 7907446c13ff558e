#pragma once

#include <memory>
#include <span>
#include <string>
#include <vector>

#include "condyle/joint.hpp"
#include "condyle/sweep.hpp"

namespace condyle::plan {

/// The limits of target motions for any values of a joint's parameters, without making the joint anew for each.
///
/// The meshes of a body are searched one by one, in pairs of one of either body: a motion ends where the first pair meets.
///
///     neither moves with a swept parameter      searched once, for all designs
///     one of them does                          the other carries the table of the motion, and this one starts where its parts have it
///     liner and neck of an implant              the closed form; searched if it cannot say on which side of the target meshes end it
///     bodies that no rotation brings together   never searched: their distances from the centre have nothing in common
///
/// Which part of the head bears is that of the joint given, for all designs.
class DesignLimits {
 public:
  /// The joint must have parts. `swept`: full names of the parameters that will change; the others keep the joint's values. With `closed_forms`
  /// false every limit is searched for.
  DesignLimits(const Joint& joint, const motion::RangeOptions& options, std::span<const SweepTarget> targets,
               std::span<const std::string> swept, bool closed_forms = true);
  ~DesignLimits();

  /// Limits at these values of the swept parameters, one per target. All NaN if the bodies are in contact in the reference pose, unless the options
  /// accept that. May be called from any thread; the same bits on each.
  void limits(std::span<const double> values, std::span<DesignLimit> out) const;
  /// Whether every target is reached at these values: sooner known than the limits.
  bool reaches_all(std::span<const double> values) const;

  /// Where the meshes of liner and neck by themselves end targets elsewhere than their facets let the closed form be: "flexion 120.000, closed form
  /// 128.706"; empty if nowhere, and without a closed form.
  std::string difference_from_form(std::span<const double> values) const;

  const std::vector<EndingPair>& pairs() const noexcept;

 private:
  struct Parts;
  std::unique_ptr<Parts> parts_;
};

}  // namespace condyle::plan
