#include "mesh/label_surface/repeated_slices.hpp"

#include <algorithm>
#include <numeric>
#include <vector>

namespace condyle::mesh {
namespace {

/// For each slice whether it is empty, and whether it is as the one before it.
struct Slices {
  std::vector<std::uint8_t> is_empty, repeats;
};

/// Most slices of a bone differ from the one before at its first rows, and are not looked at again.
Slices slices_along(const VoxelMask& mask, std::size_t axis) {
  const auto count = static_cast<std::size_t>(mask.size[axis]);
  Slices slices{std::vector<std::uint8_t>(count, 1), std::vector<std::uint8_t>(count, 1)};
  std::vector<std::size_t> open(count);
  std::iota(open.begin(), open.end(), std::size_t{0});
  if (count > 0) slices.repeats[0] = 0;
  std::ptrdiff_t step = 1;
  for (std::size_t a = 0; a < axis; ++a) step *= static_cast<std::ptrdiff_t>(mask.size[a]);
  const std::ptrdiff_t block = step * static_cast<std::ptrdiff_t>(count);
  for (std::ptrdiff_t at = 0; at < std::ssize(mask.inside) && !open.empty(); at += block)
    std::erase_if(open, [&](std::size_t s) {
      const auto row = mask.inside.begin() + at + static_cast<std::ptrdiff_t>(s) * step;
      if (slices.is_empty[s] && std::find(row, row + step, std::uint8_t{1}) != row + step)
        slices.is_empty[s] = 0;
      if (slices.repeats[s] && !std::equal(row, row + step, row - step)) slices.repeats[s] = 0;
      return !slices.is_empty[s] && !slices.repeats[s];
    });
  return slices;
}

}  // namespace

double slices_in_one(const VoxelMask& mask, std::size_t axis) {
  const Slices slices = slices_along(mask, axis);
  std::vector<std::size_t> runs;
  for (std::size_t s = 0; s < slices.is_empty.size(); ++s) {
    if (slices.is_empty[s]) continue;
    if (slices.repeats[s] && !runs.empty())
      ++runs.back();
    else
      runs.push_back(1);
  }
  if (runs.empty()) return 1;
  const auto middle = runs.begin() + std::ssize(runs) / 2;
  std::nth_element(runs.begin(), middle, runs.end());
  const std::size_t usual = *middle;
  if (usual == 1) return 1;
  double slices_of_runs = 0, kept = 0;
  for (const std::size_t run : runs)
    if (run <= 2 * usual) slices_of_runs += static_cast<double>(run), kept += 1;
  return slices_of_runs / kept;
}

}  // namespace condyle::mesh
