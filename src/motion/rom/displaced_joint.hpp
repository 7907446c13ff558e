#pragma once

#include <memory>
#include <span>

#include "condyle/limit_band.hpp"
#include "condyle/range_of_motion.hpp"
#include "motion/rom/displacement.hpp"

/// Exact limits of a joint whose centre, axes and surfaces are moved a little: one sample of a band.

namespace condyle::motion {

/// The joint that all samples are displaced from, prepared once.
class DisplacedJoint {
 public:
  /// Where a bearing surface is known, that of the joint as given is used in all. The motions must outlive it. `sigma` is that of
  /// the surfaces.
  DisplacedJoint(const Joint& joint, std::span<const Motion> motions, const RangeOptions& range,
                 const Uncertainty& sigma);
  ~DisplacedJoint();
  DisplacedJoint(const DisplacedJoint&) = delete;
  DisplacedJoint& operator=(const DisplacedJoint&) = delete;

  /// Finds where the joint as given ends its motions, to look there first: worth it for many limits, which it leaves as they are.
  void learn();
  /// Writes one limit per motion. From any thread.
  void limits(const Displacement& by, std::span<DisplacedLimit> out) const;

 private:
  struct Parts;
  std::unique_ptr<Parts> parts_;
};

/// limit_bands() without `width_from`: one search per sample. Empty if it was stopped.
[[nodiscard]] std::optional<std::vector<LimitBand>> bands_without_widths(const Joint& joint,
                                                                         std::span<const Motion> motions,
                                                                         const RangeOptions& range,
                                                                         const BandOptions& options,
                                                                         const Control& control);

}  // namespace condyle::motion
