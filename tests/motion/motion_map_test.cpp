#include "condyle/motion_map.hpp"

#include "condyle/contact.hpp"
#include "core/thread_limit.hpp"
#include "motion/joint_scenes.hpp"
#include "support/real_hip.hpp"
#include "support/test.hpp"

/// Maps against single limits, volumes against integrals.

namespace condyle::motion {
namespace {

using namespace test;

MapGrid small_grid() {
  return {.row = {JointAngle::flexion, -20, 40, 20}, .column = {JointAngle::adduction, -15, 15, 7.5}};
}

void expect_same_end(const Limit& a, const Limit& b) {
  EXPECT_EQ(a.turned, b.turned);
  EXPECT_EQ(a.reason, b.reason);
  EXPECT_EQ(a.kind(), b.kind());
  EXPECT_EQ(a.error_bound, b.error_bound);
  ASSERT_EQ(a.contact.has_value(), b.contact.has_value());
  if (!a.contact) return;
  EXPECT_EQ(a.contact->fixed_feature, b.contact->fixed_feature);
  EXPECT_EQ(a.contact->mobile_feature, b.contact->mobile_feature);
  EXPECT_EQ(a.contact->fixed_point, b.contact->fixed_point);
  EXPECT_EQ(a.contact->mobile_point, b.contact->mobile_point);
}

void expect_same_points(const MotionMap& a, const MotionMap& b) {
  ASSERT_EQ(a.points.size(), b.points.size());
  for (std::size_t i = 0; i < a.points.size(); ++i) {
    expect_same_end(a.points[i].from_start.negative, b.points[i].from_start.negative);
    expect_same_end(a.points[i].from_start.positive, b.points[i].from_start.positive);
  }
}

/// Two boxes that never meet.
Joint free_joint() {
  return {"free",
          JointKind::ball,
          Side::right,
          {"far", box({90, 90, 90}, {100, 100, 100})},
          {"near", box({-10, -10, -10}, {10, 10, 10})}};
}

/// Whether the joint without its bearing surface meets at a pose, exactly.
class ImpingesAt {
 public:
  explicit ImpingesAt(const Joint& joint)
      : coordinates_(joint.coordinates()), contact_(without_bearing(joint)) {}
  bool operator()(const JointAngles& angles) const {
    return contact_.in_contact(pose_at(coordinates_, angles));
  }

