#include "contact/elastic_parts.hpp"
#include "support/cup.hpp"
#include "support/test.hpp"

/// Faces at the rim of a solid, where closed forms say what is in contact.

namespace condyle::contact {
namespace {

constexpr double stiffness = 3, depth = 0.5;

/// A sheet of 12 x 12 mm under the end of a wider slab.
ElasticContact sheet_under_slab() {
  return {test::plane(6, 23),
          test::box({-50, 0, -50}, {0, 20, 50}),
          {.casting = Casting::fixed, .fixed = test::layer_of_stiffness(stiffness)}};
}
/// The slab's end, turned about +y, crosses the middle of the sheet at x.
Pose slab_at(double x, double turn) {
  Pose X_FM = Pose::Identity();
  X_FM.linear() = Eigen::AngleAxisd(turn, Vec3::UnitY()).toRotationMatrix();
  X_FM.translation() = Vec3(x, -depth, 0);
  return X_FM;
}

TEST(CutFaces, EndWhereASolidEnds) {
  const ElasticContact contact = sheet_under_slab();
  for (const double turn : {0.0, 0.1, -0.4}) {
    for (double x = -1.7; x < 1.7; x += 0.0613) {
      const auto results = contact.at(slab_at(x, turn));
      const ContactTotals& totals = results.fixed->totals;
      ASSERT_GT(results.fixed->rim_faces, 20u);
      // The slab's end cuts a quadrilateral off, as wide at its middle as at x. Coordinates of 50 mm round by 1e-14, sums of a
      // thousand faces by less than 1e-11 of 100 mm2.
      EXPECT_NEAR(totals.area_mm2, 12 * (6 + x), 1e-9);
      EXPECT_NEAR(totals.mean_depth_mm, depth, 1e-12);
      EXPECT_NEAR(totals.max_depth_mm, depth, 1e-12);
      EXPECT_NEAR(totals.force_n.y(), -stiffness * depth * totals.area_mm2, 1e-9);
    }
  }
}

TEST(CutFaces, ShowHowTheLoadChangesAsASolidEndSlides) {
  const ElasticContact contact = sheet_under_slab();
  for (const double turn : {0.0, 0.1, -0.4}) {
    const Pose X_FM = slab_at(0.311, turn);
    ElasticContact::Parts::Answers answers;
    contact.parts().answer(X_FM, answers);
    const auto change = contact.parts().change_of(answers, X_FM, Motions::translations);
    // Up is positive; slid along +z the turned end crosses the sheet's middle tan(turn) further back.
    const double of_slide = stiffness * depth * 12;
    EXPECT_NEAR(change(1, 0), of_slide, 1e-9 * of_slide);
    EXPECT_NEAR(change(1, 1), -stiffness * 12 * 6.311, 1e-9 * stiffness * 12 * 6.311);
    EXPECT_NEAR(change(1, 2), -of_slide * std::tan(turn), 1e-9 * of_slide);
  }
}

TEST(CutFaces, AreDecidedByPartsWhereTheTargetIsOpen) {
  // The same with the slab's lower side alone, an open sheet.
  const ElasticContact contact(test::plane(6, 23),
                               test::flipped(posed(test::translated({-50, 0, 0}), test::plane(50, 1))),
                               {.casting = Casting::fixed, .fixed = test::layer_of_stiffness(stiffness)});
  const ContactTotals totals = contact.at(slab_at(0.311, 0.1)).fixed->totals;
  // Parts are 0.13 mm wide, along a rim of 12 mm; their errors have both signs.
  EXPECT_NEAR(totals.area_mm2, 12 * 6.311, 12 * 0.13 / 2);
}

}  // namespace
}  // namespace condyle::contact
