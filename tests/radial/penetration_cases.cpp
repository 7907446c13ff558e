#include "radial/penetration_cases.hpp"

#include "radial/query/point_blocks.hpp"
#include "support/test.hpp"

namespace condyle::test {
namespace {

/// The same surface behind the paper's map, whose rows have neither 8-DOPs nor edge functions.
radial::RadialTable reference_of(const radial::RadialTable& table) {
  return radial::RadialTable(table.mesh(), {radial::DirectionMapKind::cartesian, 24});
}

/// Results of the plain query for the posed points that are not outside, in the order of the sorted ones.
radial::Penetrations plain(const radial::RadialTable& table, PointsView points,
                           const radial::SortedPoints& sorted, const Pose& X) {
  const radial::RadialResults hits = table.query(posed(X, points));
  radial::Penetrations out;
  for (const Index i : sorted.blocks().index()) {
    if (hits.state[i] == PointState::outside) continue;
    out.point.push_back(i);
    out.state.push_back(hits.state[i]);
    out.winding.push_back(hits.winding[i]);
    out.triangle.push_back(hits.triangle[i]);
    out.depth_mm.push_back(std::abs(hits.radial_gap_mm[i]));
    out.direction.push_back(hits.direction[i]);
    out.ray_to_normal.push_back(hits.ray_to_normal[i]);
  }
  return out;
}

}  // namespace

Pose pose_of(double angle, const Vec3& axis, const Vec3& translation) {
  Pose X = Pose::Identity();
  X.linear() = Eigen::AngleAxisd(angle, axis.normalized()).toRotationMatrix();
  X.translation() = translation;
  return X;
}

std::vector<Pose> some_poses(std::size_t count, double largest_translation, unsigned seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> uniform(-1, 1);
  // One by one: compilers draw the arguments of a call in another order each.
  const auto drawn = [&] {
    const double z = uniform(random), y = uniform(random), x = uniform(random);
    return Vec3(x, y, z);
  };
  std::vector<Pose> poses = {Pose::Identity()};
  for (std::size_t i = 1; i < count; ++i) {
    const double size = i % 3 == 0 ? 0 : largest_translation * std::pow(10, -static_cast<double>(i % 4));
    const Vec3 axis = drawn(), along = drawn();
    poses.push_back(pose_of(3 * uniform(random), axis, size * along));
  }
  return poses;
}

Points random_points(std::size_t count, double reach, unsigned seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> uniform(-reach, reach);
  Points points;
  for (std::size_t i = 0; i < count; ++i)
    points.push_back({uniform(random), uniform(random), uniform(random)});
  return points;
}

Points points_near_surface(const TriMesh& mesh, std::size_t count, double factor, unsigned seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> unit(0, 1);
  Points points;
  for (std::size_t i = 0; i < count; ++i) {
    const auto t = static_cast<Index>(random() % mesh.triangles.size());
    double s = unit(random), r = unit(random);
    if (s + r > 1) s = 1 - s, r = 1 - r;
    if (i % 4 == 0) s = 0;
    const Vec3 a = mesh.corner(t, 0), b = mesh.corner(t, 1), c = mesh.corner(t, 2);
    points.push_back(factor * (a + s * (b - a) + r * (c - a)));
  }
  return points;
}

Compared expect_plain_answers(const radial::RadialTable& table, const Points& points,
                              const std::vector<Pose>& poses, const Vec3& centre) {
  const radial::SortedPoints sorted(points, centre);
  const radial::RadialTable reference = reference_of(table);
  Compared compared;
  radial::Penetrations out;
  for (const Pose& X : poses) {
    table.penetrations(sorted, X, out, &compared.work);
    table.add_ray_to_normal(points, X, out);
    EXPECT_EQ(out, plain(reference, points, sorted, X));
    compared.found += out.size();
  }
  return compared;
}

}  // namespace condyle::test
