#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "condyle/joint_coordinates.hpp"
#include "condyle/length_unit.hpp"

namespace condyle {

/// What a proposal is made of.
struct ProposalRequest {
  std::filesystem::path fixed, mobile;   ///< mesh files
  std::filesystem::path joint_file;      ///< where it is to lie: meshes are named from its folder
  std::optional<Side> side = {};         ///< told by the bones where not given
  std::optional<LengthUnit> units = {};  ///< told by their size where not given
};

/// A joint file, complete but for what could not be told.
struct JointProposal {
  std::string toml;                     ///< commented: what was told and by what
  std::vector<std::string> to_fill_in;  ///< keys that stand in it as comments, with the reason
};

/// Proposes a joint file for two meshes: kind, centre, axes, side and units, each with the evidence for it. A hip's
/// frame is told from its bones: the femur hangs down from the head, the hip bone lies above it towards the midline, the
/// socket opens to the side and forwards; of the frames in use (RAS, LPS, and X anterior, Y superior, Z right) the one that
/// agrees on the given or on either side. What more than one or none agrees with is left to fill in; nothing is guessed.
/// Throws FileError where a mesh cannot be read.
JointProposal propose_joint(const ProposalRequest& request);

}  // namespace condyle
