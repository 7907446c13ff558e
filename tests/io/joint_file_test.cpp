#include "condyle/io/joint_file.hpp"

#include <sstream>

#include "condyle/io/mesh_file.hpp"
#include "condyle/joint_checks.hpp"
#include "core/predicates.hpp"
#include "support/joint_text.hpp"
#include "support/same_bits.hpp"
#include "support/test.hpp"

namespace condyle {
namespace {

using test::replaced;
using test::TemporaryFolder;

const std::string plain = test::joint_text({.name = "right hip",
                                            .fixed = "name = \"hip bone\"\nmesh = \"hip_bone.ply\"",
                                            .mobile = "name = \"femur\"\nmesh = \"femur.ply\""});
const std::string axes(test::plain_axes);

using test::scaled_by;

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
  void SetUp() override { write_meshes(1); }
  void write_meshes(double scale) const {
    io::write_mesh(folder / "hip_bone.ply", scaled_by(pelvis_like(), scale));
    io::write_mesh(folder / "femur.ply", scaled_by(femur_like(), scale));
  }
  std::filesystem::path write(std::string_view text) const { return folder.file("joint.toml", text); }
  io::LoadedJoint read(std::string_view text) const { return io::read_joint(write(text)); }

  std::string refusal(std::string_view text) const { return test::joint_refusal(write(text)); }
  std::string refusal_of(std::string_view from, std::string_view to) const {
    return refusal(replaced(plain, from, to));
  }

  const TemporaryFolder folder;
};

TEST_F(ReadJoint, StandardPlacementKeepsEveryBit) {
  const auto [joint, report] = read(plain);
  test::expect_same_bits(joint.fixed.mesh.arrays(), pelvis_like());
  test::expect_same_bits(joint.mobile.mesh.arrays(), femur_like());
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
  test::expect_begins(refusal(text + "no key\r"), "line 16: not TOML");
}

TEST_F(ReadJoint, AJointMadeByHandIsTheSameBitForBit) {
  std::string text =
      replaced(plain, "[0, 0, 0]", "\"fit\"\nfit_within = { centre = [0, 0, 0], radius = 30 }");
  text = replaced(replaced(text, "[1, 0, 0]", "[0.8, 0.0, 0.6]"), "\"right\"", "\"left\"");
  const auto [by_file, report] =
      read(text + "[reference_pose]\nflexion = 20\nadduction = -10.0\ninternal_rotation = 5\n");

  JointDescription description{.name = "right hip", .kind = JointKind::ball, .side = Side::left};
  description.frame.centre = CentreFit{.body = BodyRole::mobile, .within = Sphere{{0, 0, 0}, 30}};
  description.frame.axes = FrameDirections{{0.8, 0, 0.6}, {0, 1, 0}};
  description.reference_pose.angles = {Angle::degrees(20), Angle::degrees(-10), Angle::degrees(5)};
  EXPECT_EQ(report.file.joint.reference_pose.angles, description.reference_pose.angles);
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
  write_meshes(0.001);
  const auto [joint, report] =
      read(replaced(replaced(plain, "\"mm\"", "\"m\""), "[0, 0, 0]", "[0.001, 0.002, -0.003]"));
  const Vec3 centre(1, 2, -3);
  EXPECT_TRUE(report.placement.X_WF.translation().isApprox(centre, 4 * core::rounding_unit));
  const TriMesh expected = femur_like();
  for (std::size_t v = 0; v < expected.vertices.size(); ++v)
    // The test's own scaling, that of the file and the centre's: u each, of at most 400 mm.
    EXPECT_LE((joint.mobile.mesh.vertices()[v] - (expected.vertices[v] - centre)).cwiseAbs().maxCoeff(),
              4 * core::rounding_unit * 400);
  EXPECT_EQ(report.processing.size(), 1u);
}

TEST_F(ReadJoint, ASocketCanBeFittedInstead) {
  const auto [joint, report] = read(replaced(plain, "[0, 0, 0]", "\"fit\"\nfit_body = \"fixed\""));
  ASSERT_TRUE(report.placement.sphere);
  EXPECT_NEAR(report.placement.sphere->fit.sphere.radius, 26, 1e-12);
}

TEST_F(ReadJoint, AFitThatFindsNothingIsAMeshErrorWithFileAndKey) {
  const auto path =
      write(replaced(plain, "[0, 0, 0]", "\"fit\"\nfit_within = { centre = [0, -300, 0], radius = 20 }"));
  test::expect_begins(test::complaint_of<MeshError>([&] { io::read_joint(path); }),
                      path.string() + ": frame.centre: " + (path.parent_path() / "femur.ply").string() +
                          ": no spherical head");
}

TEST_F(ReadJoint, LandmarksGiveTheAxes) {
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
                    "centre = [0, 0, 0]\n", ""));
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
  EXPECT_LT(test::farthest(joint.mobile.mesh.vertices(), femur_like().vertices), 1e-10);
  test::expect_says(report.processing.back(), "flexion 12.00, adduction 4.00");
  test::expect_ends(refusal(both + "[reference_pose]\nflexion = 3\n"), "leave it out");
  test::expect_says(refusal(replaced(both, pelvis, pelvis + "hip_centre = [0, 0, 0]\n")),
                    "hip_centre: unknown key");
}

