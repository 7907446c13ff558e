#include "command.hpp"

/// Each allocation of a command fails in turn (preload/failing_allocations.cpp): one line and exit code 5, the earlier result or the
/// new one, whole, and nothing lost; never another answer.

namespace condyle::test {
namespace {

struct Failing {
  const char *name, *before, *command;
};

void PrintTo(const Failing& failing, std::ostream* out) {
  *out << failing.name;
}

const std::vector<Failing> commands = {
    {"depth", "depth joint.toml --pose flexion=10 --out out", "depth joint.toml --pose flexion=30 --out out"},
    {"rom", "rom joint.toml --motion abduction --out out", "rom joint.toml --motion flexion --out out"},
    {"study", "study two.csv --motion abduction --out out", "study two.csv --motion flexion --out out"},
    {"report", "report joint.toml --title Earlier --out out/page.html",
     "report joint.toml --out out/page.html"}};

/// Others, of a sample hip and its replacement: with CONDYLE_LONG_TESTS, some thousand of the allocations of each.
const std::vector<Failing> long_commands = {
    {"band", "rom hip.toml --motion extension --band=20 --out out",
     "rom hip.toml --motion fadir --band=20 --out out"},
    {"map", "rom hip.toml --map flexion=80:100:20 adduction=0:10:10 --out out",
     "rom hip.toml --map flexion=80:100:20 adduction=0:20:20 --past 3 --out out"},
    {"measure", "measure layer.toml --out out", "measure hip.toml --out out"},
    {"load", "load layer.toml --pose flexion=10 --out out", "load layer.toml --pose flexion=20 --out out"},
    {"motion", "motion hip.toml --motion swing.csv --out out",
     "motion layer.toml --motion swing.csv --load --out out"},
    {"resect", "resect hip.toml --reach fadir=25 --curve 0 --band=20 --out out",
     "resect hip.toml --reach fadir=30 --curve 1 --band=0 --burr 6 --out out"},
    {"implant", "implant hip.toml --inclination 40 --out out", "implant hip.toml --inclination 42 --out out"},
    {"sweep", "sweep replaced/hip.toml --vary cup.inclination=40:45:5 --targets sit.csv --out out",
     "sweep replaced/hip.toml --vary cup.inclination=40:45:5 --targets sit.csv --band=20 --out out"},
    {"picture", "picture hip.toml --size 64x64 --out out/picture.png",
     "picture hip.toml --measures --size 80x64 --out out/picture.png"},
    {"inspect", "inspect replaced/femur.ply --out out", "inspect femur.ply --repair weld --out out"},
    {"surface", "surface labels.nii.gz --label 76 --out out/bone.ply",
     "surface labels.nii.gz --label 76 --triangles 2000 --out out/bone.ply"},
    {"sample", "sample cohort --n 1 --out out", "sample cohort --n 2 --out out"}};

/// One run of the command, as the log has it.
struct Outcome {
  long number, exit_code, asked, live;
  int folder;
};
constexpr int as_before = 1, as_after = 2;

/// Blocks: what a JSON value that could not be built keeps.
constexpr long most_kept = 40;

class FailingAllocations : public ::testing::TestWithParam<Failing> {
 protected:
  void SetUp() override {
#ifndef CONDYLE_FAILING_ALLOCATIONS
    GTEST_SKIP() << "a sanitizer has an operator new of its own";
#else
    preload_ = CONDYLE_FAILING_ALLOCATIONS;
#endif
    fs::create_directory(here);
    io::write_mesh(here / "post.ply", box({40, -120, -50}, {60, -80, 50}));
    io::write_mesh(here / "arm.ply", box({-1, -100, -2}, {1, -10, 2}));
    std::ofstream(here / "joint.toml") << text_of_joint({});
    std::ofstream(here / "two.csv") << "id,joint\na,joint.toml\nb,joint.toml\n";
    if (is_long_command()) make_hips();
    ASSERT_EQ(run_condyle(here, GetParam().before).exit_code, 0);
    fs::rename(here / "out", here / "before");
    whole_ = run_condyle(here, GetParam().command);
    ASSERT_EQ(whole_.exit_code, 0) << whole_.err;
    fs::rename(here / "out", here / "after");
  }

