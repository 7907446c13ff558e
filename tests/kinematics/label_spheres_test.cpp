#include "condyle/fit.hpp"
#include "kinematics/hip_anatomy.hpp"
#include "support/stairs.hpp"
#include "support/test.hpp"
#include "support/voxel_masks.hpp"
#include "support/voxelised.hpp"

/// Heads and sockets on surfaces of label maps: the stairs of their voxels, and smoothed ones.

namespace condyle {
namespace {

struct Grid {
  Vec3 voxel;  ///< mm
  double turned_deg;

  Eigen::Matrix3d steps() const {
    const double turn = turned_deg * std::numbers::pi / 180;
    return Eigen::AngleAxisd(turn, Vec3(1, 2, 3).normalized()).toRotationMatrix() * voxel.asDiagonal();
  }
};

const std::array<Grid, 6> grids{{{Vec3(1, 1, 1), 0},
                                 {Vec3(0.7, 0.7, 2), 0},
                                 {Vec3(2, 0.7, 0.7), 0},
                                 {Vec3(1, 1, 1), 30},
                                 {Vec3(0.8, 0.8, 1.6), 45},
                                 {Vec3(2, 2, 2), 0}}};

/// A mask of the points p, mm, with a voxel's centre at `through`, that reaches this far about the origin.
template <class IsInside>
VoxelMask mask_of(const Grid& grid, double reach, const Vec3& through, const IsInside& is_inside) {
  Eigen::Affine3d X_WI = Eigen::Affine3d::Identity();
  X_WI.linear() = grid.steps();
  test::Voxels3 size;
  Vec3 half;
  for (int a = 0; a < 3; ++a) {
    half[a] = std::ceil(reach / grid.voxel[a]);
    size[static_cast<std::size_t>(a)] = 2 * static_cast<std::int64_t>(half[a]) + 1;
  }
  X_WI.translation() = through - X_WI.linear() * half;
  return test::mask_where(
      size, [&](const Vec3& v) { return is_inside(X_WI * v); }, X_WI);
}

/// A ball of radius 24 whose neck takes a fifth of it away.
bool in_femur(const Vec3& p) {
  return p.norm() < 24 || (p.z() < 0 && p.z() > -60 && std::hypot(p.x(), p.y()) < 19.2);
}

TEST(Stairs, OfVoxelsOfAnyShapeHaveTheirHead) {
  for (const Grid& grid : grids) {
    SCOPED_TRACE(testing::Message() << grid.voxel.transpose() << " turned by " << grid.turned_deg);
    const Vec3 through(0.13, 0.27, 0.41);
    const SphericalPatch head = find_sphere(test::stairs_of(mask_of(grid, 70, through, in_femur)));
    // Centres of voxels are inside or not: each face is off by half a voxel at most, and thousands are averaged.
    EXPECT_LT(head.fit.sphere.centre.norm(), grid.voxel.maxCoeff() / 4);
    EXPECT_NEAR(head.fit.sphere.radius, 24, grid.voxel.maxCoeff() / 4);
    // That of the ball, (1 + 0.6) / 2 as the neck begins 0.6 radii below the centre, and not that of the stairs, half as much again.
    EXPECT_NEAR(head.coverage, 0.8, 0.1);
  }
}

/// A socket of radius 26 in a block, with a fossa of 3 mm.
bool in_hip_bone(const Vec3& p) {
  if (p.z() > 10 || p.cwiseAbs().maxCoeff() > 42) return false;
  const bool in_fossa = p.normalized().dot(Vec3(0.5, -0.3, -1).normalized()) > 0.85;
  return p.norm() > (in_fossa ? 29 : 26);
}

TEST(Stairs, OfVoxelsOfAnyShapeHaveTheirSocket) {
  for (const Grid& grid : grids) {
    SCOPED_TRACE(testing::Message() << grid.voxel.transpose() << " turned by " << grid.turned_deg);
    const VoxelMask mask = mask_of(grid, 78, {0.13, 0.27, 0.41}, in_hip_bone);
    for (const TriMesh& mesh : {test::stairs_of(mask), TriMesh(surface_of(mask).mesh)}) {
      const auto socket = kinematics::find_socket(mesh, {Vec3::Zero(), 24});
      ASSERT_TRUE(socket);
      EXPECT_LT(socket->fit.sphere.centre.norm(), grid.voxel.maxCoeff() / 2);
      EXPECT_NEAR(socket->fit.sphere.radius, 26, grid.voxel.maxCoeff() / 2);
    }
  }
}

/// The same surface with its vertices and triangles counted from the other end.
TriMesh counted_backwards(const TriMesh& mesh) {
  TriMesh out;
  const std::size_t count = mesh.vertices.size();
  out.vertices.reserve(count);
  for (std::size_t v = count; v-- > 0;) out.vertices.push_back(mesh.vertices[v]);
  for (auto t = mesh.triangles.rbegin(); t != mesh.triangles.rend(); ++t) {
    Triangle turned = *t;
    for (Index& v : turned) v = static_cast<Index>(count - 1 - v);
    out.triangles.push_back(turned);
  }
  return out;
}

TEST(Socket, DoesNotDependOnTheOrderOfItsVertices) {
  for (const Grid& grid : {grids[0], grids[4]}) {
    const TriMesh bone = surface_of(mask_of(grid, 78, {0.13, 0.27, 0.41}, in_hip_bone)).mesh;
    const auto one = kinematics::find_socket(bone, {Vec3::Zero(), 24}),
               other = kinematics::find_socket(counted_backwards(bone), {Vec3::Zero(), 24});
    ASSERT_TRUE(one && other);
    EXPECT_LT((one->fit.sphere.centre - other->fit.sphere.centre).norm(), 1e-9);
    EXPECT_NEAR(one->fit.sphere.radius, other->fit.sphere.radius, 1e-9);
    EXPECT_EQ(one->fit.vertices.size(), other->fit.vertices.size());
  }
}

/// Several spheres hold nearly the same area of an uneven socket: which of them is taken may not hang on the grid.
TEST(Socket, OfAnUnevenHipIsTheSameOnItsLabelMaps) {
  FOUND_OR_SKIP(data, test::shared_data());
  const Sphere head{Vec3::Zero(), 23.85};
  TriMesh bone = test::read_ply(*data / "hip_vhf_right/hip_bone.ply");
  for (std::size_t v = 0; v < bone.vertices.size(); ++v) {
    const Vec3 p = bone.vertices[v];
    Vec3 moved = p;
    for (int k = 0; k < 3; ++k)
      moved[k] += 1.1 * std::sin(p[(k + 1) % 3] / (7.0 + k) + 2.1 * k + 1.5) +
                  0.9 * std::cos(p[(k + 2) % 3] / (11.0 - k) + 1.3 * k + 2.55);
    bone.vertices.set(v, moved);
  }
  const auto socket = kinematics::find_socket(bone, head);
  ASSERT_TRUE(socket);
  for (const Grid& grid : {grids[0], grids[1], grids[3], grids[4], grids[5]}) {
    SCOPED_TRACE(testing::Message() << grid.voxel.transpose() << " turned by " << grid.turned_deg);
    const VoxelGrid image = test::grid_around(bone, bone, grid.steps(), Vec3(0.13, 0.27, 0.41));
    const auto found =
        kinematics::find_socket(test::body_of("hip bone", test::voxelised(bone, image)).mesh, head);
    ASSERT_TRUE(found);
    // A voxel: as far as the surface itself may be off.
    EXPECT_LT((found->fit.sphere.centre - socket->fit.sphere.centre).norm(), grid.voxel.maxCoeff());
  }
}

}  // namespace
}  // namespace condyle
