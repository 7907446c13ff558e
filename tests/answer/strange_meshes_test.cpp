#include "condyle/answer.hpp"
#include "condyle/joint_checks.hpp"
#include "support/revolved_hip.hpp"
#include "support/test.hpp"

/// Files that are not one clean adult bone in millimetres: surfaces inside others, specks, second bones, other units, other sizes. Limits are
/// those of the clean joint, or a note says what moved them.

namespace condyle {
namespace {

using namespace test;
using Codes = std::vector<std::string>;

const RevolvedHip hip;

struct Answered {
  double abduction_deg = 0, adduction_deg = 0;
  std::optional<double> bearing_deg = {};
  motion::ContactKind kind = motion::ContactKind::unknown;
  Vec3 centre = Vec3::Zero();  ///< of the joint in the frame of the meshes
  Codes codes = {};            ///< of the joint's notes, then of its limits'
};

JointDescription description(bool is_fitted = false, BodyRole fit_body = BodyRole::mobile) {
  JointDescription joint{.name = "hip"};
  if (is_fitted)
    joint.frame.centre = CentreFit{.body = fit_body};
  else
    joint.frame.centre.emplace<Vec3>(Vec3::Zero());
  return joint;
}

Answered answered(TriMesh fixed, TriMesh mobile, const JointDescription& described = description()) {
  const auto [joint, placement] =
      make_joint(described, {"hip bone", std::move(fixed)}, {"femur", std::move(mobile)});
  RangeRequest request;
  for (const motion::Motion& motion : motion::hip_motions())
    if (motion.name == "abduction" || motion.name == "adduction") request.motions.push_back(motion);
  const RangeAnswer range = answer_range({joint, placement}, request);
  Answered out;
  for (const motion::MotionLimit& limit : range.limits)
    (limit.motion.name == "abduction" ? out.abduction_deg : out.adduction_deg) = limit.end.turned.degrees();
  if (range.limits[0].end.bearing_contact)
    out.bearing_deg = range.limits[0].end.bearing_contact->turned.degrees();
  if (range.limits[0].end.contact) out.kind = range.limits[0].end.contact->kind;
  out.centre = placement.X_WF.translation();
  for (const JointNote& note : check_joint(joint, placement)) out.codes.emplace_back(name_of(note.code));
  for (const RangeNote& note : range.notes) out.codes.emplace_back(name_of(note.code));
  return out;
}

bool has(const Codes& codes, const char* code) {
  return std::find(codes.begin(), codes.end(), code) != codes.end();
}

/// Roots of trigonometric equations of coordinates near 30 mm.
constexpr double rounding_deg = 1e-9;

void expect_closed_form(const Answered& found) {
  EXPECT_NEAR(found.abduction_deg, hip.limit_deg(), rounding_deg);
  EXPECT_NEAR(found.adduction_deg, hip.limit_deg(), rounding_deg);
}

TEST(StrangeMeshes, TheCleanHipEndsWhereTheClosedFormSays) {
  const Answered clean = answered(hip.hip_bone(), hip.femur());
  expect_closed_form(clean);
  ASSERT_TRUE(clean.bearing_deg);
  EXPECT_NEAR(*clean.bearing_deg, hip.bearing_contact_deg(), 4);
  for (const char* code :
       {"nested_surfaces", "separate_pieces", "limit_on_piece", "unlikely_size", "units_disagree"})
    EXPECT_FALSE(has(clean.codes, code)) << code;
}

TEST(StrangeMeshes, ASurfaceInsideAnotherIsNoHeadWhicheverWayItIsWound) {
  for (const double radius : {4.0, 12.0, 18.0, 21.0}) {
    const TriMesh ball = sphere({0.5, 0.3, -0.4}, radius, 3);
    const Answered outwards = answered(hip.hip_bone(), joined(hip.femur(), ball));
    expect_closed_form(outwards);
    EXPECT_TRUE(has(outwards.codes, "nested_surfaces"));
    const Answered cavity = answered(hip.hip_bone(), joined(hip.femur(), flipped(ball)));
    expect_closed_form(cavity);
    EXPECT_EQ(has(cavity.codes, "nested_surfaces"), radius > 8) << "a pore is no reason for a note";
    EXPECT_FALSE(has(cavity.codes, "separate_pieces"));
  }
}

TEST(StrangeMeshes, ASecondWallWithinTheBonesChangesNoFitAndNoLimit) {
  for (const double share : {0.9, 0.95})
    for (const bool is_fitted : {false, true}) {
      // The wall of the socket lies between its surfaces; that of the femur about the head's centre.
      RevolvedHip wall = hip;
      wall.inner = hip.inner + 2, wall.outer = hip.outer - 2, wall.rim_deg = hip.rim_deg + 5, wall.bump = 0.5;
      const Answered found =
          answered(joined(hip.hip_bone(), wall.hip_bone()),
                   joined(hip.femur(), scaled_by(hip.femur(), share)), description(is_fitted));
      expect_closed_form(found);
      EXPECT_LT(found.centre.norm(), rounding_deg);
      EXPECT_EQ(std::count(found.codes.begin(), found.codes.end(), "nested_surfaces"), 2);
    }
}

TEST(StrangeMeshes, ABallBesideTheCentreDoesNotMoveAFittedCentre) {
  const Answered found =
      answered(hip.hip_bone(), joined(hip.femur(), sphere({4, 3, -2}, 12, 4)), description(true));
  expect_closed_form(found);
  EXPECT_LT(found.centre.norm(), rounding_deg);
}

TEST(StrangeMeshes, ASurfaceInsideAnOpenBoneIsNoHeadEither) {
  TriMesh open = hip.femur();
  std::erase_if(open.triangles, [&](const Triangle& t) {
    return open.vertices.z[t[0]] == hip.length && open.vertices.z[t[1]] == hip.length &&
           open.vertices.z[t[2]] == hip.length;
  });
  ASSERT_FALSE(inspect(open).is_closed());
  const Answered found = answered(hip.hip_bone(), joined(open, sphere({0, 0, 0}, 15, 3)));
  expect_closed_form(found);
  EXPECT_TRUE(has(found.codes, "nested_surfaces"));
}

TEST(StrangeMeshes, ALimitOnASpeckSaysSo) {
  // In the way of the neck at 30 degrees, outside of the socket.
  const double at = (hip.rim_deg - 30) * std::numbers::pi / 180;
  const Vec3 place = 45 * Vec3(0, std::sin(at), std::cos(at));
  const TriMesh speck = box(place - Vec3::Constant(0.3), place + Vec3::Constant(0.3));
  const Answered found = answered(joined(hip.hip_bone(), speck), hip.femur());
  EXPECT_LT(std::min(found.abduction_deg, found.adduction_deg), hip.limit_deg() - 10);
  EXPECT_TRUE(has(found.codes, "separate_pieces"));
  EXPECT_TRUE(has(found.codes, "limit_on_piece"));
  const Answered largest = answered(largest_piece(joined(hip.hip_bone(), speck)), hip.femur());
  expect_closed_form(largest);
  EXPECT_FALSE(has(largest.codes, "separate_pieces"));
}

TEST(StrangeMeshes, ASpeckOutOfTheWayIsNotedAndMovesNothing) {
  const Answered found =
      answered(joined(hip.hip_bone(), box({-0.3, -0.3, -60.3}, {0.3, 0.3, -59.7})), hip.femur());
  expect_closed_form(found);
  EXPECT_TRUE(has(found.codes, "separate_pieces"));
  EXPECT_FALSE(has(found.codes, "limit_on_piece"));
}

TEST(StrangeMeshes, OfTwoSocketsTheCentreIsThatOfTheOneWithTheHead) {
  const Vec3 away(0, 0, -180);
  TriMesh other = hip.hip_bone();
  for (std::size_t v = 0; v < other.vertices.size(); ++v)
    other.vertices.set(v, Vec3(other.vertices.x[v], other.vertices.y[v], -other.vertices.z[v]) + away);
  other = flipped(other);
  for (const bool other_first : {false, true}) {
    const TriMesh pelvis = other_first ? joined(other, hip.hip_bone()) : joined(hip.hip_bone(), other);
    const Answered found = answered(pelvis, hip.femur(), description(true, BodyRole::fixed));
    expect_closed_form(found);
    EXPECT_LT(found.centre.norm(), 1e-6);
    EXPECT_TRUE(has(found.codes, "separate_pieces"));
  }
  // And of two legs the one in the socket.
  TriMesh leg = hip.femur();
  for (std::size_t v = 0; v < leg.vertices.size(); ++v)
    leg.vertices.set(v, Vec3(leg.vertices.x[v], leg.vertices.y[v], -leg.vertices.z[v]) + away);
  const Answered found = answered(hip.hip_bone(), joined(flipped(leg), hip.femur()), description(true));
  expect_closed_form(found);
  EXPECT_LT(found.centre.norm(), 1e-6);
  EXPECT_TRUE(has(found.codes, "separate_pieces"));
}

TEST(StrangeMeshes, TheOtherLegInTheMovingMeshIsNamedWhereItEndsAMotion) {
  const auto with_other = [](const TriMesh& mesh) { return joined(mesh, shifted_by(mesh, {0, 0, -180})); };
  const Answered found = answered(with_other(hip.hip_bone()), with_other(hip.femur()));
  EXPECT_LT(found.abduction_deg, 5);
  EXPECT_EQ(std::count(found.codes.begin(), found.codes.end(), "limit_on_piece"), 2) << "one for each body";
  const Answered at_joint = answered(piece_at(with_other(hip.hip_bone()), Vec3::Zero()),
                                     piece_at(with_other(hip.femur()), Vec3::Zero()));
  expect_closed_form(at_joint);
}

TEST(StrangeMeshes, LimitsDoNotDependOnTheSizeOfTheHip) {
  for (const double scale : {0.02, 0.05, 0.1, 0.3, 0.7, 1.3, 3.0, 10.0}) {
    const Answered found = answered(scaled_by(hip.hip_bone(), scale), scaled_by(hip.femur(), scale));
    expect_closed_form(found);
    ASSERT_TRUE(found.bearing_deg) << scale;
    EXPECT_EQ(found.kind, motion::ContactKind::impingement) << scale;
  }
}

TEST(StrangeMeshes, AChildsHeadIsNoReasonForANote) {
  const Answered found = answered(scaled_by(hip.hip_bone(), 0.4), scaled_by(hip.femur(), 0.4));
  EXPECT_FALSE(has(found.codes, "unlikely_size"));
  EXPECT_FALSE(has(found.codes, "units_disagree"));
}

TEST(StrangeMeshes, OtherUnitsAreNotedWithTheLikelyOne) {
  struct Unit {
    double factor;
    const char* word;
  };
  for (const auto& [factor, word] :
       {Unit{0.1, "centimetres"}, Unit{1 / 25.4, "inches"}, Unit{1e-3, "metres"}}) {
    const auto [joint, placement] = make_joint(description(), {"hip bone", scaled_by(hip.hip_bone(), factor)},
                                               {"femur", scaled_by(hip.femur(), factor)});
    std::string texts;
    for (const JointNote& note : check_joint(joint, placement))
      if (note.code == JointNoteCode::unlikely_size) texts += note.text + "\n";
    EXPECT_NE(texts.find(word), std::string::npos) << word << ": " << texts;
  }
}

TEST(StrangeMeshes, BonesInTwoUnitsAreNotedAndTheOneToScaleIsNamed) {
  for (const bool is_femur : {true, false})
    for (const double factor : {0.1, 1 / 25.4}) {
      const auto [joint, placement] =
          make_joint(description(), {"hip bone", scaled_by(hip.hip_bone(), is_femur ? 1 : factor)},
                     {"femur", scaled_by(hip.femur(), is_femur ? factor : 1)});
      std::string text;
      for (const JointNote& note : check_joint(joint, placement))
        if (note.code == JointNoteCode::units_disagree) text = note.text;
      EXPECT_NE(text.find(is_femur ? "is femur in" : "is hip bone in"), std::string::npos) << text;
      EXPECT_NE(text.find(factor == 0.1 ? "centimetres" : "inches"), std::string::npos) << text;
    }
}

TEST(StrangeMeshes, WallsInsideRealBonesChangeNoLimitOfThem) {
  FOUND_OR_SKIP(data, test::shared_data());
  const auto folder = *data / "hip_vhf_right";
  const TriMesh bone = read_ply(folder / "hip_bone.ply"), femur = read_ply(folder / "femur.ply");
  const auto inwards = [](const TriMesh& mesh, double by) {
    std::vector<Vec3> normals(mesh.vertices.size(), Vec3::Zero());
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
      const Vec3 area = (mesh.corner(t, 1) - mesh.corner(t, 0)).cross(mesh.corner(t, 2) - mesh.corner(t, 0));
      for (const Index v : mesh.triangles[t]) normals[v] += area;
    }
    TriMesh wall = mesh;
    for (std::size_t v = 0; v < normals.size(); ++v)
      if (normals[v].norm() > 0) wall.vertices.set(v, mesh.vertices[v] - by * normals[v].normalized());
    return wall;
  };
  const JointDescription fitted = description(true);
  const Answered clean = answered(bone, femur, fitted);
  for (const double by : {1.0, 3.0}) {
    const Answered walled =
        answered(joined(bone, inwards(bone, by)), joined(femur, inwards(femur, by)), fitted);
    EXPECT_EQ(walled.abduction_deg, clean.abduction_deg) << by;
    EXPECT_EQ(walled.adduction_deg, clean.adduction_deg) << by;
    EXPECT_TRUE(has(walled.codes, "nested_surfaces"));
  }
}

}  // namespace
}  // namespace condyle
