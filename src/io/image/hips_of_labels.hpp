#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "condyle/io/label_file.hpp"

/// Which labels of an image are hips, one of each side of the body or both.

namespace condyle::io {

/// Two labels that make a hip, as choose_label() takes them.
struct LabelHip {
  std::string fixed, mobile;
  std::optional<Side> side;    ///< empty if the bones show it
  bool side_by_piece = false;  ///< the label has femora of both sides: the one on this side is meant
};

/// The hips of an image, left before right, and in a line each which bone has no other of its side.
struct LabelHips {
  std::vector<LabelHip> hips = {};
  std::vector<std::string> left_out = {};
};

/// How bones are found: by names of the file or of the table, or by labels that somebody chose.
struct HipLabels {
  std::string fixed = {}, mobile = {};  ///< as choose_label() takes them; empty: by name
  std::optional<LabelTask> task = {};
  std::optional<Side> side = {};  ///< only this hip
};

/// A femur without a side in its name is of both sides if it has two large pieces. Throws UsageError, which begins with `file`, if no label is
/// called a pelvis or a femur, if several are for one side, and for a side that is not there.
LabelHips hips_in(const LabelMap& map, std::string_view file, const HipLabels& wanted);

/// Whether a label, or the only one of an image if `label` is empty, has two pieces as large as bones.
bool is_of_both_sides(const LabelMap& map, const std::string& label, std::optional<LabelTask> task);

}  // namespace condyle::io
