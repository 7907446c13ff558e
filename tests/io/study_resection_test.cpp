#include "condyle/answer.hpp"
#include "condyle/sample/hip.hpp"
#include "study_of_arms.hpp"
#include "support/test.hpp"

/// The bone that must go as columns of a study.

namespace condyle::test {
namespace {

constexpr const char* motion = "internal_rotation_at_90_flexion";

Joint with_cam() {
  const sample::SampleHip bones =
      sample::sample_hip({.alpha_angle = Angle::degrees(70)}, sample::Scenario::one);
  return {"hip", JointKind::ball, Side::right, {"hip bone", bones.hip_bone}, {"femur", bones.femur}};
}

class StudyOfCams : public ::testing::Test {
 protected:
  io::Study study(const std::string& rows, const std::string& reach) const {
    io::Study cams{folder.file("hips.csv", "id,sample,alpha_angle_deg\n" + rows), folder / "out"};
    cams.options.motions = {motion, "flexion"};
    cams.options.resection = {parse_reach(reach), {}};
    return cams;
  }

  const TemporaryFolder folder;
};

TEST_F(StudyOfCams, HasWhatTheLibraryAnswers) {
  ASSERT_EQ(io::run_study(study("cam,1,70\n", std::string(motion) + "=45"))->failures, 0u);
  const auto hip = rows_of(folder / "out/hips.csv")[0];
  const auto limits = rows_of(folder / "out/limits.csv");
  ResectionRequest request{
      .resection = {.targets = reach_targets(motion::hip_motions(), std::string(motion) + "=45")},
      .motions = {motion::motion_named(motion::hip_motions(), motion),
                  motion::motion_named(motion::hip_motions(), "flexion")},
      .bands = {},
      .curve_points = 0};
  const ResectionAnswer expected = answer_resection({with_cam()}, request);
  const plan::CutBone& femur = *expected.resection.mobile;
  EXPECT_GT(femur.volume_mm3, 1);
  EXPECT_EQ(hip.at("resect_volume_mm3"), fmt::format("{}", femur.volume_mm3));
  EXPECT_EQ(hip.at("resect_least_volume_mm3"), fmt::format("{}", femur.least_volume_mm3));
  EXPECT_EQ(hip.at("resect_area_mm2"), fmt::format("{}", femur.area_mm2));
  EXPECT_EQ(hip.at("resect_deepest_mm"), fmt::format("{}", femur.deepest_mm));
  EXPECT_EQ(hip.at("resect_internal_rotation_at_90_flexion_planned_deg"), "45");
  EXPECT_EQ(hip.at("resect_internal_rotation_at_90_flexion_after_deg"),
            fmt::format("{}", expected.resection.targets[0].after.end.turned.degrees()));
  EXPECT_EQ(hip.at("resect_internal_rotation_at_90_flexion_blocked_by"), "");
  EXPECT_EQ(hip.at("resect_none"), "");
  expect_says(hip.at("resect_notes"), "no_gain");
  for (std::size_t i = 0; i < 2; ++i) {
    EXPECT_EQ(limits[i].at("limit_deg"), fmt::format("{}", expected.before[i].end.turned.degrees()));
    EXPECT_EQ(limits[i].at("resected_limit_deg"), fmt::format("{}", expected.after[i].end.turned.degrees()));
    EXPECT_EQ(limits[i].at("resected_reason"), "contact");
  }
}

TEST_F(StudyOfCams, SaysThatNothingHasToGoAndWhatStopsATarget) {
  io::Study cams = study("none,1,60\ncam,1,70\n", std::string(motion) + "=45");
  cams.options.resection->cut.mobile.deepest_mm = 0.5;
  ASSERT_EQ(io::run_study(cams)->failures, 0u);
  const auto hips = rows_of(folder / "out/hips.csv");
  EXPECT_EQ(hips[0].at("resect_volume_mm3"), "0");
  EXPECT_EQ(hips[0].at("resect_notes"), "nothing_to_do");
  EXPECT_EQ(hips[1].at("resect_internal_rotation_at_90_flexion_blocked_by"), "depth");
  EXPECT_LT(std::stod(hips[1].at("resect_internal_rotation_at_90_flexion_planned_deg")), 45);
  EXPECT_LE(std::stod(hips[1].at("resect_deepest_mm")), 0.5);
}

TEST_F(StudyOfCams, EndsAtATargetThatNoJointOfItHas) {
  EXPECT_THROW(io::run_study(study("cam,1,70\n", "flexion=500")), UsageError);
  EXPECT_THROW(io::run_study(study("cam,1,70\n", "bending=40")), UsageError);
  EXPECT_FALSE(std::filesystem::exists(folder / "out/study.json"));
}

TEST_F(StudyOfArms, KeepsTheLimitsOfAJointWithoutAPlanAndSaysWhyItHasNone) {
  io::Study cuts = study("out");
  // All reach it but the one that starts in contact.
  cuts.options.resection = {parse_reach("flexion=5"), {}};
  cuts.options.reference_contact = motion::ReferenceContact::accept;
  run(cuts);
  std::size_t planned = 0;
  for (const auto& arm : rows_of(folder / "out/hips.csv")) {
    EXPECT_EQ(arm.at("resect_none").empty(), !arm.at("resect_volume_mm3").empty());
    if (arm.at("resect_none").empty())
      ++planned;
    else
      expect_says(arm.at("resect_none"), "flexion is in contact at its start");
  }
  EXPECT_EQ(planned, 9u);
  EXPECT_EQ(rows_of(folder / "out/hips.csv").size(), 10u) << "the one in contact is there too";
  run(study("plain"));
  EXPECT_FALSE(rows_of(folder / "plain/limits.csv")[0].contains("resected_limit_deg"));
}

}  // namespace
}  // namespace condyle::test
