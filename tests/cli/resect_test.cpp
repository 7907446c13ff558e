#include "command.hpp"
#include "condyle/answer.hpp"
#include "condyle/io/joint_file.hpp"

/// `condyle resect` says what answer_resection() answers, and writes a joint that has the limits it says.

namespace condyle::test {
namespace {

class ResectCommand : public CommandTest {
 protected:
  void SetUp() override { sample_into(here, "hip --scenario 1 --alpha-angle 70"); }
  /// Plans are for the joint as given where no band is requested: varied joints take seconds.
  static std::string without_band(const std::string& arguments) {
    const bool is_plan = arguments.starts_with("resect") && arguments.find("--band") == arguments.npos;
    return arguments + (is_plan ? " --band=0" : "");
  }
  Ran run(const std::string& arguments) const { return CommandTest::run(without_band(arguments)); }
  Ran done(const std::string& arguments) const { return CommandTest::done(without_band(arguments)); }
  Json resected(const std::string& arguments) const {
    return Json::parse(done("resect hip.toml --json " + arguments).out);
  }
  void mark_all_vertices() const {
    std::string marks;
    for (std::size_t v = 0; v < io::read_mesh(here / "femur.ply").mesh.vertices.size(); ++v) marks += "1\n";
    write("marks.txt", marks);
  }
};

TEST_F(ResectCommand, SaysWhatTheLibraryAnswers) {
  const Json json =
      resected("--reach 'internal_rotation_at_90_flexion=45 fadir=30' --curve 2 --band=20 --out plan");
  const io::LoadedJoint loaded = io::read_joint(folder / "hip.toml");
  ResectionRequest request;
  request.resection.targets =
      reach_targets(motion::hip_motions(), "internal_rotation_at_90_flexion=45 fadir=30");
  request.curve_points = 2;
  request.bands = BandRequest{.samples = 20};
  const ResectionAnswer expected = answer_resection(loaded, request);
  ASSERT_EQ(json["cuts"].size(), 1u);
  EXPECT_EQ(json["cuts"][0]["volume_mm3"], expected.resection.mobile->volume_mm3);
  EXPECT_EQ(json["cuts"][0]["deepest_mm"], expected.resection.mobile->deepest_mm);
  for (std::size_t i = 0; i < 2; ++i)
    EXPECT_EQ(json["targets"][i]["after"]["limit_deg"],
              expected.resection.targets[i].after.end.turned.degrees());
  for (std::size_t i = 0; i < expected.after.size(); ++i) {
    EXPECT_NEAR(json["limits"][i]["after"]["limit_deg"], expected.after[i].end.turned.degrees(), 1e-12);
    EXPECT_EQ(json["limits"][i]["gain_deg"], expected.gain[i].degrees());
  }
  EXPECT_EQ(json["confidence"], 0.5);
  EXPECT_EQ(json["displaced"], 20);
  ASSERT_EQ(json["alternatives"].size(), 2u);
  EXPECT_EQ(json["alternatives"][0]["volume_mm3"], expected.resection.volume_mm3());
  EXPECT_GT(json["alternatives"][1]["volume_mm3"], expected.resection.volume_mm3());
  EXPECT_EQ(json["targets"][0]["text"], expected.promises[0].text);
  EXPECT_EQ(json["targets"][0]["confidence_reached"], expected.promises[0].confidence_reached);
  EXPECT_EQ(json["targets"][0]["other_centre"], nullptr) << "head and socket of the sample have one centre";
  // Before and after the cut all motions have a band, and one that ends with the range has its number and says so.
  const Json& faber = json["limits"].back();
  for (const char* band : {"before_band", "band"}) {
    EXPECT_EQ(faber[band]["p95_deg"], 120.0);
    EXPECT_TRUE(faber[band]["text"].get<std::string>().ends_with(">120")) << faber[band]["text"];
  }
  const std::string csv = text_of("plan/limits.csv");
  EXPECT_TRUE(says(csv, fmt::format(",{},{}\n", faber["band"]["median_deg"].get<double>(), 120)));
  ASSERT_EQ(json["curve"].size(), expected.curve.size());
  // fadir is reached already: it has no curve.
  EXPECT_EQ(json["curve"].size(), 2u);
  EXPECT_LT(json["curve"][0]["volume_mm3"], json["curve"][1]["volume_mm3"]);
  ASSERT_EQ(json["resection_notes"].size(), expected.notes.size());
  for (std::size_t i = 0; i < expected.notes.size(); ++i)
    EXPECT_EQ(json["resection_notes"][i]["text"], expected.notes[i].text);
}

TEST_F(ResectCommand, SaysANoteOnceByItsCodeOnStandardError) {
  const Ran text = run("resect hip.toml --reach flexion=10"),
            json = run("resect hip.toml --reach flexion=10 --json");
  const Json note = Json::parse(json.out)["resection_notes"][0];
  EXPECT_FALSE(says(text.out, note["text"].get<std::string>()));
  for (const Ran& ran : {text, json})
    EXPECT_EQ(ran.err, "condyle: note: nothing_to_do: " + note["text"].get<std::string>() + "\n");
}

TEST_F(ResectCommand, APlanOfAHipSaysWhatFollowUpsFoundAndKeepsWhoseItIs) {
  append("hip.toml", "\n[person]\nage = 31\nsex = \"male\"\n");
  const std::string said =
      resected("--reach internal_rotation_at_90_flexion=45 --curve 0 --out plan")["caveats"].dump();
  EXPECT_TRUE(says(said, "13 patients"));
  const Person person = io::read_joint(folder / "plan" / "resected.toml").joint.person;
  EXPECT_EQ(person.age_years, 31);
  EXPECT_EQ(person.sex, Sex::male);
  // An elbow is no hip.
  edit("hip.toml", "kind = \"ball\"", "kind = \"hinge\"\njoint = \"elbow\"");
  EXPECT_FALSE(says(resected("--reach flexion=60 --curve 0 --accept-reference-contact")["caveats"].dump(),
                    "patients"));
}

TEST_F(ResectCommand, WritesAJointWithTheLimitsItSays) {
  const Json json = resected("--reach internal_rotation_at_90_flexion=45 --curve 0 --out plan");
  for (const char* name : {"resection.json", "limits.csv", "hours.csv", "depth_mobile.vtp", "resected.toml",
                           "resected_mobile.ply", "resected_fixed.ply"})
    EXPECT_TRUE(fs::exists(folder / "plan" / name)) << name;
  EXPECT_FALSE(fs::exists(folder / "plan" / "curve.csv"));
  const Json limits = answer("rom plan/resected.toml")["motions"];
  for (std::size_t i = 0; i < limits.size(); ++i)
    EXPECT_EQ(limits[i]["limit_deg"], json["limits"][i]["after"]["limit_deg"]) << limits[i]["motion"];
}

TEST_F(ResectCommand, AJointThatWasCutSaysSoInEveryAnswer) {
  const Json json = resected("--reach internal_rotation_at_90_flexion=45 --curve 0 --out plan");
  const std::string planned =
      fmt::format("without {:.1f} mm3 of {}, from hip.toml", json["cuts"][0]["volume_mm3"].get<double>(),
                  json["cuts"][0]["name"].get<std::string>());
  for (const std::string command : {"rom", "depth", "measure", "frame"}) {
    const Ran said = run(command + " plan/resected.toml");
    EXPECT_TRUE(says(said.out, ", resected")) << command;
    EXPECT_TRUE(says(said.out, "  planned: " + planned));
    const Json of = answer(command + " plan/resected.toml");
    EXPECT_EQ(of["provenance"]["planned"], planned) << command;
  }
  // Cut once more: the name says it once, and the list has both.
  done("resect plan/resected.toml --reach internal_rotation_at_90_flexion=50 --curve 0 --out again");
  const io::JointFile again = io::read_joint_file(folder / "again/resected.toml");
  EXPECT_EQ(again.joint.planned.rfind(planned + ", without ", 0), 0u) << again.joint.planned;
  EXPECT_EQ(again.joint.name.find("resected"), again.joint.name.rfind("resected"));
}

TEST_F(ResectCommand, KeepsTheColumnsOfARecordedMotion) {
  append("hip.toml",
         "\n[recorded_motion]\n"
         "flexion = { column = \"a \\\"quoted\\\" one\", unit = \"rad\", sign = -1, offset = 0.5, range = "
         "[-1, 2] }\n"
         "adduction = { column = \"b\", default = 3, locked = true }\n");
  done("resect hip.toml --reach internal_rotation_at_90_flexion=45 --curve 0 --out plan");
  const auto columns_of = [&](const char* file) {
    return std::get<std::vector<io::ColumnOfCoordinate>>(*io::read_joint_file(folder / file).recorded_motion);
  };
  const auto before = columns_of("hip.toml"), after = columns_of("plan/resected.toml");
  ASSERT_EQ(after.size(), before.size());
  for (std::size_t i = 0; i < before.size(); ++i) {
    EXPECT_EQ(after[i].coordinate, before[i].coordinate);
    EXPECT_EQ(after[i].column, before[i].column);
    EXPECT_EQ(after[i].unit, before[i].unit);
    EXPECT_EQ(after[i].sign, before[i].sign);
    EXPECT_EQ(after[i].offset, before[i].offset);
    EXPECT_EQ(after[i].otherwise, before[i].otherwise);
    EXPECT_EQ(after[i].range, before[i].range);
    EXPECT_EQ(after[i].is_locked, before[i].is_locked);
  }
}

TEST_F(ResectCommand, SaysThatPosesOfTheMeshesAsGivenAreLeftOut) {
  append("hip.toml",
         "\n[recorded_motion]\nfixed_body = \"pelvis\"\nmobile_body = \"femur\"\nunits = \"mm\"\n");
  done("resect hip.toml --reach internal_rotation_at_90_flexion=45 --curve 0 --out plan");
  EXPECT_FALSE(io::read_joint_file(folder / "plan/resected.toml").recorded_motion);
  EXPECT_TRUE(says(text_of("plan/resected.toml"), "# [recorded_motion] is left out"));
}

TEST_F(ResectCommand, StoppedGivesTheCutForTheJointAsGiven) {
  const std::string reach = "--reach internal_rotation_at_90_flexion=45 --margin 0.3";
  const Ran stopped =
      run_interrupted(here, "resect hip.toml --json --out plan --band=5000 " + reach, "joints of the band");
  EXPECT_EQ(stopped.exit_code, 130) << stopped.err;
  EXPECT_TRUE(says(stopped.err, "condyle: interrupted; the answer is what there was until then\n"));
  const Json json = Json::parse(stopped.out), whole = resected(reach + " --curve 0");
  EXPECT_TRUE(has_note(json, "stopped", "resection_notes"));
  EXPECT_FALSE(has_note(whole, "stopped", "resection_notes"));
  EXPECT_TRUE(json["confidence"].is_null() && json["curve"].empty() && json["alternatives"].empty());
  EXPECT_EQ(json["targets"], whole["targets"]);
  EXPECT_EQ(json["limits"], whole["limits"]);
  EXPECT_EQ(json["cuts"][0]["volume_mm3"], whole["cuts"][0]["volume_mm3"]);
  EXPECT_EQ(json_of("plan/resection.json"), json);
  EXPECT_TRUE(
      says(text_of("plan/limits.csv"),
           "# note: stopped: ended before varied joints were tried: the cut is for the joint as given"));
  EXPECT_TRUE(says(run_interrupted(here, "resect hip.toml --band=5000 " + reach, "joints of the band").out,
                   "  stopped: ended before varied joints were tried"));
}

TEST_F(ResectCommand, NothingToDoIsAnAnswer) {
  const Json json = resected("--reach flexion=20 --out plan");
  EXPECT_TRUE(json["cuts"].empty());
  EXPECT_EQ(json["resection_notes"][0]["code"], "nothing_to_do");
  EXPECT_FALSE(fs::exists(folder / "plan" / "resected.toml"));
}

// With a margin the sweep has to be looked at; that nothing goes is no cut.
TEST_F(ResectCommand, ACutThatTakesNothingIsNone) {
  const Json json = resected("--reach internal_rotation_at_90_flexion=30 --margin 0.5 --curve 0");
  EXPECT_EQ(json["targets"][0]["reach_deg"], 30.0);
  EXPECT_TRUE(json["cuts"].empty());
  EXPECT_EQ(json["resection_notes"][0]["code"], "nothing_to_do");
  for (const Json& measure : json["measures"])
    EXPECT_EQ(measure["before"], measure["after"]) << measure["key"];
}

// A wide ball of what bears: triangles on its border are met as a whole, their pieces are not.
TEST_F(ResectCommand, WhatSmallerTrianglesGainIsSaid) {
  const Json json = resected("--reach internal_rotation_at_90_flexion=40 --bearing 5 --curve 0");
  EXPECT_TRUE(has_note(json, "finer_triangles", "resection_notes"));
  // What they gain is no gain of the cut: nothing of it was in the way.
  bool any = false;
  for (const Json& limit : json["limits"]) {
    const double gained =
        limit["after"]["limit_deg"].get<double>() - limit["before"]["limit_deg"].get<double>();
    EXPECT_LE(limit["gain_deg"].get<double>(), std::max(gained, 0.0)) << limit["motion"];
    any |= limit["gain_deg"] == 0;
    if (limit["gain_deg"] == 0) {
      EXPECT_EQ(gained, 0) << limit["motion"];
    }
  }
  EXPECT_TRUE(any);
  EXPECT_FALSE(has_note(json, "nothing_to_do", "resection_notes"));
  EXPECT_FALSE(has_note(resected("--reach internal_rotation_at_90_flexion=45 --curve 0"), "finer_triangles",
                        "resection_notes"));
}

// Neither the joint space nor what bears depends on the triangles around a cut.
TEST_F(ResectCommand, ARimThatIsCutLeavesHeadSocketAndMarginWhatTheyWere) {
  const Json json = resected("--reach internal_rotation_at_90_flexion=45 --from fixed --curve 0 --out plan");
  std::size_t spaces = 0;
  for (const Json& measure : json["measures"])
    if (measure["key"] == "joint_space_least_mm") {
      ASSERT_TRUE(measure["before"].is_number() && measure["after"].is_number());
      EXPECT_GE(measure["after"], measure["before"]);
      ++spaces;
    }
  EXPECT_EQ(spaces, 1u);
  // The socket that resected.toml states is found on its mesh.
  const Json shape = answer("measure plan/resected.toml");
  for (std::size_t i = 0; i < shape["measures"].size(); ++i) {
    const Json &value = shape["measures"][i]["value"], &after = json["measures"][i]["after"];
    ASSERT_EQ(value.is_null(), after.is_null()) << shape["measures"][i]["key"];
    if (!value.is_null()) {
      EXPECT_NEAR(value, after, 1e-6) << shape["measures"][i]["key"];
    }
    const std::string note = shape["measures"][i]["note"].is_null() ? "" : shape["measures"][i]["note"];
    EXPECT_FALSE(says(note, "no socket"));
  }
  const motion::BearingFinding before =
                                   motion::find_bearing_surface(io::read_joint(folder / "hip.toml").joint),
                               after = motion::find_bearing_surface(
                                   io::read_joint(folder / "plan/resected.toml").joint);
  EXPECT_EQ(after.surface->margin_mm, before.surface->margin_mm);
  EXPECT_EQ(after.surface->head.radius, before.surface->head.radius);
  ASSERT_TRUE(before.surface->socket);
  EXPECT_NEAR((after.surface->socket->centre - before.surface->socket->centre).norm(), 0, 1e-12);
}

TEST_F(ResectCommand, MarkedVerticesStay) {
  mark_all_vertices();
  const Json json = resected("--reach internal_rotation_at_90_flexion=45 --curve 0 --protect marks.txt");
  EXPECT_EQ(json["targets"][0]["blocked"]["kept_by"], "marked");
  EXPECT_TRUE(json["cuts"].empty());
  EXPECT_EQ(json["resection_notes"][0]["code"], "target_blocked");
}

TEST_F(ResectCommand, RefusesInOneLine) {
  mark_all_vertices();
  write("short.txt", "1\n0\n");
  std::ofstream(folder / "wrong.txt") << "1\nyes\n";
  for (const auto& [arguments, code, says] :
       {std::tuple{"--reach wink=20", 2, "unknown motion \"wink\""},
        {"--reach flexion=200", 2, "cannot reach 200 degrees"},
        {"--reach flexion", 2, "is not a motion and its degrees"},
        {"--reach flexion=140 --share 0.3", 2, "--share: only with --from both"},
        {"--reach flexion=140 --curve -1", 2, "--curve: "},
        {"--reach flexion=140 --band=20 --confidence 1", 2, "confidence must be above 0 and below 1"},
        {"--reach flexion=140 --margin 1 --confidence 0.8", 2, "--margin excludes --confidence"},
        {"--reach flexion=140 --confidence 0.8", 2,
         "--confidence: is a share of varied joints, and there are none"},
        {"--reach flexion=140 --burr 0.4", 2, "burr's diameter must be from 0.5 to 30 mm"},
        {"--reach flexion=140 --deepest 0", 2, "must be above 0 mm"},
        {"--reach flexion=140 --from fixed --protect marks.txt", 2, "marked to stay, and it is not cut"},
        {"--reach flexion=140 --protect short.txt", 3, "short.txt: 2 marks for the"},
        {"--reach flexion=140 --protect wrong.txt", 3, "line 2: 'yes' is no mark"}}) {
    const std::string given(arguments);
    expect_refusal(run(std::string("resect hip.toml ") +
                       (given.find("--curve") == given.npos ? "--curve 0 " : "") + given),
                   code, says, given);
  }
}

}  // namespace
}  // namespace condyle::test
