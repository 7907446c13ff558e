#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <map>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "condyle/io/joint_file.hpp"
#include "condyle/io/mesh_file.hpp"
#include "condyle/make_joint.hpp"

/// Models of OpenSim (.osim): their joints, and joint files for them. What is read and what is not: docs/models.md.
/// A model's own units throughout: metres, radians.

namespace condyle::io {

struct ModelTransform;
struct CouplerFunction;
/// Kind of a coordinate. A motion file in degrees has degrees for rotational ones only.
enum class CoordinateMotion {
  rotational,     ///< it turns the joint by its own value
  translational,  ///< it moves the joint only
  coupled,        ///< it turns the joint through a function
};
/// "rotational", "translational", "coupled".
[[nodiscard]] std::string_view name_of(CoordinateMotion motion) noexcept;

struct ModelCoordinate {
  std::string name;
  CoordinateMotion motion = CoordinateMotion::rotational;
  double default_value = 0;
  std::optional<std::array<double, 2>> range = {};
  bool is_clamped = true, is_locked = false, is_prescribed = false;
  /// Where forces of the model begin to hold it, CoordinateLimitForce or CoordinateLinearStopForce; of several the narrowest.
  std::optional<std::array<double, 2>> stop = {};
  /// The names of those forces that Condyle did not write, which stay in a copy of the model; empty without any.
  std::string stop_by_others = {};
};

/// "held from -20.5 to 135.25 deg by a force" or m, between these words; empty without such a force.
[[nodiscard]] std::string stop_text(const ModelCoordinate& coordinate, std::string_view before,
                                    std::string_view behind);

/// A joint of a model: X_parent_child(q) = X_PF X_FM(q) X_CM^-1.
struct ModelJoint {
  std::string name = {}, type = {};  ///< "knee_r", "CustomJoint"; the name may be empty
  std::string parent_body = {}, child_body = {};
  Pose X_PF = Pose::Identity(), X_CM = Pose::Identity();
  std::vector<ModelCoordinate> coordinates = {};
  std::shared_ptr<const ModelTransform> transform = {};  ///< null if it cannot be read
  std::string why_not = {};  ///< then one line with the reason, and where it stands
  std::size_t line = 0;
  bool is_reversed = false;  ///< has `reverse`, which exchanges parent and child up to version 30513

