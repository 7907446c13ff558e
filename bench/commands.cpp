#include "commands.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <spawn.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <optional>
#include <stdexcept>
#include <string>
#include <string_view>
#include <system_error>
#include <vector>

#include "goals.hpp"
#include "real_data.hpp"
#include "timing.hpp"

namespace bench {
namespace {

namespace fs = std::filesystem;

const TableHead commands_head{"commands",
                              "Whole commands, processor seconds (user and system), medians",
                              {{"joint", "joint"},
                               {"command", "command"},
                               {"processor_seconds", "s"},
                               {"over_inspect", "times `inspect`"}}};

constexpr std::string_view sample = "sample_1", small_hip = "hip_vhf_right", large_hip = "hip_libhip_m1_left";

std::optional<double> processor_seconds_of(std::vector<std::string> arguments) {
  const auto seconds = run_command(std::move(arguments));
  return seconds ? std::optional(seconds->processor) : std::nullopt;
}

void write_poses(const std::string& file, int count) {
  std::ofstream out(file);
  out << "time,flexion_deg,internal_rotation_deg\n";
  for (int i = 0; i < count; ++i) out << fmt::format("{},{},{}\n", i * 0.01, 80 + 0.4 * i, 0.3 * i);
}

struct Command {
  std::string name;
  std::vector<std::string> arguments;
  std::optional<double> small_goal, large_goal;  ///< seconds, of the two hips
  std::string written = {};                      ///< a file that must not be there before
};

struct JointFiles {
  std::string fixed, mobile, side;
};

/// The sample is made, the others are there or not.
JointFiles files_of(const std::string& joint, const TemporaryFolder& folder) {
  if (joint == sample) {
    if (!processor_seconds_of({"sample", "hip", "--out", folder.file("sample")}))
      throw std::runtime_error("condyle sample hip: no answer");
    return {folder.file("sample/hip_bone.ply"), folder.file("sample/femur.ply"), "right"};
  }
  const fs::path of_joint = data_folder() / joint;
  return {(of_joint / "hip_bone.ply").string(), (of_joint / "femur.ply").string(),
          joint.substr(joint.rfind('_') + 1)};
}

std::vector<Command> commands_on(const JointFiles& files, const TemporaryFolder& folder) {
  const std::string joint = folder.file("joint.toml"), again = folder.file("again.toml");
  const std::string pose = "flexion=110 internal_rotation=30";
  return {
      {"inspect", {"inspect", files.fixed, files.mobile}, {}, {}},
      {"init", {"init", files.fixed, files.mobile, "--side", files.side, "--out", again}, 0.1, 0.3, again},
      {"frame", {"frame", joint}, 0.1, 0.3},
      {"depth", {"depth", joint, "--pose", pose}, 0.12, 0.45},
      {"rom", {"rom", joint}, 0.2, 1.2},
      {"rom, bearing counts", {"rom", joint, "--bearing", "count"}, 0.2, 1.2},
      {"rom, one motion", {"rom", joint, "--motion", "flexion"}, 0.15, 0.5},
      {"report", {"report", joint, "--out", folder.file("report.html")}, 1.0, 2.0},
      {"load", {"load", joint, "--pose", pose, "--e", "12", "--nu", "0.45", "--thickness", "1.5"}, {}, {}},
      {"motion, 1 pose", {"motion", joint, "--motion", folder.file("1.csv")}, {}, {}},
      {"motion, 100 poses", {"motion", joint, "--motion", folder.file("100.csv")}, {}, {}},
  };
}

double time_of(std::string_view name, const std::vector<Command>& commands,
               const std::vector<double>& seconds) {
  for (std::size_t i = 0; i < commands.size(); ++i)
    if (commands[i].name == name) return seconds[i];
  return 0;
}

void add_goals(const std::string& joint, const std::vector<Command>& commands,
               const std::vector<double>& seconds, Report& report) {
  if (joint == sample) return;
  for (std::size_t i = 0; i < commands.size(); ++i) {
    const auto goal = joint == small_hip ? commands[i].small_goal : commands[i].large_goal;
    if (goal)
      add_goal({"command, " + commands[i].name, joint, Bound::at_most, *goal, "s of processor time"},
               seconds[i], report);
  }
  add_goal({"command, motion of 100 poses over one of 1", joint, Bound::at_most, 3, "times"},
           time_of("motion, 100 poses", commands, seconds) / time_of("motion, 1 pose", commands, seconds),
           report);
}

}  // namespace

TemporaryFolder::TemporaryFolder() {
  std::string name = (fs::temp_directory_path() / "condyle-bench-XXXXXX").string();
  if (::mkdtemp(name.data()) == nullptr) throw std::system_error(errno, std::generic_category(), name);
  path_ = name;
}

TemporaryFolder::~TemporaryFolder() {
  std::error_code ignored;
  fs::remove_all(path_, ignored);
}

std::optional<RunSeconds> run_command(std::vector<std::string> arguments) {
  arguments.insert(arguments.begin(), CONDYLE_COMMAND);
  std::vector<char*> words;
  for (std::string& argument : arguments) words.push_back(argument.data());
  words.push_back(nullptr);
  posix_spawn_file_actions_t files;
  posix_spawn_file_actions_init(&files);
  for (const int stream : {STDOUT_FILENO, STDERR_FILENO})
    posix_spawn_file_actions_addopen(&files, stream, "/dev/null", O_WRONLY, 0);
  pid_t process = 0;
  const Stopwatch watch;
  const int failed = posix_spawn(&process, CONDYLE_COMMAND, &files, nullptr, words.data(), environ);
  posix_spawn_file_actions_destroy(&files);
  if (failed != 0) throw std::system_error(failed, std::generic_category(), CONDYLE_COMMAND);
  int status = 0;
  rusage used{};
  while (::wait4(process, &status, 0, &used) == -1)
    if (errno != EINTR) throw std::system_error(errno, std::generic_category(), CONDYLE_COMMAND);
  const double wall = watch.wall_seconds();
  if (!WIFEXITED(status) || WEXITSTATUS(status) != 0) return std::nullopt;
  const auto seconds = [](const timeval& time) {
    return static_cast<double>(time.tv_sec) + 1e-6 * static_cast<double>(time.tv_usec);
  };
  return RunSeconds{wall, seconds(used.ru_utime) + seconds(used.ru_stime)};
}

std::vector<std::string> command_joints(Effort effort) {
  std::vector<std::string> joints;
  if (effort == Effort::full)
    for (const std::string_view hip : {small_hip, large_hip})
      if (fs::exists(data_folder() / hip)) joints.emplace_back(hip);
  if (joints.empty()) joints.emplace_back(sample);
  return joints;
}

Ratios ask_commands(const std::string& joint, Effort effort, Report& report) {
  const TemporaryFolder folder;
  const JointFiles files = files_of(joint, folder);
  write_poses(folder.file("1.csv"), 1);
  write_poses(folder.file("100.csv"), 100);
  processor_seconds_of(
      {"init", files.fixed, files.mobile, "--side", files.side, "--out", folder.file("joint.toml")});

  const std::vector<Command> commands = commands_on(files, folder);
  std::vector<std::vector<double>> samples(commands.size());
  const int rounds = effort == Effort::full ? 5 : 1;
  for (int round = 0; round < rounds; ++round)
    for (std::size_t i = 0; i < commands.size(); ++i) {
      if (!commands[i].written.empty()) fs::remove(commands[i].written);
      const auto seconds = processor_seconds_of(commands[i].arguments);
      if (!seconds) {
        report.disagreements.push_back(fmt::format("command/{}/{}: no answer", joint, commands[i].name));
        return {};
      }
      samples[i].push_back(*seconds);
    }

  std::vector<double> seconds;
  for (const auto& of_command : samples) seconds.push_back(median(of_command));
  const double inspect = time_of("inspect", commands, seconds);
  Ratios ratios;
  for (std::size_t i = 0; i < commands.size(); ++i) {
    report.table(commands_head).add({joint, commands[i].name, seconds[i], seconds[i] / inspect});
    if (commands[i].name != "inspect")
      ratios[fmt::format("{}{}/{}", command_ratios, joint, commands[i].name)] = inspect / seconds[i];
  }
  add_goals(joint, commands, seconds, report);
  return ratios;
}

}  // namespace bench
