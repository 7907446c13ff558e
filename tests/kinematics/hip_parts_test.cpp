#include "kinematics/hip_parts.hpp"

#include "condyle/make_joint.hpp"
#include "kinematics/hip_anatomy.hpp"
#include "mesh/self_crossings.hpp"
#include "mesh/triangle_tree.hpp"
#include "support/test.hpp"

namespace condyle::kinematics {
namespace {

void expect_same(const SphericalPatch& a, const SphericalPatch& b) {
  EXPECT_EQ(a.fit.sphere.centre, b.fit.sphere.centre);
  EXPECT_EQ(a.fit.sphere.radius, b.fit.sphere.radius);
  EXPECT_EQ(a.fit.rms_residual, b.fit.rms_residual);
  EXPECT_EQ(a.fit.vertices, b.fit.vertices);
  EXPECT_EQ(a.coverage, b.coverage);
}

TEST(HipParts, AreFoundOnceAndSharedByCopiesOfAMesh) {
  const Mesh ball = test::sphere({1, 0, 0}, 25, 3), copy = ball;
  const auto& head = head_near_centre(ball);
  ASSERT_TRUE(head);
  EXPECT_EQ(&head_near_centre(copy), &head);
  EXPECT_EQ(&mesh::self_crossings_of(copy), &mesh::self_crossings_of(ball));
  EXPECT_EQ(mesh::tree_of(copy), mesh::tree_of(ball));
  const Mesh moved = ball.moved_to(posed(Pose(Eigen::Translation3d(1, 0, 0)), ball.vertices().view()));
  EXPECT_NE(head_near_centre(moved)->fit.sphere.centre, head->fit.sphere.centre);
}

TEST(HipParts, WhereNoneIsFoundThatIsKept) {
  const Mesh box = test::box({-50, -50, -50}, {50, 50, 50});
  EXPECT_FALSE(head_near_centre(box));
  EXPECT_EQ(&head_near_centre(box), &head_near_centre(box));
  EXPECT_FALSE(*socket_around(box, {Vec3::Zero(), 25}));
}

TEST(HipParts, ASocketIsKeptByItsHead) {
  const Mesh socket = test::socket(Vec3::Zero(), 26, 32, 3);
  const Sphere head{Vec3::Zero(), 25}, other{Vec3::Zero(), 24};
  const auto first = socket_around(socket, head);
  EXPECT_EQ(socket_around(socket, head), first);
  EXPECT_NE(socket_around(socket, other), first);
  EXPECT_EQ(rim_around(socket, head), rim_around(socket, head));
  const auto found = find_socket(socket, head);
  ASSERT_EQ(first->has_value(), found.has_value());
  if (found) expect_same(**first, *found);
}

/// The head that the centre of a joint was fitted to is kept with the placed mesh: it is what a search there finds, bit by bit.
TEST(HipParts, TheHeadThatTheCentreWasFittedToIsTheOneThatASearchFinds) {
  FOUND_OR_SKIP(data, test::shared_data());
  for (const auto& [name, side] :
       {std::pair{"hip_vhf_right", Side::right}, {"hip_libhip_m1_left", Side::left}}) {
    JointDescription hip{.name = name, .kind = JointKind::ball, .side = side};
    hip.frame.centre = CentreFit{};
    const auto [joint, placement] =
        make_joint(hip, {"hip bone", test::read_ply(*data / name / "hip_bone.ply")},
                   {"femur", test::read_ply(*data / name / "femur.ply")});
    const auto& kept = head_near_centre(joint.mobile.mesh);
    ASSERT_TRUE(kept) << name;
    EXPECT_EQ(kept->fit.vertices, placement.sphere->fit.vertices) << name;
    expect_same(*kept, find_sphere(joint.mobile.mesh, {.within = Sphere{Vec3::Zero(), 90}}));
    expect_same(*fitted_head(joint.mobile.mesh), *kept);
    EXPECT_FALSE(fitted_head(joint.fixed.mesh)) << name;
  }
}

}  // namespace
}  // namespace condyle::kinematics
