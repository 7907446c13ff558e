#include <sys/resource.h>
#include <unistd.h>

#include <chrono>
#include <csignal>
#include <memory>
#include <thread>

#include "command.hpp"

/// Commands that are ended from outside, or that cannot write: what was there stays, or what was asked for is there, each file
/// whole.

namespace condyle::test {
namespace {

using Clock = std::chrono::steady_clock;

/// Every file below a folder and what it holds, but for folders that a killed run could not clear away.
std::map<std::string, std::string> files_in(const fs::path& folder) {
  std::map<std::string, std::string> files;
  if (!fs::exists(folder)) return files;
  for (auto at = fs::recursive_directory_iterator(folder); at != fs::recursive_directory_iterator(); ++at) {
    if (at->path().filename().string().starts_with(".condyle-")) at.disable_recursion_pending();
    if (at->is_regular_file())
      files[fs::relative(at->path(), folder).string()] = io::read_whole_file(at->path());
  }
  return files;
}

/// A command that writes, with what it wrote before and what it is to write. Empty for one that writes into a new folder only.
struct Writing {
  const char* name;
  std::string before, after;
  const char* bones = "sample";  ///< the folder of the joint
};

void PrintTo(const Writing& writing, std::ostream* out) {
  *out << writing.name;
}

const std::string sweep = "sweep thr/hip.toml --targets targets.csv --out result --vary 'cup.inclination=",
                  both_angles = "0:50:10 cup.anteversion=0:10:10'";
const std::vector<Writing> writings = {
    {"rom", "rom sample/hip.toml --out result --motion flexion",
     "rom sample/hip.toml --out result --map flexion=0:60:20 --map adduction=-10:10:10"},
    {"report", "report sample/hip.toml --out result/page.html --title earlier",
     "report sample/hip.toml --out result/page.html"},
    {"motion", "motion sample/hip.toml --motion squat.csv --out result",
     "motion sample/hip.toml --motion stride.csv --out result"},
    {"sweep", sweep + "40:50:10'", sweep + "3" + both_angles, "thr"},
    {"shard_of_sweep", sweep + "4" + both_angles + " --shard 2/2", sweep + "3" + both_angles + " --shard 2/2",
     "thr"},
    {"limits_for_mujoco", "rom sample/hip.toml --write-limits result/limits.xml --angle-unit radian",
     "rom sample/hip.toml --write-limits result/limits.xml --map flexion=0:60:20 --map adduction=-10:10:10"},
    {"hip", "", "hip sample/hip_bone.ply sample/femur.ply --samples 0 --out result"},
};

class BrokenOff : public testing::TestWithParam<Writing> {
 protected:
  static void SetUpTestSuite() {
    folder_ = std::make_unique<TemporaryFolder>();
    sample_into(*folder_ / "sample", "hip");
    sample_into(*folder_ / "thr", "replacement");
    folder_->file("targets.csv", "name,motion,reach_deg\nbend,flexion,110\nstep,extension,30\n");
    folder_->file("squat.csv", "time,flexion_deg\n0,0\n0.5,40\n1,80\n");
    folder_->file("stride.csv", "time,flexion_deg,adduction_deg\n0,30,0\n0.5,0,-5\n1,-10,3\n");
  }
  static void TearDownTestSuite() { folder_.reset(); }

  /// Both results are made once for all tests of a command.
  void SetUp() override {
    if (!fs::exists(later())) {
      fs::remove_all(here() / "result");
      if (!GetParam().before.empty()) {
        run_whole(GetParam().before);
        fs::copy(here() / "result", earlier(), fs::copy_options::recursive);
      }
      run_after();
      fs::rename(here() / "result", later());
    }
    old_ = files_in(earlier());
    new_ = files_in(later());
    ASSERT_EQ(old_.empty(), GetParam().before.empty());
    ASSERT_NE(old_, new_);
  }

  static const fs::path& here() { return folder_->path(); }
  static fs::path earlier() { return here() / (std::string(GetParam().name) + ".before"); }
  static fs::path later() { return here() / (std::string(GetParam().name) + ".after"); }
  static fs::path err() { return here() / "err.txt"; }

  static int run_to_end(const std::string& arguments) {
    return end_of(start_condyle(here(), arguments, err()));
  }
  static void run_whole(const std::string& arguments) {
    ASSERT_EQ(run_to_end(arguments), 0) << io::read_whole_file(err());
  }

  /// The new result. How long it takes changes with what else the machine does, so the latest run counts.
  static void run_after() {
    const auto started = Clock::now();
    run_whole(GetParam().after);
    takes_[GetParam().name] = Clock::now() - started;
  }

  /// The earlier result and nothing else.
  void restore() {
    fs::remove_all(here() / "result");
    if (fs::exists(earlier())) fs::copy(earlier(), here() / "result", fs::copy_options::recursive);
  }

