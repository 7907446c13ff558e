#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "condyle/error.hpp"
#include "condyle/io/recorded_motion.hpp"
#include "core/near_name.hpp"
#include "core/predicates.hpp"
#include "io/file/in_quotes.hpp"
#include "io/joint/nearest_rotation.hpp"
#include "io/motion/column_names.hpp"
#include "io/motion/gaps.hpp"

namespace condyle::io {
namespace {

/// Places of a body's sixteen columns, matrix row by row.
using Places = std::array<std::size_t, 16>;

/// Column endings of OpenSim-JAM (initialize() of OpenSim/JAM/JointMechanicsTool.cpp, opensim-jam-org/opensim-core)
/// and of XMALab (saveRigidBodyTransformations() of src/core/Trial.cpp, XROMMPackages/xmalab; row vectors as in
/// Maya).
constexpr std::array<const char*, 16> jam_endings = {"_T11", "_T12", "_T13", "_T14", "_T21", "_T22",
                                                     "_T23", "_T24", "_T31", "_T32", "_T33", "_T34",
                                                     "_T41", "_T42", "_T43", "_T44"};
constexpr std::array<const char*, 16> xmalab_endings = {"_R11", "_R12", "_R13", "_01",  "_R21", "_R22",
                                                        "_R23", "_02",  "_R31", "_R32", "_R33", "_03",
                                                        "_TX",  "_TY",  "_TZ",  "_1"};

enum class Translation { unknown, last_column, last_row };

struct BodyColumns {
  std::string body;
  Places places;
  Translation named_for;  ///< what the program that gives such names writes
};

/// The suffix after "femur_R11" in the first column of that body: empty, or a filter's frequency ("_25Hz").
std::optional<std::string> xmalab_suffix(const MotionTable& table, const std::string& body) {
  const std::string first = body + xmalab_endings.front();
  std::optional<std::string> suffix;
  for (const std::string& column : table.columns) {
    if (!column.starts_with(first)) continue;
    if (suffix)
      throw FileError(fmt::format("{}: body {} has two sets of columns: {} and {}", table.path.string(),
                                  io::in_quotes(body), io::in_quotes(first + *suffix),
                                  io::in_quotes(column)));
    suffix = column.substr(first.size());
  }
  return suffix;
}

/// Names of the bodies of which the file has poses.
std::vector<std::string> bodies_of(const MotionTable& table) {
  std::vector<std::string> bodies;
  for (const std::string& column : table.columns)
    for (const char* first : {jam_endings.front(), xmalab_endings.front()})
      if (const std::size_t at = column.rfind(first); at != column.npos)
        bodies.push_back(column.substr(0, at));
  return bodies;
}

BodyColumns columns_of(const MotionTable& table, const std::string& body) {
  const auto place = [&](const std::string& name) {
    return static_cast<std::size_t>(std::find(table.columns.begin(), table.columns.end(), name) -
                                    table.columns.begin());
  };
  BodyColumns columns{body, {}, Translation::last_column};
  const bool of_jam = place(body + jam_endings.front()) < table.columns.size();
  const auto suffix = of_jam ? std::string() : xmalab_suffix(table, body);
  if (!suffix) {
    const std::vector<std::string> bodies = bodies_of(table);
    throw FileError(
        fmt::format("{}: has no columns of body {}{}: they are named {}_T11 to {}_T44, or {}_R11 to {}_1{}",
                    table.path.string(), io::in_quotes(body), core::did_you_mean(body, bodies), body, body,
                    body, body, those_there(bodies.empty() ? table.columns : bodies)));
  }
  if (!of_jam) columns.named_for = Translation::last_row;
  for (std::size_t i = 0; i < columns.places.size(); ++i) {
    const std::string name = body + (of_jam ? jam_endings[i] : xmalab_endings[i]) + *suffix;
    columns.places[i] = place(name);
    if (columns.places[i] == table.columns.size())
      throw FileError(fmt::format("{}: has no column {}", table.path.string(), io::in_quotes(name)));
  }
  return columns;
}

/// The matrix of one row; nothing if it has a gap.
std::optional<Eigen::Matrix4d> matrix_of(const MotionTable& table, const BodyColumns& columns,
                                         std::size_t row) {
  Eigen::Matrix4d matrix;
  for (std::size_t i = 0; i < columns.places.size(); ++i)
    matrix(static_cast<Eigen::Index>(i / 4), static_cast<Eigen::Index>(i % 4)) =
        table.values[columns.places[i]][row];
  return matrix.hasNaN() ? std::nullopt : std::optional(matrix);
}

[[noreturn]] void fail(const MotionTable& table, std::size_t row, const std::string& body,
                       std::string_view what) {
  throw FileError(fmt::format("{}: line {}: the matrix of {} {}", table.path.string(), table.line_of_row[row],
                              io::in_quotes(body), what));
}

/// 0 0 0 1, to what nine digits leave of computed ones.
bool is_0001(const Eigen::Vector4d& v) {
  return (v - Eigen::Vector4d::UnitW()).cwiseAbs().maxCoeff() <= 1e-9;
}

/// Where the translations of a file stand. Every matrix with a translation must say the same.
class FindTranslation {
 public:
  explicit FindTranslation(const MotionTable& table) : table_(&table) {}

