#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "condyle/io/contact_entry.hpp"
#include "condyle/io/file_digest.hpp"
#include "condyle/io/pose_text.hpp"
#include "condyle/io/recorded_motion.hpp"
#include "condyle/limit_band.hpp"
#include "condyle/make_joint.hpp"
#include "condyle/range_of_motion.hpp"
#include "condyle/repair.hpp"

/// Joint files: two meshes and how one rotates in the other, in TOML. Every key, with its unit and default,
/// is in docs/joint-file.md. Bad files throw FileError, one line "file: line 7: frame.centre: what is wrong".

namespace condyle {

/// One mesh of a body.
struct MeshEntry {
  std::string part;            ///< its name among several; empty if it is the only one
  std::filesystem::path mesh;  ///< found from the joint file's folder
  std::vector<Repair> repairs;
  bool is_bearing = false;  ///< one of several of the mobile body that slides on the fixed one
};

/// A [fixed] or [mobile] table.
struct BodyEntry {
  std::string name;
  std::vector<MeshEntry> meshes;  ///< one or more
};

/// A joint file's contents, checked one by one; no mesh was read. Lengths were converted to mm.
struct JointFile {
  std::filesystem::path path;
  JointDescription joint;
  BodyEntry fixed, mobile;
  std::vector<Motion> motions;      ///< of the [[motion]] tables, in their order, each name once
  Uncertainty uncertainty = {};     ///< of the [uncertainty] table; default values if it has no entry
  std::uint64_t band_seed = 1;      ///< of the same table
  PoseDegrees reference_pose = {};  ///< digit by digit as the file gives it
  std::optional<ContactEntry> contact = {};                   ///< of the [contact] table
  std::optional<RecordedMotionMapping> recorded_motion = {};  ///< of the [recorded_motion] table
  FileDigest digest = {};
  std::vector<std::string> processing = {};  ///< one line each: what was corrected in reading
};
JointFile read_joint_file(const std::filesystem::path& path);

/// The file itself, its meshes, and what its layers are measured by.
std::vector<std::filesystem::path> files_of(const JointFile& file);

/// Report of how one mesh was placed in the joint.
struct BodyMeshReport {
  std::string part;  ///< as in MeshEntry
  std::filesystem::path mesh;
  std::size_t vertices, triangles;
  std::size_t welded_vertices;  ///< duplicate corners of an STL file that were merged
  std::vector<RepairDone> repairs;
  FileDigest digest = {};  ///< of the file before anything was done to the mesh
};

/// Steps that made a joint from a file, for reading and for checking.
struct JointReport {
  JointFile file;
  std::vector<BodyMeshReport> fixed, mobile;  ///< one for each mesh of the body
  JointPlacement placement;
  /// One line each: what was converted, repaired or fitted. What looks wrong is for check_joint().
  std::vector<std::string> processing;
};

struct LoadedJoint {
  Joint joint;
  JointReport report;
};

/// Reads a joint file and its meshes, and makes the joint: docs/joint-frame.md, "Placement", and make_joint().
/// Throws FileError, and MeshError if a fit finds nothing or a repair cannot be made.
LoadedJoint read_joint(const std::filesystem::path& path);

}  // namespace condyle
