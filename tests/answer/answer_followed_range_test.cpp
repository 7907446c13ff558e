#include "condyle/answer.hpp"
#include "motion/joint_scenes.hpp"
#include "support/test.hpp"

/// The range of motion of a joint whose translation follows a recorded motion, or a load.

namespace condyle {
namespace {

using namespace test;

/// A ball with an arm in a cup with a post, cartilage on ball and cup.
struct BallInCup {
  BallInCup() {
    joint.kind = JointKind::free;
    joint.fixed = body("cup", joint.fixed.mesh, cup);
    joint.mobile = body("limb", joint.mobile.mesh, ball);
  }
  static Body body(const char* name, const TriMesh& bone, const TriMesh& cartilage) {
    return {name,
            joined(bone, cartilage),
            {{"bone", 0, bone.vertices.size(), 0, bone.triangles.size()},
             {"cartilage", bone.vertices.size(), cartilage.vertices.size(), bone.triangles.size(),
              cartilage.triangles.size(), PartContact::bearing}}};
  }

  static constexpr double thickness_mm = 1.5;
  const TriMesh ball = sphere({0, 0, 0}, 20, 5), cup = socket({0, 0, 0}, 20.5, 24, 5);
  const contact::ElasticContact layers{cup,
                                       ball,
                                       {.fixed = contact::ElasticLayer{12, 0.42, thickness_mm},
                                        .mobile = contact::ElasticLayer{12, 0.42, thickness_mm}}};
  const contact::Load up{.on_mobile = {Vec3(200, 800, 0), Vec3::Zero()}};
  Joint joint = post_joint(JointAngle::flexion, Side::right).joint;
};

RangeRequest request_of(const motion::Motion& motion, Follow follow) {
  RangeRequest request;
  request.motions = {motion};
  request.follow = std::move(follow);
  return request;
}

RangeAnswer answered_following(const Joint& joint, const RangeRequest& request) {
  return answer_range({joint}, request);
}

TEST(AnswerFollowedRange, PutsTheBodyWhereTheLoadIsCarried) {
  const BallInCup scene;
  const motion::Motion flexion = motion::hip_motions().front();
  const RangeAnswer answer = answered_following(
      scene.joint,
      request_of(flexion, FollowLoad{.layers = &scene.layers, .load = scene.up, .step = Angle::degrees(2)}));
  EXPECT_TRUE(answer.follows);
  const motion::MotionLimit& limit = answer.limits.front();
  ASSERT_EQ(limit.end.reason, motion::LimitReason::contact);
  ASSERT_TRUE(limit.translation_mm);
  // Balanced anew, from elsewhere, at the limit itself.
  const Pose start = pose_at(scene.joint.coordinates(), limit.angles_at_limit());
  const contact::BalancedPose balanced = contact::balance(scene.layers, start, scene.up);
  ASSERT_TRUE(balanced.carries_load());
  EXPECT_LT((balanced.X_FM.translation() - *limit.translation_mm).norm(), 0.01);
  // A ball's place hardly depends on its rotation, so the limit is that of the joint held there.
  const motion::RangeOfMotion held(held_at(scene.joint, balanced.X_FM.translation()));
  EXPECT_NEAR(limit.end.turned.degrees(), held.limit(flexion).end.turned.degrees(), 0.02);
  EXPECT_GT(std::abs(limit.end.turned.degrees() -
                     motion::RangeOfMotion(scene.joint).limit(flexion).end.turned.degrees()),
            0.25)
      << "the load moves the limit";
  ASSERT_EQ(answer.caveats.size(), 1u);
  EXPECT_NE(answer.caveats.front().find("bounded, not exact"), std::string::npos);
}

TEST(AnswerFollowedRange, SaysWhereNothingCarriesTheLoad) {
  const BallInCup scene;
  const contact::Load out{.on_mobile = {Vec3(0, -800, 0), Vec3::Zero()}};  // out of the cup
  const RangeAnswer answer = answered_following(
      scene.joint,
      request_of(motion::hip_motions().front(), FollowLoad{.layers = &scene.layers, .load = out}));
  EXPECT_EQ(answer.limits.front().end.reason, motion::LimitReason::end_of_range);
  EXPECT_EQ(answer.limits.front().motion.range, Angle());
  EXPECT_TRUE(answer.limits.front().translation_ends);
  EXPECT_FALSE(answer.limits.front().translation_mm);
  // The meshes of the scene are coarse, which is another note.
  const auto ends = std::find_if(answer.notes.begin(), answer.notes.end(), [](const RangeNote& note) {
    return note.code == RangeNoteCode::translation_ends;
  });
  ASSERT_NE(ends, answer.notes.end());
  EXPECT_NE(ends->text.find("no contact carries the load"), std::string::npos);
}

/// Frames of flexion from `first` to `last` degrees that move forwards by `mm_per_degree`, a second kept still at either end.
FollowRecord record(double first, double last, double mm_per_degree) {
  FollowRecord record;
  for (double at = first; at <= last; at += 0.5) {
    JointCoordinates frame{{Angle::degrees(at), Angle(), Angle()}, Vec3(mm_per_degree * at, 0, 0)};
    for (int copies = at == first || at + 0.5 > last ? 5 : 1; copies > 0; --copies)
      record.frames.push_back(frame);
  }
  return record;
}

TEST(AnswerFollowedRange, GoesWhereTheRecordedMotionGoes) {
  PostJoint post = post_joint(JointAngle::flexion, Side::right);
  post.joint.kind = JointKind::free;
  const motion::Motion flexion = motion::hip_motions().front();
  for (const double mm_per_degree : {-0.2, 0.0, 0.3}) {
    const RangeAnswer answer =
        answered_following(post.joint, request_of(flexion, record(-10, 60, mm_per_degree)));
    // The arm's front, moved forwards with the arm, meets the post's edge: x cos a - y' sin a = half its width in the arm's frame.
    double low = 0, high = 60;
    for (int i = 0; i < 60; ++i) {
      const double at = (low + high) / 2, a = at * std::numbers::pi / 180;
      const double x = post_x - mm_per_degree * at, y = post_y;
      (x * std::cos(a) + y * std::sin(a) > arm_half_width ? low : high) = at;
    }
    const motion::Limit& end = answer.limits.front().end;
    ASSERT_EQ(end.reason, motion::LimitReason::contact);
    EXPECT_LE(end.turned.degrees(), low + 1e-9);
    EXPECT_GE((end.turned + end.error_bound).degrees(), low - 1e-9);
    EXPECT_NEAR(answer.limits.front().translation_mm->x(), mm_per_degree * end.turned.degrees(), 1e-9);
    EXPECT_FALSE(answer.limits.front().translation_ends);
  }
  const RangeAnswer short_one = answered_following(post.joint, request_of(flexion, record(0, 12, 0.1)));
  EXPECT_NEAR(short_one.limits.front().end.turned.degrees(), 12, 1e-12);
  EXPECT_EQ(short_one.notes.front().code, RangeNoteCode::translation_ends);
  EXPECT_TRUE(short_one.limits.front().translation_ends);
}

TEST(AnswerFollowedRange, HoldsAKnownSocketWithItsBody) {
  Joint joint = BallInCup().joint;
  joint.fixed.head = Sphere{{1, 2, 3}, 20};
  EXPECT_EQ(held_at(joint, {5, 0, -1}).fixed.head->centre, Vec3(-4, 2, 4));
}

TEST(AnswerFollowedRange, ChoosesTheMotionsThatTheRecordLeadsAlong) {
  const std::vector<motion::Motion> all = motion::hip_motions();
  const auto names = [&](const FollowRecord& record) {
    std::string text;
    for (const motion::Motion& motion : motions_recorded(all, record)) text += motion.name + " ";
    return text;
  };
  EXPECT_EQ(names(record(-10, 60, 0.1)), "flexion extension ");
  EXPECT_EQ(names(record(0, 60, 0.1)), "flexion ");
  EXPECT_EQ(names(record(5, 60, 0.1)), "");
  EXPECT_EQ(names(record(-1e-7, 60, 0.1)), "flexion ") << "rounding is no motion";
  FollowRecord back = record(0, 30, 0.1);
  back.frames.push_back({{Angle::degrees(20), Angle(), Angle()}});
  EXPECT_EQ(names(back), "");
}

TEST(AnswerFollowedRange, IsRefusedWhereItMeansNothing) {
  PostJoint post = post_joint(JointAngle::flexion, Side::right);
  const BallInCup scene;
  const RangeRequest follows = request_of(motion::hip_motions().front(), record(0, 60, 0));
  const auto refusal = [&](const Joint& joint, const RangeRequest& request) {
    try {
      answered_following(joint, request);
    } catch (const UsageError& error) {
      return std::string(error.what());
    }
    return std::string("none");
  };
  EXPECT_NE(refusal(post.joint, follows).find("only the translation of a free joint"), std::string::npos);
  post.joint.kind = JointKind::free;
  RangeRequest with_bands = follows;
  with_bands.bands = BandRequest{};
  EXPECT_NE(refusal(post.joint, with_bands).find("limits only"), std::string::npos);
  RangeRequest held = follows;
  held.translation_mm = Vec3::Zero();
  EXPECT_NE(refusal(post.joint, held).find("one of the two"), std::string::npos);
  RangeRequest elsewhere = follows;
  elsewhere.motions = {motion::hip_motions()[1]};
  EXPECT_NE(refusal(post.joint, elsewhere).find("extension: the recorded angle"), std::string::npos);
  RangeRequest turning{
      .motions = follows.motions,
      .follow = FollowLoad{.layers = &scene.layers, .load = scene.up, .balance = {.free_rotations = true}}};
  EXPECT_NE(refusal(scene.joint, turning).find("rotations are held"), std::string::npos);
  turning.follow = FollowLoad{.load = scene.up};
  EXPECT_NE(refusal(scene.joint, turning).find("there are none"), std::string::npos);
}

}  // namespace
}  // namespace condyle
