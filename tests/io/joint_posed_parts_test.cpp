#include "condyle/answer.hpp"
#include "condyle/io/joint_file.hpp"
#include "condyle/io/mesh_file.hpp"
#include "condyle/io/provenance.hpp"
#include "condyle/range_of_motion.hpp"
#include "condyle/resection.hpp"
#include "condyle/sample/hip.hpp"
#include "io/result/provenance_forms.hpp"
#include "kinematics/posed_parts.hpp"
#include "support/joint_text.hpp"
#include "support/test.hpp"

/// Parts of a body with a pose of their own: [[part]] of a joint file.

namespace condyle {
namespace {

std::string part_text(std::string_view head, std::string_view parameters) {
  return "[[part]]\n" + std::string(head) + "\n" + std::string(parameters) + "\n";
}
std::string parameter_text(std::string_view name, std::string_view more = "range = [-90, 90]") {
  return "[[part.parameter]]\nname = \"" + std::string(name) + "\"\n" + std::string(more) + "\n";
}

Eigen::Matrix3d rotation(const Vec3& axis, double degrees) {
  return Eigen::AngleAxisd(degrees * std::numbers::pi / 180, axis).toRotationMatrix();
}
/// R_x(frontal) R_z(sagittal) R_y(version), written out.
Eigen::Matrix3d turned_by_hand(double frontal, double sagittal, double version) {
  return rotation(Vec3::UnitX(), frontal) * rotation(Vec3::UnitZ(), sagittal) *
         rotation(Vec3::UnitY(), version);
}
TriMesh moved_by_hand(const TriMesh& mesh, const Eigen::Affine3d& X) {
  return test::mapped(mesh, [&](const Vec3& p) { return Vec3(X * p); });
}
Eigen::Affine3d about(const Vec3& centre, const Eigen::Matrix3d& R, const Vec3& then = Vec3::Zero()) {
  return Eigen::Translation3d(centre + then) * R * Eigen::Translation3d(-centre);
}

double distance(const TriMesh& a, const TriMesh& b) {
  return test::farthest(a.vertices, b.vertices);
}

/// Coordinates of less than 512 mm, rounded twice more than by hand.
constexpr double rounding_mm = 16 * 0x1p-44;

/// A sample hip whose hip bone is a fragment beside a box that stays.
class PosedParts : public ::testing::TestWithParam<Side> {
 protected:
  void SetUp() override {
    sample::SampleHip hip = sample::sample_hip({}, sample::Scenario::three);
    if (GetParam() == Side::left) hip = sample::mirrored(hip);
    fragment = hip.hip_bone;
    femur = hip.femur;
    io::write_mesh(folder / "fragment.ply", fragment);
    io::write_mesh(folder / "femur.ply", femur);
    io::write_mesh(folder / "rest.ply", rest);
  }
  std::filesystem::path write(std::string_view more) const {
    return folder.file("joint.toml",
                       test::joint_text({.side = name_of(GetParam()),
                                         .fixed = "meshes = [{ name = \"rest\", mesh = \"rest.ply\" }, "
                                                  "{ name = \"fragment\", mesh = \"fragment.ply\" }]",
                                         .mobile = "mesh = \"femur.ply\"",
                                         .more = more}));
  }
  double sense() const { return GetParam() == Side::right ? 1 : -1; }

