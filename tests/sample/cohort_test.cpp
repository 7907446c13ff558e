#include "condyle/sample/hip.hpp"
#include "sample/parameter_checks.hpp"
#include "support/test.hpp"

namespace condyle::test {
namespace {

constexpr std::uint64_t many = 4000;

TEST(SampleCohort, HasHipsWhoseMeasuresAreWithinTheirRanges) {
  for (std::uint64_t k = 1; k <= many; ++k)
    EXPECT_NO_THROW(sample::require_valid(sample::cohort_hip(1, k).measures)) << k;
}

TEST(SampleCohort, IsTheSameForASeedAndAnotherForAnother) {
  for (std::uint64_t k = 1; k <= 50; ++k) {
    EXPECT_EQ(sample::cohort_hip(3, k).measures, sample::cohort_hip(3, k).measures);
    EXPECT_NE(sample::cohort_hip(3, k).measures, sample::cohort_hip(4, k).measures);
    EXPECT_NE(sample::cohort_hip(3, k).measures, sample::cohort_hip(3, k + 1).measures);
  }
}

/// Between the cut ends a normal distribution has a mean and a spread in closed form: with z the ends in standard deviations,
/// phi the density and P the share between them, mean = m + s (phi(a) - phi(b)) / P.
TEST(SampleCohort, HasMeasuresWithTheMeansOfTheirDistributions) {
  const auto density = [](double z) { return std::exp(-z * z / 2) / std::sqrt(2 * std::acos(-1)); };
  const auto below = [](double z) { return std::erfc(-z / std::sqrt(2.0)) / 2; };
  for (const sample::MeasureDistribution& d : sample::cohort_distributions()) {
    if (d.measure == "alpha_angle_deg" || d.unit == "head radii")
      continue;  // not what the hip has in the end
    const double a = (d.low - d.mean) / d.standard_deviation, b = (d.high - d.mean) / d.standard_deviation;
    const double mean = d.mean + d.standard_deviation * (density(a) - density(b)) / (below(b) - below(a));
    double sum = 0;
    for (std::uint64_t k = 1; k <= many; ++k)
      sum += *sample::hip_measure_named(d.measure)->value(sample::cohort_hip(1, k).measures);
    // Four standard errors of the mean, and what rounding to a tenth may shift.
    EXPECT_NEAR(sum / many, mean, 4 * d.standard_deviation / std::sqrt(double(many)) + 0.05) << d.measure;
  }
}

TEST(SampleCohort, SaysTheAlphaAngleThatTheFemurHas) {
  std::size_t cams = 0;
  for (std::uint64_t k = 1; k <= many; ++k) {
    const sample::CohortHip hip = sample::cohort_hip(1, k);
    if (hip.measures.alpha_angle) {
      EXPECT_EQ(hip.alpha_angle, *hip.measures.alpha_angle);
      ++cams;
    }
    EXPECT_GE(hip.alpha_angle, Angle::degrees(40));
  }
  EXPECT_GT(cams, many / 3);
  EXPECT_LT(cams, many);
}

}  // namespace
}  // namespace condyle::test
