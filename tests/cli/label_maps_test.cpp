#include <gtest/gtest.h>

#include <array>
#include <fstream>
#include <memory>
#include <nlohmann/json.hpp>

#include "command.hpp"
#include "condyle/io/label_file.hpp"
#include "io/file/whole_file.hpp"
#include "io/image/write_labels.hpp"
#include "support/temporary_folder.hpp"
#include "whole_pelvis.hpp"

namespace condyle::test {
namespace {

using Json = nlohmann::json;
namespace fs = std::filesystem;

/// A folder with a label map of the sample hip, which is made once.
class LabelMaps : public testing::Test {
 protected:
  static void SetUpTestSuite() {
    scan = std::make_unique<TemporaryFolder>();
    ASSERT_EQ(run_condyle(scan->path(), "sample hip --scenario 2 --voxel 1.5 --out .").exit_code, 0);
  }
  static void TearDownTestSuite() { scan.reset(); }

  Ran run(const std::string& arguments) const { return run_condyle(scan->path(), arguments); }
  std::string text(const fs::path& name) const { return io::read_whole_file(scan->path() / name); }

  static inline std::unique_ptr<TemporaryFolder> scan;
};

TEST_F(LabelMaps, BecomeJointsWithLimits) {
  const Ran made =
      run("init labels.nii.gz --task total --fixed hip_right --mobile femur_right -o right/hip.toml");
  ASSERT_EQ(made.exit_code, 0) << made.err;
  EXPECT_EQ(made.out, "");
  EXPECT_NE(made.err.find("wrote right/hip_right.ply, right/femur_right.ply, right/hip.toml"),
            std::string::npos)
      << made.err;
  EXPECT_EQ(made.err.find("to fill in"), std::string::npos) << made.err;
  EXPECT_NE(text("right/hip.toml").find("axes = \"LPS\""), std::string::npos);

  const Json image = Json::parse(run("rom right/hip.toml --band=20 --json").out);
  const Json mesh = Json::parse(run("rom hip.toml --json").out);
  ASSERT_EQ(image["motions"].size(), 12u);
  EXPECT_EQ(image["band"]["sigma"]["surface_voxels"], 0.25);
  for (std::size_t i = 0; i < 12; ++i)
    EXPECT_NEAR(image["motions"][i]["limit_deg"].get<double>(), mesh["motions"][i]["limit_deg"].get<double>(),
                4)
        << image["motions"][i]["name"] << ": the grid leaves so much open at 1.5 mm";
  bool says_whose_part = false;
  for (const Json& caveat : image["caveats"])
    says_whose_part |=
        caveat.get<std::string>().find("not the error of the segmentation") != std::string::npos;
  EXPECT_TRUE(says_whose_part);
  EXPECT_EQ(
      Json::parse(run("rom right/hip.toml --band=20 --sigma-surface 0.1 --json").out)["band"]["sigma"].count(
          "surface_voxels"),
      0u);
}

TEST_F(LabelMaps, AreListedWithWhatReachesTheBorder) {
  const Json json = Json::parse(run("inspect labels.nii.gz --json").out);
  const Json& map = json["label_maps"][0];
  ASSERT_EQ(map["labels"].size(), 2u);
  EXPECT_EQ(map["labels"][0]["label"], 76);
  EXPECT_EQ(map["labels"][1]["label"], 78);
  EXPECT_TRUE(map["labels"][0]["reaches_border"].empty());
  EXPECT_EQ(map["labels"][0]["pieces"], 1);
  const Ran text = run("inspect labels.nii.gz");
  EXPECT_NE(text.out.find("76 (no name): "), std::string::npos) << text.out;
}

TEST_F(LabelMaps, SayIfASimplificationMovesASurfaceByMoreThanAVoxel) {
  const auto noted = [&](const std::string& triangles) {
    const Ran made =
        run("surface labels.nii.gz --label 76 --triangles " + triangles + " -o simple/femur.ply --json");
    EXPECT_EQ(made.exit_code, 0) << made.err;
    const Json surface = Json::parse(made.out);
    const bool is_noted = made.err.find("simplified_away") != std::string::npos;
    EXPECT_EQ(is_noted, surface["simplification"]["largest_error_mm"].get<double>() > 1.5);
    return is_noted;
  };
  EXPECT_TRUE(noted("100"));
  EXPECT_FALSE(noted("4000"));
}

TEST_F(LabelMaps, GiveSurfacesThatAreFreeOfFindings) {
  const Ran made = run("surface labels.nii.gz --label 76 -o surface/femur.ply --json");
  ASSERT_EQ(made.exit_code, 0) << made.err;
  const Json surface = Json::parse(made.out);
  EXPECT_NE(made.err.find("label_tables"), std::string::npos) << "a bare number is no name";
  const Json mesh = Json::parse(run("inspect surface/femur.ply --json").out)["meshes"][0];
  EXPECT_EQ(mesh["triangles"], surface["triangles"]);
  EXPECT_EQ(mesh["closed"], true);
  EXPECT_EQ(mesh["components"].size(), 1u);
  for (const char* finding :
       {"boundary_edges", "non_manifold_edges", "non_manifold_vertices", "inconsistent_edges",
        "self_crossings", "degenerate_triangles", "unreferenced_vertices"})
    EXPECT_EQ(mesh[finding]["count"], 0) << finding;
}

TEST_F(LabelMaps, LeaveNothingToBeReplaced) {
  ASSERT_EQ(run("init labels.nii.gz --fixed 78 --mobile 76 -o once/hip.toml").exit_code, 0);
  const auto again = "init labels.nii.gz --fixed 78 --mobile 76 -o once/hip.toml";
  expect_refusal(run(again), 3, "once/hip.toml: is there already", again);
  const auto other = "init labels.nii.gz --fixed 78 --mobile 76 -o once/other.toml";
  expect_refusal(run(other), 3, "once/label_78.ply: is there already", other);
  EXPECT_FALSE(fs::exists(scan->path() / "once/other.toml"));
}

TEST_F(LabelMaps, WrongLabelsGetOneLine) {
  const auto refused = [&](const std::string& arguments, int exit_code, std::string_view saying) {
    expect_refusal(run(arguments), exit_code, saying, arguments);
    EXPECT_FALSE(fs::exists(scan->path() / "wrong")) << arguments;
  };
  refused("init labels.nii.gz --fixed 78 --mobile 78 -o wrong/hip.toml", 2,
          "label 78 is given for both bodies");
  refused("init labels.nii.gz --fixed 78 --mobile 7 -o wrong/hip.toml", 2, "labels.nii.gz: ");
  refused("init labels.nii.gz --fixed hip --mobile 76 -o wrong/hip.toml", 2, "labels.nii.gz: ");
  refused("init labels.nii.gz --fixed 78 -o wrong/hip.toml", 2, "--fixed, --mobile");
  refused("init labels.nii.gz --fixed 78 --mobile 76", 2, "--out");
  refused("init labels.nii.gz --fixed 78 --mobile 76 --units m -o wrong/hip.toml", 2, "--units");
  refused("init hip_bone.ply femur.ply --fixed 78 --mobile 76", 2, "are for label maps");
  refused(
      "init labels.nii.gz --task total --fixed hip_right --mobile femur_right --side left -o wrong/hip.toml",
      2, "is of the other side");
  refused("surface labels.nii.gz -o wrong/bone.ply", 2, "several labels");
  refused("surface labels.nii.gz --label 76 -o wrong/bone.stl", 3, "wrong/bone.stl");
  refused("inspect labels.nii.gz femur.ply", 2, "not together");
  refused("inspect labels.nii.gz --repair weld", 2, "are for meshes");
}

TEST_F(LabelMaps, OfOneBoneEachAreCalledAsTheirFiles) {
  const VoxelGrid grid{{40, 40, 40}, Eigen::Affine3d::Identity()};
  std::vector<std::uint8_t> ball(64000);
  for (int v = 0; v < 64000; ++v) {
    const int i = v % 40 - 20, j = v / 40 % 40 - 20, k = v / 1600 - 20;
    ball[static_cast<std::size_t>(v)] = i * i + j * j + k * k < 225;
  }
  io::write_labels(scan->path() / "femur_left.nii.gz", grid, ball);
  io::write_labels(scan->path() / "hip_right.nii.gz", grid, ball);
  const Ran surface = run("surface femur_left.nii.gz -o ball.ply");
  EXPECT_NE(surface.out.find("femur_left: "), std::string::npos) << surface.out << surface.err;
  const auto sides = "init hip_right.nii.gz femur_left.nii.gz -o sides/hip.toml";
  expect_refusal(run(sides), 2, "hip_right and femur_left are of two sides", sides);
}

/// If both halves of a pelvis have one label, the half beside the femur counts, whichever is the larger. So it is with both femora.
TEST_F(LabelMaps, OfAWholePelvisGiveTheHalfBesideTheFemur) {
  const io::LabelMap map = io::read_labels(scan->path() / "labels.nii.gz");
  ASSERT_GT(map.grid.X_WI(0, 0), 0)
      << "i runs to the left: the mirror image beside the right hip is the left one";
  auto [grid, labels] = with_mirror_image(map);
  // 1 the pelvis, whose right half lacks its top, 2 the right femur and 3 the left one.
  const std::size_t top = labels.size() * 9 / 10;
  for (std::size_t v = 0; v < labels.size(); ++v) {
    constexpr std::array<std::uint8_t, 4> by_number = {3, 2, 1, 1};
    if (labels[v] != 0) labels[v] = labels[v] == 78 && v >= top ? 0 : by_number[labels[v] - 75u];
  }
  const auto init = [&](const std::string& mobile, const std::string& of) {
    const Ran made = run("init both.nii.gz --fixed 1 --mobile " + mobile + " -o " + of + "/hip.toml");
    EXPECT_EQ(made.exit_code, 0) << made.err;
    return made.err;
  };
  const auto expect_side = [&](const std::string& mobile, const std::string& side) {
    const std::string notes = init(mobile, side + mobile);
    EXPECT_EQ(notes.find("to fill in"), notes.npos) << notes;
    EXPECT_NE(notes.find("label_1 is in 2 pieces: the one beside label_" + mobile + " is kept"), notes.npos)
        << notes;
    EXPECT_NE(text(side + mobile + "/hip.toml").find("side = '" + side + "'"), std::string::npos) << mobile;
  };
  io::write_labels(scan->path() / "both.nii.gz", grid, labels);
  expect_side("2", "right");
  expect_side("3", "left");
  const std::string all = init("3 --pieces all", "all");
  EXPECT_NE(all.find("label_1 is in 2 pieces, all of them kept"), all.npos) << all;
  for (std::uint8_t& label : labels)
    if (label == 3) label = 2;
  io::write_labels(scan->path() / "both.nii.gz", grid, labels);
  expect_side("2", "left");  // of both the larger half of the pelvis, unless the side is stated
  const std::string stated = init("2 --side right", "stated");
  EXPECT_NE(stated.find("label_2 is in 2 pieces: the one on the right is kept"), stated.npos) << stated;
  EXPECT_EQ(stated.find("to fill in"), stated.npos) << stated;
}

TEST_F(LabelMaps, AreRowsOfAStudy) {
  std::ofstream(scan->path() / "table.csv") << "id,labels,fixed_label,mobile_label,task\n"
                                               "named,labels.nii.gz,hip_right,femur_right,total\n"
                                               "numbers,labels.nii.gz,78,76,\n"
                                               "none,labels.nii.gz,77,76,\n"
                                               "half,labels.nii.gz,78,,\n";
  const Ran study = run("study table.csv --motion flexion --out study");
  ASSERT_EQ(study.exit_code, 0) << study.err;
  ASSERT_EQ(run("init labels.nii.gz --fixed 78 --mobile 76 -o of_study/hip.toml").exit_code, 0);
  const Json alone = Json::parse(run("rom of_study/hip.toml --motion flexion --json").out);
  const std::string limit = "," + alone["motions"][0]["limit_deg"].dump();
  const std::string limits = text("study/limits.csv"), failures = text("study/failures.csv");
  EXPECT_NE(limits.find("named"), std::string::npos) << limits;
  std::size_t same = 0;
  for (std::size_t at = 0; (at = limits.find(limit, at)) != std::string::npos; ++at) ++same;
  EXPECT_EQ(same, 2u) << limits << "\nnot" << limit;
  EXPECT_NE(text("study/hips.csv").find("label_tables label_tables"), std::string::npos)
      << "numbers without a table";
  EXPECT_NE(failures.find("none"), std::string::npos) << failures;
  EXPECT_NE(failures.find("column 'mobile_label': a label is needed"), std::string::npos) << failures;
}

TEST_F(LabelMaps, BonesThatContradictTheirNamesLeaveTheSideOpen) {
  ASSERT_EQ(run("sample hip --scenario 2 --voxel 2 --side left --out left").exit_code, 0);
  const Ran named = run("init left/labels.nii.gz --side right --fixed 77 --mobile 75 -o named/hip.toml");
  EXPECT_EQ(named.exit_code, 0);
  EXPECT_NE(named.err.find("to fill in: side: given it is right, and the bones lie as those of a left hip"),
            std::string::npos)
      << named.err;
  const Ran inferred = run("init left/labels.nii.gz --fixed 77 --mobile 75 -o inferred/hip.toml");
  EXPECT_NE(text("inferred/hip.toml").find("side = 'left'"), std::string::npos) << inferred.err;
  const Ran swapped = run("init left/labels.nii.gz --fixed 75 --mobile 77 -o swapped/hip.toml");
  EXPECT_TRUE(swapped.err.find("to fill in: kind") != std::string::npos ||
              run("frame swapped/hip.toml").err.find("swapped_bodies") != std::string::npos)
      << swapped.err;
}

}  // namespace
}  // namespace condyle::test
