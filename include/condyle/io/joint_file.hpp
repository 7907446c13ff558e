#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "condyle/fit_cylinder.hpp"
#include "condyle/fit_sphere.hpp"
#include "condyle/inspect.hpp"
#include "condyle/joint.hpp"
#include "condyle/joint_frame.hpp"
#include "condyle/length_unit.hpp"
#include "condyle/range_of_motion.hpp"

/// Joint files: two meshes and how one turns in the other, in TOML. Every key, with its unit and default, is
/// in docs/joint-file.md. Bad files throw FileError, one line "file: line 7: frame.centre: what is wrong".

namespace condyle {

/// Repairs that lose nothing, by the names joint files and the command line give them.
enum class Repair { weld, drop_unreferenced, flip_inverted };

/// The repair of that name; throws UsageError with the names there are.
Repair repair_named(std::string_view name);
std::string_view name_of(Repair repair) noexcept;

/// A repair that was made: how many vertices went, or triangles were turned.
struct RepairDone {
  Repair repair;
  std::size_t count;
};

/// Makes the repairs in this order. Throws MeshError where one cannot be made.
std::vector<RepairDone> repair_mesh(TriMesh& mesh, const std::vector<Repair>& repairs);

/// "welded 12 vertices", for reports.
std::string describe(const RepairDone& done);

enum class BodyRole { fixed, mobile };

/// A [fixed] or [mobile] table.
struct BodyEntry {
  std::string name;
  std::filesystem::path mesh;  ///< found from the joint file's folder
  std::vector<Repair> repairs;
};

/// The directions of a [frame] table, as written: orthonormal within axis_tolerance or refused when used.
struct FrameDirections {
  Vec3 anterior, superior;
};

/// `centre = "fit"` and what limits it.
struct CentreFit {
  BodyRole body = BodyRole::mobile;
  std::optional<Sphere> within;  ///< mm, in the frame of the meshes
};

/// Where a joint's frame comes from; all lengths in mm, in the frame of the meshes.
struct FrameEntry {
  /// Empty where the landmarks give it.
  std::variant<std::monostate, Vec3, CentreFit> centre;
  std::variant<FrameDirections, PelvisLandmarks, AnteriorPelvicPlane, FemurLandmarks, TransepicondylarAxis>
      axes;
};

/// A joint file's contents, checked one by one; no mesh was read. Lengths were converted to mm.
struct JointFile {
  std::filesystem::path path;
  std::string name;
  JointKind kind;
  Side side;
  LengthUnit units;  ///< of the meshes
  BodyEntry fixed, mobile;
  FrameEntry frame;
  JointAngles reference_pose;   ///< of the mobile mesh as it is given
  std::vector<Motion> motions;  ///< of the [[motion]] tables, in their order, each name once
};
JointFile read_joint_file(const std::filesystem::path& path);

/// What became of one mesh on its way into the joint.
struct BodyReport {
  std::filesystem::path mesh;
  std::size_t vertices, triangles;
  std::size_t welded_vertices;  ///< corners of an STL file that became one vertex
  std::vector<RepairDone> repairs;
  BoundingBox bounds;  ///< in the joint frame, at zero angles, mm
};

/// What was done to make a joint of a file, for reading and for checking.
struct JointReport {
  JointFile file;
  BodyReport fixed, mobile;
  Pose X_WF;                            ///< the joint frame in the frame of the meshes, mm
  std::optional<SphericalPatch> head;   ///< the fit that gave the centre of a ball
  std::optional<CylinderFit> cylinder;  ///< the fit that gave the axis of a hinge
  Angle axis_turn;                      ///< from the Z axis that the file gives to the fitted one
  AxisErrors axis_errors{0, 0, 0};      ///< of the directions as written; removed
  std::vector<std::string> notes;  ///< one line each: what was converted, repaired, fitted, or looks wrong
};

struct LoadedJoint {
  Joint joint;
  JointReport report;
};

/// Reads a joint file and its meshes, and places both in the joint frame (docs/joint-file.md, "Placement"):
/// every coordinate is computed in extended precision and rounded once. Where the file asks for millimetres,
/// a centre of 0, the standard axes and no reference pose, vertices keep every bit. Throws FileError, and
/// MeshError where a fit finds nothing or a repair cannot be made.
LoadedJoint read_joint(const std::filesystem::path& path);

}  // namespace condyle
