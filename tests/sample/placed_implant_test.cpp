#include <tuple>

#include "condyle/answer.hpp"
#include "condyle/sample/hip.hpp"
#include "support/real_hip.hpp"
#include "support/test.hpp"

/// A total hip placed in a joint that is given: docs/implants.md.

namespace condyle::test {
namespace {

const sample::SampleHip& bones() {
  static const sample::SampleHip hip = sample::sample_hip({}, sample::Scenario::one);
  return hip;
}

Joint joint_of(const sample::SampleHip& hip, Side side = Side::right) {
  return {.name = "hip",
          .kind = JointKind::ball,
          .side = side,
          .fixed = {"hip bone", hip.hip_bone},
          .mobile = {"femur", hip.femur}};
}

ImplantAnswer placed(const ImplantRequest& request = {}, const Joint& joint = joint_of(bones())) {
  return answer_implant({joint}, request);
}

/// The design A of docs/mathematics/13-implants.md, whose sizes are the defaults.
constexpr SizesOfBones none_of_bones{
    .neck_shaft = false, .stem_version = false, .offset = false, .cup_radius = false};

bool has_note(const ImplantAnswer& answer, ImplantNoteCode code) {
  return std::any_of(answer.notes.begin(), answer.notes.end(),
                     [&](const ImplantNote& note) { return note.code == code; });
}

Body only(const Body& body, const std::vector<std::string>& names) {
  TriMesh all;
  for (const std::string& name : names) {
    const TriMesh mesh = mesh_of_part(body, name).arrays();
    const auto first = static_cast<Index>(all.vertices.size());
    for (std::size_t v = 0; v < mesh.vertices.size(); ++v) all.vertices.push_back(mesh.vertices[v]);
    for (const auto& [a, b, c] : mesh.triangles) all.triangles.push_back({a + first, b + first, c + first});
  }
  return {body.name, Mesh(std::move(all))};
}

/// From a vertex of one mesh to the nearest vertex of the other, at the most: points of a cut may come in another order.
double farthest(const TriMesh& from, const TriMesh& to) {
  double most = 0;
  for (std::size_t v = 0; v < from.vertices.size(); ++v) {
    double nearest = (from.vertices[v] - to.vertices[v]).squaredNorm();
    for (std::size_t w = 0; nearest > 1e-12 && w < to.vertices.size(); ++w)
      nearest = std::min(nearest, (from.vertices[v] - to.vertices[w]).squaredNorm());
    most = std::max(most, nearest);
  }
  return std::sqrt(most);
}

std::vector<motion::MotionLimit> limits_of(const Joint& joint) {
  return motion::RangeOfMotion(joint, {.bearing = {.rule = motion::BearingRule::count}})
      .limits(motion::hip_motions());
}

TEST(PlacedImplant, HasTheClosedLimitsOfItsSizesIfBonesAreHidden) {
  const ImplantAnswer answer = placed({.of_bones = none_of_bones});
  Joint joint = answer.joint;
  joint.fixed = only(joint.fixed, {"liner"}), joint.mobile = only(joint.mobile, {"head", "neck", "stem"});
  // Computed by the closed form and by meshes of other code, to 1e-4 degrees; -1 for the end of the range.
  const double expected[] = {128.7064, 61.1268, 59.5838, 67.5978,  -1,      70.5273,
                             -1,       45.3956, 38.6748, 108.6748, 30.7376, -1};
  const std::vector<motion::MotionLimit> limits = limits_of(joint);
  ASSERT_TRUE(answer.pair);
  for (std::size_t i = 0; i < limits.size(); ++i) {
    SCOPED_TRACE(motion::hip_motions()[i].name);
    const plan::ClosedLimit closed =
        plan::closed_limit(*answer.pair, joint.coordinates(), motion::hip_motions()[i]);
    EXPECT_EQ(limits[i].end.reason, closed.reason);
    EXPECT_EQ(closed.reason == motion::LimitReason::contact, expected[i] > 0);
    if (expected[i] < 0) continue;
    EXPECT_NEAR(closed.turned.degrees(), expected[i], 1e-4);
    EXPECT_NEAR(limits[i].end.turned.degrees(), expected[i], 0.002);  // of 360 facets
  }
}

TEST(PlacedImplant, OfTheSampleHipIsItsReplacement) {
  const plan::ImplantMeshes made = *sample::sample_replacement({}, {}, sample::Scenario::one, Side::right);
  const ImplantAnswer answer = placed({.of_bones = none_of_bones});
  for (const auto& [part, mesh] : made.fixed)
    if (part == "liner") {
      EXPECT_EQ(mesh_of_part(answer.joint.fixed, part).arrays(), mesh);
    }
  const TriMesh &before = made.mobile.front().mesh, after = mesh_of_part(answer.joint.mobile, "femur");
  ASSERT_EQ(made.mobile.front().part, "femur");
  // The shaft's axis is measured here and known there: some hundredths of a millimetre apart, as is the bone.
  double lowest_before = 1e9, lowest_after = 1e9;
  for (std::size_t v = 0; v < before.vertices.size(); ++v)
    lowest_before = std::min(lowest_before, before.vertices.y[v]);
  for (std::size_t v = 0; v < after.vertices.size(); ++v)
    lowest_after = std::min(lowest_after, after.vertices.y[v]);
  EXPECT_NEAR(lowest_after, lowest_before, 0.1);
}

TEST(PlacedImplant, LeavesTheFemurWhereItIsByTheBonesOwnSizes) {
  const ImplantAnswer answer = placed();
  // Sizes are rounded to hundredths of a degree and of a millimetre: 0.005 degrees on 60 mm, and half a hundredth.
  EXPECT_LT(answer.femur_shift_mm.norm(), 0.02);
  EXPECT_EQ(answer.of_bones, SizesOfBones{});
  EXPECT_EQ(answer.hip.cup_radius_mm, 27);  // in a socket of 27.5
  EXPECT_LT(answer.hip.cup_radius_mm, answer.room_mm);
  EXPECT_NEAR(answer.centre_mm.norm(), 0, 1e-6);
  ASSERT_TRUE(answer.socket);
  EXPECT_NEAR(answer.socket->radius, 27.5, 0.05);
}

TEST(PlacedImplant, MovesTheFemurByOffsetAndLegLength) {
  ImplantRequest request;
  request.hip.leg_length_mm = 7;
  EXPECT_NEAR(placed(request).femur_shift_mm.y(), -7, 1e-9);
  request.hip.leg_length_mm = 0;
  const double native = placed(request).hip.offset_mm;
  request.of_bones.offset = false, request.hip.offset_mm = native + 5;
  const Vec3 shift = placed(request).femur_shift_mm;
  EXPECT_NEAR(shift.y(), 0, 1e-9);
  // 5 mm along the neck, and as much as the shaft leans over the 5 / tan(neck_shaft) by which the neck is longer: below 1 mm.
  EXPECT_NEAR(std::hypot(shift.x(), shift.z()), 5, 1);
  EXPECT_GT(shift.z(), 4);
}

TEST(PlacedImplant, TurnsTheCupAsTheRimIs) {
  ImplantRequest request;
  request.of_bones.cup = true;
  for (const CupDefinition definition : all_cup_definitions) {
    request.hip.cup.definition = definition;
    const ImplantAnswer answer = placed(request);
    const Vec3 cup = plan::cup_axis(answer.hip.cup, Side::right);
    EXPECT_LT(cup.cross(answer.bones.acetabulum.plane->normal).norm(), 0.01 * std::acos(-1.0) / 180);
  }
}

TEST(PlacedImplant, HasNothingOfTheHead) {
  const ImplantAnswer answer = placed();
  const Mesh femur = mesh_of_part(answer.joint.mobile, "femur");
  EXPECT_TRUE(femur.is_closed());
  double nearest = 1e9;
  for (std::size_t v = 0; v < femur.vertices().size(); ++v)
    nearest = std::min(nearest, femur.vertices()[v].norm());
  EXPECT_GT(nearest, answer.cut.offset_mm - 1e-6);
  EXPECT_FALSE(has_note(answer, ImplantNoteCode::trochanter_cut));
  // The ball alone has 57906 mm^3.
  EXPECT_GT(answer.removed_mm3, 55000);
}

TEST(PlacedImplant, OfALeftHipIsTheMirrorImage) {
  const ImplantAnswer right = placed(), left = placed({}, joint_of(mirrored(bones()), Side::left));
  EXPECT_EQ(left.hip, right.hip);
  EXPECT_NEAR(left.room_mm, right.room_mm, 1e-9);
  EXPECT_NEAR(left.removed_mm3, right.removed_mm3, 1e-3);
  for (const auto& [a, b] :
       {std::pair(&right.joint.fixed, &left.joint.fixed), {&right.joint.mobile, &left.joint.mobile}}) {
    ASSERT_EQ(a->mesh.vertices().size(), b->mesh.vertices().size());
    EXPECT_LT(farthest(sample::mirrored(b->mesh.arrays()), a->mesh), 1e-6);
  }
}

// A whole femur of triangles of 2.5 mm, whose axes of neck and shaft pass each other by 9 mm.
TEST(PlacedImplant, OfARealHipLeavesItsFemurAndKeepsItClosed) {
  FOUND_OR_SKIP(hip, hip_vhf_right());
  const ImplantAnswer answer = placed({}, *hip);
  EXPECT_LT(answer.femur_shift_mm.norm(), 0.02);
  EXPECT_FALSE(has_note(answer, ImplantNoteCode::trochanter_cut));
  EXPECT_FALSE(has_note(answer, ImplantNoteCode::no_shaft));
  const Mesh femur = mesh_of_part(answer.joint.mobile, "femur");
  EXPECT_TRUE(femur.is_closed());
  const motion::Motion extension = motion::motion_named(motion::hip_motions(), "extension");
  const plan::ClosedLimit closed = plan::closed_limit(*answer.pair, answer.joint.coordinates(), extension);
  const auto limits = motion::RangeOfMotion(answer.joint, {}).limits(std::vector{extension});
  EXPECT_NEAR(limits.front().end.turned.degrees(), closed.turned.degrees(), 0.01);
}

TEST(PlacedImplant, NotesACupInBoneAndACentreThatMoved) {
  ImplantRequest request;
  request.of_bones.cup_radius = false, request.hip.cup_radius_mm = 29;
  EXPECT_TRUE(has_note(placed(request), ImplantNoteCode::cup_in_bone));
  EXPECT_FALSE(has_note(placed(), ImplantNoteCode::cup_in_bone));
  sample::SampleHip moved = bones();
  for (TriMesh* mesh : {&moved.hip_bone, &moved.femur})
    for (double& y : mesh->vertices.y) y += 2;
  const ImplantAnswer answer = placed({}, joint_of(moved));
  EXPECT_TRUE(has_note(answer, ImplantNoteCode::centre_moved));
  EXPECT_NEAR(answer.centre_mm.y(), 2, 1e-6);
  EXPECT_NEAR(answer.room_mm, placed().room_mm, 1e-6);
}

TEST(PlacedImplant, RefusesInOneLine) {
  const auto says = [](const ImplantRequest& request, const Joint& joint) {
    try {
      placed(request, joint);
    } catch (const std::exception& error) {
      return std::string(error.what());
    }
    return std::string("no refusal");
  };
  const Joint hip = joint_of(bones());
  ImplantRequest large, as_rim;
  large.of_bones.cup_radius = false, large.hip.head_radius_mm = 28, large.hip.cup_radius_mm = 30;
  as_rim.of_bones.cup = true;
  Joint shoulder = hip, far = hip, open = hip;
  shoulder.anatomy = Anatomy::shoulder;
  far.fixed = {"box", box({-50, 60, -50}, {50, 90, 50})};
  TriMesh holed = bones().femur;
  holed.triangles.pop_back();
  open.mobile = {"femur", holed};
  for (const auto& [request, joint, text] :
       {std::tuple(large, hip,
                   "implant: a head of radius 28 mm does not fit: hip bone begins 27.2 mm from its centre"),
        std::tuple(ImplantRequest{}, shoulder, "implant: the joint is no hip"),
        std::tuple(ImplantRequest{}, placed().joint, "implant: the joint has an implant already"),
        std::tuple(as_rim, far, "; give inclination and anteversion"),
        std::tuple(ImplantRequest{}, far, "implant: cup_radius is 59.5, must be 12 to 45 mm"),
        std::tuple(ImplantRequest{}, open, "femur")}) {
    const std::string line = says(request, joint);
    EXPECT_NE(line.find(text), line.npos) << line;
    EXPECT_EQ(line.find('\n'), line.npos) << line;
  }
}

TEST(StemAngles, AreThoseThatMadeTheAxis) {
  for (const Side side : {Side::right, Side::left})
    for (const auto& [neck_shaft, version] : {std::pair(135.0, 15.0), {110.0, -30.0}, {160.0, 60.0}}) {
      const plan::StemAngles angles = plan::stem_angles(
          3 * plan::neck_axis(Angle::degrees(neck_shaft), Angle::degrees(version), side), side);
      EXPECT_NEAR(angles.neck_shaft.degrees(), neck_shaft, 1e-12);
      EXPECT_NEAR(angles.version.degrees(), version, 1e-12);
    }
}

}  // namespace
}  // namespace condyle::test
