#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "condyle/control.hpp"
#include "condyle/range_of_motion.hpp"

/// How far limits move when what is not known exactly is moved within what is known: a limit with its band can be
/// quoted. docs/mathematics/06-range-of-motion.md.

namespace condyle::motion {

/// Where surfaces come from, and how far such surfaces were found to be off.
struct SurfaceOrigin {
  std::string_view name;  ///< as in files: "ct"
  double sd_mm;           ///< taken for the standard deviation over a whole bone
  std::string_view what;  ///< "CT segmented by people"
  std::string_view source;
};
/// All that have a source. docs/range-of-motion.md.
[[nodiscard]] std::span<const SurfaceOrigin> surface_origins() noexcept;

/// Standard deviations, each normally distributed and independent of the others.
struct Uncertainty {
  double centre_mm = 0.5;          ///< of each coordinate of the joint centre
  Angle axes = Angle::degrees(1);  ///< of the rotation of the joint frame about each of its axes
  /// Standard deviation of the surface along its normals, one value over a whole bone: a segmentation takes too much
  /// everywhere or too little everywhere. As it stands here it is assumed.
  double surface_mm = 0.25;
  /// If above 0, of a body whose image is known, in widths of a voxel along the normal: it covers what the grid leaves open, and nothing of
  /// the segmentation's own error, which surface_mm is only if surface_from has it. docs/mathematics/09-label-maps.md.
  double surface_voxels = 0.25;
  /// The name of the origin that surface_mm is of; empty if it is stated or assumed. Then the grid's part is added, squared.
  std::string surface_from = {};

  /// Whether the body's surface is moved by a share of a voxel.
  [[nodiscard]] bool is_by_voxels(const Body& body) const noexcept {
    return body.image && surface_voxels > 0;
  }
};

struct BandOptions {
  Uncertainty sigma = {};
  std::size_t samples = 200;  ///< 20 or more
  std::uint64_t seed = 1;
};

/// Widths of the band, 5 to 95 %, where only one source is uncertain.
struct BandShares {
  Angle centre, axes, surface;
  Angle parameters = {};  ///< of parts with a pose of their own: all of them together
};

/// The spread of one motion's limit.
struct LimitBand {
  Angle p5, median, p95;
  BandShares width_from;
  double share_without_contact = 0;  ///< of the samples that reach the end of the motion's range, 0 to 1
  double share_in_contact_at_start = 0;
  /// The limit of each displaced joint, in the order of the samples. Seed and number of samples decide by how much each one is
  /// displaced, so that limits of two joints of one seed pair up.
  std::vector<Angle> turned = {};
};

/// Bands of these motions, in their order: each of `samples` joints has its centre displaced, its axes rotated, both
/// surfaces and its uncertain parts moved, by a Latin hypercube of the seed; its limits are exact. If a bearing surface is known, that of the
/// joint as given is used in all. The same bits whatever the threads.
///
/// Throws UsageError for fewer than 20 samples, a standard deviation that is negative or not finite, and motions that
/// check_motion() refuses. Up to five searches per sample, one with all sources together and one with each source by
/// itself, of some milliseconds each for twelve motions of a hip.
[[nodiscard]] std::vector<LimitBand> limit_bands(const Joint& joint, std::span<const Motion> motions,
                                                 const RangeOptions& range, const BandOptions& options = {});
/// The same; empty if it was stopped before all samples were done.
[[nodiscard]] std::optional<std::vector<LimitBand>> limit_bands(const Joint& joint,
                                                                std::span<const Motion> motions,
                                                                const RangeOptions& range,
                                                                const BandOptions& options,
                                                                const Control& control);

/// One motion's limit in a joint that is displaced.
struct DisplacedLimit {
  Angle turned = {};
  LimitReason reason = LimitReason::end_of_range;
};

/// Exact limits of the joint as it would turn about each of these centres, given in the reference pose in mm from the joint
/// centre: for each centre one per motion. Throws UsageError if check_motion() does. A search per centre and motion, of
/// some milliseconds for twelve motions of a hip.
[[nodiscard]] std::vector<DisplacedLimit> limits_about(const Joint& joint, std::span<const Motion> motions,
                                                       const RangeOptions& range,
                                                       std::span<const Vec3> centres);

}  // namespace condyle::motion
