#include <gtest/gtest.h>

#include <limits>
#include <string>
#include <thread>

#include "c/held.hpp"
#include "support/test_meshes.hpp"

/// What C passes in wrong comes back as a status and a line.

namespace condyle {
namespace {

using namespace test;

constexpr condyle_pose identity = {{1, 0, 0, 0, 1, 0, 0, 0, 1}, {0, 0, 0}};

/// Two boxes that overlap, their centres in F's origin and apart from it.
struct TwoBoxes {
  HeldMesh fixed = c_mesh(box({-1, -1, -1}, {1, 1, 1})),
           mobile = c_mesh(box({0.5, -0.5, -0.5}, {2, 0.5, 0.5}));
  HeldContact contact = made<HeldContact>(condyle_joint_contact_create, fixed.get(), mobile.get());
  HeldResults results = made<HeldResults>(condyle_contact_results_create);
};

#define EXPECT_FAILS(call, status, text)                                     \
  EXPECT_EQ(call, status);                                                   \
  EXPECT_NE(std::string(condyle_last_error()).find(text), std::string::npos) \
      << "reports '" << condyle_last_error() << "', not '" << text << "'"

TEST(CErrors, AMeshIsRefusedByItsFirstBadElement) {
  const double xyz[] = {0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1};
  const std::uint32_t bad[] = {0, 2, 1, 0, 1, 9};
  condyle_mesh* mesh = nullptr;
  EXPECT_FAILS(condyle_mesh_create(xyz, 4, bad, 2, &mesh), CONDYLE_BAD_MESH, "triangle 1 uses vertex 9 of 4");
  const double nan[] = {0, 0, std::numeric_limits<double>::quiet_NaN()};
  EXPECT_FAILS(condyle_mesh_create(nan, 1, nullptr, 0, &mesh), CONDYLE_BAD_MESH, "vertex 0");
  EXPECT_FAILS(condyle_mesh_create(nullptr, 4, bad, 2, &mesh), CONDYLE_BAD_ARGUMENT,
               "xyz_mm is a null pointer");
  EXPECT_FAILS(condyle_mesh_create(xyz, 4, nullptr, 2, &mesh), CONDYLE_BAD_ARGUMENT,
               "triangles is a null pointer");
  EXPECT_FAILS(condyle_mesh_create(xyz, 4, bad, 1, nullptr), CONDYLE_BAD_ARGUMENT, "mesh is a null pointer");
  EXPECT_FAILS(condyle_mesh_create(xyz, std::size_t{1} << 62, bad, 1, &mesh), CONDYLE_OUT_OF_MEMORY,
               "out of memory");
  EXPECT_EQ(mesh, nullptr);
}

TEST(CErrors, NullPointersAreNamed) {
  const TwoBoxes boxes;
  condyle_joint_contact* contact = nullptr;
  condyle_vertices_inside vertices;
  int answer = -7;
  EXPECT_FAILS(condyle_joint_contact_create(nullptr, boxes.mobile.get(), &contact), CONDYLE_BAD_ARGUMENT,
               "fixed");
  EXPECT_FAILS(condyle_joint_contact_create(boxes.fixed.get(), nullptr, &contact), CONDYLE_BAD_ARGUMENT,
               "mobile");
  EXPECT_FAILS(condyle_joint_contact_create(boxes.fixed.get(), boxes.mobile.get(), nullptr),
               CONDYLE_BAD_ARGUMENT, "contact");
  EXPECT_FAILS(condyle_joint_contact_at(nullptr, &identity, boxes.results.get()), CONDYLE_BAD_ARGUMENT,
               "contact");
  EXPECT_FAILS(condyle_joint_contact_at(boxes.contact.get(), nullptr, boxes.results.get()),
               CONDYLE_BAD_ARGUMENT, "X_FM");
  EXPECT_FAILS(condyle_joint_contact_at(boxes.contact.get(), &identity, nullptr), CONDYLE_BAD_ARGUMENT,
               "results");
  EXPECT_FAILS(condyle_joint_contact_in_contact(nullptr, &identity, &answer), CONDYLE_BAD_ARGUMENT,
               "contact");
  EXPECT_FAILS(condyle_joint_contact_touch(boxes.contact.get(), &identity, 0, nullptr), CONDYLE_BAD_ARGUMENT,
               "touch");
  EXPECT_FAILS(condyle_joint_contact_in_contact(boxes.contact.get(), &identity, nullptr),
               CONDYLE_BAD_ARGUMENT, "in_contact");
  EXPECT_FAILS(condyle_contact_results_vertices(nullptr, CONDYLE_FIXED, &vertices), CONDYLE_BAD_ARGUMENT,
               "results is a null pointer");
  EXPECT_FAILS(condyle_contact_results_create(nullptr), CONDYLE_BAD_ARGUMENT, "results");
  EXPECT_FAILS(condyle_normal_results_create(nullptr), CONDYLE_BAD_ARGUMENT, "results");
  EXPECT_FAILS(condyle_elastic_results_create(nullptr), CONDYLE_BAD_ARGUMENT, "results");
  EXPECT_FAILS(condyle_elastic_options_create(nullptr), CONDYLE_BAD_ARGUMENT, "options");
  EXPECT_FAILS(condyle_elastic_options_set_law(nullptr, CONDYLE_LINEAR), CONDYLE_BAD_ARGUMENT, "options");
  EXPECT_FAILS(condyle_elastic_contact_create(boxes.fixed.get(), boxes.mobile.get(), nullptr, nullptr),
               CONDYLE_BAD_ARGUMENT, "contact");
  EXPECT_FAILS(condyle_first_contact_create(boxes.fixed.get(), boxes.mobile.get(), nullptr, nullptr, nullptr),
               CONDYLE_BAD_ARGUMENT, "first_contact");
  EXPECT_FAILS(condyle_first_contact_limits(nullptr, &identity, 0, 0, nullptr, nullptr), CONDYLE_BAD_ARGUMENT,
               "first_contact");
  EXPECT_FAILS(condyle_normal_depth_at(nullptr, &identity, nullptr), CONDYLE_BAD_ARGUMENT, "results");
  EXPECT_EQ(contact, nullptr);
  EXPECT_EQ(answer, -7);
  EXPECT_EQ(condyle_mesh_vertex_count(nullptr), 0u);
  EXPECT_EQ(condyle_mesh_triangle_count(nullptr), 0u);
  EXPECT_EQ(condyle_mesh_is_closed(nullptr), 0);
  condyle_mesh_destroy(nullptr);
  condyle_joint_contact_destroy(nullptr);
  condyle_contact_results_destroy(nullptr);
  condyle_normal_depth_destroy(nullptr);
  condyle_normal_results_destroy(nullptr);
  condyle_elastic_options_destroy(nullptr);
  condyle_elastic_contact_destroy(nullptr);
  condyle_elastic_results_destroy(nullptr);
  condyle_first_contact_destroy(nullptr);
}

TEST(CErrors, APoseIsARigidMotion) {
  const TwoBoxes boxes;
  const auto at = [&](const condyle_pose& pose) {
    return condyle_joint_contact_at(boxes.contact.get(), &pose, boxes.results.get());
  };
  condyle_pose pose = identity;
  pose.rotation[4] = std::numeric_limits<double>::infinity();
  EXPECT_FAILS(at(pose), CONDYLE_BAD_ARGUMENT, "X_FM: rotation[4] is not finite");
  pose = identity;
  pose.translation_mm[2] = std::numeric_limits<double>::quiet_NaN();
  EXPECT_FAILS(at(pose), CONDYLE_BAD_ARGUMENT, "X_FM: translation_mm[2] is not finite");
  pose.translation_mm[2] = 1e31;
  EXPECT_FAILS(at(pose), CONDYLE_BAD_ARGUMENT, "1e30");
  EXPECT_FAILS(at(condyle_pose{}), CONDYLE_BAD_ARGUMENT, "not orthonormal");
  pose = identity;
  pose.rotation[8] = -1;
  EXPECT_FAILS(at(pose), CONDYLE_BAD_ARGUMENT, "a reflection is no pose");
  // Just beside: rows to six decimals.
  pose = {{0.866025, -0.5, 0, 0.5, 0.866025, 0, 0, 0, 1}, {0, 0, 0}};
  EXPECT_EQ(at(pose), CONDYLE_OK) << condyle_last_error();
  pose.rotation[0] = 0.86602;
  EXPECT_FAILS(at(pose), CONDYLE_BAD_ARGUMENT, "not orthonormal");
}

TEST(CErrors, ResultsOfAFailedQueryHaveNoAnswer) {
  const TwoBoxes boxes;
  condyle_vertices_inside vertices;
  const std::uint32_t* pairs;
  std::size_t count;
  int in_contact;
  const auto* results = boxes.results.get();
  EXPECT_FAILS(condyle_contact_results_vertices(results, CONDYLE_FIXED, &vertices), CONDYLE_BAD_ARGUMENT,
               "no answer");
  ASSERT_EQ(condyle_joint_contact_at(boxes.contact.get(), &identity, boxes.results.get()), CONDYLE_OK);
  ASSERT_EQ(condyle_contact_results_vertices(results, CONDYLE_FIXED, &vertices), CONDYLE_OK);
  EXPECT_FAILS(condyle_contact_results_vertices(results, 2, &vertices), CONDYLE_BAD_ARGUMENT, "body");
  EXPECT_FAILS(condyle_contact_results_pairs(results, nullptr, &count), CONDYLE_BAD_ARGUMENT, "pairs");
  const condyle_pose none = {};
  ASSERT_EQ(condyle_joint_contact_at(boxes.contact.get(), &none, boxes.results.get()), CONDYLE_BAD_ARGUMENT);
  EXPECT_FAILS(condyle_contact_results_pairs(results, &pairs, &count), CONDYLE_BAD_ARGUMENT, "no answer");
  EXPECT_FAILS(condyle_contact_results_in_contact(results, &in_contact), CONDYLE_BAD_ARGUMENT, "no answer");
}

TEST(CErrors, GapsToAnOpenBodyAndIntoTooShortAnArrayAreRefused) {
  const HeldMesh open = c_mesh(posed(Pose(Eigen::Translation3d(0, -3, 0)), plane(2, 2))),
                 closed = c_mesh(box({-1, -1, -1}, {1, 1, 1}));
  const auto contact = made<HeldContact>(condyle_joint_contact_create, open.get(), closed.get());
  std::vector<double> gaps(8, -7);
  EXPECT_FAILS(condyle_joint_contact_radial_gaps(contact.get(), &identity, CONDYLE_MOBILE, gaps.data(), 8),
               CONDYLE_BAD_MESH, "");
  EXPECT_FAILS(condyle_joint_contact_radial_gaps(contact.get(), &identity, CONDYLE_FIXED, gaps.data(), 8),
               CONDYLE_BAD_ARGUMENT, "count is 8, and the body has 9 vertices");
  EXPECT_EQ(gaps, std::vector<double>(8, -7));
}

TEST(CErrors, ACentreOnASurfaceIsABadMesh) {
  const HeldMesh on_surface = c_mesh(box({0, -1, -1}, {2, 1, 1})), other = c_mesh(box({5, 5, 5}, {6, 6, 6}));
  const auto contact = made<HeldContact>(condyle_joint_contact_create, on_surface.get(), other.get());
  const auto results = made<HeldResults>(condyle_contact_results_create);
  EXPECT_FAILS(condyle_joint_contact_at(contact.get(), &identity, results.get()), CONDYLE_BAD_MESH,
               "fixed body");
}

TEST(CErrors, OptionsOutsideTheirDomainAreRefused) {
  const TwoBoxes boxes;
  const auto options = made<HeldOptions>(condyle_elastic_options_create);
  const double thin = 0.1, none = 0, three[] = {1, 1, 1};
  condyle_elastic_contact* contact = nullptr;
  const auto create = [&] {
    return condyle_elastic_contact_create(boxes.fixed.get(), boxes.mobile.get(), options.get(), &contact);
  };
  const auto layer = [&](double E, double nu, const double* thickness, std::size_t count) {
    return condyle_elastic_options_set_layer(options.get(), CONDYLE_FIXED, E, nu, thickness, count);
  };
  EXPECT_FAILS(create(), CONDYLE_BAD_ARGUMENT, "needs a layer");
  EXPECT_FAILS(condyle_elastic_options_set_casting(options.get(), 3), CONDYLE_BAD_ARGUMENT,
               "casting: there is no value 3");
  EXPECT_FAILS(condyle_elastic_options_set_law(options.get(), -1), CONDYLE_BAD_ARGUMENT,
               "law: there is no value -1");
  EXPECT_FAILS(condyle_elastic_options_set_rays(options.get(), 2, 20), CONDYLE_BAD_ARGUMENT,
               "rule: there is no value 2");
  EXPECT_FAILS(layer(1, 0, nullptr, 1), CONDYLE_BAD_ARGUMENT, "thickness_mm");
  EXPECT_FAILS(layer(1, 0, &thin, 0), CONDYLE_BAD_ARGUMENT, "thickness_count");
  EXPECT_EQ(layer(1, 0.5, &thin, 1), CONDYLE_OK);
  EXPECT_FAILS(create(), CONDYLE_BAD_ARGUMENT, "fixed");
  EXPECT_EQ(layer(1, 0, &none, 1), CONDYLE_OK);
  EXPECT_FAILS(create(), CONDYLE_BAD_ARGUMENT, "fixed");
  EXPECT_EQ(layer(1, 0, three, 3), CONDYLE_OK);
  EXPECT_FAILS(create(), CONDYLE_BAD_ARGUMENT, "3");
  EXPECT_EQ(layer(1, 0, &thin, 1), CONDYLE_OK);
  EXPECT_EQ(condyle_elastic_options_set_rays(options.get(), CONDYLE_CUT_FACES, -1), CONDYLE_OK);
  EXPECT_FAILS(create(), CONDYLE_BAD_ARGUMENT, "reach");
  EXPECT_EQ(contact, nullptr);
  // An overlap of 0.5 mm in a layer of 0.1 mm.
  EXPECT_EQ(condyle_elastic_options_set_rays(options.get(), CONDYLE_CUT_FACES, 20), CONDYLE_OK);
  EXPECT_EQ(condyle_elastic_options_set_law(options.get(), CONDYLE_LOGARITHMIC), CONDYLE_OK);
  ASSERT_EQ(create(), CONDYLE_OK);
  const HeldElastic held(contact);
  const auto results = made<HeldElasticResults>(condyle_elastic_results_create);
  EXPECT_FAILS(condyle_elastic_contact_at(contact, &identity, results.get()), CONDYLE_BAD_MESH, "triangle");
  condyle_surface_contact surface;
  EXPECT_FAILS(condyle_elastic_results_surface(results.get(), CONDYLE_FIXED, &surface), CONDYLE_BAD_ARGUMENT,
               "no answer");
}

TEST(CErrors, ARotationHasAnAxisAndARange) {
  const TwoBoxes boxes;
  const double origin[] = {0, 0, 0}, z[] = {0, 0, 1};
  condyle_first_contact* made_contact = nullptr;
  EXPECT_FAILS(
      condyle_first_contact_create(boxes.fixed.get(), boxes.mobile.get(), origin, origin, &made_contact),
      CONDYLE_BAD_ARGUMENT, "");
  const auto contact =
      made<HeldRotation>(condyle_first_contact_create, boxes.fixed.get(), boxes.mobile.get(), origin, z);
  condyle_rotation_limit negative, positive;
  EXPECT_FAILS(condyle_first_contact_limits(contact.get(), &identity, 1, 2, &negative, &positive),
               CONDYLE_BAD_ARGUMENT, "");
  EXPECT_FAILS(condyle_first_contact_limits(contact.get(), &identity, -1, 361, &negative, &positive),
               CONDYLE_BAD_ARGUMENT, "");
  ASSERT_EQ(condyle_first_contact_limits(contact.get(), &identity, -1, 1, &negative, &positive), CONDYLE_OK);
  EXPECT_EQ(positive.reason, CONDYLE_CONTACT_AT_START);
}

TEST(CErrors, TurnsAndSlidesHaveADirectionAndResults) {
  const TwoBoxes boxes;
  const auto results = made<HeldFree>(condyle_free_results_create);
  const double origin[] = {0, 0, 0}, z[] = {0, 0, 1};
  condyle_rotation_limit turned;
  condyle_slide_limit moved;
  const condyle_free_interval* intervals;
  std::size_t count;
  const auto turn = [&](const double* axis, condyle_rotation_limit* positive, condyle_free_results* into) {
    return condyle_joint_contact_turn(boxes.contact.get(), &identity, origin, axis, &turned, positive, into);
  };
  const auto slide = [&](const double* along, condyle_slide_limit* positive, condyle_free_results* into) {
    return condyle_joint_contact_slide(boxes.contact.get(), &identity, along, &moved, positive, into);
  };
  EXPECT_FAILS(condyle_free_results_create(nullptr), CONDYLE_BAD_ARGUMENT, "results");
  EXPECT_FAILS(condyle_free_results_intervals(results.get(), &intervals, &count), CONDYLE_BAD_ARGUMENT,
               "no answer");
  EXPECT_FAILS(turn(z, &turned, nullptr), CONDYLE_BAD_ARGUMENT, "results is a null pointer");
  EXPECT_FAILS(turn(z, nullptr, results.get()), CONDYLE_BAD_ARGUMENT, "positive is a null pointer");
  EXPECT_FAILS(turn(nullptr, &turned, results.get()), CONDYLE_BAD_ARGUMENT, "axis_direction");
  EXPECT_FAILS(turn(origin, &turned, results.get()), CONDYLE_BAD_ARGUMENT, "axis: a direction is finite");
  EXPECT_FAILS(slide(z, &moved, nullptr), CONDYLE_BAD_ARGUMENT, "results is a null pointer");
  EXPECT_FAILS(slide(z, nullptr, results.get()), CONDYLE_BAD_ARGUMENT, "positive is a null pointer");
  EXPECT_FAILS(slide(origin, &moved, results.get()), CONDYLE_BAD_ARGUMENT, "along: a direction is finite");
  const HeldMesh empty = c_mesh({});
  const auto nothing = made<HeldContact>(condyle_joint_contact_create, boxes.fixed.get(), empty.get());
  EXPECT_FAILS(condyle_joint_contact_slide(nothing.get(), &identity, z, &moved, &moved, results.get()),
               CONDYLE_BAD_MESH, "the mobile body has no triangle");
  ASSERT_EQ(slide(z, &moved, results.get()), CONDYLE_OK) << condyle_last_error();
  EXPECT_EQ(moved.reason, CONDYLE_CONTACT_AT_START);
  EXPECT_FAILS(condyle_free_results_intervals(results.get(), nullptr, &count), CONDYLE_BAD_ARGUMENT,
               "intervals");
  ASSERT_EQ(slide(origin, &moved, results.get()), CONDYLE_BAD_ARGUMENT);
  EXPECT_FAILS(condyle_free_results_intervals(results.get(), &intervals, &count), CONDYLE_BAD_ARGUMENT,
               "no answer");
  condyle_free_results_destroy(nullptr);
}

TEST(CErrors, EachThreadHasALineOfItsOwn) {
  EXPECT_EQ(condyle_mesh_create(nullptr, 1, nullptr, 0, nullptr), CONDYLE_BAD_ARGUMENT);
  const std::string here = condyle_last_error();
  std::string before, there;
  std::thread([&] {
    before = condyle_last_error();
    EXPECT_EQ(condyle_elastic_options_create(nullptr), CONDYLE_BAD_ARGUMENT);
    there = condyle_last_error();
  }).join();
  EXPECT_EQ(before, "");
  EXPECT_EQ(there, "options is a null pointer");
  EXPECT_EQ(condyle_last_error(), here);
  // A call that succeeds leaves it.
  EXPECT_NE(c_mesh(box({0, 0, 0}, {1, 1, 1})), nullptr);
  EXPECT_EQ(condyle_last_error(), here);
}

}  // namespace
}  // namespace condyle
