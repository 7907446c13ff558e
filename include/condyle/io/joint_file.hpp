#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "condyle/answer/case.hpp"
#include "condyle/implant.hpp"
#include "condyle/inspect.hpp"
#include "condyle/io/mesh_file.hpp"
#include "condyle/io/pose_text.hpp"
#include "condyle/io/recorded_motion.hpp"
#include "condyle/joint.hpp"
#include "condyle/joint_coordinates.hpp"
#include "condyle/limit_band.hpp"
#include "condyle/make_joint.hpp"
#include "condyle/mesh.hpp"
#include "condyle/motion_contact.hpp"
#include "condyle/pressure.hpp"
#include "condyle/range_of_motion.hpp"

/// Joint files: two meshes and how one rotates in the other, in TOML. Every key, with its unit and default,
/// is in docs/joint-file.md, those of the table [contact] in docs/contact.md. Bad files throw FileError, one line "file: line 7: frame.centre: what is wrong".

namespace condyle::io {

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
  std::vector<contact::HalfSpace> half_spaces;  ///< in the casting body's joint frame
};

/// The body whose moment is reported: the casting one, as for the force, or the target, as OpenSim-JAM prints it.
enum class MomentOn { casting, target };

struct ContactEntry {
  std::string fixed_part = {}, mobile_part = {};  ///< of the bodies; empty: all of it
  contact::Casting casting = contact::Casting::both;
  contact::NormalDepthOptions rays = {};
  contact::PressureLaw law = contact::PressureLaw::linear;
  std::optional<LayerEntry> fixed = {}, mobile = {};
  MomentOn moment_on = MomentOn::casting;
  std::vector<RegionEntry> regions = {};  ///< by name, each once
};

/// The surfaces that an entry speaks of, by their names; in the bodies' joint frames.
struct ContactSurfaces {
  Body fixed, mobile;
};
/// UsageError for a part that a body does not have; the error lists its parts.
[[nodiscard]] ContactSurfaces surfaces_of(const ContactEntry& entry, const Joint& joint);

/// The options of an elastic contact of these surfaces, thicknesses measured or read. FileError for a mesh or a file of
/// thicknesses that cannot be read or has not one for each vertex,
/// MeshError if a vertex of a layer has nothing behind it within the reach and the entry gives no thickness for that.
[[nodiscard]] contact::ElasticContactOptions elastic_options(const ContactEntry& entry,
                                                             const ContactSurfaces& surfaces,
                                                             const LoadedJoint& joint);

/// Values that replace a joint file's entries for its surfaces in contact; only those given replace.
struct ContactChanges {
  std::optional<contact::Casting> casting = {};
  std::optional<contact::FaceRule> rule = {};
  std::optional<double> reach_mm = {};
  std::optional<contact::PressureLaw> law = {};
  /// One for both layers, or one of each: fixed, mobile.
  std::vector<double> youngs_modulus_mpa = {}, poisson_ratio = {}, thickness_mm = {};

  [[nodiscard]] bool any_of_rays() const noexcept { return casting || rule || reach_mm; }
  [[nodiscard]] bool any_of_layers() const noexcept {
    return !youngs_modulus_mpa.empty() || !poisson_ratio.empty() || !thickness_mm.empty();
  }
};

/// The entry with the changes. A body without a layer gets one where modulus, ratio and thickness are all given, and no part
/// of one otherwise; a thickness that is given takes the place of a measured one.
[[nodiscard]] ContactEntry changed(ContactEntry entry, const ContactChanges& changes);

/// Which connected pieces of a mesh are the bone.
enum class PieceRule : std::uint8_t {
  all,
  largest,   ///< largest_piece()
  at_joint,  ///< piece_at() the joint centre, which is stated
};

