#include "condyle/label_surface.hpp"

#include <rapidcheck/gtest.h>

#include "core/thread_limit.hpp"
#include "mesh/enclosed_volume.hpp"
#include "mesh/surface_distance.hpp"
#include "mesh/winding_number.hpp"
#include "support/test.hpp"
#include "support/voxel_masks.hpp"

namespace condyle {
namespace {

using namespace test;
using std::numbers::pi;

double mean_radius(const TriMesh& mesh, const Vec3& centre) {
  double sum = 0;
  for (std::size_t v = 0; v < mesh.vertices.size(); ++v) sum += (mesh.vertices[v] - centre).norm();
  return sum / static_cast<double>(mesh.vertices.size());
}

TEST(LabelSurface, OfABallIsASphere) {
  const double radius = 24, volume = 4 * pi / 3 * std::pow(radius, 3), moved = 0.65 * 0.65 / radius;
  const int balls = 6;
  double mean_volume = 0;
  std::mt19937 random(1);
  std::uniform_real_distribution<double> offset(-0.5, 0.5);
  for (int ball = 0; ball < balls; ++ball) {
    const Vec3 centre = Vec3::Constant(27) + Vec3(offset(random), offset(random), offset(random));
    const LabelSurface surface = surface_of(ball_mask({55, 55, 55}, centre, radius));
    expect_sound(surface.mesh);
    EXPECT_NEAR(mean_radius(surface.mesh, centre), radius, 0.03);
    for (std::size_t v = 0; v < surface.mesh.vertices.size(); ++v)
      EXPECT_NEAR((surface.mesh.vertices[v] - centre).norm(), radius, surface.digitisation);
    const double enclosed = mesh::enclosed_volume(surface.mesh);
    mean_volume += enclosed / balls;
    ASSERT_EQ(surface.pieces.size(), 1u);
    EXPECT_TRUE(surface.pieces[0].kept);
    EXPECT_NEAR(enclosed, surface.pieces[0].volume - 4 * pi * radius * radius * moved, 0.001 * volume);
    EXPECT_TRUE(surface.caps.empty());
    EXPECT_EQ(surface.cavities.count, 0u);
    EXPECT_EQ(surface.dropped_components, 0u);
    EXPECT_FALSE(surface.simplification);
  }
  // 0.22 % for what the Gaussian moves, 0.05 % for flat triangles; no more than 0.03 mm of the radius make.
  EXPECT_NEAR(mean_volume, volume, 3 * 0.03 / radius * volume);
}

/// The radius at which a Gaussian of a ball has half its height is R - sigma^2 / R + O(sigma^4 / R^3). Differences of two
/// sigmas over the same masks leave the digitisation out.
TEST(LabelSurface, MovesInwardsByTheCurvature) {
  const double radius = 8, few = 0.65, many = 1.3;
  double moved = 0;
  const int masks = 8;
  std::mt19937 random(2);
  std::uniform_real_distribution<double> offset(-0.5, 0.5);
  for (int m = 0; m < masks; ++m) {
    const Vec3 centre = Vec3::Constant(13) + Vec3(offset(random), offset(random), offset(random));
    const VoxelMask mask = ball_mask({27, 27, 27}, centre, radius);
    moved += (mean_radius(surface_of(mask, {.sigma_voxels = few}).mesh, centre) -
              mean_radius(surface_of(mask, {.sigma_voxels = many}).mesh, centre)) /
             masks;
  }
  EXPECT_NEAR(moved, (many * many - few * few) / radius, std::pow(many, 4) / std::pow(radius, 3) + 0.01);
}

VoxelMask random_mask(std::mt19937& random, std::int64_t size, std::int64_t margin, double share,
                      const Eigen::Affine3d& X_WI) {
  std::bernoulli_distribution is_set(share);
  const std::int64_t image = size + 2 * margin;
  return mask_where(
      {image, image, image},
      [&](const Vec3& p) {
        const bool in_box = (p.array() >= static_cast<double>(margin)).all() &&
                            (p.array() < static_cast<double>(margin + size)).all();
        return in_box && is_set(random);
      },
      X_WI);
}

/// 10 000 masks of 4 x 4 x 4 voxels, at the image's border and away from it, unsmoothed and smoothed a little: side by
/// side in one mesh, which is looked at once.
TEST(LabelSurface, OfAnyMaskIsSound) {
  std::mt19937 random(3);
  int vanished = 0;
  for (const double sigma : {0.0, 0.4}) {
    for (const std::int64_t margin : {0, 1}) {
      TriMesh all;
      // Unsmoothed ones, and caps, have many triangles in one plane, which takes its time in exact arithmetic.
      const int rounds = sigma == 0 ? 500 : margin == 0 ? 3000 : 6000;
      for (int round = 0; round < rounds; ++round) {
        const Eigen::Affine3d X_WI(Eigen::Translation3d(8.0 * (round % 64), 8.0 * (round / 64), 0));
        const VoxelMask mask = random_mask(random, 4, margin, 0.1 * (1 + round % 9), X_WI);
        const bool all_pieces = round % 2 == 0, keep_cavities = round % 4 < 2;
        try {
          const LabelSurface surface = surface_of(
              mask, {.sigma_voxels = sigma, .all_pieces = all_pieces, .keep_cavities = keep_cavities});
          EXPECT_GT(mesh::enclosed_volume(surface.mesh), 0);
          EXPECT_TRUE(margin == 0 || surface.caps.empty());
          append(all, surface.mesh);
        } catch (const MeshError&) {
          ++vanished;
        }
      }
      expect_sound(all);
    }
  }
  EXPECT_LT(vanished, 500);
}

TEST(LabelSurface, OfLargerRandomMasksIsSound) {
  std::mt19937 random(4);
  for (const double share : {0.2, 0.5, 0.8}) {
    for (const double sigma : {0.0, 0.65, 1.0}) {
      const VoxelMask mask = random_mask(random, 20, 0, share, Eigen::Affine3d::Identity());
      try {
        expect_sound(surface_of(mask, {.sigma_voxels = sigma}).mesh);
        expect_sound(
            surface_of(mask, {.sigma_voxels = sigma, .all_pieces = true, .keep_cavities = true}).mesh);
      } catch (const MeshError&) {
        EXPECT_LT(share, 0.5);
      }
    }
  }
}

TEST(LabelSurface, OfACheckerboardIsSound) {
  const auto is_even = [](const Vec3& p) { return std::fmod(p.sum(), 2) == 0; };
  const VoxelMask board = mask_where({5, 6, 7}, is_even);
  const LabelSurface surface = surface_of(board, {.sigma_voxels = 0, .all_pieces = true});
  EXPECT_EQ(surface.pieces.size(), 1u) << "26-connected";
  expect_sound(surface.mesh);
  expect_sound(surface_of(board).mesh);
}

TEST(LabelSurface, OfOneVoxelIsAnOctahedronOrNothing) {
  const VoxelMask one = mask_where({3, 3, 3}, [](const Vec3& p) { return p == Vec3(1, 1, 1); });
  const LabelSurface surface = surface_of(one, {.sigma_voxels = 0});
  expect_sound(surface.mesh);
  EXPECT_EQ(surface.mesh.triangles.size(), 8u);
  EXPECT_DOUBLE_EQ(mesh::enclosed_volume(surface.mesh), 1.0 / 6);
  EXPECT_THROW(surface_of(one), MeshError);
  EXPECT_THROW(surface_of(mask_where({3, 3, 3}, [](const Vec3&) { return false; })), MeshError);
}

TEST(LabelSurface, OfAPlateOfOneVoxelStays) {
  const VoxelMask plate = mask_where({20, 20, 5}, [](const Vec3& p) {
    return p.z() == 2 && (p.head<2>().array() > 2).all() && (p.head<2>().array() < 17).all();
  });
  const LabelSurface surface = surface_of(plate);
  expect_sound(surface.mesh);
  EXPECT_EQ(inspect(surface.mesh).components.size(), 1u);
}

/// A box of some voxels: oblique, sheared, mirrored grids map the same vertices.
RC_GTEST_PROP(LabelSurface, FollowsItsGrid, ()) {
  std::mt19937 random(*rc::gen::inRange(0, 1000));
  std::uniform_real_distribution<double> entry(-1, 1);
  Eigen::Affine3d X_WI;
  do {
    X_WI.matrix().setIdentity();
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j < 4; ++j) X_WI.matrix()(i, j) = entry(random) * (j == 3 ? 100 : 1);
  } while (std::abs(X_WI.linear().determinant()) < 0.02);

