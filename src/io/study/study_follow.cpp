#include "io/study/study_follow.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "condyle/error.hpp"
#include "io/study/study_joint.hpp"
#include "io/study/study_load.hpp"

namespace condyle::io {

bool may_follow(const StudyTable& table, const StudyOptions& options) {
  return options.follow_load ||
         std::find(table.columns.begin(), table.columns.end(), "follow") != table.columns.end();
}

bool follows(const StudyTable& table, const StudyRow& row, const StudyOptions& options) {
  return options.follow_load || !table.field(row, "follow").empty();
}

StudyFollow::StudyFollow(const StudyTable& table, const StudyRow& row, const LoadedJoint& joint,
                         const StudyOptions& options, RangeRequest& request) {
  const std::filesystem::path file = followed_file(table, row);
  if (options.follow_load && !file.empty())
    throw FileError(fmt::format("{}: the study's load is followed already: leave one of the two out",
                                table.place(row, "follow")));
  if (options.follow_load) {
    follow_load(joint, *options.follow_load, request);
    return;
  }
  if (file.empty()) return;
  try {
    follow(request, joint, motion_of(joint, read_motion_table(file)),
           options.motions.empty() ? MotionsAre::all : MotionsAre::chosen);
  } catch (const UsageError& error) {
    // The motion is the row's, not the study's.
    throw FileError(fmt::format("{}: {}", table.place(row, "follow"), error.what()));
  }
}

void StudyFollow::follow_load(const LoadedJoint& joint, const StudyFollowLoad& given, RangeRequest& request) {
  layers_.emplace(joint, study_contact_of(joint, given.contact));
  contact::BalanceOptions balance;
  for (const Vec3& direction : given.free_directions)
    balance.free_directions.push_back(in_joint_frame(joint.joint, direction));
  request.follow =
      layers_->carrying({.on_mobile = {.force_n = in_joint_frame(joint.joint, given.force_n)}}, balance);
}

}  // namespace condyle::io
