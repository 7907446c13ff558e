#include "condyle/radial.hpp"
#include "radial/penetration_cases.hpp"
#include "simd/instruction_set.hpp"
#include "support/parameter_names.hpp"
#include "support/test.hpp"

namespace condyle::radial {
namespace {

using test::box;
using test::expect_plain_answers;
using test::points_near_surface;
using test::random_points;
using test::some_poses;
using test::sphere;

/// Every vertex by up to `size`, the same for the same seed.
Points jiggled(const Points& points, double size, unsigned seed) {
  const Points by = random_points(points.size(), size, seed);
  Points moved;
  for (std::size_t i = 0; i < points.size(); ++i) moved.push_back(points[i] + by[i]);
  return moved;
}

TEST(RadialTableUpdate, AfterAllVerticesMovedAnswersAreThoseOfANewTable) {
  const Points points = random_points(800, 1.5, 21);
  for (const DirectionMapKind map : {DirectionMapKind::cube, DirectionMapKind::cartesian}) {
    TriMesh mesh = test::socket({0.1, 0.05, -0.2}, 1, 1.3, 4);
    RadialTable table(mesh, {map, 16});
    for (unsigned frame = 0; frame < 3; ++frame) {
      mesh.vertices = jiggled(mesh.vertices, 0.01, frame);
      table.update(mesh.vertices);
      const RadialTable made_anew(mesh, {map, 16});
      EXPECT_EQ(table.mesh(), mesh);
      EXPECT_EQ(table.query(points), made_anew.query(points));
      expect_plain_answers(table, points, some_poses(4, 0.2, frame));
    }
  }
}

TEST(RadialTableUpdate, ASurfaceThatHasDriftedIsReadWithSlackForThat) {
  for (const int cells : {8, 24, 64}) {
    // The centre outside the solid, and inside.
    for (TriMesh mesh : {test::socket({0.1, 0.05, -0.2}, 1, 1.3, 4), sphere({0.1, -0.2, 0.05}, 1, 4)}) {
      const Points rest = mesh.vertices;
      RadialTable table(mesh, {DirectionMapKind::cube, cells});
      table.prepare_penetrations();
      for (unsigned frame = 0; frame < 12; ++frame) {
        constexpr std::array<double, 4> sizes = {1e-6, 1e-3, 0.01, 0.03};
        mesh.vertices = jiggled(rest, sizes[frame % 4], frame);
        table.update(mesh.vertices);
        const Points near = points_near_surface(mesh, 100, 0.98 + 0.02 * (frame % 3), frame);
        expect_plain_answers(table, near, {Pose::Identity()});
        expect_plain_answers(table, near, some_poses(2, 0.1, frame));
      }
    }
  }
}

/// The same for its radii: a ball that grows about the centre is met where it was not before.
TEST(RadialTableUpdate, ASurfaceThatGrowsIsMetWhereItWasNot) {
  const TriMesh ball = sphere({0, 0, 0}, 1, 5);
  for (const double size : {1.02, 0.98}) {
    RadialTable table(ball);
    table.prepare_penetrations();
    const TriMesh grown = test::mapped(ball, [&](const Vec3& p) { return Vec3(size * p); });
    table.update(grown.vertices);
    for (const double part : {0.1, 0.9})
      expect_plain_answers(table, points_near_surface(ball, 300, 1 + part * (size - 1), 5),
                           {Pose::Identity()});
  }
}

/// And for its directions: a ball that is seen in the corner of a face, where cells are narrowest, and turns about the centre.
TEST(RadialTableUpdate, ASurfaceThatTurnsIsMetWhereItWasNotSeen) {
  const TriMesh ball = sphere({2, 2, 2}, 0.3, 4);
  RadialTable table(ball, {DirectionMapKind::cube, 64});
  table.prepare_penetrations();
  const Pose turned(Eigen::AngleAxisd(0.028, Vec3(1, -1, 0).normalized()));
  const TriMesh there = test::mapped(ball, [&](const Vec3& p) { return Vec3(turned * p); });
  table.update(there.vertices);
  Points points;
  for (const double part : {0.9, 0.98, 0.995}) {
    const Points shell = points_near_surface(sphere({0, 0, 0}, 0.3, 4), 4000, part, 6);
    for (std::size_t i = 0; i < shell.size(); ++i) points.push_back(turned * Vec3(shell[i] + Vec3(2, 2, 2)));
  }
  expect_plain_answers(table, points, {Pose::Identity()});
}

TEST(RadialTableUpdate, AfterSomeVerticesMovedAnswersAreThoseOfANewTable) {
  const Points points = random_points(800, 1.6, 22);
  std::mt19937 random(23);
  for (const DirectionMapKind map : {DirectionMapKind::cube, DirectionMapKind::cartesian}) {
    TriMesh mesh = test::socket({0.1, 0.05, -0.2}, 1, 1.3, 4);
    RadialTable table(mesh, {map, 24});
    for (unsigned frame = 0; frame < 12; ++frame) {
      // Near ones and far apart ones, little and much, nearer to the centre than any before.
      std::vector<Index> moved;
      for (Index i = 0; i < mesh.vertices.size(); ++i) {
        if (frame % 2 == 0 ? random() % 50 == 0 : mesh.vertices[i].x() > 0.9) moved.push_back(i);
      }
      Points positions;
      for (const Index i : moved) positions.push_back((frame % 3 == 0 ? 0.93 : 1.01) * mesh.vertices[i]);
      for (std::size_t k = 0; k < moved.size(); ++k) mesh.vertices.set(moved[k], positions[k]);
      ASSERT_FALSE(moved.empty());
      table.update(moved, positions);
      const RadialTable made_anew(mesh, {map, 24});
      EXPECT_EQ(table.mesh(), mesh);
      EXPECT_EQ(table.query(points), made_anew.query(points));
      expect_plain_answers(table, points, some_poses(4, 0.2, frame));
      expect_plain_answers(table, points_near_surface(mesh, 100, 1, frame), {Pose::Identity()});
    }
  }
}

/// Update by update, each of another kind: all vertices or some, little or much, back to where they were.
void expect_answers_after_updates(TriMesh mesh, int cells_per_side, double reach) {
  RadialTable table(mesh, {DirectionMapKind::cube, cells_per_side});
  const Points at_first = mesh.vertices, points = random_points(400, reach, 27);
  const SortedPoints sorted(points);
  const std::vector<Pose> poses = some_poses(3, 0.1 * reach, 28);
  std::vector<Index> patch;
  for (Index i = 0; i < mesh.vertices.size(); i += 1 + i % 7) patch.push_back(i);
  for (unsigned frame = 0; frame < 14; ++frame) {
    const double size = reach * (frame % 4 == 3 ? 0.05 : 1e-4);
    const Points moved = frame % 5 == 4 ? at_first : jiggled(mesh.vertices, size, frame);
    if (frame % 3 == 1) {
      Points positions;
      for (const Index i : patch) positions.push_back(moved[i]);
      for (std::size_t k = 0; k < patch.size(); ++k) mesh.vertices.set(patch[k], positions[k]);
      table.update(patch, positions);
    } else {
      mesh.vertices = moved;
      table.update(moved);
    }
    const RadialTable made_anew(mesh, {DirectionMapKind::cube, cells_per_side});
    EXPECT_EQ(table.mesh(), mesh);
    EXPECT_EQ(table.winding_at_centre(), made_anew.winding_at_centre());
    EXPECT_EQ(table.query(points), made_anew.query(points));
    Penetrations updated, anew;
    for (const Pose& X : poses) {
      table.penetrations(sorted, X, updated);
      made_anew.penetrations(sorted, X, anew);
      EXPECT_EQ(updated, anew);
    }
    expect_plain_answers(table, points, poses);
    expect_plain_answers(table, points_near_surface(mesh, 60, 1, frame), {Pose::Identity()});
  }
}

/// On each instruction set that the machine has.
class RadialTableUpdateOn : public testing::TestWithParam<simd::InstructionSet> {
 protected:
  simd::InstructionSetInUse in_use_{GetParam()};
};

INSTANTIATE_TEST_SUITE_P(EveryInstructionSet, RadialTableUpdateOn,
                         testing::ValuesIn(simd::instruction_sets()),
                         [](const auto& set) { return set.param.name; });

TEST_P(RadialTableUpdateOn, AfterUpdatesOfAllKindsAnswersAreThoseOfANewTable) {
  expect_answers_after_updates(test::socket({0.1, 0.05, -0.2}, 1, 1.3, 3), 16, 1.5);
  // About the centre; triangles larger than cells; the centre close to a box's faces, whose triangles are
  // projected on most faces of the cube.
  expect_answers_after_updates(sphere({0.1, 0.2, -0.1}, 1, 3), 24, 1.2);
  expect_answers_after_updates(test::torus(2, 0.7, 12, 8), 32, 3);
  expect_answers_after_updates(box({-0.05, -1, -1}, {1, 1.2, 1.1}), 8, 1.5);
}

TEST(RadialTableUpdate, ASurfaceThatPassesTheCentreChangesWhatIsInside) {
  TriMesh mesh = sphere({0.3, 0.2, 1.5}, 1, 3);
  RadialTable table(mesh);
  EXPECT_EQ(table.winding_at_centre(), 0);
  std::vector<Index> all(mesh.vertices.size());
  for (Index i = 0; i < all.size(); ++i) all[i] = i;
  const Points points = random_points(500, 1.5, 24);
  for (const double shift : {-1.2, 0.1, -0.05, 1.2}) {
    for (const Index i : all) mesh.vertices.set(i, mesh.vertices[i] + Vec3(0, 0, shift));
    table.update(all, mesh.vertices);
    const RadialTable made_anew(mesh);
    EXPECT_EQ(table.winding_at_centre(), made_anew.winding_at_centre());
    EXPECT_EQ(table.query(points), made_anew.query(points));
    expect_plain_answers(table, points, some_poses(3, 0.2, 25));
  }
}

/// The first triangle moved so that it holds the origin.
Points with_the_centre_on_the_surface(const TriMesh& mesh) {
  Points moved = mesh.vertices;
  const auto& [a, b, c] = mesh.triangles[0];
  moved.set(a, {1, 0, 0}), moved.set(b, {-1, 1, 0}), moved.set(c, {-1, -1, 0});
  return moved;
}

TEST(RadialTableUpdate, AfterARefusedUpdateTheTableIsWhatItWasBefore) {
  const Points points = random_points(500, 1.5, 29);
  const SortedPoints sorted(points);
  for (const DirectionMapKind map : {DirectionMapKind::cube, DirectionMapKind::cartesian}) {
    const TriMesh mesh = test::socket({0.1, 0.05, -0.2}, 1, 1.3, 3);
    const RadialTable before(mesh, {map, 16});
    RadialTable table = before;
    const Points refused = with_the_centre_on_the_surface(mesh);
    std::vector<Index> moved(mesh.triangles[0].begin(), mesh.triangles[0].end());
    Points positions;
    for (const Index v : moved) positions.push_back(refused[v]);
    const auto expect_as_before = [&] {
      EXPECT_EQ(table.mesh(), mesh);
      EXPECT_EQ(table.winding_at_centre(), before.winding_at_centre());
      EXPECT_EQ(table.query(points), before.query(points));
      Penetrations out, expected;
      table.penetrations(sorted, Pose::Identity(), out);
      before.penetrations(sorted, Pose::Identity(), expected);
      EXPECT_EQ(out, expected);
    };
    EXPECT_THROW(table.update(refused), MeshError);
    expect_as_before();
    EXPECT_THROW(table.update(moved, positions), MeshError);
    expect_as_before();
    // Updates after that count again.
    table.update(jiggled(mesh.vertices, 0.01, 1));
    EXPECT_THROW(table.update(moved, positions), MeshError);
    table.update(mesh.vertices);
    expect_as_before();
  }
}

TEST(RadialTableUpdate, PositionsThatAreNotFiniteAndVerticesThatAreNotThereAreRefused) {
  const TriMesh mesh = sphere({0, 0, 3}, 1, 1);
  RadialTable table(mesh);
  Points nowhere = mesh.vertices;
  nowhere.set(2, {0, std::numeric_limits<double>::quiet_NaN(), 0});
  EXPECT_THROW(table.update(nowhere), MeshError);
  const std::vector<Index> one = {2}, absent = {static_cast<Index>(mesh.vertices.size())};
  Points position;
  position.push_back(nowhere[2]);
  EXPECT_THROW(table.update(one, position), MeshError);
  position.set(0, {0, 0, 0});
  EXPECT_THROW(table.update(absent, position), UsageError);
  EXPECT_EQ(table.mesh(), mesh);
}

TEST(RadialTableUpdate, ANumberOfVerticesThatIsNotTheMeshsIsRefused) {
  RadialTable table(sphere({0, 0, 3}, 1, 1));
  EXPECT_THROW(table.update(Points(3)), UsageError);
}

}  // namespace
}  // namespace condyle::radial
