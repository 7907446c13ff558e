#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "core/uninitialised.hpp"
#include "mesh/label_surface/voxel_pieces.hpp"

namespace condyle::mesh {

/// Where samples lie along one axis. A cut side ends in two layers at one place: that of the cap, and one outside of
/// it, whose samples are all negative. A side that is not cut ends in a layer whose samples are all negative.
struct SampleAxis {
  std::vector<double> coordinate;  ///< ascending
  bool cut_low = false, cut_high = false;

  std::size_t size() const noexcept { return coordinate.size(); }
  /// Whether the sample is of a layer outside of a cap.
  bool is_outer(std::size_t i) const noexcept { return (cut_low && i == 0) || (cut_high && i + 1 == size()); }
  /// Whether the sample is of the layer of a cap.
  bool is_cap(std::size_t i) const noexcept { return (cut_low && i == 1) || (cut_high && i + 2 == size()); }
};

/// Samples on a grid, the first axis fastest: inside where they are not negative.
struct SampledField {
  std::array<SampleAxis, 3> axis;
  core::UninitialisedVector<float> value;
};

/// The box's place in its image, in voxels.
struct BoxPlace {
  std::array<std::int64_t, 3> first{};
  std::array<std::int64_t, 3> image{};
};

/// The voxels under a Gaussian along each axis, less one half; in single precision. The Gaussian's standard deviation
/// is in voxels; sampled at whole voxels, cut at three standard deviations and divided by its sum; none if it is 0.
/// Beyond the box there is nothing; beyond the image the voxels go on as they end there. At a cap, half a voxel beyond
/// the last centres, the field is extrapolated from those at the last two. A surface square to the cap stays so; one
/// that leans leans less near it, by 0.23, 0.34 and 0.38 voxel at 30, 45 and 60 degrees; by 0.1 to 0.15 at the last
/// centres, by nothing beyond the next.
///
/// A sample depends on the voxels around it only, in a fixed order of sums.
SampledField smoothed_field(const VoxelBox& box, const BoxPlace& place, double sigma);

}  // namespace condyle::mesh
