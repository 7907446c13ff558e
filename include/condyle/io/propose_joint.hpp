#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "condyle/joint_coordinates.hpp"
#include "condyle/length_unit.hpp"

namespace condyle {

/// Input of a proposal.
struct ProposalRequest {
  std::filesystem::path fixed, mobile;   ///< mesh files
  std::filesystem::path joint_file;      ///< where it is to lie: meshes are named from its folder
  std::optional<Side> side = {};         ///< default: inferred from the bones
  std::optional<LengthUnit> units = {};  ///< default: inferred from their size
};

/// A joint file, complete but for what could not be inferred.
struct JointProposal {
  std::string toml;                     ///< each value with a comment on its evidence
  std::vector<std::string> to_fill_in;  ///< keys that stand in it as comments, with the reason
  std::vector<std::string> evidence;  ///< for side and axes, one line each with its vote; comments in it too
};

/// Proposes a joint file for two meshes: kind, centre, axes, side and units, each with the evidence for it. A hip's axes are
/// inferred among the frames in use: RAS, LPS, and X anterior, Y superior, Z right. Where femur, neck, hip bone and the
/// socket's opening lie about the head votes for up and outwards, and so do the far ends of whole bones; the neck's angle
/// in the socket and the hip bone's shape vote for the side. What the votes do not settle, or settle against the given
/// side, is left to fill in; nothing is guessed. Throws FileError if a mesh cannot be read.
JointProposal propose_joint(const ProposalRequest& request);

}  // namespace condyle
