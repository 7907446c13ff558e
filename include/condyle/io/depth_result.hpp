#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "condyle/contact.hpp"
#include "condyle/io/mesh_file.hpp"
#include "condyle/joint.hpp"
#include "condyle/joint_checks.hpp"

/// What `condyle depth` found, for files. Every key, array, unit and sign is in docs/formats.md.

namespace condyle {

/// The pose that a result belongs to.
struct DepthQuestion {
  const Joint& joint;
  JointAngles angles;
  Pose X_FM;
  std::vector<JointNote> notes = {};  ///< what looks wrong with the joint
};

/// A rotation axis, by its joint angle and as a direction in F.
struct RotationAxis {
  JointAngle about;
  Vec3 direction_F;
};

/// Point arrays of one body (none where the other mesh is open: nothing can be inside it) and its cell array
/// in_contact, 1 for a triangle that is in a pair.
struct DepthArrays {
  std::vector<MeshArray> points;
  MeshArray in_contact;
};

/// An answer in every form in which it is given.
struct DepthResult {
  std::string text;   ///< the summary for people, a few lines
  std::string json;   ///< the summary for programs, a whole document
  std::string pairs;  ///< intersecting triangle pairs, CSV with a header line
  DepthArrays fixed, mobile;
};

/// The radial depths of one pose: point arrays inside, radial_gap_mm, triangle, winding and
/// ray_to_normal_deg.
DepthResult depth_result(const DepthQuestion& question, const RadialContact& contact,
                         const RadialSummary& summary);

/// The tangential depths about one axis: point arrays inside, tangential_depth_deg, tangential_depth_mm,
/// triangle and winding.
DepthResult depth_result(const DepthQuestion& question, const RotationAxis& axis,
                         const TangentialContact& contact);

/// Writes fixed.vtp and mobile.vtp (both in the fixed body's joint frame), pairs.csv and depth.json into a
/// folder, all or none. Throws FileError.
void write_depth(const std::filesystem::path& folder, const DepthQuestion& question,
                 const DepthResult& result);

}  // namespace condyle
