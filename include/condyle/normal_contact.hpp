#pragma once

#include <optional>
#include <vector>

#include "condyle/contact.hpp"
#include "condyle/normal_depth.hpp"
#include "condyle/pressure.hpp"

/// Depths along normals of both bodies in one pose.

namespace condyle {

/// Results of the rays along the normals of one body's surface.
struct NormalCast {
  SurfaceContact surface;            ///< in the frame of the body that casts
  std::size_t cut_off_by_reach = 0;  ///< rays that a longer reach would find in contact
};

/// Results for each body that casts its depths; and whether the surfaces meet, which needs no normals.
struct NormalContact {
  std::vector<TrianglePair> pairs;  ///< ascending
  bool in_contact = false;          ///< as ContactResults has it
  std::optional<NormalCast> fixed, mobile;
};

/// Both meshes may be open. For one pose: rays are prepared at each call, and a NormalDepth keeps them for many.
/// UsageError if the reach is not above 0.
NormalContact normal_contact(const JointContact& joint, const Pose& X_FM, Casting casting = Casting::both,
                             const NormalDepthOptions& rays = {});

}  // namespace condyle
