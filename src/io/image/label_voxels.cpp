#include <algorithm>
#include <cassert>
#include <iterator>

#include "condyle/io/label_file.hpp"

namespace condyle::io {
namespace {

using Voxel = std::array<std::int64_t, 3>;

/// The least and the largest index along each axis of the voxels that were added.
struct Extent {
  std::int64_t voxels = 0;
  Voxel least{}, largest{};

  /// Voxels (from, j, k) to (to, j, k).
  void add_run(std::int64_t from, std::int64_t to, std::int64_t j, std::int64_t k) noexcept {
    if (voxels == 0) {
      least = {from, j, k};
      largest = {to, j, k};
    }
    voxels += to - from + 1;
    least = {std::min(least[0], from), std::min(least[1], j), std::min(least[2], k)};
    largest = {std::max(largest[0], to), std::max(largest[1], j), std::max(largest[2], k)};
  }
};

/// Calls run(from, to, j, k, index) for each row's runs of equal voxels.
template <class Run>
void for_each_run(const std::vector<std::uint16_t>& layer, const Voxel& size, Run&& run) {
  const std::uint16_t* voxel = layer.data();
  for (std::int64_t k = 0; k < size[2]; ++k)
    for (std::int64_t j = 0; j < size[1]; ++j, voxel += size[0])
      for (std::int64_t from = 0; from < size[0];) {
        std::int64_t end = from + 1;
        while (end < size[0] && voxel[end] == voxel[from]) ++end;
        run(from, end - 1, j, k, voxel[from]);
        from = end;
      }
}

}  // namespace

VoxelMask mask_of(const LabelMap& map, const ChosenLabel& bone) {
  const auto for_each_label = [&](const auto& visit) {
    const auto visit_label = [&](const ChosenLabel& each) {
      assert(each.layer < map.layers.size());
      const auto found = std::lower_bound(map.labels.begin(), map.labels.end(), each.label);
      if (found != map.labels.end() && *found == each.label)
        visit(map.layers[each.layer], static_cast<std::uint16_t>(std::distance(map.labels.begin(), found)));
    };
    visit_label(bone);
    std::for_each(bone.also.begin(), bone.also.end(), visit_label);
  };
  VoxelMask mask{map.grid, {}, {}, {}};
  Extent extent;
  for_each_label([&](const std::vector<std::uint16_t>& layer, std::uint16_t wanted) {
    for_each_run(layer, map.grid.size, [&](auto from, auto to, auto j, auto k, auto index) {
      if (index == wanted) extent.add_run(from, to, j, k);
    });
  });
  if (extent.voxels == 0) return mask;
  mask.first = extent.least;
  for (std::size_t axis = 0; axis < 3; ++axis)
    mask.size[axis] = extent.largest[axis] - extent.least[axis] + 1;
  mask.inside.resize(static_cast<std::size_t>(mask.size[0] * mask.size[1] * mask.size[2]));
  for_each_label([&](const std::vector<std::uint16_t>& layer, std::uint16_t wanted) {
    auto to = mask.inside.begin();
    for (std::int64_t k = extent.least[2]; k <= extent.largest[2]; ++k)
      for (std::int64_t j = extent.least[1]; j <= extent.largest[1]; ++j) {
        const std::uint16_t* row =
            layer.data() + map.grid.size[0] * (j + map.grid.size[1] * k) + extent.least[0];
        to = std::transform(row, row + mask.size[0], to, to, [&](std::uint16_t index, std::uint8_t inside) {
          return static_cast<std::uint8_t>(inside | (index == wanted ? 1 : 0));
        });
      }
  });
  return mask;
}

VoxelMask mask_of(const LabelMap& map, std::size_t layer, std::uint32_t label) {
  return mask_of(map, ChosenLabel{layer, label, {}, {}});
}

std::vector<LabelSummary> summaries_of(const LabelMap& map) {
  std::vector<LabelSummary> summaries;
  for (std::size_t layer = 0; layer < map.layers.size(); ++layer) {
    std::vector<Extent> extents(map.labels.size());
    for_each_run(map.layers[layer], map.grid.size, [&](auto from, auto to, auto j, auto k, auto index) {
      extents[index].add_run(from, to, j, k);
    });
    for (std::size_t index = 0; index < extents.size(); ++index) {
      const Extent& extent = extents[index];
      if (extent.voxels == 0) continue;
      LabelSummary summary{layer, map.labels[index], extent.voxels, extent.least, {}, {}};
      for (std::size_t axis = 0; axis < 3; ++axis) {
        summary.size[axis] = extent.largest[axis] - extent.least[axis] + 1;
        summary.touches[2 * axis] = extent.least[axis] == 0;
        summary.touches[2 * axis + 1] = extent.largest[axis] == map.grid.size[axis] - 1;
      }
      summaries.push_back(summary);
    }
  }
  return summaries;
}

}  // namespace condyle::io