  static constexpr const char* head = "name = \"fragment\"\nbody = \"fixed\"\nmeshes = [\"fragment\"]";
  const std::string three =
      part_text(head, parameter_text("frontal") + parameter_text("sagittal") + parameter_text("version"));
  const test::TemporaryFolder folder;
  const TriMesh rest = test::box({-20, 200, -20}, {20, 240, 20});
  TriMesh fragment, femur;
};
INSTANTIATE_TEST_SUITE_P(Sides, PosedParts, ::testing::Values(Side::right, Side::left),
                         [](const auto& info) { return std::string(name_of(info.param)); });

TEST_P(PosedParts, KeepEveryBitAsGiven) {
  const Joint without = io::read_joint(write("")).joint, with = io::read_joint(write(three)).joint;
  EXPECT_EQ(with.fixed.mesh.arrays(), without.fixed.mesh.arrays());
  EXPECT_EQ(with.mobile.mesh.arrays(), without.mobile.mesh.arrays());
  const ParameterValue there{"fragment.frontal", 10}, back{"fragment.frontal", 0};
  EXPECT_EQ(with_parameters(with_parameters(with, {&there, 1}), {&back, 1}).fixed.mesh.arrays(),
            without.fixed.mesh.arrays());
  EXPECT_EQ(changed_parameters(with), "");
}

TEST_P(PosedParts, TurnByVersionThenSagittallyThenFrontally) {
  const Joint joint = io::read_joint(write(three)).joint;
  const auto values = parse_parameters("fragment.frontal=6 fragment.sagittal=-4, fragment.version=8");
  const Joint turned = with_parameters(joint, values);
  const Eigen::Affine3d Q = about(Vec3::Zero(), turned_by_hand(sense() * 6, -4, sense() * 8));
  EXPECT_LT(distance(mesh_of_part(turned.fixed, "fragment"), moved_by_hand(fragment, Q)), rounding_mm);
  EXPECT_EQ(mesh_of_part(turned.fixed, "rest").arrays(), rest);
  EXPECT_EQ(turned.mobile.mesh.arrays(), femur);
  EXPECT_EQ(changed_parameters(turned),
            "fragment.frontal 6 deg instead of 0, fragment.sagittal -4 deg instead of 0, "
            "fragment.version 8 deg instead of 0");
}

TEST_P(PosedParts, HaveTheLimitsOfMeshesTurnedByHand) {
  const io::LoadedJoint joint = io::read_joint(write(three));
  const ParameterValue ten{"fragment.frontal", 10};
  const io::LoadedJoint turned = with_parameters(joint, {&ten, 1});
  io::write_mesh(folder / "fragment.ply",
                 moved_by_hand(fragment, about(Vec3::Zero(), turned_by_hand(sense() * 10, 0, 0))));
  const io::LoadedJoint by_hand = io::read_joint(write(""));
  const auto motions = motion::hip_motions();
  const auto limits = answer_range(turned, {.motions = motions}).limits,
             expected = answer_range(by_hand, {.motions = motions}).limits,
             before = answer_range(joint, {.motions = motions}).limits;
  double largest = 0;
  for (std::size_t i = 0; i < motions.size(); ++i) {
    EXPECT_EQ(limits[i].end.reason, expected[i].end.reason) << motions[i].name;
    EXPECT_NEAR(limits[i].end.turned.degrees(), expected[i].end.turned.degrees(), 1e-6) << motions[i].name;
    largest = std::max(largest, std::abs(limits[i].end.turned.degrees() - before[i].end.turned.degrees()));
  }
  EXPECT_GT(largest, 1) << "the turn does something";
}

TEST_P(PosedParts, AddTheirFrontalTurnToTheLateralCentreEdgeAngle) {
  const Joint joint = io::read_joint(write(three)).joint;
  const auto lateral = [](const Joint& at) {
    return *answer_measures({at}).measures.acetabulum.centre_edge_lateral.value;
  };
  // The angle is measured about the head's centre, which a fit has 2e-7 mm from the joint's: over 20 mm or more to the edge.
  constexpr double off_centre_deg = 2 * 2e-7 / 20 * 180 / std::numbers::pi;
  for (const double omega : {10.0, 20.0}) {
    const ParameterValue value{"fragment.frontal", omega};
    EXPECT_NEAR(lateral(with_parameters(joint, {&value, 1})), lateral(joint) + omega, off_centre_deg);
  }
}

TEST_P(PosedParts, AreMovedByEveryKindOfParameter) {
  const std::string parameters =
      parameter_text("inclination", "range = [30, 50]\nas_given = 40\nvalue = 45") +
      parameter_text("tilt", "range = [-20, 20]") +
      parameter_text("medial", "kind = \"translation\"\nalong = \"lateral\"\nrange = [-5, 5]\nvalue = -2") +
      parameter_text("up", "kind = \"translation\"\nalong = [0, 1, 0]\nrange = [-5, 5]\nvalue = 3") +
      parameter_text("diameter", "kind = \"size\"\nas_given = 52\nrange = [40, 60]\nvalue = 54");
  const Joint joint =
      io::read_joint(write(part_text(std::string(head) + "\ncentre = [1, 2, 3]", parameters))).joint;
  const Eigen::Matrix3d R = 54.0 / 52 * turned_by_hand(-sense() * 5, 0, 0);
  EXPECT_LT(distance(mesh_of_part(joint.fixed, "fragment"),
                     moved_by_hand(fragment, about({1, 2, 3}, R, {0, 3, -2 * sense()}))),
            rounding_mm);
  EXPECT_EQ(changed_parameters(joint), "") << "the values are the file's";
  const ParameterValue tilt{"fragment.tilt", 7};
  const Eigen::Matrix3d tilted = 54.0 / 52 * turned_by_hand(-sense() * 5, -7, 0);
  EXPECT_LT(distance(mesh_of_part(with_parameters(joint, {&tilt, 1}).fixed, "fragment"),
                     moved_by_hand(fragment, about({1, 2, 3}, tilted, {0, 3, -2 * sense()}))),
            rounding_mm);
}

TEST_P(PosedParts, MoveAfterThoseThatTheFileHasBefore) {
  const Joint joint =
      io::read_joint(write(three + part_text("name = \"pelvis\"\nbody = \"fixed\"", parameter_text("tilt"))))
          .joint;
  const auto values = parse_parameters("pelvis.tilt=12 fragment.frontal=5");
  const Joint moved = with_parameters(joint, values);
  const Eigen::Matrix3d tilt = turned_by_hand(0, -12, 0);
  EXPECT_LT(distance(mesh_of_part(moved.fixed, "rest"), moved_by_hand(rest, about(Vec3::Zero(), tilt))),
            rounding_mm);
  EXPECT_LT(distance(mesh_of_part(moved.fixed, "fragment"),
                     moved_by_hand(fragment, about(Vec3::Zero(), tilt * turned_by_hand(5 * sense(), 0, 0)))),
            rounding_mm);
}

TEST_P(PosedParts, AreRefusedInOneLine) {
  const auto refused = [&](std::string_view more, std::string_view saying) {
    test::expect_says(test::joint_refusal(write(more)), saying);
  };
  refused(part_text("name = \"cup\"\nbody = \"fixed\"\nmeshes = [\"fragmnet\"]", parameter_text("tilt")),
          "part cup: the body has no mesh \"fragmnet\"; there are rest, fragment");
  refused(part_text("name = \"cup\"\nbody = \"mobile\"\nmeshes = [\"x\"]", parameter_text("tilt")),
          "it is one mesh");
  refused(part_text("name = \"a cup\"\nbody = \"fixed\"", parameter_text("tilt")), "letters, digits");
  refused(part_text("name = \"cup\"\nbody = \"fixed\"", ""), "part cup: needs one parameter or more");
  refused(part_text(head, parameter_text("tilt") + parameter_text("sagittal")),
          "tilt and sagittal turn about the same axis");
  refused(part_text(head, parameter_text("tilt") + parameter_text("tilt")), "given twice");
  refused(three + three, "part fragment: is given twice");
  refused(part_text(head, parameter_text("opening")), "kind");
  refused(part_text(head, parameter_text("tilt", "range = [5, 9]")), "lies outside of the range, 5 to 9");
  refused(part_text(head, parameter_text("tilt", "range = [9, 5]\nvalue = 7")), "lies outside of the range");
  refused(part_text(head, parameter_text("tilt", "range = [-9, 9]\nvalue = nan")), "finite");
  refused(part_text(head, parameter_text("tilt", "range = [-9, 9]\nsigma = -1")), "sigma");
  refused(part_text(head, parameter_text("tilt", "range = [-9, 9]\nalong = \"lateral\"")),
          "is for a translation");
  refused(part_text(head, parameter_text("d", "kind = \"size\"\nrange = [0, 2]")), "above 0");
  refused(part_text(head, parameter_text("d", "kind = \"translation\"\nrange = [-2, 2]")), "along");
  refused(part_text(head, parameter_text("tilt") + "colour = 1\n"), "colour");
}

TEST_P(PosedParts, TakeValuesOnlyThatTheyMayHave) {
  const Joint joint = io::read_joint(write(three)).joint;
  const auto refused = [](const Joint& of, std::string_view values) -> std::string {
    return test::complaint_of<UsageError>([&] { with_parameters(of, parse_parameters(values)); });
  };
  EXPECT_EQ(refused(joint, "fragment.fronatl=1"),
            "there is no parameter \"fragment.fronatl\" (did you mean \"fragment.frontal\"?); there are "
            "fragment.frontal, fragment.sagittal, fragment.version");
  EXPECT_EQ(refused(joint, "fragment.frontal=91"),
            "fragment.frontal: 91 deg is outside of its range, -90 to 90");
  EXPECT_EQ(refused(joint, "fragment.frontal=90"), "accepted");
  EXPECT_EQ(refused(joint, "fragment.frontal=1 fragment.frontal=1"), "fragment.frontal is given twice");
  for (const char* bad : {"fragment.frontal=nan", "fragment.frontal=inf", "fragment.frontal=", "=3", "x",
                          "fragment.frontal=3deg"})
    EXPECT_EQ(refused(joint, bad),
              "\"" + std::string(bad) + "\" is not a parameter and its value, as in cup.inclination=42");
  EXPECT_EQ(refused(joint, " "), "no parameter is given, as in cup.inclination=42");
  EXPECT_EQ(refused(io::read_joint(write("")).joint, "fragment.frontal=1"),
            "the joint has no part with parameters: its file has no [[part]]");
}

TEST_P(PosedParts, StandInTheProvenance) {
  const io::LoadedJoint joint = io::read_joint(write(three));
  const ParameterValue ten{"fragment.frontal", 10};
  const io::Provenance from = io::provenance_of(with_parameters(joint, {&ten, 1}), {});
  const auto json = io::provenance_json(&from)["parameters"];
  ASSERT_EQ(json.size(), 3u);
  EXPECT_EQ(json[0]["name"], "fragment.frontal");
  EXPECT_EQ(json[0]["value"], 10);
  EXPECT_EQ(json[0]["in_joint_file"], 0);
  EXPECT_EQ(json[0]["unit"], "deg");
  const io::Provenance without = io::provenance_of(io::read_joint(write("")), {});
  EXPECT_FALSE(io::provenance_json(&without).contains("parameters"));
}

/// A resected bone is what parts move from then on: at the values that it was cut at, and at others.
TEST_P(PosedParts, StayWithoutTheBoneThatWasCut) {
  const Joint joint =
      io::read_joint(write(part_text("name = \"femur\"\nbody = \"mobile\"", parameter_text("version"))))
          .joint;
  const ParameterValue eight{"femur.version", 8}, as_given{"femur.version", 0};
  const Joint turned = with_parameters(joint, {&eight, 1});
  const motion::Motion motion =
      motion::motion_named(motion::hip_motions(), "internal_rotation_at_90_flexion");
  const auto limit = [&](const Joint& of) {
    return motion::RangeOfMotion(of).limit(motion).end.turned.degrees();
  };
  plan::ResectionOptions request;
  request.targets = {{motion, Angle::degrees(limit(turned) + 3)}};
  const Joint cut = plan::resect(turned, request).joint;
  const Joint again = with_parameters(cut, {&eight, 1});
  EXPECT_LT(distance(again.mobile.mesh.arrays(), cut.mobile.mesh.arrays()), rounding_mm);
  EXPECT_EQ(again.fixed.mesh.arrays(), cut.fixed.mesh.arrays());
  ASSERT_TRUE(again.mobile.head);
  EXPECT_LT((again.mobile.head->centre - cut.mobile.head->centre).norm(), rounding_mm);
  // Version turns the limits of internal rotation exactly, with the cut as without.
  EXPECT_NEAR(limit(with_parameters(cut, {&as_given, 1})), limit(cut) - 8, 1e-6);

  // As many vertices as before, one of them elsewhere.
  Joint moved = turned;
  Points points = moved.mobile.mesh.vertices();
  points.set(0, points[0] + Vec3(0, 1, 0));
  moved.mobile.mesh = moved.mobile.mesh.moved_to(std::move(points));
  kinematics::take_as_moved(moved);
  EXPECT_LT(distance(with_parameters(moved, {&eight, 1}).mobile.mesh.arrays(), moved.mobile.mesh.arrays()),
            rounding_mm);
}

TEST_P(PosedParts, WidenBandsByTheirStandardDeviations) {
  const std::string uncertain =
      part_text("name = \"pelvis\"\nbody = \"fixed\"", parameter_text("tilt", "range = [-9, 9]\nsigma = 3"));
  const Joint joint = io::read_joint(write(uncertain)).joint, sure = io::read_joint(write("")).joint;
  const std::vector<motion::Motion> motions = {motion::motion_named(motion::hip_motions(), "flexion")};
  const motion::BandOptions nothing_else{.sigma = {.centre_mm = 0, .axes = Angle(), .surface_mm = 0}};
  const motion::LimitBand band = motion::limit_bands(joint, motions, {}, nothing_else).front();
  // A tilt changes the limit of flexion by exactly as much: 5 to 95 % of a normal distribution are 3.29 standard deviations apart, a
  // Latin hypercube of 200 has them within one of its strata, a hundredth.
  EXPECT_NEAR((band.p95 - band.p5).degrees(), 3 * 3.2897, 0.2);
  EXPECT_EQ(band.width_from.parameters, band.p95 - band.p5);
  EXPECT_EQ(band.width_from.surface, Angle());
  // Draws of the others do not depend on the parameters.
  const motion::LimitBand all = motion::limit_bands(joint, motions, {}, {}).front(),
                          before = motion::limit_bands(sure, motions, {}, {}).front();
  EXPECT_EQ(all.width_from.centre, before.width_from.centre);
  EXPECT_EQ(all.width_from.axes, before.width_from.axes);
  EXPECT_EQ(all.width_from.surface, before.width_from.surface);
  EXPECT_GT(all.p95 - all.p5, before.p95 - before.p5);
}

/// docs/mathematics: pelvic tilt and femoral version of the VHF hip.
TEST(PosedBones, OfARealHipTurnItsLimitsExactly) {
  FOUND_OR_SKIP(data, test::shared_data());
  const test::TemporaryFolder folder;
  const auto path = folder.file(
      "vhf.toml", test::joint_text(
                      {.fixed = test::mesh_key(*data / "hip_vhf_right/hip_bone.ply"),
                       .mobile = test::mesh_key(*data / "hip_vhf_right/femur.ply"),
                       .more = part_text("name = \"pelvis\"\nbody = \"fixed\"", parameter_text("tilt")) +
                               part_text("name = \"femur\"\nbody = \"mobile\"", parameter_text("version"))}));
  const io::LoadedJoint joint = io::read_joint(path);
  const auto limits = [&](std::string_view values) {
    const io::LoadedJoint at = values.empty() ? joint : with_parameters(joint, parse_parameters(values));
    return answer_range(at, {.motions = motion::hip_motions()}).limits;
  };
  const auto degrees = [](const std::vector<motion::MotionLimit>& of, std::string_view motion) {
    for (const motion::MotionLimit& limit : of)
      if (limit.motion.name == motion) return limit.end.turned.degrees();
    return -1.0;
  };
  constexpr double exact_deg = 1e-9;  // some error bounds of limits
  const auto before = limits(""), tilted = limits("pelvis.tilt=10"), turned = limits("femur.version=10");
  EXPECT_NEAR(degrees(tilted, "flexion"), degrees(before, "flexion") - 10, exact_deg);
  EXPECT_NEAR(degrees(tilted, "extension"), degrees(before, "extension") + 10, exact_deg);
  EXPECT_NEAR(degrees(tilted, "internal_rotation_at_90_flexion"), 30.021, 5e-4);
  EXPECT_NEAR(degrees(limits("pelvis.tilt=-10"), "internal_rotation_at_90_flexion"), 34.799, 5e-4);
  for (const char* motion : {"internal_rotation", "internal_rotation_at_90_flexion", "fadir"})
    EXPECT_NEAR(degrees(turned, motion), degrees(before, motion) + 10, exact_deg);
  for (const char* motion : {"external_rotation", "external_rotation_at_90_flexion"})
    EXPECT_NEAR(degrees(turned, motion), degrees(before, motion) - 10, exact_deg);
  EXPECT_NEAR(degrees(turned, "flexion"), 138.0, 0.05);
  EXPECT_NEAR(degrees(turned, "extension"), 62.8, 0.05);
  EXPECT_NEAR(degrees(turned, "adduction"), 30.2, 0.05);
}

}  // namespace
}  // namespace condyle
