#pragma once

#include <optional>
#include <vector>

#include "condyle/contact.hpp"
#include "condyle/normal_depth.hpp"
#include "condyle/pressure.hpp"

/// Depths along normals of both bodies in one pose.

namespace condyle {

/// What rays along the normals of one body's surface found.
struct NormalCast {
  SurfaceContact surface;            ///< in the frame of the body that casts
  std::size_t cut_off_by_reach = 0;  ///< rays that a longer reach would find in contact
};

/// Of each body that casts its depths; and whether the surfaces meet, which asks no normal.
struct NormalContact {
  std::vector<TrianglePair> pairs;  ///< ascending
  bool in_contact = false;          ///< as ContactResults has it
  std::optional<NormalCast> fixed, mobile;
};

/// Both meshes may be open. For one pose: rays are made ready for each call, and a NormalDepth keeps them for many. UsageError
/// where the reach is not above 0.
NormalContact normal_contact(const JointContact& joint, const Pose& X_FM, Casting casting = Casting::both,
                             const NormalDepthOptions& rays = {});

}  // namespace condyle