TEST_F(ReadJoint, ACentreIsAlsoTakenInTheFilesUnits) {
  write_meshes(0.001);
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
  io::write_mesh(folder / "femur.ply", scaled_by(femur_like(), 0.001));
  const std::string message = refusal(plain);
  test::expect_says(message, "hip_bone.ply looks like millimetres");
  test::expect_says(message, "femur.ply like metres");
}

TEST_F(ReadJoint, AUnitThatDoesNotFitTheMeshesIsNotedButFollowed) {
  write_meshes(0.001);
  const auto [joint, report] = read(plain);
  EXPECT_EQ(joint.mobile.mesh, scaled_by(femur_like(), 0.001));
  const auto notes = check_joint(joint, report.placement);
  ASSERT_EQ(notes.size(), 3u);
  for (const std::size_t body : {0u, 1u})
    EXPECT_EQ(notes[body].code, JointNoteCode::unlikely_size) << notes[body].text;
  EXPECT_EQ(notes[2].code, JointNoteCode::separate_pieces) << "ball and shaft";
  test::expect_says(notes[1].text, "is it in metres?");
}

TEST_F(ReadJoint, CentimetresAndInchesBecomeMillimetres) {
  for (const auto& [word, mm] : {std::pair{"cm", 10.0}, std::pair{"in", 25.4}}) {
    write_meshes(1 / mm);
    const auto [joint, report] = read(replaced(plain, "\"mm\"", std::string("\"") + word + "\""));
    EXPECT_NEAR(joint.mobile.mesh.vertices()[0].norm(), Mesh(femur_like()).vertices()[0].norm(), 1e-5)
        << word;
    test::expect_says(report.processing.at(0), "to mm");
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
                       "centre = [0, 0, 0]", "centre = \"fit\"")),
      "mobile.pieces: \"at_joint\" needs a centre that is stated in frame.centre");
}

TEST_F(ReadJoint, ScannerAxesAreNamedByOneKey) {
  for (const auto& [name, anterior] : {std::pair{"LPS", "[0.0, -1.0, 0.0]"}, std::pair{"RAS", "[0, 1, 0]"}}) {
    const auto named = read(replaced(plain, axes, std::string("axes = \"") + name + "\"\n"));
    const auto spelt =
        read(replaced(plain, axes, std::string("anterior = ") + anterior + "\nsuperior = [0, 0, 1]\n"));
    EXPECT_EQ(named.joint.mobile.mesh.vertices(), spelt.joint.mobile.mesh.vertices()) << name;
    EXPECT_EQ(named.report.placement.X_WF.linear().col(1), Vec3(Vec3::UnitZ()));
    EXPECT_TRUE(named.report.processing.empty());
  }
  test::expect_says(refusal(replaced(plain, axes, "axes = \"LAS\"\n")),
                    "must be \"LPS\" or \"RAS\", not \"LAS\"");
  test::expect_says(refusal(replaced(plain, axes, "axes = \"LPS\"\nsuperior = [0, 0, 1]\n")),
                    "frame.superior: frame.axes gives the axes already");
}

TEST_F(ReadJoint, AMissingKeyIsNamed) {
  for (const std::string line :
       {"condyle = 1", "name = \"right hip\"", "kind = \"ball\"", "side = \"right\"", "units = \"mm\"",
        "fixed.mesh = \"hip_bone.ply\"", "mobile.mesh = \"femur.ply\"", "frame.centre = [0, 0, 0]",
        "frame.anterior = [1, 0, 0]", "frame.superior = [0, 1, 0]"}) {
    const std::string key = line.substr(0, line.find(' '));
    test::expect_ends(refusal_of(line.substr(key.find('.') + 1) + "\n", ""), key + ": is missing");
  }
  test::expect_ends(refusal("condyle = 1\n"), "name: is missing");
}

