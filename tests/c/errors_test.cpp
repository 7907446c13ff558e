#include <thread>

#include "c/held.hpp"
#include "support/test.hpp"

/// What C passes in wrong comes back as a status and a line.

namespace condyle {
namespace {

using namespace test;

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
#define EXPECT_BAD(call, text) EXPECT_FAILS(call, CONDYLE_BAD_ARGUMENT, text)

TEST(CErrors, AMeshIsRefusedByItsFirstBadElement) {
  const double xyz[] = {0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1};
  const std::uint32_t bad[] = {0, 2, 1, 0, 1, 9};
  condyle_mesh* mesh = nullptr;
  EXPECT_FAILS(condyle_mesh_create(xyz, 4, bad, 2, &mesh), CONDYLE_BAD_MESH, "triangle 1 uses vertex 9 of 4");
  const double nan[] = {0, 0, std::numeric_limits<double>::quiet_NaN()};
  EXPECT_FAILS(condyle_mesh_create(nan, 1, nullptr, 0, &mesh), CONDYLE_BAD_MESH, "vertex 0");
  EXPECT_BAD(condyle_mesh_create(nullptr, 4, bad, 2, &mesh), "xyz_mm is a null pointer");
  EXPECT_BAD(condyle_mesh_create(xyz, 4, nullptr, 2, &mesh), "triangles is a null pointer");
  EXPECT_BAD(condyle_mesh_create(xyz, 4, bad, 1, nullptr), "mesh is a null pointer");
  EXPECT_FAILS(condyle_mesh_create(xyz, std::size_t{1} << 62, bad, 1, &mesh), CONDYLE_OUT_OF_MEMORY,
               "out of memory");
  EXPECT_EQ(mesh, nullptr);
}

TEST(CErrors, NullPointersAreNamed) {
  const TwoBoxes boxes;
  const auto *F = boxes.fixed.get(), *M = boxes.mobile.get();
  condyle_joint_contact* contact = nullptr;
  condyle_vertices_inside vertices;
  int answer = -7;
  EXPECT_BAD(condyle_joint_contact_create(nullptr, M, &contact), "fixed");
  EXPECT_BAD(condyle_joint_contact_create(F, nullptr, &contact), "mobile");
  EXPECT_BAD(condyle_joint_contact_create(F, M, nullptr), "contact");
  EXPECT_BAD(condyle_joint_contact_at(nullptr, &c_identity, boxes.results.get()), "contact");
  EXPECT_BAD(condyle_joint_contact_at(boxes.contact.get(), nullptr, boxes.results.get()), "X_FM");
  EXPECT_BAD(condyle_joint_contact_at(boxes.contact.get(), &c_identity, nullptr), "results");
  EXPECT_BAD(condyle_joint_contact_in_contact(nullptr, &c_identity, &answer), "contact");
  EXPECT_BAD(condyle_joint_contact_touch(boxes.contact.get(), &c_identity, 0, nullptr), "touch");
  EXPECT_BAD(condyle_joint_contact_in_contact(boxes.contact.get(), &c_identity, nullptr), "in_contact");
  EXPECT_BAD(condyle_contact_results_vertices(nullptr, CONDYLE_FIXED, &vertices),
             "results is a null pointer");
  EXPECT_BAD(condyle_contact_results_create(nullptr), "results");
  EXPECT_BAD(condyle_normal_results_create(nullptr), "results");
  EXPECT_BAD(condyle_elastic_results_create(nullptr), "results");
  EXPECT_BAD(condyle_elastic_options_create(nullptr), "options");
  EXPECT_BAD(condyle_elastic_options_set_law(nullptr, CONDYLE_LINEAR), "options");
  EXPECT_BAD(condyle_elastic_contact_create(F, M, nullptr, nullptr), "contact");
  EXPECT_BAD(condyle_first_contact_create(F, M, nullptr, nullptr, nullptr), "first_contact");
  EXPECT_BAD(condyle_first_contact_limits(nullptr, &c_identity, 0, 0, nullptr, nullptr), "first_contact");
  EXPECT_BAD(condyle_normal_depth_at(nullptr, &c_identity, nullptr), "results");
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
  condyle_pose pose = c_identity;
  pose.rotation[4] = std::numeric_limits<double>::infinity();
  EXPECT_BAD(at(pose), "X_FM: rotation[4] is not finite");
  pose = c_identity;
  pose.translation_mm[2] = std::numeric_limits<double>::quiet_NaN();
  EXPECT_BAD(at(pose), "X_FM: translation_mm[2] is not finite");
  pose.translation_mm[2] = 1e31;
  EXPECT_BAD(at(pose), "1e30");
  EXPECT_BAD(at(condyle_pose{}), "not orthonormal");
  pose = c_identity;
  pose.rotation[8] = -1;
  EXPECT_BAD(at(pose), "a reflection is no pose");
  // Just beside: rows to six decimals.
  pose = {{0.866025, -0.5, 0, 0.5, 0.866025, 0, 0, 0, 1}, {0, 0, 0}};
  EXPECT_OK(at(pose));
  pose.rotation[0] = 0.86602;
  EXPECT_BAD(at(pose), "not orthonormal");
}

TEST(CErrors, ResultsOfAFailedQueryHaveNoAnswer) {
  const TwoBoxes boxes;
  condyle_vertices_inside vertices;
  const std::uint32_t* pairs;
  std::size_t count;
  int in_contact;
  const auto* results = boxes.results.get();
  EXPECT_BAD(condyle_contact_results_vertices(results, CONDYLE_FIXED, &vertices), "no answer");
  ASSERT_OK(condyle_joint_contact_at(boxes.contact.get(), &c_identity, boxes.results.get()));
  ASSERT_OK(condyle_contact_results_vertices(results, CONDYLE_FIXED, &vertices));
  EXPECT_BAD(condyle_contact_results_vertices(results, 2, &vertices), "body");
  EXPECT_BAD(condyle_contact_results_pairs(results, nullptr, &count), "pairs");
  const condyle_pose none = {};
  ASSERT_EQ(condyle_joint_contact_at(boxes.contact.get(), &none, boxes.results.get()), CONDYLE_BAD_ARGUMENT);
  EXPECT_BAD(condyle_contact_results_pairs(results, &pairs, &count), "no answer");
  EXPECT_BAD(condyle_contact_results_in_contact(results, &in_contact), "no answer");
}

TEST(CErrors, GapsToAnOpenBodyAndIntoTooShortAnArrayAreRefused) {
  const HeldMesh open = c_mesh(posed(Pose(Eigen::Translation3d(0, -3, 0)), plane(2, 2))),
                 closed = c_mesh(box({-1, -1, -1}, {1, 1, 1}));
  const auto contact = made<HeldContact>(condyle_joint_contact_create, open.get(), closed.get());
  std::vector<double> gaps(8, -7);
  EXPECT_FAILS(condyle_joint_contact_radial_gaps(contact.get(), &c_identity, CONDYLE_MOBILE, gaps.data(), 8),
               CONDYLE_BAD_MESH, "");
  EXPECT_BAD(condyle_joint_contact_radial_gaps(contact.get(), &c_identity, CONDYLE_FIXED, gaps.data(), 8),
             "count is 8, and the body has 9 vertices");
  EXPECT_EQ(gaps, std::vector<double>(8, -7));
}

TEST(CErrors, ACentreOnASurfaceIsABadMesh) {
  const HeldMesh on_surface = c_mesh(box({0, -1, -1}, {2, 1, 1})), other = c_mesh(box({5, 5, 5}, {6, 6, 6}));
  const auto contact = made<HeldContact>(condyle_joint_contact_create, on_surface.get(), other.get());
  const auto results = made<HeldResults>(condyle_contact_results_create);
  EXPECT_FAILS(condyle_joint_contact_at(contact.get(), &c_identity, results.get()), CONDYLE_BAD_MESH,
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
  EXPECT_BAD(create(), "needs a layer");
  EXPECT_BAD(condyle_elastic_options_set_casting(options.get(), 3), "casting: there is no value 3");
  EXPECT_BAD(condyle_elastic_options_set_law(options.get(), -1), "law: there is no value -1");
  EXPECT_BAD(condyle_elastic_options_set_rays(options.get(), 2, 20), "rule: there is no value 2");
  EXPECT_BAD(layer(1, 0, nullptr, 1), "thickness_mm");
  EXPECT_BAD(layer(1, 0, &thin, 0), "thickness_count");
  EXPECT_OK(layer(1, 0.5, &thin, 1));
  EXPECT_BAD(create(), "fixed");
  EXPECT_OK(layer(1, 0, &none, 1));
  EXPECT_BAD(create(), "fixed");
  EXPECT_OK(layer(1, 0, three, 3));
  EXPECT_BAD(create(), "3");
  EXPECT_OK(layer(1, 0, &thin, 1));
  EXPECT_OK(condyle_elastic_options_set_rays(options.get(), CONDYLE_CUT_FACES, -1));
  EXPECT_BAD(create(), "reach");
  EXPECT_EQ(contact, nullptr);
  // An overlap of 0.5 mm in a layer of 0.1 mm.
  EXPECT_OK(condyle_elastic_options_set_rays(options.get(), CONDYLE_CUT_FACES, 20));
  EXPECT_OK(condyle_elastic_options_set_law(options.get(), CONDYLE_LOGARITHMIC));
  ASSERT_OK(create());
  const HeldElastic held(contact);
  const auto results = made<HeldElasticResults>(condyle_elastic_results_create);
  EXPECT_FAILS(condyle_elastic_contact_at(contact, &c_identity, results.get()), CONDYLE_BAD_MESH, "triangle");
  condyle_surface_contact surface;
  EXPECT_BAD(condyle_elastic_results_surface(results.get(), CONDYLE_FIXED, &surface), "no answer");
}

TEST(CErrors, ARotationHasAnAxisAndARange) {
  const TwoBoxes boxes;
  const double origin[] = {0, 0, 0}, z[] = {0, 0, 1};
  condyle_first_contact* made_contact = nullptr;
  EXPECT_BAD(
      condyle_first_contact_create(boxes.fixed.get(), boxes.mobile.get(), origin, origin, &made_contact), "");
  const auto contact =
      made<HeldRotation>(condyle_first_contact_create, boxes.fixed.get(), boxes.mobile.get(), origin, z);
  condyle_rotation_limit negative, positive;
  EXPECT_BAD(condyle_first_contact_limits(contact.get(), &c_identity, 1, 2, &negative, &positive), "");
  EXPECT_BAD(condyle_first_contact_limits(contact.get(), &c_identity, -1, 361, &negative, &positive), "");
  ASSERT_OK(condyle_first_contact_limits(contact.get(), &c_identity, -1, 1, &negative, &positive));
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
    return condyle_joint_contact_turn(boxes.contact.get(), &c_identity, origin, axis, &turned, positive,
                                      into);
  };
  const auto slide = [&](const double* along, condyle_slide_limit* positive, condyle_free_results* into) {
    return condyle_joint_contact_slide(boxes.contact.get(), &c_identity, along, &moved, positive, into);
  };
  EXPECT_BAD(condyle_free_results_create(nullptr), "results");
  EXPECT_BAD(condyle_free_results_intervals(results.get(), &intervals, &count), "no answer");
  EXPECT_BAD(turn(z, &turned, nullptr), "results is a null pointer");
  EXPECT_BAD(turn(z, nullptr, results.get()), "positive is a null pointer");
  EXPECT_BAD(turn(nullptr, &turned, results.get()), "axis_direction");
  EXPECT_BAD(turn(origin, &turned, results.get()), "axis: a direction is finite");
  EXPECT_BAD(slide(z, &moved, nullptr), "results is a null pointer");
  EXPECT_BAD(slide(z, nullptr, results.get()), "positive is a null pointer");
  EXPECT_BAD(slide(origin, &moved, results.get()), "along: a direction is finite");
  const HeldMesh empty = c_mesh({});
  const auto nothing = made<HeldContact>(condyle_joint_contact_create, boxes.fixed.get(), empty.get());
  EXPECT_FAILS(condyle_joint_contact_slide(nothing.get(), &c_identity, z, &moved, &moved, results.get()),
               CONDYLE_BAD_MESH, "the mobile body has no triangle");
  ASSERT_OK(slide(z, &moved, results.get()));
  EXPECT_EQ(moved.reason, CONDYLE_CONTACT_AT_START);
  EXPECT_BAD(condyle_free_results_intervals(results.get(), nullptr, &count), "intervals");
  ASSERT_EQ(slide(origin, &moved, results.get()), CONDYLE_BAD_ARGUMENT);
  EXPECT_BAD(condyle_free_results_intervals(results.get(), &intervals, &count), "no answer");
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
