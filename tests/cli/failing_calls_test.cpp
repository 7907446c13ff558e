#include <sys/wait.h>

#include <cerrno>

#include "command.hpp"

/// Each call that looks at an input fails in turn for once (preload/failing_calls.cpp): no answer is kept that a later run would not
/// give.

namespace condyle::test {
namespace {

struct Reading {
  const char *name, *command;
  std::vector<std::string> results;
};

void PrintTo(const Reading& reading, std::ostream* out) {
  *out << reading.name;
}

const std::vector<Reading> reading_commands = {
    {"study",
     "study ../inputs/two.csv --motion flexion --load '' --out out",
     {"limits.csv", "hips.csv", "failures.csv", "study.json"}},
    {"sweep",
     "sweep ../inputs/hip.toml --vary cup.inclination=40:45:5 --targets "
     "../inputs/daily.csv --load '' --e 10 --nu 0.3 "
     "--thickness 2 --out out",
     {"sweep.json", "designs.csv", "safe.csv"}}};

class FailingCalls : public ::testing::TestWithParam<Reading> {
 protected:
  void SetUp() override {
#ifndef CONDYLE_FAILING_CALLS
    GTEST_SKIP() << "a sanitizer comes first";
#else
    preload_ = CONDYLE_FAILING_CALLS;
#endif
    fs::create_directory(inputs);
    fs::create_directory(here);
    sample_into(inputs, "replacement --facets 24");
    io::write_mesh(inputs / "post.ply", box({40, -120, -50}, {60, -80, 50}));
    io::write_mesh(inputs / "arm.ply", box({-1, -100, -2}, {1, -10, 2}));
    std::ofstream(inputs / "daily.csv") << "name,motion,reach_deg\nsitting,flexion,110\n";
    std::ofstream(inputs / "h.txt") << "2 2 2 2 2 2 2 2\n";
    std::ofstream(inputs / "joint.toml")
        << text_of_joint({.more = "[contact.mobile]\nyoungs_modulus_mpa = 10\npoisson_ratio = 0.3\n"
                                  "thickness_file = \"h.txt\"\n"});
    std::ofstream(inputs / "two.csv") << "id,joint\na,joint.toml\nb,nothere.toml\n";
    ASSERT_EQ(run_condyle(here, GetParam().command).exit_code, 0);
    fs::rename(here / "out", here / "whole");
  }
  Ran run_failing(long number, int error) const {
    // The shell that runs the command must not lose calls of its own.
    const std::string environment =
        fmt::format("CONDYLE_CALLS='{} {}' CONDYLE_BELOW=inputs CONDYLE_FAILED='{}' LD_PRELOAD='{}'", number,
                    error, (folder / "failed").string(), preload_);
    fs::remove(folder / "failed");
    return run_with(environment, GetParam().command);
  }
  Ran run_with(const std::string& environment, const std::string& command) const {
    const int status = std::system(fmt::format("cd '{}' && {} '" CONDYLE_COMMAND "' {} >'{}' 2>'{}'",
                                               here.string(), environment, command,
                                               (folder / "stdout").string(), (folder / "stderr").string())
                                       .c_str());
    return {WIFEXITED(status) ? WEXITSTATUS(status) : -1, io::read_whole_file(folder / "stdout"),
            io::read_whole_file(folder / "stderr")};
  }
  void expect_whole(const std::string& what) const {
    for (const std::string& name : GetParam().results)
      EXPECT_EQ(io::read_whole_file(here / "out" / name), io::read_whole_file(here / "whole" / name))
          << what << ": " << name;
  }

  const TemporaryFolder folder;
  const fs::path inputs = folder / "inputs", here = folder / "here";
  std::string preload_;
};

TEST_P(FailingCalls, KeepNoAnswerThatALaterRunWouldNotGive) {
  int first = 0;
  for (const int error : {EIO, EINTR, EMFILE, ENFILE, ENOSPC, ENOMEM}) {
    // Each call with each error takes some minutes; by default each call with one of them.
    const bool is_long = std::getenv("CONDYLE_LONG_TESTS") != nullptr;
    const int step = is_long ? 1 : 6;
    long number = is_long ? 1 : ++first;
    for (;; number += step) {
      ASSERT_LT(number, 1000);
      fs::remove_all(here / "out");
      const Ran ran = run_failing(number, error);
      if (!fs::exists(folder / "failed")) break;
      const std::string what = fmt::format("call {} with errno {}: {}", number, error, ran.err);
      if (ran.exit_code == 0) {
        expect_whole(what);
      } else {
        EXPECT_EQ(ran.exit_code, 3) << what;
        EXPECT_TRUE(is_one_error_line(without_notes(ran.err))) << what;
        EXPECT_FALSE(fs::exists(here / "out" / GetParam().results.front())) << what;
      }
      const Ran again = run_condyle(here, GetParam().command);
      EXPECT_EQ(again.exit_code, 0) << what << again.err;
      expect_whole(what);
    }
    EXPECT_GT(number, 10) << "the inputs are read by other calls";
  }
}

INSTANTIATE_TEST_SUITE_P(Of, FailingCalls, testing::ValuesIn(reading_commands),
                         [](const auto& each) { return std::string(each.param.name); });

}  // namespace
}  // namespace condyle::test
