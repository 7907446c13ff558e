#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "condyle/answer/depth.hpp"
#include "condyle/io/mesh_file.hpp"
#include "io/result/json.hpp"

/// Results of `condyle touch`, `turn` and `slide`. Every key is in docs/touch.md.

namespace condyle::io {

/// A mesh as it was read and scaled to mm.
struct TouchMesh {
  std::filesystem::path path;
  Mesh mesh;
  FileDigest digest = {};  ///< if it was computed
};

/// Two mesh files, and where the second one was placed.
struct TouchFiles {
  TouchMesh fixed, mobile;
  Pose X_FM = Pose::Identity();
  std::vector<std::filesystem::path> read = {};  ///< all files, which no answer is written over
  std::vector<std::string> command = {};
};

/// The answer's record and where it is from; without files, as Python's meshes have none, the record only.
Json touch_object(const TouchAnswer& answer, const TouchFiles* files = nullptr);
Json turn_object(const TurnAnswer& answer, const TouchFiles* files = nullptr);
Json slide_object(const SlideAnswer& answer, const TouchFiles* files = nullptr);

std::string touch_text(const TouchAnswer& answer, const TouchFiles& files);
std::string turn_text(const TurnAnswer& answer, const TouchFiles& files);
std::string slide_text(const SlideAnswer& answer, const TouchFiles& files);

/// Throws FileError if write_touch() could not write into the folder. Leaves nothing.
void check_touch_folder(const std::filesystem::path& folder, const TouchFiles& files);

/// Writes touch.json, fixed.vtp and mobile.vtp (both in the frame of the fixed body, mm; triangles that meet have in_contact 1) and
/// place.vtp (the deepest place and its exit as a line's ends) into a folder; all or none. Returns what was written.
std::vector<std::filesystem::path> write_touch(const std::filesystem::path& folder, const TouchAnswer& answer,
                                               const TouchFiles& files, VtpEncoding encoding);

/// Draws both meshes and what meets as PNG: draw_touch() in the view of view_of_touch().
void write_touch_picture(const std::filesystem::path& path, const TouchAnswer& answer,
                         const TouchFiles& files);

}  // namespace condyle::io
