#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "condyle/answer.hpp"
#include "condyle/io/joint_file.hpp"
#include "condyle/io/mesh_file.hpp"
#include "condyle/io/pose_text.hpp"
#include "condyle/io/provenance.hpp"
#include "condyle/joint.hpp"
#include "condyle/joint_checks.hpp"

/// Results of `condyle load`, for files. Every key and array is in docs/formats.md.

namespace condyle::io {

struct LoadQuestion {
  const Joint& joint;
  PoseDegrees pose;
  Pose X_FM;
  const ContactSurfaces& surfaces;
  ContactEntry contact;
  std::optional<contact::Load> load = {};  ///< that was balanced
  std::vector<JointNote> notes = {};
  const Provenance* provenance = nullptr;
};

std::string load_text(const LoadQuestion& question, const LoadAnswer& answer);
std::string load_json(const LoadQuestion& question, const LoadAnswer& answer);

/// Throws FileError if write_load() could not write into the folder, or would write over a file that was read
/// (Provenance::read): to be called before long work. Leaves nothing.
void check_load_folder(const std::filesystem::path& folder, const Provenance* from);

/// Writes both surfaces as fixed.vtp and mobile.vtp, in F, with pressure, depth and area in contact of each triangle of what was cast,
/// and load.json; all or none. Returns what was written. FileError.
std::vector<std::filesystem::path> write_load(const std::filesystem::path& folder,
                                              const LoadQuestion& question, const LoadAnswer& answer,
                                              VtpEncoding encoding = VtpEncoding::binary);

}  // namespace condyle::io
