#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "condyle/io/label_file.hpp"
#include "io/joint/proposal.hpp"

/// Evidence of two bones of label maps on the joint made from them, whether it is written to a file or shown in a page.

namespace condyle::io {

/// A bone and the image that it is of.
struct ImagedBone {
  const LabelMap& map;
  std::string_view file;  ///< as errors call the image
  const LabelBone& bone;
};

/// A bone as it was asked for, of an image.
struct RequestedBone {
  const LabelMap& map;
  std::string_view file;  ///< as errors call the image
  const LabelBoneRequest& request;
  LabelBone bone;
};

/// Takes the two pieces that make a joint, if labels have several large ones: the fixed piece beside the mobile bone, which shows which half
/// of a pelvis is meant; if both labels are of two bones, the mobile piece on that side, else the one beside the largest fixed one.
/// Returns false if it was stopped.
bool take_pieces_of_joint(RequestedBone& fixed, RequestedBone& mobile, const std::optional<Side>& side,
                          const Control& control);

/// "21, 22": the labels of a bone.
std::string label_numbers(const ChosenLabel& bone, std::string_view between);

/// Where the surface of a bone comes from, one line each: its label and voxels, what the grid leaves open.
std::vector<std::string> origin_of(const LabelBone& bone, std::string_view image_name);

/// UsageError if both bodies are one label of one map.
void check_are_two(const ImagedBone& fixed, const ImagedBone& mobile);

/// The side that is given, else that of the labels' names, and by what. UsageError if the two names are of different sides, or not
/// of the given one.
std::optional<Stated<Side>> stated_side(const std::optional<Side>& given, const LabelBone& fixed,
                                        const LabelBone& mobile, const std::string& given_by = "given");

/// Notes of the images, of both bones and of where they touch. Those by which a joint is to be judged are put into the images of the bones,
/// for every answer to repeat.
std::vector<LabelNote> record_notes(RequestedBone& fixed, RequestedBone& mobile);

}  // namespace condyle::io
