#include "condyle/hip_measures.hpp"
#include "condyle/sample/hip.hpp"
#include "study_of_arms.hpp"
#include "support/test.hpp"

/// Measures of a hip's shape as columns of a study.

namespace condyle::test {
namespace {

std::string text_of(const std::optional<double>& value) {
  return value ? fmt::format("{}", *value) : "";
}

class StudyOfShapes : public ::testing::Test {
 protected:
  void write(const std::string& text) const { folder.file("hips.csv", text); }
  io::Study study(const std::string& out) const {
    io::Study shapes{folder / "hips.csv", folder / out};
    shapes.options.motions = {"flexion"};
    shapes.options.measures = true;
    return shapes;
  }
  static Joint sample(Side side) {
    static const sample::SampleHip right = sample::sample_hip({}, sample::Scenario::one);
    sample::SampleHip bones = right;
    if (side == Side::left) bones = mirrored(bones);
    return {"hip", JointKind::ball, side, {"hip bone", bones.hip_bone}, {"femur", bones.femur}};
  }

  const TemporaryFolder folder;
};

TEST_F(StudyOfShapes, HasWhatTheLibraryMeasuresWithTheTiltOfTheTable) {
  write("id,sample,side,pelvic_tilt_deg,neck_shaft_angle_deg\na,1,right,,127\nb,1,left,10,127\n");
  ASSERT_EQ(io::run_study(study("out"))->failures, 0u);
  const auto hips = rows_of(folder / "out/hips.csv");
  const measure::HipMeasures expected[] = {
      measure::measure_hip(sample(Side::right)),
      measure::measure_hip(sample(Side::left), {.pelvic_tilt = Angle::degrees(10)})};
  for (std::size_t k = 0; k < 2; ++k)
    for (const measure::MeasureDefinition& each : measure::measure_definitions())
      EXPECT_EQ(hips[k].at("measured_" + std::string(each.key)), text_of(each.of(expected[k]).value));
  EXPECT_EQ(hips[0].at("measured_frame"), "as scanned");
  EXPECT_EQ(hips[1].at("measured_frame"), "as scanned, tilt 10 deg given");
  EXPECT_EQ(hips[0].at("measured_femoral_version_deg"), "");
  expect_says(hips[0].at("measured_none"), "femoral_version_deg: the mesh ends above the knee");
  // Requested values stand beside measured ones.
  EXPECT_EQ(hips[0].at("neck_shaft_angle_deg"), "127");
  EXPECT_EQ(hips[1].at("pelvic_tilt_deg"), "10");
  EXPECT_FALSE(hips[0].contains("measured_alpha_3_deg_p5"));
  EXPECT_TRUE(io::run_study(study("out"))->was_there);
}

TEST_F(StudyOfShapes, ExpectsNoEndOfAChildsHipByItsAge) {
  write("id,sample,age_years\nadult,1,40\nunknown,1,\nchild,1,7\nancient,1,121\n");
  io::Study limits = study("out");
  limits.options.measures = false;
  ASSERT_EQ(io::run_study(limits)->failures, 1u);
  const auto rows = rows_of(folder / "out/limits.csv");
  ASSERT_EQ(rows.size(), 3u);
  for (const std::size_t grown : {0, 1})
    EXPECT_NEAR(std::stod(rows[grown].at("living_expected_deg")),
                std::stod(rows[grown].at("limit_deg")) - 3.1, 1e-9);
  EXPECT_EQ(rows[2].at("living_expected_deg"), "");
  expect_ends(rows_of(folder / "out/failures.csv")[0].at("message"),
              "hips.csv: line 5: column 'age_years': '121' is none of 0 to 120 years");
}

TEST_F(StudyOfShapes, HasBandsWhereTheyAreAskedFor) {
  write("id,sample\na,1\n");
  io::Study banded = study("out");
  banded.options.bands = {20, 3, {}};
  ASSERT_EQ(io::run_study(banded)->failures, 0u);
  const auto hip = rows_of(folder / "out/hips.csv")[0];
  const auto bands = measure::measure_bands(sample(Side::right), {}, {.samples = 20, .seed = 3});
  for (std::size_t i = 0; i < bands.size(); ++i) {
    const std::string name = "measured_" + std::string(measure::measure_definitions()[i].key);
    EXPECT_EQ(hip.at(name + "_p5"), text_of(bands[i].p5)) << name;
    EXPECT_EQ(hip.at(name + "_p95"), text_of(bands[i].p95)) << name;
  }
}

TEST_F(StudyOfArms, RefusesATiltThatIsNone) {
  io::Study tilted{folder.file("tilts.csv",
                               "id,joint,pelvic_tilt_deg\na,hip1.toml,forwards\nb,hip2.toml,61\nc,hip3.toml,"
                               "nan\nd,hip4.toml,-60\n"),
                   folder / "out", flexion_only()};
  EXPECT_EQ(run(tilted).failures, 0u) << "a covariate where nothing is measured";
  tilted.options.measures = true;
  EXPECT_EQ(run(tilted).failures, 3u);
  const auto failures = rows_of(folder / "out/failures.csv");
  expect_ends(
      failures[0].at("message"),
      "tilts.csv: line 2: column 'pelvic_tilt_deg': 'forwards' is no number of degrees from -60 to 60");
  EXPECT_EQ(failures[0].at("exit_code"), "3");
  EXPECT_EQ(rows_of(folder / "out/hips.csv")[0].at("id"), "d");
}

TEST_F(StudyOfArms, MeasuresNothingOfWhatHasNoHeadAndSaysWhy) {
  io::Study shapes = study("out");
  shapes.options.measures = true;
  EXPECT_EQ(run(shapes).failures, 4u);
  const auto hip = rows_of(folder / "out/hips.csv")[0];
  for (const measure::MeasureDefinition& each : measure::measure_definitions())
    EXPECT_EQ(hip.at("measured_" + std::string(each.key)), "");
  expect_says(hip.at("measured_none"), "head_radius_mm: no spherical head");
  run(study("plain"));
  EXPECT_FALSE(rows_of(folder / "plain/hips.csv")[0].contains("measured_none"));
}

TEST_F(StudyOfArms, EndsWhereMeasuresAreAskedForOfAnotherJoint) {
  io::Study of_knees = knees();
  of_knees.options.measures = true;
  expect_says(complaint_of<UsageError>([&] { io::run_study(of_knees); }),
              "measures: are of hips, and this study is of the knee");
}

}  // namespace
}  // namespace condyle::test
