#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "baseline.hpp"
#include "questions.hpp"
#include "table.hpp"

namespace bench {

/// Joints that whole commands are timed on: the two real hips, and the sample where those are not there or the run is quick.
std::vector<std::string> command_joints(Effort effort);

/// Whole commands of the built `condyle` on one joint, in processor seconds of their process (user and system), and beside
/// `inspect` of the same two meshes, which reads and checks them. Adds rows, goals, and what did not answer. Returns the
/// ratios for the baseline, "command/joint/name": how many times longer `inspect` took.
Ratios ask_commands(const std::string& joint, Effort effort, Report& report);

/// Seconds of a process of `condyle`.
struct RunSeconds {
  double wall, processor;
};

/// Runs `condyle` with these arguments; empty if it did not answer.
std::optional<RunSeconds> run_command(std::vector<std::string> arguments);

/// A folder of its own for the files that commands read and write, removed with it.
class TemporaryFolder {
 public:
  TemporaryFolder();
  ~TemporaryFolder();
  TemporaryFolder(const TemporaryFolder&) = delete;
  TemporaryFolder& operator=(const TemporaryFolder&) = delete;

  std::string file(std::string_view name) const { return (path_ / name).string(); }

 private:
  std::filesystem::path path_;
};

}  // namespace bench
