#include "condyle/joint_checks.hpp"

#include "support/test.hpp"

/// Wrong set-ups of real hips are each answered with their note, right ones with none.

namespace condyle {
namespace {

using Code = JointNoteCode;

struct Hip {
  Side side;
  TriMesh hip_bone, femur;
};

Hip read_hip(Side side, const char* folder, const char* hip_bone, const char* femur) {
  const auto path = *test::shared_data() / folder;
  return {side, test::read_ply(path / hip_bone), test::read_ply(path / femur)};
}
const Hip& vhf() {
  static const Hip hip = read_hip(Side::right, "hip_vhf_right", "hip_bone.ply", "femur.ply");
  return hip;
}
const Hip& libhip() {
  static const Hip hip = read_hip(Side::left, "hip_libhip_m1_left", "hip_bone.ply", "femur.ply");
  return hip;
}
/// The same hip with a tenth of the triangles, for what needs no more.
const Hip& coarse_libhip() {
  static const Hip hip =
      read_hip(Side::left, "hip_libhip_m1_left/coarse", "hip_bone_2442.ply", "femur_1542.ply");
  return hip;
}

/// A hip as its user describes it.
struct HipSetUp {
  JointDescription joint;
  TriMesh fixed, mobile;
};

HipSetUp right_set_up(const Hip& hip) {
  HipSetUp set_up{{.name = "hip", .side = hip.side}, hip.hip_bone, hip.femur};
  set_up.joint.frame.centre.emplace<Vec3>(Vec3::Zero());
  return set_up;
}

std::vector<JointNote> notes_on(const HipSetUp& set_up) {
  const auto [joint, placement] =
      make_joint(set_up.joint, {"hip bone", set_up.fixed}, {"femur", set_up.mobile});
  return check_joint(joint, placement);
}

using test::scaled_by, test::shifted_by, test::turned;

/// Mirrored across a coordinate plane.
TriMesh mirrored(const TriMesh& mesh, int axis) {
  Eigen::Matrix3d M = Eigen::Matrix3d::Identity();
  M(axis, axis) = -1;
  return turned(mesh, M);
}
/// As segmentation software does to a bone whose axes it mixes up.
TriMesh mirrored_only(const TriMesh& mesh, int axis) {
  return test::flipped(mirrored(mesh, axis));
}
TriMesh without_some_triangles(TriMesh mesh) {
  mesh.triangles.erase(mesh.triangles.begin() + 100, mesh.triangles.begin() + 103);
  return mesh;
}

/// A scanner's axes x, y, z in the hip frame (X anterior, Y superior, Z right), as rows.
Eigen::Matrix3d to_lps() {
  Eigen::Matrix3d M;
  M << 0, 0, -1, -1, 0, 0, 0, 1, 0;
  return M;
}

const Vec3 x = Vec3::UnitX(), y = Vec3::UnitY(), z = Vec3::UnitZ();

/// The same of both bodies.
template <class Change, class... Arguments>
void change_both(HipSetUp& s, const Change& change, const Arguments&... arguments) {
  s.fixed = change(s.fixed, arguments...), s.mobile = change(s.mobile, arguments...);
}

/// Each slice shifted forwards by so much of its height.
void tilt_gantry(HipSetUp& s) {
  Eigen::Matrix3d sheared = Eigen::Matrix3d::Identity();
  sheared(0, 1) = std::tan(10 * std::numbers::pi / 180);
  change_both(s, turned, sheared);
  s.joint.frame.centre = CentreFit{};
}

struct Case {
  const char* name;
  const Hip& (*hip)();
  std::function<void(HipSetUp&)> wrong;
  std::vector<Code> codes;
  friend void PrintTo(const Case& c, std::ostream* out) { *out << c.name; }
};

std::function<void(HipSetUp&)> with_axes(const Vec3& anterior, const Vec3& superior) {
  return [=](HipSetUp& s) { s.joint.frame.axes = FrameDirections{anterior, superior}; };
}
std::function<void(HipSetUp&)> with_centre(const Vec3& centre) {
  return [=](HipSetUp& s) { s.joint.frame.centre.emplace<Vec3>(centre); };
}

const std::vector<Case> wrong_set_ups{
    {"OtherSide", vhf, [](HipSetUp& s) { s.joint.side = Side::left; }, {Code::wrong_side}},
    {"OtherSideOfALeftHip", libhip, [](HipSetUp& s) { s.joint.side = Side::right; }, {Code::wrong_side}},
    {"AxesTurnedAboutSuperior", vhf, with_axes(-x, y), {Code::axes_turned}},
    {"LpsReadAsRas",
     coarse_libhip,
     [](HipSetUp& s) {
       change_both(s, turned, to_lps());
       s.joint.frame.axes = FrameDirections{y, z};
     },
     {Code::axes_turned}},
    {"UpsideDown", vhf, with_axes(x, -y), {Code::axes_not_upright}},
    {"SuperiorIsAnotherAxis", vhf, with_axes(x, z), {Code::axes_not_upright}},
    {"UpsideDownAndBackToFront", coarse_libhip, with_axes(-x, -y), {Code::axes_not_upright}},
    {"MillimetresCalledMetres",
     vhf,
     [](HipSetUp& s) { s.joint.units = LengthUnit::metres; },
     {Code::unlikely_size, Code::unlikely_size}},
    {"MetresCalledMillimetres",
     vhf,
     [](HipSetUp& s) { change_both(s, scaled_by, 1e-3); },
     {Code::unlikely_size, Code::unlikely_size}},
    {"AMouse",
     vhf,
     [](HipSetUp& s) { change_both(s, scaled_by, 0.03), s.joint.person.species = "mouse"; },
     {}},
    {"CentreOffBy3mm", vhf, with_centre({0, -3, 0}), {Code::centre_off_head}},
    {"CentreOffBy50mm", vhf, with_centre({-30, 40, 0}), {Code::centre_off_head}},
    {"CentreAtTheOtherEndOfTheFemur", vhf, with_centre({0, -400, 0}), {Code::centre_off_head}},
    {"SwappedBodies", vhf, [](HipSetUp& s) { std::swap(s.fixed, s.mobile); }, {Code::swapped_bodies}},
    {"MirroredSideToSide", vhf, [](HipSetUp& s) { change_both(s, mirrored, 2); }, {Code::wrong_side}},
    {"MirroredFrontToBack", vhf, [](HipSetUp& s) { change_both(s, mirrored, 0); }, {Code::mirrored}},
    {"MirroredInsideOut",
     vhf,
     [](HipSetUp& s) { change_both(s, mirrored_only, 2); },
     {Code::inverted_mesh, Code::inverted_mesh}},
    {"FemurOfTheOtherSide",
     vhf,
     [](HipSetUp& s) { s.mobile = mirrored(s.mobile, 2); },
     {Code::bodies_disagree}},
    {"HipBoneOfTheOtherSide",
     coarse_libhip,
     [](HipSetUp& s) { s.fixed = mirrored(s.fixed, 2); },
     {Code::bodies_disagree}},
    // About y = 0 a femur in LPS lies at the other side's socket of a pelvis in RAS.
    {"FemurInLpsAtAHipBoneInRas",
     vhf,
     [](HipSetUp& s) { s.mobile = mirrored(s.mobile, 0); },
     {Code::unlikely_version}},
    {"FemurInLpsAtAHipBoneInRasOfTheOtherHip",
     libhip,
     [](HipSetUp& s) { s.mobile = mirrored(s.mobile, 0); },
     {Code::unlikely_version}},
    {"ReversedFemur",
     vhf,
     [](HipSetUp& s) { s.mobile = test::flipped(s.mobile); },
     {Code::inverted_mesh, Code::no_head}},
    {"ReversedHipBone", vhf, [](HipSetUp& s) { s.fixed = test::flipped(s.fixed); }, {Code::inverted_mesh}},
    {"ReversedPieceBesideTheHipBone",
     vhf,
     [](HipSetUp& s) {
       s.fixed = test::joined(s.fixed, test::flipped(test::box({80, 80, 80}, {84, 84, 84})));
     },
     {Code::separate_pieces, Code::inverted_mesh}},
    {"OpenFemur", vhf, [](HipSetUp& s) { s.mobile = without_some_triangles(s.mobile); }, {Code::open_mesh}},
    {"OpenHipBone", vhf, [](HipSetUp& s) { s.fixed = without_some_triangles(s.fixed); }, {Code::open_mesh}},
    {"SecondSurfaceThroughTheFemur",
     vhf,
     [](HipSetUp& s) {
       s.mobile = test::joined(s.mobile, shifted_by(s.mobile, {0.4, 0, 0}));
     },
     {Code::nested_surfaces, Code::self_crossings}},
    {"HeadPulledFromItsSocket",
     vhf,
     [](HipSetUp& s) {
       s.mobile = shifted_by(s.mobile, {0, -3, 2});
       s.joint.frame.centre = CentreFit{};
     },
     {Code::head_socket_apart}},
    {"HeadLargerThanItsSocket",
     vhf,
     [](HipSetUp& s) { s.mobile = scaled_by(s.mobile, 1.1); },
     {Code::socket_smaller_than_head}},
    {"SpacingOfSlicesLost",
     vhf,
     [](HipSetUp& s) { change_both(s, turned, Vec3(1, 1, 1.1).asDiagonal().toDenseMatrix()); },
     {Code::head_not_round}},
    {"GantryTilted", vhf, tilt_gantry, {Code::head_not_round, Code::turned_leg}},
    {"GantryTiltedOfTheOtherHip", coarse_libhip, tilt_gantry, {Code::head_not_round}},
    {"CentreFittedToACondyle",
     vhf,
     [](HipSetUp& s) {
       s.joint.frame.centre = CentreFit{.within = Sphere{{0, -400, 0}, 80}};
     },
     {Code::low_coverage}},
    {"ThighFlexedInTheScan",
     vhf,
     [](HipSetUp& s) {
       s.mobile = turned(s.mobile, Eigen::AngleAxisd(std::numbers::pi / 2, z).toRotationMatrix());
     },
     {Code::axes_not_upright}},
};

class WrongSetUp : public testing::TestWithParam<Case> {};
INSTANTIATE_TEST_SUITE_P(SharedHips, WrongSetUp, testing::ValuesIn(wrong_set_ups),
                         [](const auto& wrong) { return wrong.param.name; });

TEST_P(WrongSetUp, IsAnsweredWithItsNote) {
  if (!test::shared_data()) GTEST_SKIP() << "no shared data: set CONDYLE_DATA";
  HipSetUp set_up = right_set_up(GetParam().hip());
  GetParam().wrong(set_up);
  std::vector<Code> codes;
  std::string texts;
  for (const JointNote& note : notes_on(set_up)) {
    codes.push_back(note.code);
    texts += std::string(name_of(note.code)) + ": " + note.text + '\n';
    test::expect_silent(note.text, "\n");
  }
  EXPECT_EQ(codes, GetParam().codes) << texts;
}

TEST(RightSetUp, IsAnsweredWithoutANote) {
  if (!test::shared_data()) GTEST_SKIP() << "no shared data: set CONDYLE_DATA";
  const auto expect_none = [](const HipSetUp& set_up, const char* what) {
    for (const JointNote& note : notes_on(set_up)) ADD_FAILURE() << what << ": " << note.text;
  };
  for (const Hip* hip : {&vhf(), &libhip(), &coarse_libhip()}) {
    HipSetUp set_up = right_set_up(*hip);
    expect_none(set_up, "as stated");
    set_up.joint.frame.centre = CentreFit{};
    expect_none(set_up, "centre fitted to the head");
  }
  HipSetUp in_lps = right_set_up(coarse_libhip());
  change_both(in_lps, turned, to_lps());
  in_lps.joint.frame.axes = FrameDirections{-y, z};
  expect_none(in_lps, "LPS called LPS");
  HipSetUp other = right_set_up(vhf());
  change_both(other, mirrored, 2);
  other.joint.side = Side::left;
  expect_none(other, "mirrored to the left and called left");
}

/// Turned by a little less or more than half a turn, the socket seems to open straight to the side, or forwards.
TEST(JointChecks, AxesThatAreTurnedByMoreOrLessThanHalfATurnAreTurned) {
  if (!test::shared_data()) GTEST_SKIP() << "no shared data: set CONDYLE_DATA";
  for (const Hip* hip : {&vhf(), &coarse_libhip()})
    for (const double deg : {150.0, 165.0, 180.0, 195.0, 210.0}) {
      HipSetUp set_up = right_set_up(*hip);
      const Eigen::Matrix3d turn =
          Eigen::AngleAxisd(deg * std::numbers::pi / 180, Vec3::UnitY()).toRotationMatrix();
      change_both(set_up, turned, turn);
      const auto notes = notes_on(set_up);
      ASSERT_EQ(notes.size(), 1u) << deg;
      EXPECT_EQ(notes[0].code, Code::axes_turned) << deg << ": " << notes[0].text;
    }
}

/// The socket that the sample of a hip states is where it is stated, whatever the surface has.
TEST(JointChecks, ASocketThatIsStatedIsNotFittedAgain) {
  const TriMesh head =
      test::joined(test::sphere({0, 0, 0}, 24, 4), test::box({-10, -400, -10}, {10, -40, 10}));
  const TriMesh bone = test::socket({0, 0, 0}, 26, 60, 4);
  const auto notes_with = [&](const std::optional<Sphere>& socket) {
    JointDescription description{.name = "joint"};
    description.frame.centre.emplace<Vec3>(Vec3::Zero());
    Body fixed{"hip bone", bone};
    fixed.head = socket;
    const auto [joint, placement] = make_joint(description, fixed, {"femur", head});
    std::vector<Code> codes;
    // Ball and shaft do not touch.
    for (const JointNote& note : check_joint(joint, placement))
      if (note.code != Code::separate_pieces) codes.push_back(note.code);
    return codes;
  };
  EXPECT_EQ(notes_with({}), std::vector<Code>{});
  EXPECT_EQ(notes_with(Sphere{{0, 1.4, 0}, 26}), std::vector<Code>{});
  EXPECT_EQ(notes_with(Sphere{{0, 1.6, 0}, 26}), std::vector<Code>{Code::head_socket_apart});
  EXPECT_EQ(notes_with(Sphere{{0, 0, 0}, 23.4}), std::vector<Code>{Code::socket_smaller_than_head});
}

TEST(JointChecks, ACentreFittedToAStatedSphereIsThatSpheres) {
  const TriMesh bone = test::socket({0, 0, 0}, 26, 60, 4), head = test::sphere({0, 0, 0}, 24, 4);
  for (const BodyRole body : {BodyRole::fixed, BodyRole::mobile}) {
    JointDescription description{.name = "joint"};
    description.frame.centre = CentreFit{.body = body};
    Body fixed{"hip bone", bone}, mobile{"femur", head};
    (body == BodyRole::fixed ? fixed : mobile).head = Sphere{{0.25, -0.5, 0.75}, 25};
    const PlacedJoint placed = make_joint(description, fixed, mobile);
    EXPECT_EQ(Vec3(placed.placement.X_WF.translation()), Vec3(0.25, -0.5, 0.75));
    ASSERT_TRUE(placed.placement.sphere);
    EXPECT_EQ(placed.placement.sphere->fit.sphere.radius, 25);
    test::expect_says(placed.placement.processing.back(), "stated");
  }
}

TEST(JointChecks, ThatDoNotApplyAreSilent) {
  // No head, no socket, a hinge, and a head in a socket without anatomy.
  const auto notes_of = [](JointKind kind, TriMesh fixed, TriMesh mobile) {
    JointDescription joint{.name = "joint", .kind = kind};
    return notes_on({joint, std::move(fixed), std::move(mobile)});
  };
  const TriMesh post = test::box({40, -120, -50}, {60, -80, 50}),
                arm = test::box({-1, -100, -2}, {1, -10, 2});
  EXPECT_TRUE(notes_of(JointKind::ball, post, arm).empty());
  const auto headless = notes_of(JointKind::ball, test::socket({0, 0, 0}, 26, 60, 3), arm);
  ASSERT_EQ(headless.size(), 1u);
  EXPECT_EQ(headless[0].code, Code::no_head) << "a socket, and nothing spherical in it";
  EXPECT_TRUE(notes_of(JointKind::hinge, post, test::sphere({7, 0, 0}, 20, 4)).empty());
  const TriMesh head =
      test::joined(test::sphere({0, 0, 0}, 24, 4), test::box({-10, -400, -10}, {10, -40, 10}));
  const auto notes = notes_of(JointKind::ball, test::socket({0, 0, 0}, 26, 60, 3), head);
  ASSERT_EQ(notes.size(), 1u);
  EXPECT_EQ(notes[0].code, Code::separate_pieces) << "ball and shaft do not touch";
}

TEST(JointChecks, ASurfaceThatIsThereTwiceIsNoted) {
  const TriMesh ball = test::sphere({0, -50, 0}, 20, 3);
  Joint joint{"joint",
              JointKind::hinge,
              Side::right,
              {"fixed", test::box({40, -120, -50}, {60, -80, 50})},
              {"mobile", test::joined(ball, ball)}};
  const auto notes = check_joint(joint, {});
  ASSERT_EQ(notes.size(), 2u);
  EXPECT_EQ(notes[0].code, Code::separate_pieces);
  EXPECT_EQ(notes[1].code, Code::doubled_triangles);
  test::expect_says(notes[1].text, "512 of its 1024");
  joint.mobile.mesh = Mesh(ball);
  EXPECT_TRUE(check_joint(joint, {}).empty());
}

TEST(JointChecks, AnImplantsBallInABonySocketIsNoted) {
  const auto noted = [](double radius) {
    const TriMesh stem =
        test::joined(test::sphere({0, 0, 0}, radius, 5), test::box({-8, -150, -8}, {8, -12, 8}));
    for (const JointNote& note : notes_on({{.name = "hip"}, test::socket({0, 0, 0}, 26, 60, 4), stem}))
      if (note.code == Code::socket_larger_than_head) return true;
    return false;
  };
  EXPECT_TRUE(noted(14));
  EXPECT_TRUE(noted(18));   // 1.44 times
  EXPECT_FALSE(noted(19));  // 1.37 times: a wide socket
  EXPECT_FALSE(noted(24));
}

/// Cut at a height of a block of 100 mm: what lies behind the plane is the part.
TEST(JointChecks, APartThatIsMostOfItsFixedBodyIsNoted) {
  const auto codes_with = [](BodyRole body, const Vec3& normal, double height) {
    PosedPart fragment{.name = "fragment", .body = body};
    fragment.parameters = {{.name = "frontal", .kind = ParameterKind::frontal, .low = -10, .high = 10}};
    fragment.cut = {{{0, height, 0}, normal}};
    JointDescription description{.name = "joint", .kind = JointKind::hinge};
    description.frame.centre.emplace<Vec3>(Vec3::Zero());
    description.parts = {{fragment}};
    const TriMesh block = test::box({40, -100, -30}, {90, 0, 30}),
                  other = test::box({-90, -100, -30}, {-40, 0, 30});
    const PlacedJoint placed = make_joint(description, {"hip bone", block}, {"femur", other});
    std::vector<Code> codes;
    for (const JointNote& note : check_joint(placed.joint, placed.placement))
      if (note.code == Code::part_is_most) codes.push_back(note.code);
    return codes;
  };
  const std::vector<Code> noted{Code::part_is_most};
  EXPECT_TRUE(codes_with(BodyRole::fixed, Vec3::UnitY(), -51).empty()) << "49 of 100 mm lie below";
  EXPECT_EQ(codes_with(BodyRole::fixed, Vec3::UnitY(), -49), noted);
  EXPECT_EQ(codes_with(BodyRole::fixed, -Vec3::UnitY(), -51), noted) << "the same plane, its normal turned";
  EXPECT_TRUE(codes_with(BodyRole::mobile, -Vec3::UnitY(), -51).empty());
}

TEST(JointChecks, MeshesOfOneBodyMayLieInEachOther) {
  const TriMesh bone = test::box({-20, -100, -20}, {20, 0, 20}), cartilage = test::sphere({0, -5, 0}, 15, 3);
  Joint joint{"joint",
              JointKind::hinge,
              Side::right,
              {"fixed", test::box({40, -120, -50}, {60, -80, 50})},
              {"mobile", test::joined(bone, cartilage)}};
  const auto notes = check_joint(joint, {});
  ASSERT_EQ(notes.size(), 2u);
  EXPECT_EQ(notes[0].code, Code::nested_surfaces);
  EXPECT_EQ(notes[1].code, Code::self_crossings);
  joint.mobile.parts = {{"bone", 0, bone.vertices.size(), 0, bone.triangles.size()},
                        {"cartilage", bone.vertices.size(), cartilage.vertices.size(), bone.triangles.size(),
                         cartilage.triangles.size()}};
  EXPECT_TRUE(check_joint(joint, {}).empty());
}

TEST(JointChecks, AllCodesHaveNamesOfTheirOwn) {
  std::vector<std::string_view> names;
  for (int code = 0; code <= static_cast<int>(Code::two_sided); ++code)
    names.push_back(name_of(static_cast<Code>(code)));
  std::sort(names.begin(), names.end());
  EXPECT_EQ(std::adjacent_find(names.begin(), names.end()), names.end());
  EXPECT_FALSE(names.front().empty());
}

}  // namespace
}  // namespace condyle
