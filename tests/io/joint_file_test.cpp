#include "condyle/io/joint_file.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <sstream>
#include <utility>

#include "condyle/error.hpp"
#include "condyle/io/mesh_file.hpp"
#include "condyle/joint_checks.hpp"
#include "core/predicates.hpp"
#include "support/temporary_folder.hpp"
#include "support/test_meshes.hpp"

namespace condyle {
namespace {

using test::TemporaryFolder;

constexpr const char* plain = R"(condyle = 1
name = "right hip"
kind = "ball"
side = "right"
units = "mm"
[fixed]
name = "hip bone"
mesh = "hip_bone.ply"
[mobile]
name = "femur"
mesh = "femur.ply"
[frame]
centre = [0.0, 0.0, 0.0]
anterior = [1.0, 0.0, 0.0]
superior = [0.0, 1.0, 0.0]
)";

std::string replaced(std::string text, std::string_view from, std::string_view to) {
  const auto at = text.find(from);
  EXPECT_NE(at, text.npos) << from;
  return at == text.npos ? text : text.replace(at, from.size(), to);
}

TriMesh scaled(TriMesh mesh, double scale) {
  for (std::size_t v = 0; v < mesh.vertices.size(); ++v) mesh.vertices.set(v, scale * mesh.vertices[v]);
  return mesh;
}

/// A socket and a head with a long neck, the size of bones, off the grid of floats by thirds.
TriMesh pelvis_like() {
  return test::socket({1.0 / 3, -0.0, 2.0 / 3}, 26, 60, 3);
}
TriMesh femur_like() {
  return test::joined(test::sphere({1.0 / 3, -0.0, 2.0 / 3}, 24, 4),
                      test::box({-10, -400, -10}, {10, -60, 10}));
}

class ReadJoint : public ::testing::Test {
 protected:
  void SetUp() override {
    io::write_mesh(folder / "hip_bone.ply", pelvis_like());
    io::write_mesh(folder / "femur.ply", femur_like());
  }
  std::filesystem::path write(std::string_view text) const { return folder.file("joint.toml", text); }
  io::LoadedJoint read(std::string_view text) const { return io::read_joint(write(text)); }

  /// The error's message after the file's name, or "accepted".
  std::string refusal(std::string_view text) const {
    const auto path = write(text);
    try {
      io::read_joint(path);
    } catch (const FileError& error) {
      const std::string message = error.what();
      EXPECT_EQ(message.find('\n'), message.npos);
      const std::string start = path.string() + ": ";
      EXPECT_TRUE(message.starts_with(start)) << message;
      return message.substr(std::min(message.size(), start.size()));
    }
    return "accepted";
  }
  std::string refusal_of(std::string_view from, std::string_view to) const {
    return refusal(replaced(plain, from, to));
  }

