#include <numeric>

#include "condyle/contact.hpp"
#include "condyle/range_of_motion.hpp"
#include "sample/made_hips.hpp"
#include "support/test.hpp"

/// The same surfaces with vertices, triangles and corners in another order. Decisions and pairs are the same. Of numbers the last
/// bits may differ: a plane is rounded from its first corner, and of features that meet at the same angle, as an edge and its
/// end, another one may come first. docs/concepts.md says so.

namespace condyle::sample {
namespace {

/// A mesh in another order: vertex v of it is vertex `vertex[v]` of the one it was made of; triangles likewise.
struct Shuffled {
  TriMesh mesh;
  std::vector<Index> vertex, triangle;
};

Shuffled shuffled(const TriMesh& given, std::mt19937_64& random) {
  const auto order_of = [&](std::size_t count) {
    std::vector<Index> order(count);
    std::iota(order.begin(), order.end(), Index{0});
    std::shuffle(order.begin(), order.end(), random);
    return order;
  };
  Shuffled made{{}, order_of(given.vertices.size()), order_of(given.triangles.size())};
  std::vector<Index> place(made.vertex.size());
  for (Index v = 0; v < place.size(); ++v) {
    place[made.vertex[v]] = v;
    made.mesh.vertices.push_back(given.vertices[made.vertex[v]]);
  }
  for (const Index t : made.triangle) {
    Triangle corners = given.triangles[t];
    for (Index& corner : corners) corner = place[corner];
    std::rotate(corners.begin(), corners.begin() + static_cast<std::ptrdiff_t>(random() % 3), corners.end());
    made.mesh.triangles.push_back(corners);
  }
  return made;
}

Pose pose_of(double flexion_deg, double rotation_deg) {
  return pose_at({Anatomy::hip, Side::right},
                 JointAngles{Angle::degrees(flexion_deg), Angle(), Angle::degrees(rotation_deg)});
}

/// docs/mathematics/06-range-of-motion.md lowers distances by this, as more than all rounding on the way.
constexpr double more_than_rounding_mm = 1e-9;

class VertexOrder : public ::testing::Test {
 protected:
  const SampleHip& hip = test::made_hip(Scenario::one);
  std::mt19937_64 random{11};
  const Shuffled hip_bone = shuffled(hip.hip_bone, random), femur = shuffled(hip.femur, random);
};

TEST_F(VertexOrder, ChangesNoStateAndNoPairAndGapsByRounding) {
  const contact::JointContact given(Mesh(hip.hip_bone), Mesh(hip.femur)),
      other(Mesh(hip_bone.mesh), Mesh(femur.mesh));
  std::size_t inside = 0;
  for (const Pose& X_FM : {pose_of(0, 0), pose_of(120, 30), pose_of(100, 60)}) {
    const contact::RadialContact a = given.radial(X_FM), b = other.radial(X_FM);
    for (std::size_t v = 0; v < femur.vertex.size(); ++v) {
      const auto &in_order = *a.mobile_in_fixed, &in_other = *b.mobile_in_fixed;
      ASSERT_EQ(in_other.state[v], in_order.state[femur.vertex[v]]);
      const double gap = in_order.radial_gap_mm[femur.vertex[v]], other_gap = in_other.radial_gap_mm[v];
      ASSERT_TRUE(gap == other_gap || std::abs(gap - other_gap) <= more_than_rounding_mm)
          << gap << ' ' << other_gap;
      inside += in_other.state[v] == PointState::inside;
    }
    std::vector<std::pair<Index, Index>> expected, found;
    for (const contact::TrianglePair& pair : a.pairs) expected.emplace_back(pair.fixed, pair.mobile);
    for (const contact::TrianglePair& pair : b.pairs)
      found.emplace_back(hip_bone.triangle[pair.fixed], femur.triangle[pair.mobile]);
    std::sort(expected.begin(), expected.end());
    std::sort(found.begin(), found.end());
    EXPECT_EQ(found, expected);
  }
  EXPECT_GT(inside, 20u);
}

TEST_F(VertexOrder, ChangesALimitByNoMoreThanItsErrorBound) {
  const auto limits = [](const TriMesh& fixed, const TriMesh& mobile) {
    return motion::RangeOfMotion(
               {"hip", JointKind::ball, Side::right, {"hip bone", Mesh(fixed)}, {"femur", Mesh(mobile)}})
        .limits(motion::hip_motions());
  };
  const auto given = limits(hip.hip_bone, hip.femur), other = limits(hip_bone.mesh, femur.mesh);
  ASSERT_EQ(given.size(), other.size());
  for (std::size_t i = 0; i < given.size(); ++i) {
    const motion::Limit &a = given[i].end, &b = other[i].end;
    EXPECT_EQ(a.reason, b.reason) << given[i].motion.name;
    EXPECT_LE(std::abs((a.turned - b.turned).degrees()), std::max(a.error_bound, b.error_bound).degrees())
        << given[i].motion.name;
  }
}

}  // namespace
}  // namespace condyle::sample
