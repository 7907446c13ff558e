#include <atomic>
#include <new>
#include <numeric>

#include "c/held.hpp"
#include "condyle/normal_depth.hpp"
#include "support/test.hpp"

/// Whichever allocation fails, C sees a status, and what it holds is as usable as before.

namespace {

/// Allocations that succeed before one fails, in this thread; none fails below 0.
thread_local long allocations_left = -1;
/// In all threads.
std::atomic<long> allocations = 0;

void* allocated(std::size_t bytes) {
  allocations.fetch_add(1, std::memory_order_relaxed);
  if (allocations_left == 0) {
    allocations_left = -1;
    return nullptr;
  }
  if (allocations_left > 0) --allocations_left;
  return std::malloc(bytes == 0 ? 1 : bytes);
}

}  // namespace

// Inlined, malloc and delete do not match for GCC 12.
[[gnu::noinline]] void* operator new(std::size_t bytes) {
  void* memory = allocated(bytes);
  if (!memory) throw std::bad_alloc();
  return memory;
}
[[gnu::noinline]] void* operator new[](std::size_t bytes) {
  return operator new(bytes);
}
[[gnu::noinline]] void* operator new(std::size_t bytes, const std::nothrow_t&) noexcept {
  return allocated(bytes);
}
[[gnu::noinline]] void* operator new[](std::size_t bytes, const std::nothrow_t&) noexcept {
  return allocated(bytes);
}
[[gnu::noinline]] void operator delete(void* memory) noexcept {
  std::free(memory);
}
[[gnu::noinline]] void operator delete[](void* memory) noexcept {
  std::free(memory);
}
[[gnu::noinline]] void operator delete(void* memory, std::size_t) noexcept {
  std::free(memory);
}
[[gnu::noinline]] void operator delete[](void* memory, std::size_t) noexcept {
  std::free(memory);
}