  const TemporaryFolder folder;
};

TEST_F(ReadJoint, StandardPlacementKeepsEveryBit) {
  const auto [joint, report] = read(plain);
  const TriMesh fixed = pelvis_like(), mobile = femur_like();
  EXPECT_EQ(joint.fixed.mesh, fixed);
  EXPECT_EQ(joint.mobile.mesh, mobile);
  // Equal doubles may still differ in the sign of 0.
  for (std::size_t v = 0; v < mobile.vertices.size(); ++v)
    EXPECT_EQ(std::signbit(joint.mobile.mesh.vertices().y[v]), std::signbit(mobile.vertices.y[v]));
  EXPECT_EQ(joint.name, "right hip");
  EXPECT_EQ(joint.kind, JointKind::ball);
  EXPECT_EQ(joint.side, Side::right);
  EXPECT_EQ(joint.fixed.name, "hip bone");
  EXPECT_EQ(joint.mobile.name, "femur");
  EXPECT_TRUE(report.processing.empty()) << report.processing.front();
}

TEST_F(ReadJoint, LinesMayEndWithACarriageReturnAlone) {
  std::string text = plain;
  std::replace(text.begin(), text.end(), '\n', '\r');
  EXPECT_EQ(read(text).joint.name, "right hip");
  EXPECT_TRUE(refusal(text + "no key\r").starts_with("line 16: not TOML")) << refusal(text + "no key\r");
}

TEST_F(ReadJoint, AJointMadeByHandIsTheSameBitForBit) {
  std::string text =
      replaced(plain, "[0.0, 0.0, 0.0]", "\"fit\"\nfit_within = { centre = [0, 0, 0], radius = 30 }");
  text = replaced(replaced(text, "[1.0, 0.0, 0.0]", "[0.8, 0.0, 0.6]"), "\"right\"", "\"left\"");
  const auto [by_file, report] = read(text + "[reference_pose]\nflexion = 20\nadduction = -10\n");

  JointDescription description{.name = "right hip", .kind = JointKind::ball, .side = Side::left};
  description.frame.centre = CentreFit{.body = BodyRole::mobile, .within = Sphere{{0, 0, 0}, 30}};
  description.frame.axes = FrameDirections{{0.8, 0, 0.6}, {0, 1, 0}};
  description.reference_pose.angles = {Angle::degrees(20), Angle::degrees(-10), {}};
  const auto [by_hand, placement] =
      make_joint(description, {"hip bone", pelvis_like()}, {"femur", femur_like()});

  EXPECT_EQ(by_file.fixed.mesh.arrays(), by_hand.fixed.mesh.arrays());
  EXPECT_EQ(by_file.mobile.mesh.arrays(), by_hand.mobile.mesh.arrays());
  EXPECT_EQ(by_file.name, by_hand.name);
  EXPECT_EQ(by_file.mobile.name, by_hand.mobile.name);
  EXPECT_EQ(by_file.side, by_hand.side);
  EXPECT_EQ(report.placement.X_WF.matrix(), placement.X_WF.matrix());
  EXPECT_EQ(report.processing, placement.processing);
}

TEST_F(ReadJoint, MetresBecomeMillimetres) {
  io::write_mesh(folder / "hip_bone.ply", scaled(pelvis_like(), 0.001));
  io::write_mesh(folder / "femur.ply", scaled(femur_like(), 0.001));
  const auto [joint, report] =
      read(replaced(replaced(plain, "\"mm\"", "\"m\""), "[0.0, 0.0, 0.0]", "[0.001, 0.002, -0.003]"));
  const Vec3 centre(1, 2, -3);
  EXPECT_TRUE(report.placement.X_WF.translation().isApprox(centre, 4 * core::rounding_unit));
  const TriMesh expected = femur_like();
  for (std::size_t v = 0; v < expected.vertices.size(); ++v)
    // The test's own scaling, that of the file and the centre's: u each, of at most 400 mm.
    EXPECT_LE((joint.mobile.mesh.vertices()[v] - (expected.vertices[v] - centre)).cwiseAbs().maxCoeff(),
              4 * core::rounding_unit * 400);
  EXPECT_EQ(report.processing.size(), 1u);
}

TEST_F(ReadJoint, ACentreIsSubtractedWithOneRounding) {
  const auto [joint, report] = read(replaced(plain, "[0.0, 0.0, 0.0]", "[0.1, -0.2, 0.3]"));
  const TriMesh expected = femur_like();
  for (std::size_t v = 0; v < expected.vertices.size(); ++v) {
    EXPECT_EQ(joint.mobile.mesh.vertices().x[v], expected.vertices.x[v] - 0.1);
    EXPECT_EQ(joint.mobile.mesh.vertices().y[v], expected.vertices.y[v] + 0.2);
    EXPECT_EQ(joint.mobile.mesh.vertices().z[v], expected.vertices.z[v] - 0.3);
  }
}

TEST_F(ReadJoint, AScannersFrameBecomesTheJointsWithoutRounding) {
  // Left, posterior, superior: anterior is -y, superior z, and right -x.
  const auto [joint, report] =
      read(replaced(replaced(plain, "[1.0, 0.0, 0.0]", "[0, -1, 0]"), "[0.0, 1.0, 0.0]", "[0, 0, 1]"));
  const TriMesh given = femur_like();
  for (std::size_t v = 0; v < given.vertices.size(); ++v) {
    const Vec3 p = given.vertices[v];
    EXPECT_EQ(joint.mobile.mesh.vertices()[v], Vec3(-p.y(), p.z(), -p.x()));
  }
}

TEST_F(ReadJoint, AReferencePoseIsTakenOffTheMobileMeshOnly) {
  for (const auto& [name, side] : {std::pair{"right", Side::right}, std::pair{"left", Side::left}}) {
    const JointAngles reference{Angle::degrees(20), Angle::degrees(-10), Angle::degrees(5)};
    const auto [joint, report] =
        read(replaced(plain, "\"right\"", "\"" + std::string(name) + "\"") +
             "[reference_pose]\nflexion = 20\nadduction = -10.0\ninternal_rotation = 5\n");
    EXPECT_EQ(joint.fixed.mesh, pelvis_like());
    EXPECT_EQ(report.file.joint.reference_pose.angles, reference);
    // In the reference pose the mesh is again where the file has it: two rotations with a few u of 400 mm each.
    const TriMesh given = femur_like(), back = posed(pose_at({.side = side}, reference), joint.mobile.mesh);
    for (std::size_t v = 0; v < given.vertices.size(); ++v)
      EXPECT_LE((back.vertices[v] - given.vertices[v]).norm(), 32 * core::rounding_unit * 400);
  }
}

TEST_F(ReadJoint, AFittedCentreIsThatOfTheHeadAndIsReported) {
  const auto [joint, report] = read(replaced(plain, "[0.0, 0.0, 0.0]", "\"fit\""));
  ASSERT_TRUE(report.placement.sphere);
  // Vertices of 24 mm rounded to double lie on the sphere: see the tests of the fit.
  EXPECT_LE((report.placement.X_WF.translation() - Vec3(1.0 / 3, 0, 2.0 / 3)).norm(), 1e-12);
  EXPECT_NEAR(report.placement.sphere->fit.sphere.radius, 24, 1e-12);
  ASSERT_EQ(report.processing.size(), 1u);
  EXPECT_TRUE(report.processing[0].starts_with("centre fitted: sphere of radius 24.000 mm"))
      << report.processing[0];
}

TEST_F(ReadJoint, ASocketCanBeFittedInstead) {
  const auto [joint, report] = read(replaced(plain, "[0.0, 0.0, 0.0]", "\"fit\"\nfit_body = \"fixed\""));
  ASSERT_TRUE(report.placement.sphere);
  EXPECT_NEAR(report.placement.sphere->fit.sphere.radius, 26, 1e-12);
}

TEST_F(ReadJoint, AFitThatFindsNothingIsAMeshErrorWithFileAndKey) {
  const auto path = write(
      replaced(plain, "[0.0, 0.0, 0.0]", "\"fit\"\nfit_within = { centre = [0, -300, 0], radius = 20 }"));
  try {
    io::read_joint(path);
    FAIL();
  } catch (const MeshError& error) {
    EXPECT_TRUE(std::string(error.what())
                    .starts_with(path.string() + ": frame.centre: " +
                                 (path.parent_path() / "femur.ply").string() + ": no spherical head"))
        << error.what();
  }
}

TEST_F(ReadJoint, LandmarksGiveTheAxes) {
  const std::string axes = "anterior = [1.0, 0.0, 0.0]\nsuperior = [0.0, 1.0, 0.0]\n";
  const auto at = [&](std::string_view landmarks) {
    return read(replaced(plain, axes, "[frame.landmarks]\n" + std::string(landmarks))).report.placement.X_WF;
  };
  const auto isb =
      at("right_asis = [0, 0, 120]\nleft_asis = [0, 0, -120]\nright_psis = [-150, 0, 45]\nleft_psis = [-150, "
         "0, -45]\n");
  EXPECT_TRUE(isb.matrix().isApprox(Pose::Identity().matrix(), 8 * core::rounding_unit));
  const auto plane =
      at("right_asis = [0, 0, 120]\nleft_asis = [0, 0, -120]\npubic_symphysis = [0, -90, 0]\n");
  EXPECT_TRUE(plane.matrix().isApprox(Pose::Identity().matrix(), 8 * core::rounding_unit));
  const auto femur = at("medial_epicondyle = [0, -400, -40]\nlateral_epicondyle = [0, -400, 40]\n");
  EXPECT_TRUE(femur.matrix().isApprox(Pose::Identity().matrix(), 8 * core::rounding_unit));
  const auto knee =
      read(replaced(replaced(plain, axes,
                             "[frame.landmarks]\nmedial_epicondyle = [0, -400, -40]\nlateral_epicondyle = "
                             "[0, -400, 40]\nhip_centre = [0, 0, 0]\n"),
                    "centre = [0.0, 0.0, 0.0]\n", ""));
  EXPECT_TRUE(knee.report.placement.X_WF.translation() == Vec3(0, -400, 0));
}

TEST_F(ReadJoint, LandmarksOfBothBodiesGiveTheNeutralPose) {
  // The scan has the femur flexed, adducted and turned in: its epicondyles are where that pose brings them.
  const JointAngles scan{Angle::degrees(12), Angle::degrees(4), Angle::degrees(-7)};
  const Pose X = pose_at({.side = Side::right}, scan);
  const auto text = [](const char* key, const Vec3& p) {
    std::ostringstream line;
    line.precision(17);
    line << key << " = [" << p.x() << ", " << p.y() << ", " << p.z() << "]\n";
    return line.str();
  };
  const std::string axes = "anterior = [1.0, 0.0, 0.0]\nsuperior = [0.0, 1.0, 0.0]\n";
  const std::string pelvis =
      "right_asis = [0, 0, 120]\nleft_asis = [0, 0, -120]\npubic_symphysis = [0, -90, 0]\n";
  const std::string both =
      replaced(plain, axes,
               "[frame.landmarks]\n" + pelvis + text("medial_epicondyle", X * Vec3(0, -400, -40)) +
                   text("lateral_epicondyle", X * Vec3(0, -400, 40)));
  io::write_mesh(folder / "femur.ply", posed(X, femur_like()));
  const auto [joint, report] = read(both);
  const JointAngles& found = report.placement.reference_pose.angles;
  EXPECT_NEAR(found.flexion.degrees(), 12, 1e-12);
  EXPECT_NEAR(found.adduction.degrees(), 4, 1e-12);
  EXPECT_NEAR(found.internal_rotation.degrees(), -7, 1e-12);
  const TriMesh neutral = femur_like();
  for (std::size_t v = 0; v < neutral.vertices.size(); ++v)
    ASSERT_LT((joint.mobile.mesh.vertices()[v] - neutral.vertices[v]).norm(), 1e-10);
  EXPECT_NE(report.processing.back().find("flexion 12.00, adduction 4.00"), std::string::npos)
      << report.processing.back();
  EXPECT_TRUE(refusal(both + "[reference_pose]\nflexion = 3\n").ends_with("leave it out"));
  EXPECT_NE(
      refusal(replaced(both, pelvis, pelvis + "hip_centre = [0, 0, 0]\n")).find("hip_centre: unknown key"),
      std::string::npos);
}

TEST_F(ReadJoint, ACentreIsAlsoTakenInTheFilesUnits) {
  const std::string axes = "anterior = [1.0, 0.0, 0.0]\nsuperior = [0.0, 1.0, 0.0]\n";
  io::write_mesh(folder / "hip_bone.ply", scaled(pelvis_like(), 0.001));
  io::write_mesh(folder / "femur.ply", scaled(femur_like(), 0.001));
  const auto femur = read(replaced(
      replaced(
          plain, axes,
          "[frame.landmarks]\nmedial_epicondyle = [0, -0.4, -0.04]\nlateral_epicondyle = [0, -0.4, 0.04]\n"),
      "\"mm\"", "\"m\""));
  EXPECT_TRUE(
      femur.report.placement.X_WF.matrix().isApprox(Pose::Identity().matrix(), 8 * core::rounding_unit));
}

TEST_F(ReadJoint, RepairsAreMadeInOrderAndReported) {
  TriMesh dirty = test::flipped(femur_like());
  dirty.vertices.push_back({500, 0, 0});
  io::write_mesh(folder / "femur.ply", dirty);
  const auto [joint, report] =
      read(replaced(plain, "mesh = \"femur.ply\"",
                    "mesh = \"femur.ply\"\nrepair = [\"drop_unreferenced\", \"flip_inverted\"]"));
  EXPECT_EQ(joint.mobile.mesh.vertices(), femur_like().vertices);
  ASSERT_EQ(report.mobile[0].repairs.size(), 2u);
  EXPECT_EQ(report.mobile[0].repairs[0].count, 1u);
  EXPECT_EQ(report.mobile[0].repairs[1].count, dirty.triangles.size());
  EXPECT_EQ(report.processing.size(), 2u);
}

TEST_F(ReadJoint, MeshesInContradictingUnitsAreRefusedNamingBoth) {
  io::write_mesh(folder / "femur.ply", scaled(femur_like(), 0.001));
  const std::string message = refusal(plain);
  EXPECT_NE(message.find("hip_bone.ply looks like millimetres"), message.npos) << message;
  EXPECT_NE(message.find("femur.ply like metres"), message.npos) << message;
}

TEST_F(ReadJoint, AUnitThatDoesNotFitTheMeshesIsNotedButFollowed) {
  io::write_mesh(folder / "hip_bone.ply", scaled(pelvis_like(), 0.001));
  io::write_mesh(folder / "femur.ply", scaled(femur_like(), 0.001));
  const auto [joint, report] = read(plain);
  EXPECT_EQ(joint.mobile.mesh, scaled(femur_like(), 0.001));
  const auto notes = check_joint(joint, report.placement);
  ASSERT_EQ(notes.size(), 3u);
  for (const std::size_t body : {0u, 1u})
    EXPECT_EQ(notes[body].code, JointNoteCode::unlikely_size) << notes[body].text;
  EXPECT_EQ(notes[2].code, JointNoteCode::separate_pieces) << "ball and shaft";
  EXPECT_NE(notes[1].text.find("is it in metres?"), std::string::npos) << notes[1].text;
}

TEST_F(ReadJoint, CentimetresAndInchesBecomeMillimetres) {
  for (const auto& [word, mm] : {std::pair{"cm", 10.0}, std::pair{"in", 25.4}}) {
    io::write_mesh(folder / "hip_bone.ply", scaled(pelvis_like(), 1 / mm));
    io::write_mesh(folder / "femur.ply", scaled(femur_like(), 1 / mm));
    const auto [joint, report] = read(replaced(plain, "\"mm\"", std::string("\"") + word + "\""));
    EXPECT_NEAR(joint.mobile.mesh.vertices()[0].norm(), Mesh(femur_like()).vertices()[0].norm(), 1e-5)
        << word;
    EXPECT_NE(report.processing.at(0).find("to mm"), std::string::npos);
  }
}

TEST_F(ReadJoint, PiecesBesideTheBoneAreLeftOutIfTheFileSaysSo) {
  const TriMesh ball = test::sphere({1.0 / 3, 0, 2.0 / 3}, 24, 4),
                shaft = test::box({-10, -400, -10}, {10, -60, 10});
  const auto triangles = [&](std::string_view pieces) {
    return read(replaced(plain, "mesh = \"femur.ply\"",
                         "mesh = \"femur.ply\"\npieces = \"" + std::string(pieces) + '"'));
  };
  EXPECT_EQ(triangles("all").joint.mobile.mesh.triangles().size(),
            ball.triangles.size() + shaft.triangles.size());
  const auto largest = triangles("largest");  // 136,000 mm^3 of shaft, 57,900 of ball
  EXPECT_EQ(largest.joint.mobile.mesh.triangles().size(), shaft.triangles.size());
  EXPECT_EQ(largest.report.processing.back(),
            "femur.ply: 2048 of 2060 triangles left out: pieces beside the largest");
  EXPECT_EQ(triangles("at_joint").joint.mobile.mesh.triangles().size(), ball.triangles.size())
      << "24 mm from the centre, not 60";
  EXPECT_EQ(
      refusal(replaced(replaced(plain, "mesh = \"femur.ply\"", "mesh = \"femur.ply\"\npieces = \"at_joint\""),
                       "centre = [0.0, 0.0, 0.0]", "centre = \"fit\"")),
      "mobile.pieces: \"at_joint\" needs a centre that is stated in frame.centre");
}

TEST_F(ReadJoint, ScannerAxesAreNamedByOneKey) {
  const std::string axes = "anterior = [1.0, 0.0, 0.0]\nsuperior = [0.0, 1.0, 0.0]\n";
  for (const auto& [name, anterior] :
       {std::pair{"LPS", "[0.0, -1.0, 0.0]"}, std::pair{"RAS", "[0.0, 1.0, 0.0]"}}) {
    const auto named = read(replaced(plain, axes, std::string("axes = \"") + name + "\"\n"));
    const auto spelt =
        read(replaced(plain, axes, std::string("anterior = ") + anterior + "\nsuperior = [0, 0, 1]\n"));
    EXPECT_EQ(named.joint.mobile.mesh.vertices(), spelt.joint.mobile.mesh.vertices()) << name;
    EXPECT_EQ(named.report.placement.X_WF.linear().col(1), Vec3(Vec3::UnitZ()));
    EXPECT_TRUE(named.report.processing.empty());
  }
  EXPECT_NE(
      refusal(replaced(plain, axes, "axes = \"LAS\"\n")).find("must be \"LPS\" or \"RAS\", not \"LAS\""),
      std::string::npos);
  EXPECT_NE(refusal(replaced(plain, axes, "axes = \"LPS\"\nsuperior = [0, 0, 1]\n"))
                .find("frame.superior: frame.axes gives the axes already"),
            std::string::npos);
}

TEST_F(ReadJoint, AMissingKeyIsNamed) {
  for (const auto& [line, message] : {
           std::pair{"condyle = 1\n", "condyle: is missing"},
           std::pair{"name = \"right hip\"\n", "name: is missing"},
           std::pair{"kind = \"ball\"\n", "kind: is missing"},
           std::pair{"side = \"right\"\n", "side: is missing"},
           std::pair{"units = \"mm\"\n", "units: is missing"},
           std::pair{"mesh = \"hip_bone.ply\"\n", "fixed.mesh: is missing"},
           std::pair{"mesh = \"femur.ply\"\n", "mobile.mesh: is missing"},
           std::pair{"centre = [0.0, 0.0, 0.0]\n", "frame.centre: is missing"},
           std::pair{"anterior = [1.0, 0.0, 0.0]\n", "frame.anterior: is missing"},
           std::pair{"superior = [0.0, 1.0, 0.0]\n", "frame.superior: is missing"},
       }) {
    const std::string answer = refusal_of(line, "");
    EXPECT_TRUE(answer.ends_with(message)) << answer;
  }
  EXPECT_TRUE(refusal("condyle = 1\n").ends_with("name: is missing"));
}

TEST_F(ReadJoint, WrongTypesAndWordsAreNamedWithTheirLine) {
  EXPECT_EQ(refusal_of("condyle = 1", "condyle = 2"),
            "line 1: condyle: format version 2 is not known; this is version 1");
  EXPECT_EQ(refusal_of("condyle = 1", "condyle = 1.0"),
            "line 1: condyle: must be a whole number, not a number");
  EXPECT_EQ(refusal_of("\"right hip\"", "5"), "line 2: name: must be a text in quotes, not a whole number");
  EXPECT_EQ(refusal_of("\"ball\"", "\"saddle\""),
            "line 3: kind: must be \"ball\" or \"hinge\" or \"free\", not \"saddle\"");
  EXPECT_EQ(refusal_of("\"right\"", "\"Right\""),
            "line 4: side: must be \"right\" or \"left\", not \"Right\"");
  EXPECT_EQ(refusal_of("\"mm\"", "\"ft\""),
            "line 5: units: must be \"mm\" or \"cm\" or \"in\" or \"m\", not \"ft\"");
  EXPECT_EQ(refusal_of("[0.0, 0.0, 0.0]", "\"fitted\""),
            "line 13: frame.centre: must be [x, y, z] or \"fit\"");
  EXPECT_EQ(refusal_of("[0.0, 0.0, 0.0]", "[0, 0]"),
            "line 13: frame.centre: must be a list of three numbers, not of 2");
  EXPECT_EQ(refusal_of("[0.0, 0.0, 0.0]", "[0, 0, \"0\"]"),
            "line 13: frame.centre: must be a number, not a text");
  EXPECT_EQ(refusal_of("[0.0, 0.0, 0.0]", "[0, 0, nan]"), "line 13: frame.centre: must be a finite number");
  EXPECT_EQ(refusal_of("[0.0, 0.0, 0.0]", "[0, inf, 0]"), "line 13: frame.centre: must be a finite number");
  EXPECT_EQ(refusal_of("[frame]", "[[frame]]"), "line 12: frame: must be a table, not a list");
  EXPECT_EQ(refusal_of("mesh = \"femur.ply\"", "mesh = \"\""), "line 11: mobile.mesh: must name a file");
  EXPECT_EQ(
      refusal_of("mesh = \"femur.ply\"", "mesh = \"femur.ply\"\nrepair = [\"fill\"]"),
      "line 12: mobile.repair: unknown repair \"fill\"; there are weld, drop_unreferenced and flip_inverted");
}

TEST_F(ReadJoint, UnknownKeysAreRefusedEverywhere) {
  EXPECT_EQ(refusal_of("[frame]\n", "[frame]\ncenter = 5\n").substr(0, 34),
            "line 13: frame.center: unknown key");
  EXPECT_EQ(refusal_of("units", "unit = 1\nunits").substr(0, 25), "line 5: unit: unknown key");
  EXPECT_NE(refusal_of("[mobile]\n", "[mobile]\nnaem = \"femur\"\n").find("(did you mean \"name\"?)"),
            std::string::npos);
  EXPECT_EQ(refusal_of("[mobile]\n", "[mobile]\ncolour = 1\n").substr(0, 35),
            "line 10: mobile.colour: unknown key");
  EXPECT_EQ(refusal(plain + std::string("[reference_pose]\nflex = 1\n")).substr(0, 40),
            "line 17: reference_pose.flex: unknown ke");
  for (const char* other : {"rest", "reference", "rest_pose"})
    EXPECT_EQ(refusal(plain + std::string("[") + other + "]\nflexion = 5\n"),
              "line 16: " + std::string(other) + ": unknown key (did you mean \"reference_pose\"?)");
}

TEST_F(ReadJoint, TheReferencePoseSaysWhatZeroIsKnownBy) {
  const auto zero_of = [&](const std::string& table) {
    const io::LoadedJoint loaded = read(plain + table);
    EXPECT_EQ(loaded.joint.zero_from, loaded.report.placement.zero_from);
    return loaded.joint.zero_from;
  };
  EXPECT_EQ(zero_of(""), ZeroFrom::as_given);
  EXPECT_EQ(zero_of("[reference_pose]\n"), ZeroFrom::stated);
  EXPECT_EQ(zero_of("[reference_pose]\nflexion = 0\n"), ZeroFrom::stated);
  EXPECT_EQ(zero_of("[reference_pose]\nadduction = -10\n"), ZeroFrom::stated);
}

TEST_F(ReadJoint, AReferencePoseFromTheAnatomyNeedsCondylesAndAHip) {
  const TriMesh condyles =
      test::joined(test::sphere({0, -390, 25}, 20, 4), test::sphere({0, -390, -25}, 20, 4));
  const TriMesh whole = test::joined(
      test::joined(test::sphere({0, 0, 0}, 24, 5), test::box({-8, -375, -8}, {8, -20, 8})), condyles);
  const std::string from = "[reference_pose]\nfrom = \"anatomy\"\n";
  io::write_mesh(folder / "femur.ply",
                 posed(pose_at({.side = Side::right}, {{}, {}, Angle::degrees(-25)}), whole));
  const auto [joint, report] = read(plain + from);
  EXPECT_EQ(joint.zero_from, ZeroFrom::anatomy);
  EXPECT_NEAR(report.placement.reference_pose.angles.internal_rotation.degrees(), -25, 1e-3);
  EXPECT_NE(report.processing.back().find("the condyles of the femur give the reference pose"),
            std::string::npos)
      << report.processing.back();
  // A head and a shaft.
  io::write_mesh(folder / "femur.ply", femur_like());
  try {
    read(plain + from);
    ADD_FAILURE() << "accepted";
  } catch (const MeshError& error) {
    EXPECT_NE(std::string(error.what()).find("shows no condyles"), std::string::npos) << error.what();
  }
  EXPECT_EQ(refusal(plain + std::string("[reference_pose]\nfrom = \"scan\"\n")).substr(0, 29),
            "line 17: reference_pose.from:");
  EXPECT_EQ(refusal(plain + from + "flexion = 3\n"),
            "line 18: reference_pose.flexion: the angles follow from the anatomy: leave them out");
  EXPECT_EQ(refusal(replaced(plain, "\"ball\"", "\"ball\"\njoint = \"knee\"") + from),
            "line 18: reference_pose.from: anatomy gives the reference pose of a hip only");
}

TEST_F(ReadJoint, UncertaintyIsReadWithItsSeed) {
  const io::JointFile usual = read(plain).report.file;
  EXPECT_EQ(usual.uncertainty.centre_mm, 0.5);
  EXPECT_EQ(usual.band_seed, 1u);
  const io::JointFile file =
      read(plain + std::string("[uncertainty]\ncentre = 0.75\naxes = 2\nsurface = 0\nseed = 42\n"))
          .report.file;
  EXPECT_EQ(file.uncertainty.centre_mm, 0.75);
  EXPECT_EQ(file.uncertainty.axes, Angle::degrees(2));
  EXPECT_EQ(file.uncertainty.surface_mm, 0);
  EXPECT_EQ(file.band_seed, 42u);
  EXPECT_EQ(refusal(plain + std::string("[uncertainty]\nseed = -1\n")),
            "line 17: uncertainty.seed: must be 0 or more");
  EXPECT_EQ(refusal(plain + std::string("[uncertainty]\nseed = 1.5\n")),
            "line 17: uncertainty.seed: must be a whole number, not a number");
}

TEST_F(ReadJoint, APersonHasAnAgeASexOrBoth) {
  EXPECT_FALSE(read(plain).joint.person.age_years || read(plain).joint.person.sex);
  const std::string table = plain + std::string("[person]\n");
  const Person girl = read(table + "age = 7.5\nsex = \"female\"\n").joint.person;
  EXPECT_EQ(girl.age_years, 7.5);
  EXPECT_EQ(girl.sex, Sex::female);
  EXPECT_FALSE(read(table + "sex = \"male\"\n").joint.person.age_years);
  for (const char* human : {"Human", "homo sapiens"})
    EXPECT_TRUE(read(table + "species = \"" + human + "\"\n").joint.person.is_human());
  EXPECT_FALSE(read(table + "species = \"cat\"\n").joint.person.is_human());
  EXPECT_EQ(refusal(table + "age = -1\n"), "line 17: person.age: must be 0 to 120 years");
  EXPECT_EQ(refusal(table + "age = 121\n"), "line 17: person.age: must be 0 to 120 years");
  EXPECT_NE(refusal(table + "sex = \"f\"\n").find("line 17: person.sex: "), std::string::npos);
  EXPECT_NE(refusal(table + "years = 7\n").find("line 17: person.years: unknown key"), std::string::npos);
}

TEST_F(ReadJoint, KeysThatContradictEachOtherAreRefused) {
  EXPECT_NE(refusal_of("[frame]",
                       "[frame.landmarks]\nmedial_epicondyle = [0, -400, -40]\nlateral_epicondyle = [0, "
                       "-400, 40]\n[frame]"),
            "accepted");
  EXPECT_NE(refusal_of("[frame]\n", "[frame]\nfit_body = \"fixed\"\n"), "accepted");
  EXPECT_NE(refusal_of("\"ball\"", "\"hinge\"\n[reference_pose]\nadduction = 5\n"), "accepted");
}

TEST_F(ReadJoint, OneSidesSpinesRequireTheOtherSides) {
  const std::string axes = "anterior = [1.0, 0.0, 0.0]\nsuperior = [0.0, 1.0, 0.0]\n";
  EXPECT_TRUE(refusal_of(axes, "[frame.landmarks]\nright_asis = [0, 0, 120]\nright_psis = [-150, 0, 45]\n")
                  .ends_with("frame.landmarks.left_asis: is missing"));
}

TEST_F(ReadJoint, AxesThatAreNotOrthonormalAreRefusedSayingByHowMuch) {
  EXPECT_EQ(refusal_of("[0.0, 1.0, 0.0]", "[0.6, 0.8, 0.0]"),
            "frame: anterior and superior are 53.1301 degrees apart, not 90 (off by 36.8699)");
  EXPECT_EQ(refusal_of("[0.0, 1.0, 0.0]", "[0.0, 0.0, 0.0]"), "frame: superior has length 0, not 1");
}

TEST_F(ReadJoint, AxesWithSixDecimalsAreMadeOrthonormalAndThatIsReported) {
  const auto [joint, report] = read(replaced(replaced(plain, "[1.0, 0.0, 0.0]", "[0.866025, 0.5, 0.0]"),
                                             "[0.0, 1.0, 0.0]", "[-0.5, 0.866025, 0.0]"));
  ASSERT_EQ(report.processing.size(), 1u);
  EXPECT_TRUE(report.processing[0].starts_with("axes made orthonormal")) << report.processing[0];
}

TEST_F(ReadJoint, WhatIsNotTomlIsRefusedWithItsLine) {
  EXPECT_TRUE(refusal_of("kind = \"ball\"", "kind = ball").starts_with("line 3: not TOML: "));
  EXPECT_TRUE(refusal_of("side", "kind = \"ball\"\nside").starts_with("line 4: not TOML: "));
  EXPECT_TRUE(refusal(std::string_view("\xff\xfe\0\x01", 4)).starts_with("line 1: not TOML: "));
  EXPECT_TRUE(refusal("").ends_with("condyle: is missing"));
}

TEST_F(ReadJoint, MissingFilesAreNamed) {
  EXPECT_THROW(io::read_joint(folder / "none.toml"), FileError);
  EXPECT_THROW(io::read_joint(folder.path()), FileError);
  const auto path = write(replaced(plain, "\"femur.ply\"", "\"none.ply\""));
  try {
    io::read_joint(path);
    FAIL();
  } catch (const FileError& error) {
    EXPECT_EQ(std::string(error.what()),
              path.string() + ": mobile.mesh: there is no file " + (folder / "none.ply").string());
  }
}

TEST_F(ReadJoint, CoordinatesThatOverflowInMillimetresAreRefused) {
  TriMesh huge = femur_like();
  huge.vertices.x[7] = 1e29;
  io::write_mesh(folder / "femur.ply", huge);
  const auto path = write(replaced(plain, "\"mm\"", "\"m\""));
  try {
    io::read_joint(path);
    FAIL();
  } catch (const FileError& error) {
    EXPECT_TRUE(
        std::string(error.what()).ends_with("femur.ply: vertex 7: coordinates too large for millimetres"))
        << error.what();
  }
}

}  // namespace
}  // namespace condyle
