#include "condyle/joint_checks.hpp"
#include "support/parametric_shoulder.hpp"
#include "support/test.hpp"

/// Wrong set-ups of shoulders, knees, ankles and elbows of parts are each answered with their note, right ones with none.

namespace condyle {
namespace {

using namespace test;
using Code = JointNoteCode;

std::vector<Code> codes_of(const Joint& joint, const JointPlacement& placement = {}) {
  std::vector<Code> codes;
  for (const JointNote& note : check_joint(joint, placement)) {
    codes.push_back(note.code);
    test::expect_silent(note.text, "\n");
  }
  return codes;
}

using Codes = std::vector<Code>;

/// Triangles that cross are not what is asked here: a body of several meshes may have them.
Body of_parts(const char* name, const std::vector<TriMesh>& meshes) {
  std::vector<BodyPart> parts;
  TriMesh all;
  for (const TriMesh& mesh : meshes) {
    parts.push_back({"part " + std::to_string(parts.size() + 1), all.vertices.size(), mesh.vertices.size(),
                     all.triangles.size(), mesh.triangles.size()});
    all = joined(all, mesh);
  }
  return {name, Mesh(all), parts};
}

Body shifted(Body body, const Vec3& by) {
  body.mesh = Mesh(shifted_by(body.mesh, by));
  return body;
}
void shift_both(Joint& joint, const Vec3& by) {
  joint.fixed = shifted(joint.fixed, by), joint.mobile = shifted(joint.mobile, by);
}
Body turned(Body body, const Eigen::Matrix3d& by) {
  body.mesh = Mesh(test::turned(TriMesh(body.mesh), by));
  return body;
}
Joint joint_of(Anatomy anatomy, JointKind kind, Body fixed, Body mobile, Side side = Side::right) {
  Joint joint{"joint", kind, side, std::move(fixed), std::move(mobile)};
  joint.anatomy = anatomy;
  return joint;
}
Joint mirrored(Joint joint) {
  joint.side = joint.side == Side::right ? Side::left : Side::right;
  for (Body* body : {&joint.fixed, &joint.mobile}) {
    TriMesh mesh = body->mesh;
    for (double& z : mesh.vertices.z) z = -z;
    body->mesh = Mesh(flipped(std::move(mesh)));
  }
  return joint;
}
Eigen::Matrix3d half_turn(const Vec3& axis) {
  return Eigen::AngleAxisd(std::numbers::pi, axis).toRotationMatrix();
}

/// A right shoulder whose scapula has a blade medial of the glenoid.
Joint whole_shoulder() {
  constexpr double w = ParametricShoulder::shaft_half_width;
  return joint_of(Anatomy::shoulder, JointKind::ball,
                  of_parts("scapula", {slab_with_dish(26), box({-15, 34, -10}, {15, 40, 30}),
                                       box({-20, -110, -130}, {-12, 30, -30})}),
                  of_parts("humerus", {sphere(Vec3::Zero(), 24, 4), box({-w, -250, -w}, {w, -15, w})}));
}

TEST(ShoulderChecks, SayNothingOfARightShoulder) {
  EXPECT_EQ(codes_of(whole_shoulder()), Codes{});
  EXPECT_EQ(codes_of(mirrored(whole_shoulder())), Codes{});
  Joint glides = whole_shoulder();
  glides.mobile = shifted(glides.mobile, {0, 0.9, 0});
  EXPECT_EQ(codes_of(glides), Codes{});
  Joint worn = whole_shoulder();  // a head of a third of a sphere, 1.2 mm before a larger dish
  worn.fixed.parts.clear(), worn.mobile.parts.clear();
  worn.fixed.mesh =
      Mesh(joined(shifted_by(slab_with_dish(32), {0, 0, 6.8}), box({-15, 34, -10}, {15, 40, 30})));
  EXPECT_EQ(codes_of(worn), (Codes{Code::separate_pieces, Code::separate_pieces, Code::self_crossings}))
      << "of slab and acromion, ball and shaft";
}

TEST(ShoulderChecks, NoteWhatIsWrong) {
  const auto codes_after = [](const std::function<void(Joint&)>& wrong) {
    Joint joint = whole_shoulder();
    wrong(joint);
    return codes_of(joint);
  };
  EXPECT_EQ(codes_after([](Joint& s) { std::swap(s.fixed, s.mobile); }), Codes{Code::swapped_bodies});
  EXPECT_EQ(codes_after([](Joint& s) { s.side = Side::left; }), Codes{Code::wrong_side});
  EXPECT_EQ(codes_after([](Joint& s) { shift_both(s, {0, 3, 0}); }), Codes{Code::centre_off_head});
  EXPECT_EQ(codes_after([](Joint& s) {
              s.fixed = shifted(s.fixed, {0, 7, 0});
            }),
            Codes{Code::head_socket_apart});
  EXPECT_EQ(codes_after([](Joint& s) {
              const Eigen::Matrix3d upside_down = half_turn(Vec3::UnitZ());
              s.fixed = turned(s.fixed, upside_down), s.mobile = turned(s.mobile, upside_down);
            }),
            Codes{Code::axes_not_upright});
  EXPECT_EQ(codes_after([](Joint& s) {
              s.mobile = turned(s.mobile,
                                Eigen::AngleAxisd(-std::numbers::pi / 2, Vec3::UnitX()).toRotationMatrix());
            }),
            Codes{Code::axes_not_upright})
      << "an arm that is held out in the scan";
}

TEST(ShoulderChecks, AskForLessOfAHeadThanThoseOfHips) {
  Joint joint = whole_shoulder();
  JointPlacement placement;
  const auto fitted_with = [&](double coverage) {
    placement.sphere.emplace(SphericalPatch{{{Vec3::Zero(), 24}, 0, 0, {}}, coverage});
    return codes_of(joint, placement);
  };
  EXPECT_EQ(fitted_with(0.3), Codes{});
  EXPECT_EQ(fitted_with(0.2), Codes{Code::low_coverage});
}

/// Two rods with rounded ends 4 mm apart, 25 mm below an axis along Z: no bones, and slender as bones are.
Joint rods(JointKind kind, Anatomy anatomy) {
  return joint_of(anatomy, kind, of_parts("upper", {box({-15, -23, -30}, {15, 400, 30})}),
                  of_parts("lower", {box({-15, -380, -30}, {15, -27, 30})}));
}

TEST(LongBoneChecks, SayNothingOfARightJoint) {
  for (const Anatomy anatomy : {Anatomy::knee, Anatomy::elbow, Anatomy::ankle})
    for (const JointKind kind : {JointKind::hinge, JointKind::ball, JointKind::free})
      EXPECT_EQ(codes_of(rods(kind, anatomy)), Codes{});
  Joint stumps = rods(JointKind::hinge, Anatomy::knee);
  stumps.fixed = of_parts("upper", {box({-30, -23, -40}, {30, 60, 40})});
  stumps.mobile = of_parts("lower", {box({-30, -90, -40}, {30, -27, 40})});
  EXPECT_EQ(codes_of(stumps), Codes{});
  stumps.fixed = turned(stumps.fixed, half_turn(Vec3::UnitX()));
  EXPECT_EQ(codes_of(stumps), Codes{}) << "what is no shaft says nothing";
}

TEST(LongBoneChecks, NoteWhatIsWrong) {
  const Eigen::Matrix3d forwards = Eigen::AngleAxisd(std::numbers::pi / 2, Vec3::UnitZ()).toRotationMatrix();
  for (const JointKind kind : {JointKind::hinge, JointKind::ball, JointKind::free}) {
    const auto codes_after = [&](Anatomy anatomy, const std::function<void(Joint&)>& wrong) {
      Joint joint = rods(kind, anatomy);
      wrong(joint);
      return codes_of(joint);
    };
    const bool is_free = kind == JointKind::free;
    const auto unless_free = [&](Code code) { return is_free ? Codes{} : Codes{code}; };
    for (const Anatomy anatomy : {Anatomy::knee, Anatomy::elbow}) {
      EXPECT_EQ(codes_after(anatomy, [](Joint& j) { std::swap(j.fixed, j.mobile); }),
                Codes{Code::swapped_bodies});
      EXPECT_EQ(codes_after(anatomy, [&](Joint& j) { j.mobile = turned(j.mobile, forwards); }),
                unless_free(Code::axes_not_upright))
          << "bent in the scan";
    }
    EXPECT_EQ(codes_after(Anatomy::ankle, [&](Joint& j) { j.fixed = turned(j.fixed, forwards); }),
              unless_free(Code::axes_not_upright));
    EXPECT_EQ(codes_after(Anatomy::ankle, [&](Joint& j) { j.mobile = turned(j.mobile, forwards); }), Codes{})
        << "a foot has no shaft";
    EXPECT_EQ(codes_after(Anatomy::knee,
                          [](Joint& j) {
                            shift_both(j, {20, 0, 0});
                          }),
              Codes{})
        << "43 mm from the axis at most";
    EXPECT_EQ(codes_after(Anatomy::knee,
                          [](Joint& j) {
                            shift_both(j, {80, 0, 0});
                          }),
              unless_free(Code::far_centre));
  }
  Joint unnamed = rods(JointKind::hinge, Anatomy::hip);
  std::swap(unnamed.fixed, unnamed.mobile);
  EXPECT_EQ(codes_of(unnamed), Codes{}) << "a hinge of no joint";
}

TEST(LongBoneChecks, SayNothingOfASmallBoneThatLiesOnALongOne) {
  // A patella and menisci on a tibia; the tibia hangs from the joint, and is no thigh.
  const Body tibia = of_parts("tibia", {box({-55, -430, -35}, {5, -50, 35})});
  const TriMesh patella = box({0, -20, -22}, {20, 22, 22}), menisci = box({-50, -48, -35}, {0, -38, 35});
  for (const TriMesh& small : {patella, menisci})
    for (const JointKind kind : {JointKind::hinge, JointKind::ball, JointKind::free}) {
      Joint joint = joint_of(Anatomy::knee, kind, tibia, of_parts("small", {small}));
      EXPECT_EQ(codes_of(joint), Codes{});
      joint.fixed = of_parts("tibia", {box({-55, -140, -35}, {5, -50, 35})});
      EXPECT_EQ(codes_of(joint), Codes{}) << "cut 90 mm below its plateau";
    }
  // Just beside the bound, a fifth of the cube of the tibia's breadth.
  for (const double size : {0.21, 0.19}) {
    const Joint exchanged =
        joint_of(Anatomy::knee, JointKind::hinge, of_parts("tibia", {box({-30, -430, -35}, {30, -30, 35})}),
                 of_parts("femur", {box({-35, -25, -35}, {35, -25 + 70 * size, 35})}));
    EXPECT_EQ(codes_of(exchanged), size > 0.2 ? Codes{Code::swapped_bodies} : Codes{}) << size;
  }
}

TEST(LongBoneChecks, TakeAFreeJointInItsReferencePose) {
  // Both bones in the frame of the upper one, whose origin is at its other end, as in OpenSim; the lower one is brought there.
  Joint joint = rods(JointKind::free, Anatomy::knee);
  joint.fixed = shifted(joint.fixed, {0, -400, 0});
  JointPlacement placement;
  placement.reference_pose.translation_mm = Vec3(0, -400, 0);
  EXPECT_EQ(codes_of(joint, placement), Codes{});
  placement.reference_pose.translation_mm = Vec3(0, 400, 0);
  EXPECT_EQ(codes_of(joint, placement), Codes{Code::swapped_bodies});
}

/// Whatever the surfaces of real bones are like.
Codes of_shape(const Joint& joint) {
  Codes codes = codes_of(joint);
  std::erase(codes, Code::open_mesh), std::erase(codes, Code::self_crossings);
  return codes;
}

TEST(LongBoneChecks, KnowAWholeFemurByItsShaft) {
  FOUND_OR_SKIP(data, test::shared_data());
  const TriMesh femur = read_ply(*data / "hip_vhf_right" / "femur.ply");  // its head at the origin
  const double lowest = std::ranges::min(femur.vertices.y);
  const Body tibia = of_parts("tibia", {box({-35, -60, -35}, {35, -30, 35})});
  Joint knee =
      joint_of(Anatomy::knee, JointKind::hinge, {"femur", shifted_by(femur, {0, -lowest - 25, 0})}, tibia);
  EXPECT_EQ(of_shape(knee), Codes{});
  knee.fixed = turned(knee.fixed, half_turn(Vec3::UnitX()));
  EXPECT_EQ(of_shape(knee), Codes{Code::axes_not_upright});
  knee.fixed = {"femur", femur};  // the hip's frame
  EXPECT_EQ(of_shape(knee), (Codes{Code::axes_not_upright}));
  knee.fixed = {"femur", femur};
  knee.mobile = shifted(tibia, {0, lowest + 25, 0});
  EXPECT_EQ(of_shape(knee), (Codes{Code::axes_not_upright, Code::far_centre}));
}

TEST(LongBoneChecks, KnowTheSideOfAWholeFemurByItsHead) {
  FOUND_OR_SKIP(data, test::shared_data());
  const TriMesh femur = read_ply(*data / "hip_vhf_right" / "femur.ply");
  const double lowest = std::ranges::min(femur.vertices.y);
  const TriMesh bones[] = {shifted_by(femur, {0, -lowest - 25, 0}), box({-35, -60, -35}, {35, -30, 35})};
  const auto codes = [&](JointKind kind, Side side, const Vec3& origin, const Eigen::Matrix3d& by) {
    const auto made = [&](const TriMesh& bone) { return test::turned(shifted_by(bone, origin), by); };
    return of_shape(
        joint_of(Anatomy::knee, kind, {"femur", made(bones[0])}, {"tibia", made(bones[1])}, side));
  };
  const Eigen::Matrix3d as_it_is = Eigen::Matrix3d::Identity(), mirror = Vec3(1, 1, -1).asDiagonal(),
                        about_up = half_turn(Vec3::UnitY()), head_down = half_turn(Vec3::UnitX());
  for (const JointKind kind : {JointKind::free, JointKind::hinge, JointKind::ball}) {
    const Vec3 here = Vec3::Zero();
    EXPECT_EQ(codes(kind, Side::right, here, as_it_is), Codes{});
    EXPECT_EQ(codes(kind, Side::left, here, mirror), Codes{});
    EXPECT_EQ(codes(kind, Side::left, here, as_it_is), Codes{Code::wrong_side})
        << "of the right side, named left";
    EXPECT_EQ(codes(kind, Side::right, here, mirror), Codes{Code::wrong_side});
    EXPECT_EQ(codes(kind, Side::right, here, about_up), Codes{Code::axes_turned});
  }
  // As in OpenSim, where a femur's origin is the centre of its head.
  const Vec3 at_head(0, lowest + 25, 0);
  EXPECT_EQ(codes(JointKind::free, Side::right, at_head, as_it_is), Codes{});
  EXPECT_EQ(codes(JointKind::free, Side::left, at_head, as_it_is), Codes{Code::wrong_side});
  EXPECT_EQ(codes(JointKind::free, Side::right, at_head, head_down), Codes{Code::swapped_bodies});
}

TEST(LongBoneChecks, SayNothingOfTheSharedKnee) {
  FOUND_OR_SKIP(data, test::shared_data());
  const auto mesh = [&](const char* name) { return read_ply(*data / "knee_lenhart2015_right" / name); };
  const std::array femurs{mesh("femur_cartilage.ply"), mesh("femur_bone.ply")};
  const std::array others{mesh("tibia_cartilage.ply"), mesh("patella_cartilage.ply"), mesh("tibia_bone.ply"),
                          mesh("patella_bone.ply")};
  for (const TriMesh& femur : femurs)
    for (const TriMesh& other : others) {
      Joint joint{"knee", JointKind::hinge, Side::right, {"femur", femur}, {"other", other}};
      const Codes of_a_hinge_of_no_joint = codes_of(joint);
      joint.anatomy = Anatomy::knee;
      for (const JointKind kind : {JointKind::free, JointKind::hinge, JointKind::ball}) {
        joint.kind = kind;
        EXPECT_EQ(codes_of(joint), of_a_hinge_of_no_joint);
      }
    }
  for (const JointKind kind : {JointKind::free, JointKind::hinge, JointKind::ball}) {
    EXPECT_EQ(codes_of(joint_of(Anatomy::knee, kind, {"tibia", others[2]}, {"femur", femurs[1]})),
              Codes{Code::swapped_bodies})
        << "bones cut 9 cm from the joint";
    const Codes codes = codes_of(joint_of(Anatomy::knee, kind, {"tibia", others[2]}, {"patella", others[3]}));
    for (const Code wrong :
         {Code::swapped_bodies, Code::axes_not_upright, Code::axes_turned, Code::wrong_side})
      EXPECT_EQ(std::count(codes.begin(), codes.end(), wrong), 0) << name_of(wrong);
  }
}

}  // namespace
}  // namespace condyle
