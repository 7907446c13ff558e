#include "condyle/pressure.hpp"
#include "support/knee.hpp"
#include "support/test.hpp"

/// A simulated flexion of a knee, and the contact that OpenSim-JAM publishes for it.

namespace condyle::contact {
namespace {

/// Published numbers have 8 decimals, of SI units; the joint coordinates they follow from have all their digits.
constexpr double half_a_digit = 0.5000001e-8;
/// Uncertainty from single precision somewhere in OpenSim-JAM's computation, for a number or a vector's length.
constexpr double relative = 2e-5;

const ElasticLayer published_cartilage{10, 0.45, 3.0};

struct PublishedContact : testing::TestWithParam<const char*> {
  std::string contact = GetParam();

  ElasticContact joint(const test::Knee& knee) const {
    return {knee.femur_cartilage,
            contact == "tf" ? knee.tibia_cartilage : knee.patella_cartilage,
            {.casting = Casting::mobile,
             .rays = {.rule = FaceRule::face_centre},
             .fixed = published_cartilage,
             .mobile = published_cartilage}};
  }
  Pose pose(const test::Knee& knee, std::size_t frame) const {
    return contact == "tf" ? knee.tibia_at(frame) : knee.patella_at(frame);
  }
  Vec3 vector(const test::Knee& knee, std::size_t frame, const std::string& name) const {
    const auto value = [&](const char* axis) { return knee.published(contact, frame, name + axis); };
    return {value("_x"), value("_y"), value("_z")};
  }
};

/// All 17 numbers of all frames: within half a printed digit and 2e-5.
TEST_P(PublishedContact, FollowsFromThePublishedCoordinates) {
  FOUND_OR_SKIP(knee, test::shared_knee());
  const ElasticContact surfaces = joint(*knee);
  ASSERT_EQ(knee->states.rows.size(), 251u);
  for (std::size_t frame = 0; frame < 251; ++frame) {
    SCOPED_TRACE(contact + " frame " + std::to_string(frame));
    const auto expect_published = [&](double found, const char* name) {
      const double published = knee->published(contact, frame, name);
      EXPECT_NEAR(found, published, half_a_digit + relative * std::abs(published)) << name;
    };
    const auto expect_vector = [&](const Vec3& found, const char* name) {
      const Vec3 published = vector(*knee, frame, name);
      EXPECT_LE((found - published).cwiseAbs().maxCoeff(), half_a_digit + relative * published.norm())
          << name;
    };
    const auto results = surfaces.at(pose(*knee, frame));
    const ContactTotals& totals = results.mobile->totals;
    EXPECT_NEAR(1e-6 * totals.area_mm2, knee->published(contact, frame, "contact_area"), half_a_digit);
    expect_published(1e-3 * totals.mean_depth_mm, "mean_proximity");
    expect_published(1e-3 * totals.max_depth_mm, "max_proximity");
    expect_published(1e6 * totals.mean_pressure_mpa, "mean_pressure");
    expect_published(1e6 * totals.max_pressure_mpa, "max_pressure");
    // Half a digit of the place, and as much again: the mean depth, 0.2 mm, has as many digits to weigh the place with.
    for (const auto& [found, name] : {std::pair{*totals.centre_of_depth, "center_of_proximity"},
                                      {*totals.centre_of_pressure, "center_of_pressure"}})
      EXPECT_LE((1e-3 * found - vector(*knee, frame, name)).cwiseAbs().maxCoeff(), 2 * half_a_digit) << name;
    expect_vector(totals.force_n, "contact_force");
    expect_vector(-1e-3 * totals.moment_nmm, "contact_moment");
  }
}

/// From half a millimetre off in any direction the balance is the published translation to 1e-5 mm in each coordinate.
TEST(PublishedBalance, IsFoundFromHalfAMillimetreOff) {
  FOUND_OR_SKIP(knee, test::shared_knee());
  const ElasticContact surfaces(knee->femur_cartilage, knee->tibia_cartilage,
                                {.casting = Casting::mobile,
                                 .rays = {.rule = FaceRule::face_centre},
                                 .fixed = published_cartilage,
                                 .mobile = published_cartilage});
  for (const std::size_t frame : {0u, 100u, 250u}) {
    const auto value = [&](const char* name) { return knee->published("tf", frame, name); };
    const Vec3 force(value("contact_force_x"), value("contact_force_y"), value("contact_force_z"));
    const Pose published = knee->tibia_at(frame);
    for (const Vec3& off :
         {Vec3(0.5, 0, 0), Vec3(0, 0.5, 0), Vec3(0, -0.5, 0), Vec3(-0.3, 0.3, 0.3), Vec3(0, 0, -0.5)}) {
      SCOPED_TRACE(testing::Message() << "frame " << frame << " off by " << off.transpose());
      Pose start = published;
      start.translation() += off;
      const auto balanced = balance(surfaces, start, {{-force}, BodyRole::mobile});
      if (frame != 250) {  // flexed, the tibia is held along its plateau by ligaments alone
        ASSERT_EQ(balanced.outcome, BalanceOutcome::balanced) << reason_of(balanced);
      }
      EXPECT_LE((balanced.X_FM.translation() - published.translation()).cwiseAbs().maxCoeff(), 1e-5);
      EXPECT_LE(balanced.residual.force_n.norm(), 1e-6);
      EXPECT_LE(balanced.steps, 12);
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Contacts, PublishedContact, testing::Values("tf", "pf"));

}  // namespace
}  // namespace condyle::contact