  VoxelMask mask = random_mask(random, 6, 0, 0.7, Eigen::Affine3d::Identity());
  const LabelSurface plain = surface_of(mask);
  mask.image.X_WI = X_WI;
  const LabelSurface mapped = surface_of(mask);
  ASSERT_EQ(mapped.mesh.vertices.size(), plain.mesh.vertices.size());
  const TriMesh by_hand = test::mapped(plain.mesh, [&](const Vec3& p) { return Vec3(X_WI * p); });
  ASSERT_LE(test::farthest(mapped.mesh.vertices, by_hand.vertices), 1e-9);
  const double det = std::abs(X_WI.linear().determinant()), volume = mesh::enclosed_volume(plain.mesh);
  EXPECT_GT(volume, 0);
  EXPECT_NEAR(mesh::enclosed_volume(mapped.mesh), det * volume, 1e-9 * volume);
  EXPECT_NEAR(mapped.pieces[0].volume, det * plain.pieces[0].volume, 1e-9);
  ASSERT_EQ(mapped.caps.size(), plain.caps.size());
  for (std::size_t c = 0; c < plain.caps.size(); ++c) {
    const CapPlane& cap = mapped.caps[c];
    EXPECT_EQ(cap.triangles, plain.caps[c].triangles);
    EXPECT_NEAR(cap.normal.norm(), 1, 1e-12);
    double area = 0;
    for (const Index t : cap.triangles) {
      const Vec3 a = mapped.mesh.corner(t, 0), b = mapped.mesh.corner(t, 1), d = mapped.mesh.corner(t, 2);
      const Vec3 normal = (b - a).cross(d - a) / 2;
      area += cap.normal.dot(normal);
      for (const Vec3& p : {a, b, d}) EXPECT_NEAR(cap.normal.dot(p), cap.offset, 1e-9);
    }
    EXPECT_NEAR(area, cap.area, 1e-9 * cap.area) << "outwards";
  }
}

TEST(LabelSurface, SaysHowFarItMayBeFromTheBoundary) {
  VoxelMask mask = ball_mask({9, 9, 9}, {4, 4, 4}, 3);
  mask.image.X_WI.linear() = Eigen::Vector3d(0.7, 0.7, 2).asDiagonal();
  const LabelSurface straight = surface_of(mask);
  EXPECT_EQ(straight.spacing, Vec3(0.7, 0.7, 2));
  EXPECT_DOUBLE_EQ(straight.digitisation, 1);
  const Eigen::Matrix3d turn = Eigen::AngleAxisd(0.4, Vec3(1, 2, 3).normalized()).toRotationMatrix();
  mask.image.X_WI.linear() = turn * mask.image.X_WI.linear();
  EXPECT_NEAR(surface_of(mask).digitisation, 1, 1e-12);
  mask.image.X_WI.linear() << 1, 0.5, 0, 0, 1, 0, 0, 0, 1;
  const LabelSurface sheared = surface_of(mask);
  EXPECT_NEAR(sheared.spacing.y(), std::sqrt(1.25), 1e-15);
  double worst = 0;
  for (int i = 0; i < 100'000; ++i) {
    const double t = 1e-5 * pi * i;
    const Vec3 n(std::cos(t), std::sin(t), 0);
    worst = std::max(worst, (mask.image.X_WI.linear().transpose() * n).norm() / 2);
  }
  EXPECT_NEAR(sheared.digitisation, worst, 1e-9);
}

TEST(LabelSurface, FillsCavitiesUnlessTheyAreKept) {
  const Vec3 centre(15.2, 14.9, 15.35);
  const VoxelMask shell = mask_where({31, 31, 31}, [&](const Vec3& p) {
    const double r = (p - centre).norm();
    return r < 12 && r > 6;
  });
  const LabelSurface filled = surface_of(shell), hollow = surface_of(shell, {.keep_cavities = true});
  for (const LabelSurface& surface : {filled, hollow}) {
    expect_sound(surface.mesh);
    EXPECT_EQ(surface.cavities.count, 1u);
    EXPECT_NEAR(surface.cavities.volume, 4 * pi / 3 * 216, 0.05 * 4 * pi / 3 * 216);
    EXPECT_EQ(surface.cavities.volume, static_cast<double>(surface.cavities.voxels));
  }
  EXPECT_EQ(inspect(filled.mesh).components.size(), 1u);
  EXPECT_EQ(inspect(hollow.mesh).components.size(), 2u);
  EXPECT_NEAR(mesh::enclosed_volume(filled.mesh), 4 * pi / 3 * 1728, 100);
  EXPECT_NEAR(mesh::enclosed_volume(hollow.mesh), 4 * pi / 3 * (1728 - 216), 100);

  // A voxel's corner is no opening, a voxel is; through it the cavity is no cavity.
  VoxelMask opened = shell;
  for (std::size_t k = 0; k < 15; ++k) opened.inside[(k * 31 + 15) * 31 + 15] = 0;
  EXPECT_EQ(surface_of(opened).cavities.count, 0u);
  EXPECT_EQ(surface_of(opened).dropped_components, 1u)
      << "smoothing closes the opening, and the hollow is left out";
  EXPECT_EQ(surface_of(opened, {.keep_cavities = true}).dropped_components, 0u);
}

/// A ball in a shell in a shell, apart.
TEST(LabelSurface, KeepsWhatItIsToldOfNestedBodies) {
  const Vec3 centre(20, 20, 20);
  const VoxelMask nested = mask_where({41, 41, 41}, [&](const Vec3& p) {
    const double r = (p - centre).norm();
    return r < 4 || (r > 8 && r < 12) || (r > 15 && r < 19);
  });
  const auto report = [&](bool all_pieces, bool keep_cavities) {
    const LabelSurface surface =
        surface_of(nested, {.all_pieces = all_pieces, .keep_cavities = keep_cavities});
    EXPECT_EQ(surface.pieces.size(), 3u);
    expect_sound(surface.mesh);
    return inspect(surface.mesh).components.size();
  };
  EXPECT_EQ(report(false, false), 1u);
  EXPECT_EQ(report(false, true), 2u);
  EXPECT_EQ(report(true, false), 1u) << "filled, they are one";
  EXPECT_EQ(report(true, true), 5u);
}

TEST(LabelSurface, KeepsTunnels) {
  const VoxelMask ring = mask_where({31, 31, 11}, [](const Vec3& p) {
    const double across = std::hypot(p.x() - 15, p.y() - 15) - 10;
    return std::hypot(across, p.z() - 5) < 3.5;
  });
  const LabelSurface surface = surface_of(ring);
  expect_sound(surface.mesh);
  const MeshReport report = inspect(surface.mesh);
  ASSERT_EQ(report.components.size(), 1u);
  EXPECT_EQ(report.components[0].genus, 1);
  EXPECT_EQ(surface.cavities.count, 0u);
}

TEST(LabelSurface, KeepsTheLargestPieceUnlessAllAreAskedFor) {
  const VoxelMask two = mask_where({40, 20, 20}, [](const Vec3& p) {
    return (p - Vec3(8, 10, 10)).norm() < 5 || (p - Vec3(26, 10, 10)).norm() < 7;
  });
  const LabelSurface largest = surface_of(two), both = surface_of(two, {.all_pieces = true});
  ASSERT_EQ(largest.pieces.size(), 2u);
  EXPECT_GT(largest.pieces[0].voxels, largest.pieces[1].voxels);
  EXPECT_TRUE(largest.pieces[0].kept);
  EXPECT_FALSE(largest.pieces[1].kept);
  EXPECT_TRUE(both.pieces[1].kept);
  EXPECT_EQ(inspect(largest.mesh).components.size(), 1u);
  EXPECT_EQ(inspect(both.mesh).components.size(), 2u);
  EXPECT_GT(inspect(largest.mesh).bounds.low.x(), 18);
}

/// Smoothing parts them, and neither half is lost.
TEST(LabelSurface, VoxelsThatMeetInACornerAreOnePiece) {
  const VoxelMask diagonal = mask_where({14, 14, 14}, [](const Vec3& p) {
    return ((p.array() >= 2) && (p.array() < 7)).all() || ((p.array() >= 7) && (p.array() < 12)).all();
  });
  const LabelSurface surface = surface_of(diagonal);
  EXPECT_EQ(surface.pieces.size(), 1u);
  expect_sound(surface.mesh);
  const auto halves = inspect(surface.mesh).components;
  ASSERT_EQ(halves.size(), 2u);
  EXPECT_NEAR(*halves[0].signed_volume, *halves[1].signed_volume, 1e-6) << "one is the other's mirror image";
}

TEST(LabelSurface, SimplifiedKeepsItsShape) {
  const VoxelMask ring = mask_where({61, 61, 21}, [](const Vec3& p) {
    const double across = std::hypot(p.x() - 30.2, p.y() - 29.7) - 20;
    return std::hypot(across, p.z() - 10.1) < 7.5;
  });
  const LabelSurface fine = surface_of(ring);
  const std::size_t before = fine.mesh.triangles.size();
  for (const std::size_t wanted : {before / 2, before / 5, before / 10}) {
    const LabelSurface coarse = surface_of(ring, {.triangles = wanted});
    expect_sound(coarse.mesh);
    EXPECT_LE(coarse.mesh.triangles.size(), wanted);
    EXPECT_GE(coarse.mesh.triangles.size() + 1, wanted);
    const MeshReport report = inspect(coarse.mesh);
    ASSERT_EQ(report.components.size(), 1u);
    EXPECT_EQ(report.components[0].genus, 1);
    ASSERT_TRUE(coarse.simplification);
    EXPECT_EQ(coarse.simplification->triangles_before, before);
    const mesh::SurfaceDistance distance(coarse.mesh);
    double largest = 0;
    for (std::size_t v = 0; v < fine.mesh.vertices.size(); ++v)
      largest = std::max(largest, distance(fine.mesh.vertices[v]));
    EXPECT_EQ(coarse.simplification->largest_error, largest);
    EXPECT_LT(largest, 0.5);
    EXPECT_NEAR(*report.signed_volume, mesh::enclosed_volume(fine.mesh), report.area * largest);
  }
  EXPECT_FALSE(surface_of(ring, {.triangles = before}).simplification);
  EXPECT_EQ(surface_of(ring, {.triangles = before}).mesh, fine.mesh);
  EXPECT_THROW(surface_of(ring, {.triangles = 99}), UsageError);
}

TEST(LabelSurface, SimplifiedRandomMasksAreSound) {
  std::mt19937 random(8);
  for (const double share : {0.4, 0.6, 0.9}) {
    const VoxelMask mask = random_mask(random, 16, 0, share, Eigen::Affine3d::Identity());
    for (const std::size_t triangles : {1500u, 400u, 100u})
      expect_sound(surface_of(mask, {.keep_cavities = true, .triangles = triangles}).mesh);
  }
}

TEST(LabelSurface, DoesNotDependOnTheBoxNorOnThreads) {
  std::mt19937 random(6);
  const Eigen::Affine3d X_WI(Eigen::AngleAxisd(0.3, Vec3(1, 2, 2).normalized()));
  VoxelMask mask = mask_where(
      {60, 55, 50},
      [&](const Vec3& p) {
        return (p - Vec3(30, 28, 25)).norm() < 18 + 4 * std::sin(p.x()) * std::cos(0.7 * p.y());
      },
      X_WI);
  const LabelSurface whole = surface_of(mask), simple = surface_of(mask, {.triangles = 2000});
  EXPECT_EQ(surface_of(cropped(mask)).mesh, whole.mesh);
  const core::ThreadLimit one_thread(1);
  EXPECT_EQ(surface_of(mask).mesh, whole.mesh);
  EXPECT_EQ(surface_of(mask, {.triangles = 2000}).mesh, simple.mesh);
}

TEST(LabelSurface, CountsItsStepsAndStops) {
  const VoxelMask mask = ball_mask({11, 11, 11}, {5, 5, 5}, 4);
  std::vector<std::size_t> steps;
  const auto note = [&](std::string_view, std::size_t done, std::size_t total) {
    steps.push_back(done);
    EXPECT_LE(done, total);
    if (done == total) steps.push_back(total);
  };
  ASSERT_TRUE(surface_of(mask, {}, Control{.progress = note}));
  ASSERT_GT(steps.size(), 1u);
  EXPECT_EQ(steps[steps.size() - 2], steps.back()) << "the last step is the last of all";
  std::stop_source stop;
  stop.request_stop();
  EXPECT_FALSE(surface_of(mask, {}, Control{.stop = stop.get_token()}));
}

TEST(LabelSurface, RefusesWhatIsNoMask) {
  const VoxelMask good = ball_mask({9, 9, 9}, {4, 4, 4}, 3);
  const auto refused = [&](const auto& change) {
    VoxelMask bad = good;
    change(bad);
    EXPECT_THROW(surface_of(bad), UsageError);
    EXPECT_THROW(touching_voxels(good, bad), UsageError);
  };
  refused([](VoxelMask& m) { m.inside.pop_back(); });
  refused([](VoxelMask& m) { m.inside[7] = 2; });
  refused([](VoxelMask& m) { m.size[1] = 0; });
  refused([](VoxelMask& m) { m.first[1] = 1; });
  refused([](VoxelMask& m) { m.first[0] = -1; });
  refused([](VoxelMask& m) {
    m.size = {std::int64_t{1} << 40, std::int64_t{1} << 40, 1}, m.image.size = m.size;
  });
  refused([](VoxelMask& m) { m.image.X_WI.linear().col(0).setZero(); });
  refused([](VoxelMask& m) { m.image.X_WI.translation().x() = NAN; });
  for (const double sigma : {-0.1, 4.1, std::numeric_limits<double>::quiet_NaN()})
    EXPECT_THROW(surface_of(good, {.sigma_voxels = sigma}), UsageError);
}

TEST(TouchingVoxels, AreCountedByFaces) {
  Eigen::Affine3d X_WI(Eigen::Translation3d(10, 20, 30));
  const auto block = [&](double low, double high) {
    return cropped(mask_where(
        {12, 5, 6}, [&](const Vec3& p) { return p.x() >= low && p.x() < high && p.y() > 0; }, X_WI));
  };
  const TouchingVoxels touching = touching_voxels(block(1, 4), block(4, 9));
  EXPECT_EQ(touching.faces, 24u);
  EXPECT_EQ(touching.shared, 0u);
  ASSERT_TRUE(touching.centre);
  EXPECT_TRUE(touching.centre->isApprox(Vec3(13.5, 22.5, 32.5)));
  EXPECT_EQ(touching_voxels(block(4, 9), block(1, 4)).faces, 24u);
  EXPECT_EQ(touching_voxels(block(1, 3), block(4, 9)).faces, 0u);
  EXPECT_FALSE(touching_voxels(block(1, 3), block(4, 9)).centre);
  EXPECT_EQ(touching_voxels(block(1, 5), block(4, 9)).shared, 24u);
  VoxelMask elsewhere = block(4, 9);
  elsewhere.image.X_WI.translation().x() += 1;
  EXPECT_THROW(touching_voxels(block(1, 4), elsewhere), UsageError);
}

/// A real femur as voxels of 1.5 mm, cut by its image: the surface is that of the mesh within a voxel.
TEST(LabelSurface, OfARealFemurIsNearItsMesh) {
  FOUND_OR_SKIP(data, test::shared_data());
  const TriMesh femur = read_ply(*data / "hip_vhf_right" / "femur.ply");
  const BoundingBox bounds = inspect(femur).bounds;
  const double h = 1.5;
  Eigen::Affine3d X_WI(Eigen::AngleAxisd(0.35, Vec3(2, -1, 2).normalized()));
  X_WI.linear() *= h;
  X_WI.translation() = (bounds.low + bounds.high) / 2 - X_WI.linear() * Vec3::Constant(40);
  Points centres;
  const Voxels3 size{81, 81, 81};
  mask_where(size, [&](const Vec3& p) { return centres.push_back(X_WI * p), false; });
  const auto winding = mesh::WindingNumber(Mesh(femur)).at(centres);
  std::size_t next = 0;
  const VoxelMask mask = mask_where(
      size, [&](const Vec3&) { return winding[next++].winding != 0; }, X_WI);
  const LabelSurface surface = surface_of(mask);
  expect_sound(surface.mesh);
  EXPECT_FALSE(surface.caps.empty());
  std::vector<bool> is_of_cap(surface.mesh.vertices.size());
  for (const CapPlane& cap : surface.caps)
    for (const Index t : cap.triangles)
      for (const Index v : surface.mesh.triangles[t]) is_of_cap[v] = true;
  const mesh::SurfaceDistance distance(femur);
  double sum = 0, largest = 0;
  std::size_t count = 0;
  for (std::size_t v = 0; v < surface.mesh.vertices.size(); ++v) {
    if (is_of_cap[v]) continue;
    const double d = distance(surface.mesh.vertices[v]);
    sum += d, largest = std::max(largest, d), ++count;
  }
  EXPECT_LT(sum / static_cast<double>(count), 0.15 * h);
  EXPECT_LT(largest, h);
}

}  // namespace
}  // namespace condyle
