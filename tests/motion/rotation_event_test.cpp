#include "motion/events/rotation_event.hpp"

#include <rapidcheck/gtest.h>

#include <boost/multiprecision/cpp_bin_float.hpp>

#include "support/test.hpp"

namespace condyle::motion {
namespace {

using std::numbers::pi;
using Point = Triple<double>;

/// Six hundred digits. What is compared with zero here is of degree 20 in the coordinates at most, after
/// clearing the root; with coordinates of size 1 that are multiples of 2^-54 it is 0 or above 1e-330, and
/// `negligible` is between the two.
using Real =
    boost::multiprecision::number<boost::multiprecision::cpp_bin_float<600>, boost::multiprecision::et_off>;
const Real negligible("1e-400");

int side(const Real& value) {
  return value > negligible ? 1 : value < -negligible ? -1 : 0;
}

Triple<Real> real(const Point& p) {
  return {Real(p.x), Real(p.y), Real(p.z)};
}

/// A direction of the unit circle.
struct RealRotation {
  Real cosine, sine;
};

Triple<Real> turned(const Triple<Real>& p, const RealRotation& t) {
  return {p.x * t.cosine - p.y * t.sine, p.x * t.sine + p.y * t.cosine, p.z};
}

/// In [0, 2 pi), as long as the rotation is not within a rounding of 0 without being it.
double angle_of(const RealRotation& t) {
  const double angle = std::atan2(static_cast<double>(t.sine), static_cast<double>(t.cosine));
  return angle < 0 ? angle + two_pi : angle;
}

/// Directions e with (A, B) . e = -C: the foot of the line's perpendicular, and half a chord to either side.
std::vector<RealRotation> real_roots(const Real& A, const Real& B, const Real& C) {
  const Real r2 = A * A + B * B, D = r2 - C * C;
  if (side(r2) == 0 || side(D) < 0) return {};
  const Real foot = -C / r2, half_chord = side(D) == 0 ? Real(0) : Real(sqrt(D) / r2);
  std::vector<RealRotation> roots;
  roots.push_back({foot * A - half_chord * B, foot * B + half_chord * A});
  if (side(D) != 0) roots.push_back({foot * A + half_chord * B, foot * B - half_chord * A});
  return roots;
}

/// The plain reading of "a rotating point is on a triangle": solve for the plane, then look at the three
/// sides.
std::vector<RealRotation> real_vertex_face(const Point& vertex, const Corners& face) {
  const auto p = real(vertex);
  const std::array<Triple<Real>, 3> f = {real(face[0]), real(face[1]), real(face[2])};
  const auto n = cross(f[1] - f[0], f[2] - f[0]);
  std::vector<RealRotation> found;
  for (const RealRotation& t :
       real_roots(n.x * p.x + n.y * p.y, n.y * p.x - n.x * p.y, n.z * p.z - dot(n, f[0]))) {
    const auto x = turned(p, t);
    bool inside = true;
    for (std::size_t k = 0; k < 3; ++k) {
      inside = inside && side(dot(cross(f[(k + 1) % 3] - f[k], x - f[k]), n)) >= 0;
    }
    if (inside) found.push_back(t);
  }
  return found;
}

/// The plain reading of "two edges meet": solve for coplanar lines, then for both parameters; parallel lines
/// are none.
std::vector<RealRotation> real_edges(const Point& pa, const Point& pb, const Point& pc, const Point& pd) {
  const auto a = real(pa), b = real(pb), c = real(pc), d = real(pd);
  const auto w = d - c, u = b - a, m = cross(a, u), n = cross(c, w);
  std::vector<RealRotation> found;
  for (const RealRotation& t :
       real_roots(m.x * w.x + m.y * w.y + u.x * n.x + u.y * n.y,
                  m.x * w.y - m.y * w.x + u.x * n.y - u.y * n.x, m.z * w.z + u.z * n.z)) {
    const auto x = turned(a, t), ru = turned(u, t), across = cross(ru, w);
    const Real size = dot(across, across);
    if (side(size) == 0) continue;
    const Real s = dot(cross(c - x, w), across) / size, q = dot(cross(c - x, ru), across) / size;
    if (side(s) >= 0 && side(s - 1) <= 0 && side(q) >= 0 && side(q - 1) <= 0) found.push_back(t);
  }
  return found;
}

/// Same angles: as many, each within the stated error, and that error as small as promised.
void expect_same(const ContactEvents& events, const std::vector<RealRotation>& truth) {
  RC_ASSERT(static_cast<std::size_t>(events.count) == truth.size());
  std::vector<ContactEvent> found(events.begin(), events.end());
  std::sort(found.begin(), found.end(),
            [](const ContactEvent& a, const ContactEvent& b) { return a.angle < b.angle; });
  std::vector<double> angles;
  for (const RealRotation& t : truth) angles.push_back(angle_of(t));
  std::sort(angles.begin(), angles.end());
  const double rounding_of_truth = 1e-15;
  for (std::size_t i = 0; i < found.size(); ++i) {
    RC_ASSERT(found[i].error <= worst_event_error);
    RC_ASSERT(std::abs(found[i].angle - angles[i]) <= found[i].error + rounding_of_truth);
  }
}

/// Coordinates from a coarse lattice, where almost everything degenerate happens.
Point lattice_point() {
  return {double(*rc::gen::inRange(-2, 3)), double(*rc::gen::inRange(-2, 3)),
          double(*rc::gen::inRange(-1, 2))};
}
Point any_point() {
  const auto coordinate = [] { return *rc::gen::inRange(-1'000'000, 1'000'001) * 1e-4; };
  return {coordinate(), coordinate(), coordinate()};
}

TEST(VertexMeetsFace, WhereTheArctangentSays) {
  // A point at distance 2 from the axis meets the wall x = 1 at +-60 degrees: only one of the two is in the
  // triangle.
  const Corners wall = {Point{1, 0, -5}, Point{1, 9, 0}, Point{1, 0, 5}};
  const auto events = vertex_meets_face({2, 0, 0}, wall);
  ASSERT_EQ(events.count, 1);
  EXPECT_NEAR(events.event[0].angle, pi / 3, events.event[0].error);
  EXPECT_LE(events.event[0].error, 1e-13);
  const auto backwards = face_meets_vertex(wall, {2, 0, 0});
  ASSERT_EQ(backwards.count, 1);
  EXPECT_NEAR(backwards.event[0].angle, 5 * pi / 3, backwards.event[0].error);
}

TEST(VertexMeetsFace, TouchingAnEdgeOrACornerCounts) {
  const Corners wall = {Point{0, 1, -5}, Point{0, 3, -5}, Point{0, 1, 5}};
  EXPECT_EQ(vertex_meets_face({2, 0, -5}, wall).count, 1) << "on an edge";
  EXPECT_EQ(vertex_meets_face({3, 0, -5}, wall).count, 1) << "on a corner";
  EXPECT_EQ(vertex_meets_face({3, 0, std::nextafter(-5, 0)}, wall).count, 0) << "just beside";
  EXPECT_EQ(vertex_meets_face({std::nextafter(3, 4), 0, -5}, wall).count, 0) << "just beside";
}

TEST(VertexMeetsFace, GrazingAFaceIsOneEventAndMissingItByOneRoundingIsNone) {
  const Corners wall = {Point{2, -4, -5}, Point{2, 4, -5}, Point{2, 0, 5}};
  const auto events = vertex_meets_face({0, 2, 0}, wall);
  ASSERT_EQ(events.count, 1);
  EXPECT_NEAR(events.event[0].angle, 3 * pi / 2, events.event[0].error);
  EXPECT_EQ(vertex_meets_face({0, std::nextafter(2, 0), 0}, wall).count, 0);
  EXPECT_EQ(vertex_meets_face({0, std::nextafter(2, 3), 0}, wall).count, 2);
}

TEST(VertexMeetsFace, SlidingInItsPlaneOrRestingOnTheAxisReportsNothing) {
  const Corners floor = {Point{-5, -5, 1}, Point{5, -5, 1}, Point{0, 5, 1}};
  EXPECT_EQ(vertex_meets_face({1, 0, 1}, floor).count, 0);
  EXPECT_EQ(vertex_meets_face({0, 0, 1}, floor).count, 0);
  const Corners through_axis = {Point{0, -5, -5}, Point{0, 5, -5}, Point{0, 0, 5}};
  EXPECT_EQ(vertex_meets_face({0, 0, 0}, through_axis).count, 0);
}

TEST(VertexMeetsFace, ATriangleWithoutAreaReportsNothing) {
  EXPECT_EQ(vertex_meets_face({2, 0, 0}, {Point{0, 2, -1}, Point{0, 2, 1}, Point{0, 2, 0}}).count, 0);
}

TEST(VertexMeetsFace, NextToTheStartTheSideIsDecidedExactly) {
  // The wall x = 1 + e meets the point (1 + e, y, 0) on either side of y = 0, by less than one rounding of 2
  // pi.
  const double y = 1e-17;
  const Corners wall = {Point{-5, 0, -5}, Point{5, 0, -5}, Point{0, 0, 5}};
  const auto before = vertex_meets_face({1, -y, 0}, wall, AngleWindow::forward(1));
  ASSERT_EQ(before.count, 1);
  EXPECT_LT(before.event[0].angle, 1e-15);
  const auto after = vertex_meets_face({1, y, 0}, wall, AngleWindow::backward(1));
  ASSERT_EQ(after.count, 1);
  EXPECT_GT(after.event[0].angle, two_pi - 1e-15);
}

TEST(VertexMeetsFace, AtAnyScaleOfTheCoordinates) {
  for (const double scale : {0x1p-1000, 0x1p-400, 0x1p-170, 1.0, 0x1p170, 0x1p300}) {
    const Corners wall = {Point{scale, 0, -5 * scale}, Point{scale, 9 * scale, 0},
                          Point{scale, 0, 5 * scale}};
    const auto events = vertex_meets_face({2 * scale, 0, 0}, wall);
    ASSERT_EQ(events.count, 1) << scale;
    EXPECT_NEAR(events.event[0].angle, pi / 3, events.event[0].error);
    const auto edges =
        edges_meet({scale, 0, 0}, {3 * scale, 0, 0}, {0, 2 * scale, -scale}, {0, 2 * scale, scale});
    ASSERT_EQ(edges.count, 1) << scale;
    EXPECT_NEAR(edges.event[0].angle, pi / 2, edges.event[0].error);
  }
}

TEST(EdgesMeet, WhereTheArctangentSays) {
  // A radial spoke at height 0 meets an upright post at distance 2, 90 degrees on.
  const auto events = edges_meet({1, 0, 0}, {3, 0, 0}, {0, 2, -1}, {0, 2, 1});
  ASSERT_EQ(events.count, 1);
  EXPECT_NEAR(events.event[0].angle, pi / 2, events.event[0].error);
  EXPECT_EQ(edges_meet({1, 0, 0}, {3, 0, 0}, {0, 3, -1}, {0, 3, 1}).count, 1) << "at an end";
  EXPECT_EQ(edges_meet({1, 0, 0}, {3, 0, 0}, {0, 4, -1}, {0, 4, 1}).count, 0) << "past an end";
}

TEST(EdgesMeet, AlwaysInOnePlaneReportsNothing) {
  EXPECT_EQ(edges_meet({1, 0, 0}, {1, 0, 2}, {0, 1, -1}, {0, 1, 1}).count, 0) << "both parallel to the axis";
  EXPECT_EQ(edges_meet({1, 0, 1}, {2, 0, 2}, {0, 1, 1}, {0, 3, 3}).count, 0)
      << "both through one point of the axis";
  EXPECT_EQ(edges_meet({2, 1, 1}, {2, -1, -1}, {2, 1, -1}, {2, -1, 1}).count, 0)
      << "mirrored rulings of a hyperboloid";
}

TEST(EdgesMeet, ParallelAtTheRootReportsNothing) {
  // At 90 degrees both are parallel, and one is the other.
  for (const ContactEvent& e : edges_meet({2, 1, 0}, {2, -1, 1}, {-1, 2, 0}, {1, 2, 1})) {
    EXPECT_GT(std::abs(e.angle - pi / 2), 0.1);
  }
}

TEST(EdgesMeet, InOnePlaneAcrossTheAxisWhereAnEndPassesTheOtherEdge) {
  // A spoke from 1 to 3 sweeps the plane z = 0 and meets the bar x = 2 (|y| < 1) end first at atan(1/2)...
  // from below.
  const auto events = edges_meet({1, 0, 0}, {3, 0, 0}, {2, -1, 0}, {2, 1, 0});
  ASSERT_EQ(events.count, 2);
  for (const ContactEvent& e : events) EXPECT_NEAR(std::abs(std::sin(e.angle)), 1 / std::sqrt(5), 1e-14);
}

RC_GTEST_PROP(RotationEvents, OfAVertexAgreeWithSixHundredDigits, ()) {
  for (int i = 0; i < 20; ++i) {
    const Point p = any_point();
    const Corners face = {any_point(), any_point(), any_point()};
    expect_same(vertex_meets_face(p, face), real_vertex_face(p, face));
  }
}

RC_GTEST_PROP(RotationEvents, OfEdgesAgreeWithSixHundredDigits, ()) {
  for (int i = 0; i < 20; ++i) {
    const Point a = any_point(), b = any_point(), c = any_point(), d = any_point();
    expect_same(edges_meet(a, b, c, d), real_edges(a, b, c, d));
  }
}

RC_GTEST_PROP(RotationEvents, OnALatticeOfDegenerateCasesAgreeWithSixHundredDigits, ()) {
  for (int i = 0; i < 100; ++i) {
    const Point a = lattice_point(), b = lattice_point(), c = lattice_point(), d = lattice_point();
    expect_same(vertex_meets_face(a, {b, c, d}), real_vertex_face(a, {b, c, d}));
    const bool flat = a.z == b.z && b.z == c.z && c.z == d.z;
    if (!flat) expect_same(edges_meet(a, b, c, d), real_edges(a, b, c, d));
  }
}

/// Almost degenerate: where bounds have to notice that they cannot decide.
RC_GTEST_PROP(RotationEvents, AHairOffTheLatticeAgreeWithSixHundredDigits, ()) {
  const auto nudged = [](Point p) {
    for (double* x : {&p.x, &p.y, &p.z})
      *x += *rc::gen::inRange(-1, 2) * std::ldexp(1, *rc::gen::inRange(-54, -20));
    return p;
  };
  for (int i = 0; i < 30; ++i) {
    const Point a = nudged(lattice_point()), b = nudged(lattice_point());
    const Point c = nudged(lattice_point()), d = nudged(lattice_point());
    expect_same(vertex_meets_face(a, {b, c, d}), real_vertex_face(a, {b, c, d}));
    const bool flat = a.z == b.z && b.z == c.z && c.z == d.z;
    if (!flat) expect_same(edges_meet(a, b, c, d), real_edges(a, b, c, d));
  }
}

RC_GTEST_PROP(RotationEvents, TenMetresAwayAgreeWithSixHundredDigits, ()) {
  const auto away = [](Point p) { return Point{p.x + 1e4, p.y, p.z - 1e4}; };
  const Point a = away(any_point()), b = away(any_point()), c = away(any_point()), d = away(any_point());
  expect_same(vertex_meets_face(a, {b, c, d}), real_vertex_face(a, {b, c, d}));
  expect_same(edges_meet(a, b, c, d), real_edges(a, b, c, d));
}

RC_GTEST_PROP(RotationEvents, AWindowLosesNoneOfItsEvents, ()) {
  for (int i = 0; i < 100; ++i) {
    const Point a = any_point(), b = any_point(), c = any_point(), d = any_point();
    const double last = *rc::gen::inRange(0, 6283) * 1e-3;
    const auto all = vertex_meets_face(a, {b, c, d});
    const auto forward = vertex_meets_face(a, {b, c, d}, AngleWindow::forward(last));
    const auto backward = vertex_meets_face(a, {b, c, d}, AngleWindow::backward(last));
    for (const ContactEvent& e : all) {
      const auto same = [&](const ContactEvent& other) { return other.angle == e.angle; };
      if (e.angle <= last) RC_ASSERT(std::any_of(forward.begin(), forward.end(), same));
      if (e.angle >= two_pi - last) RC_ASSERT(std::any_of(backward.begin(), backward.end(), same));
    }
  }
}

}  // namespace
}  // namespace condyle::motion
