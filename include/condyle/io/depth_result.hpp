#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "condyle/contact.hpp"
#include "condyle/io/mesh_file.hpp"
#include "condyle/io/pose_text.hpp"
#include "condyle/io/provenance.hpp"
#include "condyle/joint.hpp"

/// What `condyle depth` found, for files. Every key, array, unit and sign is in docs/formats.md.

namespace condyle {

/// The pose that a result belongs to.
struct DepthQuestion {
  const Joint& joint;
  PoseDegrees pose;  ///< as it was given
  Pose X_FM;
  /// Where the answer comes from and in which frame it is given; null: not known, and the joint frame.
  const Provenance* provenance = nullptr;

  AnswerFrame frame() const { return provenance ? provenance->frame : AnswerFrame{}; }
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

/// Writes fixed.vtp and mobile.vtp (both in the fixed body's frame), pairs.csv and depth.json into a
/// folder, all or none; files of an earlier result go. Returns what was written. Throws FileError.
std::vector<std::filesystem::path> write_depth(const std::filesystem::path& folder,
                                               const DepthQuestion& question, const DepthResult& result,
                                               VtpEncoding encoding = VtpEncoding::binary);

}  // namespace condyle
