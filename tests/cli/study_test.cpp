#include <signal.h>

#include <chrono>
#include <thread>

#include "command.hpp"
#include "support/small_cohort.hpp"

namespace condyle::test {
namespace {

using namespace std::chrono_literals;
using Clock = std::chrono::steady_clock;

constexpr const char* tables[] = {"limits.csv",  "hips.csv", "failures.csv",
                                  "columns.csv", "study.h5", "study.json"};

class StudyCommand : public CommandTest {
 protected:
  void expect_same_tables(const std::string& a, const std::string& b) const {
    for (const char* name : tables)
      EXPECT_EQ(io::read_whole_file(here / a / name), io::read_whole_file(here / b / name)) << name;
  }

  const SmallCohort cohort{here, 12};
};

TEST_F(StudyCommand, AnswersWithFailuresInTheirTable) {
  const Ran ran = done("study table.csv --out out");
  EXPECT_EQ(ran.out, "12 answered, 4 failed\n");
  EXPECT_TRUE(ran.err.starts_with("condyle: note: wrote out/limits.csv, ")) << ran.err;
  const Ran again = run("study table.csv --out out --threads 1");
  EXPECT_EQ(again.out, ran.out);
  EXPECT_EQ(again.err, "condyle: note: is there already, of the same inputs, options and version\n");
}

TEST_F(StudyCommand, EndsAtABadJointWithItsExitCodeWhereThatIsAskedFor) {
  expect_refused(3, "study table.csv --out out --strict", "nothere.toml: no such file");
  write("contact.csv", "id,joint\na,hip1.toml\nb,in_contact.toml\nc,nothere.toml\n");
  for (const char* threads : {"1", "7"})
    expect_refusal(run(std::string("study contact.csv --out out --strict --threads ") + threads), 6,
                   "in contact in the reference pose", "--strict");
  EXPECT_FALSE(fs::exists(here / "out/limits.csv"));
}

TEST_F(StudyCommand, EndsWithTheExitCodeOfTheFirstFailureWhereNoneIsAnswered) {
  write("none.csv", "id,joint\nb,in_contact.toml\nc,nothere.toml\n");
  for (const char* round : {"computed", "there already"}) {
    const Ran ran = run("study none.csv --out none");
    EXPECT_EQ(ran.exit_code, 6) << round;
    EXPECT_EQ(ran.out, "0 answered, 2 failed\n");
    EXPECT_TRUE(is_one_error_line(without_notes(ran.err))) << ran.err;
    EXPECT_TRUE(says(ran.err, "condyle: none.csv: none of 2 joints was answered; the first one: "));
    EXPECT_TRUE(fs::exists(here / "none/failures.csv"));
  }
  // A shard may hold bad joints only; what is merged is the study.
  for (const char* shard : {"1/2", "2/2"}) done(std::string("study none.csv --out parted --shard ") + shard);
  EXPECT_EQ(run("merge parted").exit_code, 6);
}

TEST_F(StudyCommand, OfShardsMergedIsTheWholeStudy) {
  done("study table.csv --out whole --band=20 --motion flexion");
  for (int i = 7; i >= 1; --i) {
    if (i == 3) expect_refused(3, "merge out", "3 of 7 shards are missing or not whole: 1, 2, 3");
    done(fmt::format("study table.csv --out out --band=20 --motion flexion --shard {}/7", i));
  }
  const Ran merged = done("merge out");
  EXPECT_EQ(merged.out, "12 answered, 4 failed\n");
  for (const char* name : {"limits.csv", "hips.csv", "failures.csv", "columns.csv", "study.h5"})
    EXPECT_EQ(io::read_whole_file(here / "whole" / name), io::read_whole_file(here / "out" / name)) << name;
}

TEST_F(StudyCommand, RefusesWhatCannotBe) {
  for (const char* shard : {"0/3", "4/3", "1", "a/b", "1/0", "1/2/3", "-1/3"})
    expect_refusal(run(std::string("study table.csv --out out --shard=") + shard), 2, "such as 3/7", shard);
  expect_refused(3, "study nothere.csv --out out", "nothere.csv: no such file");
  expect_refused(2, "study table.csv --out out --motion flexoin", "flexoin");
  expect_refused(2, "study table.csv --out out --map flexion=0:10:1 flexion=0:10:1", "one is named twice");
  expect_refused(2, "study table.csv --out out --depth yaw=3", "yaw");
  expect_refused(2, "study table.csv --out out --load yaw=3", "yaw");
  expect_refused(2, "study table.csv --out out --anatomy knee --measures", "measures: are of hips");
  expect_refused(2, "study table.csv --out out --force 1 2 3", "needs --load");
  expect_refused(2, "study table.csv --out out --load '' --e 12 --nu 0.7 --thickness 1", "Poisson's ratio");
  expect_refused(2, "study table.csv --out out --load '' --along 1 0 0", "needs --force");
  expect_refused(2, "study table.csv --out out --load '' --force 1 2 3 --along 1 2 3 4", "--along");
  expect_refused(3, "merge nothere", "nothere: there is no shard");
  write("file", "x");
  expect_refused(3, "study table.csv --out file/out", "file/out: cannot be written to");
}

/// Whether a process has set up what it does at a signal; true of one that has ended, too.
bool catches(pid_t process, int signal) {
  std::ifstream status(fmt::format("/proc/{}/status", process));
  for (std::string line; std::getline(status, line);) {
    if (line.starts_with("State:") && line.find('Z') != line.npos) return true;
    if (line.starts_with("SigCgt:")) return (std::stoull(line.substr(7), nullptr, 16) >> (signal - 1)) & 1;
  }
  return true;
}

/// Checks a folder that a killed run left: every file is whole, or not there.
void expect_no_half_file(const fs::path& left, const fs::path& whole) {
  for (const char* name : tables) {
    if (!fs::exists(left / name)) continue;
    EXPECT_EQ(io::read_whole_file(left / name), io::read_whole_file(whole / name)) << name;
  }
}

TEST_F(StudyCommand, KilledAtAnyMomentGoesOnWithTheRowsThatAreTheSame) {
  const std::string command = "study table.csv --out killed --band=400 --threads 1";
  const fs::path rows = here / "killed/.condyle-rows";
  const auto answered = [&] {
    std::ifstream lines(rows);
    std::size_t count = 0;
    for (std::string line; std::getline(lines, line);) count += line.ends_with('}');
    return count;
  };
  const auto earlier = [](const Ran& ran) {
    return ran.err.find(" joints were answered by an earlier run") == ran.err.npos
               ? 0
               : std::stoul(ran.err.substr(ran.err.find("note: ") + 6));
  };
  const auto began = Clock::now();
  done("study table.csv --out whole --band=400");
  const auto whole_run = Clock::now() - began;
  std::mt19937 random(1);
  std::uniform_real_distribution<double> share(0, 0.5);
  const int kills = std::getenv("CONDYLE_LONG_TESTS") != nullptr ? 200 : 8;
  for (int i = 0; i < kills || answered() < 2; ++i) {
    // The next kill, too, is to meet a run that has something to do.
    if (fs::exists(here / "killed/study.json")) fs::remove_all(here / "killed");
    const pid_t process = start_condyle(here, command, folder / "err");
    std::this_thread::sleep_for(whole_run * share(random));
    ::kill(process, i % 4 == 3 ? SIGINT : SIGKILL);
    end_of(process);
    expect_no_half_file(here / "killed", here / "whole");
  }
  std::ofstream(rows, std::ios::app) << "half a li";
  fs::copy(here / "killed", here / "other", fs::copy_options::recursive);
  const std::size_t kept = answered();
  cohort.write_post(1, 50);  // of the row that is answered first
  EXPECT_EQ(earlier(run(command)), kept - 1);
  EXPECT_EQ(earlier(run("study table.csv --out other --band=399")), 0u);
  done("study table.csv --out whole --band=400");
  expect_same_tables("whole", "killed");
  EXPECT_FALSE(fs::exists(rows) || fs::exists(here / "other/.condyle-rows"));
}

TEST_F(StudyCommand, RunTwiceAtATimeWritesWhatOneRunWrites) {
  done("study table.csv --out whole --band=20");
  for (int round = 0; round < 3; ++round) {
    std::vector<pid_t> processes;
    for (int i = 0; i < 3; ++i)
      processes.push_back(start_condyle(here, fmt::format("study table.csv --out at_once{} --band=20", round),
                                        folder / "err"));
    for (const pid_t process : processes) EXPECT_EQ(end_of(process), 0);
    expect_same_tables("whole", fmt::format("at_once{}", round));
  }
}

TEST_F(StudyCommand, EndsAtAnInterruptionInTheMiddleOfAMap) {
  // Maps of some hundred thousand points each, which take minutes: a run that did not stop would answer with 0.
  const pid_t process =
      start_condyle(here, "study table.csv --out out --map adduction=-30:30:0.1 internal_rotation=-30:30:0.1",
                    folder / "err");
  while (!catches(process, SIGINT)) std::this_thread::sleep_for(10ms);
  std::this_thread::sleep_for(100ms);
  ::kill(process, SIGINT);
  EXPECT_EQ(end_of(process), 130);
  const std::string said = text_of("err");
  EXPECT_TRUE(says(said, "; the same command goes on from here\n"));
  EXPECT_FALSE(fs::exists(here / "out/limits.csv"));
}

TEST_F(StudyCommand, MeasuresShapesOfACohort) {
  done("sample cohort --n 1 --seed 5 --out drawn");
  done("study drawn/cohort.csv --out out --motion flexion --measures --band=20");
  const std::string hips = text_of("out/hips.csv");
  EXPECT_TRUE(says(hips, ",measured_alpha_1_30_deg,measured_alpha_1_30_deg_p5,measured_alpha_1_30_deg_p95,"));
  EXPECT_TRUE(says(text_of("out/columns.csv"), "hips,measured_head_radius_mm,mm,number,"));
}

TEST_F(StudyCommand, DrawsACohortThatItThenAnswersFor) {
  const Ran drawn = done("sample cohort --n 2 --seed 5 --out drawn");
  EXPECT_EQ(drawn.out, "2 hips, for condyle study drawn/cohort.csv\n");
  EXPECT_EQ(run("study drawn/cohort.csv --out out --motion flexion").out, "2 answered, 0 failed\n");
  run("sample cohort --n 40 --seed 5 --out more");
  const std::string few = text_of("drawn/cohort.csv");
  EXPECT_TRUE(text_of("more/cohort.csv").starts_with(few));
  expect_refused(2, "sample cohort --n 0 --out none", "1 to 10000000 hips");
}

}  // namespace
}  // namespace condyle::test
