#include "motion_scene.hpp"

/// Notes on layers, loads and motions, in the command's text, its JSON and under --strict.

namespace condyle::test {
namespace {

/// The codes that standard error and the JSON answer have.
std::vector<std::string> codes_in(const Ran& ran) {
  std::vector<std::string> codes;
  const Json answer = Json::parse(ran.out);
  for (const auto& note : answer["notes"]) {
    codes.push_back(note["code"]);
    EXPECT_TRUE(says(ran.err, "condyle: note: " + codes.back() + ": "));
  }
  return codes;
}

bool has(const std::vector<std::string>& codes, const char* code) {
  return std::find(codes.begin(), codes.end(), code) != codes.end();
}

TEST_F(Motion, LayersThatNothingHasAreNoted) {
  struct Case {
    const char *options, *code;
  };
  for (const Case& each : {Case{"--e 1e9", "unlikely_modulus"}, Case{"--nu 0.4999", "unlikely_poisson_ratio"},
                           Case{"--thickness 1500", "unlikely_thickness"}}) {
    const std::string load = std::string("load cup.toml --pose y=-0.5 --json ") + each.options;
    const Ran ran = done(load);
    EXPECT_TRUE(has(codes_in(ran), each.code)) << ran.err;
    const Ran strict = run(load + " --strict");
    EXPECT_EQ(strict.exit_code, 4);
    EXPECT_TRUE(strict.out.empty());
  }
  const auto usual = codes_in(run("load cup.toml --pose y=-0.5 --json"));
  for (const char* code :
       {"unlikely_modulus", "unlikely_poisson_ratio", "unlikely_thickness", "large_strain"})
    EXPECT_FALSE(has(usual, code)) << code;
}

TEST_F(Motion, LoadsAndOverlapsBeyondWhatLayersBearAreNoted) {
  EXPECT_TRUE(has(codes_in(run("load cup.toml --force 0 -8000 0 --json")), "unlikely_load"));
  EXPECT_TRUE(has(codes_in(run("load cup.toml --pose y=-3 --json")), "large_strain"));
  EXPECT_TRUE(has(codes_in(run("load cup.toml --pose y=-8 --json")), "deeper_than_layers"));
  write("bone.toml",
        joint("free", "cup.ply", "ball.ply", "[contact]\ncasting = \"fixed\"\n" + layer("mobile")));
  EXPECT_FALSE(has(codes_in(run("load bone.toml --pose y=-0.5 --json")), "layer_on_bone")) << "6 mm on 16.5";
  EXPECT_TRUE(has(codes_in(run("load bone.toml --thickness 3 --pose y=-0.5 --json")), "layer_on_bone"));
}

TEST_F(Motion, RecordedNumbersInAnotherUnitAreNoted) {
  // Degrees and millimetres under names that say radians and metres.
  write("wrong.csv", "time,flexion_rad,y_m\n0,0,0\n0.1,40,-0.2\n0.2,90,-5\n0.3,90,-5\n");
  const Ran ran = done("motion cup.toml --motion wrong.csv --json");
  const auto codes = codes_in(ran);
  EXPECT_TRUE(has(codes, "unlikely_angle"));
  EXPECT_TRUE(has(codes, "unlikely_translation"));
  EXPECT_TRUE(has(codes, "mostly_apart"));
  EXPECT_EQ(run("motion cup.toml --motion wrong.csv --strict").exit_code, 4);
  write("right.csv", "time,flexion_deg,y_mm\n0,0,0\n0.1,40,-0.2\n0.2,90,-0.5\n");
  for (const char* code : {"unlikely_angle", "unlikely_translation", "mostly_apart", "mostly_deep"})
    EXPECT_FALSE(has(codes_in(run("motion cup.toml --motion right.csv --json")), code)) << code;
}

TEST_F(Motion, ASignThatPutsTheBodiesIntoEachOtherIsNoted) {
  write("deep.csv", "time,y_mm\n0,-1\n0.1,-14\n0.2,-15\n0.3,-14\n");
  const auto codes = codes_in(run("motion cup.toml --motion deep.csv --load --json"));
  EXPECT_TRUE(has(codes, "mostly_deep"));
  EXPECT_TRUE(has(codes, "deeper_than_layers"));
}

TEST_F(Motion, AnswersSayWhatTheTrianglesSizeLeavesOpen) {
  const Json json = answer("load cup.toml --force 0 -1500 0");
  const double force = json["on_mobile"]["force_n"][1], refined = json["refined_force_n"][1];
  EXPECT_NE(force, refined);
  EXPECT_NEAR(refined, force, 0.1 * force);
  EXPECT_TRUE(says(run("load cup.toml --force 0 -1500 0").out, "with 16 rays in each triangle"));
  EXPECT_EQ(answer("load cup.toml --pose y=-0.5 --rule face_centre")["refined_force_n"], nullptr);
}

TEST_F(Motion, ALoadHasTheArcsThatDepthHasAtItsPose) {
  done("sample cartilages --scenario 5 --out layers");
  write_edited("layers/cartilages.toml", "layers/cartilages.toml", "kind = \"ball\"",
               "kind = \"free\"\njoint = \"hip\"");
  const std::string about = " --about '0 0 1 60 0 0'";
  const std::string asked =
      "load layers/cartilages.toml --e 12 --nu 0.42 --thickness 1.5 --force 0 1500 -200" + about;
  const Json load = answer(asked);
  std::string matrix;
  for (const Json& row : load["X_FM"])
    for (const double number : row) matrix += fmt::format("{} ", number);
  const Json depth =
      answer("depth layers/cartilages.toml --method tangential" + about + " --pose '" + matrix + "'");
  ASSERT_GT(load["arcs"]["max_tangential_depth_mm"], 0);
  for (const auto& [key, value] : load["arcs"].items()) EXPECT_EQ(value, depth[key]) << key;
  EXPECT_TRUE(says(run(asked).out, "mm along the arc of the axis"));

  const std::string open = "load cup.toml --force 0 -1500 0" + about;
  EXPECT_EQ(answer(open)["arcs"]["bodies"]["mobile"], nullptr);
  EXPECT_TRUE(says(run(open).out, "open")) << run(open).out;
}

TEST_F(Motion, ARecordingThatEndsInContactSaysSo) {
  write("swing.csv", "time,flexion_deg\n0,0\n0.1,30\n");
  const Json contact =
      answer("motion shank.toml --motion swing.csv --out out")["between_samples"]["contacts"][0];
  EXPECT_EQ(contact["exit"]["kind"], "recording_ends");
  EXPECT_EQ(contact["exit"]["uncertainty_s"], nullptr);
  EXPECT_EQ(contact["entry"]["kind"], "exact");
  const std::string csv = text_of("out/contacts.csv");
  EXPECT_TRUE(
      csv.starts_with("entry_s,entry_kind,entry_uncertainty_s,entry_turned_deg,exit_s,exit_kind,"
                      "exit_uncertainty_s,exit_turned_deg,is_certain,"))
      << csv;
  EXPECT_TRUE(says(csv, ",0.1,recording_ends,,"));
  EXPECT_TRUE(says(run("motion shank.toml --motion swing.csv").out, "to 0.100000 s (recording ends)"));
}

}  // namespace
}  // namespace condyle::test
