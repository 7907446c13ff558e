#include <tuple>

#include "condyle/answer.hpp"
#include "mesh/cut_mesh.hpp"
#include "motion/joint_scenes.hpp"
#include "support/parametric_shoulder.hpp"
#include "support/test.hpp"

/// One answer for every shell: limits as their own functions give them, with the notes that they must be read with.

namespace condyle {
namespace {

using namespace test;

/// The joint as it turns about another point: both meshes moved until it is the origin.
Joint about(const Joint& joint, const Vec3& centre) {
  const auto moved = [&](const Body& body) { return Body{body.name, test::shifted_by(body.mesh, -centre)}; };
  Joint other = joint;
  other.fixed = moved(joint.fixed);
  other.mobile = moved(joint.mobile);
  return other;
}

/// Solids of these scenes do not hang together: limits lie on separate pieces, which other tests look at.
std::vector<std::string> codes(const std::vector<RangeNote>& notes) {
  std::vector<std::string> found;
  for (const RangeNote& note : notes)
    if (note.code != RangeNoteCode::limit_on_piece) found.emplace_back(name_of(note.code));
  return found;
}

RangeAnswer answered(const Joint& joint, const RangeRequest& request) {
  return answer_range({joint}, request);
}

TEST(LimitsAbout, AreThoseOfTheJointWithItsCentreThere) {
  // Coordinates below 128 mm are rounded by half of 2^-46 mm where they are moved, in both bodies and once more into the frame of
  // the axis; at none of these contacts do the surfaces approach by less than a micrometre per radian.
  constexpr double rounding_mm = 4 * 0x1p-46, slowest_mm = 1e-3;
  const motion::RangeOptions range{.bearing = {.rule = motion::BearingRule::count}};
  const std::vector<motion::Motion> motions = motion::hip_motions();
  const Joint joint = bumpy_joint(Side::right);
  const std::vector<Vec3> centres = {Vec3::Zero(), {0.8, -0.3, 0.5}, {-1.1, 0.4, 0.2}};
  const std::vector<motion::DisplacedLimit> limits = motion::limits_about(joint, motions, range, centres);
  ASSERT_EQ(limits.size(), centres.size() * motions.size());
  for (std::size_t c = 0; c < centres.size(); ++c) {
    const motion::RangeOfMotion there(about(joint, centres[c]), range);
    for (std::size_t m = 0; m < motions.size(); ++m) {
      const motion::Limit expected = there.limit(motions[m]).end;
      const motion::DisplacedLimit& limit = limits[c * motions.size() + m];
      EXPECT_NEAR(limit.turned.radians(), expected.turned.radians(), rounding_mm / slowest_mm)
          << motions[m].name;
      EXPECT_EQ(limit.reason, expected.reason) << motions[m].name;
    }
  }
}

TEST(RangeNotes, SayByHowMuchTheCentreMovesLimits) {
  // About the head's centre, which is above the socket's, the arm meets the post later.
  const Vec3 off(0.5, 1.2, 0);
  const Joint joint = head_and_post_joint(off);
  const motion::Motion flexion = motion::hip_motions().front();
  const RangeAnswer answer = answered(joint, {.motions = {flexion}});
  ASSERT_EQ(codes(answer.notes), std::vector<std::string>{"centre_moves_limits"});
  const double about_socket = motion::RangeOfMotion(joint).limit(flexion).end.turned.degrees();
  const double about_head = motion::RangeOfMotion(about(joint, off)).limit(flexion).end.turned.degrees();
  EXPECT_GT(std::abs(about_head - about_socket), 0.1);
  char expected[200];
  std::snprintf(expected, sizeof expected,
                "centres 1.3 mm apart: limits about the socket's centre instead of the "
                "head's differ by up to %.1f degrees (flexion: %.1f, not %.1f)",
                std::abs(about_head - about_socket), about_socket, about_head);
  EXPECT_NE(answer.notes.front().text.find(expected), std::string::npos)
      << answer.notes.front().text << "\nexpected: " << expected;
}

TEST(RangeNotes, AreNoneIfHeadAndSocketAreNearlyConcentric) {
  // A head of 20 mm radius may be 20/24 of a millimetre off.
  EXPECT_EQ(codes(answered(head_and_post_joint({0.83, 0, 0}), {.motions = motion::hip_motions()}).notes),
            std::vector<std::string>{});
  EXPECT_EQ(codes(answered(head_and_post_joint({0.84, 0, 0}), {.motions = motion::hip_motions()}).notes),
            std::vector<std::string>{"centre_moves_limits"});
  EXPECT_TRUE(answered(post_joint(JointAngle::flexion, Side::right).joint, {.motions = motion::hip_motions()})
                  .notes.empty())
      << "a joint without a head";
}

TEST(RangeNotes, SayThatANarrowGapLeavesLittleMargin) {
  const auto notes_at = [](double radius, const motion::BearingOptions& bearing = {}) {
    Joint joint = head_and_post_joint(Vec3::Zero());
    joint.mobile.mesh = joined(sphere({0, 0, 0}, radius, 4), box({-1, -100, -1}, {1, -50, 1}));
    RangeRequest request{.motions = {motion::hip_motions().front()}};
    request.range.bearing = bearing;
    return codes(answered(joint, request).notes);
  };
  const std::vector<std::string> none, narrow = {"narrow_bearing_margin"};
  // A gap of 23 mm - r leaves r/48 less, and is narrow below r/24: from r = 23 / (1 + 1/48 + 1/24) = 21.65 on.
  EXPECT_EQ(notes_at(21.6), none);
  EXPECT_EQ(notes_at(21.7), narrow);
  EXPECT_EQ(notes_at(22.7), narrow);  // no margin at all
  EXPECT_EQ(notes_at(21.7, {.margin_mm = 1.0}), none) << "the margin is stated";
  EXPECT_EQ(notes_at(21.7, {.rule = motion::BearingRule::count}), none) << "any contact counts";
}

/// A head of 24 mm in a half shell with a rim at 26, whose roof above 15 mm is of a shell of this inner radius.
Joint hip_with_roof(double inner) {
  const std::array planes{mesh::CuttingPlane{{0, 15, 0}, -Vec3::UnitY()}};
  const TriMesh roof = mesh::cut_by_planes(Mesh(socket({0, 0, 0}, inner, 27, 5)), "roof", planes).inner.mesh;
  return {"hip",
          JointKind::ball,
          Side::right,
          {"hip bone", joined(socket({0, 0, 0}, 26, 60, 4), roof)},
          {"femur", joined(sphere({0, 0, 0}, 24, 5), box({-8, -200, -8}, {8, -22, 8}))}};
}

TEST(RangeNotes, SayThatBonesTouchOverTheirBearingSurface) {
  const auto touch = [](const Joint& joint) {
    const auto found = codes(answered(joint, {.motions = {motion::hip_motions().front()}}).notes);
    return std::count(found.begin(), found.end(), "bones_touch") == 1;
  };
  // Above 15 mm lie (1 - 15 / 24) / 2 of the head, 19 %, and 25 % of what its margin leaves of it.
  EXPECT_TRUE(touch(hip_with_roof(23.5)));
  EXPECT_FALSE(touch(hip_with_roof(23.85))) << "0.15 mm deep";
  EXPECT_FALSE(touch(hip_with_roof(24.5))) << "apart";
}

TEST(RangeNotes, SayThatTrianglesAreTooLong) {
  const auto coarse = [](int head_levels) {
    Joint joint = hip_with_roof(25);
    joint.mobile = {"femur", joined(sphere({0, 0, 0}, 24, head_levels), box({-8, -200, -8}, {8, -22, 8}))};
    const auto found = codes(answered(joint, {.motions = {motion::hip_motions().front()}}).notes);
    return std::count(found.begin(), found.end(), "coarse_mesh") == 1;
  };
  // Edges of a quarter of a circle in 4 parts sag by R (1 - cos(11.25 deg)) = 0.46 mm, 1.1 degrees; in 2 by 1.8 mm, 4.4 degrees.
  EXPECT_FALSE(coarse(4));
  EXPECT_TRUE(coarse(1));
}

TEST(RangeNotes, SayThatSurfacesSlideByNatureWhereNoHeadTellsContactApart) {
  const auto notes_of = [](JointKind kind, Anatomy anatomy, double range_deg) {
    Joint joint = post_joint(JointAngle::flexion, Side::right).joint;
    joint.kind = kind, joint.anatomy = anatomy;
    motion::Motion forwards = motion::hip_motions().front();
    forwards.range = Angle::degrees(range_deg);
    return answered(joint, {.motions = {forwards}}).notes;
  };
  for (const auto& [kind, anatomy, name] : {std::tuple(JointKind::ball, Anatomy::elbow, "an elbow"),
                                            {JointKind::free, Anatomy::ankle, "an ankle"},
                                            {JointKind::hinge, Anatomy::elbow, "an elbow"},
                                            {JointKind::hinge, Anatomy::hip, "a hinge"}}) {
    const auto notes = notes_of(kind, anatomy, 120);
    ASSERT_EQ(codes(notes), std::vector<std::string>{"sliding_surfaces"}) << name;
    EXPECT_EQ(
        notes.front().text.find("the surfaces of " + std::string(name) + " slide on each other by nature"),
        0u)
        << notes.front().text;
    EXPECT_TRUE(notes_of(kind, anatomy, 1).empty()) << "nothing touched";
  }
  EXPECT_TRUE(notes_of(JointKind::ball, Anatomy::hip, 120).empty());
  EXPECT_TRUE(notes_of(JointKind::ball, Anatomy::shoulder, 120).empty());
}

TEST(RangeNotes, SayThatSurfacesSlideUnlessMeshesOfTheMobileBodyDo) {
  const auto notes_with = [](PartContact of_post, PartContact of_pad) {
    Joint joint = post_joint(JointAngle::flexion, Side::right).joint;
    joint.kind = JointKind::hinge;
    const auto two_meshes = [](Body& body, const TriMesh& more, PartContact first, PartContact second) {
      const TriMesh whole = body.mesh;
      body.parts = {{"a", 0, whole.vertices.size(), 0, whole.triangles.size(), first},
                    {"b", whole.vertices.size(), more.vertices.size(), whole.triangles.size(),
                     more.triangles.size(), second}};
      body.mesh = joined(whole, more);
    };
    two_meshes(joint.fixed, box({300, 0, 0}, {301, 1, 1}), of_post, PartContact::ends);
    two_meshes(joint.mobile, box({1, 1, 1}, {2, 2, 2}), PartContact::ends, of_pad);
    return codes(answered(joint, {.motions = {motion::hip_motions().front()}}).notes);
  };
  const std::vector<std::string> sliding{"sliding_surfaces"};
  EXPECT_EQ(notes_with(PartContact::bearing, PartContact::ends), sliding);
  EXPECT_EQ(notes_with(PartContact::ends, PartContact::soft), sliding);
  EXPECT_TRUE(notes_with(PartContact::bearing, PartContact::bearing).empty());
}

TEST(RangeNotes, OfAShoulderSayWhatLeavesLittleMargin) {
  ParametricShoulder shape;
  shape.acromion_y = 25.2;
  const motion::Motion abduction =
      motion::motion_named(motion::built_in_motions(JointKind::ball, Anatomy::shoulder), "abduction");
  const auto notes = answered(shoulder(shape), {.motions = {abduction}}).notes;
  ASSERT_EQ(codes(notes), std::vector<std::string>{"narrow_bearing_margin"});
  EXPECT_EQ(
      notes.front().text.find("scapula leaves the head only 1.20 mm beside its socket: contact counts as "
                              "bearing within 0.70 mm of the head only"),
      0u)
      << notes.front().text;
}

TEST(RangeNotes, DoNotTurnAShoulderAboutItsGlenoidsCentre) {
  // A dish of 30 mm whose middle is 2 mm from the ball has its centre 4 mm off.
  Joint joint = shoulder({});
  TriMesh slab = slab_with_dish(30);
  for (double& z : slab.vertices.z) z += 4;
  joint.fixed.mesh = joined(slab, box({-15, 34, -10}, {15, 40, 30}));
  const motion::Motion abduction =
      motion::motion_named(motion::built_in_motions(JointKind::ball, Anatomy::shoulder), "abduction");
  const RangeAnswer answer = answered(joint, {.motions = {abduction}});
  ASSERT_TRUE(answer.bearing.surface && answer.bearing.surface->socket);
  EXPECT_NEAR(answer.bearing.surface->socket->centre.z(), 4, 1e-8);
  EXPECT_TRUE(codes(answer.notes).empty());
  EXPECT_NEAR(answer.limits.front().end.turned.radians(), shaft_limit({}), 5e-12);
}

TEST(AnswerRange, GivesWhatItsPartsGive) {
  const Joint joint = bumpy_joint(Side::left);
  RangeRequest request{.motions = motion::hip_motions(), .zones_past = Angle::degrees(4)};
  request.map = {.row = {JointAngle::adduction, -10, 10, 10}, .column = {JointAngle::flexion, 0, 20, 20}};
  request.bands = BandRequest{.samples = 20, .seed = 5};
  const RangeAnswer answer = answered(joint, request);
  const motion::RangeOfMotion range(joint);
  ASSERT_EQ(answer.limits.size(), request.motions.size());
  for (std::size_t m = 0; m < request.motions.size(); ++m)
    EXPECT_EQ(answer.limits[m].end.turned, range.limit(request.motions[m]).end.turned);
  EXPECT_EQ(answer.zones.size(), request.motions.size());
  ASSERT_TRUE(answer.map);
  EXPECT_EQ(answer.map->points.size(), 6u);
  const auto bands = motion::limit_bands(joint, request.motions, {}, {.samples = 20, .seed = 5});
  ASSERT_EQ(answer.bands.size(), bands.size());
  for (std::size_t m = 0; m < bands.size(); ++m) EXPECT_EQ(answer.bands[m].median, bands[m].median);
}

TEST(AnswerRange, SaysThatAMapEndsBeforeItsLastValue) {
  RangeRequest request;
  request.map = {.row = {JointAngle::adduction, -10, 10, 10}, .column = {JointAngle::flexion, 0, 25, 20}};
  const RangeAnswer answer = answered(bumpy_joint(Side::left), request);
  ASSERT_EQ(answer.notes.size(), 1u);
  EXPECT_EQ(answer.notes[0].code, RangeNoteCode::last_value_left_out);
  EXPECT_NE(answer.notes[0].text.find("flexion 20, not 25"), std::string::npos) << answer.notes[0].text;
}

TEST(AnswerRange, IsEmptyIfStopped) {
  RangeRequest request{.motions = motion::hip_motions()};
  request.bands.emplace();
  std::stop_source stop;
  const auto at_first = [&](std::string_view stage, std::size_t, std::size_t) {
    EXPECT_EQ(stage, "joints of the band");
    stop.request_stop();
  };
  EXPECT_FALSE(answer_range({bumpy_joint(Side::right)}, request, {at_first, stop.get_token()}));
}

TEST(AnswerRange, RefusesWhatContradictsItself) {
  const Joint joint = bumpy_joint(Side::right);
  const RangeRequest limits{.motions = {motion::hip_motions().front()}};
  RangeRequest request = limits;
  request.allowed_depth.emplace();
  request.bands.emplace();
  EXPECT_THROW(answered(joint, request), UsageError);
  request = limits;
  request.translation_mm = Vec3::Zero();
  EXPECT_THROW(answered(joint, request), UsageError) << "a ball does not translate";
  request = limits;
  request.clock = motion::ClockPlane::rim;
  EXPECT_THROW(answered(post_joint(JointAngle::flexion, Side::right).joint, request), MeshError) << "no rim";
}

TEST(AnswerRange, HoldsTheTranslationOfAFreeJoint) {
  Joint joint = bumpy_joint(Side::right);
  joint.kind = JointKind::free;
  const Vec3 held(0.4, -0.2, 0.1);
  JointPlacement placement{};
  placement.reference_pose.translation_mm = held;
  RangeRequest request{.motions = {motion::hip_motions().front()}};
  const RangeAnswer by_reference = answer_range({joint, placement}, request);
  request.translation_mm = held;
  const RangeAnswer by_request = answer_range({joint}, request);
  EXPECT_EQ(by_reference.held_translation_mm, held);
  EXPECT_EQ(by_reference.limits[0].end.turned, by_request.limits[0].end.turned);
  joint.translation_frame = TranslationFrame::joint_axes;
  EXPECT_THROW(answer_range({joint}, request), UsageError) << "it would turn with the axes";
}

TEST(FurtherLimits, AreThoseOfTheAnswerThatKeptItsTables) {
  const std::vector<motion::Motion> motions = motion::hip_motions();
  const RangeAnswer all = answered(bumpy_joint(Side::right), {.motions = motions});
  const RangeAnswer kept = answered(bumpy_joint(Side::right), {});
  const Case joint{bumpy_joint(Side::right)};
  const auto further = further_answer(joint, kept, {.motions = motions});
  ASSERT_EQ(further->limits.size(), motions.size());
  for (std::size_t i = 0; i < motions.size(); ++i)
    EXPECT_EQ(further->limits[i].end.turned, all.limits[i].end.turned) << motions[i].name;
  EXPECT_EQ(further->range, kept.range);
  std::stop_source stop;
  stop.request_stop();
  EXPECT_FALSE(further_answer(joint, kept, {.motions = motions}, {.stop = stop.get_token()}));
  EXPECT_THROW(further_answer(joint, kept, {.motions = {motion::Motion{.name = "still"}}}), UsageError);
}

}  // namespace
}  // namespace condyle
