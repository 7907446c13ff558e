#include <variant>

#include "answer/depth_meshes.hpp"
#include "condyle/answer.hpp"
#include "condyle/make_joint.hpp"
#include "support/test.hpp"

/// One answer for every shell: depths as their own functions give them, with the caveats that they must be read with.

namespace condyle::test {
namespace {

/// A wall in front of the joint, x = 40, and an arm that hangs from the centre along -y and is flexed into it.
class DepthAnswers : public ::testing::Test {
 protected:
  const Joint joint{.name = "arm",
                    .kind = JointKind::ball,
                    .side = Side::right,
                    .fixed = {"wall", box({40, -120, -50}, {60, -20, 50})},
                    .mobile = {"arm", box({-1, -100, -2}, {1, -10, 2})}};
  const contact::JointContact bodies{joint};
  const JointAngles pose{Angle::degrees(25), {}, {}};
  const Pose X_FM = pose_at(joint.coordinates(), pose);
};

TEST_F(DepthAnswers, AreThoseOfTheirOwnFunctions) {
  const contact::RadialContact contact = bodies.radial(X_FM);
  const contact::ContactMeasures measures = contact::measure_contact(
      bodies, X_FM, contact::MeasuredContact(contact), contact::DistancesOf::vertices_inside);
  const contact::ReliableContact expected =
      contact::reliable_depths(bodies, joint.kind, joint.coordinates(), pose, contact, measures.distances);

  const DepthAnswer answer = answer_depth(bodies, joint, {.X_FM = X_FM, .pose = pose});
  const auto& rays = std::get<RayDepths>(answer.depths);
  EXPECT_TRUE(answer.in_contact());
  EXPECT_EQ(rays.reliable.mobile->depth_mm, expected.mobile->depth_mm);
  EXPECT_EQ(rays.reliable.mobile->kind, expected.mobile->kind);
  EXPECT_EQ(answer.measures.volume_mm3, measures.volume_mm3);
  EXPECT_TRUE(answer.caveats.empty());

  const DepthAnswer by_joint = answer_depth(joint, {.X_FM = X_FM, .pose = pose});
  EXPECT_EQ(std::get<RayDepths>(by_joint.depths).reliable.mobile->depth_mm, expected.mobile->depth_mm);
}

TEST_F(DepthAnswers, SayWhereTheyEndOnAFaceInWhichAPartIsCut) {
  const auto caveats = [&](double height, DepthMethod method) {
    JointDescription description{.name = "arm", .kind = JointKind::ball, .side = Side::right};
    PosedPart top{.name = "top", .body = BodyRole::fixed};
    top.parameters = {{.name = "tilt", .kind = ParameterKind::tilt, .low = -9, .high = 9}};
    top.cut = {{{50, height, 0}, {0, -1, 0}}};
    description.parts = {{top}};
    const Joint cut = make_joint(description, {"wall", joint.fixed.mesh}, {"arm", joint.mobile.mesh}).joint;
    return answer_depth(cut, {.X_FM = X_FM, .pose = pose, .method = method}).caveats;
  };
  // The arm's end is in the wall between 86 and 92 mm below the joint.
  const std::string sentence =
      "arm meets a face in which a part of wall is cut: depths end there, and contact areas count it";
  EXPECT_EQ(caveats(-60, DepthMethod::reliable), std::vector<std::string>{});
  EXPECT_EQ(caveats(-88, DepthMethod::reliable), std::vector<std::string>{sentence});
  EXPECT_EQ(caveats(-88, DepthMethod::tangential), std::vector<std::string>{sentence});
  EXPECT_EQ(caveats(-88, DepthMethod::normal).back(), sentence);
}

TEST_F(DepthAnswers, WithoutMeasuresHaveTheSameDepths) {
  const DepthAnswer whole = answer_depth(bodies, joint, {.X_FM = X_FM, .pose = pose});
  const DepthAnswer quick =
      answer_depth(bodies, joint, {.X_FM = X_FM, .pose = pose, .measures = MeasuresOf::distances_only});
  EXPECT_EQ(std::get<RayDepths>(quick.depths).reliable.mobile->depth_mm,
            std::get<RayDepths>(whole.depths).reliable.mobile->depth_mm);
  EXPECT_EQ(std::get<RayDepths>(quick.depths).reliable.fixed->depth_mm,
            std::get<RayDepths>(whole.depths).reliable.fixed->depth_mm);
  EXPECT_TRUE(whole.measures.volume_mm3);
  EXPECT_FALSE(quick.measures.volume_mm3);
}

TEST_F(DepthAnswers, SummariesWithKnownDistancesAreTheSame) {
  const contact::RadialContact contact = bodies.radial(X_FM);
  const contact::RadialSummary searched = contact::summarise(bodies, X_FM, contact);
  const contact::RadialSummary known =
      contact::summarise(contact, nearest_distances(bodies, X_FM, contact::MeasuredContact(contact),
                                                    contact::DistancesOf::vertices_inside));
  ASSERT_TRUE(searched.mobile->deepest && known.mobile->deepest);
  EXPECT_EQ(known.mobile->deepest->shortest_exit_mm, searched.mobile->deepest->shortest_exit_mm);
  EXPECT_EQ(known.mobile->oblique_inside, searched.mobile->oblique_inside);
  EXPECT_EQ(known.fixed->vertices_inside, searched.fixed->vertices_inside);
  EXPECT_EQ(known.mobile->min_gap_mm, searched.mobile->min_gap_mm);
}

TEST_F(DepthAnswers, AlongArcsAreAboutTheAxisRequested) {
  const auto about = [&](std::optional<contact::ArcsAbout> axis) {
    const DepthAnswer answer = answer_depth(
        bodies, joint, {.X_FM = X_FM, .pose = pose, .method = DepthMethod::tangential, .about = axis});
    return std::get<ArcDepths>(answer.depths);
  };
  EXPECT_EQ(about({}).axis.about, JointAngle::flexion);
  for (const JointAngle angle : all_joint_angles) {
    const ArcDepths arcs = about(angle);
    const Vec3 axis = axis_of(angle, joint.coordinates(), pose);
    EXPECT_EQ(arcs.axis.direction_F, axis);
    EXPECT_EQ(arcs.contact.mobile_in_fixed->arc_gap_mm,
              bodies.tangential(X_FM, axis).mobile_in_fixed->arc_gap_mm);
  }
}

TEST_F(DepthAnswers, AlongNormalsAreOfTheBodyThatCasts) {
  const DepthAnswer answer = answer_depth(bodies, joint,
                                          {.X_FM = X_FM,
                                           .method = DepthMethod::normal,
                                           .casting = contact::Casting::mobile,
                                           .rays = {{contact::FaceRule::face_centre, 30}}});
  const auto& found = std::get<contact::NormalContact>(answer.depths);
  EXPECT_TRUE(answer.in_contact());
  EXPECT_FALSE(found.fixed);
  const contact::NormalContact expected =
      contact::normal_contact(bodies, X_FM, contact::Casting::mobile, {contact::FaceRule::face_centre, 30});
  EXPECT_EQ(found.mobile->surface.totals.area_mm2, expected.mobile->surface.totals.area_mm2);
  ASSERT_EQ(answer.caveats.size(), 1u);
  EXPECT_NE(answer.caveats.front().find("same casting surface and rule"), std::string::npos);
}

TEST_F(DepthAnswers, SayThatABodyWasTranslated) {
  Pose moved = X_FM;
  moved.translation() = Vec3(0, 0.3, -0.4);
  const auto caveats = [&](DepthMethod method) {
    return answer_depth(bodies, joint, {.X_FM = moved, .pose = pose, .method = method}).caveats;
  };
  ASSERT_EQ(caveats(DepthMethod::reliable).size(), 1u);
  EXPECT_NE(caveats(DepthMethod::reliable).front().find("centre is 0.500 mm from"), std::string::npos);
  EXPECT_NE(caveats(DepthMethod::reliable).front().find("no depths along arcs"), std::string::npos);
  EXPECT_EQ(caveats(DepthMethod::radial).front().find("no depths along arcs"), std::string::npos);
  EXPECT_THROW(caveats(DepthMethod::tangential), UsageError);
  const contact::AxisLine line{{0, 0, -4}, {3, -5, 7}};
  const DepthRequest about_line{.X_FM = moved, .method = DepthMethod::tangential, .about = line};
  const auto arcs = std::get<ArcDepths>(answer_depth(bodies, joint, about_line).depths);
  EXPECT_EQ(arcs.axis.direction_F, Vec3(0, 0, -1));
  EXPECT_EQ(arcs.contact.mobile_in_fixed, bodies.tangential(moved, line).mobile_in_fixed);
}

TEST_F(DepthAnswers, RefuseOptionsOfAnotherMethod) {
  EXPECT_THROW(check_depth_request(joint, {.about = JointAngle::flexion}), UsageError);
  EXPECT_THROW(check_depth_request(joint, {.casting = contact::Casting::both}), UsageError);
  EXPECT_THROW(
      check_depth_request(joint, {.method = DepthMethod::tangential, .rays = contact::NormalDepthOptions{}}),
      UsageError);
  check_depth_request(joint, {.method = DepthMethod::tangential, .about = JointAngle::adduction});
}

TEST_F(DepthAnswers, AreThoseOfThePoseWithoutItsAngles) {
  const auto depths = [&](const DepthRequest& request) {
    return std::get<RayDepths>(answer_depth(bodies, joint, request).depths).reliable.mobile->depth_mm;
  };
  const std::vector<double> given = depths({.X_FM = X_FM, .pose = pose}), found = depths({.X_FM = X_FM});
  ASSERT_EQ(found.size(), given.size());
  // Angles that a rotation is split into are off by some 2^-52, at arms of 120 mm.
  for (std::size_t v = 0; v < given.size(); ++v) EXPECT_NEAR(found[v], given[v], 120 * 0x1p-48);
  EXPECT_GT(*std::max_element(found.begin(), found.end()), 1);
}

TEST_F(DepthAnswers, RefuseAnglesOfAnotherPose) {
  EXPECT_THROW(answer_depth(bodies, joint, {.X_FM = X_FM, .pose = JointAngles{}}), UsageError);
  JointAngles nearly = pose;
  nearly.flexion = Angle::radians(pose.flexion.radians() + 1e-8);
  EXPECT_THROW(answer_depth(bodies, joint, {.X_FM = X_FM, .pose = nearly}), UsageError);
  nearly.flexion = Angle::radians(pose.flexion.radians() + 1e-10);
  answer_depth(bodies, joint, {.X_FM = X_FM, .pose = nearly});
}

TEST(DepthAnswer, OfAnOpenBodyHasNothingInsideIt) {
  const Joint joint{.name = "sheet",
                    .kind = JointKind::ball,
                    .side = Side::right,
                    .fixed = {"sheet", plane(20, 8)},
                    .mobile = {"ball", sphere({0, 1, 0}, 5, 3)}};
  const DepthAnswer answer = answer_depth(joint, {});
  const auto& rays = std::get<RayDepths>(answer.depths);
  EXPECT_TRUE(answer.in_contact());
  EXPECT_FALSE(rays.reliable.mobile);
  EXPECT_TRUE(rays.reliable.fixed);
  EXPECT_FALSE(answer.measures.volume_mm3);
}

/// A sheet, open but with an outer side, against a ball; and the sheet with one triangle wound against the others.
TEST(DepthMeshes, AreSolidsForDepthsAndHaveOuterSidesForNormals) {
  TriMesh wound = plane(20, 8);
  std::swap(wound.triangles[0][1], wound.triangles[0][2]);
  Joint joint{.name = "sheet",
              .kind = JointKind::ball,
              .side = Side::right,
              .fixed = {"sheet", plane(20, 8)},
              .mobile = {"ball", sphere({0, 1, 0}, 5, 3)}};
  const auto refusal = [&](DepthMethod method) -> std::pair<std::string, bool> {
    try {
      answer::require_depth_meshes(joint, method, {"sheet.ply", "ball.ply"});
    } catch (const answer::NoSolidError& error) {
      return {error.what(), error.normals_would_do};
    } catch (const MeshError& error) {
      return {error.what(), false};
    }
    return {};
  };
  EXPECT_TRUE(refusal(DepthMethod::normal).first.empty());
  for (const DepthMethod method : {DepthMethod::reliable, DepthMethod::radial, DepthMethod::tangential}) {
    EXPECT_TRUE(refusal(method).first.starts_with("sheet.ply: "));
    EXPECT_TRUE(refusal(method).second);
  }
  joint.fixed.mesh = wound;
  EXPECT_TRUE(refusal(DepthMethod::normal).first.starts_with("sheet.ply: "));
  EXPECT_FALSE(refusal(DepthMethod::reliable).second);
}

}  // namespace
}  // namespace condyle::test
