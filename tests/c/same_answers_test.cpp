#include <thread>

#include "c/held.hpp"
#include "c/same_answers.hpp"
#include "condyle/answer.hpp"
#include "condyle/version.hpp"
#include "support/test.hpp"

/// What C answers has the bits of what C++ answers.

namespace condyle {
namespace {

using namespace test;

TEST(CInterface, HasTheVersionOfTheLibrary) {
  EXPECT_EQ(condyle_version(), version);
}

TEST(CInterface, KnowsAMeshAsItWasGiven) {
  const HeldMesh closed = c_mesh(hip().femur), open = c_mesh(plane(1, 3));
  EXPECT_EQ(condyle_mesh_vertex_count(closed.get()), hip().femur.vertices.size());
  EXPECT_EQ(condyle_mesh_triangle_count(closed.get()), hip().femur.triangles.size());
  EXPECT_EQ(condyle_mesh_is_closed(closed.get()), 1);
  EXPECT_EQ(condyle_mesh_is_closed(open.get()), 0);
}

TEST(CInterface, FindsTheVerticesAndPairsOfCppInOneResultsObjectForManyPoses) {
  const contact::JointContact cpp(hip().hip_bone, hip().femur);
  HeldMesh fixed = c_mesh(hip().hip_bone), mobile = c_mesh(hip().femur);
  const auto c = made<HeldContact>(condyle_joint_contact_create, fixed.get(), mobile.get());
  fixed.reset(), mobile.reset();  // The contact has what it needs.
  const auto results = made<HeldResults>(condyle_contact_results_create);
  std::size_t most_inside = 0, free_poses = 0;
  for (const Pose& X : poses()) {
    const condyle_pose pose = c_pose(X);
    ASSERT_OK(condyle_joint_contact_at(c.get(), &pose, results.get()));
    const contact::Contact expected = cpp.at(X);
    most_inside = std::max(most_inside, expect_same(expected, results.get()));
    free_poses += !expected.in_contact;
    const TouchAnswer touch = answer_touch(cpp, {.X_FM = X, .measures = TouchMeasures::all});
    condyle_touch in_c;
    ASSERT_OK(condyle_joint_contact_touch(c.get(), &pose, 1, &in_c));
    EXPECT_EQ(in_c.in_contact, touch.in_contact ? 1 : 0);
    EXPECT_EQ(in_c.intersecting_pairs, touch.pairs.size());
    EXPECT_EQ(in_c.deepest_of, !touch.deepest                         ? -1
                               : touch.deepest->of == BodyRole::fixed ? CONDYLE_FIXED
                                                                      : CONDYLE_MOBILE);
    if (touch.deepest) {
      EXPECT_EQ(in_c.depth_mm, touch.deepest->depth_mm);
      EXPECT_EQ(in_c.exit_mm[1], touch.deepest->exit.y());
    }
    ASSERT_EQ(touch.overlap.has_value(), touch.in_contact);
    if (touch.overlap) {
      EXPECT_EQ(in_c.volume_mm3, touch.overlap->volume_mm3);
      EXPECT_EQ(in_c.depth_bound_mm, touch.depth_bound_mm);
      EXPECT_EQ(in_c.fixed_covered_again_mm3, touch.overlap->fixed_covered_again_mm3);
    }
    if (touch.nearest) {
      EXPECT_EQ(in_c.nearest_distance_mm, touch.nearest->distance_mm);
    }
    EXPECT_EQ(std::isnan(in_c.volume_mm3), !touch.in_contact);
    int in_contact = -1;
    ASSERT_OK(condyle_joint_contact_in_contact(c.get(), &pose, &in_contact));
    EXPECT_EQ(in_contact, expected.in_contact ? 1 : 0);
  }
  EXPECT_GT(most_inside, 10u);
  EXPECT_GT(free_poses, 0u);
}

TEST(CInterface, GivesTheGapsOfCpp) {
  const contact::JointContact cpp(hip().hip_bone, hip().femur);
  const auto c = c_contact(hip().hip_bone, hip().femur);
  std::vector<double> mobile(hip().femur.vertices.size()), fixed(hip().hip_bone.vertices.size());
  for (const Pose& X : poses()) {
    const condyle_pose pose = c_pose(X);
    ASSERT_OK(
        condyle_joint_contact_radial_gaps(c.get(), &pose, CONDYLE_MOBILE, mobile.data(), mobile.size()));
    ASSERT_OK(condyle_joint_contact_radial_gaps(c.get(), &pose, CONDYLE_FIXED, fixed.data(), fixed.size()));
    const contact::RadialContact expected = cpp.radial(X);
    EXPECT_EQ(mobile, expected.mobile_in_fixed->radial_gap_mm);
    EXPECT_EQ(fixed, expected.fixed_in_mobile->radial_gap_mm);
  }
  const contact::AxisLine line{{1, -2, 3}, {5, -40, 7}};
  const condyle_pose last = c_pose(poses().back());
  std::vector<double> deg(mobile.size());
  ASSERT_OK(condyle_joint_contact_arc_gaps(c.get(), &last, line.point.data(), line.direction.data(),
                                           CONDYLE_MOBILE, deg.data(), mobile.data(), mobile.size()));
  const auto arcs = cpp.tangential(poses().back(), line).mobile_in_fixed;
  EXPECT_EQ(mobile, arcs->arc_gap_mm);
  for (std::size_t v = 0; v < deg.size(); ++v) EXPECT_EQ(deg[v], arcs->angular_gap[v].degrees());
}

TEST(CInterface, SaysThatAnOpenBodyHasNoInside) {
  const TriMesh sheet = plane(2, 4), ball = sphere({0, 0.3, 0.1}, 1, 2);
  const contact::JointContact cpp(sheet, ball);
  const auto c = c_contact(sheet, ball);
  const auto results = made<HeldResults>(condyle_contact_results_create);
  // Off the vertices and the sheet, which hold the centre.
  const Pose X = rotated(10, {1, 0.3, 2}, {0.1, 0.2, 0});
  const condyle_pose pose = c_pose(X);
  try {
    const contact::Contact expected = cpp.at(X);
    ASSERT_OK(condyle_joint_contact_at(c.get(), &pose, results.get()));
    EXPECT_FALSE(expected.mobile_in_fixed);
    EXPECT_GT(expect_same(expected, results.get()), 0u);
  } catch (const std::exception& error) {
    FAIL() << error.what();
  }
}

TEST(CInterface, CastsNormalsAsCppDoes) {
  for (const auto rule : {contact::FaceRule::face_centre, contact::FaceRule::cut_faces}) {
    const contact::NormalDepth cpp(hip().hip_bone, hip().femur, {rule, 12});
    const auto c = made<HeldDepth>(condyle_normal_depth_create, c_mesh(hip().hip_bone).get(),
                                   c_mesh(hip().femur).get(), static_cast<int>(rule), 12.0);
    const auto results = made<HeldNormalResults>(condyle_normal_results_create);
    double area = 0;
    for (const Pose& X : poses()) {
      const condyle_pose pose = c_pose(X);
      ASSERT_OK(condyle_normal_depth_at(c.get(), &pose, results.get()));
      condyle_surface_contact surface;
      ASSERT_OK(condyle_normal_results_surface(results.get(), &surface));
      expect_same(cpp.at(X), surface);
      area += surface.area_mm2;
    }
    EXPECT_GT(area, 0);
  }
}

TEST(CInterface, PressesLayersAsCppDoes) {
  std::vector<double> of_vertices(hip().femur.vertices.size());
  for (std::size_t v = 0; v < of_vertices.size(); ++v) of_vertices[v] = 20 + 0.001 * static_cast<double>(v);
  const contact::ElasticLayer fixed{12, 0.45, 25.0}, mobile{8, 0.4, of_vertices};
  for (const auto casting : {contact::Casting::fixed, contact::Casting::mobile, contact::Casting::both}) {
    const contact::ElasticContactOptions options{
        casting, {contact::FaceRule::cut_faces, 15}, contact::PressureLaw::logarithmic, fixed, mobile};
    const contact::ElasticContact cpp(hip().hip_bone, hip().femur, options);
    const auto c = made<HeldElastic>(condyle_elastic_contact_create, c_mesh(hip().hip_bone).get(),
                                     c_mesh(hip().femur).get(), c_options(options).get());
    const auto results = made<HeldElasticResults>(condyle_elastic_results_create);
    double stored = 0;
    for (const Pose& X : poses()) {
      const condyle_pose pose = c_pose(X);
      ASSERT_OK(condyle_elastic_contact_at(c.get(), &pose, results.get()));
      const contact::ElasticContactResults expected = cpp.at(X);
      condyle_wrench on_mobile;
      double energy = -1;
      ASSERT_OK(condyle_elastic_results_load(results.get(), &on_mobile, &energy));
      EXPECT_EQ(vector(on_mobile.force_n), expected.on_mobile.force_n);
      EXPECT_EQ(vector(on_mobile.moment_nmm), expected.on_mobile.moment_nmm);
      EXPECT_EQ(energy, expected.energy_nmm);
      stored += energy;
      for (const auto& [body, cast] :
           {std::pair{CONDYLE_FIXED, &expected.fixed}, std::pair{CONDYLE_MOBILE, &expected.mobile}}) {
        condyle_surface_contact surface;
        ASSERT_OK(condyle_elastic_results_surface(results.get(), body, &surface));
        if (*cast)
          expect_same(**cast, surface);
        else
          EXPECT_EQ(surface.is_cast, 0);
      }
    }
    EXPECT_GT(stored, 0);
  }
}

TEST(CInterface, TurnsAboutAnAxisUpToTheContactOfCpp) {
  const Vec3 point(1, 0.5, 0), direction(0.1, 0.2, 1);
  const motion::FirstContact cpp(hip().hip_bone, hip().femur, AxisFrame(point, direction));
  const auto c = made<HeldRotation>(condyle_first_contact_create, c_mesh(hip().hip_bone).get(),
                                    c_mesh(hip().femur).get(), point.data(), direction.data());
  condyle_rotation_limit negative, positive;
  for (const Pose& X : poses()) {
    for (const double range : {5.0, 360.0}) {
      const condyle_pose pose = c_pose(X);
      ASSERT_OK(condyle_first_contact_limits(c.get(), &pose, -range, range, &negative, &positive));
      const motion::RotationLimits expected = cpp.limits(X, {Angle::degrees(-range), Angle::degrees(range)});
      expect_same(expected.negative, negative);
      expect_same(expected.positive, positive);
    }
  }
}

std::vector<condyle_free_interval> intervals_of(const HeldFree& results) {
  const condyle_free_interval* first = nullptr;
  std::size_t count = 0;
  EXPECT_OK(condyle_free_results_intervals(results.get(), &first, &count));
  return array(first, count);
}

TEST(CInterface, FindsTheFreeTurnsOfCpp) {
  const auto c = c_contact(hip().hip_bone, hip().femur);
  const auto results = made<HeldFree>(condyle_free_results_create);
  const Vec3 point(1, 0.5, 0), direction(0.1, 0.2, 1);
  condyle_rotation_limit negative, positive;
  std::size_t free_at_start = 0, in_contact = 0;
  for (const Pose& X : poses()) {
    const condyle_pose pose = c_pose(X);
    ASSERT_OK(condyle_joint_contact_turn(c.get(), &pose, point.data(), direction.data(), &negative, &positive,
                                         results.get()));
    const motion::FreeAngles expected = answer_turn(hip().hip_bone, hip().femur, {direction, point, X}).free;
    expect_same(expected.from_start.negative, negative);
    expect_same(expected.from_start.positive, positive);
    ++(expected.from_start.free_at_start() ? free_at_start : in_contact);
    const auto intervals = intervals_of(results);
    ASSERT_EQ(intervals.size(), expected.intervals.size());
    for (std::size_t i = 0; i < intervals.size(); ++i) {
      EXPECT_EQ(intervals[i].low, expected.intervals[i].low.degrees());
      EXPECT_EQ(intervals[i].high, expected.intervals[i].high.degrees());
      EXPECT_EQ(intervals[i].low_error_bound, expected.intervals[i].at_low.error_bound.degrees());
      EXPECT_EQ(intervals[i].high_error_bound, expected.intervals[i].at_high.error_bound.degrees());
    }
  }
  EXPECT_GT(free_at_start, 0u);
  EXPECT_GT(in_contact, 0u);
}

TEST(CInterface, SlidesABoxBetweenTwoWallsFromOneToTheOther) {
  const TriMesh walls = joined(box({-10, -5, -5}, {-8, 5, 5}), box({7, -5, -5}, {10, 5, 5}));
  const auto c = made<HeldContact>(condyle_joint_contact_create, c_mesh(walls).get(),
                                   c_mesh(box({-1, -1, -1}, {1, 1, 1})).get());
  const auto results = made<HeldFree>(condyle_free_results_create);
  constexpr double endless = std::numeric_limits<double>::infinity();
  // Twice as long and the other way round: lengths are mm along the direction all the same.
  const double direction[] = {-2, 0, 0};
  condyle_slide_limit negative, positive;
  const auto slide_from = [&](const Vec3& place) {
    condyle_pose pose = c_pose(rotated(0, {0, 0, 1}, place));
    EXPECT_OK(condyle_joint_contact_slide(c.get(), &pose, direction, &negative, &positive, results.get()));
  };
  slide_from({0, 0, 0});
  EXPECT_NEAR(negative.moved_mm, -6, 1e-12);
  EXPECT_NEAR(positive.moved_mm, 7, 1e-12);
  EXPECT_LT(positive.error_bound_mm, 1e-12);
  EXPECT_EQ(positive.reason, CONDYLE_CONTACT);
  ASSERT_EQ(positive.has_witness, 1);
  EXPECT_NEAR(positive.fixed_point_mm[0], -8, 1e-12);
  EXPECT_NEAR(positive.mobile_point_mm[0], -1, 1e-12);
  EXPECT_LT(positive.fixed_triangle, 24u);
  EXPECT_LT(positive.mobile_triangle, 12u);
  // From the first wall on, between them, and from the second one on.
  const auto intervals = intervals_of(results);
  ASSERT_EQ(intervals.size(), 3u);
  EXPECT_EQ(intervals[0].low, -endless);
  EXPECT_NEAR(intervals[0].high, -11, 1e-12);
  EXPECT_NEAR(intervals[1].low, -6, 1e-12);
  EXPECT_NEAR(intervals[1].high, 7, 1e-12);
  EXPECT_NEAR(intervals[2].low, 11, 1e-12);
  EXPECT_EQ(intervals[2].high, endless);
  slide_from({8, 0, 0});
  EXPECT_EQ(negative.reason, CONDYLE_CONTACT_AT_START);
  EXPECT_EQ(negative.moved_mm, 0);
  EXPECT_EQ(positive.has_witness, 0);
  slide_from({0, 20, 0});
  EXPECT_EQ(negative.reason, CONDYLE_END_OF_RANGE);
  EXPECT_EQ(negative.moved_mm, -endless);
  EXPECT_EQ(positive.moved_mm, endless);
  EXPECT_EQ(intervals_of(results).size(), 1u);
}

TEST(CInterface, AnswersManyThreadsOfOneObjectAsOne) {
  const auto c = c_contact(hip().hip_bone, hip().femur);
  const contact::JointContact cpp(hip().hip_bone, hip().femur);
  std::vector<contact::Contact> expected;
  for (const Pose& X : poses()) expected.push_back(cpp.at(X));
  std::vector<std::thread> threads;
  for (std::size_t first = 0; first < 4; ++first) {
    threads.emplace_back([&, first] {
      const auto results = made<HeldResults>(condyle_contact_results_create);
      for (std::size_t i = 0; i < 2 * expected.size(); ++i) {
        const std::size_t n = (first + i) % expected.size();
        const condyle_pose pose = c_pose(poses()[n]);
        ASSERT_OK(condyle_joint_contact_at(c.get(), &pose, results.get()));
        expect_same(expected[n], results.get());
      }
    });
  }
  for (std::thread& thread : threads) thread.join();
}

}  // namespace
}  // namespace condyle
