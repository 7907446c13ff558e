#include "condyle/contact.hpp"
#include "condyle/range_of_motion.hpp"
#include "motion/joint_scenes.hpp"
#include "motion/motion_cases.hpp"
#include "support/test.hpp"

/// Limits of joints whose centre is not held: free before them and in contact after them, as exact tests of triangles at poses say.

namespace condyle::motion {
namespace {

using namespace test;

Joint random_joint(std::mt19937& random, TranslationFrame frame) {
  const auto body = [&](const char* name) {
    TriMesh mesh = random_box(random);
    for (int i = 0; i < 3; ++i) mesh = joined(mesh, random_box(random));
    return Body{name, mesh};
  };
  Joint joint{"scene", JointKind::free, Side::right, body("fixed"), body("mobile"), Anatomy::knee};
  joint.translation_frame = frame;
  return joint;
}

/// A few millimetres from one knot to the next, 7 degrees apart.
std::vector<TranslationKnot> random_knots(std::mt19937& random) {
  std::uniform_real_distribution<double> step(-4, 4);
  std::vector<TranslationKnot> knots{{Angle(), {step(random), step(random), step(random)}}};
  for (int degrees = 7; degrees <= 84; degrees += 7)
    knots.push_back({Angle::degrees(degrees),
                     knots.back().translation_mm + Vec3(step(random), step(random), step(random))});
  return knots;
}

NextKnot one_after_another(const std::vector<TranslationKnot>& knots) {
  return [&knots](std::span<const TranslationKnot> before) {
    return before.size() < knots.size() ? std::optional(knots[before.size()]) : std::nullopt;
  };
}

/// Where knots and angle bring the body, by the definition.
Pose pose_on(const Joint& joint, const Motion& motion, const std::vector<TranslationKnot>& knots,
             Angle turned) {
  std::size_t i = 1;
  while (i + 1 < knots.size() && knots[i].turned < turned) ++i;
  const TranslationKnot &a = knots[i - 1], &b = knots[i];
  const double share = (turned - a.turned).radians() / (b.turned - a.turned).radians();
  const Vec3 translation = (1 - share) * a.translation_mm + share * b.translation_mm;
  return pose_at(
      joint.coordinates(),
      JointCoordinates{turned_by(motion.start, motion.vary, turned * sign_of(motion.sense)), translation},
      joint.translation_frame);
}

TEST(FollowedRange, IsFreeBeforeItsLimitsAndInContactPastThem) {
  std::mt19937 random(9);
  int ended = 0, started = 0, passed = 0;
  for (int scene = 0; scene < 80; ++scene) {
    const Joint joint =
        random_joint(random, scene % 2 ? TranslationFrame::fixed : TranslationFrame::joint_axes);
    const std::vector<TranslationKnot> knots = random_knots(random);
    const FollowedRange range(joint);
    const contact::JointContact bodies(joint);
    for (Motion motion : built_in_motions(joint.kind, joint.anatomy)) {
      SCOPED_TRACE(std::to_string(scene) + " " + motion.name);
      const MotionLimit limit = range.limit(motion, one_after_another(knots))->limit;
      if (limit.end.reason == LimitReason::contact_at_start) {
        ++started;
        EXPECT_FALSE(bodies.pairs(pose_on(joint, motion, knots, Angle())).empty());
        continue;
      }
      EXPECT_LE(limit.end.turned, std::min(motion.range, Angle::degrees(84)));
      for (double share = 0; share < 1; share += 1.0 / 512)
        ASSERT_TRUE(bodies.pairs(pose_on(joint, motion, knots, limit.end.turned * share)).empty()) << share;
      if (limit.end.reason != LimitReason::contact) continue;
      ++ended;
      EXPECT_LE(limit.end.error_bound.degrees(), 0.064 + 1e-12);
      const Pose past = pose_on(joint, motion, knots, limit.end.turned + limit.end.error_bound);
      if (bodies.pairs(past).empty()) {
        // They pass each other so close that the search cannot go on.
        ++passed;
        EXPECT_EQ(limit.end.error_bound, Angle::degrees(1e-3));
      }
      const Pose X_FM = pose_on(joint, motion, knots, limit.end.turned);
      EXPECT_LT((posed(X_FM, limit.end.contact->mobile_point) - limit.end.contact->fixed_point).norm(), 0.01);
      EXPECT_LT((coordinates_at(joint.coordinates(), X_FM, joint.translation_frame).translation_mm -
                 *limit.translation_mm)
                    .norm(),
                1e-9);
    }
  }
  EXPECT_GT(ended, 100);
  EXPECT_GT(started, 5);
  EXPECT_LE(passed, 2);
}

TEST(FollowedRange, OfATranslationThatStaysIsThatOfTheHeldJoint) {
  std::mt19937 random(2);
  for (int scene = 0; scene < 20; ++scene) {
    const Joint joint = random_joint(random, TranslationFrame::fixed);
    const Vec3 held(3, -2, 1);
    const std::vector<TranslationKnot> knots{{Angle(), held}, {Angle::degrees(180), held}};
    RangeOptions accept;
    accept.overlap.reference_contact = ReferenceContact::accept;
    const RangeOfMotion exact(held_at(joint, held), accept);
    const FollowedRange range(joint);
    for (const Motion& motion : built_in_motions(joint.kind, joint.anatomy)) {
      const Limit expected = exact.limit(motion).end;
      const Limit end = range.limit(motion, one_after_another(knots))->limit.end;
      EXPECT_EQ(end.reason, expected.reason) << motion.name;
      EXPECT_LE(end.turned.radians(), expected.turned.radians() + 1e-12);
      EXPECT_GE((end.turned + end.error_bound).radians(), expected.turned.radians() - 1e-12) << motion.name;
    }
  }
}

TEST(FollowedRange, EndsWhereItsKnotsEnd) {
  PostJoint post = post_joint(JointAngle::flexion, Side::right);
  post.joint.kind = JointKind::free;
  const std::vector<TranslationKnot> knots{{Angle(), Vec3::Zero()}, {Angle::degrees(10), Vec3(0, 0, 1)}};
  const MotionLimit limit =
      FollowedRange(post.joint).limit(hip_motions().front(), one_after_another(knots))->limit;
  EXPECT_EQ(limit.end.reason, LimitReason::end_of_range);
  EXPECT_EQ(limit.end.turned, Angle::degrees(10));
  EXPECT_EQ(limit.motion.range, Angle::degrees(10));
  EXPECT_EQ(*limit.translation_mm, Vec3(0, 0, 1));
}

TEST(FollowedRange, RefusesKnotsThatDoNotAscendAndJointsThatDoNotTranslate) {
  PostJoint post = post_joint(JointAngle::flexion, Side::right);
  EXPECT_THROW(FollowedRange{post.joint}, UsageError);
  post.joint.kind = JointKind::free;
  const FollowedRange range(post.joint);
  const Motion flexion = hip_motions().front();
  using Knots = std::vector<TranslationKnot>;
  for (const Knots& knots :
       {Knots{{Angle::degrees(1), Vec3::Zero()}}, Knots{{Angle(), Vec3::Zero()}, {Angle(), Vec3::Zero()}},
        Knots{{Angle(), Vec3(0, std::nan(""), 0)}}})
    EXPECT_THROW(range.limit(flexion, one_after_another(knots)), UsageError);
  const Knots good{{Angle(), Vec3::Zero()}, {Angle::degrees(9), Vec3::Zero()}};
  EXPECT_THROW(range.limit(flexion, one_after_another(good), {}, Angle::degrees(1e-7)), UsageError);
}

TEST(FollowedRange, NotesWhatSlidesAndWhatIsSoft) {
  PostJoint post = post_joint(JointAngle::flexion, Side::right);
  Joint joint = post.joint;
  joint.kind = JointKind::free, joint.anatomy = Anatomy::knee;
  const TriMesh soft = box({5, -60, -1}, {6, -55, 1});
  const std::size_t vertices = joint.fixed.mesh.vertices().size(),
                    triangles = joint.fixed.mesh.triangles().size();
  joint.fixed.mesh = joined(joint.fixed.mesh, soft);
  joint.fixed.parts = {
      {"post", 0, vertices, 0, triangles},
      {"labrum", vertices, soft.vertices.size(), triangles, soft.triangles.size(), PartContact::soft}};
  Motion back = built_in_motions(joint.kind, joint.anatomy).front();
  back.sense = RotationSense::negative;  // a knee flexes the other way
  const std::vector<TranslationKnot> knots{{Angle(), Vec3::Zero()}, {Angle::degrees(180), Vec3::Zero()}};
  const MotionLimit limit = FollowedRange(joint).limit(back, one_after_another(knots))->limit;
  ASSERT_EQ(limit.end.reason, LimitReason::contact);
  ASSERT_TRUE(limit.end.soft_contact);
  const Limit exact = RangeOfMotion(joint).limit(back).end;
  EXPECT_NEAR(limit.end.soft_contact->turned.degrees(), exact.soft_contact->turned.degrees(), 0.01);
  EXPECT_NEAR(limit.end.turned.degrees(), exact.turned.degrees(), 0.01);
}

}  // namespace
}  // namespace condyle::motion
