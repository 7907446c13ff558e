#include "follow_options.hpp"

#include <CLI/App.hpp>

#include "answer.hpp"
#include "choice.hpp"
#include "condyle/error.hpp"
#include "condyle/io/recorded_motion.hpp"

namespace condyle::cli {

void add_follow(CLI::App& command, FollowArguments& given, const std::vector<CLI::Option*>& excluded) {
  auto* record = command.add_option(
      "--follow", given.record,
      "Do not hold the centre of a free joint: its translation at each angle is that of this recorded "
      "motion, .mot, .sto or .csv, as condyle motion reads it. Limits are then bounded, not exact");
  record->option_text("FILE");
  auto* load =
      add_flag(command, "--follow-load", given.load, true,
               "Do not hold the centre of a free joint: at each angle the layers of [contact] carry --force");
  add_force(command, given.balance, "With --follow-load: the force on the mobile body");
  load->excludes(record);
  for (CLI::Option* other : excluded)
    for (CLI::Option* following : {record, load}) following->excludes(other);
}

std::vector<std::string> follow_names() {
  return {"--follow", "--follow-load", "--force", "--force-frame", "--along"};
}

Followed::Followed(const FollowArguments& given, const io::LoadedJoint& loaded, io::MotionsAre motions,
                   RangeRequest& request) {
  if (given.balance.any() && !given.load)
    throw UsageError("--force: only a translation that follows a load takes one: --follow-load");
  if (given.load) {
    if (given.balance.force.empty()) throw UsageError("--follow-load: needs --force");
    layers_.emplace(loaded, contact_of({}, loaded.report.file, true));
    request.follow =
        layers_->carrying(load_of(given.balance), balance_options_of(given.balance, loaded.joint));
  }
  if (given.record.empty()) return;
  const io::JointMotion recorded = io::motion_of(loaded, io::read_motion_table(given.record));
  for (const std::string& remark : recorded.processing) note(remark);
  io::follow(request, loaded, recorded, motions);
}

}  // namespace condyle::cli
