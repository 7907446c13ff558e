#pragma once

#include <optional>
#include <string>
#include <vector>

#include "condyle/hip_measures.hpp"

namespace condyle::measure {

/// Both bones as they are measured, in the frames of the joint.
struct Bones {
  TriMesh hip_bone, femur;
};

/// Results of searches of whole surfaces, computed once for a joint and all joints displaced from it.
struct BoneParts {
  std::optional<SphericalPatch> head;
  std::string why_no_head;      ///< empty if there is one
  std::vector<Index> socket;    ///< vertices on the socket's sphere; empty if there is none
  std::string socket_note;      ///< what angles of the socket must be read with; empty if nothing
  std::optional<Vec3> opening;  ///< of the socket, roughly
  std::string why_no_opening;   ///< empty if there is one
  /// A flag for each vertex: the mesh ends there, on an open edge, on a face that closes the bone where its image ends, or on one that
  /// looks like it.
  std::vector<char> hip_bone_ends, femur_ends;
  std::string why_no_condyles;  ///< of the femur; empty if it shows them
  std::vector<std::string>
      left_out;  ///< pieces of the meshes that are not measured, a sentence for each bone
};

/// Reference directions of angles: unit vectors.
struct BodyAxes {
  Vec3 anterior, superior, lateral;
};
BodyAxes body_axes(Side side, Angle tilt = {});

/// A value, or none.
Measure measured(double value);
Measure not_measured(std::string why);
/// A further sentence to be read with the value, if there are both.
void add_note(Measure& measure, const std::string& note);
/// A value that is empty for one reason.
Measure measured_or(const std::optional<double>& value, const std::string& why);

}  // namespace condyle::measure
