#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <new>
#include <string_view>

#include "c/held.hpp"
#include "support/test_meshes.hpp"

/// Whichever allocation fails, C sees a status, and what it holds is as usable as before.

namespace {

/// Allocations that succeed before one fails, in this thread; none fails below 0.
thread_local long allocations_left = -1;

void* allocated(std::size_t bytes) {
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

/// Calls with the first allocation failing, then the second and so on, until none does; how many failed.
template <class Call>
long failures_until_success(const Call& call) {
  for (long n = 0;; ++n) {
    allocations_left = n;
    const condyle_status status = call();
    const bool has_failed = allocations_left < 0;
    allocations_left = -1;
    if (!has_failed) {
      EXPECT_EQ(status, CONDYLE_OK) << condyle_last_error();
      return n;
    }
    EXPECT_TRUE(status == CONDYLE_OUT_OF_MEMORY || status == CONDYLE_OK)
        << status << ": " << condyle_last_error();
    EXPECT_TRUE(status == CONDYLE_OK || std::string_view(condyle_last_error()) == "out of memory");
    if (testing::Test::HasFailure()) return n;
  }
}

TEST(CMemory, EveryAllocationOfAJointContactMayFail) {
  const TriMesh fixed = socket(Vec3::Zero(), 1.0, 1.3, 1), mobile = sphere({0.1, 0.1, 0.05}, 1.05, 2);
  const condyle_pose pose = {{1, 0, 0, 0, 1, 0, 0, 0, 1}, {0.01, 0.02, 0}};
  HeldMesh F = c_mesh(fixed), M = c_mesh(mobile);
  const double xyz[] = {0, 0, 0, 1, 0, 0, 0, 1, 0};
  const std::uint32_t triangle[] = {0, 1, 2};
  HeldMesh one;
  EXPECT_GT(failures_until_success([&] {
              condyle_mesh* mesh = nullptr;
              const condyle_status status = condyle_mesh_create(xyz, 3, triangle, 1, &mesh);
              one.reset(mesh);
              return status;
            }),
            4);
  HeldContact contact;
  EXPECT_GT(failures_until_success([&] {
              condyle_joint_contact* given = nullptr;
              const condyle_status status = condyle_joint_contact_create(F.get(), M.get(), &given);
              contact.reset(given);
              return status;
            }),
            2);
  const auto results = made<HeldResults>(condyle_contact_results_create);
  EXPECT_GT(
      failures_until_success([&] { return condyle_joint_contact_at(contact.get(), &pose, results.get()); }),
      10);
  // With tables that were made while memory ran out again and again, the answer is that of ones made at once.
  const auto fresh = made<HeldContact>(condyle_joint_contact_create, F.get(), M.get());
  const auto expected = made<HeldResults>(condyle_contact_results_create);
  ASSERT_EQ(condyle_joint_contact_at(fresh.get(), &pose, expected.get()), CONDYLE_OK);
  for (const condyle_body body : {CONDYLE_FIXED, CONDYLE_MOBILE}) {
    condyle_vertices_inside a, b;
    ASSERT_EQ(condyle_contact_results_vertices(results.get(), body, &a), CONDYLE_OK);
    ASSERT_EQ(condyle_contact_results_vertices(expected.get(), body, &b), CONDYLE_OK);
    ASSERT_EQ(a.count, b.count);
    EXPECT_GT(a.count, 0u);
    EXPECT_TRUE(std::equal(a.depth_mm, a.depth_mm + a.count, b.depth_mm));
  }
}

TEST(CMemory, EveryAllocationOfAnElasticContactMayFail) {
  const HeldMesh F = c_mesh(box({-40, -10, -40}, {40, 0, 40})), M = c_mesh(box({-1, -0.1, -1}, {1, 1, 1}));
  const condyle_pose pose = {{1, 0, 0, 0, 1, 0, 0, 0, 1}, {0, 0, 0}};
  const auto options = made<HeldOptions>(condyle_elastic_options_create);
  const double thickness = 2;
  ASSERT_EQ(condyle_elastic_options_set_layer(options.get(), CONDYLE_FIXED, 10, 0.25, &thickness, 1),
            CONDYLE_OK);
  HeldElastic contact;
  EXPECT_GT(failures_until_success([&] {
              condyle_elastic_contact* given = nullptr;
              const condyle_status status =
                  condyle_elastic_contact_create(F.get(), M.get(), options.get(), &given);
              contact.reset(given);
              return status;
            }),
            2);
  const auto results = made<HeldElasticResults>(condyle_elastic_results_create);
  EXPECT_GT(
      failures_until_success([&] { return condyle_elastic_contact_at(contact.get(), &pose, results.get()); }),
      2);
  condyle_surface_contact surface;
  ASSERT_EQ(condyle_elastic_results_surface(results.get(), CONDYLE_MOBILE, &surface), CONDYLE_OK);
  // 6 MPa per mm of overlap, 0.1 mm, 4 mm2.
  EXPECT_NEAR(surface.area_mm2, 4, 1e-12);
  EXPECT_NEAR(surface.max_pressure_mpa, 0.6, 1e-12);
}

TEST(CMemory, EveryAllocationOfARotationMayFail) {
  const HeldMesh F = c_mesh(box({5, -30, -10}, {15, 30, 10})), M = c_mesh(box({-1, -10, -1}, {1, -1, 1}));
  const condyle_pose pose = {{1, 0, 0, 0, 1, 0, 0, 0, 1}, {0, 0, 0}};
  const double origin[] = {0, 0, 0}, z[] = {0, 0, 1};
  HeldRotation contact;
  EXPECT_GT(failures_until_success([&] {
              condyle_first_contact* given = nullptr;
              const condyle_status status = condyle_first_contact_create(F.get(), M.get(), origin, z, &given);
              contact.reset(given);
              return status;
            }),
            2);
  condyle_rotation_limit negative, positive;
  EXPECT_GT(failures_until_success([&] {
              return condyle_first_contact_limits(contact.get(), &pose, -360, 360, &negative, &positive);
            }),
            2);
  // The corner at (1, -10) meets x = 5: sqrt(101) sin(a + t) = 5 with tan(a) = 1 / 10.
  EXPECT_NEAR(positive.turned_deg, (std::asin(5 / std::sqrt(101.0)) - std::atan(0.1)) * 180 / M_PI, 1e-9);
}

}  // namespace
}  // namespace condyle