TEST_F(ReadJoint, WrongTypesAndWordsAreNamedWithTheirLine) {
  for (const auto& [from, to, says] : std::vector<std::array<const char*, 3>>{
           {"condyle = 1", "condyle = 2", "1: condyle: format version 2 is not known; this is version 1"},
           {"condyle = 1", "condyle = 1.0", "1: condyle: must be a whole number, not a number"},
           {"\"right hip\"", "5", "2: name: must be a text in quotes, not a whole number"},
           {"\"ball\"", "\"saddle\"", "3: kind: must be \"ball\" or \"hinge\" or \"free\", not \"saddle\""},
           {"\"right\"", "\"Right\"", "4: side: must be \"right\" or \"left\", not \"Right\""},
           {"\"mm\"", "\"ft\"", "5: units: must be \"mm\" or \"cm\" or \"in\" or \"m\", not \"ft\""},
           {"[0, 0, 0]", "\"fitted\"", "13: frame.centre: must be [x, y, z] or \"fit\""},
           {"[0, 0, 0]", "[0, 0]", "13: frame.centre: must be a list of three numbers, not of 2"},
           {"[0, 0, 0]", "[0, 0, \"0\"]", "13: frame.centre: must be a number, not a text"},
           {"[0, 0, 0]", "[0, 0, nan]", "13: frame.centre: must be a finite number"},
           {"[0, 0, 0]", "[0, inf, 0]", "13: frame.centre: must be a finite number"},
           {"[frame]", "[[frame]]", "12: frame: must be a table, not a list"},
           {"mesh = \"femur.ply\"", "mesh = \"\"", "11: mobile.mesh: must name a file"},
           {"mesh = \"femur.ply\"", "mesh = \"femur.ply\"\nrepair = [\"fill\"]",
            "12: mobile.repair: unknown repair \"fill\"; there are weld, drop_unreferenced and "
            "flip_inverted"}})
    EXPECT_EQ(refusal_of(from, to), std::string("line ") + says);
}