  [[nodiscard]] std::vector<double> defaults() const;
};

/// X_parent_child at one value for each coordinate, in their order. Throws UsageError for another number of values, FileError
/// for a joint that cannot be read. 1e-15 of the model's size.
[[nodiscard]] Pose pose_of(const ModelJoint& joint, std::span<const double> q);

/// A mesh that a model attaches to a body: p_body = X_BG diag(scale) v.
struct ModelMesh {
  std::string body = {};
  std::string file = {};  ///< as the model names it
  Vec3 scale = Vec3::Ones();
  Pose X_BG = Pose::Identity();
  std::optional<std::filesystem::path> path = {};     ///< where it was found
  std::vector<std::filesystem::path> looked_in = {};  ///< where it was looked for, if it was not
  std::size_t line = 0;
  std::string why_not =
      {};  ///< one line if its scale or place cannot be read: joints of its body are refused
};

/// A surface in contact of OpenSim-JAM (Smith2018ContactMesh), its layer behind the surface.
struct ModelContactMesh {
  std::string name;
  ModelMesh mesh = {};
  double youngs_modulus_pa = 1e6, poisson_ratio = 0.5;
  double thickness = 0.005;
  bool has_variable_thickness = false;
  std::string back_file = {};
  std::optional<std::filesystem::path> back_path = {};
  double least_thickness = 0.001, greatest_thickness = 0.01;
};

/// A contact of two of them (Smith2018ArticularContactForce).
struct ModelContact {
  std::string name;
  std::string casting = {}, target = {};  ///< names of contact meshes
  double least_proximity = 0, greatest_proximity = 0.01;
  bool is_linear = true, is_lumped = true, applies = true;
  std::size_t line = 0;
};

/// A surface that ligaments wrap, in the frame of its body: WrapSphere, WrapCylinder, WrapEllipsoid or another.
struct ModelWrap {
  std::string name, type, body;
  Pose X_BW = Pose::Identity();
  Vec3 radii = Vec3::Zero();  ///< of an ellipsoid; else the first is the radius
  std::string quadrant = "all";
  bool is_active = true;
  std::string why_not = {};
};

/// A string between two bodies or more (Blankevoort1991Ligament).
struct ModelLigament {
  struct Point {
    std::string body;
    Vec3 p;  ///< in the body's frame
  };
  std::string name;
  std::vector<Point> points = {};
  std::vector<std::string> wraps = {};  ///< names of the surfaces
  double stiffness_n = 0, slack_length = 0, transition_strain = 0.06, damping_n_s = 0;
  bool applies = true;
  std::size_t line = 0;
};

/// A coordinate that follows others (CoordinateCouplerConstraint).
struct ModelCoupler {
  std::string name, dependent = {};
  std::vector<std::string> independent = {};
  std::shared_ptr<const CouplerFunction> function = {};  ///< null if it cannot be read
  std::string why_not = {};
};

/// A note on a model, or on a joint file made from it.
enum class ModelNoteCode : std::uint8_t {
  missing_mesh,         ///< It is left out.
  other_case,           ///< A mesh was found by a name in another case of letters.
  mirrored,             ///< A mesh by its scale factors; its triangles are turned round.
  uneven_scale,         ///< Scale factors of a mesh that differ by more than twice.
  repeated_mesh,        ///< One that is attached twice in one place; it is taken once.
  not_used,             ///< Kinds of components, and how many of each.
  welded,               ///< Bodies that are one.
  oblique_axis,         ///< A hinge does not turn about an axis to the side.
  turned_frame,         ///< The joint's frame, or its body, is turned: which axes its angles are about.
  given_otherwise,      ///< The side or the joint is given, and names say another.
  contact_left_out,     ///< It is not applied, or lacks a surface.
  several_contacts,     ///< Between the two bodies; one is taken.
  measured_thickness,   ///< Near to OpenSim-JAM's, not equal.
  reverse_passed_over,  ///< A joint of a later version has it, and no meaning.
  exchanged_bodies,     ///< The child is the proximal bone: angles have the other sense.
  coupled_coordinate,   ///< It follows others where a motion has no column of it.
  no_length_unit,       ///< length_units says that nobody set one; lengths are metres.
  no_name,              ///< A body or joint without a name, for which nobody can ask.
  ligament_left_out,    ///< It has what no string of two bodies has, or is not applied.
  endless_cylinder,     ///< A ligament wraps a cylinder, whose ends are not looked at.
  unlikely_range,       ///< A coordinate that turns by more than two turns, as degrees typed for radians do.
  left_out,             ///< A component that cannot be read, and why; nothing that was asked for needs it.
};
/// As written: "missing_mesh".
[[nodiscard]] std::string_view name_of(ModelNoteCode code) noexcept;

struct ModelNote {
  ModelNoteCode code;
  std::string text;  ///< one line
};
/// "missing_mesh: ...".
[[nodiscard]] std::string to_text(const ModelNote& note);

struct Model {
  std::filesystem::path path;
  FileDigest digest = {};
  std::string name = {};
  int version = 0;
  std::vector<std::string> bodies = {};  ///< "ground" among them if joints or meshes use it
  std::vector<ModelJoint> joints = {};
  std::vector<ModelMesh> meshes = {};  ///< of all bodies
  std::vector<ModelContactMesh> contact_meshes = {};
  std::vector<ModelContact> contacts = {};
  std::vector<ModelCoupler> couplers = {};
  std::vector<ModelLigament> ligaments = {};
  std::vector<ModelWrap> wraps = {};
  std::map<std::string, std::size_t> ignored = {};  ///< how many of each kind of component are not used here
  std::vector<ModelNote> notes = {};                ///< what was read otherwise than it stands
};

/// Reads a model, and finds its meshes: in the model's folder, its folder Geometry, and the folders given, in this order. No
/// mesh is opened. A joint, mesh or frame that cannot be read is refused where it is needed and leaves the rest as it is. Throws
/// FileError, one line with the line of the file, for what is no model, for two bodies of one name, and for a folder that
/// there is not.
[[nodiscard]] Model read_model(const std::filesystem::path& path,
                               std::span<const std::filesystem::path> geometry_folders = {});

/// The same from memory; the path is what errors call it, and what meshes are found from.
[[nodiscard]] Model read_model(std::string_view bytes, const std::filesystem::path& path,
                               std::span<const std::filesystem::path> geometry_folders = {});

/// The joint of that name. Throws UsageError with the names there are, and FileError for one that cannot be read.
[[nodiscard]] const ModelJoint& joint_named(const Model& model, std::string_view name);

/// The meshes of the parent's or the child's body and of all bodies welded to it, their poses in the body. Throws FileError
/// for a weld that cannot be read.
[[nodiscard]] std::vector<ModelMesh> meshes_of(const Model& model, const ModelJoint& joint, BodyRole role);

/// Options of a joint file that is proposed for a model's joint.
struct ModelJointRequest {
  std::string joint;
  std::filesystem::path joint_file;           ///< where it is to lie: meshes are named from its folder
  std::optional<Anatomy> anatomy = {};        ///< default: by the names of joint and bodies
  std::optional<Side> side = {};              ///< default: by the ending of their names
  std::string contact = {};                   ///< default: the first between the two bodies
  PolygonRule polygons = PolygonRule::split;  ///< of the model's meshes; the file says so too
};

/// A joint file for a joint of a model.
struct ModelJointProposal {
  JointProposal proposal;
  std::vector<ModelNote> notes = {};  ///< what the model has and the file has not
  /// One line if none of a body's meshes was found: the file names them as the model does.
  std::string missing_body = {};
  /// One line if the file cannot be loaded as it stands: a mesh that it names is empty or unreadable.
  std::string unreadable = {};
};

/// Centre, axes, signs, kind, meshes, contact and the columns of a recorded motion as the model has them. Reads the meshes that it
/// names. Throws UsageError if the joint or the contact is not there, or names do not determine joint or side; FileError if the joint cannot be read.
[[nodiscard]] ModelJointProposal propose_joint(const Model& model, const ModelJointRequest& request);

/// The joint itself, as read_joint() would read the proposed file, with the notes among its processing. Throws as both do;
/// FileError if no mesh of a body is there.
[[nodiscard]] LoadedJoint read_joint(const Model& model, const ModelJointRequest& request);

}  // namespace condyle::io
