#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "condyle/io/joint_file.hpp"

/// Contents of a proposed joint file, whether its bodies are mesh files or bones of an image.

namespace condyle::io {

/// How a bone was moved to have its head in the socket.
struct Seating {
  Vec3 moved_mm;
  double space_mm;  ///< of the socket's radius less the head's
  bool overlaps;    ///< as seated
};

/// A body of a joint that is proposed.
struct ProposedBody {
  TriMesh mesh;                            ///< in the unit of its file
  std::filesystem::path file;              ///< where the mesh lies, or will lie
  std::string name;                        ///< as reports call it
  std::vector<std::string> comments = {};  ///< one line each, above its keys: where the surface comes from
  std::optional<BodyImage> image = {};
  double scale = 1;           ///< of the mesh's own coordinates, if its unit is another than the other body's
  std::string scale_by = {};  ///< evidence for it
  PolygonRule polygons = PolygonRule::refuse;
  bool is_piece_at_joint = false;  ///< and not all of the mesh
  std::optional<Seating> seating = {};
};

/// A value that somebody stated, and who did.
template <class T>
struct Stated {
  T value;
  std::string by;  ///< "given", "the label's name"
};

struct ProposalFacts {
  std::filesystem::path joint_file;              ///< meshes are named from its folder
  std::string from;                              ///< "the two meshes below"
  std::optional<Stated<Side>> side = {};         ///< default: inferred from the bones
  std::optional<Stated<LengthUnit>> units = {};  ///< default: inferred from their size
  std::optional<std::string> axes_by =
      {};  ///< who stated that the meshes are in LPS; default: inferred from the bones
  std::optional<Anatomy> anatomy = {};  ///< default: a hip
  Person person = {};                   ///< as ProposalRequest
  bool seat = false;                    ///< as ProposalRequest
};

JointProposal proposal_of(ProposedBody fixed, ProposedBody mobile, const ProposalFacts& facts);

}  // namespace condyle::io
