#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include <cmath>
#include <cstring>

#include "condyle/error.hpp"
#include "condyle/hip_measures.hpp"
#include "condyle/sample/hip.hpp"
#include "measure/analytic_hip.hpp"
#include "measure/displaced_bones.hpp"
#include "support/real_hip.hpp"

/// Bands of measures: in closed form, the same on any number of threads, and of as many joints as they say.

namespace condyle {
namespace {

using namespace test;

const Joint& some_hip() {
  static const Joint hip = [] {
    SampleHip bones = sample_hip({}, Scenario::two);
    return hip_of(std::move(bones.hip_bone), std::move(bones.femur));
  }();
  return hip;
}

const MeasureBand& band_of(const std::vector<MeasureBand>& bands, std::string_view key) {
  return bands[static_cast<std::size_t>(measure_definition(key) - measure_definitions().data())];
}

TEST(MeasureBands, WithoutUncertaintyEveryBandIsItsMeasure) {
  const Joint& hip = some_hip();
  const HipMeasures m = measure_hip(hip);
  const BandOptions none{.sigma = {.centre_mm = 0, .axes = Angle(), .surface_mm = 0}, .samples = 20};
  const auto bands = measure_bands(hip, {}, none);
  ASSERT_EQ(bands.size(), measure_definitions().size());
  for (std::size_t i = 0; i < bands.size(); ++i) {
    const Measure& measure = measure_definitions()[i].of(m);
    EXPECT_EQ(bands[i].samples_without_value, measure.value ? 0u : 20u);
    ASSERT_EQ(bands[i].median.has_value(), measure.value.has_value());
    if (!measure.value) continue;
    EXPECT_NEAR(*bands[i].p5, *measure.value, 1e-9) << measure_definitions()[i].key;
    EXPECT_NEAR(*bands[i].p95, *measure.value, 1e-9) << measure_definitions()[i].key;
  }
}

/// 5 to 95 % of a normal distribution of this deviation.
double width_of(double sigma) {
  return 2 * 1.6449 * sigma;
}

TEST(MeasureBands, AxesAndSurfacesMoveAnglesAndLengthsAsFarAsTheyAreUncertain) {
  const Joint& hip = some_hip();
  const auto width = [](const MeasureBand& band) { return *band.p95 - *band.p5; };
  const auto of_axes = measure_bands(
      hip, {}, {.sigma = {.centre_mm = 0, .axes = Angle::degrees(1), .surface_mm = 0}, .samples = 60});
  // About the one axis that is square to the opening and the vertical an inclination turns one to one. Of 60 samples a 5 % quantile
  // has a deviation of 0.27: twice that, of two of them.
  EXPECT_NEAR(width(band_of(of_axes, "acetabular_inclination_deg")), width_of(1), 0.76);
  // The femur's own angles do not turn with a frame, but for 12 o'clock without a shaft.
  EXPECT_LT(width(band_of(of_axes, "alpha_1_30_deg")), 0.02);
  EXPECT_LT(width(band_of(of_axes, "head_covered_share")), 1e-3);
  const auto of_surface =
      measure_bands(hip, {}, {.sigma = {.centre_mm = 0, .axes = Angle(), .surface_mm = 0.25}, .samples = 60});
  EXPECT_NEAR(width(band_of(of_surface, "head_radius_mm")), width_of(0.25), 0.1);
  EXPECT_NEAR(width(band_of(of_surface, "joint_space_median_mm")), width_of(std::sqrt(2) * 0.25), 0.27);
  // A rim that is rounded goes outwards with its surface.
  EXPECT_LT(width(band_of(of_surface, "acetabular_version_deg")), 0.2);
}

bool same_bits(const std::vector<MeasureBand>& a, const std::vector<MeasureBand>& b) {
  const auto same = [](const std::optional<double>& x, const std::optional<double>& y) {
    return x.has_value() == y.has_value() && (!x || std::memcmp(&*x, &*y, sizeof *x) == 0);
  };
  for (std::size_t i = 0; i < a.size(); ++i)
    if (!same(a[i].p5, b[i].p5) || !same(a[i].median, b[i].median) || !same(a[i].p95, b[i].p95) ||
        a[i].samples_without_value != b[i].samples_without_value)
      return false;
  return a.size() == b.size();
}

TEST(MeasureBands, OneThreadAndManyGiveTheSameBits) {
  const Joint& hip = some_hip();
  const BandOptions options{.samples = 20, .seed = 5};
  const auto many = measure_bands(hip, {}, options);
  const tbb::global_control one(tbb::global_control::max_allowed_parallelism, 1);
  EXPECT_TRUE(same_bits(many, measure_bands(hip, {}, options)));
}

TEST(MeasureBands, AStoppedBandIsEmptyAndProgressCounts) {
  const Joint& hip = some_hip();
  std::stop_source stop;
  std::size_t last = 0;
  Control control;
  control.progress = [&](std::size_t done, std::size_t total) {
    EXPECT_EQ(done, last + 1);
    EXPECT_EQ(total, 20u);
    last = done;
    if (done == 3) stop.request_stop();
  };
  control.stop = stop.get_token();
  EXPECT_FALSE(measure_bands(hip, {}, {.samples = 20}, control));
  EXPECT_LT(last, 20u);
  EXPECT_THROW(measure_bands(hip, {}, {.samples = 19}), UsageError);
}

TEST(MeasureBands, NineTenthsOfOtherDisplacedJointsLieInsideThem) {
  const auto hip = hip_vhf_right();
  if (!hip) GTEST_SKIP() << "no real hip in CONDYLE_DATA";
  const MeasureRequest request;
  const auto bands = measure_bands(*hip, request, {.samples = 60});
  const auto others = motion::displacements({.samples = 40, .seed = 2});
  const measure::DisplacedBones bones(*hip, request, {});
  double inside = 0, all = 0;
  for (const motion::Displacement& by : others) {
    const HipMeasures m = bones.measured(by);
    for (std::size_t i = 0; i < bands.size(); ++i) {
      const auto& value = measure_definitions()[i].of(m).value;
      if (!value) continue;
      ++all;
      inside += *value >= *bands[i].p5 && *value <= *bands[i].p95;
    }
  }
  EXPECT_GT(inside / all, 0.85);
  EXPECT_LT(inside / all, 0.95);
}

}  // namespace
}  // namespace condyle
