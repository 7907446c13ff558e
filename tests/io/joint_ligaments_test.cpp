#include "condyle/answer.hpp"
#include "condyle/io/joint_file.hpp"
#include "condyle/io/mesh_file.hpp"
#include "condyle/joint_checks.hpp"
#include "condyle/limit_band.hpp"
#include "condyle/range_of_motion.hpp"
#include "support/joint_text.hpp"
#include "support/test.hpp"

/// [[ligament]] tables of joint files, and the motions that they end.

namespace condyle {
namespace {

using std::numbers::pi;

/// A ball of 24 mm in a socket of 25: nothing but a string ends its flexion.
class JointLigaments : public testing::Test {
 protected:
  void SetUp() override {
    io::write_mesh(folder_ / "fixed.ply", test::socket({0, 0, 0}, 25, 30, 3));
    io::write_mesh(folder_ / "mobile.ply", test::sphere({0, 0, 0}, 24, 3));
  }
  std::filesystem::path file(const std::string& tables) const {
    return folder_.file("joint.toml", test::joint_text({.more = tables}));
  }
  Joint joint(const std::string& tables) const { return io::read_joint(file(tables)).joint; }
  void expect_refused(const std::vector<test::Refusal>& all) const {
    for (const auto& [tables, says] : all) test::expect_says(test::joint_refusal(file(tables)), says);
  }

