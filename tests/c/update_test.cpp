#include <sys/mman.h>
#include <unistd.h>

#include "c/held.hpp"
#include "c/same_answers.hpp"
#include "support/test.hpp"

/// Contacts of C follow bodies that deform as those of C++ do, and refuse what these refuse.

namespace condyle {
namespace {

using namespace test;

/// A body that swells and shrinks along waves.
Points waved(const Points& first, double phase) {
  Points moved(first.size());
  for (std::size_t v = 0; v < first.size(); ++v) {
    const Vec3 p = first[v];
    moved.set(v, (1 + 0.02 * std::sin(0.1 * p.x() + 0.2 * p.y() + phase)) * p);
  }
  return moved;
}

/// Every seventh vertex, and where a wave takes it.
struct SomeMoved {
  std::vector<Index> vertices = {};
  Points positions = {};
  std::vector<double> xyz = {};
};
SomeMoved some_moved(const Points& first, double phase) {
  const Points all = waved(first, phase);
  SomeMoved some;
  for (std::size_t v = 3; v < first.size(); v += 7) {
    some.vertices.push_back(static_cast<Index>(v));
    some.positions.push_back(all[v]);
  }
  some.xyz = c_points(some.positions);
  return some;
}

TEST(CUpdate, TurnsAndSlidesAreThoseOfTheBodyAsItIsNow) {
  const TriMesh small = box({-1, -1, -1}, {1, 1, 1}), large = box({-2, -2, -2}, {2, 2, 2});
  const auto contact = made<HeldContact>(condyle_joint_contact_create,
                                         c_mesh(box({5, -9, -9}, {6, 9, 9})).get(), c_mesh(small).get());
  const auto results = made<HeldFree>(condyle_free_results_create);
  const double x[] = {1, 0, 0};
  condyle_slide_limit back, on;
  const auto moved = [&] {
    EXPECT_OK(condyle_joint_contact_slide(contact.get(), &c_identity, x, &back, &on, results.get()));
    return on.moved_mm;
  };
  EXPECT_NEAR(moved(), 4, 1e-12);
  const std::vector<double> xyz = c_points(large.vertices);
  ASSERT_OK(condyle_joint_contact_update(contact.get(), CONDYLE_MOBILE, xyz.data(), xyz.size() / 3));
  EXPECT_NEAR(moved(), 3, 1e-12);
}

TEST(CUpdate, AJointContactFollowsItsBodiesAsThatOfCppDoes) {
  contact::JointContact cpp(hip().hip_bone, hip().femur);
  const auto c = c_contact(hip().hip_bone, hip().femur);
  const auto results = made<HeldResults>(condyle_contact_results_create);
  std::size_t most_inside = 0;
  double phase = 0;
  for (const Pose& X : poses()) {
    for (const auto& [role, body, first] :
         {std::tuple{BodyRole::fixed, CONDYLE_FIXED, &hip().hip_bone.vertices},
          std::tuple{BodyRole::mobile, CONDYLE_MOBILE, &hip().femur.vertices}}) {
      const Points all = waved(*first, ++phase);
      cpp.update(role, all);
      ASSERT_OK(condyle_joint_contact_update(c.get(), body, c_points(all).data(), all.size()));
      const SomeMoved some = some_moved(*first, ++phase);
      cpp.update(role, some.vertices, some.positions);
      ASSERT_OK(condyle_joint_contact_update_some(c.get(), body, some.vertices.data(), some.vertices.size(),
                                                  some.xyz.data()));
    }
    const condyle_pose pose = c_pose(X);
    ASSERT_OK(condyle_joint_contact_at(c.get(), &pose, results.get()));
    most_inside = std::max(most_inside, expect_same(cpp.at(X), results.get()));
  }
  EXPECT_GT(most_inside, 10u);
}

TEST(CUpdate, NormalDepthsFollowBothSurfacesAsThoseOfCppDo) {
  contact::NormalDepth cpp(hip().hip_bone, hip().femur);
  const auto c = made<HeldDepth>(condyle_normal_depth_create, c_mesh(hip().hip_bone).get(),
                                 c_mesh(hip().femur).get(), CONDYLE_CUT_FACES, 20.0);
  const auto results = made<HeldNormalResults>(condyle_normal_results_create);
  const condyle_pose pose = c_pose(poses()[2]);
  double area = 0;
  const auto expect_same_answers = [&](condyle_status status) {
    ASSERT_OK(status);
    ASSERT_OK(condyle_normal_depth_at(c.get(), &pose, results.get()));
    condyle_surface_contact surface;
    ASSERT_OK(condyle_normal_results_surface(results.get(), &surface));
    EXPECT_NE(surface.area_mm2, area);
    area = surface.area_mm2;
    expect_same(cpp.at(poses()[2]), surface);
  };
  const Points casting = waved(hip().hip_bone.vertices, 1), target = waved(hip().femur.vertices, 2);
  const SomeMoved some_casting = some_moved(hip().hip_bone.vertices, 3),
                  some_target = some_moved(hip().femur.vertices, 4);
  cpp.update_casting(casting);
  expect_same_answers(condyle_normal_depth_update_casting(c.get(), c_points(casting).data(), casting.size()));
  cpp.update_target(target);
  expect_same_answers(condyle_normal_depth_update_target(c.get(), c_points(target).data(), target.size()));
  cpp.update_casting(some_casting.vertices, some_casting.positions);
  expect_same_answers(condyle_normal_depth_update_casting_some(
      c.get(), some_casting.vertices.data(), some_casting.vertices.size(), some_casting.xyz.data()));
  cpp.update_target(some_target.vertices, some_target.positions);
  expect_same_answers(condyle_normal_depth_update_target_some(
      c.get(), some_target.vertices.data(), some_target.vertices.size(), some_target.xyz.data()));
}

/// A ball pressed into the layer of a socket, and contacts of all kinds.
struct PressedBall {
  TriMesh fixed = socket(Vec3::Zero(), 10, 13, 2), mobile = sphere({0, 0.2, 0}, 9.9, 2);
  HeldMesh F = c_mesh(fixed), M = c_mesh(mobile);
  HeldOptions options = c_layer(10, 0.4, 2);
  HeldContact joint = made<HeldContact>(condyle_joint_contact_create, F.get(), M.get());
  HeldElastic elastic = made<HeldElastic>(condyle_elastic_contact_create, F.get(), M.get(), options.get());
  HeldDepth depth = made<HeldDepth>(condyle_normal_depth_create, F.get(), M.get(), CONDYLE_CUT_FACES, 20.0);
};

TEST(CUpdate, WhatIsRefusedHasTheLineOfCppAndChangesNothing) {
  const PressedBall ball;
  const TriMesh &fixed = ball.fixed, &mobile = ball.mobile;
  condyle_joint_contact* const c_joint = ball.joint.get();
  condyle_elastic_contact* const c_elastic = ball.elastic.get();
  condyle_normal_depth* const c_depth = ball.depth.get();
  const contact::ElasticContactOptions layer{.fixed = contact::ElasticLayer{10, 0.4, 2.0}};
  contact::JointContact joint(fixed, mobile);
  contact::ElasticContact elastic(fixed, mobile, layer);
  contact::NormalDepth depth(fixed, mobile);
  const auto results = made<HeldResults>(condyle_contact_results_create);
  const auto elastic_results = made<HeldElasticResults>(condyle_elastic_results_create);
  const auto depths = made<HeldNormalResults>(condyle_normal_results_create);
  const auto expect_unchanged = [&] {
    ASSERT_OK(condyle_joint_contact_at(c_joint, &c_identity, results.get()));
    EXPECT_GT(expect_same(contact::JointContact(fixed, mobile).at(Pose::Identity()), results.get()), 0u);
    ASSERT_OK(condyle_elastic_contact_at(c_elastic, &c_identity, elastic_results.get()));
    condyle_surface_contact surface;
    ASSERT_OK(condyle_elastic_results_surface(elastic_results.get(), CONDYLE_MOBILE, &surface));
    expect_same(*contact::ElasticContact(fixed, mobile, layer).at(Pose::Identity()).mobile, surface);
    ASSERT_OK(condyle_normal_depth_at(c_depth, &c_identity, depths.get()));
    ASSERT_OK(condyle_normal_results_surface(depths.get(), &surface));
    expect_same(contact::NormalDepth(fixed, mobile).at(Pose::Identity()), surface);
  };
  expect_unchanged();

  Points fewer = mobile.vertices, infinite = mobile.vertices, far = mobile.vertices;
  fewer.x.pop_back(), fewer.y.pop_back(), fewer.z.pop_back();
  infinite.x[5] = std::numeric_limits<double>::infinity();
  far.y[4] = 2e30;
  for (const auto& [points, status] :
       {std::pair{&fewer, CONDYLE_BAD_ARGUMENT}, std::pair{&infinite, CONDYLE_BAD_MESH},
        std::pair{&far, CONDYLE_BAD_MESH}}) {
    const std::vector<double> xyz = c_points(*points);
    expect_refused(condyle_joint_contact_update(c_joint, CONDYLE_MOBILE, xyz.data(), points->size()),
                   test::complaint_of([&, all = points] { joint.update(BodyRole::mobile, *all); }), status);
    expect_refused(condyle_elastic_contact_update(c_elastic, CONDYLE_MOBILE, xyz.data(), points->size()),
                   test::complaint_of([&, all = points] { elastic.update(BodyRole::mobile, *all); }), status);
    expect_refused(condyle_normal_depth_update_target(c_depth, xyz.data(), points->size()),
                   test::complaint_of([&, all = points] { depth.update_target(*all); }), status);
    expect_unchanged();
  }

  const Points three(3);
  const std::vector<double> xyz = c_points(three);
  for (const std::vector<Index>& numbers : {std::vector<Index>{3, 9999, 4}, std::vector<Index>{3, 4, 3}}) {
    expect_refused(condyle_joint_contact_update_some(c_joint, CONDYLE_MOBILE, numbers.data(), 3, xyz.data()),
                   test::complaint_of([&] { joint.update(BodyRole::mobile, numbers, three); }));
    expect_refused(
        condyle_elastic_contact_update_some(c_elastic, CONDYLE_MOBILE, numbers.data(), 3, xyz.data()),
        test::complaint_of([&] { elastic.update(BodyRole::mobile, numbers, three); }));
    expect_refused(condyle_normal_depth_update_casting_some(c_depth, numbers.data(), 3, xyz.data()),
                   test::complaint_of([&] { depth.update_casting(numbers, three); }));
    expect_refused(condyle_normal_depth_update_target_some(c_depth, numbers.data(), 3, xyz.data()),
                   test::complaint_of([&] { depth.update_target(numbers, three); }));
    expect_unchanged();
  }

  // The ball is shifted so that its surface holds the joint centre.
  Points through_centre = mobile.vertices;
  for (double& x : through_centre.x) x += 9.9;
  for (double& y : through_centre.y) y -= 0.2;
  (void)joint.at(Pose::Identity());
  expect_refused(condyle_joint_contact_update(c_joint, CONDYLE_MOBILE, c_points(through_centre).data(),
                                              through_centre.size()),
                 test::complaint_of([&] { joint.update(BodyRole::mobile, through_centre); }),
                 CONDYLE_BAD_MESH);
  expect_unchanged();

  const std::vector<Index> numbers = {1, 2, 3};
  expect_refused(condyle_joint_contact_update(nullptr, CONDYLE_MOBILE, xyz.data(), 3),
                 "contact is a null pointer");
  expect_refused(condyle_elastic_contact_update(nullptr, CONDYLE_MOBILE, xyz.data(), 3),
                 "contact is a null pointer");
  expect_refused(condyle_normal_depth_update_casting(nullptr, xyz.data(), 3), "depth is a null pointer");
  expect_refused(condyle_joint_contact_update(c_joint, 2, xyz.data(), 3), "body: there is no value 2");
  expect_refused(condyle_joint_contact_update(c_joint, CONDYLE_FIXED, nullptr, 3),
                 "xyz_mm is a null pointer");
  expect_refused(condyle_joint_contact_update_some(c_joint, CONDYLE_FIXED, nullptr, 3, xyz.data()),
                 "vertices is a null pointer");
  expect_refused(condyle_elastic_contact_update_some(c_elastic, CONDYLE_FIXED, numbers.data(), 3, nullptr),
                 "xyz_mm is a null pointer");
  expect_unchanged();
  EXPECT_OK(condyle_joint_contact_update_some(c_joint, CONDYLE_FIXED, nullptr, 0, nullptr));
  expect_unchanged();
}

/// The last bytes of a page behind which nothing can be read.
class LastOfAPage {
 public:
  LastOfAPage() : size_(static_cast<std::size_t>(::sysconf(_SC_PAGESIZE))) {
    pages_ = static_cast<char*>(
        ::mmap(nullptr, 2 * size_, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0));
    ::mprotect(pages_ + size_, size_, PROT_NONE);
  }
  ~LastOfAPage() { ::munmap(pages_, 2 * size_); }
  LastOfAPage(const LastOfAPage&) = delete;
  LastOfAPage& operator=(const LastOfAPage&) = delete;