 private:
  static Joint without_bearing(Joint joint) {
    const auto surface = find_bearing_surface(joint).surface.value();
    TriMesh rest{joint.mobile.mesh.vertices(), {}};
    for (std::size_t t = 0; t < surface.triangles.size(); ++t)
      if (!surface.triangles[t]) rest.triangles.push_back(joint.mobile.mesh.triangles()[t]);
    joint.mobile.mesh = rest;
    return joint;
  }
  CoordinateSystem coordinates_;
  contact::JointContact contact_;
};

/// Most points of this map that are in contact at zero internal rotation are free a few degrees away.
TEST(MotionMap, OfARealHipHasWhatIsFreeBesideAStartInContactAndIslands) {
  FOUND_OR_SKIP(hip, hip_vhf_right());
  const Joint& joint = *hip;
  const MapGrid grid{.row = {JointAngle::adduction, -40, 30, 10},
                     .column = {JointAngle::flexion, -20, 120, 10},
                     .vary = JointAngle::internal_rotation};
  const MotionMap map = motion_map(grid, RangeOfMotion(joint));
  const ImpingesAt impinges(joint);
  std::size_t free_elsewhere = 0, islands = 0;
  for (std::size_t i = 0; i < map.points.size(); ++i) {
    const FreeAngles& point = map.points[i];
    const JointAngles start = grid.start_of(i).angles;
    EXPECT_EQ(impinges(start), !point.from_start.free_at_start()) << i;
    free_elsewhere += !point.from_start.free_at_start() && !point.intervals.empty();
    islands += point.intervals.size() > 1;
    for (const FreeInterval& free : point.intervals)
      EXPECT_FALSE(impinges(turned_by(start, grid.vary.angle(), (free.low + free.high) * 0.5))) << i;
  }
  EXPECT_GT(free_elsewhere, 0u);
  EXPECT_GT(islands, 0u);
}

TEST(GridAxis, CountsItsLastValueWhereStepsAreDecimal) {
  EXPECT_EQ((GridAxis{JointAngle::flexion, -20, 120, 1}.count()), 141u);
  EXPECT_EQ((GridAxis{JointAngle::flexion, 0, 1, 0.1}.count()), 11u);
  EXPECT_EQ((GridAxis{JointAngle::flexion, 0, 0.95, 0.1}.count()), 10u);
  EXPECT_EQ((GridAxis{JointAngle::flexion, 5, 5, 1}.count()), 1u);
}

TEST(MotionMap, HoldsTheLimitsOfEachPoint) {
  const RangeOfMotion joint(bumpy_joint(Side::right));
  const MotionMap map = motion_map(small_grid(), joint);
  std::size_t contacts = 0, starts = 0;
  for (std::size_t i = 0; i < map.points.size(); ++i) {
    const double flexion = -20 + 20 * static_cast<double>(i / 5),
                 adduction = -15 + 7.5 * static_cast<double>(i % 5);
    const Motion motion{"",
                        JointAngle::internal_rotation,
                        RotationSense::positive,
                        {Angle::degrees(flexion), Angle::degrees(adduction), Angle()},
                        Angle::degrees(180)};
    const MotionLimit limit = joint.limit(motion);
    EXPECT_EQ(map.points[i].from_start.positive.turned, limit.end.turned);
    EXPECT_EQ(map.points[i].from_start.positive.reason, limit.end.reason);
    contacts += limit.end.reason == LimitReason::contact;
    starts += !map.points[i].from_start.free_at_start();
  }
  EXPECT_GT(contacts, 5u);
  EXPECT_GT(starts, 0u);
}

TEST(MotionMap, GivesTheSameBytesOnOneThreadAndOnMany) {
  for (const JointAngle vary : {JointAngle::internal_rotation, JointAngle::adduction}) {
    const RangeOfMotion joint(bumpy_joint(Side::left));
    MapGrid grid = small_grid();
    grid.vary = vary;
    if (vary == JointAngle::adduction)
      grid.row = {JointAngle::internal_rotation, -10, 10, 5},
      grid.column = {JointAngle::flexion, -10, 20, 10};
    const MotionMap many = motion_map(grid, joint);
    const core::ThreadLimit single(1);
    const MotionMap one = motion_map(grid, joint);
    expect_same_points(many, one);
    EXPECT_EQ(many.work().node_pairs, one.work().node_pairs);
    EXPECT_GT(one.work().node_pairs, 0);
  }
}

TEST(MotionMap, ReportsEveryPointOnceInGrowingCounts) {
  std::size_t last_done = 0;
  const auto map = motion_map(small_grid(), RangeOfMotion(bumpy_joint(Side::right)),
                              {.progress = [&](std::string_view, std::size_t done, std::size_t total) {
                                EXPECT_EQ(done, ++last_done);
                                EXPECT_EQ(total, 20u);
                              }});
  EXPECT_TRUE(map);
  EXPECT_EQ(last_done, 20u);
}

TEST(MotionMap, StoppedBeforeItsLastPointIsNone) {
  const RangeOfMotion joint(bumpy_joint(Side::right));
  for (const std::size_t stop_at : {1u, 7u, 20u}) {
    std::stop_source stop;
    std::size_t last_done = 0;
    const core::ThreadLimit single(1);
    const auto map = motion_map(small_grid(), joint,
                                {.progress =
                                     [&](std::string_view, std::size_t done, std::size_t) {
                                       last_done = done;
                                       if (done == stop_at) stop.request_stop();
                                     },
                                 .stop = stop.get_token()});
    EXPECT_EQ(last_done, stop_at);
    EXPECT_EQ(map.has_value(), stop_at == 20);
  }
}

TEST(FreeVolume, OfAJointThatNeverTouchesIsThatOfTheBox) {
  const RangeOfMotion joint(free_joint());
  MapGrid grid{.row = {JointAngle::flexion, -30, 50, 2},
               .column = {JointAngle::adduction, -60, 90, 0.5},
               .range = {Angle::degrees(-40), Angle::degrees(70)}};
  const FreeVolume volume = free_volume(motion_map(grid, joint));
  EXPECT_NEAR(volume.plain_deg3, 80.0 * 150 * 110, 1e-6);
  const double deg = 180 / std::numbers::pi;
  const double exact = 80 * 110 * deg * (std::sin(90 / deg) - std::sin(-60 / deg));
  // Trapezoids of a cosine are short by h^2 / 12 of the integral, and by less than h^4 more.
  const double h = 0.5 / deg;
  EXPECT_NEAR(volume.weighted_deg3 / exact, 1 - h * h / 12, h * h * h * h);
  ASSERT_EQ(volume.row_area_deg2.size(), 41u);
  for (const double area : volume.row_area_deg2) EXPECT_NEAR(area, 150.0 * 110, 1e-8);
}

TEST(FreeVolume, WithAdductionVariedIntegratesTheCosineExactly) {
  const RangeOfMotion joint(free_joint());
  MapGrid grid{.row = {JointAngle::flexion, -30, 50, 20},
               .column = {JointAngle::internal_rotation, 0, 30, 10},
               .vary = JointAngle::adduction,
               .start = Angle::degrees(10),
               .range = {Angle::degrees(-40), Angle::degrees(50)}};
  const FreeVolume volume = free_volume(motion_map(grid, joint));
  const double deg = 180 / std::numbers::pi;
  EXPECT_NEAR(volume.weighted_deg3, 80.0 * 30 * deg * (std::sin(60 / deg) - std::sin(-30 / deg)), 1e-6);
  EXPECT_NEAR(volume.plain_deg3, 80.0 * 30 * 90, 1e-6);
}

TEST(FreeVolume, OfAllRotationsIsTheirInvariantMeasure) {
  const RangeOfMotion joint(free_joint());
  const MapGrid grid{.row = {JointAngle::flexion, -180, 180, 90},
                     .column = {JointAngle::internal_rotation, -180, 180, 90},
                     .vary = JointAngle::adduction,
                     .range = {Angle::degrees(-90), Angle::degrees(90)}};
  EXPECT_NEAR(free_volume(motion_map(grid, joint)).weighted_deg3, 360.0 * 360 * 360 / std::numbers::pi, 1e-6);
}

TEST(MotionMap, RefusesGridsThatMakeNoSenseBeforeAnyWork) {
  const auto refused = [](auto change, const char* why) {
    MapGrid grid = small_grid();
    change(grid);
    try {
      check_grid(grid, JointKind::ball);
      ADD_FAILURE() << "accepted: " << why;
    } catch (const UsageError& error) {
      EXPECT_NE(std::string(error.what()).find(why), std::string::npos) << error.what();
    }
  };
  refused([](MapGrid& g) { g.vary = JointAngle::flexion; }, "named twice");
  refused([](MapGrid& g) { g.column.coordinate = JointAngle::flexion; }, "named twice");
  refused([](MapGrid& g) { g.row.step = 0; }, "step");
  refused([](MapGrid& g) { g.row.last = -21; }, "ends before");
  refused([](MapGrid& g) { g.row.first = std::nan(""); }, "finite");
  refused([](MapGrid& g) { g.range = {Angle(), Angle()}; }, "empty");
  refused([](MapGrid& g) { g.range.positive = Angle::degrees(181); }, "half a turn");
  refused(
      [](MapGrid& g) {
        g.row = {JointAngle::flexion, 0, 99999, 1}, g.column = {JointAngle::adduction, 0, 9999, 1};
      },
      "1000000000");
  refused([](MapGrid& g) { g.row.step = 1e-300; }, "more than 10000000");
  refused([](MapGrid& g) { g.vary = MapCoordinate::translation(0); }, "only a free joint translates");
  EXPECT_THROW(check_grid(small_grid(), JointKind::hinge), UsageError);
}

}  // namespace
}  // namespace condyle::motion
