#include "condyle/brush.hpp"

#include "condyle/sample/hip.hpp"
#include "measure/analytic_hip.hpp"
#include "mesh/self_crossings.hpp"
#include "mesh/surface_distance.hpp"
#include "support/real_hip.hpp"
#include "support/test.hpp"

/// Strokes of a brush against closed forms, and what they must leave as it was.

namespace condyle::test {
namespace {

constexpr double R = 24;

Body ball() {
  return {"ball", sphere(Vec3::Zero(), R, 6)};
}

/// A plate of 2 mm about Y, 15 mm in radius, triangles of about half a millimetre: at least 2 mm of bone everywhere.
Body plate() {
  constexpr double thickness = 2, radius = 15;
  std::vector<ProfilePoint> profile{{0, 0}};
  for (double beside = 0.5; beside <= radius; beside += 0.5) profile.push_back({0, beside});
  profile.push_back({thickness / 2, radius});
  for (double beside = radius; beside >= 0.5; beside -= 0.5) profile.push_back({thickness, beside});
  profile.push_back({thickness, 0});
  return {"plate", revolved(Vec3::UnitY(), profile, 120)};
}

Index vertex_nearest(const Mesh& mesh, const Vec3& point) {
  Index nearest = 0;
  for (Index v = 0; v < mesh.vertices().size(); ++v)
    if ((mesh.vertices()[v] - point).norm() < (mesh.vertices()[nearest] - point).norm()) nearest = v;
  return nearest;
}

plan::BrushStroke lowering(std::vector<Index> along, double radius_mm, double depth_mm) {
  return {.along = std::move(along), .radius_mm = radius_mm, .depth_mm = depth_mm};
}

Mesh mesh_now(const Body& bone, const plan::Brush& brush) {
  return bone.mesh.moved_to(brush.vertices());
}

/// Closed, without new crossings, no triangle turned over.
void expect_sound_bone(const Body& bone, const plan::Brush& brush) {
  const Mesh now = mesh_now(bone, brush);
  EXPECT_TRUE(now.is_closed());
  EXPECT_EQ(mesh::self_crossings_of(now).pairs, mesh::self_crossings_of(bone.mesh).pairs);
  std::size_t turned = 0;
  const auto normal = [](const TriMesh& m, std::size_t t) {
    return Vec3((m.corner(t, 1) - m.corner(t, 0)).cross(m.corner(t, 2) - m.corner(t, 0)));
  };
  for (std::size_t t = 0; t < now.triangles().size(); ++t)
    turned += normal(bone.mesh, t).dot(normal(now, t)) < 0;
  EXPECT_EQ(turned, 0);
}

double brush_weight(double share_of_radius) {
  const double t = std::clamp(2 * share_of_radius - 1, 0.0, 1.0);
  return 1 - t * t * (3 - 2 * t);
}

/// Volume that a stroke takes from a ball. The area of a sphere within a chord c is pi c^2 whatever its radius, and of a cone from its centre with the
/// base dA the part above R - h has dA (R^3 - (R - h)^3) / (3 R^2): with c = t r
///
///     V = 2 pi r^2 int_0^1 (h - h^2 / R + h^3 / (3 R^2)) t dt,   h = d w(t)
double volume_from_ball(double r, double d) {
  constexpr int steps = 2000;  // midpoints
  double sum = 0;
  for (int i = 0; i < steps; ++i) {
    const double t = (i + 0.5) / steps, h = d * brush_weight(t);
    sum += (h - h * h / R + h * h * h / (3 * R * R)) * t / steps;
  }
  return 2 * std::numbers::pi * r * r * sum;
}

TEST(Brush, AStrokeOnABallTakesWhatTheClosedFormSays) {
  const Body bone = ball();
  for (const auto& [r, d] : {std::pair(8., 2.), {12., 0.5}, {6., 1.}}) {
    plan::Brush brush(bone);
    const plan::StrokeOutcome outcome = brush.stroke(lowering({0}, r, d));
    const plan::BrushedBone removed = brush.removed();
    EXPECT_EQ(outcome.limited, 0);
    EXPECT_EQ(outcome.kept, 0);
    // Between vertices the weight is a straight line: within edge^2 / 8 of it times its second derivative, at most 24 / r^2, on the border.
    const double edge = 2 * brush.edge_mm(), border = 0.75 * std::numbers::pi * r * r;
    EXPECT_NEAR(removed.volume_mm3, volume_from_ball(r, d), border * d * 3 * edge * edge / (r * r));
    // The distance of a vertex from facets is less than its depth by what they sag, at most.
    EXPECT_LE(removed.deepest_mm, d + 1e-12);
    EXPECT_GE(removed.deepest_mm, d - edge * edge / (8 * R));
    expect_sound_bone(bone, brush);
  }
}

TEST(Brush, NoVertexIsDeeperThanItsStrokesHoweverOftenTheyPass) {
  const Body bone = ball();
  const mesh::SurfaceDistance from_before(bone.mesh);
  plan::Brush brush(bone);
  const Index there = vertex_nearest(bone.mesh, Vec3(R, 2, 1));
  for (int i = 0; i < 5; ++i) brush.stroke(lowering({there, 0, there}, 7, 1.5));
  for (Index v = 0; v < bone.mesh.vertices().size(); ++v) {
    EXPECT_LE((brush.vertices()[v] - bone.mesh.vertices()[v]).norm(), 1.5 + 1e-12);
    EXPECT_EQ(brush.depth_mm()[v],
              brush.vertices()[v] == bone.mesh.vertices()[v] ? 0 : from_before(brush.vertices()[v]));
  }
  EXPECT_EQ(brush.stroke(lowering({there}, 7, 1.5)).moved, 0);
}

TEST(Brush, StrokesThatAreNotLimitedHaveNoOrder) {
  const Body bone = ball();
  const plan::BrushStroke one = lowering({0}, 8, 1),
                          other = lowering({vertex_nearest(bone.mesh, Vec3(R, 5, 0))}, 5, 2);
  plan::Brush first(bone), second(bone);
  EXPECT_EQ(first.stroke(one).limited + first.stroke(other).limited, 0);
  second.stroke(other), second.stroke(one);
  EXPECT_EQ(first.vertices(), second.vertices());
}

TEST(Brush, UndoRestoresEveryBit) {
  const Body bone = ball();
  plan::Brush brush(bone);
  brush.stroke(lowering({0, 1}, 8, 2));
  const Points after_one = brush.vertices();
  const std::vector<double> depths = brush.depth_mm();
  brush.stroke(lowering({0}, 4, 5));
  brush.stroke({.action = plan::BrushAction::restore, .along = {1}, .radius_mm = 6});
  EXPECT_EQ(brush.steps(), 3);
  EXPECT_TRUE(brush.undo() && brush.undo());
  EXPECT_EQ(brush.vertices(), after_one);
  EXPECT_EQ(brush.depth_mm(), depths);
  EXPECT_TRUE(brush.undo());
  EXPECT_EQ(brush.vertices(), bone.mesh.vertices());
  EXPECT_EQ(brush.removed().volume_mm3, 0);
  EXPECT_FALSE(brush.undo());
}

TEST(Brush, WhatIsRestoredIsTheSurfaceBeforeBitByBit) {
  const Body bone = ball();
  plan::Brush brush(bone);
  brush.stroke(lowering({0}, 6, 2));
  // The whole weight reaches half of the radius.
  brush.stroke({.action = plan::BrushAction::restore, .along = {0}, .radius_mm = 12});
  EXPECT_EQ(brush.vertices(), bone.mesh.vertices());
}

TEST(Brush, WhatMustStayStaysAndIsCounted) {
  const Body bone = ball();
  std::vector<std::uint8_t> stays(bone.mesh.vertices().size(), 0);
  for (Index v = 0; v < stays.size(); ++v) stays[v] = bone.mesh.vertices()[v].y() > 1;
  plan::Brush brush(bone, stays);
  const plan::StrokeOutcome outcome =
      brush.stroke(lowering({vertex_nearest(bone.mesh, Vec3(R, 0, 0))}, 8, 2));
  EXPECT_GT(outcome.kept, 100);
  EXPECT_GT(outcome.moved, 100);
  for (Index v = 0; v < stays.size(); ++v)
    if (stays[v]) {
      EXPECT_EQ(brush.vertices()[v], bone.mesh.vertices()[v]);
    }
  expect_sound_bone(bone, brush);
}

TEST(Brush, AThinPlateIsNotPiercedAndItsOtherSideStays) {
  const Body bone = plate();
  plan::Brush brush(bone);
  const Index top = vertex_nearest(bone.mesh, Vec3(0, 2, 0));
  const plan::StrokeOutcome outcome = brush.stroke(lowering({top}, 8, 6));
  EXPECT_GT(outcome.limited, 0);
  for (Index v = 0; v < bone.mesh.vertices().size(); ++v) {
    if (bone.mesh.vertices()[v].y() < 0.5) {
      EXPECT_EQ(brush.vertices()[v], bone.mesh.vertices()[v]);
    }
  }
  // Never through the other side, but to less than a fifth of its depth: steps of holding back.
  EXPECT_GT(brush.vertices()[top].y(), 0);
  EXPECT_LT(brush.vertices()[top].y(), 0.6);
  expect_sound_bone(bone, brush);
}

TEST(Brush, ACutGoesOnFromWhereItIs) {
  const Body bone = ball();
  plan::Brush first(bone);
  first.stroke(lowering({0}, 8, 2));
  const Body cut{"ball", mesh_now(bone, first)};
  plan::Brush brush(cut, bone.mesh.vertices());
  EXPECT_EQ(brush.vertices(), first.vertices());
  EXPECT_EQ(brush.removed().volume_mm3, first.removed().volume_mm3);
  EXPECT_EQ(brush.stroke(lowering({0}, 3, 1)).moved, 0);
  EXPECT_GT(brush.stroke(lowering({0}, 6, 3)).moved, 0);
  EXPECT_NEAR(brush.removed().deepest_mm, 3, 0.01);
  EXPECT_TRUE(brush.undo() && brush.undo());
  EXPECT_EQ(brush.vertices(), first.vertices());
  EXPECT_TRUE(brush.undo());
  EXPECT_EQ(brush.vertices(), bone.mesh.vertices());
  EXPECT_FALSE(brush.undo());
}

std::string refusal(const Body& bone, const plan::BrushStroke& stroke) {
  plan::Brush brush(bone);
  return complaint_of<UsageError>([&] { brush.stroke(stroke); });
}

TEST(Brush, RefusesWhatIsNoStroke) {
  const Body bone = ball();
  const std::string count = std::to_string(bone.mesh.vertices().size());
  EXPECT_EQ(refusal(bone, lowering({}, 5, 1)), "brush: a stroke needs a vertex that it passes over");
  EXPECT_EQ(refusal(bone, lowering({1000000}, 5, 1)), "brush: vertex 1000000 of the " + count + " of ball");
  EXPECT_EQ(refusal(bone, lowering({0}, 0, 1)), "brush: its radius must be above 0 and at most 30 mm");
  EXPECT_EQ(refusal(bone, lowering({0}, 5, std::nan(""))),
            "brush: its depth must be above 0 and at most 20 mm");
  EXPECT_THROW(plan::Brush(bone, {1, 0}), UsageError);
  TriMesh open = bone.mesh;
  open.triangles.pop_back();
  EXPECT_THROW(plan::Brush({"ball", std::move(open)}), MeshError);
}

Joint cam_hip() {
  sample::HipParameters parameters;
  parameters.alpha_angle = Angle::degrees(70);
  auto [hip_bone, femur] = sample::sample_hip(parameters, sample::Scenario::one);
  return {
      "sample", JointKind::ball, Side::right, {"hip bone", std::move(hip_bone)}, {"femur", std::move(femur)}};
}

TEST(Brush, RefusesAJointWithAnImplant) {
  Joint joint = cam_hip();
  const plan::BrushRequest request{.strokes = {lowering({0}, 5, 1)}};
  EXPECT_NO_THROW(plan::brush_joint(joint, request, {}));
  joint.implant.emplace();
  EXPECT_THROW(plan::brush_joint(joint, request, {}), UsageError);
}

/// Where a motion ends, on either bone.
Index contact_vertex(const Joint& joint, BodyRole role, const char* motion) {
  const motion::MotionLimit limit =
      motion::RangeOfMotion(joint).limit(motion::motion_named(motion::hip_motions(), motion));
  return role == BodyRole::mobile ? vertex_nearest(joint.mobile.mesh, limit.end.contact->mobile_point)
                                  : vertex_nearest(joint.fixed.mesh, limit.end.contact->fixed_point);
}

TEST(BrushedJoint, LimitsAreThoseOfAJointMadeAnewBitByBit) {
  const Joint joint = cam_hip();
  const auto motions = motion::hip_motions();
  for (const BodyRole role : {BodyRole::mobile, BodyRole::fixed}) {
    const Index there = contact_vertex(joint, role, "internal_rotation_at_90_flexion");
    const plan::BrushedJoint brushed =
        plan::brush_joint(joint, {.body = role, .strokes = {lowering({there}, 8, 2)}}, motions);
    motion::RangeOptions options;
    options.bearing.roles = motion::RangeOfMotion(joint).bearing().roles;
    const auto anew = motion::RangeOfMotion(brushed.joint, options).limits(motions);
    double gained = 0;
    for (std::size_t i = 0; i < motions.size(); ++i) {
      EXPECT_EQ(brushed.after[i].end.turned, anew[i].end.turned) << motions[i].name;
      EXPECT_EQ(brushed.after[i].end.reason, anew[i].end.reason) << motions[i].name;
      gained = std::max(gained, (brushed.after[i].end.turned - brushed.before[i].end.turned).degrees());
    }
    EXPECT_GT(gained, 0.5);
    EXPECT_GT(brushed.removed.volume_mm3, 0);
  }
}

TEST(BrushedJoint, TheBearingSurfaceStays) {
  const Joint joint = cam_hip();
  const auto roles = motion::RangeOfMotion(joint).bearing().roles;
  const auto marks = plan::protected_vertices(joint, BodyRole::mobile, roles);
  const auto head = std::find(marks.begin(), marks.end(), 1);
  ASSERT_NE(head, marks.end());
  const plan::BrushedJoint brushed = plan::brush_joint(
      joint, {.strokes = {lowering({static_cast<Index>(head - marks.begin())}, 30, 3)}}, {});
  EXPECT_GT(brushed.strokes[0].kept, 0);
  for (Index v = 0; v < marks.size(); ++v)
    if (marks[v]) {
      EXPECT_EQ(brushed.depth_mm[v], 0);
    }
}

TEST(Brush, AHundredStrokesLeaveARealFemurSound) {
  FOUND_OR_SKIP(joint, hip_vhf_right());
  for (const Body* bone : {&joint->mobile, &joint->fixed}) {
    std::mt19937 random(5);
    plan::Brush brush(*bone);
    const auto count = bone->mesh.vertices().size();
    for (int i = 0; i < 100; ++i) {
      const auto share = [&] { return static_cast<double>(random()) / 4294967296.0; };
      const auto vertex = static_cast<Index>(random() % count);
      brush.stroke(lowering({vertex}, 2 + 13 * share(), 0.5 + 7 * share()));
    }
    expect_sound_bone(*bone, brush);
    const Points& now = brush.vertices();
    EXPECT_NE(now, bone->mesh.vertices());
    while (brush.undo()) {
    }
    EXPECT_EQ(brush.vertices(), bone->mesh.vertices());
  }
}

}  // namespace
}  // namespace condyle::test