  void see(const Eigen::Matrix4d& matrix, std::size_t row, const std::string& body) {
    const bool in_column = is_0001(matrix.row(3).transpose()), in_row = is_0001(matrix.col(3));
    if (!in_column && !in_row)
      fail(*table_, row, body, "has 0 0 0 1 neither in its last row nor in its last column");
    if (in_column && in_row) return;
    const Translation here = in_column ? Translation::last_column : Translation::last_row;
    if (found != Translation::unknown && found != here)
      fail(*table_, row, body,
           fmt::format("has 0 0 0 1 in its last {0}, and those before it in their last {1}",
                       in_column ? "row" : "column", in_column ? "column" : "row"));
    found = here;
  }

  Translation found = Translation::unknown;

 private:
  const MotionTable* table_;
};

/// Rotations off by up to this are printed or computed with few digits; beyond it a matrix is scaled or sheared.
constexpr double most_off = 1e-4;
/// Beyond this it is said. Twelve printed digits leave 1e-12, floats 1e-7.
constexpr double said_beyond = 1e-9;

/// Error from rounding a rotation's own entries: three products of entries that are each half a unit off.
constexpr double off_as_doubles_are = 8 * core::rounding_unit;

struct WorstRotation {
  double off = 0;
  std::size_t row = 0;
  std::string body;
};

Eigen::Matrix3d rotation_of(const MotionTable& table, const Eigen::Matrix3d& R, std::size_t row,
                            const std::string& body, WorstRotation& worst) {
  const double off = io::orthonormality_error(R);
  if (!(off <= most_off))
    fail(table, row, body, fmt::format("is no rotation: off by {:.2g}, more than {}", off, most_off));
  if (R.determinant() < 0) fail(table, row, body, "is a reflection, not a rotation: its determinant is -1");
  if (off > worst.off) worst = {off, row, body};
  return off <= off_as_doubles_are ? R : io::nearest_rotation(R);
}

}  // namespace

RecordedPoses recorded_poses(const MotionTable& table, const ColumnsOfPoses& mapping) {
  const BodyColumns fixed = columns_of(table, mapping.fixed_body),
                    mobile = columns_of(table, mapping.mobile_body);
  RecordedPoses out;
  out.times = frame_times(table);
  out.processing = table.processing;

  FindTranslation translation(table);
  for (std::size_t row = 0; row < table.rows; ++row)
    for (const BodyColumns* columns : {&fixed, &mobile})
      if (const auto matrix = matrix_of(table, *columns, row)) translation.see(*matrix, row, columns->body);
  if (translation.found == Translation::unknown)
    out.processing.push_back(
        "no matrix has a translation: the names of the columns say which way its rotations are meant");

  WorstRotation worst;
  const auto pose = [&](const BodyColumns& columns, std::size_t row) -> std::optional<Pose> {
    auto matrix = matrix_of(table, columns, row);
    if (!matrix) return std::nullopt;
    const Translation stands =
        translation.found == Translation::unknown ? columns.named_for : translation.found;
    if (stands == Translation::last_row) matrix->transposeInPlace();
    Pose X = Pose::Identity();
    X.linear() = rotation_of(table, matrix->topLeftCorner<3, 3>(), row, columns.body, worst);
    X.translation() = mm_per(mapping.unit) * matrix->topRightCorner<3, 1>();
    return X;
  };
  for (std::size_t row = 0; row < table.rows; ++row) {
    const auto X_LF = pose(fixed, row), X_LM = pose(mobile, row);
    out.X_FM.push_back(X_LF && X_LM ? std::optional<Pose>(inverted(*X_LF) * *X_LM) : std::nullopt);
  }
  if (worst.off > said_beyond)
    out.processing.push_back(
        fmt::format("rotations are orthonormal to {:.2g} only (line {}, {}): the nearest ones are used",
                    worst.off, table.line_of_row[worst.row], io::in_quotes(worst.body)));
  io::note_gaps(table, out.X_FM, out.processing);
  return out;
}

}  // namespace condyle::io
