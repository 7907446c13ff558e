#include <cstdio>
#include <cstring>
#include <regex>

#include "command.hpp"
#include "condyle/contact.hpp"
#include "condyle/joint_coordinates.hpp"
#include "condyle/sample/hip.hpp"

namespace condyle::test {
namespace {

constexpr const char* deep = "--pose \"flexion=130 internal_rotation=20\"";
const JointAngles deep_angles{Angle::degrees(130), {}, Angle::degrees(20)};

/// The sample hip as `condyle sample hip` writes it, in the folder `sample`: made once, copied for each test.
class SampleJointCommand : public CommandTest {
 protected:
  SampleJointCommand() {
    static const TemporaryFolder once;
    static const Ran made = run_well(once.path(), "sample hip --out sample");
    fs::copy(once / "sample", here / "sample");
  }
  /// Answers without a note.
  Json answer(const std::string& arguments) const {
    const Ran ran = done(arguments + " --json");
    EXPECT_EQ(ran.err, "");
    return Json::parse(ran.out);
  }
  void expect_refused(int exit_code, const std::string& arguments, std::string_view saying) const {
    const std::size_t before = count_entries(here);
    CommandTest::expect_refused(exit_code, arguments, saying);
    EXPECT_EQ(count_entries(here), before) << arguments;
  }
  void edit_joint(std::string_view from, std::string_view to) const { edit("sample/hip.toml", from, to); }
};

TEST_F(SampleJointCommand, IsWrittenWithTheCountsOfItsScenario) {
  const TriMesh femur = io::read_mesh(folder / "sample/femur.ply").mesh;
  const TriMesh hip_bone = io::read_mesh(folder / "sample/hip_bone.ply").mesh;
  EXPECT_EQ(femur.vertices.size(), 773u);
  EXPECT_EQ(femur.triangles.size(), 1542u);
  EXPECT_EQ(hip_bone.vertices.size(), 1221u);
  EXPECT_EQ(hip_bone.triangles.size(), 2442u);
}

TEST_F(SampleJointCommand, AMatrixMayHaveCommentsAboveIt) {
  const double c = std::cos(0.5), s = std::sin(0.5);
  const std::string rows = fmt::format("{} {} 0 0\n{} {} 0 0\n0 0 1 0\n0 0 0 1\n", c, -s, s, c);
  write("plain.txt", rows);
  std::ofstream(folder / "titled.txt") << "\xEF\xBB\xBF# X_FM\r\n  # 4 x 4 numbers\r\n" << rows << "# end\n";
  const Json plain = answer("depth sample/hip.toml --matrix plain.txt"),
             titled = answer("depth sample/hip.toml --matrix titled.txt");
  EXPECT_NEAR(titled["pose_deg"]["flexion"], 0.5 * 180 / std::numbers::pi, 1e-12);
  EXPECT_EQ(titled["pose_deg"], plain["pose_deg"]);
  write("none.txt", "# 1 0 0 0\n");
  expect_refused(3, "depth sample/hip.toml --matrix none.txt", "pose: a matrix begins with a number");
}

TEST_F(SampleJointCommand, DepthIsWhatTheLibraryFinds) {
  const Json json = answer(std::string("depth sample/hip.toml ") + deep);
  const contact::JointContact joint(io::read_mesh(folder / "sample/hip_bone.ply").mesh,
                                    io::read_mesh(folder / "sample/femur.ply").mesh);
  const contact::RadialContact contact = joint.radial(pose_at({.side = Side::right}, deep_angles));
  const auto inside = [](const radial::RadialResults& hits) {
    return std::count(hits.state.begin(), hits.state.end(), PointState::inside);
  };
  EXPECT_TRUE(json["in_contact"]);
  EXPECT_EQ(json["mobile_vertices_inside"], inside(*contact.mobile_in_fixed));
  EXPECT_EQ(json["fixed_vertices_inside"], inside(*contact.fixed_in_mobile));
  EXPECT_GT(json["mobile_vertices_inside"], 0);
  EXPECT_EQ(json["triangle_pairs"], contact.pairs.size());
  const radial::RadialResults& deepest =
      json["deepest_body"] == "mobile" ? *contact.mobile_in_fixed : *contact.fixed_in_mobile;
  EXPECT_EQ(json["max_radial_depth_mm"], -deepest.radial_gap_mm[json["deepest_vertex"].get<std::size_t>()]);
  EXPECT_EQ(json["deepest_point_mm"].size(), 3u);
  EXPECT_LE(json["max_facing_radial_depth_mm"], json["max_radial_depth_mm"]);
  EXPECT_GT(json["min_gap_mm"], 0);
}

TEST_F(SampleJointCommand, DepthLeadsWithTheReliableOne) {
  const Json json = answer(std::string("depth sample/hip.toml ") + deep);
  EXPECT_EQ(json["method"], "reliable");
  const Json& reliable = json["reliable_depth"];
  // The deepest vertex along its ray is a vertex of the rim: the ray runs along the bone.
  EXPECT_EQ(json["depth_to_read"], "tangential");
  EXPECT_LT(reliable["depth_mm"], json["max_radial_depth_mm"]);
  EXPECT_GE(reliable["depth_mm"], json["max_facing_radial_depth_mm"]);
  EXPECT_EQ(reliable["kind"], "tangential");
  const std::string about = reliable["about"];
  EXPECT_EQ(reliable["rotations"][about]["depth_mm"], reliable["depth_mm"]);
  for (const auto& [axis, way] : reliable["rotations"].items()) {
    if (!way.is_null()) {
      EXPECT_GE(way["depth_mm"], reliable["depth_mm"]) << axis;
    }
  }
  EXPECT_LE(reliable["nearest_distance_mm"], reliable["depth_mm"].get<double>() + 1e-9);
  EXPECT_GT(json["contact"]["mobile"]["area_mm2"], 0);
  EXPECT_GT(json["contact"]["fixed"]["mean_depth_mm"], 0);
  EXPECT_GT(json["contact"]["volume_mm3"], 0);
  EXPECT_EQ(json["nearest_distance_mm"], 0);

  const std::string text = run(std::string("depth sample/hip.toml ") + deep).out;
  char volume[64];
  std::snprintf(volume, sizeof volume, "penetration volume: %.4f mm3, to within",
                json["contact"]["volume_mm3"].get<double>());
  const std::size_t at = text.find(volume);
  ASSERT_NE(at, text.npos) << text;
  const double error_mm3 = json["contact"]["volume_error_mm3"];
  EXPECT_GT(error_mm3, 0);
  const double said_mm3 = std::strtod(text.c_str() + at + std::strlen(volume), nullptr);
  EXPECT_GE(said_mm3, error_mm3) << "a bound is rounded up";
  EXPECT_LT(said_mm3, 2 * error_mm3);
  EXPECT_LT(error_mm3, 1e-5);
  EXPECT_FALSE(says(text, "smallest gap")) << "in contact";
  EXPECT_TRUE(says(run("depth sample/hip.toml").out, "smallest gap"));
  EXPECT_TRUE(says(text, " mm along the arc of " + about));
  char unreliable[32];
  std::snprintf(unreliable, sizeof unreliable, "%.3f", json["max_radial_depth_mm"].get<double>());
  EXPECT_FALSE(says(text, unreliable)) << "only in JSON";

  const Json radial = answer(std::string("depth sample/hip.toml --method radial ") + deep);
  EXPECT_EQ(radial["reliable_depth"]["depth_mm"], json["max_facing_radial_depth_mm"]);
  EXPECT_GT(radial["vertices_without_depth"], 0);
  EXPECT_EQ(radial["contact"], json["contact"]);
}

TEST_F(SampleJointCommand, VerticesAreWrittenAsATableOnRequest) {
  const Json json = CommandTest::answer(std::string("depth sample/hip.toml --csv --out deep ") + deep);
  const std::vector<std::string> lines = lines_of(text_of("deep/mobile.csv"));
  EXPECT_TRUE(lines[0].starts_with(
      "vertex,x_mm,y_mm,z_mm,depth_mm,depth_is_reliable,depth_kind,nearest_distance_mm,"))
      << lines[0];
  const TriMesh posed_femur = io::read_mesh(folder / "deep/mobile.vtp").mesh;
  ASSERT_EQ(lines.size(), 1 + posed_femur.vertices.size());
  double deepest = 0;
  for (std::size_t v = 0; v + 1 < lines.size(); ++v) {
    const std::string& line = lines[v + 1];
    double x, y, z, depth;
    std::size_t vertex;
    ASSERT_EQ(std::sscanf(line.c_str(), "%zu,%lf,%lf,%lf,%lf,", &vertex, &x, &y, &z, &depth), 5) << line;
    EXPECT_EQ(vertex, v);
    EXPECT_EQ(Vec3(x, y, z), posed_femur.vertices[v]);
    deepest = std::max(deepest, depth);
    EXPECT_FALSE(says(line, "nan"));
    EXPECT_FALSE(says(line, ",-0,"));
  }
  EXPECT_GT(deepest, 0);
  EXPECT_TRUE(fs::exists(folder / "deep/fixed.csv"));
  done(std::string("depth sample/hip.toml --out deep ") + deep);
  EXPECT_FALSE(fs::exists(folder / "deep/fixed.csv")) << "of an earlier run";
}

TEST_F(SampleJointCommand, TheNeutralPoseIsFreeWithTheJointSpaceAsGap) {
  const Json json = answer("depth sample/hip.toml");
  EXPECT_FALSE(json["in_contact"]);
  EXPECT_EQ(json["mobile_vertices_inside"], 0);
  EXPECT_EQ(json["triangle_pairs"], 0);
  EXPECT_EQ(json["max_radial_depth_mm"], 0);
  EXPECT_TRUE(json["deepest_vertex"].is_null());
  EXPECT_TRUE(json["deepest_point_mm"].is_null());
  // A joint space of 3.5 mm between surfaces of flat triangles.
  EXPECT_GT(json["min_gap_mm"], 3);
  EXPECT_LT(json["min_gap_mm"], 3.6);
  EXPECT_GT(json["nearest_distance_mm"], 3);
  EXPECT_LE(json["nearest_distance_mm"], json["min_gap_mm"]);
  EXPECT_TRUE(json["reliable_depth"].is_null());
  EXPECT_TRUE(json["contact"]["centroid_mm"].is_null());
  EXPECT_EQ(json["contact"]["volume_mm3"], 0);
}

TEST_F(SampleJointCommand, TheTangentialMethodGivesAnglesAndArcs) {
  for (const char* about : {"flexion", "adduction", "internal_rotation"}) {
    const Json radial = answer(std::string("depth sample/hip.toml ") + deep);
    const Json json =
        answer(std::string("depth sample/hip.toml --method tangential --about ") + about + " " + deep);
    EXPECT_EQ(json["method"], "tangential");
    EXPECT_EQ(json["about"], about);
    // Axes other than a coordinate axis round once more; no vertex of this sample is that near to a surface.
    EXPECT_EQ(json["mobile_vertices_inside"], radial["mobile_vertices_inside"]) << about;
    EXPECT_EQ(json["fixed_vertices_inside"], radial["fixed_vertices_inside"]) << about;
    EXPECT_EQ(json["triangle_pairs"], radial["triangle_pairs"]);
    EXPECT_GT(json["max_tangential_depth_deg"], 0);
    EXPECT_GT(json["max_tangential_depth_mm"], 0);
    EXPECT_FALSE(json.contains("max_radial_depth_mm"));
  }
}

TEST_F(SampleJointCommand, ArcsGoAboutAnyAxis) {
  const auto arguments = [&](const std::string& about) {
    return fmt::format("depth sample/hip.toml --method tangential --about \"{}\" {}", about, deep);
  };
  const Json angle = answer(arguments("flexion")), same = answer(arguments("0 0 2")),
             other = answer(arguments("-0.6,0,+0.8 5 -40 1e1"));
  EXPECT_TRUE(same["about"].is_null());
  for (const char* key : {"axis", "axis_point_mm", "max_tangential_depth_deg", "min_gap_mm", "bodies"})
    EXPECT_EQ(same[key], angle[key]) << key;
  EXPECT_NEAR(other["axis"][0].get<double>(), -0.6, 1e-15);
  EXPECT_EQ(other["axis_point_mm"], (Json{5.0, -40.0, 10.0}));
  EXPECT_NE(other["max_tangential_depth_mm"], angle["max_tangential_depth_mm"]);
  EXPECT_TRUE(
      says(run(arguments("0 0 1 5 0 0")).out, "along the arc of the axis (0, 0, 1) through (5, 0, 0) mm"));

  expect_refused(2, arguments("0 0 0"), "joint axis: its direction is zero");
  expect_refused(2, arguments("0 1"), "about: an axis has 3 numbers, or 6 with a point of it in mm, not 2");
  expect_refused(2, arguments("0 inf 1"), "about: 'inf' in the axis is not a finite number");
  expect_refused(2, "picture sample/hip.toml --colour gap --about flexion --out gap.png",
                 "about: is for the colours of depths");
}

TEST_F(SampleJointCommand, ResultsAreWrittenTogether) {
  const Json json = CommandTest::answer(std::string("depth sample/hip.toml --out deep ") + deep);
  EXPECT_EQ(json_of("deep/depth.json"), json);
  const std::vector<std::string> pairs = lines_of(text_of("deep/pairs.csv"));
  EXPECT_EQ(pairs[0], "fixed_triangle,mobile_triangle");
  EXPECT_EQ(pairs.size() - 1, json["triangle_pairs"]);

  const TriMesh femur = io::read_mesh(folder / "sample/femur.ply").mesh;
  EXPECT_EQ(io::read_mesh(folder / "deep/fixed.vtp").mesh,
            io::read_mesh(folder / "sample/hip_bone.ply").mesh);
  EXPECT_EQ(io::read_mesh(folder / "deep/mobile.vtp").mesh,
            posed(pose_at({.side = Side::right}, deep_angles), femur));
  for (const char* name : {"deep/fixed.vtp", "deep/mobile.vtp"}) {
    const std::string text = text_of(name);
    for (const char* array :
         {"depth_mm", "depth_is_reliable", "depth_kind", "nearest_distance_mm", "radial_depth_mm",
          "radial_gap_mm", "ray_to_normal_deg", "inside", "triangle", "winding", "in_contact"}) {
      EXPECT_TRUE(says(text, "Name=\"" + std::string(array) + "\"")) << name << " " << array;
    }
  }
}

TEST_F(SampleJointCommand, ThePoseIsEchoedToTheDigit) {
  // Through radians and back 57 and 0.7 are other numbers in the last place.
  const std::string pose = " --pose \"flexion=57 abduction=0.7 external_rotation=0\"";
  const std::string text = run("depth sample/hip.toml --json" + pose).out;
  const Json json = Json::parse(text);
  EXPECT_EQ(json["pose_deg"]["flexion"].get<double>(), 57);
  EXPECT_EQ(json["pose_deg"]["adduction"].get<double>(), -0.7);
  EXPECT_FALSE(std::regex_search(text, std::regex("-0(\\.0)?[^.0-9]"))) << text;
  EXPECT_TRUE(
      says(run("depth sample/hip.toml" + pose).out, "flexion 57, adduction -0.7, internal rotation 0 deg"));
}

TEST_F(SampleJointCommand, EveryFileSaysWhereItComesFrom) {
  const Ran ran =
      done(std::string("--threads 1 depth --out deep --frame joint --json sample/hip.toml ") + deep);
  const Json from = Json::parse(ran.out)["provenance"];
  EXPECT_EQ(from["command"], Json({"depth", "sample/hip.toml", "--pose", "flexion=130 internal_rotation=20",
                                   "--frame", "joint"}));
  const std::string femur = text_of("sample/femur.ply");
  EXPECT_EQ(from["mobile_mesh"]["path"], "sample/femur.ply");
  EXPECT_EQ(from["mobile_mesh"]["bytes"], femur.size());
  EXPECT_EQ(from["mobile_mesh"]["sha256"], io::digest_of(femur).sha256);
  EXPECT_EQ(from["fixed_mesh"]["joint_from_source"],
            Json({{1.0, 0.0, 0.0, 0.0}, {0.0, 1.0, 0.0, 0.0}, {0.0, 0.0, 1.0, 0.0}, {0.0, 0.0, 0.0, 1.0}}));
  const std::string sha = from["fixed_mesh"]["sha256"];
  EXPECT_TRUE(says(text_of("deep/pairs.csv"), sha));
  for (const char* name : {"deep/fixed.vtp", "deep/mobile.vtp"})
    EXPECT_TRUE(says(text_of(name), "Name=\"fixed_mesh\"")) << name;
  EXPECT_TRUE(says(ran.err, "wrote deep/fixed.vtp, deep/mobile.vtp, deep/pairs.csv, deep/depth.json"));

  // Neither the folder nor the number of threads is part of it: runs compare.
  done(std::string("depth sample/hip.toml --threads 4 --out again --frame joint ") + deep);
  for (const auto& entry : fs::directory_iterator(folder / "deep"))
    EXPECT_EQ(io::read_whole_file(entry.path()),
              io::read_whole_file(folder / "again" / entry.path().filename()));
}

TEST_F(SampleJointCommand, InTheSourceFrameMeshesLieOnTheirFiles) {
  edit_joint("centre = [0.0, 0.0, 0.0]", "centre = [1.0, 2.0, -3.0]");
  const std::string command = std::string("depth sample/hip.toml --json --out deep --ascii ") + deep;
  const Json joint = Json::parse(run(command).out),
             source = Json::parse(run(command + " --frame source").out);
  EXPECT_EQ(source["provenance"]["frame"], "source");
  EXPECT_EQ(source["max_radial_depth_mm"], joint["max_radial_depth_mm"]);
  for (std::size_t k = 0; k < 3; ++k)
    EXPECT_NEAR(source["deepest_point_mm"][k].get<double>() - joint["deepest_point_mm"][k].get<double>(),
                (std::array{1, 2, -3})[k], 1e-12);
  const TriMesh fixed = io::read_mesh(folder / "deep/fixed.vtp").mesh,
                file = io::read_mesh(folder / "sample/hip_bone.ply").mesh;
  ASSERT_EQ(fixed.triangles, file.triangles);
  for (std::size_t v = 0; v < file.vertices.size(); ++v)
    EXPECT_LT((fixed.vertices[v] - file.vertices[v]).norm(), 1e-12) << v;
  EXPECT_FALSE(says(text_of("deep/fixed.vtp"), "appended"));
}

TEST_F(SampleJointCommand, AnOpenMeshIsRefusedByItsBoundaryAndStillHasPairs) {
  TriMesh open = io::read_mesh(folder / "sample/hip_bone.ply").mesh;
  open.triangles.erase(open.triangles.begin() + 100);
  io::write_mesh(folder / "sample/hip_bone.ply", open);
  expect_refused(4, "depth sample/hip.toml", "hip_bone.ply: an open boundary of 3 edges near (");
  expect_refused(4, "depth sample/hip.toml --method tangential --out result", "--pairs-only");
  const Ran ran = run(std::string("depth sample/hip.toml --pairs-only --json ") + deep);
  EXPECT_EQ(ran.err,
            "condyle: note: open_mesh: hip bone is open: one body inside the other would not be detected\n");
  const Json json = Json::parse(ran.out);
  ASSERT_EQ(json["notes"].size(), 1u);
  EXPECT_EQ(json["notes"][0]["code"], "open_mesh");
  EXPECT_TRUE(json["mobile_vertices_inside"].is_null());
  EXPECT_FALSE(json["fixed_vertices_inside"].is_null());
  EXPECT_GT(json["triangle_pairs"], 0);
}

TEST_F(SampleJointCommand, AMeshOfInvertedOrientationIsRefusedWithItsRepair) {
  io::write_mesh(folder / "sample/femur.ply", flipped(io::read_mesh(folder / "sample/femur.ply").mesh));
  expect_refused(4, "depth sample/hip.toml", "femur.ply: inverted orientation");
  edit_joint("mesh = \"femur.ply\"", "mesh = \"femur.ply\"\nrepair = [\"flip_inverted\"]");
  EXPECT_FALSE(answer("depth sample/hip.toml")["in_contact"]);
}

TEST_F(SampleJointCommand, WhatLooksWrongIsNotedByEveryCommandAndAnErrorWhenStrict) {
  EXPECT_EQ(run("frame sample/hip.toml --strict").err, "");
  EXPECT_EQ(answer("depth sample/hip.toml --strict")["notes"], Json::array());
  edit_joint("side = \"right\"", "side = \"left\"");
  write("flexion.csv", "time_s,flexion_deg\n0,0\n1,10\n");
  for (const char* command :
       {"frame sample/hip.toml", "depth sample/hip.toml", "rom sample/hip.toml --motion flexion",
        "load sample/hip.toml --e 12 --nu 0.42 --thickness 1.5",
        "motion sample/hip.toml --motion flexion.csv"}) {
    const Ran ran = done(command + std::string(" --json"));
    EXPECT_TRUE(says(ran.err, "condyle: note: wrong_side: the side is left, but ")) << command;
    EXPECT_EQ(without_notes(ran.err), "");
    const Json notes = Json::parse(ran.out)["notes"];
    ASSERT_GE(notes.size(), 1u) << command;
    EXPECT_EQ(notes[0]["code"], "wrong_side");
    // A load takes the bones for layers, which is noted for each.
    for (std::size_t i = 1; i < notes.size(); ++i) EXPECT_EQ(notes[i]["code"], "layer_on_bone") << command;
    EXPECT_EQ(notes.size(), std::string_view(command).starts_with("load") ? 3u : 1u) << command;
    EXPECT_TRUE(notes[0]["text"].get<std::string>().starts_with("the side is left")) << command;
    expect_refused(4, command + std::string(" --strict"), "hip.toml: wrong_side: the side is left");
  }
  for (const char* command : {"depth sample/hip.toml", "rom sample/hip.toml",
                              "load sample/hip.toml --e 12 --nu 0.42 --thickness 1.5",
                              "motion sample/hip.toml --motion flexion.csv"})
    expect_refused(4, command + std::string(" --strict --out nothing"), "(--strict)");
  for (const char* command : {"picture sample/hip.toml --out seen.png",
                              "report sample/hip.toml --motion flexion.csv --out seen.html"}) {
    expect_refused(4, command + std::string(" --strict"), "hip.toml: wrong_side: the side is left");
    for (const char* file : {"seen.png", "seen.html"}) EXPECT_FALSE(fs::exists(folder / file)) << command;
    const Ran ran = done(command);
    EXPECT_TRUE(says(ran.err, "condyle: note: wrong_side: the side is left, but "));
    fs::remove(folder / "seen.png");
  }
}

TEST_F(SampleJointCommand, AStudyNotesInALineEachWhatLooksWrongAndEndsThereWhenStrict) {
  done("sample hip --out other");
  edit_joint("side = \"right\"", "side = \"left\"");
  write("table.csv", "id,joint\ngood,other/hip.toml\nwrong,sample/hip.toml\n");
  const std::string study = "study table.csv --motion flexion --out out";
  for (const char* shard : {"", " --shard 2/2"})
    expect_refusal(run(study + " --strict" + shard), 4,
                   "table.csv: line 3: joint 'wrong': wrong_side: the side is left", "--strict");
  EXPECT_FALSE(fs::exists(folder / "out/study.json"));
  EXPECT_FALSE(says(run(study + " --strict --shard 1/2").err, "wrong_side"));
  for (const char* what : {"first", "again"}) {
    const Ran ran = done(study);
    EXPECT_TRUE(ran.err.starts_with("condyle: note: wrong: wrong_side\ncondyle: note: ")) << what << ran.err;
  }
  expect_refusal(run(study + " --strict"), 4, "wrong_side", "of what is there");
  done(study + " --shard 2/2");
  EXPECT_TRUE(run("merge out").err.starts_with("condyle: note: wrong: wrong_side\n"));
}

TEST_F(SampleJointCommand, ACentreOnTheSurfaceIsRefused) {
  const Vec3 vertex = io::read_mesh(folder / "sample/hip_bone.ply").mesh.vertices[7];
  edit_joint("centre = [0.0, 0.0, 0.0]",
             "centre = [" + std::to_string(vertex.x()) + ", " + std::to_string(vertex.y()) + ", 0.0]");
  edit_joint(", 0.0]", ", " + Json(vertex.z()).dump() + "]");
  // Six decimals are not the vertex; its own digits are.
  edit_joint(std::to_string(vertex.x()), Json(vertex.x()).dump());
  edit_joint(std::to_string(vertex.y()), Json(vertex.y()).dump());
  expect_refused(4, "depth sample/hip.toml", "the joint centre lies on the surface, in triangle ");
}

TEST_F(SampleJointCommand, WrongUsageEndsWithTwo) {
  expect_refused(2, "depth sample/hip.toml --pose \"flexion=90 twist=3\"", "unknown angle 'twist'");
  expect_refused(2, "depth sample/hip.toml --pose \"flexion=ninety\"", "flexion='ninety' is not a number");
  expect_refused(2, "depth sample/hip.toml --method shortest", "--method");
  expect_refused(2, "depth sample/hip.toml --method tangential --about twist", "unknown angle 'twist'");
  expect_refused(2, "depth sample/hip.toml --about flexion", "about: is for method tangential");
  expect_refused(2, "depth sample/hip.toml --method radial --about adduction",
                 "about: is for method tangential");
  expect_refused(2, "depth sample/hip.toml --csv", "--csv requires --out");
  expect_refused(2, "depth sample/hip.toml --frame world", "unknown frame 'world'");
  expect_refused(2, "depth", "JOINT is required");
  expect_refused(2, "sample", "");
  expect_refused(2, "sample hip", "--out is required");
  expect_refused(2, "sample hip --out other --scenario 5", "--scenario");
  expect_refused(2, "sample hip --out other --head-radius 90", "head_radius");
  expect_refused(2, "sample hip --out other --femur-triangles 2000",
                 "--femur-triangles requires --hip-bone-triangles");
  expect_refused(2, "sample cartilages --out other --scenario 4", "--scenario");
  expect_refused(2, "sample cartilages --out other --clearance 2", "clearance_mm is 2, must be -0.5 to 1 mm");
}

TEST_F(SampleJointCommand, AnUnwritableFolderEndsWithThree) {
  expect_refused(3, "depth sample/hip.toml --out sample/femur.ply", "femur.ply");
  expect_refused(3, "sample hip --out /proc/condyle", "/proc/condyle");
}

TEST_F(SampleJointCommand, TenMetresFromTheOriginTheAnswersAreTheSame) {
  const Json near = answer(std::string("depth sample/hip.toml ") + deep);
  const Vec3 away(10000, -10000, 10000);
  for (const char* name : {"sample/hip_bone.ply", "sample/femur.ply"})
    io::write_mesh(folder / name, shifted_by(io::read_mesh(folder / name).mesh, away));
  edit_joint("centre = [0.0, 0.0, 0.0]", "centre = [10000.0, -10000.0, 10000.0]");
  const Json far = answer(std::string("depth sample/hip.toml ") + deep);
  for (const char* key :
       {"mobile_vertices_inside", "fixed_vertices_inside", "triangle_pairs", "deepest_vertex"}) {
    EXPECT_EQ(near[key], far[key]) << key;
  }
  // Written 10 m away a coordinate moves by 2^-40 mm at most; a depth by that over the cosine between ray and
  // normal.
  const double cosine = std::cos(Angle::degrees(near["deepest_ray_to_normal_deg"]).radians());
  EXPECT_NEAR(near["max_radial_depth_mm"], far["max_radial_depth_mm"], 8 * 0x1p-40 / cosine);
}

TEST_F(SampleJointCommand, AMissingMeshEndsWithThree) {
  fs::remove(folder / "sample/femur.ply");
  expect_refused(3, "depth sample/hip.toml --out result", "femur.ply");
}

TEST_F(SampleJointCommand, TheSameParametersGiveTheSameBytes) {
  done("sample hip --out again --threads 1");
  for (const std::string name : {"femur.ply", "hip_bone.ply", "hip.toml"})
    EXPECT_EQ(text_of("sample/" + name), text_of("again/" + name)) << name;
}

TEST_F(SampleJointCommand, ALeftHipIsTheMirroredRightOne) {
  done("sample hip --side left --out left");
  const Json right = answer(std::string("depth sample/hip.toml ") + deep),
             left = answer(std::string("depth left/hip.toml ") + deep);
  EXPECT_EQ(left["side"], "left");
  for (const char* key :
       {"mobile_vertices_inside", "fixed_vertices_inside", "triangle_pairs", "max_radial_depth_mm"}) {
    EXPECT_EQ(left[key], right[key]) << key;
  }
}

}  // namespace
}  // namespace condyle::test