  void expect_whole_files() {
    for (const auto& [name, bytes] : files_in(here() / "result")) {
      const auto is = [&, &name = name, &bytes = bytes](const auto& files) {
        const auto found = files.find(name);
        return found != files.end() && found->second == bytes;
      };
      EXPECT_TRUE(is(old_) || is(new_)) << name << " is neither the earlier file nor the new one";
    }
  }

  static inline std::unique_ptr<TemporaryFolder> folder_;
  static inline std::map<std::string, Clock::duration> takes_;
  std::map<std::string, std::string> old_, new_;
};

/// Fewer of what takes seconds.
int kills_of(const Writing& writing) {
  const int all = std::getenv("CONDYLE_LONG_TESTS") ? 200 / static_cast<int>(writings.size()) + 1 : 6;
  return writing.before.empty() ? all / 3 : all;
}

TEST_P(BrokenOff, AtAnyMomentLeavesEachFileOldOrNewAndTheNextRunTheSameBytes) {
  std::mt19937 random(5);
  const int kills = kills_of(GetParam());
  int ended_early = 0;
  // Goes on until enough of them met a run at its work: a run may end before a signal that was meant for its middle.
  for (int i = 0; i < kills || (ended_early <= kills / 3 && i < 10 * kills); ++i) {
    restore();
    const int signal = std::array{SIGINT, SIGKILL, SIGTERM, SIGKILL, SIGHUP, SIGKILL}[i % 6];
    const pid_t child = start_condyle(here(), GetParam().after, err());
    const double share = 1.1 * static_cast<double>(random() % 1000) / 1000;
    std::this_thread::sleep_for(std::chrono::duration<double>(takes_[GetParam().name]) * share);
    ::kill(child, signal);
    const int end = end_of(child);
    ended_early += end != 0;
    if (signal == SIGKILL) {
      EXPECT_TRUE(end == 0 || end == -SIGKILL) << end;
    } else if (end > 0) {
      EXPECT_EQ(end, 130);
      const std::string said = io::read_whole_file(err());
      EXPECT_TRUE(says(said, "condyle: "));
      EXPECT_EQ(said.back(), '\n') << said;
    } else if (end < 0) {
      // Before the program had begun to listen.
      EXPECT_EQ(end, -signal);
    }
    if (signal != SIGKILL) {
      EXPECT_FALSE(has_temporary(here() / "result")) << signal;
    }
    expect_whole_files();
    if (GetParam().before.empty()) restore();
    run_after();
    EXPECT_EQ(files_in(here() / "result"), new_);
    if (HasFailure()) return;
  }
  EXPECT_GT(ended_early, kills / 3);
}

/// A disk that is full for files of more than 1,500 bytes.
TEST_P(BrokenOff, WithoutRoomForItsFilesLeavesTheEarlierOnesAndSaysSoInOneLine) {
  restore();
  struct rlimit before {};
  ASSERT_EQ(::getrlimit(RLIMIT_FSIZE, &before), 0);
  struct rlimit little = before;
  little.rlim_cur = 1500;
  ASSERT_EQ(::setrlimit(RLIMIT_FSIZE, &little), 0);
  const pid_t child = start_condyle(here(), GetParam().after, err());
  ::setrlimit(RLIMIT_FSIZE, &before);
  EXPECT_EQ(end_of(child), 3);
  const std::string said = io::read_whole_file(err());
  EXPECT_TRUE(says(said, "cannot be written: File too large\n"));
  EXPECT_TRUE(says(said, "condyle: result/") && !says(said, ".condyle-")) << said;
  EXPECT_EQ(files_in(here() / "result"), old_);
}

TEST_P(BrokenOff, InAFolderThatMayNotBeWrittenToLeavesItAsItWas) {
  if (::geteuid() == 0) GTEST_SKIP() << "root may write to every folder";
  restore();
  fs::permissions(here() / "result", fs::perms::owner_read | fs::perms::owner_exec);
  const int end = run_to_end(GetParam().after);
  fs::permissions(here() / "result", fs::perms::owner_all);
  EXPECT_EQ(end, 3);
  EXPECT_TRUE(is_one_error_line(without_notes(io::read_whole_file(err()))));
  EXPECT_EQ(files_in(here() / "result"), old_);
}

TEST_P(BrokenOff, WithAnInputThatVanishedSaysWhichInOneLine) {
  restore();
  const fs::path bones = here() / GetParam().bones;
  fs::rename(bones / "femur.ply", bones / "gone.ply");
  const int end = run_to_end(GetParam().after);
  fs::rename(bones / "gone.ply", bones / "femur.ply");
  EXPECT_EQ(end, 3);
  const std::string said = without_notes(io::read_whole_file(err()));
  EXPECT_TRUE(is_one_error_line(said)) << said;
  EXPECT_TRUE(says(said, "femur.ply"));
  EXPECT_EQ(files_in(here() / "result"), old_);
}

INSTANTIATE_TEST_SUITE_P(Writes, BrokenOff, testing::ValuesIn(writings),
                         [](const auto& writing) { return std::string(writing.param.name); });

}  // namespace
}  // namespace condyle::test
