#include "command.hpp"
#include "condyle/io/label_file.hpp"
#include "io/image/write_labels.hpp"
#include "whole_pelvis.hpp"

namespace condyle::test {
namespace {

/// A folder with a label map of the sample hip, which is made once.
class LabelMaps : public CommandTest {
 protected:
  void SetUp() override { sample_into(here, "hip --scenario 2 --voxel 1.5"); }
};

TEST_F(LabelMaps, BecomeJointsWithLimits) {
  const Ran made =
      done("init labels.nii.gz --task total --fixed hip_right --mobile femur_right -o right/hip.toml");
  EXPECT_EQ(made.out, "");
  EXPECT_TRUE(says(made.err, "wrote right/hip_right.ply, right/femur_right.ply, right/hip.toml"));
  EXPECT_FALSE(says(made.err, "to fill in"));
  EXPECT_TRUE(says(text_of("right/hip.toml"), "axes = \"LPS\""));

  const Json image = answer("rom right/hip.toml --band=20");
  const Json mesh = answer("rom hip.toml");
  ASSERT_EQ(image["motions"].size(), 12u);
  EXPECT_EQ(image["band"]["sigma"]["surface_voxels"], 0.25);
  for (std::size_t i = 0; i < 12; ++i)
    EXPECT_NEAR(image["motions"][i]["limit_deg"], mesh["motions"][i]["limit_deg"], 4)
        << image["motions"][i]["name"] << ": the grid leaves so much open at 1.5 mm";
  bool says_whose_part = false;
  for (const Json& caveat : image["caveats"])
    says_whose_part |=
        caveat.get<std::string>().find("not the error of the segmentation") != std::string::npos;
  EXPECT_TRUE(says_whose_part);
  write("right/ct.toml", text_of("right/hip.toml") + "\n[uncertainty]\nsurface = \"ct\"\n");
  const Json ct = answer("rom right/ct.toml --band=20");
  EXPECT_EQ(ct["band"]["sigma"]["surface_from"], "ct");
  EXPECT_EQ(ct["band"]["sigma"]["surface_mm"], 0.84);
  EXPECT_EQ(ct["band"]["sigma"]["grid_voxels"], 0.25);
  const auto width = [](const Json& answer) {
    return answer["motions"][10]["band"]["width_from"]["surface_deg"].get<double>();
  };
  EXPECT_GT(width(ct), width(image));
  EXPECT_TRUE(says(done("rom right/ct.toml --band=20").out, "Soodmand 2018"));
  EXPECT_TRUE(says(done("rom hip.toml --band=20").out, "surfaces 0.25 mm (assumed)"));
  EXPECT_EQ(
      answer("rom right/hip.toml --band=20 --sigma-surface 0.1")["band"]["sigma"].count("surface_voxels"),
      0u);
}

TEST_F(LabelMaps, AreListedWithWhatReachesTheBorder) {
  const Json json = answer("inspect labels.nii.gz");
  const Json& map = json["label_maps"][0];
  ASSERT_EQ(map["labels"].size(), 2u);
  EXPECT_EQ(map["labels"][0]["label"], 76);
  EXPECT_EQ(map["labels"][1]["label"], 78);
  EXPECT_TRUE(map["labels"][0]["reaches_border"].empty());
  EXPECT_EQ(map["labels"][0]["pieces"], 1);
  const Ran text = run("inspect labels.nii.gz");
  EXPECT_TRUE(says(text.out, "76 (no name): "));
}

TEST_F(LabelMaps, SayIfASimplificationMovesASurfaceByMoreThanAVoxel) {
  const auto noted = [&](const std::string& triangles) {
    const Ran made =
        done("surface labels.nii.gz --label 76 --triangles " + triangles + " -o simple/femur.ply --json");
    const Json surface = Json::parse(made.out);
    const bool is_noted = made.err.find("simplified_away") != std::string::npos;
    EXPECT_EQ(is_noted, surface["simplification"]["largest_error_mm"].get<double>() > 1.5);
    return is_noted;
  };
  EXPECT_TRUE(noted("100"));
  EXPECT_FALSE(noted("4000"));
}

TEST_F(LabelMaps, GiveSurfacesThatAreFreeOfFindings) {
  const Ran made = done("surface labels.nii.gz --label 76 -o surface/femur.ply --json");
  const Json surface = Json::parse(made.out);
  EXPECT_TRUE(says(made.err, "label_tables")) << "a bare number is no name";
  const Json mesh = answer("inspect surface/femur.ply")["meshes"][0];
  EXPECT_EQ(mesh["triangles"], surface["triangles"]);
  EXPECT_EQ(mesh["closed"], true);
  EXPECT_EQ(mesh["components"].size(), 1u);
  for (const char* finding :
       {"boundary_edges", "non_manifold_edges", "non_manifold_vertices", "inconsistent_edges",
        "self_crossings", "degenerate_triangles", "unreferenced_vertices"})
    EXPECT_EQ(mesh[finding]["count"], 0) << finding;
}

TEST_F(LabelMaps, LeaveNothingToBeReplaced) {
  done("init labels.nii.gz --fixed 78 --mobile 76 -o once/hip.toml");
  const auto again = "init labels.nii.gz --fixed 78 --mobile 76 -o once/hip.toml";
  expect_refusal(run(again), 3, "once/hip.toml: is there already", again);
  const auto other = "init labels.nii.gz --fixed 78 --mobile 76 -o once/other.toml";
  expect_refusal(run(other), 3, "once/label_78.ply: is there already", other);
  EXPECT_FALSE(fs::exists(here / "once/other.toml"));
}

TEST_F(LabelMaps, WrongLabelsGetOneLine) {
  const auto refused = [&](const std::string& arguments, int exit_code, std::string_view saying) {
    expect_refusal(run(arguments), exit_code, saying, arguments);
    EXPECT_FALSE(fs::exists(here / "wrong")) << arguments;
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
  io::write_labels(here / "femur_left.nii.gz", grid, ball);
  io::write_labels(here / "hip_right.nii.gz", grid, ball);
  const Ran surface = run("surface femur_left.nii.gz -o ball.ply");
  EXPECT_TRUE(says(surface.out, "femur_left: "));
  const auto sides = "init hip_right.nii.gz femur_left.nii.gz -o sides/hip.toml";
  expect_refusal(run(sides), 2, "hip_right and femur_left are of two sides", sides);
}

/// If both halves of a pelvis have one label, the half beside the femur counts, whichever is the larger. So it is with both femora.
TEST_F(LabelMaps, OfAWholePelvisGiveTheHalfBesideTheFemur) {
  const io::LabelMap map = io::read_labels(here / "labels.nii.gz");
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
    const Ran made = done("init both.nii.gz --fixed 1 --mobile " + mobile + " -o " + of + "/hip.toml");
    return made.err;
  };
  const auto expect_side = [&](const std::string& mobile, const std::string& side) {
    const std::string notes = init(mobile, side + mobile);
    EXPECT_FALSE(says(notes, "to fill in"));
    EXPECT_TRUE(says(notes, "label_1 is in 2 pieces: the one beside label_" + mobile + " is kept"));
    EXPECT_TRUE(says(text_of(side + mobile + "/hip.toml"), "side = '" + side + "'")) << mobile;
  };
  io::write_labels(here / "both.nii.gz", grid, labels);
  expect_side("2", "right");
  expect_side("3", "left");
  const std::string all = init("3 --pieces all", "all");
  EXPECT_TRUE(says(all, "label_1 is in 2 pieces, all of them kept"));
  for (std::uint8_t& label : labels)
    if (label == 3) label = 2;
  io::write_labels(here / "both.nii.gz", grid, labels);
  expect_side("2", "left");  // of both the larger half of the pelvis, unless the side is stated
  const std::string stated = init("2 --side right", "stated");
  EXPECT_TRUE(says(stated, "label_2 is in 2 pieces: the one on the right is kept"));
  EXPECT_FALSE(says(stated, "to fill in"));
}

TEST_F(LabelMaps, AreRowsOfAStudy) {
  write("table.csv",
        "id,labels,fixed_label,mobile_label,task\n"
        "named,labels.nii.gz,hip_right,femur_right,total\n"
        "numbers,labels.nii.gz,78,76,\n"
        "none,labels.nii.gz,77,76,\n"
        "half,labels.nii.gz,78,,\n");
  const Ran study = done("study table.csv --motion flexion --out study");
  done("init labels.nii.gz --fixed 78 --mobile 76 -o of_study/hip.toml");
  const Json alone = answer("rom of_study/hip.toml --motion flexion");
  const std::string limit = "," + alone["motions"][0]["limit_deg"].dump();
  const std::string limits = text_of("study/limits.csv"), failures = text_of("study/failures.csv");
  EXPECT_TRUE(says(limits, "named"));
  std::size_t same = 0;
  for (std::size_t at = 0; (at = limits.find(limit, at)) != std::string::npos; ++at) ++same;
  EXPECT_EQ(same, 2u) << limits << "\nnot" << limit;
  EXPECT_TRUE(says(text_of("study/hips.csv"), "label_tables label_tables")) << "numbers without a table";
  EXPECT_TRUE(says(failures, "none"));
  EXPECT_TRUE(says(failures, "column 'mobile_label': a label is needed"));
}

TEST_F(LabelMaps, BonesThatContradictTheirNamesLeaveTheSideOpen) {
  done("sample hip --scenario 2 --voxel 2 --side left --out left");
  const Ran named = done("init left/labels.nii.gz --side right --fixed 77 --mobile 75 -o named/hip.toml");
  EXPECT_TRUE(
      says(named.err, "to fill in: side: given it is right, and the bones lie as those of a left hip"));
  const Ran inferred = run("init left/labels.nii.gz --fixed 77 --mobile 75 -o inferred/hip.toml");
  EXPECT_TRUE(says(text_of("inferred/hip.toml"), "side = 'left'")) << inferred.err;
  const Ran swapped = run("init left/labels.nii.gz --fixed 75 --mobile 77 -o swapped/hip.toml");
  EXPECT_TRUE(swapped.err.find("to fill in: kind") != std::string::npos ||
              run("frame swapped/hip.toml").err.find("swapped_bodies") != std::string::npos)
      << swapped.err;
}

}  // namespace
}  // namespace condyle::test
