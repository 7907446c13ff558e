#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <cmath>

#include "condyle/load_balance.hpp"
#include "contact/elastic_parts.hpp"
#include "support/knee.hpp"

/// A simulated flexion of a knee, and the contact that OpenSim-JAM publishes for it.

namespace condyle {
namespace {

/// Published numbers have 8 decimals, of SI units.
constexpr double half_a_digit = 0.5000001e-8;
/// So have the joint coordinates: translations are off by half a digit along each axis, rotations move what lies within
/// 60 mm of the origin by less than 6e-10 m more. No depth is off by more than this.
constexpr double depth_of_states = 1.7321 * half_a_digit + 1e-9;
constexpr double relative = 2e-5;
/// m. Half a digit in each coordinate of a centre, 8.7e-9, and what rounded angles leave once the force is the published one: a
/// tilt of 5e-9 rad adds 5e-9 s of depth at a distance s from the centre, which moves the centre by 5e-9 <s^2> over the mean
/// depth. With the two compartments 20 mm to either side and 0.18 mm deep that is 1.1e-8.
constexpr double centre_of_printed = 2e-8;

const ElasticLayer cartilage{10, 0.45, 3.0};

struct PublishedContact : testing::TestWithParam<const char*> {
  std::string contact = GetParam();

  ElasticContact joint(const test::Knee& knee) const {
    return {knee.femur_cartilage,
            contact == "tf" ? knee.tibia_cartilage : knee.patella_cartilage,
            {.casting = Casting::mobile,
             .rays = {.rule = FaceRule::face_centre},
             .fixed = cartilage,
             .mobile = cartilage}};
  }
  Pose pose(const test::Knee& knee, std::size_t frame) const {
    return contact == "tf" ? knee.tibia_at(frame) : knee.patella_at(frame);
  }
  Vec3 vector(const test::Knee& knee, std::size_t frame, const std::string& name) const {
    const auto value = [&](const char* axis) { return knee.published(contact, frame, name + axis); };
    return {value("_x"), value("_y"), value("_z")};
  }
};

/// All numbers of all frames from the printed coordinates, as far as those determine them: an error of the depth moves a
/// pressure by its share of the depth, and a centre by that share of the patch.
TEST_P(PublishedContact, FollowsFromThePrintedCoordinates) {
  const auto knee = test::shared_knee();
  if (!knee) GTEST_SKIP() << "the shared knee is missing";
  const ElasticContact surfaces = joint(*knee);
  ASSERT_EQ(knee->states.rows.size(), 251u);
  for (std::size_t frame = 0; frame < 251; ++frame) {
    SCOPED_TRACE(contact + " frame " + std::to_string(frame));
    const auto published = [&](const char* name) { return knee->published(contact, frame, name); };
    const auto results = surfaces.at(pose(*knee, frame));
    const ContactTotals& totals = results.mobile->totals;
    EXPECT_NEAR(1e-6 * totals.area_mm2, published("contact_area"), half_a_digit);
    EXPECT_NEAR(1e-3 * totals.mean_depth_mm, published("mean_proximity"), half_a_digit + depth_of_states);
    EXPECT_NEAR(1e-3 * totals.max_depth_mm, published("max_proximity"), half_a_digit + depth_of_states);
    const double share = depth_of_states / published("mean_proximity");
    constexpr double patch = 0.03;  // m: from a centre to the far end of the other compartment
    EXPECT_LE((1e-3 * *totals.centre_of_depth - vector(*knee, frame, "center_of_proximity")).norm(),
              share * patch);
    EXPECT_LE((1e-3 * *totals.centre_of_pressure - vector(*knee, frame, "center_of_pressure")).norm(),
              share * patch);
    EXPECT_NEAR(1e6 * totals.mean_pressure_mpa, published("mean_pressure"),
                share * published("mean_pressure"));
    EXPECT_NEAR(1e6 * totals.max_pressure_mpa, published("max_pressure"), share * published("max_pressure"));
    const Vec3 force = vector(*knee, frame, "contact_force"), moment = vector(*knee, frame, "contact_moment");
    EXPECT_LE((totals.force_n - force).norm(), share * force.norm());
    EXPECT_LE((-1e-3 * totals.moment_nmm - moment).norm(), share * (moment.norm() + force.norm() * patch));
  }
}

/// Among the coordinates that print the same there are some for which every number is the published one to 2e-5: those nearest
/// to the printed ones that carry the published force, as far as the contact is stiff enough to tell.
TEST_P(PublishedContact, HoldsToPrintedDigitsWithinTheRoundingOfTheCoordinates) {
  const auto knee = test::shared_knee();
  if (!knee) GTEST_SKIP() << "the shared knee is missing";
  const ElasticContact surfaces = joint(*knee);
  ElasticContact::Parts::Answers answers;
  for (std::size_t frame = 0; frame < 251; ++frame) {
    SCOPED_TRACE(contact + " frame " + std::to_string(frame));
    const auto published = [&](const char* name) { return knee->published(contact, frame, name); };
    const Vec3 force = vector(*knee, frame, "contact_force"), moment = vector(*knee, frame, "contact_moment");
    Pose X = pose(*knee, frame);
    surfaces.parts().answer(X, answers);
    const auto load = surfaces.parts().load_of(answers, X);
    const Eigen::Matrix3d change =
        surfaces.parts().change_of(answers, X, contact::Motions::translations).topLeftCorner<3, 3>();
    constexpr double soft = 20;  // N / mm: of some 1500 across the contact; along it rounded angles decide
    const Vec3 off = (change.transpose() * change + soft * soft * Eigen::Matrix3d::Identity())
                         .ldlt()
                         .solve(change.transpose() * (X.linear() * force - Vec3(load.wrench.head<3>())));
    // Half a digit of each translation; angles of half a digit move a surface 40 mm away by 2e-7 mm more.
    EXPECT_LE(off.cwiseAbs().maxCoeff(), 1e3 * half_a_digit + 3 * 2e-7);
    X.translation() += off;
    const auto results = surfaces.at(X);
    const ContactTotals& totals = results.mobile->totals;
    EXPECT_NEAR(1e-6 * totals.area_mm2, published("contact_area"), half_a_digit);
    EXPECT_NEAR(1e-3 * totals.mean_depth_mm, published("mean_proximity"),
                half_a_digit + relative * published("mean_proximity"));
    EXPECT_NEAR(1e-3 * totals.max_depth_mm, published("max_proximity"),
                half_a_digit + relative * published("max_proximity"));
    EXPECT_NEAR(1e6 * totals.mean_pressure_mpa, published("mean_pressure"),
                relative * published("mean_pressure"));
    EXPECT_NEAR(1e6 * totals.max_pressure_mpa, published("max_pressure"),
                relative * published("max_pressure"));
    const Vec3 of_depth = vector(*knee, frame, "center_of_proximity"),
               of_pressure = vector(*knee, frame, "center_of_pressure");
    EXPECT_LE((1e-3 * *totals.centre_of_depth - of_depth).norm(), centre_of_printed);
    const double off_pressure = (1e-3 * *totals.centre_of_pressure - of_pressure).norm();
    EXPECT_LE(off_pressure, centre_of_printed);
    EXPECT_LE(off_pressure, relative * of_pressure.norm());
    EXPECT_LE((totals.force_n - force).norm(), relative * force.norm());
    EXPECT_LE((-1e-3 * totals.moment_nmm - moment).norm(), relative * moment.norm() + half_a_digit);
  }
}

/// From half a millimetre off in any direction the balance is the printed translation to 1e-5 mm, and half of the last printed
/// digit, in each coordinate.
TEST(PublishedBalance, IsFoundFromHalfAMillimetreOff) {
  const auto knee = test::shared_knee();
  if (!knee) GTEST_SKIP() << "the shared knee is missing";
  const ElasticContact surfaces(knee->femur_cartilage, knee->tibia_cartilage,
                                {.casting = Casting::mobile,
                                 .rays = {.rule = FaceRule::face_centre},
                                 .fixed = cartilage,
                                 .mobile = cartilage});
  for (const std::size_t frame : {0u, 100u, 250u}) {
    const auto value = [&](const char* name) { return knee->published("tf", frame, name); };
    const Vec3 force(value("contact_force_x"), value("contact_force_y"), value("contact_force_z"));
    const Pose printed = knee->tibia_at(frame);
    for (const Vec3& off :
         {Vec3(0.5, 0, 0), Vec3(0, 0.5, 0), Vec3(0, -0.5, 0), Vec3(-0.3, 0.3, 0.3), Vec3(0, 0, -0.5)}) {
      SCOPED_TRACE(testing::Message() << "frame " << frame << " off by " << off.transpose());
      Pose start = printed;
      start.translation() += off;
      const auto balanced = balance(surfaces, start, {{-force}, BodyRole::mobile});
      if (frame != 250) {  // flexed, the tibia is held along its plateau by ligaments alone
        ASSERT_EQ(balanced.outcome, BalanceOutcome::balanced) << reason_of(balanced);
      }
      EXPECT_LE((balanced.X_FM.translation() - printed.translation()).cwiseAbs().maxCoeff(),
                1e-5 + 1e3 * half_a_digit);
      EXPECT_LE(balanced.residual.force_n.norm(), 1e-6);
      EXPECT_LE(balanced.steps, 12);
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Contacts, PublishedContact, testing::Values("tf", "pf"));

}  // namespace
}  // namespace condyle
