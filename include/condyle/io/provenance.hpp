#pragma once

#include <Eigen/Geometry>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "condyle/implant.hpp"
#include "condyle/io/joint_file.hpp"
#include "condyle/io/mesh_file.hpp"
#include "condyle/mesh.hpp"
#include "condyle/pose.hpp"

/// Where an answer comes from, and where it is. Every key is in docs/formats.md.

namespace condyle::io {

/// The frame in which an answer gives points and meshes.
enum class AnswerFrameName {
  joint,  ///< joint frame: the fixed body's, and for what is fixed to the mobile body the mobile one's
  source  ///< that of the mesh files; each body's own if they have frames of their own
};

/// "joint", "source".
[[nodiscard]] std::string_view name_of(AnswerFrameName name) noexcept;
/// The frame of that name; throws UsageError that lists the valid names.
[[nodiscard]] AnswerFrameName answer_frame_named(std::string_view name);

/// Brings points and meshes of an answer, which are in the bodies' own joint frames, into the requested frame. Points
/// are mm in both; meshes in the source frame have the unit of their files, so that they lie on those. Default: the
/// joint frame, in which not a bit changes.
class AnswerFrame {
 public:
  AnswerFrame() = default;
  AnswerFrame(AnswerFrameName name, const JointReport& report);

  [[nodiscard]] AnswerFrameName name() const noexcept { return name_; }

  /// The same for an answer about held_at(joint, translation): what it gives in F is moved back.
  [[nodiscard]] AnswerFrame of_held(const Vec3& translation_mm) const;

  /// A point or a direction of F, and a point fixed to the mobile body, given in M.
  [[nodiscard]] Vec3 fixed_point(const Vec3& p_F) const noexcept;
  [[nodiscard]] Vec3 fixed_direction(const Vec3& d_F) const noexcept;
  [[nodiscard]] Vec3 mobile_point(const Vec3& p_M) const noexcept;

  /// A mesh in F, and the mobile body as it is in M: in the source frame as its file has it.
  [[nodiscard]] TriMesh fixed_mesh(const TriMesh& mesh) const;
  [[nodiscard]] TriMesh mobile_mesh(const TriMesh& mesh) const;

 private:
  AnswerFrameName name_ = AnswerFrameName::joint;
  Pose X_SF_ = Pose::Identity(), X_SM_ = Pose::Identity();  ///< in the frame of each body's mesh file
  double per_mm_ = 1;                                       ///< the files' unit
  Vec3 held_ = Vec3::Zero();
};

/// The file of one mesh.
struct MeshSource {
  std::string part;  ///< its name among several of one body
  std::filesystem::path path;
  FileDigest digest;
  /// From the file to the source frame below: the identity for a mesh without a scale or a pose of its own in the body.
  Eigen::Affine3d source_from_file = Eigen::Affine3d::Identity();
};

/// The mesh files of a body and how their meshes came into the joint: p_joint = joint_from_source * p_source for a vertex of the file,
/// in the file's unit, and the same vertex in the body's own joint frame (at zero angles), in mm.
struct MeshOrigin {
  std::vector<MeshSource> files;  ///< one or more
  Eigen::Affine3d joint_from_source, source_from_joint;
};

/// A file that is neither the joint file nor a mesh of a body: thicknesses, a recorded motion, targets.
struct OtherFile {
  std::filesystem::path path;
  std::string sha256;
};

/// All that an answer depends on, and nothing that changes from run to run: no date, no number of threads.
struct Provenance {
  std::vector<std::string> command;  ///< the command line word by word, without the program
  std::filesystem::path joint_path;
  FileDigest joint_digest;
  Side side;
  MeshOrigin fixed, mobile;
  AnswerFrame frame;
  /// All files that were read for it, which no answer is written over: those of the joint, and what else the question took.
  std::vector<std::filesystem::path> read = {};
  std::vector<PosedPart> parts = {};      ///< with the values that the answer is of
  std::vector<plan::CupAngles> cup = {};  ///< of a total hip, by each definition
  std::vector<OtherFile> other_files =
      {};                    ///< read beside joint file and meshes, in the order of their paths
  std::string planned = {};  ///< as Joint::planned
  LengthUnit units_of_meshes = LengthUnit::millimetres;  ///< of the files
};
[[nodiscard]] Provenance provenance_of(const LoadedJoint& loaded, std::vector<std::string> command,
                                       AnswerFrameName frame = AnswerFrameName::joint);

}  // namespace condyle::io