namespace condyle {
namespace {

using namespace test;

/// Calls with the first allocation failing, then the second and so on, until none does; how many failed. After each call
/// then(status), for which none fails.
template <class Call, class Then>
long failures_until_success(const Call& call, const Then& then) {
  for (long n = 0;; ++n) {
    allocations_left = n;
    const condyle_status status = call();
    const bool has_failed = allocations_left < 0;
    allocations_left = -1;
    EXPECT_TRUE(status == CONDYLE_OK || has_failed) << condyle_last_error();
    EXPECT_TRUE(status == CONDYLE_OUT_OF_MEMORY || status == CONDYLE_OK)
        << status << ": " << condyle_last_error();
    EXPECT_TRUE(status == CONDYLE_OK || std::string_view(condyle_last_error()) == "out of memory");
    then(status);
    if (!has_failed || testing::Test::HasFailure()) return n;
  }
}
long failures_until_success(const auto& call) {
  return failures_until_success(call, [](condyle_status) {});
}

template <class... Arguments>
long failures_of(condyle_status (*call)(Arguments...), auto... arguments) {
  return failures_until_success([&] { return call(arguments...); });
}

/// Calls a _create function, and keeps the object that it makes.
template <class Object, class... Arguments>
long failures_until_made(Object& object, condyle_status (*create)(Arguments...), auto... arguments) {
  return failures_until_success([&] {
    typename Object::pointer given = nullptr;
    const condyle_status status = create(arguments..., &given);
    object.reset(given);
    return status;
  });
}

/// Forces with all their parts, of bodies that move.
void set_all(condyle_force_options* options) {
  const double velocity[] = {3, -2, 1.5}, angular_velocity[] = {0.1, -0.2, 0.15};
  EXPECT_OK(condyle_force_options_set_parts(options, all_parts));
  EXPECT_OK(condyle_force_options_set_motion(options, velocity, angular_velocity));
  EXPECT_OK(condyle_force_options_set_friction(options, 0.1, 1));
  EXPECT_OK(condyle_force_options_set_damping(options, 0.01));
}

/// oneTBB has to be running: without memory at its start it waits for itself for ever.
class CMemory : public testing::Test {
 protected:
  static void SetUpTestSuite() {
    (void)contact::NormalDepth(box({0, 0, 0}, {1, 1, 1}), box({0, 0, 0}, {1, 1, 1}));
  }
};

TEST_F(CMemory, EveryAllocationOfAJointContactMayFail) {
  const TriMesh fixed = socket(Vec3::Zero(), 1.0, 1.3, 1), mobile = sphere({0.1, 0.1, 0.05}, 1.05, 2);
  const condyle_pose pose = {{1, 0, 0, 0, 1, 0, 0, 0, 1}, {0.01, 0.02, 0}};
  HeldMesh F = c_mesh(fixed), M = c_mesh(mobile);
  const double xyz[] = {0, 0, 0, 1, 0, 0, 0, 1, 0};
  const std::uint32_t triangle[] = {0, 1, 2};
  HeldMesh one;
  EXPECT_GT(failures_until_made(one, condyle_mesh_create, xyz, 3, triangle, 1), 4);
  HeldContact contact;
  EXPECT_GT(failures_until_made(contact, condyle_joint_contact_create, F.get(), M.get()), 2);
  const auto results = made<HeldResults>(condyle_contact_results_create);
  EXPECT_GT(failures_of(condyle_joint_contact_at, contact.get(), &pose, results.get()), 10);
  // With tables that were made while memory ran out again and again, the answer is that of ones made at once.
  const auto fresh = made<HeldContact>(condyle_joint_contact_create, F.get(), M.get());
  const auto expected = made<HeldResults>(condyle_contact_results_create);
  ASSERT_OK(condyle_joint_contact_at(fresh.get(), &pose, expected.get()));
  for (const condyle_body body : {CONDYLE_FIXED, CONDYLE_MOBILE}) {
    condyle_vertices_inside a, b;
    ASSERT_OK(condyle_contact_results_vertices(results.get(), body, &a));
    ASSERT_OK(condyle_contact_results_vertices(expected.get(), body, &b));
    ASSERT_EQ(a.count, b.count);
    EXPECT_GT(a.count, 0u);
    EXPECT_TRUE(std::equal(a.depth_mm, a.depth_mm + a.count, b.depth_mm));
  }
}

TEST_F(CMemory, EveryAllocationOfAnElasticContactMayFail) {
  const HeldMesh F = c_mesh(box({-40, -10, -40}, {40, 0, 40})), M = c_mesh(box({-1, -0.1, -1}, {1, 1, 1}));
  const HeldOptions options = c_layer(10, 0.25, 2);
  HeldElastic contact;
  EXPECT_GT(failures_until_made(contact, condyle_elastic_contact_create, F.get(), M.get(), options.get()), 2);
  const auto results = made<HeldElasticResults>(condyle_elastic_results_create);
  EXPECT_GT(failures_of(condyle_elastic_contact_at, contact.get(), &c_identity, results.get()), 2);
  condyle_surface_contact surface;
  ASSERT_OK(condyle_elastic_results_surface(results.get(), CONDYLE_MOBILE, &surface));
  // 6 MPa per mm of overlap, 0.1 mm, 4 mm2.
  EXPECT_NEAR(surface.area_mm2, 4, 1e-12);
  EXPECT_NEAR(surface.max_pressure_mpa, 0.6, 1e-12);
}

/// A ball in a socket, and two shapes of the ball that the socket holds deeper and less deep.
struct DeformingBall {
  TriMesh socket = test::socket(Vec3::Zero(), 10, 13, 2);
  std::array<TriMesh, 2> balls = {sphere({0, 0.2, 0}, 9.9, 2), sphere({0, 0.3, 0.1}, 10.0, 2)};
  HeldMesh F = c_mesh(socket), M = c_mesh(balls[0]);
  HeldElastic elastic(const TriMesh& ball) const {
    return made<HeldElastic>(condyle_elastic_contact_create, F.get(), c_mesh(ball).get(),
                             c_layer(10, 0.4, 2).get());
  }
};

/// The depths of the mobile body's vertices, by vertex: after an update their order may differ.
std::vector<std::pair<std::uint32_t, double>> depths_of(const condyle_contact_results* results) {
  condyle_vertices_inside inside;
  EXPECT_OK(condyle_contact_results_vertices(results, CONDYLE_MOBILE, &inside));
  std::vector<std::pair<std::uint32_t, double>> depths;
  for (std::size_t i = 0; i < inside.count; ++i) depths.emplace_back(inside.vertex[i], inside.depth_mm[i]);
  std::sort(depths.begin(), depths.end());
  return depths;
}

TEST_F(CMemory, AnUpdateOfAJointContactThatFailsChangesNothing) {
  const DeformingBall scene;
  const auto contact = made<HeldContact>(condyle_joint_contact_create, scene.F.get(), scene.M.get());
  const auto results = made<HeldResults>(condyle_contact_results_create);
  const auto answer_of = [&](const condyle_joint_contact* of) {
    EXPECT_OK(condyle_joint_contact_at(of, &c_identity, results.get()));
    const std::uint32_t* pairs;
    std::size_t count;
    EXPECT_OK(condyle_contact_results_pairs(results.get(), &pairs, &count));
    return std::pair(depths_of(results.get()), std::vector<std::uint32_t>(pairs, pairs + 2 * count));
  };
  std::array answers = {
      answer_of(contact.get()),
      answer_of(made<HeldContact>(condyle_joint_contact_create, scene.F.get(), c_mesh(scene.balls[1]).get())
                    .get())};
  ASSERT_NE(answers[0], answers[1]);
  ASSERT_FALSE(answers[0].first.empty());
  long failed = 0;
  // To and fro, some or all vertices, so that updates of all kinds meet tables that are new and tables that have slack.
  std::vector<std::uint32_t> numbers(scene.balls[0].vertices.size());
  std::iota(numbers.begin(), numbers.end(), 0u);
  for (std::size_t step = 1; step < 6; ++step) {
    const std::vector<double> xyz = c_points(scene.balls[step % 2].vertices);
    std::size_t now = (step + 1) % 2;
    failed += failures_until_success(
        [&] {
          return step < 3
                     ? condyle_joint_contact_update(contact.get(), CONDYLE_MOBILE, xyz.data(), numbers.size())
                     : condyle_joint_contact_update_some(contact.get(), CONDYLE_MOBILE, numbers.data(),
                                                         numbers.size(), xyz.data());
        },
        [&](condyle_status status) {
          if (status == CONDYLE_OK) now = step % 2;
          EXPECT_EQ(answer_of(contact.get()), answers[now]);
        });
  }
  EXPECT_GT(failed, 20);
}

TEST_F(CMemory, AnUpdateOfAnElasticContactThatFailsChangesNothingOrIsKnown) {
  const DeformingBall scene;
  const auto options = made<HeldForceOptions>(condyle_force_options_create);
  const auto results = made<HeldForces>(condyle_force_results_create);
  const auto force_of = [&](const condyle_elastic_contact* of) {
    condyle_force_load load;
    EXPECT_OK(condyle_elastic_contact_forces(of, &c_identity, options.get(), results.get()));
    EXPECT_OK(condyle_force_results_load(results.get(), &load));
    return load.on_mobile.force_n[1];
  };
  const double before = force_of(scene.elastic(scene.balls[0]).get()),
               after = force_of(scene.elastic(scene.balls[1]).get());
  ASSERT_NE(before, after);
  const std::vector<double> xyz = c_points(scene.balls[1].vertices);
  const auto update = [&](condyle_elastic_contact* contact) {
    return condyle_elastic_contact_update(contact, CONDYLE_MOBILE, xyz.data(), xyz.size() / 3);
  };
  long unchanged = 0, lost = 0;
  HeldElastic contact = scene.elastic(scene.balls[0]);
  failures_until_success(
      [&] { return update(contact.get()); },
      [&](condyle_status status) {
        if (status == CONDYLE_OK) {
          EXPECT_EQ(force_of(contact.get()), after);
          contact = scene.elastic(scene.balls[0]);
        } else if (condyle_elastic_contact_forces(contact.get(), &c_identity, options.get(), results.get()) ==
                   CONDYLE_OK) {
          EXPECT_EQ(force_of(contact.get()), before);
          ++unchanged;
        } else {
          const std::string line = "memory ran out in an update of this contact: it has to be made anew";
          EXPECT_EQ(condyle_last_error(), line);
          EXPECT_EQ(update(contact.get()), CONDYLE_BAD_ARGUMENT);
          EXPECT_EQ(condyle_last_error(), line);
          contact = scene.elastic(scene.balls[0]);
          ++lost;
        }
      });
  EXPECT_GT(unchanged, 3);
  EXPECT_GT(lost, 3);
}

TEST_F(CMemory, EveryAllocationOfForcesMayFail) {
  const DeformingBall scene;
  const HeldElastic contact = scene.elastic(scene.balls[0]);
  HeldForceOptions options;
  EXPECT_EQ(failures_until_made(options, condyle_force_options_create), 1);
  set_all(options.get());
  const auto results = made<HeldForces>(condyle_force_results_create);
  const auto step = [&] {
    return condyle_elastic_contact_forces(contact.get(), &c_identity, options.get(), results.get());
  };
  EXPECT_GT(failures_until_success(step), 10);
  condyle_force_load load, expected;
  ASSERT_OK(condyle_force_results_load(results.get(), &load));
  const auto fresh = made<HeldForces>(condyle_force_results_create);
  ASSERT_OK(condyle_elastic_contact_forces(scene.elastic(scene.balls[0]).get(), &c_identity, options.get(),
                                           fresh.get()));
  ASSERT_OK(condyle_force_results_load(fresh.get(), &expected));
  EXPECT_TRUE(std::equal(load.on_mobile.force_n, load.on_mobile.force_n + 3, expected.on_mobile.force_n));
  EXPECT_GT(load.energy_nmm, 0);
  HeldRamp ramp;
  EXPECT_GT(failures_until_made(ramp, condyle_ramp_create, contact.get(), &c_identity, 0.1), 1);
}

TEST_F(CMemory, StepsOfOneResultsObjectTakeNoMemory) {
  // On a sheet, which has no inside: points that are decided exactly in a closed body take memory for the moment.
  const HeldMesh F = c_mesh(plane(12, 24)), M = c_mesh(sphere({0, 10, 0}, 10, 3));
  const HeldOptions layer = c_layer(10, 0.4, 2, CONDYLE_CAST_MOBILE);
  const auto contact = made<HeldElastic>(condyle_elastic_contact_create, F.get(), M.get(), layer.get());
  const auto options = made<HeldForceOptions>(condyle_force_options_create);
  set_all(options.get());
  const auto results = made<HeldForces>(condyle_force_results_create);
  condyle_pose pose = c_identity;
  condyle_force_load load;
  long before = 0;
  // The second time capacities are large enough.
  for (int i = 0; i < 40; ++i) {
    if (i == 20) before = allocations;
    pose.translation_mm[1] = -0.3 - 0.02 * (i % 20);
    ASSERT_OK(condyle_elastic_contact_forces(contact.get(), &pose, options.get(), results.get()));
    ASSERT_OK(condyle_force_results_load(results.get(), &load));
    EXPECT_GT(load.energy_nmm, 0);
  }
  EXPECT_EQ(allocations - before, 0);
}

TEST_F(CMemory, EveryAllocationOfARotationMayFail) {
  const HeldMesh F = c_mesh(box({5, -30, -10}, {15, 30, 10})), M = c_mesh(box({-1, -10, -1}, {1, -1, 1}));
  const double origin[] = {0, 0, 0}, z[] = {0, 0, 1};
  HeldRotation contact;
  EXPECT_GT(failures_until_made(contact, condyle_first_contact_create, F.get(), M.get(), origin, z), 2);
  condyle_rotation_limit negative, positive;
  EXPECT_GT(
      failures_of(condyle_first_contact_limits, contact.get(), &c_identity, -360, 360, &negative, &positive),
      2);
  // The corner at (1, -10) meets x = 5: sqrt(101) sin(a + t) = 5 with tan(a) = 1 / 10.
  const double turned = (std::asin(5 / std::sqrt(101.0)) - std::atan(0.1)) * 180 / M_PI;
  EXPECT_NEAR(positive.turned_deg, turned, 1e-9);
  const auto both = made<HeldContact>(condyle_joint_contact_create, F.get(), M.get());
  const auto results = made<HeldFree>(condyle_free_results_create);
  EXPECT_GT(failures_of(condyle_joint_contact_turn, both.get(), &c_identity, origin, z, &negative, &positive,
                        results.get()),
            10);
  EXPECT_NEAR(positive.turned_deg, turned, 1e-9);
  const double x[] = {1, 0, 0};
  condyle_slide_limit back, on;
  EXPECT_GT(failures_of(condyle_joint_contact_slide, both.get(), &c_identity, x, &back, &on, results.get()),
            10);
  EXPECT_NEAR(on.moved_mm, 4, 1e-12);
}

}  // namespace
}  // namespace condyle
