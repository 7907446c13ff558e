#include "condyle/limit_band.hpp"

#include "core/thread_limit.hpp"
#include "motion/joint_scenes.hpp"
#include "motion/motion_cases.hpp"
#include "motion/rom/displacement.hpp"
#include "support/real_hip.hpp"
#include "support/test.hpp"

/// Bands of limits: in closed form, the same on any number of threads, and those of an independent run on real hips.

namespace condyle::motion {
namespace {

using namespace test;

/// With the centre displaced in F, and in M by `arm_x` across the arm.
double post_limit_deg(const Vec3& centre, double arm_x) {
  const double x = post_x - centre.x(), y = post_y - centre.y(), front = arm_half_width - arm_x;
  return (std::atan2(x, -y) - std::asin(front / std::hypot(x, y))) * 180 / std::numbers::pi;
}

/// To first order the limit is normal with the gradient's length as its deviation; a millimetre is small here. With the
/// bodies known at an angle, a displacement d of the centre in F is R^-1 d in M.
void expect_band_of_the_centre(const LimitBand& band, Angle reference) {
  const double h = 1e-3, c = std::cos(reference.radians()), s = std::sin(reference.radians());
  const auto limit_at = [&](double dx, double dy) { return post_limit_deg({dx, dy, 0}, c * dx + s * dy); };
  const double gx = (limit_at(h, 0) - limit_at(-h, 0)) / (2 * h),
               gy = (limit_at(0, h) - limit_at(0, -h)) / (2 * h);
  const double sigma = std::hypot(gx, gy), limit = post_limit() * 180 / std::numbers::pi;
  // With 2000 samples an unstratified 5 % quantile has a deviation of 0.047 sigma, a median 0.028: twice that,
  // rounded.
  EXPECT_NEAR(band.median.degrees(), limit, 0.05 * sigma);
  EXPECT_NEAR(band.p5.degrees(), limit - 1.645 * sigma, 0.1 * sigma);
  EXPECT_NEAR(band.p95.degrees(), limit + 1.645 * sigma, 0.1 * sigma);
  EXPECT_EQ(band.width_from.centre, band.p95 - band.p5) << "nothing else is uncertain";
}

TEST(LimitBand, OfTheCentreIsThatOfTheClosedFormInAnyReferencePose) {
  const PostJoint scene = post_joint(JointAngle::flexion, Side::right);
  const std::vector<Motion> motions{flexion()};
  const BandOptions options{.sigma = {.centre_mm = 1, .axes = Angle(), .surface_mm = 0}, .samples = 2000};
  for (const double reference_deg : {0., 10., -35.}) {
    SCOPED_TRACE(reference_deg);
    RangeOptions range;
    range.overlap.reference_pose.flexion = Angle::degrees(reference_deg);
    const LimitBand band = limit_bands(scene.joint, motions, range, options).front();
    expect_band_of_the_centre(band, range.overlap.reference_pose.flexion);
    EXPECT_EQ(band.width_from.axes, Angle());
    EXPECT_EQ(band.width_from.surface, Angle());
    EXPECT_EQ(band.share_without_contact, 0);
  }
}

TEST(LimitBand, WithoutUncertaintyIsTheLimit) {
  for (const JointAngle vary : {JointAngle::flexion, JointAngle::adduction, JointAngle::internal_rotation}) {
    for (const Side side : {Side::right, Side::left}) {
      const PostJoint scene = post_joint(vary, side);
      const std::vector<Motion> motions{{"there", vary, RotationSense::positive, {}, Angle::degrees(180)},
                                        {"back", vary, RotationSense::negative, {}, Angle::radians(two_pi)},
                                        {"briefly", vary, RotationSense::positive, {}, Angle::degrees(5)}};
      const BandOptions options{.sigma = {.centre_mm = 0, .axes = Angle(), .surface_mm = 0}, .samples = 20};
      const auto bands = limit_bands(scene.joint, motions, {}, options);
      EXPECT_NEAR(bands[0].p5.radians(), scene.limit, 5e-12);
      EXPECT_NEAR(bands[0].p95.radians(), scene.limit, 5e-12);
      EXPECT_NEAR(bands[1].median.radians(), scene.limit_other_way, 5e-12);
      EXPECT_EQ(bands[2].median, Angle::degrees(5));
      EXPECT_EQ(bands[2].share_without_contact, 1);
    }
  }
}

TEST(LimitBand, IsTheSameBytesOnAnyNumberOfThreadsAndAnotherWithAnotherSeed) {
  const Joint joint = bumpy_joint(Side::right);
  const std::vector<Motion> motions = hip_motions();
  const auto bands = [&](std::uint64_t seed) {
    return limit_bands(joint, motions, {.bearing = {.rule = BearingRule::count}, .overlap = {}},
                       {.samples = 20, .seed = seed});
  };
  const auto many = bands(1), other = bands(2);
  const core::ThreadLimit one(1);
  const auto alone = bands(1);
  ASSERT_EQ(many.size(), motions.size());
  std::size_t different = 0;
  for (std::size_t i = 0; i < many.size(); ++i) {
    EXPECT_EQ(many[i].p5, alone[i].p5);
    EXPECT_EQ(many[i].median, alone[i].median);
    EXPECT_EQ(many[i].p95, alone[i].p95);
    EXPECT_EQ(many[i].turned, alone[i].turned);
    EXPECT_EQ(many[i].width_from.axes, alone[i].width_from.axes);
    different += many[i].median != other[i].median;
  }
  EXPECT_GE(different, 5u) << "of those that end by contact";
}

TEST(LimitBand, OfAJointWithABearingSurfaceIsTheSameBytesOnAnyNumberOfThreads) {
  const Joint joint = head_and_post_joint({0.1, -0.05, 0.15});
  ASSERT_TRUE(find_bearing_surface(joint).surface);
  const std::vector<Motion> motions = hip_motions();
  const auto bands_on = [&](std::size_t threads) {
    const core::ThreadLimit control(threads);
    return *limit_bands(joint, motions, {}, {.samples = 40, .seed = 3}, {});
  };
  const auto one = bands_on(1);
  ASSERT_EQ(one.size(), motions.size());
  std::size_t with_width = 0;
  for (const LimitBand& band : one) with_width += band.p5 < band.p95;
  EXPECT_GT(with_width, 0u);
  for (const std::size_t threads : {2, 7}) {
    const auto other = bands_on(threads);
    ASSERT_EQ(other.size(), one.size());
    for (std::size_t i = 0; i < one.size(); ++i) {
      SCOPED_TRACE(testing::Message() << motions[i].name << " on " << threads << " threads");
      EXPECT_EQ(other[i].p5, one[i].p5);
      EXPECT_EQ(other[i].median, one[i].median);
      EXPECT_EQ(other[i].p95, one[i].p95);
      EXPECT_EQ(other[i].width_from.centre, one[i].width_from.centre);
      EXPECT_EQ(other[i].width_from.axes, one[i].width_from.axes);
      EXPECT_EQ(other[i].width_from.surface, one[i].width_from.surface);
      EXPECT_EQ(other[i].share_without_contact, one[i].share_without_contact);
      EXPECT_EQ(other[i].share_in_contact_at_start, one[i].share_in_contact_at_start);
    }
  }
}

// The size of an implant is given; that of the bone beside it was measured.
TEST(LimitBand, OfAnImplantMovesTheSurfaceOfBoneOnly) {
  Joint joint = post_joint(JointAngle::flexion, Side::right).joint;
  const std::size_t half = joint.fixed.mesh.vertices().size(),
                    triangles = joint.fixed.mesh.triangles().size();
  joint.fixed.mesh = Mesh(joined(joint.fixed.mesh.arrays(),
                                 posed(Pose(Eigen::Translation3d(500, 0, 0)), joint.fixed.mesh.arrays())));
  joint.fixed.parts = {{"pelvis", 0, half, 0, triangles}, {"liner", half, half, triangles, triangles}};
  const auto moved_vertices = [&](std::size_t from) {
    const auto points = MovableSurface(joint, BodyRole::fixed, {.surface_mm = 0.5}).moved_by(1);
    std::size_t count = 0;
    for (std::size_t v = from; v < from + half; ++v) count += (*points)[v] != joint.fixed.mesh.vertices()[v];
    return count;
  };
  EXPECT_EQ(moved_vertices(half), half) << "a mesh called liner is no implant";
  joint.implant = JointImplant{"liner", ""};
  EXPECT_EQ(moved_vertices(0), half);
  EXPECT_EQ(moved_vertices(half), 0u);
  joint.fixed.parts[0].name = "neck";
  EXPECT_EQ(moved_vertices(half), half) << "without bone a deviation is that of the sizes";
}

TEST(LimitBand, RefusesWhatIsNoUncertainty) {
  const Joint joint = post_joint(JointAngle::flexion, Side::right).joint;
  const std::vector<Motion> motions{flexion()};
  const auto refused = [&](const BandOptions& options) {
    EXPECT_THROW(limit_bands(joint, motions, {}, options), UsageError);
  };
  refused({.samples = 19});
  refused({.sigma = {.centre_mm = -1}});
  refused({.sigma = {.axes = Angle::radians(std::nan(""))}});
  refused({.sigma = {.surface_mm = HUGE_VAL}});
}

TEST(LimitBand, EndsWhereItIsStopped) {
  std::stop_source stop;
  std::size_t seen = 0;
  const std::vector<Motion> motions{flexion()};
  const auto bands = limit_bands(post_joint(JointAngle::flexion, Side::right).joint, motions, {}, {},
                                 {.progress =
                                      [&](std::string_view, std::size_t done, std::size_t total) {
                                        EXPECT_EQ(done, ++seen);
                                        EXPECT_EQ(total, 800u);
                                        if (done == 3) stop.request_stop();
                                      },
                                  .stop = stop.get_token()});
  EXPECT_FALSE(bands);
  EXPECT_LT(seen, 800u);
}

/// Quantiles of 200 samples drawn by another generator, and the widths that each source alone gives.
struct ExpectedBand {
  double p5_deg, median_deg, p95_deg, centre_deg, axes_deg, surface_deg;
};
constexpr std::array<ExpectedBand, 12> vhf_bands{{{127.0, 133.7, 138.0, 10.1, 7.3, 5.0},
                                                  {68.0, 72.9, 79.5, 8.6, 8.0, 6.0},
                                                  {59.5, 61.3, 63.6, 4.0, 0.8, 2.6},
                                                  {37.4, 39.3, 41.3, 1.3, 3.5, 2.1},
                                                  {97.7, 102.7, 115.5, 16.0, 4.8, 8.3},
                                                  {50.9, 55.1, 60.8, 4.8, 7.5, 3.3},
                                                  {67.6, 75.2, 81.9, 13.0, 5.6, 6.0},
                                                  {49.8, 53.2, 56.4, 5.8, 4.0, 3.5},
                                                  {26.8, 32.5, 37.7, 10.5, 4.6, 5.1},
                                                  {104.6, 110.8, 116.3, 9.7, 6.9, 4.2},
                                                  {20.2, 26.0, 31.3, 10.5, 4.2, 5.1},
                                                  {85.8, 120.0, 120.0, 0.0, 30.7, 0.0}}};

TEST(RealHipBands, AgreeWithAnIndependentRun) {
  FOUND_OR_SKIP(hip, hip_vhf_right());
  const Joint& joint = *hip;
  const auto motions = hip_motions();
  // The quantiles of that run are of centre and axes: their widths are less than the surface alone would make them.
  const auto bands = limit_bands(joint, motions, {}, {.sigma = {.surface_mm = 0}});
  const auto surface = limit_bands(joint, motions, {}, {.sigma = {.centre_mm = 0, .axes = Angle()}});
  for (std::size_t i = 0; i < motions.size(); ++i) {
    SCOPED_TRACE(motions[i].name);
    const ExpectedBand& expected = vhf_bands[i];
    const auto near = [](Angle found, double expected_deg, double width_deg) {
      EXPECT_NEAR(found.degrees(), expected_deg, std::max(1.5, width_deg / 10));
    };
    const double width_deg = expected.p95_deg - expected.p5_deg;
    near(bands[i].p5, expected.p5_deg, width_deg);
    near(bands[i].median, expected.median_deg, width_deg);
    near(bands[i].p95, expected.p95_deg, width_deg);
    // The difference of two quantiles has twice the variance of one, of two runs.
    near(bands[i].width_from.centre, expected.centre_deg, 2 * expected.centre_deg);
    near(bands[i].width_from.axes, expected.axes_deg, 2 * expected.axes_deg);
    near(surface[i].width_from.surface, expected.surface_deg, 2 * expected.surface_deg);
  }
}

/// A quarter of a voxel of 2 mm is 0.5 mm: beside 1.2 mm of the segmentation 1.3.
TEST(MovableSurface, AddsTheGridsPartSquaredToThatOfAnOrigin) {
  Body body{"ball", Mesh(test::sphere(Vec3::Zero(), 10, 2))};
  body.image = BodyImage{2 * Eigen::Matrix3d::Identity(), {}};
  const auto moved_by = [&](const Uncertainty& sigma) {
    const Points moved = *MovableSurface(body, sigma).moved_by(1);
    double farthest = 0;
    for (Index v = 0; v < moved.size(); ++v)
      farthest = std::max(farthest, (moved[v] - body.mesh.vertices()[v]).norm());
    return farthest;
  };
  const double of_grid = moved_by({.surface_mm = 1.2}),
               of_both = moved_by({.surface_mm = 1.2, .surface_from = "ct"});
  EXPECT_GT(of_grid, 0.4);
  EXPECT_NEAR(of_both, std::hypot(of_grid, 1.2), 1e-12);
}

TEST(SurfaceOrigins, HaveASource) {
  for (const SurfaceOrigin& origin : surface_origins()) {
    EXPECT_GE(origin.sd_mm, 0);
    EXPECT_FALSE(origin.source.empty()) << origin.name;
  }
}

}  // namespace
}  // namespace condyle::motion
