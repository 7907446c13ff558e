#pragma once

#include <filesystem>
#include <optional>
#include <variant>

#include "condyle/pressure.hpp"

/// What a joint file says of its surfaces in contact: the table [contact], whose keys are docs/joint-file.md.

namespace condyle {

struct LoadedJoint;

/// A layer as a file describes it.
struct LayerEntry {
  double youngs_modulus_mpa = 0, poisson_ratio = 0;
  /// mm; or the mesh of what lies behind the layer, in the frame of the body's own mesh file.
  std::variant<double, std::filesystem::path> thickness = 0.0;
};

/// The body that a moment is told of: the casting one, as the force is, or the target, as OpenSim-JAM prints it.
enum class MomentOn { casting, target };

struct ContactEntry {
  Casting casting = Casting::both;
  NormalDepthOptions rays = {};
  PressureLaw law = PressureLaw::linear;
  std::optional<LayerEntry> fixed = {}, mobile = {};
  MomentOn moment_on = MomentOn::casting;
};

/// The options of an elastic contact of the joint, thicknesses measured. FileError for a mesh that cannot be read,
/// MeshError where a vertex of a layer has nothing behind it within the reach.
ElasticContactOptions elastic_options(const ContactEntry& entry, const LoadedJoint& joint);

}  // namespace condyle
