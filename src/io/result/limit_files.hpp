#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "answer/records/limit_box_record.hpp"
#include "condyle/io/joint_file.hpp"
#include "condyle/io/provenance.hpp"
#include "io/model/model_limits.hpp"

/// Limits for other programs: docs/limits-for-programs.md.

namespace condyle::io {

/// What is written where; the ending says in which format: .osim, .xml of MuJoCo, .csv of coupled limits.
struct LimitFile {
  std::filesystem::path path;
  StopForce stop = StopForce::limit;  ///< of .osim
  std::optional<std::filesystem::path> model =
      {};                                  ///< of .osim: whose copy it is; else a fragment is written
  LimitSource source = LimitSource::bony;  ///< bony, or living where studies say so
};

/// The coordinates by which the program knows the joint: those of the model that the joint was read from, by [recorded_motion], or for .xml and .csv without
/// them the joint's own angles. To be called before long work. Throws UsageError for another ending, for a model or a linear stop with another than .osim, for
/// coupled limits of a hinge or of living joints, and for .osim if no model was read into the joint or if the model poses it; FileError where the file could not
/// be written, or would replace one that was read.
std::vector<TurningCoordinate> limit_coordinates(const LoadedJoint& joint, const LimitFile& file,
                                                 const Provenance* from);

/// Lines on a box: each end, whose it is, and how far it is from coupled limits.
std::string limit_box_text(const LimitBoxRecord& box);

/// Throws FileError.
void write_limits(const LimitFile& file, const LimitBoxRecord& box, const LoadedJoint& joint,
                  const Provenance* from);

}  // namespace condyle::io
