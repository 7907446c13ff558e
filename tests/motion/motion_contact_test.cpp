#include "condyle/motion_contact.hpp"

#include "condyle/contact.hpp"
#include "support/cup.hpp"
#include "support/test.hpp"

/// Frames of a motion give the results of single poses.

namespace condyle::motion {
namespace {

using test::translated;

std::vector<std::optional<Pose>> lowered(std::initializer_list<double> by_mm) {
  std::vector<std::optional<Pose>> X_FM;
  for (const double y : by_mm) X_FM.emplace_back(translated({0, -y, 0}));
  return X_FM;
}

/// A ball of 24.8 mm in a cup of 25 mm is y - 0.2 deep once lowered by y.
TEST(MotionContact, FramesCountTheRaysThatTheReachCutsOff) {
  const TriMesh cup = test::cup(25, 4), ball = test::sphere(Vec3::Zero(), 24.8, 4);
  const contact::JointContact joint(cup, ball);
  const auto X_FM = lowered({0, 0.25, 0.35, 0.45, 0.6, 1.5, 5});
  for (const contact::Casting casting :
       {contact::Casting::fixed, contact::Casting::mobile, contact::Casting::both}) {
    const contact::ElasticContact surfaces(
        cup, ball, {.casting = casting, .rays = {.reach_mm = 0.2}, .fixed = test::layer_of_stiffness(1)});
    const auto frames = contact_along(joint, &surfaces, X_FM);
    std::size_t cut_off = 0;
    for (std::size_t i = 0; i < X_FM.size(); ++i) {
      EXPECT_EQ((*frames)[i]->cut_off_by_reach, surfaces.cut_off_by_reach(*X_FM[i])) << i;
      if ((*frames)[i]->cut_off_by_reach > 0) ++cut_off;
    }
    EXPECT_GE(cut_off, 2u);
    EXPECT_EQ((*frames)[1]->cut_off_by_reach, 0u) << "0.05 mm deep at most";
  }
  const contact::NormalDepth depths(cup, ball, {.reach_mm = 0.2});
  const auto frames = contact_along(joint, &depths, X_FM, BodyRole::fixed);
  for (std::size_t i = 0; i < X_FM.size(); ++i)
    EXPECT_EQ((*frames)[i]->cut_off_by_reach, depths.cut_off_by_reach(*X_FM[i])) << i;
}

/// Sheets bound nothing: one that is wholly past the other meets it nowhere, and its rays end beyond the reach.
TEST(MotionContact, ASheetWhollyBeyondTheReachIsCutOff) {
  const auto sheet = [](double half, const Vec3& normal) {
    TriMesh mesh;
    for (const auto& [x, z] : {std::pair{-1.0, -1.0}, {-1.0, 1.0}, {1.0, 1.0}, {1.0, -1.0}})
      mesh.vertices.push_back(Vec3(half * x, 0, half * z));
    mesh.triangles = {{0, 1, 2}, {0, 2, 3}};
    return normal.y() > 0 ? mesh : test::flipped(std::move(mesh));
  };
  const TriMesh floor = sheet(10, Vec3::UnitY()), plate = sheet(5, -Vec3::UnitY());
  const contact::JointContact joint(floor, plate);
  const contact::NormalDepth depths(plate, floor, {.reach_mm = 0.2});
  const auto frames = contact_along(joint, &depths, lowered({0.1, 0.3}));
  EXPECT_GT((*frames)[0]->surface.totals.area_mm2, 0);
  EXPECT_EQ((*frames)[0]->cut_off_by_reach, 0u);
  EXPECT_EQ((*frames)[1]->surface.totals.area_mm2, 0);
  EXPECT_GT((*frames)[1]->cut_off_by_reach, 0u);
}

/// A block on a plane carries 300 N at 0.5 mm: 100 mm^2 at 6 MPa per mm.
class BlockInBalance {
 public:
  /// Balanced pose of each frame, with its number of steps; no step if it started in balance.
  std::vector<contact::BalancedPose> along(std::span<const std::optional<Pose>> X_FM) const {
    std::vector<contact::BalancedPose> poses;
    const auto frames = balance_along(contact_, X_FM, std::span(&load_, 1), along_y_);
    for (const auto& frame : *frames) {
      if (!frame) continue;
      EXPECT_EQ(frame->outcome, contact::BalanceOutcome::balanced) << contact::reason_of(*frame);
      EXPECT_NEAR(frame->X_FM.translation().y(), -0.5, 1e-9);
      poses.push_back(*frame);
    }
    return poses;
  }

 private:
  const contact::ElasticContact contact_{
      test::box({-40, -10, -40}, {40, 0, 40}),
      test::box({-5, 0, -5}, {5, 5, 5}),
      {.casting = contact::Casting::mobile, .fixed = test::layer_of_stiffness(6)}};
  const contact::Load load_{.on_mobile = {.force_n = {0, -300, 0}}};
  const contact::BalanceOptions along_y_{.free_directions = {Vec3::UnitY()}};
};

TEST(MotionContact, ABalancedFrameStartsWhereTheLastOnesLead) {
  const BlockInBalance block;
  const auto steady = block.along(lowered({0.1, 0.15, 0.2, 0.25, 0.3}));
  ASSERT_EQ(steady.size(), 5u);
  EXPECT_GT(steady[0].steps, 0);
  EXPECT_GT(steady[1].steps, 0);
  for (std::size_t i = 2; i < 5; ++i) EXPECT_EQ(steady[i].steps, 0) << i;

  // A gap leads nowhere: the frame behind it starts as the last one before it was moved.
  auto with_gap = lowered({0.1, 0.1, 0.2, 0.3, 0.3});
  with_gap[2].reset();
  const auto after_gap = block.along(with_gap);
  ASSERT_EQ(after_gap.size(), 4u);
  EXPECT_EQ(after_gap[1].steps, 0);
  EXPECT_GT(after_gap[2].steps, 0);
  EXPECT_EQ(after_gap[3].steps, 0);
}

}  // namespace
}  // namespace condyle::motion
