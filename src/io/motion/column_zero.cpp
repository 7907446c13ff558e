#include "io/motion/column_zero.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <utility>

#include "condyle/error.hpp"
#include "condyle/io/pose_text.hpp"
#include "condyle/io/provenance.hpp"
#include "io/joint/load_joint.hpp"

namespace condyle::io {
namespace {

/// The coordinates where the columns have these values.
JointCoordinates coordinates_where(std::span<const ColumnOfCoordinate> columns, std::vector<double> values,
                                   Anatomy joint) {
  for (std::size_t i = 0; i < columns.size(); ++i)
    values[i] = columns[i].sign * values[i] + columns[i].offset;
  return coordinates_by(columns, values, joint);
}

/// pose_at() where all columns are 0.
Pose at_columns_of_0(const ZeroOfColumns& zero, std::span<const ColumnOfCoordinate> columns, Anatomy joint) {
  return pose_at(zero.system, coordinates_where(columns, std::vector<double>(columns.size()), joint),
                 zero.translation_frame);
}

/// A joint file's numbers have 17 digits, and poses of a metre are off by some 1e-13 mm for each product.
bool is_same_frame(const Pose& X) {
  constexpr double rounding = 1e-8;
  return X.matrix().isIdentity(rounding) && X.translation().norm() < rounding;
}

std::string exact_numbers(const Vec3& v) {
  return fmt::format("[{}, {}, {}]", v.x() + 0.0, v.y() + 0.0, v.z() + 0.0);  // no -0
}

}  // namespace

JointCoordinates coordinates_by(std::span<const ColumnOfCoordinate> columns, std::span<const double> values,
                                Anatomy joint) {
  JointCoordinates at;
  for (std::size_t i = 0; i < columns.size(); ++i) {
    const ColumnOfCoordinate& column = columns[i];
    if (column.kind == CoordinateKind::length)
      at.translation_mm[column.coordinate[0] - 'x'] = values[i];
    else
      at.angles = motion::turned_by(at.angles, joint_angle_named(column.coordinate, joint),
                                    Angle::degrees(values[i]));
  }
  return at;
}

Pose pose_by(const ZeroOfColumns& zero, std::span<const ColumnOfCoordinate> columns,
             std::span<const double> values, Anatomy joint) {
  return zero.X_PZ *
         pose_at(zero.system, coordinates_where(columns, {values.begin(), values.end()}, joint),
                 zero.translation_frame) *
         inverted(zero.X_PZ * at_columns_of_0(zero, columns, joint)) * zero.X_PC;
}

BodyFrames body_frames(const LoadedJoint& joint) {
  const Provenance from = provenance_of(joint, {});
  const auto joint_from_file = [&](const MeshOrigin& origin) {
    Pose X = Pose::Identity();
    X.linear() = origin.joint_from_source.linear() / mm_per(joint.report.file.joint.units);
    X.translation() = origin.joint_from_source.translation();
    return X;
  };
  return {joint_from_file(from.fixed), joint_from_file(from.mobile)};
}

ZeroOfColumns zero_in_joint(ZeroOfColumns zero, std::span<const ColumnOfCoordinate> columns,
                            const LoadedJoint& joint) {
  const BodyFrames frames = body_frames(joint);
  zero.X_FZ = frames.X_FA * zero.X_AP * zero.X_PZ;
  zero.X_YM = inverted(zero.X_PZ * at_columns_of_0(zero, columns, joint.joint.anatomy)) * zero.X_PC *
              inverted(frames.X_MB * zero.X_BC);
  if (is_same_frame(zero.X_FZ) && is_same_frame(zero.X_YM)) zero.X_FZ = zero.X_YM = Pose::Identity();
  return zero;
}

bool is_moved(const ZeroOfColumns& zero, const Joint& joint) noexcept {
  return zero.system != joint.coordinates() || zero.translation_frame != joint.translation_frame ||
         !zero.X_FZ.matrix().isIdentity(0) || !zero.X_YM.matrix().isIdentity(0);
}

ZeroOfColumns zero_of(const LoadedJoint& joint, std::span<const ColumnOfCoordinate> columns) {
  if (const auto& zero = joint.report.file.recorded_zero) return *zero;
  const BodyFrames frames = body_frames(joint);
  ZeroOfColumns zero{.system = joint.joint.coordinates(),
                     .translation_frame = joint.joint.translation_frame,
                     .X_PZ = inverted(frames.X_FA)};
  zero.X_PC = zero.X_PZ * at_columns_of_0(zero, columns, joint.joint.anatomy) * frames.X_MB;
  return zero;
}

LoadedJoint joint_in(const ZeroOfColumns& zero, const LoadedJoint& joint,
                     std::span<const ColumnOfCoordinate> columns) {
  JointFile file = joint.report.file;
  if (joint.joint.posed || file.implant)
    throw UsageError(
        "the joint has another zero or other axes than [recorded_motion.zero], and parts that lie in its "
        "own: "
        "no limits are written in the angles of the columns");
  JointDescription& description = file.joint;
  const Pose X_WP = description.fixed_in_W * zero.X_AP, X_WZ = X_WP * zero.X_PZ;
  description.frame = {.centre = Vec3(X_WZ.translation()),
                       .axes = FrameDirections{X_WZ.linear().col(0), X_WZ.linear().col(1)}};
  description.mobile_in_W = X_WP * zero.X_PC * inverted(zero.X_BC);
  description.reference_pose =
      coordinates_where(columns, std::vector<double>(columns.size()), description.anatomy);
  description.zero_from = ZeroFrom::as_given;
  description.anatomy = zero.system.anatomy, description.side = zero.system.side;
  description.translation_frame = zero.translation_frame;
  // What a slack length follows from is said in the joint's own angles.
  for (std::size_t i = 0; i < description.ligaments.size(); ++i) {
    description.ligaments[i].taut_at.reset(), description.ligaments[i].slack_share.reset();
    description.ligaments[i].ligament.slack_length_mm = joint.joint.ligaments.at(i).slack_length_mm;
  }
  return load_joint(std::move(file));
}

std::string zero_text(const ZeroOfColumns& zero, double mm) {
  std::string text = fmt::format(
      "\n[recorded_motion.zero]  # what the columns count from, whatever [frame], side and [reference_pose] "
      "say\n"
      "joint = \"{}\"\nside = \"{}\"\ncentre = {}\nanterior = {}\nsuperior = {}\n",
      name_of(zero.system.anatomy), name_of(zero.system.side), exact_numbers(zero.X_PZ.translation() / mm),
      exact_numbers(zero.X_PZ.linear().col(0)), exact_numbers(zero.X_PZ.linear().col(1)));
  const std::pair<const char*, const Pose&> poses[] = {
      {"pose", zero.X_PC}, {"fixed", zero.X_AP}, {"mobile", zero.X_BC}};
  for (const auto& [key, X] : poses) {
    if (X.matrix().isIdentity(0)) continue;
    std::vector<double> rows;
    for (int i = 0; i < 16; ++i) rows.push_back(X(i / 4, i % 4) / (i % 4 == 3 && i < 12 ? mm : 1) + 0.0);
    text += fmt::format("{} = [{}]\n", key, fmt::join(rows, ", "));
  }
  return text;
}

std::string zero_text_in_joint(ZeroOfColumns zero, std::span<const ColumnOfCoordinate> columns,
                               const Joint& joint) {
  zero.X_AP = zero.X_FZ * inverted(zero.X_PZ);
  zero.X_BC = inverted(zero.X_PZ * at_columns_of_0(zero, columns, joint.anatomy) * zero.X_YM) * zero.X_PC;
  return zero_text(zero, 1);
}

}  // namespace condyle::io
