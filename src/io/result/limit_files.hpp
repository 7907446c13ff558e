#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "answer/records/limit_box_record.hpp"
#include "condyle/io/joint_file.hpp"
#include "condyle/io/provenance.hpp"
#include "io/model/model_limits.hpp"
#include "io/motion/curve_files.hpp"

/// Limits for other programs: docs/limits-for-programs.md.

namespace condyle::io {

/// What is written where; the ending says in which format: .osim, .xml of MuJoCo, .csv of coupled limits.
struct LimitFile {
  std::filesystem::path path;
  StopForce stop = StopForce::limit;  ///< of .osim
  std::optional<std::filesystem::path> model =
      {};                                  ///< of .osim: whose copy it is; else a fragment is written
  LimitSource source = LimitSource::bony;  ///< bony, or living where studies say so
  AngleUnit angles = AngleUnit::degrees;   ///< of .xml
};

/// The coordinates by which a program knows a joint.
struct LimitCoordinates {
  std::vector<TurningCoordinate> coordinates;
  /// The joint by whose angles they are known, where its own zero, axes or side are others: joint_in().
  std::optional<LoadedJoint> in_zero = {};
};

/// Those of the model that the joint was read from, by [recorded_motion], or for .xml and .csv without them the joint's own angles. To be called before
/// long work. `holds_translation`: somebody said at which translation a free joint is held. Throws UsageError for another ending; for a model, a linear stop or
/// radians with a file that has none; for coupled limits of a hinge or of living joints; for .osim if no model was read into the joint; for .osim and .xml if the
/// model poses it; and for a free joint whose recorded motion moves the translation that nobody said. FileError where the file could not be written, or would
/// replace one that was read, and for a model that poses the joint otherwise than the joint file, or in which a constraint moves it.
LimitCoordinates limit_coordinates(const LoadedJoint& joint, const LimitFile& file, const Provenance* from,
                                   bool holds_translation);

/// limit_box_record() in the zero of the coordinates; `answer` is of `request` about the joint itself.
std::optional<LimitBoxRecord> limit_box(const LimitCoordinates& known_by, const Case& joint,
                                        const RangeAnswer& answer, const RangeRequest& request,
                                        LimitSource source, const Control& control);

/// Lines on a box: each end, whose it is, and how far it is from coupled limits.
std::string limit_box_text(const LimitBoxRecord& box);

/// Throws FileError.
void write_limits(const LimitFile& file, const LimitBoxRecord& box, const LoadedJoint& joint,
                  const LimitCoordinates& known_by, const Provenance* from);

}  // namespace condyle::io