  static bool is_long_command() {
    return std::any_of(long_commands.begin(), long_commands.end(),
                       [](const Failing& each) { return std::string_view(each.name) == GetParam().name; });
  }
  void make_hips() const {
    sample_into(here, "hip --alpha-angle 70 --voxel 2");
    sample_into(here / "replaced", "replacement --facets 24");
    std::ofstream(here / "layer.toml") << io::read_whole_file(here / "hip.toml")
                                       << "[contact]\ncasting = \"fixed\"\n[contact.fixed]\n"
                                          "youngs_modulus_mpa = 12\npoisson_ratio = 0.45\nthickness = 2\n";
    std::ofstream(here / "swing.csv") << "time,flexion_deg\n0,0\n0.1,10\n0.2,\n0.3,30\n";
    std::ofstream(here / "sit.csv") << "name,motion,reach_deg\nsit,flexion,100\n";
  }

  /// The command with "FIRST STEP LAST MODE" of the preload.
  std::vector<Outcome> outcomes(const std::string& which) const {
    const fs::path log = folder / "log";
    const std::string environment = fmt::format(
        "CONDYLE_FAIL='{}' CONDYLE_LOG='{}' CONDYLE_RESET='rm -rf out && cp -r before out' "
        "CONDYLE_CHECK='if diff -rq -x .condyle-rows out before >/dev/null; then exit {}; fi; "
        "if diff -rq -x .condyle-rows out after >/dev/null; then exit {}; fi; exit 3' LD_PRELOAD='{}'",
        which, log.string(), as_before, as_after, preload_);
    const std::string line = fmt::format("cd '{}' && {} '{}' {} --threads 1", here.string(), environment,
                                         CONDYLE_COMMAND, GetParam().command);
    EXPECT_EQ(std::system(line.c_str()), 0) << line;
    std::vector<Outcome> all;
    std::ifstream lines(log);
    for (Outcome one{}; lines >> one.number >> one.exit_code >> one.asked >> one.live >> one.folder;)
      all.push_back(one);
    return all;
  }

  void expect_all_or_nothing(const Outcome& one, long live_at_most) const {
    const std::string what =
        fmt::format("{}, allocation {} of {}", GetParam().command, one.number, one.asked);
    const std::string log = (folder / "log").string() + fmt::format(".{}.", one.number);
    const std::string out = io::read_whole_file(log + "out"), err = io::read_whole_file(log + "err");
    if (one.exit_code == 0) {
      // The failed memory was dispensable, or nothing failed.
      EXPECT_EQ(out, whole_.out) << what;
      EXPECT_EQ(err, whole_.err) << what;
      EXPECT_EQ(one.folder, as_after) << what;
      return;
    }
    EXPECT_EQ(one.exit_code, 5) << what << ": " << err;
    EXPECT_TRUE(out.empty() || out == whole_.out) << what << ": " << out;
    EXPECT_TRUE(is_one_error_line(without_notes(err))) << what << ": " << err;
    EXPECT_TRUE(one.folder == as_before || one.folder == as_after) << what;
    // A process that ends at once gives nothing back.
    if (one.live >= 0) {
      EXPECT_LE(one.live, live_at_most) << what;
    }
  }

  const TemporaryFolder folder;
  const fs::path here = folder / "in";
  std::string preload_;
  Ran whole_{};
};

TEST_P(FailingAllocations, EndWithOneLineAndNothingTorn) {
  const std::vector<Outcome> none = outcomes("0 1 0 once");
  ASSERT_EQ(none.size(), 1u);
  const long asked = none.front().asked;
  ASSERT_GT(asked, 1000);
  expect_all_or_nothing(none.front(), none.front().live);
  // The steps are prime to most periods of a program; all of them are some minutes.
  const bool is_long = std::getenv("CONDYLE_LONG_TESTS") != nullptr;
  for (const auto& [mode, few] : {std::pair{"once", 90}, {"on", 30}, {"end", 10}}) {
    const long runs = is_long_command() ? 20L * few : is_long ? asked : few;
    const long step = std::max(asked / runs, 1L) | 1;
    const auto all = outcomes(fmt::format("1 {} {} {}", step, 2 * asked, mode));
    EXPECT_GE(static_cast<long>(all.size()), asked / step);
    long failed = 0;
    for (const Outcome& one : all) {
      expect_all_or_nothing(one, none.front().live + most_kept);
      failed += one.exit_code == 5;
    }
    EXPECT_GT(failed, static_cast<long>(all.size()) * 9 / 10) << mode;
  }
}

INSTANTIATE_TEST_SUITE_P(LongCommands, FailingAllocations,
                         testing::ValuesIn(std::getenv("CONDYLE_LONG_TESTS") ? long_commands
                                                                             : std::vector<Failing>{}),
                         [](const auto& failing) { return std::string(failing.param.name); });
INSTANTIATE_TEST_SUITE_P(Commands, FailingAllocations, testing::ValuesIn(commands),
                         [](const auto& failing) { return std::string(failing.param.name); });

}  // namespace
}  // namespace condyle::test
