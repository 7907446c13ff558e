#include "condyle/io/model_file.hpp"
#include "condyle/joint_checks.hpp"
#include "condyle/sample/hip.hpp"
#include "support/knee_model.hpp"
#include "support/test.hpp"

/// Ligaments that are spoiled by mistakes that people make are noted, and sound ones are not.

namespace condyle {
namespace {

void set_slack(Ligament& ligament, double share) {
  ligament.slack_length_mm = 1;
  ligament.slack_length_mm = share * ligament_state(ligament, Pose::Identity())->length_mm;
}

struct Mistake {
  const char* name;
  std::function<void(Ligament&)> make;
  bool keeps_length =
      false;  ///< The slack length is as given; else it follows from where the points are now.
};

/// Twenty kinds in joints whose bodies lie as given at zero. `inside` is deep in the mobile body, and strings along x run through it there.
std::vector<Mistake> mistakes(const Vec3& inside, std::mt19937& random) {
  const auto points = [](std::function<Vec3(const Vec3&)> map) {
    return [map](Ligament& l) { l.fixed[0] = map(l.fixed[0]), l.mobile[0] = map(l.mobile[0]); };
  };
  const auto scaled = [=](double by) { return points([by](const Vec3& p) -> Vec3 { return by * p; }); };
  const auto slack = [](double by) { return [by](Ligament& l) { l.slack_length_mm *= by; }; };
  const auto far = [&random](double mm) -> Vec3 {
    std::normal_distribution<double> normal;
    return mm * Vec3(normal(random), normal(random), normal(random)).normalized();
  };
  const Vec3 x(60, 0, 0);
  return {
      {"points in metres", scaled(0.001)},
      {"points in centimetres", scaled(0.1)},
      {"points in inches", scaled(1 / 25.4)},
      {"points in micrometres", scaled(1000)},
      {"LPS for the joint's axes", points([](const Vec3& p) { return Vec3(-p.z(), -p.x(), p.y()); })},
      {"RAS for the joint's axes", points([](const Vec3& p) { return Vec3(p.z(), p.x(), p.y()); })},
      {"y and z exchanged", points([](const Vec3& p) { return Vec3(p.x(), p.z(), p.y()); })},
      {"of the other side", points([](const Vec3& p) { return Vec3(p.x(), p.y(), -p.z()); })},
      {"front and back exchanged", points([](const Vec3& p) { return Vec3(-p.x(), p.y(), p.z()); })},
      {"ends exchanged", [](Ligament& l) { std::swap(l.fixed, l.mobile); }},
      {"both ends on the mobile body", [](Ligament& l) { l.fixed[0] = l.mobile[0] + Vec3(0, 1, 0); }},
      {"one end 300 mm away", [=](Ligament& l) { l.mobile[0] += far(300); }},
      {"both ends 300 mm away", [=](Ligament& l) { l.mobile[0] += far(300), l.fixed[0] += far(300); }},
      {"both ends inside", [=](Ligament& l) { l.fixed[0] = inside + far(3), l.mobile[0] = inside + far(3); }},
      {"through the body",
       [=](Ligament& l) {
         l.mobile.insert(l.mobile.end(), {inside - x + far(1), inside + x});
       }},
      {"a point 300 mm away", [=](Ligament& l) { l.mobile.push_back(l.mobile[0] + far(300)); }},
      {"end's strain in per cent", [](Ligament& l) { l.ends_at_strain = 10; }},
      {"transition strain in per cent", [](Ligament& l) { l.stiffness_n = 1000, l.transition_strain = 6; }},
      {"slack share in per cent", slack(100), true},
      {"slack length in metres", slack(0.001), true},
  };
}

/// The ligaments of a joint have no note, and each mistake has one, however often it is made.
void expect_notes(Joint joint, const Vec3& inside, std::size_t times) {
  std::mt19937 random(78);
  for (const JointNote& note : check_ligaments(joint, {})) ADD_FAILURE() << note.text;
  const std::vector<Ligament> sound = joint.ligaments;
  for (const Mistake& mistake : mistakes(inside, random))
    for (std::size_t k = 0; k < times; ++k) {
      Ligament wrong = sound[k % sound.size()];
      mistake.make(wrong);
      if (!mistake.keeps_length) set_slack(wrong, 1.05);
      joint.ligaments = {wrong};
      EXPECT_FALSE(check_ligaments(joint, {}).empty()) << mistake.name << ", " << k;
    }
}

TEST(LigamentChecks, NoteTwentyKindsOfMistakesOnAHipAndNothingElse) {
  const sample::SampleHip hip = sample::sample_hip({}, sample::Scenario::one);
  Joint joint{"hip", JointKind::ball, Side::right, {"hip bone", hip.hip_bone}, {"femur", hip.femur}};
  for (const auto& [fixed, mobile] : {std::pair(Vec3(30, 28, 8), Vec3(12, -38, 30)),
                                      {{-29, 6, 9}, {-14, -2, 49}},
                                      {{28, 24, 10}, {9, -42, 31}},
                                      {{-28, 6, 9}, {-11, -7, 51}},
                                      {{-29, -3, 1}, {-12, -9, 57}}}) {
    joint.ligaments.push_back({.name = "string", .fixed = {fixed}, .mobile = {mobile}});
    if (fixed.x() > 0) joint.ligaments.back().wrap = LigamentWrap{.radius_mm = 24};
    set_slack(joint.ligaments.back(), 1.05);
  }
  expect_notes(joint, {0, 0, 0}, 10);
}

TEST(LigamentChecks, NoteTwentyKindsOfMistakesOnAKneeAndNothingElse) {
  if (!test::has_knee_model()) GTEST_SKIP() << "no published knee in CONDYLE_DATA";
  const auto folder = std::filesystem::path(testing::TempDir()) / "ligament_checks";
  test::write_knee_model(folder, {"femur", "tibia"});
  io::ModelJointRequest request;
  request.joint = "knee_r";
  Joint knee = io::read_joint(io::read_model(folder / "lenhart2015.osim"), request).joint;
  const auto with = [](const Mesh& mesh, const char* bone) {
    return test::joined(mesh, test::read_ply(test::shared_data_folder() / "knee_lenhart2015_right" / bone));
  };
  knee.fixed.mesh = with(knee.fixed.mesh, "femur_bone.ply");
  knee.mobile.mesh = with(with(knee.mobile.mesh, "tibia_bone.ply"), "fibula_bone.ply");
  ASSERT_EQ(knee.ligaments.size(), 55u);
  EXPECT_TRUE(check_ligaments(knee, {}).empty());
  // Cruciate ligaments of the other side end on bone too: nothing shows that.
  std::erase_if(knee.ligaments, [](const Ligament& ligament) { return !ligament.name.starts_with("LCL"); });
  expect_notes(knee, {0, -45, 0}, 2);
}

}  // namespace
}  // namespace condyle
