#include "command.hpp"
#include "support/small_cohort.hpp"

/// `condyle merge` takes each row of a table, and each design of a sweep, once, from the shard that has it.

namespace condyle::test {
namespace {

struct Sharded {
  const char* name;
  const char* command;
  const char *record, *version;
  std::vector<std::string> results;
};

void PrintTo(const Sharded& sharded, std::ostream* out) {
  *out << sharded.name;
}

const std::vector<Sharded> sharded_commands = {
    {"study",
     "study table.csv --motion flexion",
     "study.json",
     "\"condyle\": \"",
     {"limits.csv", "hips.csv", "failures.csv", "study.h5"}},
    {"sweep",
     "sweep hip.toml --vary 'cup.inclination=30:50:5 cup.anteversion=0:30:10' --targets daily.csv",
     "sweep.json",
     "\"version\": \"",
     {"sweep.json", "designs.csv", "safe.csv", "zone.vtp"}}};

constexpr int shard_count = 4;

class Shards : public CommandTest, public ::testing::WithParamInterface<Sharded> {
 protected:
  void SetUp() override {
    sample_into(here, "replacement --facets 24");
    write("daily.csv", "name,motion,reach_deg\nsitting,flexion,110\n");
    EXPECT_EQ(answer("--out whole").exit_code, 0);
    for (int i = 1; i <= shard_count; ++i) EXPECT_EQ(answer_shard(i).exit_code, 0);
    fs::copy(here / "out", here / "made", fs::copy_options::recursive);
  }
  Ran answer(const std::string& more) const { return run(fmt::format("{} {}", GetParam().command, more)); }
  Ran answer_shard(int i) const { return answer(fmt::format("--out out --shard {}/{}", i, shard_count)); }
  fs::path shard(int i) const { return here / fmt::format("out/shards/{}_of_{}", i, shard_count); }
  void put_back() const {
    fs::remove_all(here / "out");
    fs::copy(here / "made", here / "out", fs::copy_options::recursive);
  }
  void expect_merge_refused(const std::string& naming, const std::string& what) const {
    expect_refusal(run("merge out"), 3, naming, what);
    EXPECT_FALSE(fs::exists(here / "out" / GetParam().record)) << what;
    put_back();
  }
  void expect_whole() const {
    done("merge out");
    for (const std::string& name : GetParam().results)
      EXPECT_EQ(io::read_whole_file(here / "out" / name), io::read_whole_file(here / "whole" / name)) << name;
  }
  void replace_in_record(int i, const std::string& before, const std::string& after) const {
    edit(fmt::format("out/shards/{}_of_{}/{}", i, shard_count, GetParam().record), before, after);
  }

  const SmallCohort cohort{here, 9};
};

TEST_P(Shards, ThatWereCopiedSwappedOrRenamedAreRefusedByName) {
  for (int i = 1; i <= shard_count; ++i) {
    const int other = i % shard_count + 1;
    fs::remove_all(shard(other));
    fs::copy(shard(i), shard(other));
    expect_merge_refused(
        fmt::format("out/shards/{}_of_4/{}: is of shard {} of 4", other, GetParam().record, i), "copied");
    fs::rename(shard(i), here / "aside");
    fs::rename(shard(other), shard(i));
    fs::rename(here / "aside", shard(other));
    expect_merge_refused(fmt::format("/{}: is of shard ", GetParam().record), "swapped");
  }
  fs::rename(shard(4), here / "out/shards/4_of_5");
  expect_merge_refused("shards of 4 and of 5", "one renamed");
  for (int i = 1; i <= 3; ++i) fs::rename(shard(i), here / fmt::format("out/shards/{}_of_3", i));
  fs::remove_all(shard(4));
  expect_merge_refused(fmt::format("out/shards/1_of_3/{}: is of shard 1 of 4, in the folder of shard 1 of 3",
                                   GetParam().record),
                       "all renamed, one lost");
  expect_whole();
}

TEST_P(Shards, OfAnotherVersionAreRefusedByName) {
  for (int i = 1; i <= shard_count; ++i) {
    replace_in_record(i, GetParam().version + std::string("0."), GetParam().version + std::string("9."));
    expect_merge_refused(fmt::format("out/shards/{}_of_4/{}: is of version 9.", i, GetParam().record), "one");
  }
  for (int i = 1; i <= shard_count; ++i)
    replace_in_record(i, GetParam().version + std::string("0."), GetParam().version + std::string("9."));
  expect_merge_refused("is of version 9.", "all");
}

TEST_P(Shards, OfInputsThatAreOthersNowAreRefusedByName) {
  const bool is_study = GetParam().name == std::string("study");
  for (const std::string& file :
       is_study ? std::vector<std::string>{"post1.ply", "post9.ply", "hip4.toml", "arm.ply", "table.csv"}
                : std::vector<std::string>{"neck.ply", "hip.toml", "daily.csv"}) {
    const std::string before = text_of(file);
    append(file, "\n");
    expect_merge_refused(file + ": is another since ", file);
    write(file, before);
  }
  // Where inputs are no more, shards are merged as they are.
  fs::create_directory(here / "elsewhere");
  fs::rename(here / "out", here / "elsewhere/out");
  EXPECT_EQ(run_condyle(here / "elsewhere", "merge out").exit_code, 0);
  fs::rename(here / "elsewhere/out", here / "out");
}

TEST_P(Shards, AreMadeAnewByTheirCommandAfterARefusal) {
  fs::remove_all(shard(2));
  fs::copy(shard(1), shard(2));
  CommandTest::expect_refused(3, "merge out", "2_of_4");
  const Ran again = answer_shard(2);
  EXPECT_EQ(again.exit_code, 0) << again.err;
  EXPECT_FALSE(says(again.err, "is there already"));
  expect_whole();
}

TEST_P(Shards, ThatWereMergedAreThereAlreadyForARunOfTheWhole) {
  const auto is_there = [&] {
    const Ran ran = answer("--out out");
    EXPECT_EQ(ran.exit_code, 0) << ran.err;
    return ran.err.find("is there already") != ran.err.npos;
  };
  expect_whole();
  for (const char* time : {"first", "second"}) EXPECT_TRUE(is_there()) << time;
  for (const std::string& name : GetParam().results)
    EXPECT_EQ(io::read_whole_file(here / "out" / name), io::read_whole_file(here / "whole" / name)) << name;
  put_back();
  expect_whole();
  const bool is_study = GetParam().name == std::string("study");
  std::ofstream(here / (is_study ? "post9.ply" : "neck.ply"), std::ios::app) << "\n";
  EXPECT_FALSE(is_there()) << "an input is another";
}

INSTANTIATE_TEST_SUITE_P(Of, Shards, testing::ValuesIn(sharded_commands),
                         [](const auto& each) { return std::string(each.param.name); });

}  // namespace
}  // namespace condyle::test