  const test::TemporaryFolder folder_;
};

const motion::Motion flexion{.name = "flexion", .range = Angle::degrees(180)};

/// From the front of the rim to the back of the ball's lower side: flexion, about z, winds it up.
const std::string straight = "[[ligament]]\nname = \"front\"\nfixed = [30, 0, 0]\nmobile = [30, 0, 0]\n";
const std::string string_over_ball =
    straight + "wrap = { shape = \"sphere\", body = \"mobile\", centre = [0, 0, 0], radius = 24 }\n";

TEST_F(JointLigaments, EndAMotionWhereTheirStrainDoes) {
  const double wraps_from = 2 * std::acos(24.0 / 30), tangents = 2 * std::sqrt(30.0 * 30 - 24 * 24);
  const double wanted = 1.9, length = tangents + 24 * (wanted - wraps_from);
  const Joint ball = joint(string_over_ball + "slack_length = " + std::to_string(length / 1.05) +
                           "\nends_at_strain = 0.05\n");
  const motion::RangeOfMotion range(ball);
  const motion::MotionLimit limit = range.limit(flexion);
  EXPECT_EQ(limit.end.reason, motion::LimitReason::ligament);
  EXPECT_EQ(limit.end.ligament, 0u);
  EXPECT_NEAR(limit.end.turned.radians(), wanted, 1e-6);  // six decimals of the slack length
  EXPECT_FALSE(limit.end.contact);
  const auto strain = [&](double t) {
    return ligament_state(ball.ligaments[0], pose_at(ball.coordinates(), {Angle::radians(t), {}, {}}))
        ->strain;
  };
  EXPECT_NEAR(strain(limit.end.turned.radians()), 0.05, 1e-12);

  // The same from a start at which it has more strain, and all that is free of a whole turn.
  motion::Motion from_beyond = flexion;
  from_beyond.start.flexion = Angle::radians(2.5);
  from_beyond.range = Angle::degrees(10);
  EXPECT_EQ(range.limit(from_beyond).end.reason, motion::LimitReason::strained_at_start);
  const auto free = range.free_angles(JointAngle::flexion, {Angle::radians(2.5), {}, {}},
                                      {Angle::degrees(-180), Angle::degrees(180)});
  ASSERT_FALSE(free.intervals.empty());
  for (const motion::FreeInterval& interval : free.intervals)
    for (const Angle end : {interval.low, interval.high}) EXPECT_LT(strain(2.5 + end.radians()), 0.05 + 1e-9);
}

TEST_F(JointLigaments, ThatNeverEndMotionsLeaveLimitsAsTheyAre) {
  const Joint without = joint(""), with = joint(string_over_ball + "slack_length = 20\nstiffness_n = 900\n");
  const motion::MotionLimit a = motion::RangeOfMotion(without).limit(flexion),
                            b = motion::RangeOfMotion(with).limit(flexion);
  EXPECT_EQ(a.end.turned, b.end.turned);
  EXPECT_EQ(a.end.reason, b.end.reason);
}

TEST_F(JointLigaments, EndTheMotionsOfABandToo) {
  const Joint ball = joint(string_over_ball + "slack_length = 40\nends_at_strain = 0.05\n");
  const Angle limit = motion::RangeOfMotion(ball).limit(flexion).end.turned;
  const auto about = motion::limits_about(ball, {&flexion, 1}, {}, std::vector<Vec3>{{0, 0, 0}, {0.4, 0, 0}});
  EXPECT_EQ(about[0].reason, motion::LimitReason::ligament);
  EXPECT_NEAR(about[0].turned.radians(), limit.radians(), 1e-9);
  EXPECT_EQ(about[1].reason, motion::LimitReason::ligament);
  EXPECT_GT(std::abs(about[1].turned.radians() - limit.radians()), 1e-4);
}

motion::LimitBand band_of_ligaments(const Joint& joint, std::size_t samples) {
  motion::BandOptions options{.samples = samples};
  options.sigma = {.centre_mm = 0, .axes = {}, .surface_mm = 0, .surface_voxels = 0};
  return motion::limit_bands(joint, {&flexion, 1}, {}, options).front();
}

TEST_F(JointLigaments, SpreadABandByWhatIsNotKnownOfTheirSlackLength) {
  const Joint ball =
      joint(string_over_ball + "slack_length = 40\nslack_sigma = 0.5\nends_at_strain = 0.05\n");
  const motion::LimitBand band = band_of_ligaments(ball, 400);
  // Wrapped over 24 mm, the angle grows with 1.05 times the slack length over the radius: 5 to 95 % are 3.29 deviations.
  EXPECT_NEAR((band.p95 - band.p5).radians(), 3.29 * 0.5 * 1.05 / 24, 0.002);
  EXPECT_NEAR(band.median.radians(), motion::RangeOfMotion(ball).limit(flexion).end.turned.radians(), 1e-3);
  EXPECT_EQ(band.width_from.parameters, band.p95 - band.p5);
}

TEST_F(JointLigaments, SpreadABandByWhatIsNotKnownOfTheirPoints) {
  // From 30 mm in front of the axis to 30 mm in front of it: at a turn by t its length is 60 sin(t / 2).
  const Joint ball = joint(straight + "slack_length = 40\npoint_sigma = 0.3\nends_at_strain = 0.05\n");
  const motion::LimitBand band = band_of_ligaments(ball, 2000);
  // Along the string either end displaces the length by one deviation, and the length's slope over the angle is 30 cos(t / 2).
  const double half = std::asin(42.0 / 60);
  EXPECT_NEAR((band.p95 - band.p5).radians(), 3.29 * 0.3 * std::sqrt(2.0) / (30 * std::cos(half)), 0.004);
  EXPECT_NEAR(band.median.radians(), 2 * half, 2e-3);
  EXPECT_EQ(band.width_from.parameters, band.p95 - band.p5);
}

TEST_F(JointLigaments, HaveOneOfThreeSlackLengths) {
  const std::string points =
      "[[ligament]]\nname = \"a\"\nfixed = [[0, 40, 0], [0, 30, 0]]\nmobile = [40, 0, 0]\n";
  EXPECT_DOUBLE_EQ(joint(points + "slack_length = 12.5\n").ligaments[0].slack_length_mm, 12.5);
  EXPECT_DOUBLE_EQ(joint(points + "slack_share = 0.9\n").ligaments[0].slack_length_mm, 0.9 * 60);
  EXPECT_NEAR(joint(points + "taut_at = \"flexion=90\"\n").ligaments[0].slack_length_mm, 20, 1e-12);
  expect_refused({{points, "ligament[0].slack_length: is missing"},
                  {points + "slack_length = 3\nslack_share = 1\n", "give one of"},
                  {points + "slack_length = 0\n", "must be above 0"},
                  {points + "slack_length = nan\n", "must be a finite number"},
                  {points + "taut_at = \"bending=9\"\n", "taut_at"}});
}

TEST_F(JointLigaments, ThatContradictTheirBonesOrTheirWordsAreNoted) {
  // Ends on the rim and 0.2 mm within 5 mm of the ball, and beyond; strings beside the ball, whose depth in it is 24 mm less its least distance.
  const std::string name = "[[ligament]]\nname = \"a\"\n", slack = "slack_share = 1.05\n",
                    off = "ligament_off_bone: ", through = "ligament_through_bone: ",
                    strain = "unlikely_strain: ",
                    sound = name + "fixed = [30, 0, 0]\nmobile = [20.3, -20.3, 0]\n";
  const auto below = [&](const char* y) {
    return name + "fixed = [30, 0, 0]\nmobile = [[-24, 0, 0], [-30, " + y + ", 0], [30, " + y + ", 0]]\n" +
           slack;
  };
  const std::vector<test::Refusal> all = {
      {sound + slack, ""},
      {name + "fixed = [30, 0, 0]\nmobile = [20.7, -20.7, 0]\n" + slack,
       off + "ligament a: its mobile end is 5.27 mm from"},
      {name + "fixed = [30, 0, 0]\nmobile = [27, -1, 0]\n" + slack, "and 1 mm from that of fixed"},
      {name + "fixed = [30, 0, 0]\nmobile = [[20, -20, 0], [0, -330, 0]]\n" + slack,
       "point 2 of mobile is 306"},
      {below("-21.2"), ""},
      {below("-20.8"), through + "ligament a: its straight part runs through mobile for 24 mm, up to 3 mm"},
      {sound + "slack_share = 1.5\n", ""},
      {sound + "slack_share = 1.51\n", strain + "ligament a: its slack length is 1.51 times"},
      {sound + "slack_share = 0.667\n", ""},
      {sound + "slack_share = 0.666\n", strain + "ligament a: its strain is 0.5015"},
      {sound + slack + "ends_at_strain = 0.5\n", ""},
      {sound + slack + "ends_at_strain = 10\n",
       strain + "ligament a: it ends motions at a strain of 10: 10 % is 0.1"},
      {sound + slack + "stiffness_n = 9\ntransition_strain = 6\n",
       strain + "ligament a: its transition strain is 6"},
      {sound + slack + "slack_sigma = 20\n", "deviation of its slack length"}};
  for (const auto& [ligament, expected] : all) {
    const io::LoadedJoint loaded = io::read_joint(file(ligament));
    std::string notes;
    for (const JointNote& note : check_joint(loaded.joint, loaded.report.placement))
      if (note.text.starts_with("ligament")) notes += std::string(name_of(note.code)) + ": " + note.text;
    EXPECT_EQ(notes.empty(), expected.empty()) << ligament << notes;
    test::expect_says(notes, expected);
  }
}

TEST_F(JointLigaments, ThatEndAMotionThroughBoneAreNotedWithTheLimit) {
  // At a turn by t the string is 60 sin(t / 2) long and 30 cos(t / 2) from the centre: 3.58 mm beneath the ball at 44 mm, 2.57 at 42.
  for (const double strain : {0.05, 0.1}) {
    const io::LoadedJoint ball = io::read_joint(
        file(straight + "slack_length = 40\nends_at_strain = " + std::to_string(strain) + "\n"));
    std::string notes;
    for (const RangeNote& note : answer_range(ball, {.motions = {flexion}}).notes)
      if (note.code == RangeNoteCode::limit_through_bone) notes += note.text;
    EXPECT_EQ(strain < 0.1,
              notes.find("flexion, where ligament front runs through mobile for 2") == notes.npos)
        << notes;
  }
}

TEST_F(JointLigaments, ThatNobodyCanMeanAreRefusedInOneLine) {
  const std::string a = "[[ligament]]\nname = \"a\"\nfixed = [40, 0, 0]\n",
                    b = a + "mobile = [0, 40, 0]\nslack_length = 60\n";
  const auto about = [&](std::string_view shape, std::string_view more) {
    return b + "wrap = { shape = \"" + std::string(shape) + "\", body = \"fixed\", centre = [0, 0, 0], " +
           std::string(more);
  };
  expect_refused(
      {{a + "slack_length = 3\n", "ligament[0].mobile: is missing"},
       {a + "mobile = [1, 2]\nslack_length = 3\n", "three numbers"},
       {a + "mobile = []\nslack_length = 3\n", "three numbers"},
       {b + b, "is given twice"},
       {b + "stiffness_n = -3\n", "must be above 0"},
       {b + "damping_n_s = -1\n", "ligament[0].damping_n_s: must be 0 or more"},
       {b + "transition_strain = -0.1\n", "must be 0 or more"},
       {b + "ends_at_strain = 0\n", "must be above 0"},
       {b + "wrap = \"neck\"\n", "head"},
       {b + "wrap = \"head\"\n", "no head is known here"},
       {about("torus", "radius = 3 }\n"), "cylinder"},
       {about("cylinder", "radius = 3 }\n"), "axis"},
       {about("sphere", "radius = 41 }\nends_at_strain = 0.1\n"), "inside its wrap"},
       {about("ellipsoid", "radii = [3, 4, 5], axes = [[1, 0, 0], [0, 1, 0]] }\nends_at_strain = 0.1\n"),
        "cannot end motions"},
       {a + "mobile = [0, 40, 0]\nslack_length = 40\nends_at_strain = 0.1\n",
        "in the reference pose already"},
       {b + "[[part]]\nname = \"cup\"\nbody = \"fixed\"\n[[part.parameter]]\nname = \"tilt\"\n"
            "range = [-5, 5]\n",
        "a joint with parts"}});
}

}  // namespace
}  // namespace condyle
