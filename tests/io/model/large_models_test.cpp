#include <fmt/format.h>

#include "condyle/io/model_file.hpp"
#include "condyle/io/recorded_motion.hpp"
#include "io/motion/model_poses.hpp"
#include "io/motion/motion_text.hpp"
#include "io/result/model_result.hpp"
#include "support/test.hpp"

/// Models in which things of one kind are many and meet: whatever takes the square of their number does not end.

namespace condyle {
namespace {

constexpr int many = 20'000;

/// What `line` gives for 0, 1, 2 and so on.
std::string repeated(int count, const std::function<std::string(int)>& line) {
  std::string text;
  for (int i = 0; i < count; ++i) text += line(i) + "\n";
  return text;
}

std::string pin(std::string_view name, std::string_view parent, std::string_view child,
                std::string_view more = "") {
  return fmt::format(
      R"(<PinJoint name="{0}"><socket_parent_frame>/bodyset/{1}</socket_parent_frame><socket_child_frame>/bodyset/{2}</socket_child_frame>
<coordinates><Coordinate name="q{0}"/></coordinates>{3}</PinJoint>)",
      name, parent, child, more);
}

std::string weld(int number, std::string_view parent, std::string_view child) {
  return fmt::format(
      R"(<WeldJoint name="w{0}"><socket_parent_frame>/bodyset/{1}</socket_parent_frame><socket_child_frame>/bodyset/{2}</socket_child_frame></WeldJoint>)",
      number, parent, child);
}

std::string mesh(std::string_view file) {
  return fmt::format(
      R"(<attached_geometry><Mesh name="m"><mesh_file>{}</mesh_file></Mesh></attached_geometry>)", file);
}

/// A knee among many other bodies and joints.
std::string model(const std::string& bodies, const std::string& joints, const std::string& more = "") {
  return fmt::format(R"(<OpenSimDocument Version="40000"><Model name="large"><BodySet><objects>
<Body name="femur_r">{}</Body><Body name="tibia_r">{}</Body>
{}</objects></BodySet><JointSet><objects>{}
{}</objects></JointSet>{}</Model></OpenSimDocument>)",
                     mesh("femur.stl"), mesh("tibia.stl"), bodies, pin("knee_r", "femur_r", "tibia_r"),
                     joints, more);
}

std::string bodies(int count, const std::function<std::string(int)>& inside = {}) {
  return repeated(
      count, [&](int i) { return fmt::format(R"(<Body name="b{}">{}</Body>)", i, inside ? inside(i) : ""); });
}

std::string inspected(const std::string& text) {
  return io::models_text(std::array{io::read_model(text, "/nowhere/large.osim")});
}

bool has(const std::string& text, std::string_view part) {
  return text.find(part) != text.npos;
}

TEST(LargeModel, OfWeldsInAChainAStarAndBetweenTwoBodiesIsInspected) {
  const std::string all = bodies(many, [](int i) { return i == many - 1 ? mesh("far.stl") : std::string(); });
  const std::string chain = repeated(many, [](int i) {
    return weld(i, i == 0 ? "tibia_r" : fmt::format("b{}", i - 1), fmt::format("b{}", i));
  });
  const std::string star = repeated(many, [](int i) { return weld(i, "tibia_r", fmt::format("b{}", i)); });
  for (const std::string& welds : {chain, star})
    EXPECT_TRUE(has(inspected(model(all, welds)),
                    "knee_r: tibia_r in femur_r, hinge (PinJoint); meshes found 0 of 1 and 0 of 2;"));
  const std::string twice = repeated(many, [](int i) { return weld(i, "tibia_r", "b0"); });
  EXPECT_TRUE(has(inspected(model(bodies(1), twice)),
                  "knee_r: tibia_r in femur_r, hinge (PinJoint); meshes found 0 of 1 and 0 of 1;"));
}

TEST(LargeModel, OfWeldsIsProposedAsOneBody) {
  const std::string star = repeated(many, [](int i) { return weld(i, "tibia_r", fmt::format("b{}", i)); });
  const io::Model read =
      io::read_model(model(bodies(many, [](int) { return mesh("part.stl"); }), star), "/nowhere/large.osim");
  const io::ModelJointProposal made =
      io::propose_joint(read, {.joint = "knee_r", .joint_file = "/nowhere/k.toml"});
  EXPECT_TRUE(has(made.missing_body, "no mesh of body 'femur_r' was found"));
  const auto repeats = std::count_if(made.notes.begin(), made.notes.end(), [](const io::ModelNote& note) {
    return note.code == io::ModelNoteCode::repeated_mesh;
  });
  EXPECT_EQ(repeats, many - 1);
}

TEST(LargeModel, WithMeshesOfOneNameInManyPlacesNumbersThem) {
  const std::string places = repeated(many, [](int i) {
    return fmt::format(
        R"(<PhysicalOffsetFrame name="f{0}"><socket_parent>..</socket_parent><translation>{0} 0 0</translation>{1}</PhysicalOffsetFrame>)",
        i, mesh("part.stl"));
  });
  const io::Model read = io::read_model(
      model(R"(<Body name="b"><components>)" + places + "</components></Body>", weld(0, "tibia_r", "b")),
      "/nowhere/large.osim");
  const std::string toml =
      io::propose_joint(read, {.joint = "knee_r", .joint_file = "/nowhere/k.toml"}).proposal.toml;
  EXPECT_TRUE(has(toml, "name = 'part'\n"));
  EXPECT_TRUE(has(toml, "name = 'part_2'\n"));
  EXPECT_TRUE(has(toml, fmt::format("name = 'part_{}'\n", many)));
}

