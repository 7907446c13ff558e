#pragma once

#include <optional>

#include "condyle/answer.hpp"
#include "condyle/io/joint_file.hpp"
#include "condyle/io/study.hpp"
#include "io/motion/follow.hpp"
#include "io/study/study_table.hpp"

namespace condyle::io {

/// Whether limits of a study may be those of a joint whose centre is not held: by a column `follow`, or a load.
bool may_follow(const StudyTable& table, const StudyOptions& options);

/// Whether the limits of this row follow.
bool follows(const StudyTable& table, const StudyRow& row, const StudyOptions& options);

/// Source of the translation of a row's joint: its recorded motion, or the study's load. Outlives the request.
class StudyFollow {
 public:
  /// Makes the request follow it, or leaves it. Throws FileError for a motion that the joint cannot follow, and for a joint without
  /// layers; UsageError for a load that is none.
  StudyFollow(const StudyTable& table, const StudyRow& row, const LoadedJoint& joint,
              const StudyOptions& options, RangeRequest& request);

 private:
  void follow_load(const LoadedJoint& joint, const StudyFollowLoad& given, RangeRequest& request);

  std::optional<FollowedLayers> layers_;
};

}  // namespace condyle::io
