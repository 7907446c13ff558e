#pragma once

#include <span>
#include <string>

#include "condyle/io/joint_file.hpp"

namespace condyle::io {

/// The coordinates of one frame from a value for the coordinate of each column, degrees or mm; those without a column are 0. `joint`: whose
/// names they have.
JointCoordinates coordinates_by(std::span<const ColumnOfCoordinate> columns, std::span<const double> values,
                                Anatomy joint);

/// X_PC where the columns themselves have these values.
Pose pose_by(const ZeroOfColumns& zero, std::span<const ColumnOfCoordinate> columns,
             std::span<const double> values, Anatomy joint);

/// Where the frames of the mesh files, A and B, lie in the joint's, lengths in mm.
struct BodyFrames {
  Pose X_FA, X_MB;
};
BodyFrames body_frames(const LoadedJoint& joint);

/// With X_FZ and X_YM of this joint.
ZeroOfColumns zero_in_joint(ZeroOfColumns zero, std::span<const ColumnOfCoordinate> columns,
                            const LoadedJoint& joint);

/// Whether the joint has another zero, other axes or another side than the columns.
bool is_moved(const ZeroOfColumns& zero, const Joint& joint) noexcept;

/// The columns' zero as the file says it, or that of the joint itself, in the frames of its meshes.
ZeroOfColumns zero_of(const LoadedJoint& joint, std::span<const ColumnOfCoordinate> columns);

/// The joint as the columns have it: their zero, axes and side in place of its own. Reads its meshes anew. Throws UsageError for a joint
/// with parts that move or an implant, which lie in its own axes.
LoadedJoint joint_in(const ZeroOfColumns& zero, const LoadedJoint& joint,
                     std::span<const ColumnOfCoordinate> columns);

/// The table [recorded_motion.zero]; lengths of `zero` are in mm, those of the file in units of `mm`.
std::string zero_text(const ZeroOfColumns& zero, double mm);

/// The same for meshes that were written in the joint's frames, mm.
std::string zero_text_in_joint(ZeroOfColumns zero, std::span<const ColumnOfCoordinate> columns,
                               const Joint& joint);

}  // namespace condyle::io
