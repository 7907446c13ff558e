#include "kinematics/hip_axes.hpp"
#include "support/test.hpp"

/// Axes and side of drawn hips: directions without bones, just beside each margin.

namespace condyle::kinematics {
namespace {

/// Components forwards, up and to the right of a right hip; a left one is its mirror image.
struct Frame {
  Vec3 anterior, superior, lateral;
  Vec3 operator()(double forwards, double up, double outwards) const {
    return forwards * anterior + up * superior + outwards * lateral;
  }
};

Frame frame_of(const FrameDirections& axes, Side side) {
  const Vec3 right = axes.anterior.cross(axes.superior);
  return {axes.anterior, axes.superior, side == Side::right ? right : Vec3(-right)};
}

struct Drawn {
  double neck_deg = 40;  ///< by which the socket opens in front of the neck, seen from above
  bool whole = true;     ///< both bones reach as far as they do in a whole hip
};

HipAnatomy drawn(const Frame& in, const Drawn& hip) {
  const double neck = (20 - hip.neck_deg) * std::numbers::pi / 180, socket = 20 * std::numbers::pi / 180;
  const double horizontal = std::sqrt(0.5);
  const double reach = hip.whole ? 150 : 60;
  HipAnatomy anatomy{};
  anatomy.head.fit.sphere = {Vec3::Zero(), 25};
  anatomy.towards_femur = in(0, -0.9, 0.3).normalized();
  anatomy.towards_pelvis = in(-0.2, 0.8, -0.5).normalized();
  anatomy.towards_neck = in(horizontal * std::sin(neck), -horizontal, horizontal * std::cos(neck));
  anatomy.opening = in(horizontal * std::sin(socket), -horizontal, horizontal * std::cos(socket));
  anatomy.femur_end = in(0, -reach, 0);
  anatomy.hip_bone_end = in(0, reach, 0);
  return anatomy;
}

HipAxes inferred(const FrameDirections& axes, Side side, const Drawn& hip = {},
                 const std::optional<Side>& given = {}) {
  return hip_axes(TriMesh{}, drawn(frame_of(axes, side), hip), given);
}

const FrameDirections joint_axes{};

TEST(HipAxes, OfADrawnHipAreInferredInAllAxesInUse) {
  for (const FrameDirections& axes : {ras_axes, lps_axes, joint_axes})
    for (const Side side : {Side::right, Side::left}) {
      const HipAxes found = inferred(axes, side);
      ASSERT_EQ(found.agreeing.size(), 1u) << found.why_none;
      EXPECT_EQ(found.agreeing[0].side, side);
      EXPECT_EQ(found.agreeing[0].axes->anterior(), axes.anterior);
      EXPECT_EQ(found.agreeing[0].axes->superior(), axes.superior);
      EXPECT_FALSE(found.evidence.empty());
    }
}

TEST(HipAxes, OfAnImageNeedANeckThirtyDegreesBehindTheSocketsOpening) {
  EXPECT_EQ(inferred(lps_axes, Side::left, {30.1}).agreeing.size(), 1u);
  const HipAxes neither = inferred(lps_axes, Side::left, {29.9});
  ASSERT_EQ(neither.agreeing.size(), 2u) << "a left hip in LPS, or a right one in RAS";
  EXPECT_NE(neither.agreeing[0].side, neither.agreeing[1].side);
  test::expect_says(neither.why_none, "more than one");
}

TEST(HipAxes, WithTheSideGivenOrInJointAxesNeedNoVoteForIt) {
  for (const double neck_deg : {10.0, 0.0, -5.0}) {
    const HipAxes given = inferred(lps_axes, Side::left, {neck_deg}, Side::left);
    ASSERT_EQ(given.agreeing.size(), 1u);
    EXPECT_EQ(given.agreeing[0].axes->anterior(), lps_axes.anterior);
    const HipAxes joint = inferred(joint_axes, Side::left, {neck_deg});
    ASSERT_EQ(joint.agreeing.size(), 1u);
    EXPECT_EQ(joint.agreeing[0].side, Side::left);
  }
}

TEST(HipAxes, AgainstWhichTheNeckVotesByHalfItsMarginAreNotInferred) {
  EXPECT_EQ(inferred(joint_axes, Side::right, {-14.9}).agreeing.size(), 1u);
  EXPECT_TRUE(inferred(joint_axes, Side::right, {-15.1}).agreeing.empty());
  EXPECT_EQ(inferred(ras_axes, Side::right, {14.9}, Side::left).agreeing.size(), 1u) << "LPS of a left hip";
  EXPECT_TRUE(inferred(ras_axes, Side::right, {15.1}, Side::left).agreeing.empty());
}

/// A hip that lies between two pairs of axes, as with a leg that hangs forwards in LPS: where both bones are long their far ends say which is up.
TEST(HipAxes, OfALegThatHangsForwardsAreInferredIfBothBonesAreLong) {
  for (const Side side : {Side::right, Side::left})
    for (const bool in_lps : {true, false})
      for (const bool whole : {true, false}) {
        const Frame in = frame_of(in_lps ? lps_axes : ras_axes, side);
        const double forwards = in_lps ? 1 : -1;  // Y of both is taken for down
        HipAnatomy hip = drawn(in, {});
        hip.towards_femur = in(0.3 * forwards, -0.85, 0.3).normalized();
        hip.towards_pelvis = in(-0.3 * forwards, 0.8, -0.5).normalized();
        const Vec3 far = in(0.4 * forwards, -0.65, 0.65).normalized(),
                   near = in(0.1 * forwards, -0.7, 0.7).normalized();
        hip.towards_neck = in_lps ? near : far;  // the socket opens in front of it
        hip.opening = in_lps ? far : near;
        if (!whole) hip.femur_end = in(0, -60, 0);
        const HipAxes found = hip_axes(TriMesh{}, hip, side);
        EXPECT_EQ(found.agreeing.size(), whole ? 1u : 0u) << found.why_none;
        EXPECT_EQ(found.why_none.find("nearly as much") != std::string::npos, !whole) << found.why_none;
      }
}

/// Down and outwards cannot be distinguished where both bones are cut short.
TEST(HipAxes, OfTwoShortPiecesAreNotInferred) {
  EXPECT_TRUE(inferred(joint_axes, Side::right, {40, false}).agreeing.empty());
}

TEST(HipAxes, ExchangedUpAndOutwardsAreNotInferred) {
  for (const Side side : {Side::right, Side::left}) {
    const Frame known = frame_of(joint_axes, side);
    const Frame exchanged{known.anterior, -known.lateral, -known.superior};
    EXPECT_TRUE(hip_axes(TriMesh{}, drawn(exchanged, {}), {}).agreeing.empty());
  }
}

TEST(HipAxes, OfAHipAQuarterOfATurnOffAreNotInferred) {
  for (const FrameDirections& axes : {ras_axes, lps_axes, joint_axes})
    for (const Side side : {Side::right, Side::left})
      for (const double sense : {1.0, -1.0}) {
        const Frame known = frame_of(axes, side);
        const Frame turned{sense * known.lateral, known.superior, -sense * known.anterior};
        EXPECT_TRUE(hip_axes(TriMesh{}, drawn(turned, {}), {}).agreeing.empty());
      }
}

TEST(HipAxes, WithoutNeckAndSocketAreNotInferred) {
  HipAnatomy hip = drawn(frame_of(joint_axes, Side::right), {});
  hip.towards_neck.reset();
  hip.opening.reset();
  EXPECT_TRUE(hip_axes(TriMesh{}, hip, {}).agreeing.empty());
}

}  // namespace
}  // namespace condyle::kinematics
