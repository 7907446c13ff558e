#pragma once

#include <array>
#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "condyle/io/mesh_file.hpp"
#include "condyle/joint_coordinates.hpp"
#include "condyle/mesh.hpp"
#include "condyle/motion_contact.hpp"
#include "condyle/pose.hpp"

/// From a table of a recorded motion to one set of coordinates or one pose per frame. A mapping says which columns mean
/// what; nothing is guessed. A frame with a gap in a column that is needed stays a gap: nothing is interpolated.

namespace condyle::io {

/// A recorded motion as its file has it: a table of numbers with named columns, nothing converted.
struct MotionTable {
  std::filesystem::path path;        ///< as given, for messages
  std::vector<std::string> columns;  ///< one name each, no two the same; the column of times is among them
  std::size_t rows = 0;              ///< at least one
  /// One vector of `rows` numbers per column. NaN if the file has a gap (`nan`, an empty CSV cell), never inf.
  std::vector<std::vector<double>> values;
  std::vector<std::size_t> line_of_row;  ///< line of the file, from 1, for messages
  /// Value of `inDegrees=` in an OpenSim header, which applies to angles; empty if the header has none.
  std::optional<bool> in_degrees;
  std::vector<std::string> processing;  ///< where the file contradicts itself and was read nevertheless
  FileDigest digest;
};

/// Reads .mot and .sto (OpenSim) or .csv (comma; the first row has the names, lines with # are comments); the extension
/// decides, in upper or lower case. What is accepted: docs/motion-files.md. Line ends of any system, a byte order mark
/// and empty lines at the end are passed over; numbers are read the same in every locale.
/// Raises FileError, one line "file: line N: column 'x': what is wrong", where rows and names differ in number, a cell
/// has no number or an infinite one, two columns share a name, times do not increase, or a header or all rows are missing.
[[nodiscard]] MotionTable read_motion_table(const std::filesystem::path& path);

/// When each row was.
struct FrameTimes {
  std::vector<double> values;  ///< strictly increasing
  bool in_seconds = true;      ///< else numbers of frames
};

/// The column `time` or `time_s` in seconds; without one the column `Frame`, or else frames counted from 0. Case does not count.
[[nodiscard]] FrameTimes frame_times(const MotionTable& table);

enum class CoordinateKind { angle, length };
enum class ColumnUnit { degrees, radians, millimetres, metres };

/// As in files: "deg", "rad", "mm", "m".
[[nodiscard]] std::string_view name_of(ColumnUnit unit) noexcept;

/// A coordinate of a joint and the column that records it: value = sign * column + offset.
struct ColumnOfCoordinate {
  std::string coordinate = {};  ///< its name in the joint
  CoordinateKind kind = CoordinateKind::angle;
  /// The column's name. For "/jointset/knee_r/knee_flex_r/value", as OpenSim writes states, "knee_flex_r" does too where
  /// no other column has it.
  std::string column = {};
  /// Unit of the column. An angle without one is as the file's header says, and must not contradict it; a length must
  /// have one.
  std::optional<ColumnUnit> unit = {};
  double sign = 1;    ///< 1 or -1
  double offset = 0;  ///< degrees or mm
  /// Stands in for the column, in degrees or mm, in a table that has no such column.
  std::optional<double> otherwise = {};
  /// The column's lowest and highest value by the model that it is of, degrees or mm. It changes no pose: frames beyond it
  /// are noted.
  std::optional<std::array<double, 2>> range = {};
  bool is_locked = false;  ///< by that model, at `otherwise`; likewise
};

/// Where columns of coordinates are zero and what their angles turn about, whatever the joint's own zero, axes and side are. With a the
/// coordinates by the columns and a0 those by columns of 0, the mobile body C of whoever recorded them lies in the fixed one P at
///
///     X_PC(a) = X_PZ pose_at(a) pose_at(a0)^-1 X_PZ^-1 X_PC
struct ZeroOfColumns {
  CoordinateSystem system = {};
  TranslationFrame translation_frame = TranslationFrame::fixed;
  Pose X_PZ = Pose::Identity(), X_PC = Pose::Identity();  ///< mm
  Pose X_AP = Pose::Identity(),
       X_BC = Pose::Identity();  ///< these bodies in the frames of the joint's own meshes
  /// What load_joint() makes of them: X_FM = X_FZ pose_at(a) X_YM. Exactly the identity if the joint's zero and axes are these.
  Pose X_FZ = Pose::Identity(), X_YM = Pose::Identity();
};

/// Columns with poses of both bodies, 16 per body, in one frame L of a laboratory or scanner.
struct ColumnsOfPoses {
  std::string fixed_body, mobile_body;  ///< as the names of columns begin: "femur" of "femur_T11"
  LengthUnit unit = LengthUnit::millimetres;
};

/// The joint of an OpenSim model that poses the bodies: its functions take the columns of its coordinates.
struct PosesOfModel {
  std::filesystem::path model;
  std::string joint;
  std::optional<bool> in_degrees = {};  ///< of rotational coordinates, where no header says it
};

using RecordedMotionMapping = std::variant<std::vector<ColumnOfCoordinate>, ColumnsOfPoses, PosesOfModel>;

/// Coordinates of every frame, by name.
struct NamedCoordinates {
  FrameTimes times;
  std::vector<std::string> names;
  /// Per frame one value for each name, in degrees or mm; nothing if one of their columns has a gap.
  std::vector<std::optional<std::vector<double>>> frames;
  std::vector<std::string> processing;          ///< of the table and of this reading
  std::vector<motion::ContactNote> notes = {};  ///< values that the columns' ranges and locks do not allow
};

/// Raises FileError for a column that is not there (naming one that was most likely meant) or could be two, and for an
/// angle whose unit neither the mapping nor the file's header gives, or both and not the same. Lengths must have a unit.
[[nodiscard]] NamedCoordinates recorded_coordinates(const MotionTable& table,
                                                    const std::vector<ColumnOfCoordinate>& mapping);

/// Poses of every frame.
struct RecordedPoses {
  FrameTimes times;
  /// X_FM = X_LF^-1 X_LM of the bodies' own frames, translation in mm; nothing if one of the 32 cells is a gap.
  std::vector<std::optional<Pose>> X_FM;
  std::vector<std::string> processing;          ///< of the table and of this reading
  std::vector<motion::ContactNote> notes = {};  ///< of a model: values that its ranges and locks do not allow
};

/// Poses from matrices of 4 x 4 numbers, row by row, in columns named
///   femur_T11 femur_T12 ... femur_T44                     (OpenSim-JAM: p_L = T p, translation in the last column), or
///   femur_R11 femur_R12 femur_R13 femur_01 femur_R21 ... femur_TX femur_TY femur_TZ femur_1, with an ending such as _25Hz
///                                                         (XMALab: row vectors, translation in the last row).
/// The position of 0 0 0 1 determines the convention, whatever the names; the names decide only if no translation
/// differs from 0. Rotations are the nearest ones to those of the file (singular values); a note reports the
/// deviation of the file's if it is beyond 1e-9. Raises FileError for columns that are missing, for 0 0 0 1 in
/// neither place or in both by turns, and for a row whose rotation is off by more than 1e-4 or is a reflection.
[[nodiscard]] RecordedPoses recorded_poses(const MotionTable& table, const ColumnsOfPoses& mapping);

}  // namespace condyle::io
