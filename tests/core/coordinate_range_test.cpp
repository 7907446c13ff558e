#include "core/coordinate_range.hpp"

#include "condyle/contact.hpp"
#include "condyle/first_contact.hpp"
#include "condyle/normal_depth.hpp"
#include "condyle/pose.hpp"
#include "condyle/pressure.hpp"
#include "condyle/radial.hpp"
#include "condyle/tangential.hpp"
#include "support/brute_force.hpp"
#include "support/test.hpp"

namespace condyle {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();
constexpr double nan = std::numeric_limits<double>::quiet_NaN();

Pose translated(double x) {
  Pose X = Pose::Identity();
  X.translation().x() = x;
  return X;
}

TEST(CoordinateRange, EndsAt1e30) {
  Points points;
  points.push_back({1e30, -1e30, 0});
  EXPECT_EQ(core::first_out_of_range(points), std::nullopt);
  for (const double value : {std::nextafter(1e30, 1e31), -1e31, infinity, nan}) {
    Points beyond = points;
    beyond.push_back({0, 0, value});
    EXPECT_EQ(core::first_out_of_range(beyond), 1u) << value;
  }
  EXPECT_EQ(test::complaint_of<UsageError>([] { core::require_in_range(translated(1e30)); }), "accepted");
}

TEST(CoordinateRange, HoldsForEveryPoseThatIsAsked) {
  const Mesh box = test::box({1, 1, 1}, {2, 2, 2});
  const contact::JointContact joint(box, box);
  const motion::FirstContact turning(box, box, AxisFrame(Vec3::Zero(), Vec3::UnitZ()));
  const contact::NormalDepth normal(box, box);
  const radial::RadialTable table(box);
  const radial::SortedPoints sorted(box.vertices());
  radial::Penetrations out;
  const std::vector<std::function<void(const Pose&)>> questions = {
      [&](const Pose& X) { joint.at(X); },
      [&](const Pose& X) { joint.radial(X); },
      [&](const Pose& X) { joint.tangential(X, Vec3::UnitZ()); },
      [&](const Pose& X) { joint.pairs(X); },
      [&](const Pose& X) { joint.in_contact(X); },
      [&](const Pose& X) { turning.limits(X); },
      [&](const Pose& X) { normal.at(X); },
      [&](const Pose& X) { table.penetrations(sorted, X, out); },
  };
  Pose not_a_number = Pose::Identity();
  not_a_number.linear()(1, 2) = nan;
  for (const auto& ask : questions) {
    EXPECT_EQ(test::complaint_of<UsageError>([&] { ask(Pose::Identity()); }), "accepted");
    EXPECT_EQ(test::complaint_of<UsageError>([&] { ask(translated(-1e31)); }),
              "pose: its translation is beyond 1e30 mm");
    EXPECT_EQ(test::complaint_of<UsageError>([&] { ask(translated(infinity)); }),
              "pose: an entry is not finite");
    EXPECT_EQ(test::complaint_of<UsageError>([&] { ask(not_a_number); }), "pose: an entry is not finite");
  }
}

TEST(CoordinateRange, HoldsForEveryPointThatIsAsked) {
  const Mesh box = test::box({1, 1, 1}, {2, 2, 2});
  const radial::RadialTable radial(box);
  const AxisFrame axis(Vec3::Zero(), Vec3::UnitZ());
  const tangential::RingTable tangential(box, axis);
  Points points;
  points.push_back({0, 0, 0});
  points.push_back({0, -1e31, 0});
  const std::string expected = "point 1 has a coordinate that is not finite or beyond 1e30 mm";
  EXPECT_EQ(test::complaint_of<UsageError>([&] { radial.query(points); }), expected);
  EXPECT_EQ(test::complaint_of<UsageError>([&] { tangential.query(points); }), expected);
  EXPECT_EQ(test::complaint_of<UsageError>([&] { tangential.occupied_arcs(points); }), expected);
  EXPECT_EQ(test::complaint_of<UsageError>([&] { radial::SortedPoints{points}; }), expected);
  EXPECT_EQ(test::complaint_of<UsageError>([&] {
              AxisFrame({1e308, 0, 0}, {0, 0, 1});
            }),
            "joint axis: its point is beyond 1e30 mm");
}

/// Beyond the range tables once gave wrong states: of 60 points 2 at 1e60 and at 1e-60.
TEST(CoordinateRange, WithinItStatesAreThoseOfBruteForceAtItsEndsToo) {
  for (const double scale : {1e-29, 1.0, 1e29}) {
    const TriMesh mesh = test::box(scale * Vec3(1, -3, -4), scale * Vec3(5, 6, 7));
    Points points;
    for (int i = 0; i < 60; ++i)
      points.push_back(scale * Vec3(7 * std::sin(i * 1.7), 9 * std::cos(i * 2.9), 8 * std::sin(i * 5.3)));
    const radial::RadialResults radial = radial::RadialTable(mesh).query(points);
    const tangential::TangentialResults tangential =
        tangential::RingTable(mesh, AxisFrame(Vec3::Zero(), Vec3::UnitZ())).query(points);
    for (std::size_t i = 0; i < points.size(); ++i) {
      const PointState state =
          test::winding_number(mesh, points[i]).winding > 0 ? PointState::inside : PointState::outside;
      EXPECT_EQ(radial.state[i], state) << scale << " " << i;
      EXPECT_EQ(tangential.state[i], state) << scale << " " << i;
    }
  }
}

TEST(CoordinateRange, AVertexAlmostAtTheCentreIsRefused) {
  for (const radial::DirectionMapKind map :
       {radial::DirectionMapKind::cube, radial::DirectionMapKind::cartesian}) {
    TriMesh mesh = test::box({-1, -1, -1}, {1, 1, 1});
    mesh.vertices.set(2, {0, 9e-37, -1e-40});
    try {
      const radial::RadialTable table(mesh, {map, {}});
      ADD_FAILURE();
    } catch (const MeshError& error) {
      EXPECT_EQ(std::string(error.what()), "the joint centre is nearer than 1e-36 mm to vertex 2");
    }
    for (const double apart : {1e-36, 0.5}) {
      mesh.vertices.set(2, {apart, 9e-37, -1e-40});
      EXPECT_NO_THROW(radial::RadialTable(mesh, {map, {}})) << apart;
    }
  }
}

/// A point may be as near the centre as doubles get: its gap is the centre's along its ray.
TEST(CoordinateRange, GapsOfPointsAlmostAtTheCentreAreThoseOfTheirDirections) {
  const radial::RadialTable table(test::box({-3, -4, -5}, {6, 7, 8}));
  for (const double size : {1e-100, 1e-200, 1e-300, 1e-310, std::numeric_limits<double>::denorm_min()}) {
    Points points;
    points.push_back({size, 0, 0});
    points.push_back({0, -size, 0});
    points.push_back({size, size, size});
    const radial::RadialResults results = table.query(points);
    EXPECT_DOUBLE_EQ(results.radial_gap_mm[0], -6) << size;
    EXPECT_DOUBLE_EQ(results.radial_gap_mm[1], -4) << size;
    EXPECT_DOUBLE_EQ(results.radial_gap_mm[2], -6 * std::sqrt(3.0)) << size;
  }
}

}  // namespace
}  // namespace condyle
