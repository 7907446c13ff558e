#include "condyle/contact_measures.hpp"

#include "mesh/subdivide.hpp"
#include "support/test.hpp"

/// Areas, mean depths and volumes in closed form, and how fast finer meshes come to them.

namespace condyle::test {
namespace {

constexpr double pi = std::numbers::pi;

contact::ContactMeasures measured(const TriMesh& fixed, const TriMesh& mobile,
                                  const Pose& X = Pose::Identity()) {
  const contact::JointContact joint(fixed, mobile);
  return contact::measure_contact(joint, X, contact::MeasuredContact(joint.radial(X)),
                                  contact::DistancesOf::all_vertices);
}

/// Two spheres whose centres are d apart; the lens that they share.
///
///     .-- R --(  )-- r --.       u0 = (R^2 + d^2 - r^2) / (2 R d): cosine at the edge of R's cap
struct Lens {
  double R, r, d;

  double u0(double own, double other) const { return (own * own + d * d - other * other) / (2 * own * d); }
  double area(double own, double other) const { return 2 * pi * own * own * (1 - u0(own, other)); }
  /// Mean over own's cap of other - |p - c|, with |p - c|^2 = own^2 + d^2 - 2 own d u, uniform in u.
  double mean_depth(double own, double other) const {
    const double b = 2 * own * d, nearest = std::abs(own - d);
    return other - 2 / (3 * b) * (std::pow(other, 3) - std::pow(nearest, 3)) / (1 - u0(own, other));
  }
  double volume() const {
    const double s = R + r - d;
    return pi * s * s * (d * d + 2 * d * (R + r) - 3 * (R - r) * (R - r)) / (12 * d);
  }
};

/// Relative errors at one level of refinement.
struct Errors {
  double area_fixed, area_mobile, mean_fixed, mean_mobile, volume, centroid_mm;
};

Errors lens_errors(const Lens& lens, int level) {
  // Off every axis of the meshes, so that nothing is hit by luck. The joint centre is in neither surface.
  const Vec3 direction = Vec3(0.3, 0.8, -0.52).normalized(), away(1, 2, 3);
  const TriMesh fixed = sphere(away, lens.R, level),
                mobile = sphere(away + lens.d * direction, lens.r, level);
  const contact::ContactMeasures found = measured(fixed, mobile);
  const auto relative = [](double value, double exact) { return std::abs(value / exact - 1); };
  // By symmetry the centroid is on the line of centres, at the areas' mean of both caps' middles.
  const double area_R = lens.area(lens.R, lens.r), area_r = lens.area(lens.r, lens.R);
  const double along = (area_R * lens.R * (1 + lens.u0(lens.R, lens.r)) / 2 +
                        area_r * (lens.d - lens.r * (1 + lens.u0(lens.r, lens.R)) / 2)) /
                       (area_R + area_r);
  return {relative(found.fixed->area_mm2, area_R),
          relative(found.mobile->area_mm2, area_r),
          relative(*found.fixed->mean_depth_mm, lens.mean_depth(lens.R, lens.r)),
          relative(*found.mobile->mean_depth_mm, lens.mean_depth(lens.r, lens.R)),
          relative(*found.volume_mm3, lens.volume()),
          (*found.centroid - (away + along * direction)).norm()};
}

/// Edges of half the length err a quarter as much; two levels make a sixteenth. Where the border runs through
/// triangles is chance, which leaves a factor of two.
TEST(ContactMeasures, OfTwoSpheresComeToThoseOfTheLensByTheSquareOfTheEdgeLength) {
  const Lens lens{20, 15, 30};
  const Errors coarse = lens_errors(lens, 4), fine = lens_errors(lens, 6);
  for (const auto error : {&Errors::area_fixed, &Errors::area_mobile, &Errors::mean_fixed,
                           &Errors::mean_mobile, &Errors::volume}) {
    EXPECT_LT(fine.*error, coarse.*error / 8);
    EXPECT_LT(fine.*error, 0.01);
  }
  EXPECT_LT(fine.centroid_mm, 0.01);
}

/// Boxes [0, 10]^3 and [10 - L, ...]^3 share a cube of edge L. On each of the three faces of a body that lie in it the
/// depth is the smaller of two distances, L / 3 in the mean.
TEST(ContactMeasures, OfTwoBoxesComeToThoseOfTheCubeTheyShare) {
  const double L = 4.7;
  double coarse_mean = 0;
  for (const int level : {3, 5}) {
    TriMesh fixed = box({0, 0, 0}, {10, 10, 10}), mobile = box(Vec3::Constant(10 - L), {17, 18, 19});
    for (int i = 0; i < level; ++i) fixed = mesh::subdivided(fixed), mobile = mesh::subdivided(mobile);
    const Vec3 centre(5, 5, 5);  // of the joint: on no surface
    for (TriMesh* mesh : {&fixed, &mobile})
      for (std::size_t v = 0; v < mesh->vertices.size(); ++v)
        mesh->vertices.set(v, mesh->vertices[v] - centre);
    const contact::ContactMeasures found = measured(fixed, mobile);
    double area = 0, mean = 0;
    for (const auto& patch : {found.fixed, found.mobile}) {
      area = std::max(area, std::abs(patch->area_mm2 / (3 * L * L) - 1));
      mean = std::max(mean, std::abs(*patch->mean_depth_mm / (L / 3) - 1));
    }
    const double volume = std::abs(*found.volume_mm3 / (L * L * L) - 1);
    EXPECT_LT(area, 1e-11);
    EXPECT_LT(volume, 1e-11);
    if (level == 3) {
      coarse_mean = mean;
      continue;
    }
    EXPECT_LT(mean, coarse_mean / 4);
    EXPECT_EQ(found.nearest.distance_mm, 0);
  }
}

TEST(ContactMeasures, OfABoxInABoxAreThoseOfTheInnerOne) {
  const TriMesh outer = box({-10, -10, -10}, {10, 10, 10}), inner = box({-1, -2, 4}, {3, 1, 9});
  const contact::ContactMeasures found = measured(outer, inner);
  // Twelve triangles: every sum is of a few terms.
  EXPECT_NEAR(*found.volume_mm3, 4 * 3 * 5, 1e-12);
  EXPECT_NEAR(found.mobile->area_mm2, 2 * (4 * 3 + 3 * 5 + 4 * 5), 1e-12);
  EXPECT_EQ(found.fixed->area_mm2, 0);
  EXPECT_FALSE(found.fixed->mean_depth_mm);
  EXPECT_FALSE(found.fixed->centroid);
  EXPECT_NEAR((*found.centroid - Vec3(1, -0.5, 6.5)).norm(), 0, 1e-14);
  EXPECT_NEAR(found.nearest.distance_mm, 1, 1e-14);
  EXPECT_NEAR(found.nearest.on_fixed.z(), 10, 1e-14);
  EXPECT_NEAR(found.nearest.on_mobile.z(), 9, 1e-14);
}

/// A pyramid's tip through the middle of a large face: no vertex of the face is inside, and it has its patch all the same.
TEST(ContactMeasures, UnderACornerNeedNoVertexOfTheFace) {
  const TriMesh slab = box({-50, -50, 10}, {50, 50, 20});
  TriMesh tip;
  for (const Vec3& p : {Vec3(-3, -3, 5), Vec3(3, -3, 5), Vec3(0, 4, 5), Vec3(0, 0, 12)})
    tip.vertices.push_back(p);
  tip.triangles = {{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {2, 0, 3}};
  const contact::ContactMeasures found = measured(slab, tip);
  // Cut at 2 of 7 mm below the tip: what is cut off is similar to the whole, and the gap is linear along the edges.
  const double whole = 6 * 7 / 2.0 * 7 / 3;
  EXPECT_NEAR(*found.volume_mm3, whole * std::pow(2 / 7.0, 3), 1e-12);
  EXPECT_NEAR(found.fixed->area_mm2, 6 * 7 / 2.0 * std::pow(2 / 7.0, 2), 1e-12);
  EXPECT_GT(found.mobile->area_mm2, found.fixed->area_mm2);
}

TEST(ContactMeasures, OfBodiesApartAreADistanceOnly) {
  const contact::ContactMeasures found = measured(box({1, 1, 1}, {2, 2, 2}), box({5, 1, 1}, {6, 2, 2}));
  EXPECT_NEAR(found.nearest.distance_mm, 3, 1e-14);
  EXPECT_EQ(*found.volume_mm3, 0);
  EXPECT_FALSE(found.centroid);
  EXPECT_EQ(found.distances.mobile.size(), 8u);
  EXPECT_NEAR(found.distances.mobile[0], 3, 1e-14);
}

TEST(ContactMeasures, WithAnOpenMeshThereIsNoVolumeAndOnePatch) {
  TriMesh open = box({-10, -10, -10}, {10, 10, 10});
  open.triangles.pop_back();
  const contact::ContactMeasures found = measured(open, box({5, 1, 1}, {15, 2, 2}));
  EXPECT_FALSE(found.volume_mm3);
  EXPECT_FALSE(found.mobile);
  ASSERT_TRUE(found.fixed);
}

TEST(ContactMeasures, DoNotDependOnWhichBodyIsWhich) {
  const TriMesh a = sphere({1, 2, 3}, 20, 3), b = sphere({15, 9, 5}, 12, 3);
  const contact::ContactMeasures one = measured(a, b), other = measured(b, a);
  EXPECT_EQ(one.mobile->area_mm2, other.fixed->area_mm2);
  EXPECT_EQ(*one.fixed->mean_depth_mm, *other.mobile->mean_depth_mm);
  EXPECT_NEAR(*one.volume_mm3, *other.volume_mm3, 1e-9 * *one.volume_mm3);
}

}  // namespace
}  // namespace condyle::test
