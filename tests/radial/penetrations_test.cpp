#include <thread>

#include "condyle/radial.hpp"
#include "mesh/subdivide.hpp"
#include "radial/penetration_cases.hpp"
#include "simd/instruction_set.hpp"
#include "support/parameter_names.hpp"
#include "support/test.hpp"

namespace condyle::radial {
namespace {

using test::box;
using test::Compared;
using test::expect_plain_answers;
using test::flipped;
using test::joined;
using test::points_near_surface;
using test::pose_of;
using test::random_points;
using test::some_poses;
using test::sphere;

/// Every test runs on each instruction set that the machine has.
class PenetrationsOn : public testing::TestWithParam<simd::InstructionSet> {
 protected:
  simd::InstructionSetInUse in_use_{GetParam()};
};

INSTANTIATE_TEST_SUITE_P(EveryInstructionSet, PenetrationsOn, testing::ValuesIn(simd::instruction_sets()),
                         [](const auto& set) { return set.param.name; });

TriMesh cavity(double radius, int levels) {
  return joined(box(Vec3::Constant(-2 * radius), Vec3::Constant(2 * radius)),
                flipped(sphere(Vec3::Zero(), radius, levels)));
}

TEST_P(PenetrationsOn, ABallShiftedInItsSocketPenetratesWhereTheRaySphereRootSays) {
  constexpr double socket = 25, ball = 24.8, shift = 0.5;
  const Vec3 u = Vec3(1, 2, -2) / 3;
  const RadialTable table(cavity(socket, 5));
  const TriMesh mobile = sphere(Vec3::Zero(), ball, 4);
  Penetrations out;
  table.penetrations(SortedPoints(mobile.vertices), pose_of(0, u, shift * u), out);
  const double edge = socket * std::numbers::pi / 2 / 32 * (std::numbers::pi / 2);
  const double sag = edge * edge / (8 * socket) * 2;
  std::vector<bool> found(mobile.vertices.size());
  for (std::size_t k = 0; k < out.size(); ++k) {
    found[out.point[k]] = true;
    const double radius = (mobile.vertices[out.point[k]] + shift * u).norm();
    EXPECT_GE(out.depth_mm[k], radius - socket - 1e-11);
    EXPECT_LE(out.depth_mm[k], radius - socket + sag);
    EXPECT_EQ(out.direction[k], RayDirection::towards_centre);
  }
  std::size_t decided = 0;
  for (std::size_t i = 0; i < found.size(); ++i) {
    const double radius = (mobile.vertices[i] + shift * u).norm();
    if (radius > socket - sag && radius <= socket) continue;
    EXPECT_EQ(found[i], radius > socket);
    ++decided;
  }
  EXPECT_GT(decided, found.size() * 9 / 10);
}

TEST_P(PenetrationsOn, AnswersAreThoseOfThePlainQueryByteForByte) {
  const Points points = random_points(700, 1.6, 1);
  const auto poses = some_poses(13, 0.8, 2);
  std::size_t found = 0;
  for (const TriMesh& mesh : {test::socket({0.1, 0.05, -0.2}, 1, 1.3, 4), test::torus(1.2, 0.4, 30, 20),
                              sphere({0.3, 0.2, -0.1}, 1, 3), flipped(sphere({0.1, 0.2, 0.3}, 1, 2)),
                              box({-0.5, -0.1, -1}, {1, 1.2, 1}), cavity(0.7, 2)}) {
    found += expect_plain_answers(RadialTable(mesh), points, poses).found;
  }
  EXPECT_GT(found, 5000u);
}

TEST_P(PenetrationsOn, AnswersDoNotDependOnTheNumberOfCells) {
  const TriMesh mesh = test::socket({0.1, 0.05, -0.2}, 1, 1.3, 3);
  const Points points = random_points(300, 1.5, 3);
  for (const int cells : {1, 2, 3, 7, 12, 64, 200}) {
    expect_plain_answers(RadialTable(mesh, {DirectionMapKind::cube, cells}), points, some_poses(7, 0.5, 4));
  }
  expect_plain_answers(RadialTable(mesh, {DirectionMapKind::cartesian, 24}), points, some_poses(4, 0.5, 4));
}

TEST_P(PenetrationsOn, SolidsThatOverlapAreCountedByWinding) {
  TriMesh mesh = joined(box({1, -1, -1}, {2, 1, 1}), box({3, -1, -1}, {4, 1, 1}));
  mesh = joined(mesh, box({3.5, -1, -1}, {5, 1, 1}));
  mesh = joined(mesh, mesh::subdivided(box({-4, -1, -1}, {-2, 1, 1})));
  const Compared compared =
      expect_plain_answers(RadialTable(mesh), random_points(900, 5, 5), some_poses(9, 2, 6));
  EXPECT_GT(compared.found, 100u);
}

TEST_P(PenetrationsOn, PointsAMillionthFromTheSurfaceAndOnItAreDecidedExactly) {
  const TriMesh mesh = test::socket({0.01, 0.005, -0.02}, 25, 30, 3);
  const RadialTable table(mesh);
  std::uint64_t uncertain = 0;
  for (const double away : {0.0, 1e-6, -1e-6, 1e-9, -1e-9, 1e-14}) {
    // 1e-6 mm of a radius of 25 to 30 mm.
    const Points points = points_near_surface(mesh, 400, 1 + away / 25, 7);
    uncertain += expect_plain_answers(table, points, {Pose::Identity()}).work.uncertain;
  }
  EXPECT_GT(uncertain, 1000u);
  expect_plain_answers(table, mesh.vertices, {Pose::Identity()});
}

TEST_P(PenetrationsOn, PlanesThroughTheCentreAndSliversAreDecidedExactly) {
  // Faces seen edge-on, with points on them.
  const TriMesh edge_on = box({1, 0, -1}, {3, 2, 1});
  Points points = random_points(300, 3.5, 8);
  for (const Vec3& p : {Vec3(2, 0, 0), Vec3(1, 0, 0), Vec3(3, 0, 1), Vec3(1, 1, 1)}) points.push_back(p);
  expect_plain_answers(RadialTable(edge_on), points, some_poses(5, 1, 9));

  // A needle-shaped box: triangles 10 long and a hair wide, next to ordinary ones.
  for (const double width : {1e-3, 1e-6, 1e-9}) {
    const TriMesh needle = joined(box({5, -5, 3}, {5 + width, 5, 3 + width}), sphere({0, 0, 8}, 1, 2));
    Points near = points_near_surface(needle, 300, 1, 10);
    for (std::size_t i = 0; i < 300; ++i) near.push_back(points_near_surface(needle, 1, 1 - 1e-10, 11)[0]);
    expect_plain_answers(RadialTable(needle), near, {Pose::Identity(), some_poses(3, 0.1, 12)[2]});
  }
}

TEST_P(PenetrationsOn, ASolidThatHoldsTheCentreFindsPointsAtAndNearTheCentre) {
  const RadialTable table(sphere({0.3, 0.2, -0.1}, 10, 3));
  ASSERT_EQ(table.winding_at_centre(), 1);
  Points points = random_points(500, 8, 13);
  points.push_back({0, 0, 0});
  points.push_back({1e-300, 0, 0});
  points.push_back({1e-9, -1e-9, 3e-9});
  const Compared compared =
      expect_plain_answers(table, points, {Pose::Identity(), pose_of(1, {1, 2, 3}, {0.1, 0, 0})});
  EXPECT_GT(compared.found, 800u);
}

TEST_P(PenetrationsOn, BodiesFarFromTheirFramesOriginAndPosesThatAreNoneAreAnsweredToo) {
  const TriMesh mesh = test::socket(Vec3::Zero(), 25, 30, 3);
  const RadialTable table(mesh);
  // A mobile body 10 m from its frame's origin, with its joint centre there and without.
  const Vec3 centre(1e4, -2e3, 500);
  Points points;
  for (std::size_t i = 0; i < 400; ++i)
    points.push_back(centre + 27 * random_points(1, 1, static_cast<unsigned>(i))[0]);
  const Pose turned = pose_of(0.4, {1, 1, 0}, Vec3::Zero());
  Pose back = turned;
  back.translation() = -(turned * centre) + Vec3(0.5, 0, -0.2);
  EXPECT_GT(expect_plain_answers(table, points, {back}, centre).found, 10u);
  EXPECT_GT(expect_plain_answers(table, points, {back}).found, 10u);

  Pose stretched = turned;
  stretched.linear() *= 1.1;
  const Points near = random_points(400, 30, 14);
  expect_plain_answers(table, near, {stretched, pose_of(0, {1, 0, 0}, {200, 0, 0})});
}

TEST_P(PenetrationsOn, LengthsThatFloatsDoNotHoldAreAnsweredToo) {
  for (const double unit : {1e-30, 1e-13, 1e13, 5e29}) {
    TriMesh mesh = test::socket({0.1, 0.05, -0.2}, 1, 1.3, 2);
    Points points = random_points(200, 1.4, 15);
    for (auto* of : {&mesh.vertices, &points}) {
      for (std::size_t i = 0; i < of->size(); ++i) of->set(i, unit * (*of)[i]);
    }
    EXPECT_GT(expect_plain_answers(RadialTable(mesh), points, {Pose::Identity()}).found, 5u);
  }
}

TEST_P(PenetrationsOn, AnyNumberOfPointsFillsTheBlocks) {
  const RadialTable table(test::socket(Vec3::Zero(), 1, 1.3, 3));
  for (const std::size_t count : {0u, 1u, 15u, 16u, 17u, 255u, 257u, 4097u}) {
    expect_plain_answers(table, random_points(count, 1.3, static_cast<unsigned>(count)),
                         some_poses(3, 0.1, 16));
  }
}

TEST_P(PenetrationsOn, AFreeBallIsRejectedByTheBlock) {
  const RadialTable table(cavity(25, 5));
  const TriMesh ball = sphere(Vec3::Zero(), 24, 5);
  const Compared compared = expect_plain_answers(table, ball.vertices, some_poses(6, 0.05, 17));
  EXPECT_EQ(compared.found, 0u);
  EXPECT_EQ(compared.work.near_points, 0u);
  EXPECT_GT(compared.work.blocks, 6 * ball.vertices.size() / 16);
}

TEST_P(PenetrationsOn, RealHipsAndCartilagesAtRestAnswerAlike) {
  FOUND_OR_SKIP(data, test::shared_data());
  const auto read = [&](const char* name) { return test::read_ply(*data / "hip_libhip_m1_left" / name); };
  std::vector<Pose> poses = some_poses(3, 2, 18);
  for (const double angle : {0.6, 1.2, 2.0}) poses.push_back(pose_of(angle, {0.1, -0.2, 1}, Vec3::Zero()));
  const Compared bones =
      expect_plain_answers(RadialTable(read("hip_bone.ply")), read("femur.ply").vertices, poses);
  EXPECT_GT(bones.found, 100u);
  EXPECT_LT(bones.work.uncertain, bones.work.near_points / 100);
  // Touching in the reference pose: hundreds of vertices within 1e-4 mm of the other surface.
  const RadialTable acetabular(read("acetabular_cartilage_nogap.ply"));
  const Points femoral = read("femur_cartilage_nogap.ply").vertices;
  EXPECT_GT(
      expect_plain_answers(acetabular, femoral, {Pose::Identity(), pose_of(0.01, {0, 0, 1}, {0.1, 0, 0})})
          .found,
      300u);
}

TEST(Penetrations, AnOpenMeshIsRefused) {
  TriMesh mesh = sphere(Vec3::Zero(), 1, 2);
  mesh.triangles.pop_back();
  Penetrations out;
  EXPECT_THROW(RadialTable(mesh).penetrations(SortedPoints(mesh.vertices), Pose::Identity(), out), MeshError);
}

TEST(Penetrations, ManyPosesOnAllThreadsAreThoseOneByOne) {
  const RadialTable table(test::socket({0.1, 0.05, -0.2}, 1, 1.3, 3));
  const SortedPoints points(random_points(500, 1.5, 19));
  const auto poses = some_poses(40, 0.3, 20);
  std::vector<Penetrations> together(poses.size());
  table.penetrations(points, poses, together);
  for (std::size_t i = 0; i < poses.size(); ++i) {
    Penetrations single;
    table.penetrations(points, poses[i], single);
    EXPECT_EQ(together[i], single);
  }
}

TEST(RadialTable, ManyThreadsThatAskFirstGetTheSameAnswers) {
  const RadialTable table(test::socket({0.1, 0.05, -0.2}, 1, 1.3, 4));
  const SortedPoints points(random_points(500, 1.5, 30));
  std::vector<Penetrations> found(16);
  {
    std::vector<std::jthread> threads;
    for (Penetrations& out : found)
      threads.emplace_back([&] { table.penetrations(points, Pose::Identity(), out); });
  }
  EXPECT_GT(found[0].size(), 10u);
  for (const Penetrations& out : found) EXPECT_EQ(out, found[0]);
}

TEST(RadialTable, ATableThatOnlyAnswersQueriesBuildsNoRadii) {
  const TriMesh mesh = test::socket({0.1, 0.05, -0.2}, 1, 1.3, 4);
  const RadialTable table(mesh);
  const std::size_t built = table.table_size().bytes;
  table.query(mesh.vertices);
  EXPECT_EQ(table.table_size().bytes, built);
  table.prepare_penetrations();
  EXPECT_GT(table.table_size().bytes, built);
}

TEST(InstructionSets, TheBestComesFirst) {
  const auto sets = simd::instruction_sets();
  ASSERT_FALSE(sets.empty());
  for (std::size_t i = 1; i < sets.size(); ++i) EXPECT_LT(sets[i - 1].target, sets[i].target);
}

}  // namespace
}  // namespace condyle::radial