TEST_F(ReadJoint, UnknownKeysAreRefusedEverywhere) {
  EXPECT_EQ(refusal_of("[frame]\n", "[frame]\ncenter = 5\n").substr(0, 34),
            "line 13: frame.center: unknown key");
  EXPECT_EQ(refusal_of("units", "unit = 1\nunits").substr(0, 25), "line 5: unit: unknown key");
  test::expect_says(refusal_of("[mobile]\n", "[mobile]\nnaem = \"femur\"\n"), "(did you mean \"name\"?)");
  EXPECT_EQ(refusal_of("[mobile]\n", "[mobile]\ncolour = 1\n").substr(0, 35),
            "line 10: mobile.colour: unknown key");
  EXPECT_EQ(refusal(plain + "[reference_pose]\nflex = 1\n").substr(0, 40),
            "line 17: reference_pose.flex: unknown ke");
  for (const char* other : {"rest", "reference", "rest_pose"})
    EXPECT_EQ(refusal(plain + "[" + other + "]\nflexion = 5\n"),
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
  test::expect_says(report.processing.back(), "the condyles of the femur give the reference pose");
  // A head and a shaft.
  io::write_mesh(folder / "femur.ply", femur_like());
  test::expect_says(test::complaint_of<MeshError>([&] { read(plain + from); }), "shows no condyles");
  EXPECT_EQ(refusal(plain + "[reference_pose]\nfrom = \"scan\"\n").substr(0, 29),
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
      read(plain + "[uncertainty]\ncentre = 0.75\naxes = 2\nsurface = 0\nseed = 42\n").report.file;
  EXPECT_EQ(file.uncertainty.centre_mm, 0.75);
  EXPECT_EQ(file.uncertainty.axes, Angle::degrees(2));
  EXPECT_EQ(file.uncertainty.surface_mm, 0);
  EXPECT_EQ(file.band_seed, 42u);
  const motion::Uncertainty ct = read(plain + "[uncertainty]\nsurface = \"ct\"\n").report.file.uncertainty;
  EXPECT_EQ(ct.surface_from, "ct");
  EXPECT_EQ(ct.surface_mm, 0.84);
  EXPECT_EQ(ct.surface_voxels, 0.25) << "the grid's part is added";
  EXPECT_EQ(refusal(plain + "[uncertainty]\nsurface = \"CT\"\n"),
            "line 17: uncertainty.surface: a number, or where surfaces come from: ct, ct_network, mr, "
            "radiographs, design");
  EXPECT_EQ(refusal(plain + "[uncertainty]\nseed = -1\n"), "line 17: uncertainty.seed: must be 0 or more");
  EXPECT_EQ(refusal(plain + "[uncertainty]\nseed = 1.5\n"),
            "line 17: uncertainty.seed: must be a whole number, not a number");
}

TEST_F(ReadJoint, APersonHasAnAgeASexOrBoth) {
  EXPECT_FALSE(read(plain).joint.person.age_years || read(plain).joint.person.sex);
  const std::string table = plain + "[person]\n";
  const Person girl = read(table + "age = 7.5\nsex = \"female\"\n").joint.person;
  EXPECT_EQ(girl.age_years, 7.5);
  EXPECT_EQ(girl.sex, Sex::female);
  EXPECT_FALSE(read(table + "sex = \"male\"\n").joint.person.age_years);
  for (const char* human : {"Human", "homo sapiens"})
    EXPECT_TRUE(read(table + "species = \"" + human + "\"\n").joint.person.is_human());
  EXPECT_FALSE(read(table + "species = \"cat\"\n").joint.person.is_human());
  EXPECT_EQ(refusal(table + "age = -1\n"), "line 17: person.age: must be 0 to 120 years");
  EXPECT_EQ(refusal(table + "age = 121\n"), "line 17: person.age: must be 0 to 120 years");
  test::expect_says(refusal(table + "sex = \"f\"\n"), "line 17: person.sex: ");
  test::expect_says(refusal(table + "years = 7\n"), "line 17: person.years: unknown key");
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
  test::expect_ends(
      refusal_of(axes, "[frame.landmarks]\nright_asis = [0, 0, 120]\nright_psis = [-150, 0, 45]\n"),
      "frame.landmarks.left_asis: is missing");
}

TEST_F(ReadJoint, AxesThatAreNotOrthonormalAreRefusedSayingByHowMuch) {
  EXPECT_EQ(refusal_of("[0, 1, 0]", "[0.6, 0.8, 0.0]"),
            "frame: anterior and superior are 53.1301 degrees apart, not 90 (off by 36.8699)");
  EXPECT_EQ(refusal_of("[0, 1, 0]", "[0, 0, 0]"), "frame: superior has length 0, not 1");
}

TEST_F(ReadJoint, AxesWithSixDecimalsAreMadeOrthonormalAndThatIsReported) {
  const auto [joint, report] = read(
      replaced(replaced(plain, "[1, 0, 0]", "[0.866025, 0.5, 0.0]"), "[0, 1, 0]", "[-0.5, 0.866025, 0.0]"));
  ASSERT_EQ(report.processing.size(), 1u);
  test::expect_begins(report.processing[0], "axes made orthonormal");
}

TEST_F(ReadJoint, WhatIsNotTomlIsRefusedWithItsLine) {
  test::expect_begins(refusal_of("kind = \"ball\"", "kind = ball"), "line 3: not TOML: ");
  test::expect_begins(refusal_of("side", "kind = \"ball\"\nside"), "line 4: not TOML: ");
  test::expect_begins(refusal(std::string_view("\xff\xfe\0\x01", 4)), "line 1: not TOML: ");
  test::expect_ends(refusal(""), "condyle: is missing");
}

TEST_F(ReadJoint, MissingFilesAreNamed) {
  EXPECT_THROW(io::read_joint(folder / "none.toml"), FileError);
  EXPECT_THROW(io::read_joint(folder.path()), FileError);
  const auto path = write(replaced(plain, "\"femur.ply\"", "\"none.ply\""));
  EXPECT_EQ(test::complaint_of<FileError>([&] { io::read_joint(path); }),
            path.string() + ": mobile.mesh: there is no file " + (folder / "none.ply").string());
}

TEST_F(ReadJoint, CoordinatesThatOverflowInMillimetresAreRefused) {
  TriMesh huge = femur_like();
  huge.vertices.x[7] = 1e29;
  io::write_mesh(folder / "femur.ply", huge);
  const auto path = write(replaced(plain, "\"mm\"", "\"m\""));
  test::expect_ends(test::complaint_of<FileError>([&] { io::read_joint(path); }),
                    "femur.ply: vertex 7: coordinates too large for millimetres");
}

}  // namespace
}  // namespace condyle
