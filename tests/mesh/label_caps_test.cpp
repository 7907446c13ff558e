#include "condyle/label_surface.hpp"

#include "mesh/enclosed_volume.hpp"
#include "support/test.hpp"
#include "support/voxel_masks.hpp"

namespace condyle {
namespace {

using namespace test;
using std::numbers::pi;

/// The vertices of a cap, and that its triangles, and only they, are in its plane.
std::set<Index> vertices_of_cap(const LabelSurface& surface, const CapPlane& cap, double coordinate) {
  std::set<Index> vertices;
  const auto in_plane = [&](Index t) {
    for (const Index v : surface.mesh.triangles[t])
      if (surface.mesh.vertices[v][cap.axis] != coordinate) return false;
    return true;
  };
  for (Index t = 0; t < surface.mesh.triangles.size(); ++t) {
    const bool is_of_cap = std::binary_search(cap.triangles.begin(), cap.triangles.end(), t);
    EXPECT_EQ(in_plane(t), is_of_cap);
    if (is_of_cap) vertices.insert(surface.mesh.triangles[t].begin(), surface.mesh.triangles[t].end());
  }
  return vertices;
}

TEST(LabelSurfaceCaps, OfACutCylinderHasFlatCaps) {
  const double radius = 9;
  const Eigen::Vector2d axis(12.3, 11.8);
  const Voxels3 size{25, 25, 30};
  Eigen::Affine3d X_WI = Eigen::Affine3d::Identity();
  X_WI.linear() = Eigen::Vector3d(0.8, 0.8, 1.5).asDiagonal();
  X_WI.translation() = Vec3(-31, 17, 240);
  const VoxelMask mask = mask_where(
      size, [&](const Vec3& p) { return (p.head<2>() - axis).norm() < radius; }, X_WI);
  const LabelSurface surface = surface_of(mask);
  expect_sound(surface.mesh);
  ASSERT_EQ(surface.caps.size(), 2u);
  const double disc = pi * std::pow(0.8 * radius, 2), height = 30 * 1.5;
  for (std::size_t c = 0; c < 2; ++c) {
    const CapPlane& cap = surface.caps[c];
    EXPECT_EQ(cap.axis, 2);
    EXPECT_EQ(cap.high, c == 1);
    EXPECT_EQ(cap.normal, Vec3(0, 0, c == 1 ? 1 : -1));
    const double z = c == 1 ? 240 + 29.5 * 1.5 : 240 - 0.75;
    EXPECT_DOUBLE_EQ(cap.offset, c == 1 ? z : -z);
    // The Gaussian moves the wall inwards by sigma^2 / (2 radius); voxels leave an area within some of their edges.
    EXPECT_NEAR(cap.area, disc, 0.01 * disc);
    EXPECT_FALSE(vertices_of_cap(surface, cap, z).empty());
  }
  EXPECT_EQ(surface.caps[0].area, surface.caps[1].area);
  EXPECT_NEAR(mesh::enclosed_volume(surface.mesh), surface.caps[0].area * height, 1e-9 * disc * height);
}

TEST(LabelSurfaceCaps, IsNotRoundedAtACap) {
  // Every layer of a cylinder square to the border is the same, up to the cap.
  const VoxelMask mask =
      mask_where({20, 20, 12}, [](const Vec3& p) { return std::hypot(p.x() - 9.6, p.y() - 9.9) < 7; });
  const LabelSurface surface = surface_of(mask);
  std::map<double, std::set<std::pair<double, double>>> layer;
  const std::set<Index> low = vertices_of_cap(surface, surface.caps.at(0), -0.5);
  for (std::size_t v = 0; v < surface.mesh.vertices.size(); ++v) {
    const Vec3 p = surface.mesh.vertices[v];
    const bool within_cap = p.x() == std::round(p.x()) && p.y() == std::round(p.y());
    if (!within_cap) layer[p.z()].insert({p.x(), p.y()});
  }
  EXPECT_EQ(layer.size(), 14u);
  for (const auto& [z, outline] : layer) EXPECT_EQ(outline, layer.begin()->second) << z;
}

/// Half a space behind a plane that leans to the border: near its cap the wall leans less, by less than half a voxel.
TEST(LabelSurfaceCaps, IsHardlyBentAtACap) {
  for (const double degrees : {15.0, 30.0, 45.0, 60.0}) {
    const double tilt = degrees * pi / 180;
    const Vec3 normal(std::cos(tilt), 0, -std::sin(tilt)), on_plane(30, 0, 0);
    std::map<double, std::pair<double, int>>
        layers;  // by z: the sum of distances from the plane, and how many
    const int masks = 20;
    for (int m = 0; m < masks; ++m) {
      const double offset = 0.05 * m;
      const VoxelMask mask =
          mask_where({61, 5, 30}, [&](const Vec3& p) { return normal.dot(p - on_plane) < offset; });
      const LabelSurface surface = surface_of(mask);
      for (std::size_t v = 0; v < surface.mesh.vertices.size(); ++v) {
        const Vec3 p = surface.mesh.vertices[v];
        // Within the image in x and y; on an edge along x.
        if (p.y() != 2 || p.x() < 5 || p.x() > 55 || p.x() == std::round(p.x())) continue;
        auto& [sum, count] = layers[p.z()];
        sum += normal.dot(p - on_plane) - offset;
        ++count;
      }
    }
    const auto mean = [&](double z) { return layers.at(z).first / layers.at(z).second; };
    EXPECT_LT(std::abs(mean(-0.5)), 0.5);
    EXPECT_LT(std::abs(mean(0)), 0.2);
    EXPECT_LT(std::abs(mean(1)), 0.1);
  }
}

TEST(LabelSurfaceCaps, OfABallInACornerOfTheImageHasThreeCaps) {
  const double radius = 14;
  for (const bool high : {false, true}) {
    const double corner = high ? 20.5 : -0.5;
    const VoxelMask mask = ball_mask({21, 21, 21}, Vec3::Constant(corner), radius);
    const LabelSurface surface = surface_of(mask);
    expect_sound(surface.mesh);
    ASSERT_EQ(surface.caps.size(), 3u);
    std::set<Index> common;
    for (std::size_t c = 0; c < 3; ++c) {
      const CapPlane& cap = surface.caps[c];
      EXPECT_EQ(cap.axis, static_cast<int>(c));
      EXPECT_EQ(cap.high, high);
      EXPECT_NEAR(cap.area, pi * radius * radius / 4, 0.02 * pi * radius * radius / 4);
      const std::set<Index> vertices = vertices_of_cap(surface, cap, corner);
      if (c == 0) {
        common = vertices;
      } else {
        std::erase_if(common, [&](Index v) { return vertices.count(v) == 0; });
      }
    }
    ASSERT_EQ(common.size(), 1u);
    EXPECT_EQ(surface.mesh.vertices[*common.begin()], Vec3::Constant(corner));
    EXPECT_NEAR(mesh::enclosed_volume(surface.mesh), pi / 6 * std::pow(radius, 3),
                0.01 * std::pow(radius, 3));
    EXPECT_EQ(inspect(surface.mesh).components[0].genus, 0);
  }
}

TEST(LabelSurfaceCaps, OfAFullImageIsItsBox) {
  for (const Voxels3& size : {Voxels3{1, 1, 1}, Voxels3{1, 2, 3}, Voxels3{4, 5, 6}}) {
    const LabelSurface surface = surface_of(mask_where(size, [](const Vec3&) { return true; }));
    expect_sound(surface.mesh);
    EXPECT_EQ(surface.caps.size(), 6u);
    EXPECT_DOUBLE_EQ(mesh::enclosed_volume(surface.mesh), static_cast<double>(size[0] * size[1] * size[2]));
    std::size_t of_caps = 0;
    for (const CapPlane& cap : surface.caps) of_caps += cap.triangles.size();
    EXPECT_EQ(of_caps, surface.mesh.triangles.size());
  }
}

TEST(LabelSurfaceCaps, OfAMaskBesideTheBorderHasNoCap) {
  // One voxel of background is at the border.
  const LabelSurface surface = surface_of(ball_mask({17, 17, 17}, {8, 8, 8}, 7.2));
  EXPECT_TRUE(surface.caps.empty());
  EXPECT_EQ(surface_of(ball_mask({17, 17, 17}, {8, 8, 7}, 7.2)).caps.size(), 1u);
}

TEST(LabelSurfaceCaps, SimplifiedKeepsItsCaps) {
  Eigen::Affine3d X_WI(Eigen::AngleAxisd(0.5, Vec3(1, 2, 2).normalized()));
  for (const bool oblique : {false, true}) {
    VoxelMask mask = ball_mask({30, 30, 30}, {3.2, 25.1, 15}, 21);
    if (oblique) mask.image.X_WI = X_WI;
    const LabelSurface fine = surface_of(mask), coarse = surface_of(mask, {.triangles = 600});
    expect_sound(coarse.mesh);
    EXPECT_EQ(coarse.mesh.triangles.size(), 600u);
    ASSERT_EQ(coarse.caps.size(), 4u);
    for (std::size_t c = 0; c < 4; ++c) {
      const CapPlane &cap = coarse.caps[c], &as_before = fine.caps[c];
      EXPECT_EQ(cap.normal, as_before.normal);
      EXPECT_EQ(cap.offset, as_before.offset);
      EXPECT_NEAR(cap.area, as_before.area, 0.02 * as_before.area);
      EXPECT_LT(cap.triangles.size(), as_before.triangles.size());
      for (const Index t : cap.triangles) {
        for (int k = 0; k < 3; ++k) {
          const double off_plane = cap.normal.dot(coarse.mesh.corner(t, k)) - cap.offset;
          EXPECT_NEAR(off_plane, 0, 1e-13 * 30);
        }
      }
      if (!oblique) vertices_of_cap(coarse, cap, cap.normal[cap.axis] * cap.offset);
    }
  }
}

}  // namespace
}  // namespace condyle
