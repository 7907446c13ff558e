#include <cmath>

#include "condyle/answer.hpp"
#include "support/cup.hpp"
#include "support/test.hpp"

/// A block of 10 by 10 mm on a plane: 100 mm^2 at 6 MPa per mm.

namespace condyle::test {
namespace {

std::vector<std::string> codes(const std::vector<motion::ContactNote>& notes) {
  std::vector<std::string> found;
  for (const motion::ContactNote& note : notes) found.emplace_back(name_of(note.code));
  return found;
}

class Block : public ::testing::Test {
 protected:
  const TriMesh table = box({-40, -10, -40}, {40, 0, 40}), block = box({-5, 0, -5}, {5, 12, 5});
  const contact::ElasticContact layers{
      table, block, {.casting = contact::Casting::mobile, .mobile = layer_of_stiffness(6)}};
  const contact::JointContact bodies{table, block};
  const contact::Load down{.on_mobile = {.force_n = {0, -300, 0}}};
  const contact::BalanceOptions along_y{.free_directions = {Vec3::UnitY()}};

  std::vector<std::optional<Pose>> lowered(std::initializer_list<double> by_mm) const {
    std::vector<std::optional<Pose>> X_FM;
    for (const double y : by_mm) X_FM.emplace_back(translated({0, -y, 0}));
    return X_FM;
  }
};

using LoadAnswers = Block;
using MotionAnswers = Block;

TEST_F(LoadAnswers, AreOfThePoseRequestedWithoutALoad) {
  const LoadAnswer answer = answer_load(layers, {.X_FM = translated({0, -0.25, 0})});
  EXPECT_NEAR(answer.contact.on_mobile.force_n.y(), 150, 1e-9);
  EXPECT_FALSE(answer.balanced);
  EXPECT_TRUE(answer.carries_load());
  ASSERT_TRUE(answer.refined_force_n);
  EXPECT_NEAR(answer.refined_force_n->y(), 150, 1e-9);
  EXPECT_EQ(answer.cut_off_by_reach, layers.cut_off_by_reach(answer.X_FM));
}

TEST_F(LoadAnswers, AreOfTheBalancedPoseWithOne) {
  const LoadAnswer answer =
      answer_load(layers, {.X_FM = translated({0, -0.1, 0}), .load = down, .balance = along_y});
  ASSERT_TRUE(answer.balanced && answer.carries_load());
  EXPECT_NEAR(answer.X_FM.translation().y(), -0.5, 1e-9);
  EXPECT_NEAR(answer.refined_force_n->y(), 300, 1e-6);
}

TEST_F(LoadAnswers, ThatCarryNothingSayWhy) {
  const contact::Load up{.on_mobile = {.force_n = {0, 300, 0}}};
  const LoadAnswer answer = answer_load(layers, {.load = up, .balance = along_y});
  EXPECT_FALSE(answer.carries_load());
  EXPECT_EQ(answer.balanced->outcome, contact::BalanceOutcome::pulled_apart);
  EXPECT_FALSE(contact::reason_of(*answer.balanced).empty());
  EXPECT_FALSE(answer.refined_force_n);
}

// The block's corners turn about the table's Z axis through (20, 0, 0): of the one at (-5, -h) on a circle of radius r the table's top is passed
// by the angle between them, asin(h / r).
TEST_F(LoadAnswers, HaveDepthsAlongArcsWhereTheLoadIsCarried) {
  const LoadRequest request{.load = down,
                            .balance = along_y,
                            .about = contact::AxisLine{.direction = Vec3::UnitZ(), .point = {20, 0, 0}}};
  const LoadAnswer answer = answer_load(layers, request);
  ASSERT_TRUE(answer.arcs && answer.carries_load());
  const auto summary = contact::summarise(*answer.arcs->contact.mobile_in_fixed);
  EXPECT_EQ(summary.vertices_inside, 4u);
  const double h = -answer.X_FM.translation().y(), near = std::hypot(15, h);
  EXPECT_NEAR(summary.deepest->depth_mm, near * std::asin(h / near), 1e-9);
  EXPECT_NEAR(summary.largest_angle->depth.radians(), std::asin(h / near), 1e-9);
  LoadRequest flexion = request;
  flexion.about = JointAngle::flexion;
  EXPECT_THROW(answer_load(layers, flexion), UsageError) << "the block's centre is not the table's";
}

TEST_F(LoadAnswers, NoteLayersLoadAndContactOnce) {
  const contact::ElasticContact stiff(
      table, block, {.casting = contact::Casting::mobile, .mobile = contact::ElasticLayer{6e9, 0.45, 1.0}});
  const contact::Load heavy{.on_mobile = {.force_n = {0, -1e6, 0}}};
  const LoadAnswer answer =
      answer_load(stiff, {.X_FM = translated({0, -0.01, 0}), .load = heavy, .balance = along_y});
  EXPECT_EQ(codes(answer.notes), (std::vector<std::string>{"unlikely_modulus", "unlikely_load"}));
}

TEST_F(LoadAnswers, RefuseAMomentThatNothingBalances) {
  const contact::Load turning{.on_mobile = {.force_n = {0, -300, 0}, .moment_nmm = {1, 0, 0}}};
  EXPECT_THROW(answer_load(layers, {.load = turning}), UsageError);
  check_load_request({.load = turning, .balance = {.free_rotations = true}});
}

TEST_F(MotionAnswers, AreThoseOfEachFrame) {
  auto X_FM = lowered({0.25, 0.1, 0.5});
  X_FM.insert(X_FM.begin() + 1, std::nullopt);
  const MotionAnswer answer = answer_motion(bodies, &layers, {.X_FM = X_FM});
  const auto expected = motion::contact_along(bodies, &layers, X_FM);
  ASSERT_EQ(answer.frames.size(), 4u);
  for (std::size_t i = 0; i < 4; ++i) {
    ASSERT_EQ(answer.frames[i].has_value(), X_FM[i].has_value());
    if (answer.frames[i]) {
      EXPECT_EQ(answer.frames[i]->on_mobile.force_n, (*expected)[i]->on_mobile.force_n);
    }
  }
  EXPECT_EQ(frame_of_largest_force(answer), 3u);
  ASSERT_TRUE(answer.refined_largest_force_n);
  EXPECT_NEAR(*answer.refined_largest_force_n, 300, 1e-9);
  EXPECT_FALSE(answer.between) << "times are not known";
}

TEST_F(MotionAnswers, WithoutLayersHaveTheDepthsOfTheBodyThatCasts) {
  const auto X_FM = lowered({0.25, 0.5});
  for (const BodyRole casting : {BodyRole::fixed, BodyRole::mobile}) {
    const bool fixed_casts = casting == BodyRole::fixed;
    const contact::NormalDepth depths(fixed_casts ? table : block, fixed_casts ? block : table,
                                      {contact::FaceRule::cut_faces, 3});
    const auto expected = motion::contact_along(bodies, &depths, X_FM, casting);
    const MotionAnswer answer = answer_motion(
        bodies, nullptr, {.X_FM = X_FM, .casting = casting, .rays = {contact::FaceRule::cut_faces, 3}});
    for (std::size_t i = 0; i < X_FM.size(); ++i) {
      EXPECT_EQ(answer.frames[i]->surface.totals.area_mm2, (*expected)[i]->surface.totals.area_mm2);
      // No ray of the table, which has two large triangles, meets the block.
      EXPECT_NEAR(answer.frames[i]->surface.totals.max_depth_mm,
                  fixed_casts ? 0
                  : i == 0    ? 0.25
                              : 0.5,
                  1e-12);
    }
    EXPECT_TRUE(answer.caveats.empty() && !answer.refined_largest_force_n);
  }
}

TEST_F(MotionAnswers, NoteLayersAndLoadsBeforeTheirFrames) {
  const contact::ElasticContact stiff(
      table, block, {.casting = contact::Casting::mobile, .mobile = contact::ElasticLayer{6e9, 0.45, 1.0}});
  const contact::Load heavy{.on_mobile = {.force_n = {0, -1e6, 0}}};
  const MotionRequest request{.X_FM = lowered({0.01}), .loads = {heavy}, .balance = along_y};
  const auto before = codes(motion_request_notes(&stiff, request));
  EXPECT_EQ(before, (std::vector<std::string>{"unlikely_modulus", "unlikely_load"}));
  const auto all = codes(answer_motion(bodies, &stiff, request).notes);
  EXPECT_EQ(std::vector<std::string>(all.begin(), all.begin() + 2), before);
}

TEST_F(MotionAnswers, CarryTheSameLoadInEveryFrame) {
  const MotionAnswer answer = answer_motion(
      bodies, &layers, {.X_FM = lowered({0.1, 0.7}), .time_s = {0, 1}, .load = down, .balance = along_y});
  ASSERT_EQ(answer.balanced.size(), 2u);
  for (const auto& frame : answer.frames) EXPECT_NEAR(frame->X_FM.translation().y(), -0.5, 1e-9);
  EXPECT_FALSE(answer.between) << "balanced poses are not as recorded";
}

TEST_F(MotionAnswers, LeaveOutFramesWithoutALoadOfTheirOwn) {
  const contact::Load none{}, up{.on_mobile = {.force_n = {0, 300, 0}}};
  const MotionAnswer answer = answer_motion(
      bodies, &layers,
      {.X_FM = lowered({0.1, 0.2, 0.3, 0.4}), .loads = {down, none, std::nullopt, up}, .balance = along_y});
  EXPECT_TRUE(answer.frames[0]);
  EXPECT_FALSE(answer.frames[1] || answer.frames[2] || answer.frames[3]);
  EXPECT_EQ(answer.without_load, std::vector<std::size_t>{1});
  EXPECT_FALSE(answer.balanced[1] || answer.balanced[2]);
  ASSERT_TRUE(answer.balanced[3]);
  EXPECT_FALSE(answer.balanced[3]->carries_load());
}

TEST_F(MotionAnswers, SearchBetweenFramesAsRequested) {
  std::vector<std::optional<Pose>> turning;
  for (const double degrees : {0.0, 20.0})
    turning.emplace_back(Pose(Eigen::AngleAxisd(Angle::degrees(degrees).radians(), Vec3::UnitY())));
  const auto between = [&](const std::vector<std::optional<Pose>>& X_FM, BetweenFrames how) {
    return answer_motion(bodies, &layers, {.X_FM = X_FM, .time_s = {0, 0.1}, .between = how})
        .between.has_value();
  };
  EXPECT_TRUE(between(turning, BetweenFrames::if_exact)) << "the centre is held";
  EXPECT_FALSE(between(turning, BetweenFrames::never));
  EXPECT_FALSE(between(lowered({-1, -2}), BetweenFrames::if_exact));
  EXPECT_TRUE(between(lowered({-1, -2}), BetweenFrames::always));
}

TEST_F(MotionAnswers, NumberSamplesBehindAGapAsTheFrames) {
  // Apart, a gap, and from 2 mm above the table down into it.
  auto X_FM = lowered({-3, -2, 1});
  X_FM.insert(X_FM.begin() + 1, std::nullopt);
  const MotionAnswer answer = answer_motion(
      bodies, &layers, {.X_FM = X_FM, .time_s = {0, 1, 2, 3}, .between = BetweenFrames::always});
  ASSERT_EQ(answer.between->contacts.size(), 1u);
  const motion::ContactEnd& entry = answer.between->contacts[0].entry;
  EXPECT_EQ(entry.sample, 2u);
  EXPECT_LE(entry.time_s, 2 + 2.0 / 3);
  EXPECT_GE(entry.time_s + entry.uncertainty_s, 2 + 2.0 / 3);
}

TEST_F(MotionAnswers, AreEmptyOnceStopped) {
  std::stop_source stop;
  std::vector<std::string> stages;
  const Control control{[&](std::string_view stage, std::size_t, std::size_t) {
                          if (stages.empty() || stages.back() != stage) stages.emplace_back(stage);
                          stop.request_stop();
                        },
                        stop.get_token()};
  EXPECT_FALSE(answer_motion(bodies, &layers,
                             {.X_FM = std::vector<std::optional<Pose>>(200, translated({0, -0.2, 0})),
                              .load = down,
                              .balance = along_y},
                             control));
  EXPECT_EQ(stages, std::vector<std::string>{"balanced frames"});
}

TEST_F(MotionAnswers, RefuseWhatContradictsItself) {
  const auto refused = [&](const MotionRequest& request) {
    EXPECT_THROW(answer_motion(bodies, &layers, request), UsageError);
  };
  refused({.X_FM = lowered({0.1, 0.2}), .time_s = {0}});
  refused({.X_FM = lowered({0.1, 0.2}), .loads = {down}, .balance = along_y});
  refused({.X_FM = lowered({0.1}), .load = down, .loads = {down}, .balance = along_y});
  refused({.X_FM = lowered({0.1}), .between = BetweenFrames::always});
  refused({.X_FM = lowered({0.1, 0.2}), .time_s = {0, 1}, .load = down, .between = BetweenFrames::always});
  refused({.X_FM = lowered({0.1}),
           .load = contact::Load{.on_mobile = {.force_n = {0, -1, 0}, .moment_nmm = {1, 0, 0}}}});
  EXPECT_THROW(answer_motion(bodies, nullptr, {.X_FM = lowered({0.1}), .load = down}), UsageError)
      << "no layers";
}

}  // namespace
}  // namespace condyle::test
