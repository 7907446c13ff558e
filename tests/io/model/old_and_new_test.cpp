#include "condyle/io/model_file.hpp"
#include "support/test.hpp"

/// One knee in files of four generations of OpenSim: the same joint.

namespace condyle {
namespace {

namespace fs = std::filesystem;

/// As OpenSim 4 writes the knee of osim_small: offset frames for places of the joint, sockets for bodies.
constexpr std::string_view version_4 = R"(<?xml version="1.0" encoding="UTF-8"?>
<OpenSimDocument Version="40500"><Model name="new"><BodySet><objects><Body name="femur_r"/><Body name="tibia_r"/></objects></BodySet>
<JointSet><objects><CustomJoint name="knee_r">
<socket_parent_frame>femur_r_offset</socket_parent_frame><socket_child_frame>tibia_r_offset</socket_child_frame>
<coordinates><Coordinate name="knee_angle_r"><default_value>-0.1</default_value><range>-2 0.2</range></Coordinate></coordinates>
<frames>
<PhysicalOffsetFrame name="femur_r_offset"><socket_parent>/bodyset/femur_r</socket_parent><translation>0.01 -0.4 0.002</translation>
<orientation>0.1 0.2 -0.3</orientation></PhysicalOffsetFrame>
<PhysicalOffsetFrame name="tibia_r_offset"><socket_parent>/bodyset/tibia_r</socket_parent><translation>0.003 0.02 0</translation>
<orientation>0 -0.1 0.05</orientation></PhysicalOffsetFrame></frames>
<SpatialTransform>
<TransformAxis name="rotation1"><coordinates>knee_angle_r</coordinates><axis>0 0 1</axis>
<LinearFunction name="function"><coefficients> 1 0</coefficients></LinearFunction></TransformAxis>
<TransformAxis name="rotation2"><coordinates/><axis>0 1 0</axis><Constant name="function"><value>0</value></Constant></TransformAxis>
<TransformAxis name="rotation3"><coordinates/><axis>1 0 0</axis><Constant name="function"><value>0.1</value></Constant></TransformAxis>
<TransformAxis name="translation1"><coordinates>knee_angle_r</coordinates><axis>1 0 0</axis>
<SimmSpline name="function"><x> -2.1 -1.7 -1 -0.5 0 0.2</x><y> -0.003 0.001 0.004 0.002 -0.005 -0.0052</y></SimmSpline></TransformAxis>
<TransformAxis name="translation2"><coordinates/><axis>0 1 0</axis><Constant name="function"><value>-0.4</value></Constant></TransformAxis>
<TransformAxis name="translation3"><coordinates/><axis>0 0 1</axis><Constant name="function"><value>0</value></Constant></TransformAxis>
</SpatialTransform></CustomJoint></objects></JointSet></Model></OpenSimDocument>)";

/// The lines of a joint file that say where the joint is and how it turns.
std::string joint_lines(const std::string& toml) {
  std::string lines, table;
  std::istringstream text(toml);
  for (std::string line; std::getline(text, line);) {
    if (line.starts_with("[")) table = line;
    if (table.starts_with("[[")) continue;  // a mesh, which some of the files have
    for (const char* key :
         {"kind = ", "joint = \"knee\"", "side = ", "pose = ", "centre = ", "anterior = ", "superior = "})
      if (line.starts_with(key)) lines += line + "\n";
  }
  return lines;
}

TEST(OldAndNewModels, HaveTheSameJoint) {
  const auto data = test::shared_data();
  if (!data || !fs::exists(*data / "osim_small")) GTEST_SKIP() << "no models";
  const test::TemporaryFolder folder;
  std::ofstream(folder.path() / "new.osim") << version_4;
  const io::Model newest = io::read_model(folder.path() / "new.osim");
  const io::ModelJoint& wanted = io::joint_named(newest, "knee_r");
  const auto proposed = [](const io::Model& model) {
    return joint_lines(io::propose_joint(model, {.joint = "knee_r", .joint_file = {}}).proposal.toml);
  };
  for (const char* name : {"old_10905.osim", "old_20302.osim", "connectors_30502.osim"}) {
    SCOPED_TRACE(name);
    const io::Model model = io::read_model(*data / "osim_small" / name);
    const io::ModelJoint& joint = io::joint_named(model, "knee_r");
    EXPECT_EQ(joint.defaults(), wanted.defaults());
    EXPECT_EQ(joint.coordinates[0].range, wanted.coordinates[0].range);
    for (double angle = -2.5; angle <= 0.5; angle += 0.3)
      EXPECT_EQ(io::pose_of(joint, std::vector{angle}).matrix(),
                io::pose_of(wanted, std::vector{angle}).matrix())
          << angle;
    EXPECT_EQ(proposed(model), proposed(newest));
  }
  test::expect_says(proposed(newest), "centre = ");
}

}  // namespace
}  // namespace condyle
