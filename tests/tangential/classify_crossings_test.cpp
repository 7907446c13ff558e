#include "tangential/query/classify_crossings.hpp"

#include "mesh/triangle_intersection.hpp"
#include "simd/instruction_set.hpp"
#include "support/test.hpp"

namespace condyle::tangential {
namespace {

/// Circles about z, each with triangles of its own.
struct Pairs {
  double scale;
  std::vector<CirclePoint> points;
  core::UninitialisedVector<AxisVertex> vertices;
  std::vector<Triangle> triangles;
  std::vector<Index> circle, triangle;

  void add_point(const Vec3& p) { points.push_back({p.x(), p.y(), p.z(), p.x() * p.x() + p.y() * p.y()}); }
  /// To the last point.
  void add(const mesh::TriangleCorners& corners) {
    const auto first = static_cast<Index>(vertices.size());
    for (const Vec3& corner : corners) vertices.push_back({corner, 0});
    triangle.push_back(static_cast<Index>(triangles.size()));
    circle.push_back(static_cast<Index>(points.size() - 1));
    triangles.push_back({first, first + 1, first + 2});
  }
  mesh::TriangleCorners corners(std::size_t k) const {
    const auto& [a, b, c] = triangles[triangle[k]];
    return {vertices[a].at, vertices[b].at, vertices[c].at};
  }
};

struct Outcome {
  CrossingClass crossing_class;
  double angle;
  friend bool operator==(const Outcome&, const Outcome&) = default;
};

/// Outcomes of the pairs that may cross.
std::map<std::size_t, Outcome> classified(const Pairs& pairs) {
  std::map<std::size_t, Outcome> all;
  ClassifiedPairs found;
  for (std::size_t first = 0; first < pairs.circle.size(); first += ClassifiedPairs::most) {
    tangential::classify_crossings({pairs.vertices.data(), pairs.triangles.data(), pairs.scale}, pairs.points,
                                   pairs.circle, pairs.triangle, first, found);
    for (std::size_t k = 0; k < found.count; ++k) {
      const auto crossing_class =
          static_cast<CrossingClass>(static_cast<signed char>(found.crossing_class[k]));
      all[found.pair[k]] = {crossing_class, crossing_class == CrossingClass::uncertain ? 0 : found.angle[k]};
    }
  }
  return all;
}

struct Counts {
  std::size_t compared = 0, left_out = 0, decided = 0;
};

/// Against what is decided exactly, one pair at a time: none is left out that crosses or holds its point, and
/// what is decided has the same bits.
void expect_as_one_by_one(const Pairs& pairs, Counts& counts) {
  const auto found = classified(pairs);
  for (std::size_t k = 0; k < pairs.circle.size(); ++k) {
    const CirclePoint& p = pairs.points[pairs.circle[k]];
    const mesh::TriangleCorners t = pairs.corners(k);
    std::vector<CircleCrossing> crossings;
    TangentialWork work;
    tangential::add_crossings({p.at(), p.squared_radius, pairs.scale}, {&t[0], &t[1], &t[2]}, 0, crossings,
                              work);
    const auto at = found.find(k);
    ++counts.compared;
    if (at == found.end()) {
      EXPECT_TRUE(crossings.empty());
      EXPECT_FALSE(core::orientation(t[0], t[1], t[2], p.at()) == core::Sign::zero &&
                   mesh::contains_coplanar(t, p.at()));
      ++counts.left_out;
    } else if (at->second.crossing_class != CrossingClass::uncertain) {
      ASSERT_EQ(crossings.size(), 1u);
      EXPECT_EQ(crossings[0].angle, at->second.angle);
      EXPECT_EQ(static_cast<int>(crossings[0].passage), static_cast<int>(at->second.crossing_class));
      ++counts.decided;
    }
  }
}

/// About places on circles, from large to so small that rounding decides; a third of the triangles with
/// a corner at the circle's height, or in the point itself.
Pairs pairs_of_size(double scale, std::mt19937& random) {
  std::uniform_real_distribution<double> uniform(-1, 1), weight(0, 1);
  Pairs pairs{2 * scale, {}, {}, {}, {}, {}};
  for (int round = 0; round < 400; ++round) {
    const Vec3 p = 0.5 * scale * Vec3(uniform(random), uniform(random), uniform(random));
    pairs.add_point(p);
    for (int i = 0; i < 13; ++i) {
      const double angle = 3.2 * uniform(random), size = scale * std::exp2(-55 * weight(random));
      const double c = std::cos(angle), s = std::sin(angle);
      const Vec3 at(c * p.x() - s * p.y(), s * p.x() + c * p.y(), p.z());
      mesh::TriangleCorners t;
      for (Vec3& corner : t) corner = at + size * Vec3(uniform(random), uniform(random), uniform(random));
      if (i % 3 == 0) t[0].z() = p.z();
      if (i % 6 == 0) t[0] = p;
      pairs.add(t);
    }
  }
  return pairs;
}

TEST(ClassifyCrossings, AreTheCrossingsFoundOneByOneAtAnySize) {
  std::mt19937 random(3);
  for (const double scale : {1.0, 300.0, 1e-5, 1e-30, 1e-100, 1e17, 1e60, 1e100}) {
    Counts counts;
    expect_as_one_by_one(pairs_of_size(scale, random), counts);
    // Where fourth powers overflow or underflow nothing is decided, and nothing left out but by height.
    const bool usual = scale > 1e-60 && scale < 1e70;
    EXPECT_GT(counts.left_out, counts.compared / (usual ? 4 : 20)) << scale;
    if (usual) {
      EXPECT_GT(counts.decided, counts.compared / 10) << scale;
    } else {
      EXPECT_EQ(counts.decided, 0u) << scale;
    }
  }
}

TEST(ClassifyCrossings, AreTheCrossingsFoundOneByOneOfTrianglesThatAreNearlyFlat) {
  std::mt19937 random(5);
  std::uniform_real_distribution<double> uniform(-1, 1);
  Counts counts;
  Pairs pairs{100, {}, {}, {}, {}, {}};
  for (double flat = 1e-8; flat > 1e-26; flat /= 3) {
    for (int round = 0; round < 40; ++round) {
      pairs.add_point({50 * uniform(random), 50 * uniform(random), flat * uniform(random) / 2});
      for (int i = 0; i < 16; ++i) {
        mesh::TriangleCorners t;
        for (Vec3& p : t) p = {100 * uniform(random), 100 * uniform(random), flat * uniform(random)};
        pairs.add(t);
      }
    }
  }
  expect_as_one_by_one(pairs, counts);
  EXPECT_GT(counts.decided, counts.compared / 6);
}

Pairs pairs_on_a_lattice() {
  std::mt19937 random(4);
  std::uniform_int_distribution<int> coordinate(-5, 5);
  const auto point = [&] { return Vec3(coordinate(random), coordinate(random), coordinate(random)); };
  Pairs pairs{5, {}, {}, {}, {}, {}};
  for (int round = 0; round < 500; ++round) {
    Vec3 p = point();
    while (p.x() == 0 && p.y() == 0) p = point();
    pairs.add_point(p);
    for (int i = 0; i < 16; ++i) pairs.add({point(), point(), point()});
  }
  return pairs;
}

TEST(ClassifyCrossings, AreTheCrossingsFoundOneByOneOnALattice) {
  Counts counts;
  expect_as_one_by_one(pairs_on_a_lattice(), counts);
  EXPECT_GT(counts.decided, 500u);
  EXPECT_GT(counts.left_out, 1000u);
}

TEST(ClassifyCrossings, AreTheSameBytesOnEveryInstructionSet) {
  std::mt19937 random(7);
  for (const Pairs& pairs : {pairs_of_size(100, random), pairs_on_a_lattice()}) {
    const auto expected = classified(pairs);
    EXPECT_GT(expected.size(), 1000u);
    for (const simd::InstructionSet& set : simd::instruction_sets()) {
      const simd::InstructionSetInUse in_use(set);
      EXPECT_EQ(classified(pairs), expected) << set.name;
    }
  }
}

}  // namespace
}  // namespace condyle::tangential
