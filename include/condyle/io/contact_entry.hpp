#pragma once

#include <array>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "condyle/joint.hpp"
#include "condyle/pressure.hpp"

/// A joint file's entries for its surfaces in contact: the table [contact], whose keys are in docs/joint-contact.md.

namespace condyle {

struct LoadedJoint;

/// A layer as a file describes it.
struct LayerEntry {
  double youngs_modulus_mpa = 0, poisson_ratio = 0;
  /// Thickness of the layer, or of its parts with nothing behind them; 0: not given.
  double thickness_mm = 0;
  /// The mesh of what lies behind the layer, in the frame of the body's own mesh file: its thickness is measured.
  std::optional<std::filesystem::path> behind = {};
  /// A text file with the thickness at each vertex of the surface, in the joint file's units; then nothing else is given.
  std::optional<std::filesystem::path> thickness_file = {};
  double mm_per_unit = 1;  ///< of that file
  /// Least and greatest thickness that a layer of varying thickness should have; a note names what lies beyond.
  std::optional<std::array<double, 2>> thickness_bounds_mm = {};
};

/// A part of the casting surface by its place: the faces whose centre is in all half-spaces.
struct RegionEntry {
  std::string name;
  std::vector<HalfSpace> half_spaces;  ///< in the casting body's joint frame
};

/// The body whose moment is reported: the casting one, as for the force, or the target, as OpenSim-JAM prints it.
enum class MomentOn { casting, target };

struct ContactEntry {
  std::string fixed_part = {}, mobile_part = {};  ///< of the bodies; empty: all of it
  Casting casting = Casting::both;
  NormalDepthOptions rays = {};
  PressureLaw law = PressureLaw::linear;
  std::optional<LayerEntry> fixed = {}, mobile = {};
  MomentOn moment_on = MomentOn::casting;
  std::vector<RegionEntry> regions = {};  ///< by name, each once
};

/// The surfaces that an entry speaks of, by their names; in the bodies' joint frames.
struct ContactSurfaces {
  Body fixed, mobile;
};
/// UsageError for a part that a body does not have, with those it has.
ContactSurfaces surfaces_of(const ContactEntry& entry, const Joint& joint);

/// The options of an elastic contact of these surfaces, thicknesses measured or read. FileError for a mesh or a file of
/// thicknesses that cannot be read or has not one for each vertex,
/// MeshError if a vertex of a layer has nothing behind it within the reach and the entry gives no thickness for that.
ElasticContactOptions elastic_options(const ContactEntry& entry, const ContactSurfaces& surfaces,
                                      const LoadedJoint& joint);

/// Values that replace a joint file's entries for its surfaces in contact; only those given replace.
struct ContactChanges {
  std::optional<Casting> casting = {};
  std::optional<FaceRule> rule = {};
  std::optional<double> reach_mm = {};
  std::optional<PressureLaw> law = {};
  /// One for both layers, or one of each: fixed, mobile.
  std::vector<double> youngs_modulus_mpa = {}, poisson_ratio = {}, thickness_mm = {};

  bool any_of_rays() const noexcept { return casting || rule || reach_mm; }
  bool any_of_layers() const noexcept {
    return !youngs_modulus_mpa.empty() || !poisson_ratio.empty() || !thickness_mm.empty();
  }
};

/// The entry with the changes. A body without a layer gets one where modulus, ratio and thickness are all given, and no part
/// of one otherwise; a thickness that is given takes the place of a measured one.
ContactEntry changed(ContactEntry entry, const ContactChanges& changes);

}  // namespace condyle
