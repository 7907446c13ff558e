#include "mesh/label_surface/smoothed_field.hpp"

#include <algorithm>

#include "core/exponential.hpp"
#include "core/parallel.hpp"

namespace condyle::mesh {
namespace {

/// Weights at distance 0, 1, ... voxels.
std::vector<float> gaussian(double sigma) {
  const auto radius = static_cast<std::size_t>(3 * sigma + 0.5);
  std::vector<double> weight(radius + 1);
  double sum = 0;
  for (std::size_t d = 0; d <= radius; ++d) {
    const double t = static_cast<double>(d) / sigma;
    weight[d] = d == 0 ? 1 : core::exponential(-0.5 * t * t);
    sum += d == 0 ? weight[d] : 2 * weight[d];
  }
  std::vector<float> rounded;
  for (const double w : weight) rounded.push_back(static_cast<float>(w / sum));
  return rounded;
}

/// Smooths along one axis: rows of voxels -1 to size, each of `width` values, are made of rows 0 to size - 1.
struct AxisFilter {
  std::vector<float> weight;
  std::int64_t size;
  bool cut_low, cut_high;

  /// source(c) is row c of those given, target(c) the place of row c of those made; they do not overlap. `zero` is a
  /// row of zeros.
  template <class Source, class Target>
  void apply(std::size_t width, const float* zero, const Source& source, const Target& target) const {
    const auto row = [&](std::int64_t c) -> const float* {
      if ((c < 0 && !cut_low) || (c >= size && !cut_high)) return zero;
      return source(std::clamp<std::int64_t>(c, 0, size - 1));
    };
    for (std::int64_t c = -1; c <= size; ++c) {
      float* out = target(c);
      const float* middle = row(c);
      for (std::size_t i = 0; i < width; ++i) out[i] = weight[0] * middle[i];
      for (std::size_t d = 1; d < weight.size(); ++d) {
        const auto step = static_cast<std::int64_t>(d);
        const float *before = row(c - step), *after = row(c + step);
        const float w = weight[d];
        for (std::size_t i = 0; i < width; ++i) out[i] += w * (before[i] + after[i]);
      }
    }
    const auto to_cap = [&](float* cap, const float* last, const float* next) {
      for (std::size_t i = 0; i < width; ++i) cap[i] = last[i] + 0.5f * (last[i] - next[i]);
    };
    if (cut_low) to_cap(target(-1), target(0), target(std::min<std::int64_t>(1, size - 1)));
    if (cut_high) to_cap(target(size), target(size - 1), target(std::max<std::int64_t>(size - 2, 0)));
  }
};

SampleAxis sample_axis(std::int64_t first, std::int64_t size, bool cut_low, bool cut_high) {
  SampleAxis axis{{}, cut_low, cut_high};
  const auto low = static_cast<double>(first), high = static_cast<double>(first + size - 1);
  if (cut_low) axis.coordinate.push_back(low - 0.5);
  axis.coordinate.push_back(cut_low ? low - 0.5 : low - 1);
  for (std::int64_t i = 0; i < size; ++i) axis.coordinate.push_back(static_cast<double>(first + i));
  axis.coordinate.push_back(cut_high ? high + 0.5 : high + 1);
  if (cut_high) axis.coordinate.push_back(high + 0.5);
  return axis;
}

}  // namespace

SampledField smoothed_field(const VoxelBox& box, const BoxPlace& place, double sigma) {
  SampledField field;
  std::array<AxisFilter, 3> filter;
  std::array<std::size_t, 3> count, outer;
  for (std::size_t a = 0; a < 3; ++a) {
    const bool cut_low = place.first[a] == 0, cut_high = place.first[a] + box.size[a] == place.image[a];
    filter[a] = {gaussian(sigma), box.size[a], cut_low, cut_high};
    field.axis[a] = sample_axis(place.first[a], box.size[a], cut_low, cut_high);
    count[a] = field.axis[a].size();
    outer[a] = cut_low ? 1 : 0;
  }
  const auto width = static_cast<std::size_t>(box.size[0]) + 2,
             voxels = static_cast<std::size_t>(box.size[0]);
  const auto rows = static_cast<std::size_t>(box.size[1]), slices = static_cast<std::size_t>(box.size[2]);
  field.value.resize(count[0] * count[1] * count[2]);
  /// The row of samples at centre j of centres' slice k, both from -1.
  const auto at = [&](std::int64_t j, std::int64_t k) {
    const std::size_t y = static_cast<std::size_t>(j + 1) + outer[1],
                      z = static_cast<std::size_t>(k + 1) + outer[2];
    return field.value.data() + (z * count[1] + y) * count[0] + outer[0];
  };
  const std::vector<float> zero(width, 0.0f);

  // Along x and y, slice by slice.
  core::parallel_chunks(slices, 1, [&](std::size_t first, std::size_t last) {
    std::vector<float> line(voxels), smoothed(rows * width);
    for (std::size_t k = first; k < last; ++k) {
      const std::uint8_t* voxel = box.inside.data() + k * rows * voxels;
      for (std::size_t j = 0; j < rows; ++j, voxel += voxels) {
        float* const out = smoothed.data() + j * width;
        if (std::find(voxel, voxel + voxels, std::uint8_t{1}) == voxel + voxels) {
          std::fill(out, out + width, 0.0f);
          continue;
        }
        std::copy(voxel, voxel + voxels, line.begin());
        filter[0].apply(
            1, zero.data(), [&](std::int64_t i) { return line.data() + i; },
            [&](std::int64_t i) { return out + (i + 1); });
      }
      filter[1].apply(
          width, zero.data(),
          [&](std::int64_t j) { return smoothed.data() + static_cast<std::size_t>(j) * width; },
          [&](std::int64_t j) { return at(j, static_cast<std::int64_t>(k)); });
    }
  });

  // Along z, all slices of one row at a time.
  core::parallel_chunks(rows + 2, 1, [&](std::size_t first, std::size_t last) {
    std::vector<float> given(slices * width);
    for (std::size_t y = first; y < last; ++y) {
      const std::int64_t j = static_cast<std::int64_t>(y) - 1;
      for (std::size_t k = 0; k < slices; ++k) {
        const float* const row = at(j, static_cast<std::int64_t>(k));
        std::copy(row, row + width, given.data() + k * width);
      }
      filter[2].apply(
          width, zero.data(),
          [&](std::int64_t k) { return given.data() + static_cast<std::size_t>(k) * width; },
          [&](std::int64_t k) { return at(j, k); });
      for (std::int64_t k = -1; k <= box.size[2]; ++k) {
        float* const row = at(j, k);
        for (std::size_t i = 0; i < width; ++i) row[i] -= 0.5f;
      }
    }
  });

  // Layers outside of caps, and the last ones of sides that are not cut: outside too where a cap's extrapolation says
  // otherwise.
  constexpr float outside = -0.5f, most_at_end = -0.01f;
  core::parallel_chunks(count[2], 16, [&](std::size_t first, std::size_t last) {
    for (std::size_t k = first; k < last; ++k) {
      for (std::size_t j = 0; j < count[1]; ++j) {
        float* const row = field.value.data() + (k * count[1] + j) * count[0];
        const auto is_end = [&](std::size_t a, std::size_t layer) {
          return (layer == 0 && !field.axis[a].cut_low) || (layer + 1 == count[a] && !field.axis[a].cut_high);
        };
        if (field.axis[1].is_outer(j) || field.axis[2].is_outer(k)) {
          std::fill(row, row + count[0], outside);
          continue;
        }
        if (is_end(1, j) || is_end(2, k))
          for (std::size_t i = 0; i < count[0]; ++i) row[i] = std::min(row[i], most_at_end);
        for (const std::size_t i : {std::size_t{0}, count[0] - 1})
          row[i] = field.axis[0].is_outer(i) ? outside : std::min(row[i], most_at_end);
      }
    }
  });
  return field;
}

}  // namespace condyle::mesh
