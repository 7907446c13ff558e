#include "condyle/answer/case.hpp"

#include "motion/joint_scenes.hpp"
#include "support/test.hpp"

namespace condyle {
namespace {

TEST(Case, HasTheBandThatItIsAskedForAndElseItsOwn) {
  Case joint{test::bumpy_joint(Side::right)};
  joint.uncertainty = {.centre_mm = 3, .axes = Angle::degrees(2), .surface_mm = 0.5, .surface_voxels = 0.75};
  joint.band_seed = 7;
  const motion::BandOptions own = band_options(joint, {.samples = 30});
  EXPECT_EQ(own.samples, 30u);
  EXPECT_EQ(own.seed, 7u);
  EXPECT_EQ(own.sigma.centre_mm, 3);
  EXPECT_EQ(own.sigma.axes, Angle::degrees(2));
  EXPECT_EQ(own.sigma.surface_mm, 0.5);
  EXPECT_EQ(own.sigma.surface_voxels, 0.75);

  const motion::BandOptions asked =
      band_options(joint, {.seed = 5, .centre_mm = 1, .axes_deg = 0, .surface_mm = 0.25});
  EXPECT_EQ(asked.samples, motion::BandOptions{}.samples);
  EXPECT_EQ(asked.seed, 5u);
  EXPECT_EQ(asked.sigma.centre_mm, 1);
  EXPECT_EQ(asked.sigma.axes, Angle());
  EXPECT_EQ(asked.sigma.surface_mm, 0.25);
  EXPECT_EQ(asked.sigma.surface_voxels, 0) << "a surface in mm has no part in voxels";
}

TEST(Case, KnowsItsOwnMotionsBesideTheBuiltInOnes) {
  Case joint{test::bumpy_joint(Side::right)};
  const std::size_t built_in = joint.motions().size();
  motion::Motion own = joint.motions().front();
  own.name = "reach";
  joint.own_motions = {own};
  EXPECT_EQ(joint.motions().size(), built_in + 1);
  const std::vector<std::string> names{"reach"};
  ASSERT_EQ(joint.motions(names).size(), 1u);
  EXPECT_EQ(joint.motions(names)[0].name, "reach");
  EXPECT_EQ(joint.motions(std::vector<std::string>{}).size(), built_in + 1);
  EXPECT_THROW(joint.motions(std::vector<std::string>{"jump"}), UsageError);
}

TEST(Case, IsMeasuredInTheFrameAndAtThePoseOfItsDescription) {
  Case joint{test::bumpy_joint(Side::right)};
  joint.pelvis_frame = "anterior pelvic plane";
  joint.placement.reference_pose.angles.flexion = Angle::degrees(20);
  const measure::MeasureOptions options = joint.measure_options(Angle::degrees(5));
  EXPECT_EQ(options.pelvic_tilt, Angle::degrees(5));
  EXPECT_EQ(options.pelvis_frame, "anterior pelvic plane");
  EXPECT_EQ(options.ischiofemoral_pose.flexion, Angle::degrees(20));
}

}  // namespace
}  // namespace condyle
