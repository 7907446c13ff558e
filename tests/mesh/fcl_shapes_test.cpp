#include <stdexcept>

#include "mesh/surface_distance.hpp"
#include "mesh/surface_to_surface.hpp"
#include "support/test.hpp"

/// What test/test_fcl_shape_mesh_consistency.cpp of FCL asks (github.com/flexible-collision-library/fcl, commit e5efcc4, BSD): shapes and
/// meshes of them with 16 segments and 16 rings, apart and touching. Sizes, places and expectations are facts from there, the meshes are made
/// anew by their segment counts, and their gaps are closed forms.

namespace condyle::mesh {
namespace {

using std::numbers::pi;

constexpr int lathe_rings = 16;
constexpr Index lathe_segments = 16;
/// The rings of a ball stand at multiples of pi / 17 from its pole: the widest two, 8 and 9, beside its equator. As a share of its radius.
const double widest = std::sin(8 * pi / 17);

TriMesh meshed_ellipsoid(const Vec3& radii) {
  std::vector<std::array<double, 2>> profile;
  for (int i = 0; i <= lathe_rings + 1; ++i)
    profile.push_back({std::sin(pi * i / (lathe_rings + 1)), std::cos(pi * i / (lathe_rings + 1))});
  return test::mapped(test::turned_solid(profile, lathe_segments),
                      [&](const Vec3& p) { return Vec3(radii.cwiseProduct(p)); });
}
TriMesh meshed_ball(double radius) {
  return meshed_ellipsoid(Vec3::Constant(radius));
}

TriMesh meshed_cylinder(double radius, double length) {
  std::vector<std::array<double, 2>> profile = {{0, length / 2}};
  for (int i = 0; i <= lathe_rings; ++i) profile.push_back({radius, length / 2 - i * length / lathe_rings});
  profile.push_back({0, -length / 2});
  return test::turned_solid(profile, lathe_segments);
}

TriMesh meshed_cone(double radius, double length) {
  std::vector<std::array<double, 2>> profile;
  for (int i = 0; i <= lathe_rings; ++i)
    profile.push_back({i * radius / lathe_rings, length / 2 - i * length / lathe_rings});
  profile.push_back({0, -length / 2});
  return test::turned_solid(profile, lathe_segments);
}

TriMesh sized_box(double x, double y, double z) {
  return test::box({-x / 2, -y / 2, -z / 2}, {x / 2, y / 2, z / 2});
}

Pose shifted_by(const Vec3& by) {
  return Pose(Eigen::Translation3d(by));
}

double gap_of_meshes(const TriMesh& first, const TriMesh& second, const Pose& X) {
  return closest_points(TriangleTree(first), TriangleTree(second), X).value().distance_mm;
}

struct ShapePair {
  std::string name;
  TriMesh first, second;
  double reach;         ///< of both along x, mm: their meshes touch where the second is moved by this
  double shapes_reach;  ///< of the shapes themselves
};

std::vector<ShapePair> shape_pairs() {
  return {{"two spheres", meshed_ball(20), meshed_ball(20), 40 * widest, 40},
          {"two ellipsoids", meshed_ellipsoid({20, 40, 50}), meshed_ball(10), 30 * widest, 30},
          {"two boxes", sized_box(20, 40, 50), sized_box(10, 10, 10), 15, 15},
          {"sphere and box", meshed_ball(20), sized_box(5, 5, 5), 20 * widest + 2.5, 22.5},
          {"two cylinders", meshed_cylinder(5, 10), meshed_cylinder(5, 10), 10, 10},
          {"two cones", meshed_cone(5, 10), meshed_cone(5, 10), 10, 10},
          {"sphere and small sphere", meshed_ball(20), meshed_ball(10), 30 * widest, 30}};
}

const ShapePair& shapes_named(const std::vector<ShapePair>& all, const std::string& name) {
  for (const ShapePair& pair : all)
    if (pair.name == name) return pair;
  throw std::logic_error(name);
}

TEST(FclShapes, AreAsFarApartAsTheirWidestCornersSayAndWithinWhatIsExpectedOfShapes) {
  // Moved along x by this; FCL's tolerance of a mesh's distance, as a share of the shapes'.
  struct Apart {
    std::string name;
    double shift, tolerance;
  };
  const auto all = shape_pairs();
  std::mt19937 random(1);
  std::uniform_real_distribution<double> anywhere(0, 10), angle(0, 2 * pi);
  for (const Apart& apart :
       {Apart{"two spheres", 50, 0.05}, Apart{"two spheres", 40.1, 2}, Apart{"two ellipsoids", 40, 0.05},
        Apart{"two ellipsoids", 30.1, 2}, Apart{"two boxes", 50, 0.01}, Apart{"two boxes", 15.1, 2},
        Apart{"two cylinders", 20, 0.01}, Apart{"two cylinders", 15, 2}, Apart{"two cones", 20, 0.05},
        Apart{"two cones", 15, 2}}) {
    const ShapePair& pair = shapes_named(all, apart.name);
    const Pose X = shifted_by({apart.shift, 0, 0});
    const double expected = apart.shift - pair.reach, of_shapes = apart.shift - pair.shapes_reach;
    EXPECT_NEAR(gap_of_meshes(pair.first, pair.second, X), expected, 1e-12)
        << apart.name << " " << apart.shift;
    EXPECT_LT(std::abs(expected - of_shapes) / of_shapes, apart.tolerance) << apart.name;
    // Both carried elsewhere: coordinates up to 120 mm are rounded three times, 2^-53 each.
    for (int i = 0; i < 10; ++i) {
      Pose X_WA = shifted_by({anywhere(random), anywhere(random), anywhere(random)});
      X_WA.linear() =
          (Eigen::AngleAxisd(angle(random), Vec3::UnitX()) * Eigen::AngleAxisd(angle(random), Vec3::UnitY()) *
           Eigen::AngleAxisd(angle(random), Vec3::UnitZ()))
              .toRotationMatrix();
      const TriMesh first = posed(X_WA, pair.first), second = posed(X_WA * X, pair.second);
      EXPECT_NEAR(gap_of_meshes(first, second, Pose::Identity()), expected, 1e-12) << apart.name;
    }
  }
}

TEST(FclShapes, TouchWhereTheyAreExpectedTo) {
  struct Touch {
    std::string name;
    Vec3 shift;
    bool touch;
  };
  const auto all = shape_pairs();
  for (const Touch& each :
       {Touch{"two boxes", {15.01, 0, 0}, false}, Touch{"two boxes", {14.99, 0, 0}, true},
        Touch{"two boxes", {15, 0, 0}, true}, Touch{"sphere and box", {22.4, 0, 0}, true},
        Touch{"sphere and box", {22.51, 0, 0}, false}, Touch{"two cylinders", {9.99, 0, 0}, true},
        Touch{"two cylinders", {10.01, 0, 0}, false}, Touch{"two cones", {9.9, 0, 0}, true},
        Touch{"two cones", {10.1, 0, 0}, false}, Touch{"two cones", {0, 0, 9.9}, true},
        Touch{"two cones", {0, 0, 10.1}, false}, Touch{"two spheres", {40, 0, 0}, false},
        // Meshes are inside of their spheres, and surfaces one in the other do not touch.
        Touch{"sphere and small sphere", {30, 0, 0}, false},
        Touch{"sphere and small sphere", {29.9, 0, 0}, false},
        Touch{"sphere and small sphere", {29.87, 0, 0}, true},
        Touch{"sphere and small sphere", {-29.87, 0, 0}, true},
        Touch{"sphere and small sphere", {0, 0, 0}, false}, Touch{"two ellipsoids", {0, 0, 0}, false},
        Touch{"two boxes", {0, 0, 0}, false}}) {
    const ShapePair& pair = shapes_named(all, each.name);
    EXPECT_EQ(gap_of_meshes(pair.first, pair.second, shifted_by(each.shift)) == 0, each.touch)
        << each.name << " " << each.shift.transpose();
  }
}

TEST(FclShapes, OfASphereItselfAreAsFarAsTheMeshIsFromItsCentre) {
  // A sphere of radius 20 against the mesh of one of radius 10: touching at 29.9 and not at 30, as there; within it, all the way.
  const TriMesh small = meshed_ball(10);
  for (const auto& [shift, touches] :
       {std::pair{40.0, false}, {30.0, false}, {29.9, true}, {-29.9, true}, {-30.0, false}, {0.0, true}}) {
    const TriMesh moved = posed(shifted_by({shift, 0, 0}), small);
    const double distance = SurfaceDistance(moved)(Vec3::Zero());
    EXPECT_EQ(distance <= 20, touches) << shift;
    if (shift != 0) {
      EXPECT_NEAR(distance, std::abs(shift) - 10 * widest, 1e-12);
    }
  }
}

}  // namespace
}  // namespace condyle::mesh
