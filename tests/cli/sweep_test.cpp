#include "command.hpp"
#include "condyle/answer.hpp"
#include "condyle/io/joint_file.hpp"

/// `condyle sweep` says what answer_sweep() answers, and its shards are the whole.

namespace condyle::test {
namespace {

const char* const every_file[] = {"sweep.json", "designs.csv", "safe.csv", "zone.vtp"};
const char* const vary = "--vary 'cup.inclination=30:50:5 cup.anteversion=0:30:5'";

class SweepCommand : public CommandTest {
 protected:
  void SetUp() override {
    sample_into(here, "replacement --facets 120");
    write("daily.csv",
          "name,motion,reach_deg,pelvic_tilt_deg,source\n"
          "sitting,flexion,110,-10,made up\n"
          "pivoting,external_rotation,40,,\n");
  }
  Ran sweep(const std::string& more) const {
    return run(fmt::format("sweep hip.toml {} --targets daily.csv {}", vary, more));
  }
};

TEST_F(SweepCommand, SaysWhatTheLibraryAnswers) {
  const Ran ran = sweep("--band=20 --json --out zone");
  ASSERT_EQ(ran.exit_code, 0) << ran.err;
  const io::LoadedJoint loaded = io::read_joint(folder / "hip.toml");
  const plan::SweepTarget sitting{"sitting", motion::motion_named(motion::hip_motions(), "flexion"),
                                  Angle::degrees(110), Angle::degrees(-10)},
      pivoting{"pivoting", motion::motion_named(motion::hip_motions(), "external_rotation"),
               Angle::degrees(40)};
  const SweepAnswer expected =
      answer_sweep(loaded, {.parameters = plan::parse_sweep("cup.inclination=30:50:5 cup.anteversion=0:30:5"),
                            .targets = {sitting, pivoting},
                            .bands = BandRequest{.samples = 20}});
  const Json json = Json::parse(ran.out);
  EXPECT_EQ(json["designs"], 35);
  EXPECT_EQ(json["safe_measure"], expected.safe_measure);
  EXPECT_EQ(json["window_measure"], expected.window_measure);
  ASSERT_TRUE(expected.best);
  EXPECT_EQ(json["best"]["margin_deg"], expected.margin_deg[*expected.best]);
  EXPECT_EQ(json["best"]["values"]["cup.anteversion"], expected.values_of(*expected.best)[1]);
  EXPECT_EQ(json["here"]["values"]["cup.inclination"], 40.0);
  EXPECT_EQ(json["here"]["limits"][0]["limit_deg"], expected.limits_here[0].turned_deg);
  EXPECT_EQ(json["targets"][0]["pelvic_tilt_deg"], -10.0);
  EXPECT_EQ(json["targets"][0]["source"], "made up");
  EXPECT_EQ(json["band"]["samples"], 20);
  ASSERT_EQ(json["sweep_notes"].size(), expected.notes.size());
  const std::string text = sweep("--band=20 --out zone").out;
  for (std::size_t i = 0; i < expected.notes.size(); ++i) {
    EXPECT_EQ(json["sweep_notes"][i]["text"], expected.notes[i].text);
    const std::string& note = expected.notes[i].text;
    EXPECT_TRUE(says(ran.err, fmt::format("note: {}: {}\n", name_of(expected.notes[i].code), note)));
    EXPECT_FALSE(says(text, note));
  }
  const std::vector<std::string> rows = lines_of(text_of("zone/designs.csv"));
  ASSERT_EQ(rows.size(), 1 + expected.designs());
  EXPECT_TRUE(rows[0].starts_with("cup.inclination,cup.anteversion,margin_deg,safe,probability,"));
  for (std::size_t i = 0; i < expected.designs(); ++i)
    EXPECT_TRUE(rows[1 + i].starts_with(fmt::format(
        "{},{},{},{},{},{},", expected.values_of(i)[0], expected.values_of(i)[1], expected.margin_deg[i],
        expected.margin_deg[i] >= 0 ? 1 : 0, expected.probability[i], expected.limits[2 * i].turned_deg)))
        << rows[1 + i];
  EXPECT_EQ(lines_of(text_of("zone/safe.csv")).size(), 1 + expected.safe.size());
  // The document that is written is the one that is printed, with what a second run looks for.
  Json written = json_of("zone/sweep.json");
  for (const char* key : {"family", "files", "read"}) written.erase(key);
  EXPECT_EQ(written, json);
}

TEST_F(SweepCommand, OfShardsMergedIsTheWholeSweep) {
  ASSERT_EQ(sweep("--band=20 --out whole").exit_code, 0);
  for (int i = 3; i >= 1; --i) {
    if (i == 2) expect_refused(3, "merge out", "2 of 3 shards are missing or not whole: 1, 2");
    const Ran ran = sweep(fmt::format("--band=20 --out out --shard {}/3", i));
    EXPECT_EQ(ran.exit_code, 0) << ran.err;
  }
  const Ran merged = done("merge out");
  for (const char* name : every_file)
    EXPECT_EQ(text_of(std::string("out/") + name), text_of(std::string("whole/") + name)) << name;
  const Ran again = sweep("--band=20 --out whole");
  EXPECT_EQ(merged.out, again.out);
}

TEST_F(SweepCommand, OfMoreShardsThanLinesHasEmptyOnes) {
  ASSERT_EQ(sweep("--band=20 --out whole").exit_code, 0);
  for (int i = 1; i <= 7; ++i) {
    const Ran ran = sweep(fmt::format("--band=20 --out out --shard {}/7", i));
    EXPECT_EQ(ran.exit_code, 0) << ran.err;
    EXPECT_FALSE(says(ran.err, "nothing_is_safe"));
  }
  done("merge out");
  EXPECT_EQ(text_of("out/designs.csv"), text_of("whole/designs.csv"));
}

TEST_F(SweepCommand, IsNotDoneAgainUnlessSomethingIsOther) {
  const Ran first = sweep("--out zone");
  ASSERT_EQ(first.exit_code, 0) << first.err;
  EXPECT_TRUE(says(first.err, "wrote zone/"));
  const auto is_done_again = [&](const std::string& more) {
    const Ran ran = sweep("--out zone " + more);
    EXPECT_EQ(ran.exit_code, 0) << ran.err;
    return ran.err.find("is there already") == ran.err.npos;
  };
  const Ran second = sweep("--out zone");
  EXPECT_TRUE(says(second.err, "condyle: note: is there already, of the same inputs, options and version\n"));
  EXPECT_EQ(second.out, first.out);
  EXPECT_TRUE(is_done_again("--set stem.version=10"));
  EXPECT_FALSE(is_done_again("--set stem.version=10"));
  EXPECT_TRUE(is_done_again("--bearing count"));
  EXPECT_TRUE(is_done_again("--band=20"));
  EXPECT_TRUE(is_done_again("--band=20 --seed 2"));
  append("daily.csv", "bending,abduction,20,,\n");
  EXPECT_TRUE(is_done_again("--band=20 --seed 2"));
  EXPECT_FALSE(is_done_again("--band=20 --seed 2"));
}

TEST_F(SweepCommand, DoesADamagedShardAgainAndMergesNone) {
  for (int i = 1; i <= 2; ++i) ASSERT_EQ(sweep(fmt::format("--out out --shard {}/2", i)).exit_code, 0);
  const std::string whole = text_of("out/shards/2_of_2/designs.csv");
  for (const char* damage : {"designs.csv", "safe.csv", "sweep.json"}) {
    const fs::path path = folder / "out/shards/2_of_2" / damage;
    fs::resize_file(path, fs::file_size(path) - 7);
    expect_refusal(run("merge out"), 3, "1 of 2 shards is missing or not whole: 2", damage);
    const Ran again = sweep("--out out --shard 2/2");
    EXPECT_EQ(again.exit_code, 0) << again.err;
    EXPECT_FALSE(says(again.err, "is there already")) << damage;
    EXPECT_EQ(text_of("out/shards/2_of_2/designs.csv"), whole);
  }
  done("merge out");
  ASSERT_EQ(sweep("--out out --shard 2/2 --bearing count").exit_code, 0);
  expect_refused(3, "merge out", "is of another joint, other targets, options or another version");
  ASSERT_EQ(sweep("--out out --shard 1/3").exit_code, 0);
  expect_refused(3, "merge out", "shards of 2 and of 3 lie there");
}

TEST_F(SweepCommand, RefusesWrongWordsInOneLineAndWritesNothing) {
  done("sample hip --out plain");
  write("wrong.csv", "name,motion,reach_deg\nsitting,flexoin,110\n");
  write("far.csv",
        "name,motion,reach_deg\nsitting,flexion,110\n"
        "bowing,flexion,200\n");
  for (const auto& [arguments, code, says] :
       {std::tuple{"hip.toml --vary cup.inclinaton=30:50:5 --targets daily.csv", 2,
                   "there is no parameter \"cup.inclinaton\""},
        {"hip.toml --vary '' --targets daily.csv", 2, "no parameter is given"},
        {"plain/hip.toml --vary cup.inclination=30:50:5 --targets daily.csv", 2,
         "the joint has no part with parameters: its file has no [[part]]"},
        {"hip.toml --vary cup.inclination=30:50:5 --targets nothere.csv", 3, "nothere.csv: no such file"},
        {"hip.toml --vary cup.inclination=30:50:5 --targets wrong.csv", 3,
         "wrong.csv: line 2: motion: unknown motion \"flexoin\""},
        {"hip.toml --vary cup.inclination=30:50:5 --targets far.csv", 3,
         "far.csv: line 3: reach_deg: 200 must be above 0 and up to the motion's range, 180"},
        {"hip.toml --vary cup.inclination=30:50:5 --targets daily.csv --shard 4/3", 2, "such as 3/7"},
        {"hip.toml --vary cup.inclination=30:50:5", 2, "--targets"}})
    expect_refusal(run(fmt::format("sweep {} --out zone", arguments)), code, says, arguments);
  expect_refusal(sweep("--shard 1/3"), 2, "--shard: needs --out", "no folder");
  EXPECT_FALSE(fs::exists(folder / "zone"));
}

TEST_F(SweepCommand, RefusesStandardDeviationsThatItDoesNotUse) {
  for (const char* option : {"--sigma-centre 1", "--sigma-axes 1", "--sigma-surface 1"})
    expect_refusal(sweep(std::string("--band=20 ") + option), 2, "a sweep displaces parameters of parts only",
                   option);
}

TEST_F(SweepCommand, NotesTheValueOfAParameterThatItVaries) {
  const Ran ran = sweep("--set cup.inclination=42");
  EXPECT_EQ(ran.exit_code, 0) << ran.err;
  EXPECT_TRUE(says(ran.err, "value_is_swept: cup.inclination was set to 42"));
}

TEST_F(SweepCommand, RefusesABandOfPartsWithoutStandardDeviations) {
  std::string text = text_of("hip.toml");
  for (std::size_t at; (at = text.find("\nsigma = ")) != text.npos;)
    text.erase(at, text.find('\n', at + 1) - at);
  write("certain.toml", text);
  const Ran ran = run(fmt::format("sweep certain.toml {} --targets daily.csv --band=20 --out zone", vary));
  expect_refusal(ran, 2, "a band needs a parameter with a standard deviation", "--band");
  EXPECT_FALSE(fs::exists(folder / "zone"));
}

}  // namespace
}  // namespace condyle::test