/// One mesh of a body.
struct MeshEntry {
  std::string part;            ///< its name among several; empty if it is the only one
  std::filesystem::path mesh;  ///< found from the joint file's folder
  std::vector<Repair> repairs;
  PartContact contact = PartContact::ends;  ///< of one of several
  PolygonRule polygons = PolygonRule::refuse;
  PieceRule pieces = PieceRule::all;
  /// Where it lies in the body's frame: p_B = X_BG diag(scale) v, in the file's unit.
  Vec3 scale = Vec3::Ones();
  Pose X_BG = Pose::Identity();

  [[nodiscard]] bool is_moved() const noexcept {
    return scale != Vec3::Ones() || !X_BG.matrix().isIdentity(0);
  }
};

/// A [fixed] or [mobile] table.
struct BodyEntry {
  std::string name;
  std::vector<MeshEntry> meshes;        ///< one or more
  std::optional<BodyImage> image = {};  ///< in the frame of the mesh, mm
  std::optional<Sphere> head = {};      ///< the same
  std::optional<double> bearing_margin_mm = {};
};

/// A joint file's contents, checked one by one; no mesh was read. Lengths were converted to mm.
struct JointFile {
  std::filesystem::path path;
  JointDescription joint;
  BodyEntry fixed, mobile;
  std::vector<motion::Motion> motions;   ///< of the [[motion]] tables, in their order, each name once
  motion::Uncertainty uncertainty = {};  ///< of the [uncertainty] table; default values if it has no entry
  std::uint64_t band_seed = 1;           ///< of the same table
  PoseDegrees reference_pose = {};       ///< digit by digit as the file gives it
  std::optional<ContactEntry> contact = {};                   ///< of the [contact] table
  std::optional<RecordedMotionMapping> recorded_motion = {};  ///< of the [recorded_motion] table
  std::optional<ZeroOfColumns> recorded_zero = {};            ///< of its table zero
  std::optional<plan::Implant> implant = {};                  ///< of the [implant] table
  FileDigest digest = {};
  std::vector<std::string> processing = {};  ///< one line each: what was corrected in reading
};
[[nodiscard]] JointFile read_joint_file(const std::filesystem::path& path);

/// The file itself, its meshes, and what its layers are measured by.
[[nodiscard]] std::vector<std::filesystem::path> files_of(const JointFile& file);

/// Report of how one mesh was placed in the joint.
struct BodyMeshReport {
  std::string part;  ///< as in MeshEntry
  std::filesystem::path mesh;
  std::size_t vertices, triangles;
  std::size_t welded_vertices;  ///< duplicate corners of an STL file that were merged
  std::vector<RepairDone> repairs;
  FileDigest digest = {};  ///< of the file before anything was done to the mesh
  /// p_B = body_from_file v, in the file's unit: the identity for a mesh without a scale or a pose of its own.
  Eigen::Affine3d body_from_file = Eigen::Affine3d::Identity();
  std::string left_out = {};         ///< pieces, in a line
  std::size_t split_polygons = 0;    ///< into triangles
  std::size_t guessed_polygons = 0;  ///< of these, as MeshFile has it
  double guessed_within = 0;         ///< likewise, in the file's unit
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

  /// With its motions and its uncertainty, for answer_range() and the other questions.
  operator Case() const;
};

/// Reads a joint file and its meshes, and makes the joint: docs/joint-frame.md, "Placement", and make_joint().
/// Throws FileError, and MeshError if a fit finds nothing or a repair cannot be made.
[[nodiscard]] LoadedJoint read_joint(const std::filesystem::path& path);

/// The joint at these values of its parts' parameters, as with_parameters() of its `joint`; and the report of that.
[[nodiscard]] LoadedJoint with_parameters(const LoadedJoint& loaded, std::span<const ParameterValue> values);

