#include "condyle/tangential.hpp"

#include <memory>

#include "core/thread_limit.hpp"
#include "mesh/winding_number.hpp"
#include "simd/instruction_set.hpp"
#include "support/test.hpp"
#include "tangential/about_z.hpp"

namespace condyle::tangential {
namespace {

using test::infinity, test::z_axis;

TEST(RingTable, TenMetresFromTheOriginStatesStayExactAndAnglesKeepTheirBound) {
  const Vec3 away(1e4, -1e4, 1e4);
  const TriMesh ball = test::sphere(away, 25, 3);
  Points points;
  for (std::size_t i = 0; i < ball.vertices.size(); ++i) {
    const Vec3 v = ball.vertices[i];
    points.push_back(v);
    points.push_back(v + (away - v) * 1e-12);
    points.push_back(v + (away - v) * 0.3);
    points.push_back(v - (away - v) * 0.3);
  }
  const auto windings = mesh::WindingNumber(ball).at(points);
  // About the z axis of the origin, 14 m away: no rounding at all.
  const auto results = RingTable(ball, z_axis).query(points);
  for (std::size_t i = 0; i < points.size(); ++i) EXPECT_EQ(results.state[i], windings[i].state);
  // About an axis beside the ball, the coordinates rounded once: the angle is that of the mesh moved to the
  // origin.
  const TriMesh home = test::sphere(Vec3::Zero(), 25, 3);
  Points home_points;
  for (std::size_t i = 0; i < points.size(); ++i) home_points.push_back(points[i] - away);
  const auto far_results = RingTable(ball, AxisFrame(away + Vec3(40, 0, 0), Vec3::UnitZ())).query(points);
  const auto near_results = RingTable(home, AxisFrame(Vec3(40, 0, 0), Vec3::UnitZ())).query(home_points);
  for (std::size_t i = 2; i < points.size(); i += 4) {
    // Vertices ten metres out are given to 2^-40 mm; at a graze that may show as its root.
    EXPECT_EQ(far_results.state[i], near_results.state[i]);
    EXPECT_NEAR(far_results.angular_gap[i].radians(), near_results.angular_gap[i].radians(),
                std::sqrt(2 * 0x1p-39 / 15));
  }
}

TEST(RingTable, AnyAxisGivesWhatRotatingEverythingToZGives) {
  const Vec3 point(3, -2, 5), direction(1, -2, 3);
  const AxisFrame frame(point, direction);
  const TriMesh mesh = test::socket({10, 4, -3}, 8, 12, 3);
  Points points, in_frame;
  std::mt19937 random(2);
  std::uniform_real_distribution<double> uniform(-15, 15);
  for (int i = 0; i < 500; ++i) {
    points.push_back(Vec3(10, 4, -3) + Vec3(uniform(random), uniform(random), uniform(random)));
    in_frame.push_back(frame.to_axis(points[points.size() - 1]));
  }
  EXPECT_EQ(RingTable(mesh, frame).query(points),
            RingTable(test::in_axis_frame(frame, mesh), z_axis).query(in_frame));
  // Opposite direction: the same gaps, every rotation sense reversed.
  const auto forth = RingTable(mesh, AxisFrame(Vec3::Zero(), Vec3::UnitX())).query(points);
  const auto back = RingTable(mesh, AxisFrame(Vec3::Zero(), -Vec3::UnitX())).query(points);
  EXPECT_EQ(forth.state, back.state);
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (std::isinf(forth.angular_gap[i].radians())) {
      EXPECT_EQ(forth.angular_gap[i].radians(), back.angular_gap[i].radians());
    } else {
      EXPECT_NEAR(forth.angular_gap[i].radians(), back.angular_gap[i].radians(), 1e-7);
      EXPECT_EQ(static_cast<int>(forth.rotation_sense[i]), -static_cast<int>(back.rotation_sense[i]));
    }
  }
}

/// Beside its length floats cannot distinguish its radii from zero.
TEST(RingTable, OfAnEndlesslyThinNeedleHasTheStatesOfBruteForce) {
  const double thin = 1e-29, length = 1e10;
  const TriMesh needle = test::box({-thin, -3 * thin, -length}, {5 * thin, 6 * thin, length});
  Points points;
  for (int i = 0; i < 800; ++i)
    points.push_back(
        {7 * thin * std::sin(i * 1.7), 9 * thin * std::cos(i * 2.9), 1.3 * length * std::sin(i * 5.3)});
  const auto windings = mesh::WindingNumber(needle).at(points);
  EXPECT_GT(std::count_if(windings.begin(), windings.end(),
                          [](const auto& at) { return at.state == PointState::inside; }),
            20);
  for (const double cells_per_triangle : {0.1, 1.0, 30.0}) {
    const auto results = RingTable(needle, z_axis, {.cells_per_triangle = cells_per_triangle}).query(points);
    for (std::size_t i = 0; i < points.size(); ++i) EXPECT_EQ(results.state[i], windings[i].state) << i;
  }
}

TEST(RingTable, AnOpenMeshAndAFoolishOptionAreRefused) {
  TriMesh mesh = test::box({1, 1, 1}, {2, 2, 2});
  EXPECT_THROW(RingTable(mesh, z_axis, {.cells_per_triangle = 0}), UsageError);
  EXPECT_THROW(RingTable(mesh, z_axis, {.cells_per_triangle = NAN}), UsageError);
  mesh.triangles.pop_back();
  try {
    RingTable refused(mesh, z_axis);
    FAIL() << "an open mesh was accepted";
  } catch (const MeshError& error) {
    EXPECT_NE(std::string(error.what()).find("intersecting triangle pairs can still be computed"),
              std::string::npos);
  }
}

TEST(RingTable, ACopyOutlivesTheTableAndTheMeshItWasMadeOf) {
  Points points;
  for (double x = -12; x < 12; x += 0.7) points.push_back({x, 1.3, 0.4});
  auto mesh = std::make_unique<Mesh>(test::torus(8, 3, 20, 10));
  auto table = std::make_unique<RingTable>(*mesh, z_axis);
  const auto results = table->query(points);
  const RingTable copy = *table, moved = std::move(*table);
  table.reset(), mesh.reset();
  EXPECT_EQ(copy.query(points), results);
  EXPECT_EQ(moved.query(points), results);
}

TEST(RingTable, NoTrianglesAndNoPointsAreNoTrouble) {
  const RingTable nothing(TriMesh{}, z_axis);
  Points points;
  EXPECT_EQ(nothing.query(points).size(), 0u);
  EXPECT_EQ(nothing.occupied_arcs(points).size(), 0u);
  points.push_back({1, 2, 3}), points.push_back({0, 0, 0});
  EXPECT_EQ(nothing.query(points).angular_gap,
            (std::vector<Angle>{Angle::radians(infinity), Angle::radians(infinity)}));
  EXPECT_TRUE(nothing.occupied_arcs(points).of(1).empty());
}

TEST(RingTable, AnyFinenessOfTheProfileGivesTheSameAnswersByteForByte) {
  const TriMesh mesh = test::joined(test::torus(8, 3, 31, 17), test::sphere({6, 2, 1}, 4, 3));
  Points points;
  std::mt19937 random(12);
  std::uniform_real_distribution<double> uniform(-12, 12);
  for (int i = 0; i < 3000; ++i) points.push_back({uniform(random), uniform(random), uniform(random) / 3});
  for (std::size_t i = 0; i < mesh.vertices.size(); ++i) points.push_back(mesh.vertices[i]);
  const RingTable coarse(mesh, z_axis, {.cells_per_triangle = 0.001}),
      fine(mesh, z_axis, {.cells_per_triangle = 8});
  auto a = coarse.query(points), b = fine.query(points);
  EXPECT_GT(a.work.candidates, 3 * b.work.candidates);
  a.work = b.work = {};
  EXPECT_EQ(a, b);
  EXPECT_EQ(coarse.occupied_arcs(points), fine.occupied_arcs(points));
}

TEST(RingTable, IsTheSameOnEveryInstructionSetByteForByte) {
  const TriMesh mesh = test::joined(test::torus(8, 3, 50, 30), test::socket({3, 2, 0}, 6, 8, 3));
  Points points;
  std::mt19937 random(14);
  std::uniform_real_distribution<double> uniform(-12, 12);
  for (int i = 0; i < 5000; ++i) points.push_back({uniform(random), uniform(random), uniform(random) / 2});
  for (std::size_t i = 0; i < mesh.vertices.size(); ++i) points.push_back(mesh.vertices[i]);
  const AxisFrame frame(Vec3(0.3, -0.2, 0), Vec3(1, 2, 7));
  for (const AxisFrame& axis : {z_axis, frame}) {
    const RingTable table(mesh, axis);
    const auto results = table.query(points);
    const auto arcs = table.occupied_arcs(points);
    EXPECT_GT(std::count(results.state.begin(), results.state.end(), PointState::inside), 500);
    for (const simd::InstructionSet& set : simd::instruction_sets()) {
      const simd::InstructionSetInUse in_use(set);
      EXPECT_EQ(results, RingTable(mesh, axis).query(points)) << set.name;
      EXPECT_EQ(arcs, RingTable(mesh, axis).occupied_arcs(points)) << set.name;
      EXPECT_EQ(results, table.query(points)) << set.name;
    }
  }
}

TEST(RingTable, IsTheSameForAnyNumberOfThreadsByteForByte) {
  const TriMesh mesh = test::joined(test::torus(8, 3, 50, 30), test::socket({3, 2, 0}, 6, 8, 3));
  Points points;
  std::mt19937 random(4);
  std::uniform_real_distribution<double> uniform(-12, 12);
  for (int i = 0; i < 20000; ++i) points.push_back({uniform(random), uniform(random), uniform(random) / 2});
  const RingTable table(mesh, z_axis);
  const auto results = table.query(points);
  const auto arcs = table.occupied_arcs(points);
  const core::ThreadLimit one(1);
  EXPECT_EQ(results, RingTable(mesh, z_axis).query(points));
  EXPECT_EQ(arcs, RingTable(mesh, z_axis).occupied_arcs(points));
  EXPECT_GT(std::count(results.state.begin(), results.state.end(), PointState::inside), 2000);
}

}  // namespace
}  // namespace condyle::tangential
