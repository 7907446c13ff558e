#pragma once

#include <CLI/App.hpp>
#include <optional>
#include <string>
#include <vector>

#include "condyle/answer.hpp"
#include "condyle/io/joint_file.hpp"
#include "contact_options.hpp"
#include "io/motion/follow.hpp"

/// --follow, --follow-load and --force, shared by the commands that answer for a range of motion.

namespace condyle::cli {

struct FollowArguments {
  std::string record;
  bool load = false;
  BalanceArguments balance;
};

/// `excluded`: options of which neither the one nor the other may be given beside.
void add_follow(CLI::App& command, FollowArguments& given, const std::vector<CLI::Option*>& excluded);

/// Their names, for a group of the help.
std::vector<std::string> follow_names();

/// The record or load that a request follows; the request points to it. Notes how the recorded motion was read.
class Followed {
 public:
  /// Makes the request follow what is given, or leaves it. UsageError for a load without a force and the reverse.
  Followed(const FollowArguments& given, const io::LoadedJoint& loaded, io::MotionsAre motions,
           RangeRequest& request);

 private:
  std::optional<io::FollowedLayers> layers_;
};

}  // namespace condyle::cli
