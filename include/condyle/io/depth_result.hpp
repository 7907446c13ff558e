#pragma once

#include <string>
#include <vector>

#include "condyle/io/mesh_file.hpp"
#include "condyle/joint.hpp"
#include "contact/radial_summary.hpp"
#include "contact/tangential_contact.hpp"

/// What `condyle depth` found, for files. Every key, array, unit and sign is in docs/formats.md.

namespace condyle {

/// The pose that a result belongs to.
struct DepthQuestion {
  const Joint& joint;
  JointAngles angles;
  Pose X_FM;
};

/// A turning axis, by its joint angle and as a direction in F.
struct TurnAxis {
  JointAngle about;
  Vec3 direction_F;
};

/// The summary as JSON text, ending in a newline.
std::string depth_json(const DepthQuestion& question, const RadialContact& contact,
                       const RadialSummary& summary);
std::string depth_json(const DepthQuestion& question, const TurnAxis& axis, const TangentialContact& contact);

/// The summary for people, a few lines.
std::string depth_text(const DepthQuestion& question, const RadialContact& contact,
                       const RadialSummary& summary);
std::string depth_text(const DepthQuestion& question, const TurnAxis& axis, const TangentialContact& contact);

/// Point arrays of one body: inside, winding, triangle; radial_gap_mm and ray_to_normal_deg, or
/// tangential_depth_deg and tangential_depth_mm. None where the other mesh is open and nothing can be inside
/// it.
std::vector<MeshArray> depth_arrays(const std::optional<RadialResults>& results);
std::vector<MeshArray> depth_arrays(const std::optional<TangentialResults>& results);

/// Cell arrays in_contact of both bodies: 1 for a triangle that is in a pair.
struct InContact {
  MeshArray fixed, mobile;
};
InContact contact_arrays(const Joint& joint, const std::vector<TrianglePair>& pairs);

/// Colliding triangle pairs as CSV text with a header line.
std::string pairs_csv(const std::vector<TrianglePair>& pairs);

}  // namespace condyle
