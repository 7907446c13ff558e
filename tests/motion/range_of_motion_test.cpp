#include "condyle/range_of_motion.hpp"

#include "condyle/contact.hpp"
#include "condyle/limit_band.hpp"
#include "core/thread_limit.hpp"
#include "motion/joint_scenes.hpp"
#include "motion/motion_cases.hpp"
#include "support/test.hpp"

/// Limits of a joint's motions: closed forms in all three angles and on both sides, the joint in other words,
/// and the same bytes whichever way they are asked for.

namespace condyle::motion {
namespace {

using namespace test;

void expect_same_end(const MotionLimit& a, const MotionLimit& b) {
  EXPECT_EQ(a.end.turned, b.end.turned) << a.motion.name;
  EXPECT_EQ(a.end.reason, b.end.reason);
  EXPECT_EQ(a.end.kind(), b.end.kind());
  EXPECT_EQ(a.end.error_bound, b.end.error_bound);
  ASSERT_EQ(a.end.contact.has_value(), b.end.contact.has_value());
  if (!a.end.contact) return;
  EXPECT_EQ(a.end.contact->fixed_feature, b.end.contact->fixed_feature);
  EXPECT_EQ(a.end.contact->mobile_feature, b.end.contact->mobile_feature);
  EXPECT_EQ(a.end.contact->fixed_point, b.end.contact->fixed_point);
  EXPECT_EQ(a.end.contact->mobile_point, b.end.contact->mobile_point);
}

std::string name_of(JointAngle vary, Side side) {
  const char* angle = vary == JointAngle::flexion     ? "flexion"
                      : vary == JointAngle::adduction ? "adduction"
                                                      : "internal_rotation";
  return std::string(angle) + (side == Side::right ? "_right" : "_left");
}

class EachAngle : public testing::TestWithParam<std::tuple<JointAngle, Side>> {
 protected:
  JointAngle vary() const { return std::get<0>(GetParam()); }
  Side side() const { return std::get<1>(GetParam()); }
  Motion motion(const JointAngles& start = {}) const {
    return {"rotation", vary(), RotationSense::positive, start, Angle::degrees(180)};
  }
};
INSTANTIATE_TEST_SUITE_P(RangeOfMotion, EachAngle,
                         testing::Combine(testing::Values(JointAngle::flexion, JointAngle::adduction,
                                                          JointAngle::internal_rotation),
                                          testing::Values(Side::right, Side::left)),
                         [](const auto& at) {
                           return name_of(std::get<0>(at.param), std::get<1>(at.param));
                         });

TEST_P(EachAngle, AnArmMeetsAPostWhereTheArctangentSays) {
  const PostJoint scene = post_joint(vary(), side());
  const MotionLimit limit = RangeOfMotion(scene.joint).limit(motion());
  EXPECT_EQ(limit.end.reason, LimitReason::contact);
  EXPECT_NEAR(limit.end.turned.radians(), scene.limit, angle_tolerance);
  EXPECT_LE(limit.end.error_bound.radians(), 4e-12);
}

TEST_P(EachAngle, TheOtherWayRoundIsAFullTurnLess) {
  const PostJoint scene = post_joint(vary(), side());
  Motion other = motion();
  other.sense = RotationSense::negative, other.range = Angle::radians(two_pi);
  EXPECT_NEAR(RangeOfMotion(scene.joint).limit(other).end.turned.radians(), scene.limit_other_way,
              angle_tolerance);
}

TEST_P(EachAngle, AStartOnTheWayLeavesTheRest) {
  const PostJoint scene = post_joint(vary(), side());
  const Angle start = Angle::degrees(7);
  const MotionLimit limit = RangeOfMotion(scene.joint).limit(motion(turned_by({}, vary(), start)));
  EXPECT_NEAR(limit.end.turned.radians(), scene.limit - start.radians(), angle_tolerance);
  EXPECT_NEAR(angle_of(limit.angles_at_limit(), vary()).radians(), scene.limit, angle_tolerance);
}

TEST_P(EachAngle, ARangeThatEndsBeforeContactSaysSo) {
  const PostJoint scene = post_joint(vary(), side());
  Motion shorter = motion();
  shorter.range = Angle::radians(scene.limit - 1e-9);
  const MotionLimit limit = RangeOfMotion(scene.joint).limit(shorter);
  EXPECT_EQ(limit.end.reason, LimitReason::end_of_range);
  EXPECT_EQ(limit.end.turned, shorter.range);
  EXPECT_FALSE(limit.end.contact);
}

TEST_P(EachAngle, AnglesHeldBesidesCarryTheAxisWithThem) {
  // Whatever the other angles are, rotating F as they turn the axis' own body leaves the scene as it was: F by
  // all rotations before the varied one, M by the inverse of those after it.
  const PostJoint scene = post_joint(vary(), side());
  const JointAngles held = [&] {
    JointAngles all{Angle::degrees(40), Angle::degrees(-25), Angle::degrees(15)};
    return turned_by(all, vary(), -angle_of(all, vary()));
  }();
  JointAngles before{}, after{};
  switch (vary()) {
    case JointAngle::flexion:
      after = held;
      break;
    case JointAngle::adduction:
      before.flexion = held.flexion, after.internal_rotation = held.internal_rotation;
      break;
    case JointAngle::internal_rotation:
      before = held;
      break;
  }
  Joint carried = scene.joint;
  carried.fixed.mesh = posed(pose_at({.side = side()}, before), carried.fixed.mesh);
  carried.mobile.mesh = posed(pose_at({.side = side()}, after).inverse(), carried.mobile.mesh);
  const RangeOptions accept{.bearing = {}, .overlap = {.reference_contact = ReferenceContact::accept}};
  EXPECT_NEAR(RangeOfMotion(carried, accept).limit(motion(held)).end.turned.radians(), scene.limit, 1e-11);
}

TEST_P(EachAngle, ExchangingTheBodiesNegatesAndAgrees) {
  const Joint joint = bumpy_joint(side());
  Joint exchanged = joint;
  std::swap(exchanged.fixed, exchanged.mobile);
  Motion one = motion(), other = motion();
  other.sense = RotationSense::negative;
  const RangeOptions all{.bearing = {.rule = BearingRule::count}, .overlap = {}};
  const MotionLimit a = RangeOfMotion(joint, all).limit(one), b = RangeOfMotion(exchanged, all).limit(other);
  ASSERT_EQ(a.end.reason, LimitReason::contact);
  EXPECT_EQ(b.end.reason, a.end.reason);
  EXPECT_NEAR(a.end.turned.radians(), b.end.turned.radians(), 1e-11);
  EXPECT_EQ(a.end.contact->fixed_feature, b.end.contact->mobile_feature);
  EXPECT_EQ(a.end.contact->mobile_feature, b.end.contact->fixed_feature);
}

TEST_P(EachAngle, ContactPointsAreOnePlaceSeenFromBothBodies) {
  const MotionLimit limit = RangeOfMotion(bumpy_joint(side())).limit(motion({Angle::degrees(5), {}, {}}));
  ASSERT_TRUE(limit.end.contact);
  const Vec3 seen_from_F =
      pose_at({.side = side()}, limit.angles_at_limit()) * limit.end.contact->mobile_point;
  // 40 mm away at most, short of contact by up to 4e-12, some ten roundings.
  EXPECT_LT((seen_from_F - limit.end.contact->fixed_point).norm(), 40 * 5e-12);
}

TEST(RangeOfMotion, AMirroredLeftJointTurnsAsFar) {
  const Joint right = bumpy_joint(Side::right), left = mirrored(right);
  const auto motions = hip_motions();
  const auto one = RangeOfMotion(right).limits(motions), other = RangeOfMotion(left).limits(motions);
  for (std::size_t i = 0; i < motions.size(); ++i) {
    EXPECT_EQ(one[i].end.reason, other[i].end.reason) << motions[i].name;
    EXPECT_NEAR(one[i].end.turned.radians(), other[i].end.turned.radians(), 1e-11) << motions[i].name;
  }
}

TEST(RangeOfMotion, SharedTablesAndManyThreadsGiveTheBytesOfFreshOnes) {
  const Joint joint = bumpy_joint(Side::right);
  const auto motions = hip_motions();
  const RangeOfMotion shared(joint);
  const auto many = shared.limits(motions);
  const core::ThreadLimit one_thread(1);
  const auto again = shared.limits(motions);
  ASSERT_EQ(many.size(), motions.size());
  std::size_t contacts = 0;
  for (std::size_t i = 0; i < motions.size(); ++i) {
    expect_same_end(many[i], again[i]);
    expect_same_end(many[i], RangeOfMotion(joint).limit(motions[i]));
    contacts += many[i].end.reason == LimitReason::contact;
  }
  EXPECT_GT(contacts, 4u);
}

TEST(RangeOfMotion, BodiesInContactInTheReferencePoseAreRefusedWithTheDeepestVertexAndWhatCanBeDone) {
  const Joint joint = overlapping_joint();
  try {
    const RangeOfMotion refused(joint);
    FAIL() << "accepted";
  } catch (const ReferenceContactError& error) {
    const std::string text = error.what();
    for (const char* part : {"arm and post are in contact in the reference pose", "arm vertex",
                             "1 mm inside post", "leave out", "accept"})
      EXPECT_NE(text.find(part), std::string::npos) << part << " is not in: " << text;
    EXPECT_EQ(text.find('\n'), std::string::npos);
  }
}

TEST(RangeOfMotion, ContactInTheReferencePoseCanBeAcceptedAndIsThenReported) {
  const RangeOfMotion range(overlapping_joint(),
                            {.overlap = {.reference_contact = ReferenceContact::accept}});
  const MotionLimit limit = range.limit(hip_motions().front());
  EXPECT_EQ(limit.end.reason, LimitReason::contact_at_start);
  EXPECT_EQ(limit.end.turned, Angle());
  EXPECT_TRUE(limit.end.contact);
}

TEST(RangeOfMotion, ContactsInTheReferencePoseCanBeLeftOut) {
  const OverlapOptions options{.leave_out_reference_contacts = LeaveOutReferenceContacts{.rings = 1}};
  const RangeOfMotion range(ball_and_post_joint(), {.overlap = options});
  EXPECT_GT(range.left_out().fixed_triangles, 0u);
  EXPECT_GT(range.left_out().mobile_triangles, 0u);
  const MotionLimit limit = range.limit(hip_motions().front());
  EXPECT_EQ(limit.end.reason, LimitReason::contact);
  EXPECT_NEAR(limit.end.turned.radians(), post_limit(), angle_tolerance);
  // Features carry the numbers of the whole mesh: the point lies on the named fixed edge or its faces.
  EXPECT_NEAR(limit.end.contact->fixed_point.x(), post_x, 1e-9);
  EXPECT_NEAR(limit.end.contact->fixed_point.y(), post_y, 1e-9);
}

TEST(HipMotions, HaveTheNamesThatCliniciansUse) {
  std::vector<std::string> names;
  for (const Motion& motion : hip_motions()) {
    names.push_back(motion.name);
    EXPECT_NO_THROW(check_motion(motion, JointKind::ball));
  }
  EXPECT_EQ(names,
            (std::vector<std::string>{"flexion", "extension", "abduction", "adduction", "internal_rotation",
                                      "external_rotation", "abduction_at_90_flexion",
                                      "adduction_at_90_flexion", "internal_rotation_at_90_flexion",
                                      "external_rotation_at_90_flexion", "fadir", "faber"}));
}

TEST(HipMotions, OwnOnesReplaceThoseOfTheirNameAndFollowTheRest) {
  Motion own = hip_motions().front(), fadir = hip_motions()[10];
  own.name = "kick", fadir.start.adduction = Angle::degrees(30);
  const std::vector<Motion> given{own, fadir};
  const auto all = with_own_motions(hip_motions(), given);
  ASSERT_EQ(all.size(), 13u);
  EXPECT_EQ(all.back().name, "kick");
  EXPECT_EQ(motion_named(all, "fadir").start.adduction, Angle::degrees(30));
}

TEST(HipMotions, UnknownNamesAreRefusedWithThoseThereAre) {
  try {
    motion_named(hip_motions(), "flexoin");
    FAIL();
  } catch (const UsageError& error) {
    EXPECT_NE(std::string(error.what())
                  .find("\"flexoin\" (did you mean \"flexion\"?); there are flexion, extension"),
              std::string::npos);
  }
}

TEST(HipMotions, AreFoundInAnyCaseButFirstAsWritten) {
  const auto motions = hip_motions();
  EXPECT_EQ(motion_named(motions, "FADIR").name, "fadir");
  EXPECT_EQ(motion_named(motions, "Internal rotation at 90 flexion").name, "internal_rotation_at_90_flexion");
  Motion own = motions.front();
  own.name = "FADIR";
  const auto all = with_own_motions(motions, std::vector{own});
  EXPECT_EQ(motion_named(all, "FADIR").name, "FADIR");
  EXPECT_EQ(motion_named(all, "Fadir").name, "fadir");
}

TEST(HipMotions, ImpossibleOnesAreRefusedByName) {
  const Motion good = hip_motions()[4];
  const auto refused = [&](auto change, JointKind kind) {
    Motion bad = good;
    change(bad);
    EXPECT_THROW(check_motion(bad, kind), UsageError);
  };
  refused([](Motion& m) { m.range = Angle(); }, JointKind::ball);
  refused([](Motion& m) { m.range = Angle::degrees(-1); }, JointKind::ball);
  refused([](Motion& m) { m.range = Angle::degrees(361); }, JointKind::ball);
  refused([](Motion& m) { m.range = Angle::radians(std::nan("")); }, JointKind::ball);
  refused([](Motion& m) { m.start.adduction = Angle::radians(INFINITY); }, JointKind::ball);
  refused([](Motion&) {}, JointKind::hinge);
  refused([](Motion& m) { m.vary = JointAngle::flexion, m.start.adduction = Angle::degrees(1); },
          JointKind::hinge);
}

TEST(Motions, OfEveryJointAreInOrderAndNamedOnce) {
  for (const Anatomy joint : all_anatomies)
    for (const JointKind kind : {JointKind::ball, JointKind::free, JointKind::hinge}) {
      std::set<std::string> names;
      for (const Motion& motion : built_in_motions(kind, joint)) {
        EXPECT_NO_THROW(check_motion(motion, kind)) << motion.name;
        EXPECT_TRUE(names.insert(motion.name).second) << motion.name;
      }
      EXPECT_EQ(names.contains("fadir"), joint == Anatomy::hip && kind != JointKind::hinge);
    }
}

TEST(Motions, OfAKneeGoByItsSigns) {
  const auto motions = built_in_motions(JointKind::free, Anatomy::knee);
  const Motion& flexion = motion_named(motions, "flexion");
  EXPECT_EQ(flexion.vary, JointAngle::flexion);
  EXPECT_EQ(flexion.sense, RotationSense::positive);
  EXPECT_EQ(motion_named(motions, "external_rotation_at_90_flexion").start.flexion, Angle::degrees(90));
}

/// Plane, elevation: to the side, forwards, backwards.
TEST(Motions, OfAShoulderElevateInPlanes) {
  const auto motions = built_in_motions(JointKind::ball, Anatomy::shoulder);
  for (const auto& [name, plane] : {std::pair("abduction", 0), {"flexion", 90}, {"extension", -90}}) {
    const Motion& motion = motion_named(motions, name);
    EXPECT_EQ(motion.vary, JointAngle::adduction);
    EXPECT_EQ(motion.start.flexion, Angle::degrees(plane));
  }
}

/// The pose of a shoulder's motion after `turned`.
Eigen::Matrix3d shoulder_pose(const char* name, Side side, double turned_deg) {
  const Motion motion = motion_named(built_in_motions(JointKind::ball, Anatomy::shoulder), name);
  const Angle by = Angle::degrees(turned_deg) * sign_of(motion.sense);
  return pose_at({Anatomy::shoulder, side}, turned_by(motion.start, motion.vary, by)).linear();
}

TEST(Motions, OfAShoulderBeginWithTheArmAsItHangs) {
  const Vec3 x = Vec3::UnitX(), y = Vec3::UnitY(), z = Vec3::UnitZ();
  const std::array from_hanging{"abduction", "flexion", "extension", "internal_rotation",
                                "external_rotation"};
  const std::array from_abduction{"horizontal_flexion", "horizontal_extension",
                                  "internal_rotation_at_90_abduction", "external_rotation_at_90_abduction"};
  for (const Side side : {Side::right, Side::left}) {
    const double right = side == Side::right ? 1 : -1;
    for (const char* name : from_hanging)
      EXPECT_EQ(shoulder_pose(name, side, 0), Eigen::Matrix3d::Identity()) << name;
    for (const char* name : from_abduction)
      EXPECT_EQ(shoulder_pose(name, side, 0), shoulder_pose("abduction", side, 90)) << name;
    // About one axis of the scapula each: the hand goes forwards, backwards, outwards.
    for (const double turned : {0.0, 20.0, 90.0, 135.0}) {
      const double rad = Angle::degrees(turned).radians();
      const auto expect_rotation = [&](const char* name, double sense, const Vec3& axis) {
        const Eigen::Matrix3d start = shoulder_pose(name, side, 0);
        const Eigen::Matrix3d expected = Eigen::AngleAxisd(sense * rad, axis) * start;
        EXPECT_LT((shoulder_pose(name, side, turned) - expected).cwiseAbs().maxCoeff(), 4e-16)
            << name << ' ' << turned;
      };
      expect_rotation("abduction", -right, x);
      expect_rotation("flexion", 1, z);
      expect_rotation("extension", -1, z);
      expect_rotation("internal_rotation", right, y);
      expect_rotation("external_rotation", -right, y);
      expect_rotation("horizontal_flexion", right, y);
      expect_rotation("horizontal_extension", -right, y);
    }
    const Vec3 thumb = x, hand = -y;
    EXPECT_EQ(shoulder_pose("flexion", side, 90) * thumb, y) << "up";
    EXPECT_EQ(shoulder_pose("flexion", side, 90) * hand, x) << "forwards";
    EXPECT_EQ(shoulder_pose("extension", side, 90) * hand, -x) << "backwards";
    EXPECT_EQ(shoulder_pose("abduction", side, 90) * hand, right * z) << "outwards";
    EXPECT_EQ(shoulder_pose("horizontal_flexion", side, 90) * hand, x) << "forwards";
    EXPECT_EQ(shoulder_pose("external_rotation_at_90_abduction", side, 90) * thumb, y) << "up";
    EXPECT_EQ(shoulder_pose("internal_rotation", side, 90) * thumb, -right * z) << "to the midline";
  }
}

/// Each vertex nearer to the centre or farther, by up to a hundredth.
Points dented(const Points& vertices) {
  Points moved = vertices;
  for (std::size_t v = 0; v < moved.size(); ++v)
    moved.set(v, vertices[v] * (1 + 0.01 * std::sin(static_cast<double>(v))));
  return moved;
}

TEST(MovedVertices, LimitsAreThoseOfAJointMadeAnewInEveryBit) {
  const auto motions = hip_motions();
  for (const Side side : {Side::right, Side::left})
    for (const BodyRole role : {BodyRole::fixed, BodyRole::mobile}) {
      Joint joint = bumpy_joint(side);
      const RangeOfMotion before(joint);
      before.limits(motions);  // its tables are made
      Body& body = role == BodyRole::fixed ? joint.fixed : joint.mobile;
      body.mesh = body.mesh.moved_to(dented(body.mesh.vertices()));
      RangeOptions options{.bearing = {.roles = before.bearing().roles}};
      options.overlap.reference_contact = ReferenceContact::accept;
      const auto anew = RangeOfMotion(joint, options).limits(motions);
      const auto shared = RangeOfMotion(before, role, body.mesh.vertices()).limits(motions);
      for (std::size_t i = 0; i < motions.size(); ++i) {
        EXPECT_EQ(anew[i].end.turned, shared[i].end.turned) << motions[i].name;
        EXPECT_EQ(anew[i].end.reason, shared[i].end.reason) << motions[i].name;
        // In contact at the start any pair that meets is named: the one that the tree has first.
        if (anew[i].end.reason != LimitReason::contact_at_start) expect_same_end(anew[i], shared[i]);
      }
    }
}

// The centre of both bodies is moved: limits_about() moves the axes, which rounds otherwise.
TEST(MovedVertices, BothBodiesShiftedTurnAboutAnotherCentreAndTheirLigamentsWithThem) {
  Joint joint = bumpy_joint(Side::right);
  joint.ligaments = {{.name = "front",
                      .fixed = {{25, 10, 5}},
                      .mobile = {{25, -20, 5}},
                      .slack_length_mm = 30.6,
                      .ends_at_strain = 0.1}};
  const auto motions = hip_motions();
  const Vec3 centre(1.5, -2, 0.5);
  RangeOptions options{.bearing = {.rule = BearingRule::count}};
  const auto moved = RangeOfMotion(RangeOfMotion(joint, options), -centre, -centre).limits(motions);
  const auto about = limits_about(joint, motions, options, {&centre, 1});
  std::size_t by_ligament = 0;
  for (std::size_t i = 0; i < motions.size(); ++i) {
    EXPECT_NEAR(moved[i].end.turned.radians(), about[i].turned.radians(), 1e-8) << motions[i].name;
    EXPECT_EQ(moved[i].end.reason, about[i].reason) << motions[i].name;
    by_ligament += moved[i].end.reason == LimitReason::ligament;
  }
  EXPECT_GT(by_ligament, 0u);
  EXPECT_LT(by_ligament, motions.size());
}

}  // namespace
}  // namespace condyle::motion
