#include "condyle/pressure.hpp"
#include "support/test.hpp"

/// Cartilages of a real hip under what a pelvis puts on it while standing: rays at their rims begin and cease to meet as the hip
/// flexes, so forces and energies jump.

namespace condyle::contact {
namespace {

struct Way {
  Casting casting;
  FaceRule rule;
  int balanced;  ///< at least, of 31 angles; sums rounded in another order may take some off
};

class HipBalance : public testing::TestWithParam<Way> {};

TEST_P(HipBalance, CarriesTheLoadAtEveryAngle) {
  FOUND_OR_SKIP(data, test::shared_data());
  const auto layer = [&](const char* name) {
    return Mesh(test::read_ply(*data / "hip_libhip_m1_left" / name));
  };
  const ElasticLayer cartilage{12, 0.42, 1.5};
  const ElasticContact contact(layer("acetabular_cartilage_gap.ply"), layer("femur_cartilage_gap.ply"),
                               {.casting = GetParam().casting,
                                .rays = {.rule = GetParam().rule},
                                .fixed = cartilage,
                                .mobile = cartilage});
  const Load stance{.on_mobile = {.force_n = {0, 1700, 500}}};
  double deepest = 0;
  int balanced = 0;
  for (int degrees = -30; degrees <= 30; degrees += 2) {
    Pose X = Pose::Identity();
    X.linear() = Eigen::AngleAxisd(degrees * std::numbers::pi / 180, Vec3::UnitZ()).toRotationMatrix();
    const BalancedPose pose = balance(contact, X, stance);
    EXPECT_TRUE(pose.carries_load()) << degrees << ": " << reason_of(pose);
    balanced += pose.outcome == BalanceOutcome::balanced;
    for (const auto* surface : {&pose.contact.fixed, &pose.contact.mobile})
      if (*surface) deepest = std::max(deepest, (*surface)->totals.max_depth_mm);
  }
  EXPECT_GE(balanced, GetParam().balanced);
  // Centres of faces come to 1.2 mm. Edges are 2 mm long, corners 1.2 mm from centres: 0.3 mm deeper at a slope of a quarter, the
  // steepest that a rim is taken to have.
  EXPECT_LE(deepest, 1.5);
}

std::string name_of_kind(const testing::TestParamInfo<Way>& info) {
  constexpr std::array names = {"Fixed", "Mobile", "Both"};
  return names[static_cast<std::size_t>(info.param.casting)] +
         std::string(info.param.rule == FaceRule::face_centre ? "FaceCentre" : "CutFaces");
}

INSTANTIATE_TEST_SUITE_P(Ways, HipBalance,
                         testing::Values(Way{Casting::fixed, FaceRule::face_centre, 29},
                                         Way{Casting::fixed, FaceRule::cut_faces, 30},
                                         Way{Casting::mobile, FaceRule::face_centre, 29},
                                         Way{Casting::mobile, FaceRule::cut_faces, 30},
                                         Way{Casting::both, FaceRule::cut_faces, 30}),
                         name_of_kind);

TEST(RefusedLoad, LeavesNoMoreOnBonesThanWasApplied) {
  FOUND_OR_SKIP(data, test::shared_data());
  const ElasticLayer soft{12, 0.42, 1.5};
  const ElasticContact contact(Mesh(test::read_ply(*data / "hip_vhf_right" / "hip_bone.ply")),
                               Mesh(test::read_ply(*data / "hip_vhf_right" / "femur.ply")),
                               {.fixed = soft, .mobile = soft});
  for (const Vec3& force : {Vec3(0, -1500, 0), Vec3(0, 1e-3, 0), Vec3(0, 0, 800), Vec3(0, 1e5, 0)}) {
    const BalancedPose pose = balance(contact, Pose::Identity(), {.on_mobile = {.force_n = force}});
    if (pose.carries_load()) continue;
    EXPECT_LE(pose.residual.force_n.norm(), force.norm() * (1 + 1e-12))
        << force.transpose() << ": " << reason_of(pose);
  }
}

}  // namespace
}  // namespace condyle::contact