TEST(LargeModel, OfJointsInAChainIsInspected) {
  // Each joint asks how its body stands, and whether others stand turned.
  constexpr std::string_view turned =
      R"(<frames><PhysicalOffsetFrame name="t"><socket_parent>/bodyset/b0</socket_parent><orientation>1.5708 0 0</orientation></PhysicalOffsetFrame></frames>)";
  const std::string chain = repeated(many, [&](int i) {
    return i == 0 ? pin("j0", "ground", "b0", turned)
                  : pin(fmt::format("j{}", i), fmt::format("b{}", i - 1), fmt::format("b{}", i));
  });
  const std::string text = inspected(model(bodies(many), chain));
  EXPECT_TRUE(has(text, fmt::format("j{0}: b{0} in b{1}, ", many - 1, many - 2)));
}

TEST(LargeModel, OfConstraintsOnOneCoordinateRefusesEach) {
  const std::string couplers =
      "<ConstraintSet><objects>" +
      repeated(
          many,
          [](int i) {
            return fmt::format(
                R"(<CoordinateCouplerConstraint name="c{}"><coupled_coordinates_function><LinearFunction><coefficients>1 0</coefficients></LinearFunction></coupled_coordinates_function>
<independent_coordinate_names>q</independent_coordinate_names><dependent_coordinate_name>qknee_r</dependent_coordinate_name></CoordinateCouplerConstraint>)",
                i);
          }) +
      "</objects></ConstraintSet>";
  const io::Model read = io::read_model(model("", "", couplers), "/nowhere/large.osim");
  ASSERT_EQ(read.couplers.size(), static_cast<std::size_t>(many));
  const auto why = [](int a, int b) {
    return fmt::format("/nowhere/large.osim: constraints 'c{}' and 'c{}' both give coordinate 'qknee_r'", a,
                       b);
  };
  EXPECT_EQ(read.couplers.front().why_not, why(0, many - 1));
  EXPECT_EQ(read.couplers[7].why_not, why(7, many - 1));
  EXPECT_EQ(read.couplers.back().why_not, why(many - 2, many - 1));
  for (const io::ModelCoupler& coupler : read.couplers) EXPECT_EQ(coupler.function, nullptr);
}

TEST(LargeModel, OfFramesOfOneNameFindsThatOfEachBody) {
  const std::string all = bodies(many, [](int i) {
    return fmt::format(
        R"(<components><PhysicalOffsetFrame name="f"><socket_parent>..</socket_parent><translation>{} 0 0</translation></PhysicalOffsetFrame></components>)",
        i);
  });
  const std::string joints = repeated(many - 1, [](int i) {
    return fmt::format(
        R"(<PinJoint name="j{0}"><socket_parent_frame>b{0}/f</socket_parent_frame><socket_child_frame>b{1}/f</socket_child_frame>
<coordinates><Coordinate name="q{0}"/></coordinates></PinJoint>)",
        i, i + 1);
  });
  const io::Model read = io::read_model(model(all, joints), "/nowhere/large.osim");
  const io::ModelJoint& joint = read.joints[many / 2];
  ASSERT_NE(joint.transform, nullptr) << joint.why_not;
  EXPECT_EQ(joint.X_PF.translation().x(), many / 2 - 1);
  EXPECT_EQ(joint.parent_body, fmt::format("b{}", many / 2 - 1));
}

/// Constraints each of which names the next coordinate twice: 2^20 ways lead to the last one.
TEST(LargeModel, OfConstraintsThatNameOneCoordinateTwiceComputesEachOnce) {
  constexpr int chain = 20;
  std::string joints, couplers = "<ConstraintSet><objects>";
  for (int i = 0; i < chain; ++i) {
    const std::string from = i == 0 ? "qknee_r" : fmt::format("qj{}", i), next = fmt::format("qj{}", i + 1);
    joints += pin(fmt::format("j{}", i + 1), "femur_r", fmt::format("b{}", i));
    couplers += fmt::format(
        R"(<CoordinateCouplerConstraint name="c{0}"><coupled_coordinates_function><LinearFunction><coefficients>0.25 0.25 0</coefficients></LinearFunction></coupled_coordinates_function>
<independent_coordinate_names>{2} {2}</independent_coordinate_names><dependent_coordinate_name>{1}</dependent_coordinate_name></CoordinateCouplerConstraint>)",
        i, from, next);
  }
  const test::TemporaryFolder folder;
  const auto path =
      folder.file("large.osim", model(bodies(chain), joints, couplers + "</objects></ConstraintSet>"));
  const io::MotionTable table =
      test::motion_table({fmt::format("qj{}", chain)}, {std::vector<double>(1000, 1)});
  const io::RecordedPoses poses = io::model_poses(table, {.model = path, .joint = "knee_r"});
  ASSERT_EQ(poses.X_FM.size(), table.rows);
  // Each step halves it: the angle is 2^-20.
  const double angle = std::ldexp(1, -chain);
  EXPECT_NEAR(poses.X_FM[5]->linear()(1, 0), std::sin(angle), 1e-16);
}

}  // namespace
}  // namespace condyle
