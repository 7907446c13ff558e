#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "condyle/error.hpp"
#include "condyle/io/label_file.hpp"
#include "fuzz/one_line.hpp"
#include "fuzz/targets.hpp"

namespace condyle::test {
namespace {

constexpr std::string_view name = "some.file";

std::string fault_of_grid(const VoxelGrid& grid) {
  if (!grid.X_WI.matrix().allFinite()) return "an affine that is not finite";
  Eigen::Matrix3d axes = grid.X_WI.linear();
  for (int axis = 0; axis < 3; ++axis) axes.col(axis) /= axes.col(axis).stableNorm();
  if (!(std::abs(axes.determinant()) > 0)) return "axes in one plane";
  if (*std::min_element(grid.size.begin(), grid.size.end()) < 1) return "a size below 1";
  return {};
}

std::string fault_of_voxels(const io::LabelMap& map) {
  if (map.layers.empty()) return "no layer";
  if (std::adjacent_find(map.labels.begin(), map.labels.end(), std::greater_equal<>()) != map.labels.end())
    return "labels that do not ascend";
  const auto voxels = static_cast<std::size_t>(map.grid.size[0] * map.grid.size[1] * map.grid.size[2]);
  std::vector<bool> occurs(map.labels.size());
  for (const auto& layer : map.layers) {
    if (layer.size() != voxels) return "a layer of another size";
    for (const auto index : layer) {
      if (index >= map.labels.size()) return "an index out of range";
      occurs[index] = true;
    }
  }
  if (std::find(occurs.begin(), occurs.end(), false) != occurs.end()) return "a label without voxels";
  return {};
}

/// Summaries and masks count the same voxels as plain counting.
std::string fault_of_summaries(const io::LabelMap& map) {
  constexpr std::size_t most_masks = 8;
  std::size_t masks = 0;
  std::int64_t in_all = 0;
  for (const auto& summary : io::summaries_of(map)) {
    in_all += summary.voxels;
    if (++masks > most_masks) continue;
    const auto& layer = map.layers[summary.layer];
    const auto plain = std::count_if(layer.begin(), layer.end(),
                                     [&](const auto index) { return map.labels[index] == summary.label; });
    const VoxelMask mask = io::mask_of(map, summary.layer, summary.label);
    if (plain != summary.voxels || std::count(mask.inside.begin(), mask.inside.end(), 1) != summary.voxels)
      return "a label of another number of voxels";
    if (mask.first != summary.first || mask.size != summary.size) return "a box that differs";
  }
  const auto all = static_cast<std::int64_t>(map.layers.size() * map.layers.front().size());
  return in_all == all ? "" : "voxels that no label has";
}

std::string fault_of_choice(const io::LabelMap& map, const std::string& text) {
  for (const std::optional<io::LabelTask> task :
       {std::optional<io::LabelTask>(), std::optional(io::LabelTask::total)}) {
    try {
      if (io::choose_label(map, text, task).layer >= map.layers.size()) return "a choice in no layer";
    } catch (const UsageError& error) {
      if (const auto fault = fault_of_message(error.what()); !fault.empty()) return fault;
    }
  }
  return {};
}

std::string fault_of(const io::LabelMap& map) {
  if (auto fault = fault_of_grid(map.grid); !fault.empty()) return fault;
  if (auto fault = fault_of_voxels(map); !fault.empty()) return fault;
  if (auto fault = fault_of_summaries(map); !fault.empty()) return fault;
  for (const auto& note : map.notes)
    if (auto fault = fault_of_message(note.text); !fault.empty()) return fault;
  constexpr std::size_t most_names = 16;
  for (std::size_t i = 0; i < std::min(map.segments.size(), most_names); ++i) {
    const auto& segment = map.segments[i];
    if (segment.layer >= map.layers.size()) return "a segment in no layer";
    for (const auto& text : {segment.name, segment.id, fmt::format("{}:{}", segment.layer, segment.label)})
      if (auto fault = fault_of_choice(map, text); !fault.empty()) return fault;
  }
  return fault_of_choice(map, "femur_left");
}

/// The format, and what a user may choose, by one byte.
io::LabelFileOptions options_of(unsigned byte) {
  io::LabelFileOptions options;
  options.affine = static_cast<io::AffineChoice>(byte / 3 % 3);
  if (byte / 9 % 2 == 1) options.axes = io::StatedAxes::ras;
  if (byte / 18 % 2 == 1) options.volume = byte / 36 % 3;
  return options;
}

}  // namespace

std::string fuzz_label_file(std::string_view bytes) {
  if (bytes.empty()) return {};
  const unsigned choice = static_cast<unsigned char>(bytes[0]);
  try {
    return fault_of(
        io::read_labels(bytes.substr(1), static_cast<io::LabelFormat>(choice % 3), name, options_of(choice)));
  } catch (const FileError& error) {
    return fault_of_message(error.what(), std::string(name) + ": ");
  }
}

}  // namespace condyle::test
