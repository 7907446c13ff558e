#include "mesh/ray_hits.hpp"

#include "simd/instruction_set.hpp"
#include "support/test.hpp"

namespace condyle::mesh {
namespace {

constexpr double none = std::numeric_limits<double>::infinity();

RayHits hits_of(const TriMesh& mesh, const std::vector<Ray>& rays, double reach,
                const Pose& X_TR = Pose::Identity()) {
  RayHits hits;
  nearest_hits(RayTarget(mesh), X_TR, rays, reach, hits);
  return hits;
}

/// Every triangle, by barycentric coordinates in extended precision. `doubtful` where the ray passes within `margin` of an
/// edge's line, relative to the triangle, or the distance is that near an end.
struct Expected {
  double distance = none;
  Index triangle = no_index;
  bool doubtful = false;
};
Expected brute_force(const TriMesh& mesh, const Ray& ray, double reach) {
  using Long = Eigen::Matrix<long double, 3, 1>;
  constexpr long double margin = 1e-9L;
  Expected found;
  const Long o = ray.origin.cast<long double>(), u = ray.direction.cast<long double>();
  for (Index t = 0; t < mesh.triangles.size(); ++t) {
    const Long a = mesh.corner(t, 0).cast<long double>(), b = mesh.corner(t, 1).cast<long double>(),
               c = mesh.corner(t, 2).cast<long double>();
    const Long n = (b - a).cross(c - a);
    const long double speed = n.dot(u);
    if (std::abs(speed) < margin * n.norm()) continue;
    const long double distance = n.dot(a - o) / speed;
    const Long p = o + distance * u;
    const long double least =
        std::min({(b - a).cross(p - a).dot(n), (c - b).cross(p - b).dot(n), (a - c).cross(p - c).dot(n)}) /
        n.squaredNorm();
    if (least < -margin || distance < -margin || distance > reach + margin) continue;
    if (least < margin || distance < margin || distance > reach - margin) found.doubtful = true;
    if (distance < found.distance) found.distance = static_cast<double>(distance), found.triangle = t;
  }
  return found;
}

TEST(RayHits, AgreeWithEveryTriangleHeldAgainstEveryRay) {
  std::mt19937_64 random(7);
  std::normal_distribution<double> normal;
  const auto vector = [&] { return Vec3(normal(random), normal(random), normal(random)); };
  const TriMesh mesh = test::joined(test::sphere({3, -2, 1}, 10, 3), test::torus(14, 3, 40, 20));
  Pose X_TR = Pose::Identity();
  X_TR.linear() = Eigen::AngleAxisd(0.7, vector().normalized()).toRotationMatrix();
  X_TR.translation() = Vec3(1, 2, 3);
  for (const double reach : {4.0, 30.0}) {
    std::vector<Ray> rays;
    for (int i = 0; i < 1001; ++i) rays.push_back({8 * vector(), vector().normalized()});
    // Neighbours that run alike, as of a surface.
    for (int i = 0; i < 1003; ++i)
      rays.push_back({Vec3(0.01 * i - 5, 20, 0.003 * i), Vec3(0.001 * i - 0.5, -1, 0.1).normalized()});
    const RayHits hits = hits_of(mesh, rays, reach, X_TR);
    std::size_t met = 0, missed = 0;
    for (std::size_t i = 0; i < rays.size(); ++i) {
      const Expected expected =
          brute_force(mesh, {X_TR * rays[i].origin, X_TR.linear() * rays[i].direction}, reach);
      if (expected.doubtful) continue;
      ++(expected.triangle == no_index ? missed : met);
      EXPECT_EQ(hits.triangle[i], expected.triangle) << i;
      if (expected.triangle != no_index) {
        EXPECT_NEAR(hits.distance[i], expected.distance, 1e-11) << i;
      } else {
        EXPECT_EQ(hits.distance[i], none);
      }
    }
    EXPECT_GT(met, 100u);
    EXPECT_GT(missed, 100u);
  }
}

TEST(RayHits, NoRaySlipsThroughAnEdgeOrAVertex) {
  // Rays aimed at vertices and at middles of edges, from outside of a closed surface: each meets it there or before.
  const TriMesh mesh = test::sphere({0.1, 0.2, 0.3}, 7, 3);
  std::vector<Ray> rays;
  std::vector<double> distance;
  const Vec3 from(31, 17, 23);
  const auto aim = [&](const Vec3& at) {
    rays.push_back({from, (at - from).normalized()});
    distance.push_back((at - from).norm());
  };
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    aim(mesh.corner(t, 0));
    aim((mesh.corner(t, 0) + mesh.corner(t, 1)) / 2);
  }
  const RayHits hits = hits_of(mesh, rays, 100);
  for (std::size_t i = 0; i < rays.size(); ++i) {
    // A vertex on the far side is met through the near one; one on the outline may be passed by.
    const Vec3 at = from + distance[i] * rays[i].direction, out = at - Vec3(0.1, 0.2, 0.3);
    if (std::abs(out.normalized().dot(rays[i].direction)) < 0.2) continue;
    ASSERT_TRUE(hits.is_hit(i)) << i;
    EXPECT_LE(hits.distance[i], distance[i] + 1e-11) << i;
    if (out.dot(rays[i].direction) < 0) {
      EXPECT_NEAR(hits.distance[i], distance[i], 1e-11) << i;
    }
  }
}

TEST(RayHits, ReachIsIncludedAndNothingBehind) {
  const TriMesh box = test::box({-1, -1, -1}, {1, 1, 1});
  const std::vector<Ray> rays = {
      {{3, 0.25, 0.5}, {-1, 0, 0}}, {{3, 0.25, 0.5}, {1, 0, 0}}, {{1, 0.25, 0.5}, {-1, 0, 0}}};
  EXPECT_EQ(hits_of(box, rays, 2).distance[0], 2);
  EXPECT_EQ(hits_of(box, rays, std::nextafter(2, 0)).distance[0], none);
  EXPECT_EQ(hits_of(box, rays, 10).distance[1], none);
  EXPECT_EQ(hits_of(box, rays, 10).distance[2], 0) << "a ray that starts on the surface";
}

TEST(RayHits, OfTrianglesMetAtOneDistanceTheLowestNumberCounts) {
  const TriMesh once = test::box({-1, -1, -1}, {1, 1, 1});
  const TriMesh twice = test::joined(once, once);
  const RayHits hits = hits_of(twice, {{{3, 0.5, 0.25}, {-1, 0, 0}}}, 10);
  EXPECT_LT(hits.triangle[0], once.triangles.size());
}

TEST(RayHits, AreTheSameWhateverTriangleIsTriedFirst) {
  std::mt19937_64 random(13);
  std::normal_distribution<double> normal;
  const auto vector = [&] { return Vec3(normal(random), normal(random), normal(random)); };
  const TriMesh mesh = test::torus(14, 3, 40, 20);
  std::vector<Ray> rays;
  for (int i = 0; i < 500; ++i) rays.push_back({8 * vector(), vector().normalized()});
  const RayTarget target(mesh);
  RayHits hits;
  nearest_hits(target, Pose::Identity(), rays, 40, hits);
  std::uniform_int_distribution<Index> any(0, static_cast<Index>(mesh.triangles.size() - 1));
  std::vector<Index> guessed, right;
  for (std::size_t ray = 0; ray < rays.size(); ++ray) {
    guessed.push_back(any(random));
    right.push_back(hits.is_hit(ray) ? hits.triangle[ray] : guessed.back());
  }
  for (const auto& first : {guessed, right}) {
    RayHits again;
    nearest_hits(target, Pose::Identity(), rays, 40, again, first);
    EXPECT_EQ(again.distance, hits.distance);
    EXPECT_EQ(again.triangle, hits.triangle);
  }
}

TEST(RayHits, SameBitsOnEveryInstructionSet) {
  std::mt19937_64 random(11);
  std::normal_distribution<double> normal;
  const auto vector = [&] { return Vec3(normal(random), normal(random), normal(random)); };
  const TriMesh mesh = test::torus(14, 3, 40, 20);
  std::vector<Ray> rays;
  for (int i = 0; i < 500; ++i) rays.push_back({8 * vector(), vector().normalized()});
  const RayHits best = hits_of(mesh, rays, 40);
  for (const auto& set : simd::instruction_sets()) {
    const simd::InstructionSetInUse in_use(set);
    const RayHits other = hits_of(mesh, rays, 40);
    EXPECT_EQ(other.distance, best.distance) << set.name;
    EXPECT_EQ(other.triangle, best.triangle) << set.name;
  }
}

TEST(RayHits, NoTriangleNoHitAndNoRayNoAnswer) {
  EXPECT_FALSE(hits_of({}, {{{0, 0, 0}, {1, 0, 0}}}, 10).is_hit(0));
  EXPECT_TRUE(hits_of(test::box({-1, -1, -1}, {1, 1, 1}), {}, 10).triangle.empty());
}

}  // namespace
}  // namespace condyle::mesh
