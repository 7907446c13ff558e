#include "condyle/motion_contact.hpp"

#include "core/thread_limit.hpp"
#include "motion/joint_scenes.hpp"
#include "motion/recorded/screw_motion.hpp"
#include "support/test.hpp"

/// Contact between samples: in closed form about a held centre, by a proven bound otherwise.

namespace condyle::motion {
namespace {

using namespace test;
using std::numbers::pi;

class Random {
 public:
  explicit Random(unsigned seed) : random_(seed) {}

  double between(double low, double high) {
    return std::uniform_real_distribution<double>(low, high)(random_);
  }
  Vec3 direction() {
    // One by one: compilers draw the arguments of a call in another order each.
    std::normal_distribution<double> normal;
    const double z = normal(random_), y = normal(random_), x = normal(random_);
    return Vec3(x, y, z).normalized();
  }
  Eigen::Matrix3d rotation() {
    const Vec3 axis = direction();
    return Eigen::AngleAxisd(between(0, pi), axis).toRotationMatrix();
  }

 private:
  std::mt19937 random_;
};

Pose pose(const Eigen::Matrix3d& R, const Vec3& t) {
  Pose X = Pose::Identity();
  X.linear() = R, X.translation() = t;
  return X;
}

Eigen::Matrix3d about(const Vec3& axis, double angle) {
  return Eigen::AngleAxisd(angle, axis).toRotationMatrix();
}

/// A tooth that points outwards and a wall beyond it, about z through C:
///
///                      near
///                        +---------      A corner (near, +-box_half_width) of the wall meets the flat side of the
///     C    +-------------|-+   wall      tooth, at half_width from its middle line, where
///     .    |    tooth    | |                 rho sin(angle between) = half_width,  rho = hypot(near, box_half_width)
///          +-------------|-+             before anything else meets: that corner is nearer to C than the tooth's.
///                        +---------
///
/// At the angle 0 both point along x; contact lasts from -half_contact() to half_contact().
struct Tooth {
  double length, near, half_width, box_half_width;

  double half_contact() const {
    return std::atan2(box_half_width, near) + std::asin(half_width / std::hypot(near, box_half_width));
  }
  TriMesh tooth() const { return box({length / 2, -half_width, -1}, {length, half_width, 1}); }
  TriMesh wall() const { return box({near, -box_half_width, -5}, {2 * length, box_half_width, 5}); }
};

/// The tooth turns at a constant rate, sampled at 30 Hz, about any axis through the joint centre.
struct ToothMotion {
  contact::JointContact bodies;
  double rate;             ///< rad / s
  std::size_t sample = 2;  ///< before the contact
  double entry_angle_rad;  ///< from that sample
  double entry_s, exit_s;
  std::vector<double> time_s = {};
  std::vector<Pose> X_FM = {};

