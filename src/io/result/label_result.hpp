#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "condyle/io/label_file.hpp"

/// Results of `condyle surface` and of `condyle inspect` for label maps. Keys of the JSON are listed in docs/label-maps.md.

namespace condyle::io {

std::string surface_text(const LabelBone& bone);
std::string surface_json(const LabelBone& bone, const std::filesystem::path& image,
                         const std::vector<std::string>& command);

/// An inspected label map, without its voxels.
struct LabelInspection {
  std::filesystem::path image;
  VoxelGrid grid;
  std::size_t layers;
  std::vector<LabelSummary> labels;  ///< above 0
  std::vector<std::size_t> pieces;   ///< 26-connected ones of each
  std::vector<LabelSegment> segments;
  std::vector<LabelNote> notes;
};
LabelInspection inspect_labels(const std::filesystem::path& image, const LabelFileOptions& options);

std::string labels_text(std::span<const LabelInspection> images);
std::string labels_json(std::span<const LabelInspection> images, const std::vector<std::string>& command);

}  // namespace condyle::io
