#include "c/held.hpp"
#include "c/same_answers.hpp"
#include "condyle/pressure.hpp"
#include "support/test.hpp"

/// Forces for a simulator, and contacts that are stepped, have the bits of C++.

namespace condyle {
namespace {

using namespace test;

/// A ball in a ring whose tube it is pressed into, in C++ and in C.
struct BallInRing {
  TriMesh ring = torus(12, 6, 40, 24), ball = sphere(Vec3::Zero(), 10, 3);
  Pose X_FM = rotated(40, {1, 2, 3}, {0.2, -0.1, 7.2});
  contact::ElasticContactOptions options;
  contact::ElasticContact cpp{ring, ball, options};
  HeldElastic c = made<HeldElastic>(condyle_elastic_contact_create, c_mesh(ring).get(), c_mesh(ball).get(),
                                    c_options(options).get());

  explicit BallInRing(contact::Casting casting = contact::Casting::both)
      : options{.casting = casting,
                .fixed = contact::ElasticLayer{12, 0.42, 2.0},
                .mobile = contact::ElasticLayer{8, 0.45, 1.5}} {}
};

void expect_same_wrench(const contact::Wrench& cpp, const condyle_wrench& c) {
  EXPECT_EQ(vector(c.force_n), cpp.force_n);
  EXPECT_EQ(vector(c.moment_nmm), cpp.moment_nmm);
}

void expect_same_vertices(const std::vector<contact::VertexForce>& cpp, const condyle_vertex_forces& c) {
  ASSERT_EQ(c.count, cpp.size());
  for (std::size_t i = 0; i < c.count; ++i) {
    ASSERT_EQ(c.vertex[i], cpp[i].vertex);
    ASSERT_EQ(Vec3(c.force_n[3 * i], c.force_n[3 * i + 1], c.force_n[3 * i + 2]), cpp[i].force_n);
  }
}

/// All parts of C's results against those of C++.
void expect_same_forces(const contact::ContactForces& cpp, const condyle_force_results* c) {
  condyle_force_load load;
  ASSERT_OK(condyle_force_results_load(c, &load));
  expect_same_wrench(cpp.on_mobile_body, load.on_mobile);
  EXPECT_EQ(
      (std::array{load.energy_nmm, load.friction_power, load.damping_power, load.max_strain, load.factor}),
      (std::array{cpp.energy_nmm, cpp.friction_power, cpp.damping_power, cpp.max_strain, cpp.factor}));
  double stiffness[36];
  ASSERT_OK(condyle_force_results_stiffness(c, stiffness));
  for (int i = 0; i < 6; ++i)
    for (int k = 0; k < 6; ++k) EXPECT_EQ(stiffness[6 * i + k], cpp.stiffness(i, k));
  condyle_vertex_forces fixed, mobile;
  ASSERT_OK(condyle_force_results_vertices(c, CONDYLE_FIXED, &fixed));
  ASSERT_OK(condyle_force_results_vertices(c, CONDYLE_MOBILE, &mobile));
  expect_same_vertices(cpp.on_fixed, fixed);
  expect_same_vertices(cpp.on_mobile, mobile);
  condyle_vertex_stiffness pairs;
  ASSERT_OK(condyle_force_results_vertex_stiffness(c, &pairs));
  ASSERT_EQ(pairs.count, cpp.vertex_stiffness.size());
  for (std::size_t n = 0; n < pairs.count; ++n) {
    const contact::VertexStiffness& expected = cpp.vertex_stiffness[n];
    ASSERT_EQ(pairs.row[n], expected.row);
    ASSERT_EQ(pairs.column[n], expected.column);
    for (int i = 0; i < 3; ++i)
      for (int k = 0; k < 3; ++k)
        ASSERT_EQ(pairs.block[9 * n + 3 * static_cast<std::size_t>(i) + static_cast<std::size_t>(k)],
                  expected.block(i, k));
  }
  const condyle_force_patch* patches;
  std::size_t count;
  ASSERT_OK(condyle_force_results_patches(c, &patches, &count));
  ASSERT_EQ(count, cpp.patches.size());
  for (std::size_t i = 0; i < count; ++i) {
    const contact::ForcePatch& a = cpp.patches[i];
    const condyle_force_patch& b = patches[i];
    EXPECT_EQ(b.casting, a.casting == BodyRole::fixed ? CONDYLE_FIXED : CONDYLE_MOBILE);
    const auto faces = cpp.faces_of(a);
    EXPECT_EQ(array(b.faces, b.face_count), std::vector<Index>(faces.begin(), faces.end()));
    EXPECT_EQ((std::array{b.area_mm2, b.max_pressure_mpa, b.load_n}),
              (std::array{a.area_mm2, a.max_pressure_mpa, a.load_n}));
    expect_same_wrench(a.on_mobile_body, b.on_mobile);
    EXPECT_EQ(vector(b.centre_of_pressure_mm), a.centre_of_pressure);
    EXPECT_EQ(vector(b.centre_of_area_mm), a.centre_of_area);
  }
}

TEST(CForces, AreThoseOfCppAtEachStepInOneResultsObject) {
  for (const auto casting : {contact::Casting::fixed, contact::Casting::mobile, contact::Casting::both}) {
    BallInRing on(casting);
    const auto options = made<HeldForceOptions>(condyle_force_options_create);
    const auto results = made<HeldForces>(condyle_force_results_create);
    contact::ForceOptions given{
        .vertex_forces = true, .stiffness = true, .vertex_stiffness = true, .patches = true};
    ASSERT_OK(condyle_force_options_set_parts(options.get(), all_parts));
    std::size_t pushed = 0;
    const auto expect_same_step = [&](const Pose& X_FM) {
      const condyle_pose pose = c_pose(X_FM);
      ASSERT_OK(condyle_elastic_contact_forces(on.c.get(), &pose, options.get(), results.get()));
      const contact::ContactForces expected = on.cpp.forces(X_FM, given);
      expect_same_forces(expected, results.get());
      pushed += expected.energy_nmm > 0;
    };
    expect_same_step(on.X_FM);
    given.motion = {{3, -2, 1.5}, {0.1, -0.2, 0.15}};
    ASSERT_OK(condyle_force_options_set_motion(options.get(), given.motion.velocity_mm_s.data(),
                                               given.motion.angular_velocity_rad_s.data()));
    expect_same_step(on.X_FM);
    given.friction = 0.1, given.slip_velocity_mm_s = 0.5;
    ASSERT_OK(condyle_force_options_set_friction(options.get(), 0.1, 0.5));
    expect_same_step(on.X_FM);
    given.damping_s_per_mm = 0.02;
    ASSERT_OK(condyle_force_options_set_damping(options.get(), 0.02));
    expect_same_step(on.X_FM);
    given.factor = 0.3;
    ASSERT_OK(condyle_force_options_set_factor(options.get(), 0.3));
    expect_same_step(on.X_FM);
    EXPECT_EQ(pushed, 5u);
    // Apart; and in contact again, with bodies that have deformed.
    expect_same_step(rotated(0, {0, 0, 1}, {100, 0, 0}));
    EXPECT_EQ(pushed, 5u);
    for (const auto& [role, body, first] : {std::tuple{BodyRole::fixed, CONDYLE_FIXED, &on.ring},
                                            std::tuple{BodyRole::mobile, CONDYLE_MOBILE, &on.ball}}) {
      Points larger = first->vertices;
      for (double& x : larger.x) x *= 1.01;
      on.cpp.update(role, larger);
      ASSERT_OK(condyle_elastic_contact_update(on.c.get(), body, c_points(larger).data(), larger.size()));
      expect_same_step(on.X_FM);
      const std::vector<Index> some = {7, 1, 30};
      Points places;
      for (const Index v : some) places.push_back(1.02 * first->vertices[v]);
      on.cpp.update(role, some, places);
      ASSERT_OK(condyle_elastic_contact_update_some(on.c.get(), body, some.data(), some.size(),
                                                    c_points(places).data()));
      expect_same_step(on.X_FM);
    }
    EXPECT_EQ(pushed, 9u);
  }
}

TEST(CForces, TheStiffnessPushesBack) {
  // A block of 10 mm x 10 mm, 0.1 mm deep in a layer of 6 MPa / mm, whose force falls by 600 N per mm that it is lifted.
  const HeldMesh F = c_mesh(box({-40, -10, -40}, {40, 0, 40})), M = c_mesh(box({-5, -0.1, -5}, {5, 1, 5}));
  const HeldOptions layer = c_layer(10, 0.25, 2, CONDYLE_CAST_MOBILE);
  const auto contact = made<HeldElastic>(condyle_elastic_contact_create, F.get(), M.get(), layer.get());
  const auto options = made<HeldForceOptions>(condyle_force_options_create);
  const auto results = made<HeldForces>(condyle_force_results_create);
  ASSERT_OK(condyle_force_options_set_parts(options.get(), CONDYLE_STIFFNESS));
  ASSERT_OK(condyle_elastic_contact_forces(contact.get(), &c_identity, options.get(), results.get()));
  double stiffness[36];
  condyle_force_load load;
  ASSERT_OK(condyle_force_results_stiffness(results.get(), stiffness));
  ASSERT_OK(condyle_force_results_load(results.get(), &load));
  EXPECT_NEAR(load.on_mobile.force_n[1], 60, 1e-9);
  EXPECT_NEAR(stiffness[7], 600, 1e-9);
  // Turned about z it takes 6 MPa / mm times the second moment of its area, and at most what 60 N do at 0.1 mm.
  EXPECT_NEAR(stiffness[35], 6 * 10 * 1000 / 12.0, 6);
  condyle_vertex_forces vertices;
  EXPECT_EQ(condyle_force_results_vertices(results.get(), CONDYLE_FIXED, &vertices), CONDYLE_BAD_ARGUMENT);
  EXPECT_STREQ(condyle_last_error(), "the results have no vertex forces among their parts");
}

TEST(CForces, ARampIsThatOfCpp) {
  const BallInRing on;
  const condyle_pose pose = c_pose(on.X_FM), apart = c_pose(rotated(0, {0, 0, 1}, {100, 0, 0}));
  const contact::ContactRamp cpp(on.cpp, on.X_FM, 0.05);
  const auto c = made<HeldRamp>(condyle_ramp_create, on.c.get(), &pose, 0.05);
  EXPECT_GT(condyle_ramp_max_depth_mm(c.get()), 0);
  EXPECT_EQ(condyle_ramp_max_depth_mm(c.get()), cpp.max_depth_mm());
  EXPECT_EQ(condyle_ramp_energy_nmm(c.get()), cpp.energy_nmm());
  for (const double t : {-1.0, 0.0, 0.01, 0.025, 0.04, 0.05, 1.0})
    EXPECT_EQ(condyle_ramp_factor_at(c.get(), t), cpp.factor_at(t));
  const auto none = made<HeldRamp>(condyle_ramp_create, on.c.get(), &apart, 0.05);
  EXPECT_EQ(condyle_ramp_max_depth_mm(none.get()), 0);
  EXPECT_EQ(condyle_ramp_factor_at(none.get(), 0), 1);
  condyle_ramp* ramp = nullptr;
  EXPECT_EQ(condyle_ramp_create(on.c.get(), &pose, 0, &ramp), CONDYLE_BAD_ARGUMENT);
  EXPECT_STREQ(condyle_last_error(), "the duration of a ramp must be above 0 s");
  EXPECT_EQ(condyle_ramp_create(nullptr, &pose, 1, &ramp), CONDYLE_BAD_ARGUMENT);
  EXPECT_EQ(condyle_ramp_create(on.c.get(), &pose, 1, nullptr), CONDYLE_BAD_ARGUMENT);
  EXPECT_EQ(ramp, nullptr);
  EXPECT_EQ(condyle_ramp_max_depth_mm(nullptr), 0);
  EXPECT_EQ(condyle_ramp_energy_nmm(nullptr), 0);
  EXPECT_EQ(condyle_ramp_factor_at(nullptr, 0), 1);
  condyle_ramp_destroy(nullptr);
}

TEST(CForces, OptionsOutsideTheirDomainAreRefusedWithTheLineOfCpp) {
  const BallInRing on;
  const auto options = made<HeldForceOptions>(condyle_force_options_create);
  const auto results = made<HeldForces>(condyle_force_results_create);
  const double nan = std::nan(""), none[] = {0, 0, 0}, bad[] = {0, nan, 0};
  expect_refused(condyle_force_options_set_motion(options.get(), bad, none), "the velocity must be finite");
  expect_refused(condyle_force_options_set_motion(options.get(), none, bad),
                 "the angular velocity must be finite");
  expect_refused(condyle_force_options_set_motion(options.get(), nullptr, none),
                 "velocity_mm_s is a null pointer");
  expect_refused(condyle_force_options_set_friction(options.get(), -1e-9, 1),
                 "the coefficient of friction must be 0 or more");
  expect_refused(condyle_force_options_set_friction(options.get(), 0.1, 0),
                 "the slip velocity must be above 0 mm/s");
  expect_refused(condyle_force_options_set_damping(options.get(), nan), "the damping must be 0 s/mm or more");
  expect_refused(condyle_force_options_set_factor(options.get(), 1.0001), "the factor must be from 0 to 1");
  expect_refused(condyle_force_options_set_parts(options.get(), 16), "parts: there is no value 16");
  expect_refused(condyle_force_options_set_parts(options.get(), -1), "parts: there is no value -1");
  expect_refused(condyle_force_options_set_factor(nullptr, 1), "options is a null pointer");
  expect_refused(condyle_force_options_create(nullptr), "options is a null pointer");
  expect_refused(condyle_force_results_create(nullptr), "results is a null pointer");
  const condyle_pose pose = c_pose(on.X_FM), broken = {};
  condyle_force_load load;
  expect_refused(condyle_force_results_load(results.get(), &load),
                 "the results have no answer: the last query failed, or there was none");
  expect_refused(condyle_elastic_contact_forces(nullptr, &pose, options.get(), results.get()),
                 "contact is a null pointer");
  expect_refused(condyle_elastic_contact_forces(on.c.get(), &pose, nullptr, results.get()),
                 "options is a null pointer");
  expect_refused(condyle_elastic_contact_forces(on.c.get(), &pose, options.get(), nullptr),
                 "results is a null pointer");
  // What was refused left the options as they were.
  ASSERT_OK(condyle_elastic_contact_forces(on.c.get(), &pose, options.get(), results.get()));
  ASSERT_OK(condyle_force_results_load(results.get(), &load));
  const contact::ContactForces expected = on.cpp.forces(on.X_FM);
  expect_same_wrench(expected.on_mobile_body, load.on_mobile);
  EXPECT_EQ(load.factor, 1);
  EXPECT_EQ(load.friction_power, 0);
  double stiffness[36];
  const condyle_force_patch* patches;
  std::size_t count;
  condyle_vertex_stiffness pairs;
  expect_refused(condyle_force_results_stiffness(results.get(), stiffness),
                 "the results have no stiffness among their parts");
  expect_refused(condyle_force_results_vertex_stiffness(results.get(), &pairs),
                 "the results have no vertex stiffness among their parts");
  expect_refused(condyle_force_results_patches(results.get(), &patches, &count),
                 "the results have no patches among their parts");
  EXPECT_EQ(condyle_elastic_contact_forces(on.c.get(), &broken, options.get(), results.get()),
            CONDYLE_BAD_ARGUMENT);
  EXPECT_EQ(condyle_force_results_load(results.get(), &load), CONDYLE_BAD_ARGUMENT);
  condyle_force_options_destroy(nullptr);
  condyle_force_results_destroy(nullptr);
}

}  // namespace
}  // namespace condyle