  /// Contact lasts for duration_s somewhere between the third sample and the fourth.
  static ToothMotion any(Random& random, double duration_s, const Vec3& centre) {
    const double length = random.between(50, 100);
    const Tooth tooth{length, length * random.between(0.8, 0.99), random.between(0.02, 0.1),
                      random.between(0.02, 0.1)};
    const Eigen::Matrix3d into_F = random.rotation(), from_M = random.rotation();
    const Vec3 axis = into_F.col(2);
    const double period_s = 1.0 / 30, before_s = random.between(0.01, 0.99) * (period_s - duration_s);
    const double rate = 2 * tooth.half_contact() / duration_s;
    ToothMotion motion{
        .bodies = contact::JointContact(posed(pose(into_F, centre), tooth.wall()),
                                        posed(pose(from_M.transpose(), Vec3::Zero()), tooth.tooth())),
        .rate = rate,
        .entry_angle_rad = rate * before_s,
        .entry_s = 2 * period_s + before_s,
        .exit_s = 2 * period_s + before_s + duration_s};
    for (int i = 0; i < 5; ++i) {
      motion.time_s.push_back(i * period_s);
      const double angle = rate * ((i - 2) * period_s - before_s) - tooth.half_contact();
      motion.X_FM.push_back(pose(about(axis, angle) * into_F * from_M, centre));
    }
    return motion;
  }
};

TEST(RecordedContact, OfTwoMillisecondsBetweenSamplesBeginsAndEndsWhereTheClosedFormSays) {
  Random random(1);
  for (int i = 0; i < 1000; ++i) {
    SCOPED_TRACE(i);
    const Vec3 centre = i % 2 == 0 ? Vec3::Zero() : Vec3(30 * random.direction());
    const ToothMotion motion = ToothMotion::any(random, 2e-3, centre);
    for (const Pose& X_FM : motion.X_FM) ASSERT_FALSE(motion.bodies.in_contact(X_FM));
    const RecordedContact found = contact_between(motion.bodies, motion.time_s, motion.X_FM);
    ASSERT_EQ(found.contacts.size(), 1u);
    const ContactInterval& contact = found.contacts.front();
    EXPECT_TRUE(contact.is_certain);
    EXPECT_EQ(contact.undecided_s, 0);
    for (const ContactEnd* end : {&contact.entry, &contact.exit}) {
      EXPECT_EQ(end->kind, ContactEndKind::exact);
      EXPECT_EQ(end->sample, motion.sample);
      EXPECT_LE(end->uncertainty_s * motion.rate, 4e-12 * (1 + 1e-9));
      ASSERT_TRUE(end->contact);
      // An edge of the box on the side of the tooth: its corner's radius.
      EXPECT_NEAR((end->contact->fixed_point - centre).norm(), end->contact->mobile_point.norm(), 1e-9);
    }
    EXPECT_NEAR(contact.entry.turned.degrees(), Angle::radians(motion.entry_angle_rad).degrees(), 1e-9);
    EXPECT_NEAR(contact.exit.turned.degrees(),
                Angle::radians(motion.entry_angle_rad + motion.rate * 2e-3).degrees(), 1e-9);
    EXPECT_NEAR(contact.entry.time_s, motion.entry_s, 1e-11 / motion.rate);
    EXPECT_NEAR(contact.exit.time_s, motion.exit_s, 1e-11 / motion.rate);
    EXPECT_EQ(found.searched, std::vector<BetweenSamples>(4, BetweenSamples::exact));
    EXPECT_EQ(found.poses, 0u);
  }
}

/// The same motion with a centre that drifts by this much over the recording, along the axis.
std::vector<Pose> drifting(const ToothMotion& motion, double drift_mm) {
  std::vector<Pose> X_FM = motion.X_FM;
  const Vec3 axis = Eigen::AngleAxisd(X_FM[1].linear() * X_FM[0].linear().transpose()).axis();
  for (std::size_t i = 0; i < X_FM.size(); ++i)
    X_FM[i].translation() += drift_mm * static_cast<double>(i) / 4 * axis;
  return X_FM;
}

TEST(RecordedContact, WithADriftingCentreIsBoundedAboutTheSameEntryAndExit) {
  Random random(2);
  for (int i = 0; i < 100; ++i) {
    SCOPED_TRACE(i);
    const ToothMotion motion = ToothMotion::any(random, 2e-3, Vec3::Zero());
    // The box is the same all along the axis: the drift changes nothing.
    const RecordedContact found = contact_between(motion.bodies, motion.time_s, drifting(motion, 0.5));
    EXPECT_EQ(found.searched, std::vector<BetweenSamples>(4, BetweenSamples::bounded));
    ASSERT_EQ(found.contacts.size(), 1u);
    const auto& [entry, exit, is_certain, undecided_s] = found.contacts.front();
    EXPECT_TRUE(is_certain);
    EXPECT_EQ(entry.kind, ContactEndKind::bounded);
    const double rounding_s = 1e-11;
    EXPECT_LE(entry.time_s, motion.entry_s + rounding_s);
    EXPECT_GE(entry.time_s + entry.uncertainty_s, motion.entry_s - rounding_s);
    EXPECT_GE(exit.time_s, motion.exit_s - rounding_s);
    EXPECT_LE(exit.time_s - exit.uncertainty_s, motion.exit_s + rounding_s);
    EXPECT_LE(entry.uncertainty_s, 4e-5);
    EXPECT_LE(exit.uncertainty_s, 4e-5);
    ASSERT_TRUE(entry.contact && exit.contact);
  }
}

TEST(RecordedContact, OfTranslationsBeginsAndEndsWhereFacesPass) {
  // A cube of 2 mm runs along x through a plate of 1 mm, 10 mm in 0.1 s: contact while its middle is from -1 to 2.
  const contact::JointContact bodies(box({0, -20, -20}, {1, 20, 20}), box({-1, -1, -1}, {1, 1, 1}));
  const auto at = [](double x) { return pose(Eigen::Matrix3d::Identity(), {x, 0.3, 0.2}); };
  const std::vector<double> time_s{0, 0.1, 0.2};
  const std::vector<Pose> X_FM{at(-12), at(-2), at(8)};
  const RecordedContact found = contact_between(bodies, time_s, X_FM, {.resolution_s = 1e-6});
  ASSERT_EQ(found.contacts.size(), 1u);
  const ContactInterval& contact = found.contacts.front();
  EXPECT_EQ(contact.entry.sample, 1u);
  EXPECT_LE(contact.entry.time_s, 0.11);
  EXPECT_GE(contact.entry.time_s + contact.entry.uncertainty_s, 0.11);
  EXPECT_GE(contact.exit.time_s, 0.14);
  EXPECT_LE(contact.exit.time_s - contact.exit.uncertainty_s, 0.14);
  EXPECT_LE(contact.entry.uncertainty_s, 4e-6);
  EXPECT_LE(contact.exit.uncertainty_s, 4e-6);
  EXPECT_LT(found.poses, 500u);
}

/// Poses between which the body turns and shifts at random, at 30 Hz.
struct Recording {
  std::vector<double> time_s;
  std::vector<Pose> X_FM;
};
Recording random_recording(Random& random, std::size_t samples, double rotation, double shift_mm) {
  Recording out;
  Pose X = Pose::Identity();
  for (std::size_t i = 0; i < samples; ++i) {
    out.time_s.push_back(static_cast<double>(i) / 30);
    out.X_FM.push_back(X);
    const double angle = random.between(0, rotation);
    X.linear() = about(random.direction(), angle) * X.linear();
    const double shift = shift_mm * random.between(0, 1);
    X.translation() = shift * random.direction();
  }
  return out;
}

/// Poses of every way, its ends left out: between(time, X_FM).
template <class Between>
void for_poses_between(const Recording& recording, std::size_t poses, const Between& between) {
  for (std::size_t i = 0; i + 1 < recording.X_FM.size(); ++i) {
    const ScrewMotion motion(recording.X_FM[i], recording.X_FM[i + 1], 100);
    for (std::size_t k = 1; k < poses; ++k) {
      const double s = static_cast<double>(k) / static_cast<double>(poses);
      between(recording.time_s[i] + s * (recording.time_s[i + 1] - recording.time_s[i]), motion.at(s));
    }
  }
}

TEST(RecordedContact, OfRandomScrewMotionsAgreesWithExactTestsOfManyPoses) {
  Random random(3);
  const Joint joint = bumpy_joint(Side::right);
  const contact::JointContact bodies(joint);
  std::size_t free = 0, in_contact = 0, contacts = 0;
  for (int i = 0; i < 4; ++i) {
    const Recording recording = random_recording(random, 6, 0.5, 3);
    const RecordedContact found = contact_between(bodies, recording.time_s, recording.X_FM);
    contacts += found.contacts.size();
    for_poses_between(recording, 100, [&](double time_s, const Pose& X_FM) {
      const auto at = std::find_if(
          found.contacts.begin(), found.contacts.end(),
          [&](const ContactInterval& c) { return c.entry.time_s <= time_s && time_s <= c.exit.time_s; });
      const bool certain = at != found.contacts.end() && at->is_certain && at->undecided_s < 1e-12 &&
                           at->entry.time_s + at->entry.uncertainty_s <= time_s &&
                           time_s <= at->exit.time_s - at->exit.uncertainty_s;
      if (bodies.in_contact(X_FM)) {
        ++in_contact;
        EXPECT_NE(at, found.contacts.end()) << time_s;
      } else {
        ++free;
        EXPECT_FALSE(certain) << time_s;
      }
    });
    for (const ContactInterval& c : found.contacts) {
      EXPECT_LE(c.undecided_s, 0.01 * (c.exit.time_s - c.entry.time_s) + 4e-5);
      if (c.is_certain && c.entry.kind == ContactEndKind::bounded) {
        EXPECT_LT(c.entry.uncertainty_s, 1e-3);
      }
    }
  }
  EXPECT_GT(contacts, 4u);
  EXPECT_GT(free, 200u);
  EXPECT_GT(in_contact, 200u);
}

TEST(RecordedContact, OfRandomRotationsAgreesWithExactTestsOfManyPoses) {
  Random random(4);
  const Joint joint = bumpy_joint(Side::left);
  const contact::JointContact bodies(joint);
  std::size_t free = 0, in_contact = 0;
  for (int i = 0; i < 4; ++i) {
    const Recording recording = random_recording(random, 6, 0.8, 0);
    const RecordedContact found = contact_between(bodies, recording.time_s, recording.X_FM);
    for_poses_between(recording, 100, [&](double time_s, const Pose& X_FM) {
      const bool expected = bodies.in_contact(X_FM);
      ++(expected ? in_contact : free);
      EXPECT_EQ(std::any_of(found.contacts.begin(), found.contacts.end(),
                            [&](const ContactInterval& c) {
                              return c.entry.time_s <= time_s && time_s <= c.exit.time_s;
                            }),
                expected)
          << time_s;
    });
  }
  EXPECT_GT(free, 200u);
  EXPECT_GT(in_contact, 200u);
}

TEST(RecordedContact, GoesOnOverSamples) {
  // 0.1 s at 30 Hz: three samples are in contact.
  const Tooth tooth{100, 90, 2, 3};
  const double half = tooth.half_contact();
  const contact::JointContact bodies(tooth.wall(), tooth.tooth());
  std::vector<double> time_s;
  std::vector<Pose> held, shifted;
  const double rate = 2 * half / 0.1;
  for (int i = 0; i < 8; ++i) {
    time_s.push_back(i / 30.0);
    held.push_back(pose(about(Vec3::UnitZ(), rate * (time_s.back() - 0.08) - half), Vec3::Zero()));
    shifted.push_back(held.back());
    shifted.back().translation().z() = 0.1 * i;
  }
  for (const auto& X_FM : {held, shifted}) {
    const RecordedContact found = contact_between(bodies, time_s, X_FM);
    ASSERT_EQ(found.contacts.size(), 1u);
    const ContactInterval& contact = found.contacts.front();
    EXPECT_EQ(contact.entry.sample, 2u);
    EXPECT_EQ(contact.exit.sample, 5u);
    EXPECT_NEAR(contact.entry.time_s, 0.08, contact.entry.uncertainty_s + 1e-12);
    EXPECT_NEAR(contact.exit.time_s, 0.18, contact.exit.uncertainty_s + 1e-12);
    EXPECT_LT(contact.entry.uncertainty_s, 4e-5);
  }
  // Begun within the contact and ended there.
  const RecordedContact within =
      contact_between(bodies, std::span(time_s).subspan(3, 3), std::span(held).subspan(3, 3));
  ASSERT_EQ(within.contacts.size(), 1u);
  EXPECT_EQ(within.contacts[0].entry.kind, ContactEndKind::recording);
  EXPECT_EQ(within.contacts[0].entry.time_s, time_s[3]);
  EXPECT_EQ(within.contacts[0].exit.kind, ContactEndKind::recording);
  EXPECT_EQ(within.contacts[0].exit.time_s, time_s[5]);
}

TEST(RecordedContact, CountsABodyInsideTheOther) {
  const contact::JointContact bodies(sphere({0, 0, 0}, 20, 3), box({-1, -1, -1}, {1, 1, 1}));
  const std::vector<double> time_s{0, 1};
  for (const double shift_mm : {0.0, 1.0}) {
    const std::vector<Pose> X_FM{Pose::Identity(), pose(about(Vec3::UnitX(), 0.3), {shift_mm, 0, 0})};
    const RecordedContact found = contact_between(bodies, time_s, X_FM);
    ASSERT_EQ(found.contacts.size(), 1u);
    EXPECT_EQ(found.contacts[0].entry.time_s, 0);
    EXPECT_EQ(found.contacts[0].exit.time_s, 1);
    EXPECT_TRUE(found.contacts[0].is_certain);
    EXPECT_FALSE(found.contacts[0].entry.contact);
    EXPECT_EQ(found.contacts[0].entry.uncertainty_s, 0);
  }
}

TEST(RecordedContact, OfABodyAtRestIsThatOfItsPose) {
  const contact::JointContact bodies(box({0, -20, -20}, {1, 20, 20}), box({-1, -1, -1}, {1, 1, 1}));
  const std::vector<double> time_s{0, 1, 2};
  const auto rest_at = [](double x) {
    return std::vector<Pose>(3, pose(Eigen::Matrix3d::Identity(), {x, 0, 0}));
  };
  EXPECT_TRUE(contact_between(bodies, time_s, rest_at(-1.5)).contacts.empty());
  const RecordedContact found = contact_between(bodies, time_s, rest_at(-1));
  ASSERT_EQ(found.contacts.size(), 1u);
  EXPECT_EQ(found.contacts[0].exit.time_s, 2);
  EXPECT_EQ(found.contacts[0].entry.uncertainty_s, 0);
}

TEST(RecordedContact, OfAHeadThatGlidesInItsSocketNeedsFewPoses) {
  // A gap of 0.5 mm; the centre moves by 0.1 mm while the head turns by 100 degrees.
  const contact::JointContact bodies(socket({0, 0, 0}, 24, 30, 4), sphere({0, 0, 0}, 23.5, 4));
  const std::vector<double> time_s{0, 1};
  const std::vector<Pose> X_FM{Pose::Identity(), pose(about(Vec3(1, 2, 3).normalized(), 1.75), {0.1, 0, 0})};
  const RecordedContact found = contact_between(bodies, time_s, X_FM);
  EXPECT_TRUE(found.contacts.empty());
  EXPECT_LT(found.poses, 10u);
}

TEST(RecordedContact, IsOnlyPossibleWhereSurfacesPassWithinTheResolution) {
  // Two cubes pass with 1e-10 mm between their faces: less than what rounding may hide.
  const contact::JointContact bodies(box({0, 0, 0}, {1, 1, 1}), box({0, 0, 0}, {1, 1, 1}));
  const auto at = [](double x) { return pose(Eigen::Matrix3d::Identity(), {x, 1 + 1e-10, 0.1}); };
  const std::vector<double> time_s{0, 1};
  const std::vector<Pose> X_FM{at(-3), at(2)};
  const RecordedContact found = contact_between(bodies, time_s, X_FM, {.resolution_s = 1e-2});
  ASSERT_EQ(found.contacts.size(), 1u);
  const ContactInterval& contact = found.contacts.front();
  EXPECT_FALSE(contact.is_certain);
  EXPECT_EQ(contact.entry.kind, ContactEndKind::bounded);
  EXPECT_NEAR(contact.entry.time_s, 0.4, 1e-2);
  EXPECT_NEAR(contact.exit.time_s, 0.8, 1e-2);
  EXPECT_EQ(contact.entry.uncertainty_s, contact.exit.time_s - contact.entry.time_s);
  EXPECT_FALSE(contact.entry.contact);
}

TEST(RecordedContact, IsTheSameToTheByteOnOneThreadAndMany) {
  Random random(3);
  const Joint joint = bumpy_joint(Side::right);
  const contact::JointContact bodies(joint);
  Recording recording = random_recording(random, 6, 0.5, 0);
  for (std::size_t i = 3; i < 6; ++i) recording.X_FM[i].translation().x() += static_cast<double>(i) - 2;
  const auto bits = [&] {
    std::vector<double> out;
    for (const ContactInterval& c : contact_between(bodies, recording.time_s, recording.X_FM).contacts)
      for (const ContactEnd* end : {&c.entry, &c.exit}) {
        out.insert(out.end(), {end->time_s, end->uncertainty_s, end->turned.radians(), c.undecided_s});
        if (end->contact) out.push_back(end->contact->fixed_point.x());
      }
    return out;
  };
  const auto many = bits();
  const core::ThreadLimit one_thread(1);
  EXPECT_EQ(bits(), many);
  EXPECT_GT(many.size(), 8u);
}

TEST(RecordedContact, ReportsItsProgressAndEndsWhereItIsStopped) {
  Random random(7);
  const ToothMotion motion = ToothMotion::any(random, 2e-3, Vec3::Zero());
  std::stop_source stop;
  std::size_t seen = 0;
  const auto found = contact_between(motion.bodies, motion.time_s, motion.X_FM, {},
                                     {.progress =
                                          [&](std::string_view, std::size_t done, std::size_t total) {
                                            EXPECT_EQ(done, ++seen);
                                            EXPECT_EQ(total, 4u);
                                            stop.request_stop();
                                          },
                                      .stop = stop.get_token()});
  EXPECT_FALSE(found);
  EXPECT_GE(seen, 1u);
}

TEST(RecordedContact, RefusesWhatIsNoRecording) {
  const contact::JointContact bodies(box({0, 0, 0}, {1, 1, 1}), box({2, 0, 0}, {3, 1, 1}));
  const Pose I = Pose::Identity();
  const auto refused = [&](std::vector<double> time_s, std::vector<Pose> X_FM, const std::string& message,
                           const RecordedContactOptions& options = {}) {
    try {
      contact_between(bodies, time_s, X_FM, options);
      ADD_FAILURE() << message;
    } catch (const UsageError& error) {
      EXPECT_EQ(error.what(), "recorded motion: " + message);
    }
  };
  refused({0}, {I}, "needs two samples or more");
  refused({0, 1}, {I}, "2 times and 1 poses");
  refused({0, 1, 1}, {I, I, I}, "sample 2: its time is not after the one before");
  refused({0, NAN}, {I, I}, "sample 1: its time is not finite");
  refused({0, 1}, {I, pose(I.linear(), {0, INFINITY, 0})}, "sample 1: its translation is not finite");
  refused({0, 1}, {pose(-I.linear(), {0, 0, 0}), I}, "sample 0: its rotation is none");
  refused({0, 1}, {pose(I.linear() * 1.001, {0, 0, 0}), I}, "sample 0: its rotation is none");
  refused({0, 1, 2}, {I, I, pose(about(Vec3::UnitX(), pi), {0, 0, 0})},
          "samples 1 and 2 are more than 179 degrees apart: which way round is not known");
  refused({0, 1}, {I, I}, "the resolution must be above 0 s", {.resolution_s = 0});
}

}  // namespace
}  // namespace condyle::motion
