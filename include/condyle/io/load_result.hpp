#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "condyle/io/contact_entry.hpp"
#include "condyle/io/mesh_file.hpp"
#include "condyle/io/pose_text.hpp"
#include "condyle/io/provenance.hpp"
#include "condyle/joint.hpp"
#include "condyle/joint_checks.hpp"
#include "condyle/load_balance.hpp"

/// What `condyle load` found, for files. Every key and array is in docs/formats.md.

namespace condyle {

struct LoadQuestion {
  const Joint& joint;
  PoseDegrees pose;
  Pose X_FM;
  const ContactSurfaces& surfaces;
  ContactEntry contact;
  std::optional<Load> load = {};  ///< that was balanced
  std::vector<JointNote> notes = {};
  const Provenance* provenance = nullptr;
};

/// The pose that was asked, or the balanced one.
struct LoadAnswer {
  Pose X_FM;
  ElasticContactResults contact;
  std::optional<BalancedPose> balanced = {};
  std::size_t cut_off_by_reach = 0;  ///< rays
};

std::string load_text(const LoadQuestion& question, const LoadAnswer& answer);
std::string load_json(const LoadQuestion& question, const LoadAnswer& answer);

/// Writes both surfaces as fixed.vtp and mobile.vtp, in F, with pressure, depth and area in contact of each triangle of what was cast,
/// and load.json; all or none. Returns what was written. FileError.
std::vector<std::filesystem::path> write_load(const std::filesystem::path& folder,
                                              const LoadQuestion& question, const LoadAnswer& answer,
                                              VtpEncoding encoding = VtpEncoding::binary);

}  // namespace condyle
