#include <ostream>

#include "method.hpp"
#include "support/test.hpp"

/// Results of the published and the library methods that find vertices inside, on shapes with answers known in closed
/// form. The experiment measures how far they are off on bones.

namespace bench {

inline void PrintTo(const MethodKind& kind, std::ostream* out) {
  *out << kind.name;
}

namespace {

using condyle::Index;
using condyle::Pose;
using condyle::TriMesh;
using condyle::Vec3;

/// Those of these tests: they look up vertices in something that was made of the fixed body.
std::vector<MethodKind> looking_up() {
  const std::set<std::string> families = {"ray casting", "spherical sampling", "distance fields",
                                          "image space", "spatial hashing"};
  std::vector<MethodKind> kinds;
  for (const MethodGroup& group : method_groups())
    for (const MethodKind& kind : group.kinds)
      if (families.contains(kind.family)) kinds.push_back(kind);
  return kinds;
}

/// The methods among them that update for a deformed body; the others are made anew.
std::vector<MethodKind> following() {
  std::vector<MethodKind> kinds = looking_up();
  std::erase_if(kinds, [](const MethodKind& kind) { return !kind.answers.deforms; });
  return kinds;
}

/// A ball of 14 mm about the joint centre, and a slab that begins 10 mm beside it.
///
///        | slab          a vertex at x > 10 is inside, x - 10 deep to the nearest surface,
///    (   |)              r (1 - 10 / x) deep along its ray
///        |
class BallInSlab : public ::testing::TestWithParam<MethodKind> {
 protected:
  static constexpr double begin_mm = 10, radius_mm = 14;
  /// Half a pixel or sample of the coarsest of them, 64 to a side: seen from the centre half the diagonal of
  /// a cell is 1 / (32 sqrt 2) rad, at 14 mm and 44 degrees to the surface 0.3 mm; of a pixel 0.3 mm too.
  static constexpr double sample_mm = 0.31;

  std::map<Index, InsideVertex> inside_of(Method& method, const Pose& X = Pose::Identity()) const {
    std::vector<InsideVertex> reported;
    method.find_inside(X, reported);
    std::map<Index, InsideVertex> inside;
    for (const InsideVertex& vertex : reported) {
      const bool is_new = inside.emplace(vertex.vertex, vertex).second;
      EXPECT_TRUE(is_new) << "vertex " << vertex.vertex << " reported twice";
    }
    return inside;
  }

  void expect_beyond(double begin, const std::map<Index, InsideVertex>& inside) const {
    const double margin = is_sampled() ? sample_mm : 1e-4;
    int beyond = 0;
    for (Index v = 0; v < ball_.vertices.size(); ++v) {
      const Vec3 p = ball_.vertices[v];
      if (std::abs(p.x() - begin) <= margin) continue;
      const auto reported = inside.find(v);
      ASSERT_EQ(reported != inside.end(), p.x() > begin) << "vertex " << v << " at x = " << p.x();
      if (reported == inside.end()) continue;
      ++beyond;
      if (GetParam().depth == DepthKind::none) continue;
      const bool is_along_ray = GetParam().depth == DepthKind::along_ray;
      EXPECT_NEAR(reported->second.depth_mm, is_along_ray ? p.norm() * (1 - begin / p.x()) : p.x() - begin,
                  margin);
    }
    EXPECT_GT(beyond, 20);
  }

  bool is_sampled() const {
    return GetParam().family == "spherical sampling" || GetParam().family == "image space";
  }

  const TriMesh slab_ = condyle::test::box({begin_mm, -16, -16}, {20, 16, 16});
  const TriMesh ball_ = condyle::test::sphere({0, 0, 0}, radius_mm, 4);
  const Bodies bodies_{slab_, ball_};
};

TEST_P(BallInSlab, VerticesBeyondTheFaceAreInsideAsDeepAsTheyAreBeyondIt) {
  const auto method = GetParam().make(bodies_);
  expect_beyond(begin_mm, inside_of(*method));
}

TEST_P(BallInSlab, TheTriangleToldIsOneOfTheFace) {
  const auto method = GetParam().make(bodies_);
  const auto inside = inside_of(*method);
  EXPECT_GT(inside.size(), 20u);
  for (const auto& [v, reported] : inside) {
    if (reported.triangle == condyle::no_index) continue;
    for (int k = 0; k < 3; ++k) EXPECT_EQ(slab_.corner(reported.triangle, k).x(), begin_mm);
  }
}

TEST_P(BallInSlab, ABallMovedAwayHasNothingInside) {
  const auto method = GetParam().make(bodies_);
  Pose away = Pose::Identity();
  away.translation() = Vec3(-4.5, 0, 0);
  EXPECT_TRUE(inside_of(*method, away).empty());
}

TEST_P(BallInSlab, AskedAgainItAnswersAlikeAndSoDoesACopyForAnotherThread) {
  const auto method = GetParam().make(bodies_);
  const auto inside = inside_of(*method);
  const auto expect_alike = [&](Method& other) {
    const auto again = inside_of(other);
    ASSERT_EQ(inside.size(), again.size());
    for (const auto& [v, reported] : inside) {
      ASSERT_TRUE(again.contains(v));
      EXPECT_EQ(again.at(v).triangle, reported.triangle);
    }
  };
  expect_alike(*method);
  if (const auto copy = method->for_another_thread()) expect_alike(*copy);
}

class BallInDeformedSlab : public BallInSlab {};

TEST_P(BallInDeformedSlab, TheFaceIsWhereItWasMoved) {
  const auto method = GetParam().make(bodies_);
  for (const double begin : {9.5, 10.75}) {
    condyle::Points moved = slab_.vertices;
    for (double& x : moved.x)
      if (x == begin_mm) x = begin;
    method->deform(moved);
    expect_beyond(begin, inside_of(*method));
  }
}

std::string name_of(const testing::TestParamInfo<MethodKind>& kind) {
  std::string name = kind.param.name;
  std::replace(name.begin(), name.end(), '.', '_');
  return name;
}

INSTANTIATE_TEST_SUITE_P(Methods, BallInSlab, ::testing::ValuesIn(looking_up()), name_of);
INSTANTIATE_TEST_SUITE_P(Methods, BallInDeformedSlab, ::testing::ValuesIn(following()), name_of);

}  // namespace
}  // namespace bench