/// Input of a proposal.
struct ProposalRequest {
  std::filesystem::path fixed, mobile;         ///< mesh files
  std::filesystem::path joint_file;            ///< where it is to lie: meshes are named from its folder
  std::optional<Side> side = {};               ///< default: inferred from the bones
  std::optional<LengthUnit> units = {};        ///< default: inferred from their size
  std::optional<Anatomy> anatomy = {};         ///< which joint it is; default: a hip
  PolygonRule polygons = PolygonRule::refuse;  ///< of both meshes; the file says so too
  Person person = {};  ///< stands in the file; of another species than human no unit is inferred from sizes
  std::optional<std::size_t> mobile_piece = {};  ///< one of femora_in(); default: all of the mesh
  /// Of a hip: the mobile mesh is moved, and not turned, so that the head's sphere has its centre in the socket's. MeshError where either is
  /// not found, and where the radii do not fit.
  bool seat = false;
};

/// The connected pieces of the mobile mesh that are femora, as large as each other and each with its head in a socket of the fixed one; none if there
/// are not two. Throws FileError.
[[nodiscard]] std::vector<std::size_t> femora_in(const ProposalRequest& request);

/// A joint file, complete but for what could not be inferred.
struct JointProposal {
  std::string toml;                     ///< each value with a comment on its evidence
  std::vector<std::string> to_fill_in;  ///< keys that stand in it as comments, with the reason
  std::optional<Side> side;             ///< as the file has it
  std::vector<std::string> evidence;  ///< for side and axes, one line each with its vote; comments in it too
  /// A sentence if the unit was inferred and is not millimetres, or is not the same of both meshes; else empty.
  std::string units_note = {};
};

/// Proposes a joint file for two meshes: kind, centre, axes, side and units, each with the evidence for it. A hip's axes are
/// inferred among the frames in use: RAS, LPS, and X anterior, Y superior, Z right. Where femur, neck, hip bone and the
/// socket's opening lie about the head votes for up and outwards, and so do the far ends of whole bones; the neck's angle
/// in the socket and the hip bone's shape vote for the side. What the votes do not settle, or settle against the given
/// side, is left to fill in; nothing is guessed. Other joints have their axis from condyles, dome or trochlea, their directions
/// from shafts, where the bones show them: docs/other-joints.md. Throws FileError if a mesh cannot be read.
[[nodiscard]] JointProposal propose_joint(const ProposalRequest& request);

// A recorded motion of a joint: from the columns of a table to poses X_FM in the joint frame.

struct JointMotion {
  FrameTimes times;
  std::vector<std::optional<Pose>> X_FM;  ///< in the joint frame; empty for gaps
  std::vector<std::string> processing;    ///< of the table and of its reading
  std::filesystem::path path = {};        ///< of the table
  FileDigest digest = {};
  /// Warnings on its numbers: their unit, ranges, locks.
  std::vector<motion::ContactNote> notes = {};
};

/// By the joint file's [recorded_motion]. Without one the table must have columns named after the joint's coordinates and
/// their units: flexion_deg, internal_rotation_rad, x_mm, z_m; coordinates without a column are 0, and a note says so.
/// Columns of poses are of the frames of the mesh files. FileError as for recorded_coordinates() and recorded_poses(), and
/// for a joint that does not translate if its poses do by more than 1e-6 mm.
[[nodiscard]] JointMotion motion_of(const LoadedJoint& joint, const MotionTable& table);

/// How the mobile body moves in each of those frames, where the table has columns of speeds: "/jointset/knee_r/knee_flex_r/speed" beside
/// ".../value", as OpenSim writes states, in the same unit per second. Empty for gaps, and in all frames if a column that the motion needs has no
/// speed; no entries if none has. By differences of the poses a thousandth of a radian or metre on either side, to some ten digits.
[[nodiscard]] std::vector<std::optional<RelativeMotion>> recorded_speeds(const LoadedJoint& joint,
                                                                         const MotionTable& table);

/// The coordinates of its frames, without gaps.
[[nodiscard]] std::vector<JointCoordinates> coordinates_of(const Joint& joint, const JointMotion& motion);

}  // namespace condyle::io