  /// So many zeros at the end.
  template <class T>
  const T* last(std::size_t count) const {
    return reinterpret_cast<const T*>(pages_ + size_ - count * sizeof(T));
  }

 private:
  std::size_t size_;
  char* pages_;
};

TEST(CUpdate, AWrongCountIsRefusedBeforeAnythingIsRead) {
  const PressedBall ball;
  condyle_joint_contact* const joint = ball.joint.get();
  condyle_elastic_contact* const elastic = ball.elastic.get();
  condyle_normal_depth* const depth = ball.depth.get();
  const LastOfAPage page;
  const auto* xyz = page.last<double>(3);
  const auto* numbers = page.last<std::uint32_t>(1);
  const std::size_t all = ball.mobile.vertices.size(), of_fixed = ball.fixed.vertices.size();
  for (const std::size_t more :
       {all + 1, 2 * all, std::size_t{1} << 40, std::numeric_limits<std::size_t>::max()}) {
    const std::string gives =
                          "an update of " + std::to_string(all) + " vertices gives " + std::to_string(more),
                      moves =
                          "an update moves " + std::to_string(more) + " vertices of " + std::to_string(all);
    expect_refused(condyle_joint_contact_update(joint, CONDYLE_MOBILE, xyz, more), gives);
    expect_refused(condyle_joint_contact_update_some(joint, CONDYLE_MOBILE, numbers, more, xyz), moves);
    expect_refused(condyle_elastic_contact_update(elastic, CONDYLE_MOBILE, xyz, more), gives);
    expect_refused(condyle_elastic_contact_update_some(elastic, CONDYLE_MOBILE, numbers, more, xyz), moves);
    expect_refused(condyle_normal_depth_update_target(depth, xyz, more), gives);
    expect_refused(condyle_normal_depth_update_target_some(depth, numbers, more, xyz), moves);
    EXPECT_EQ(condyle_normal_depth_update_casting(depth, xyz, more + (more == of_fixed)),
              CONDYLE_BAD_ARGUMENT);
  }
  // One fewer is read no further than its neighbours would be: it is refused, too.
  EXPECT_EQ(condyle_joint_contact_update(joint, CONDYLE_MOBILE, xyz, all - 1), CONDYLE_BAD_ARGUMENT);
  // Counts that no mesh has.
  condyle_mesh* mesh = nullptr;
  for (const std::size_t count :
       {(std::size_t{1} << 31) + 1, std::size_t{1} << 40, std::numeric_limits<std::size_t>::max()}) {
    EXPECT_EQ(condyle_mesh_create(xyz, count, numbers, 0, &mesh), CONDYLE_OUT_OF_MEMORY);
    EXPECT_EQ(condyle_mesh_create(xyz, 1, numbers, count, &mesh), CONDYLE_OUT_OF_MEMORY);
    EXPECT_EQ(condyle_elastic_options_set_layer(ball.options.get(), CONDYLE_FIXED, 10, 0.4, xyz, count),
              CONDYLE_OUT_OF_MEMORY);
  }
}

TEST(CUpdate, AnglesOfRaysAreThoseOfCpp) {
  contact::JointContact cpp(hip().hip_bone, hip().femur);
  const auto c = c_contact(hip().hip_bone, hip().femur);
  const auto results = made<HeldResults>(condyle_contact_results_create);
  double smallest = 90, largest = 0;
  const auto expect_angles = [&](const std::vector<Angle>& expected, condyle_body body) {
    std::vector<double> angles(expected.size());
    ASSERT_OK(condyle_joint_contact_ray_angles(c.get(), results.get(), body, angles.data(), angles.size()));
    for (std::size_t i = 0; i < expected.size(); ++i) {
      ASSERT_EQ(angles[i], expected[i].degrees());
      smallest = std::min(smallest, angles[i]), largest = std::max(largest, angles[i]);
    }
  };
  for (const Pose& X : poses()) {
    const condyle_pose pose = c_pose(X);
    ASSERT_OK(condyle_joint_contact_at(c.get(), &pose, results.get()));
    contact::Contact expected = cpp.at(X);
    cpp.fixed_table().add_ray_to_normal(cpp.mobile().vertices(), X, *expected.mobile_in_fixed);
    cpp.mobile_table().add_ray_to_normal(cpp.fixed().vertices(), inverted(X), *expected.fixed_in_mobile);
    expect_angles(expected.mobile_in_fixed->ray_to_normal, CONDYLE_MOBILE);
    expect_angles(expected.fixed_in_mobile->ray_to_normal, CONDYLE_FIXED);
  }
  // On either side of 60 degrees, where a radial depth ends to be one.
  EXPECT_LT(smallest, 60);
  EXPECT_GT(largest, 60);
}

TEST(CUpdate, TheAngleOfARayThroughAFlatWallHasItsClosedForm) {
  // A corner at (6, 8, 0) leaves the wall through x = 5, its ray asin(0.8) off the normal.
  const TriMesh wall = box({5, -30, -30}, {15, 30, 30});
  TriMesh needle = box({-1, -1, -1}, {1, 1, 1});
  needle.vertices.set(7, {6, 8, 0});
  const auto c = c_contact(wall, needle);
  const auto results = made<HeldResults>(condyle_contact_results_create);
  double angle = -7;
  EXPECT_EQ(condyle_joint_contact_ray_angles(c.get(), results.get(), CONDYLE_MOBILE, &angle, 1),
            CONDYLE_BAD_ARGUMENT);
  ASSERT_OK(condyle_joint_contact_at(c.get(), &c_identity, results.get()));
  ASSERT_OK(condyle_joint_contact_ray_angles(c.get(), results.get(), CONDYLE_MOBILE, &angle, 1));
  EXPECT_NEAR(angle, std::asin(0.8) * 180 / M_PI, 1e-12);
  EXPECT_EQ(condyle_joint_contact_ray_angles(c.get(), results.get(), CONDYLE_MOBILE, &angle, 2),
            CONDYLE_BAD_ARGUMENT);
  EXPECT_STREQ(condyle_last_error(), "count is 2, and 1 vertices are not outside");
  EXPECT_EQ(condyle_joint_contact_ray_angles(c.get(), results.get(), CONDYLE_MOBILE, nullptr, 1),
            CONDYLE_BAD_ARGUMENT);
  EXPECT_EQ(condyle_joint_contact_ray_angles(nullptr, results.get(), CONDYLE_MOBILE, &angle, 1),
            CONDYLE_BAD_ARGUMENT);
  // A contact with fewer vertices.
  const auto other = c_contact(wall, {Points(1), {}});
  EXPECT_EQ(condyle_joint_contact_ray_angles(other.get(), results.get(), CONDYLE_MOBILE, &angle, 1),
            CONDYLE_BAD_ARGUMENT);
  EXPECT_STREQ(condyle_last_error(), "the results are those of another contact");
}

}  // namespace
}  // namespace condyle
