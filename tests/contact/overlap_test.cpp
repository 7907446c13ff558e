#include "contact/overlap.hpp"

#include "condyle/contact_measures.hpp"
#include "condyle/joint_coordinates.hpp"
#include "mesh/winding_number.hpp"
#include "support/real_hip.hpp"
#include "support/test.hpp"

/// Volumes and areas of overlaps, thin ones above all, against closed forms, against values that exact integration gave in another
/// program, along two directions that agreed to 1e-12, and against columns and subdivision here.

namespace condyle::test {
namespace {

contact::ContactMeasures measured_overlap(const TriMesh& fixed, const TriMesh& mobile,
                                          const Pose& X_FM = Pose::Identity()) {
  const contact::JointContact joint(fixed, mobile);
  return contact::measure_contact(joint, X_FM, contact::MeasuredContact(joint.radial(X_FM)),
                                  contact::DistancesOf::vertices_inside);
}

TriMesh moved(const Pose& X, const TriMesh& mesh) {
  return posed(X, mesh);
}

Pose translation(const Vec3& by) {
  Pose X = Pose::Identity();
  X.translation() = by;
  return X;
}

Pose rotation(double degrees, const Vec3& about) {
  Pose X = Pose::Identity();
  X.linear() = Eigen::AngleAxisd(degrees * std::numbers::pi / 180, about.normalized()).toRotationMatrix();
  return X;
}

/// The joint centre must lie on no surface: both bodies move by this.
const Pose off_centre = translation({-5.13, -4.71, -3.37});

/// Corners (+-1, +-phi, 0) and their cyclic exchanges, each triangle in four, corners on the sphere.
TriMesh icosphere(int levels, double radius, const Vec3& centre = Vec3::Zero()) {
  const double phi = (1 + std::sqrt(5.0)) / 2;
  std::vector<Vec3> p;
  for (const double a : {-1.0, 1.0})
    for (const double b : {-phi, phi}) p.insert(p.end(), {{a, b, 0}, {0, a, b}, {b, 0, a}});
  std::vector<Triangle> triangles;
  for (Index i = 0; i < p.size(); ++i)
    for (Index j = i + 1; j < p.size(); ++j)
      for (Index k = j + 1; k < p.size(); ++k) {
        const auto is_edge = [&](Index a, Index b) { return std::abs((p[a] - p[b]).norm() - 2) < 1e-9; };
        if (!is_edge(i, j) || !is_edge(j, k) || !is_edge(k, i)) continue;
        const bool outward = (p[j] - p[i]).cross(p[k] - p[i]).dot(p[i]) > 0;
        triangles.push_back(outward ? Triangle{i, j, k} : Triangle{i, k, j});
      }
  for (int level = 0; level < levels; ++level) {
    std::map<std::pair<Index, Index>, Index> middle;
    std::vector<Triangle> finer;
    const auto middle_of = [&](Index a, Index b) {
      const auto [at, is_new] = middle.try_emplace(std::minmax(a, b), static_cast<Index>(p.size()));
      if (is_new) p.push_back(((p[a].normalized() + p[b].normalized()) / 2));
      return at->second;
    };
    for (const auto& [a, b, c] : triangles) {
      const Index ab = middle_of(a, b), bc = middle_of(b, c), ca = middle_of(c, a);
      finer.insert(finer.end(), {{a, ab, ca}, {ab, b, bc}, {ca, bc, c}, {ab, bc, ca}});
    }
    triangles = std::move(finer);
  }
  TriMesh mesh;
  for (const Vec3& q : p) mesh.vertices.push_back(radius * q.normalized() + centre);
  mesh.triangles = std::move(triangles);
  return mesh;
}

TriMesh shell(int levels, double inner, double outer, const Vec3& centre = Vec3::Zero()) {
  return joined(icosphere(levels, outer, centre), flipped(icosphere(levels, inner, centre)));
}

/// Length of each line along `axis` through a grid that is inside both bodies, winding numbers above 0, times the area that it
/// stands for.
double volume_by_columns(const TriMesh& a, const TriMesh& b, int axis, int across) {
  const int u = (axis + 1) % 3, v = (axis + 2) % 3;
  // A box that only the smaller body's bounds can hold.
  Vec3 low = Vec3::Constant(-1e300), high = Vec3::Constant(1e300);
  for (const TriMesh* mesh : {&a, &b}) {
    Vec3 l = Vec3::Constant(1e300), h = -l;
    for (std::size_t i = 0; i < mesh->vertices.size(); ++i)
      l = l.cwiseMin(mesh->vertices[i]), h = h.cwiseMax(mesh->vertices[i]);
    low = low.cwiseMax(l), high = high.cwiseMin(h);
  }
  const double du = (high[u] - low[u]) / across, dv = (high[v] - low[v]) / across;
  struct Crossing {
    double at;
    std::array<int, 2> step;
  };
  std::vector<std::vector<Crossing>> lines(static_cast<std::size_t>(across) *
                                           static_cast<std::size_t>(across));
  const auto add = [&](const TriMesh& mesh, std::size_t body) {
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
      const Vec3 p = mesh.corner(t, 0), q = mesh.corner(t, 1), r = mesh.corner(t, 2);
      const auto cross = [&](const Vec3& s, const Vec3& e, double x, double y) {
        return (e[u] - s[u]) * (y - s[v]) - (e[v] - s[v]) * (x - s[u]);
      };
      const double area = cross(p, q, r[u], r[v]);
      if (area == 0) continue;
      const auto cell = [&](double at, double from, double width) {
        return std::clamp(static_cast<int>(std::floor((at - from) / width)), 0, across - 1);
      };
      const auto [least_u, most_u] = std::minmax({p[u], q[u], r[u]});
      const auto [least_v, most_v] = std::minmax({p[v], q[v], r[v]});
      for (int i = cell(least_u, low[u], du); i <= cell(most_u, low[u], du); ++i)
        for (int j = cell(least_v, low[v], dv); j <= cell(most_v, low[v], dv); ++j) {
          const double x = low[u] + (i + 0.5) * du, y = low[v] + (j + 0.5) * dv;
          const double of_r = cross(p, q, x, y) / area, of_p = cross(q, r, x, y) / area,
                       of_q = cross(r, p, x, y) / area;
          if (of_p < 0 || of_q < 0 || of_r < 0) continue;
          Crossing crossing{of_p * p[axis] + of_q * q[axis] + of_r * r[axis], {0, 0}};
          crossing.step[body] = area > 0 ? -1 : 1;
          lines[static_cast<std::size_t>(i * across + j)].push_back(crossing);
        }
    }
  };
  add(a, 0), add(b, 1);
  double length = 0;
  for (auto& line : lines) {
    std::sort(line.begin(), line.end(), [](const Crossing& l, const Crossing& r) { return l.at < r.at; });
    std::array<int, 2> winding{};
    for (std::size_t i = 0; i < line.size(); ++i) {
      if (i > 0 && winding[0] > 0 && winding[1] > 0) length += line[i].at - line[i - 1].at;
      winding[0] += line[i].step[0], winding[1] += line[i].step[1];
    }
  }
  return length * du * dv;
}

/// A third of the sum of area times n . (p - o) over both patches: the divergence theorem. It needs both patches to end at one line,
/// to the last bit nearly.
double volume_by_patches(const TriMesh& fixed, const TriMesh& mobile, const contact::Overlap& overlap) {
  double sum = 0, weight = 0;
  Vec3 o = Vec3::Zero();
  for (const auto* patch : {&overlap.fixed, &overlap.mobile})
    for (const contact::PatchPart& part : *patch) o += part.area * part.centroid, weight += part.area;
  if (weight == 0) return 0;
  o /= weight;
  const auto add = [&](const TriMesh& mesh, const std::vector<contact::PatchPart>& patch) {
    for (const contact::PatchPart& part : patch) {
      const Vec3 a = mesh.corner(part.triangle, 0);
      const Vec3 n =
          (mesh.corner(part.triangle, 1) - a).cross(mesh.corner(part.triangle, 2) - a).normalized();
      sum += part.area * n.dot(a - o);
    }
  };
  add(fixed, overlap.fixed), add(mobile, overlap.mobile);
  return sum / 3;
}

contact::Overlap overlap_at(const TriMesh& fixed, const TriMesh& mobile, const Pose& X_FM) {
  const contact::JointContact joint(fixed, mobile);
  const contact::RadialContact contact = joint.radial(X_FM);
  const TriMesh mobile_in_F = posed(X_FM, mobile);
  return contact::overlap_of({fixed, contact.fixed_in_mobile->state},
                             {mobile_in_F, contact.mobile_in_fixed->state}, contact.pairs);
}

struct Case {
  const char* name;
  TriMesh fixed, mobile;
  double volume;
};

std::vector<Case> exact_cases() {
  const TriMesh ten = moved(off_centre, box({0, 0, 0}, {10, 10, 10}));
  const auto off = [](const TriMesh& mesh) { return moved(off_centre, mesh); };
  const Vec3 away(0.3, -0.2, 0.4);
  const Vec3 along = 30 * Vec3(.48, .6, .64), far = 39.9 * Vec3(.48, .6, .64);
  const auto turned = [](const TriMesh& mesh) { return moved(rotation(25, {3, 1, 2}), mesh); };
  return {
      {"a corner", ten, off(box({8, 7, 6}, {18, 17, 16})), 24},
      {"one inside", ten, off(box({2, 3, 4}, {5, 7, 9})), 60},
      {"a slab", ten, off(box({0, 0, 9.99}, {10, 10, 20})), 1},
      {"itself", ten, ten, 1000},
      {"a face", ten, off(box({0, 0, 10}, {10, 10, 20})), 0},
      {"a turned box", ten, off(moved(rotation(40, {1, 1, 1}), box({-5, -5, -5}, {5, 5, 5}))), 134.415265714},
      {"balls of 320", icosphere(2, 25), icosphere(2, 24, along), 11291.0232109},
      {"balls of 1280", icosphere(3, 25), icosphere(3, 24, along), 11883.5609056},
      {"balls of 5120", icosphere(4, 25), icosphere(4, 24, along), 12036.3899519},
      {"balls apart", icosphere(2, 20), icosphere(2, 20, far), 0},
      {"balls that graze", icosphere(4, 20), icosphere(4, 20, far), 0.1388743717},
      {"shells of 1280 by 0.01", shell(3, 20, 25), shell(3, 15, 20.01), 49.8578104028},
      {"shells of 1280 by 0.1", shell(3, 20, 25), shell(3, 15, 20.1), 500.8246952822},
      {"shells of 1280 by 1", shell(3, 20, 25), shell(3, 15, 21), 5236.6061703544},
      {"shells of 320 by 0.01", shell(2, 20, 25), shell(2, 15, 20.01), 48.5888224749},
      {"shells of 320 by 0.1", shell(2, 20, 25), shell(2, 15, 20.1), 488.0776354501},
      {"shells of 320 by 1", shell(2, 20, 25), shell(2, 15, 21), 5103.3233414533},
      {"shells moved a little", shell(3, 20, 25), shell(3, 17, 20, {.05, .02, -.03}), 77.0864345054},
      {"shells moved", shell(3, 20, 25), shell(3, 17, 20, {.3, .4, .2}), 673.3144089676},
      {"shells of 320 turned", shell(2, 20, 25), turned(shell(2, 15, 20.01)), 203.1808830161},
      {"shells of 1280 turned", shell(3, 20, 25), turned(shell(3, 15, 20.01)), 73.6416454675},
  };
}

/// The references have ten decimals, or nine.
TEST(Overlap, HasTheVolumeOfClosedFormsAndOfExactIntegration) {
  for (const Case& c : exact_cases()) {
    const contact::ContactMeasures found = measured_overlap(c.fixed, c.mobile);
    ASSERT_TRUE(found.volume_mm3) << c.name;
    const double digits = std::max(5e-11, 5e-8 * (c.volume > 1000) + 5e-10 * (c.volume > 100));
    EXPECT_NEAR(*found.volume_mm3, c.volume, found.volume_error_mm3 + digits) << c.name;
    EXPECT_LT(found.volume_error_mm3, 1e-5) << c.name;
    EXPECT_EQ(found.mobile_covered_again_mm3, 0) << c.name;
    EXPECT_EQ(found.fixed_covered_again_mm3, 0) << c.name;
  }
}

TEST(Overlap, OfAThinSlabBetweenPlanesIsItsThicknessTimesItsArea) {
  const TriMesh below = moved(off_centre, box({0, 0, 0}, {10, 10, 10}));
  for (const double thickness : {1.0, 1e-3, 1e-6, 1e-9, 1e-12}) {
    const TriMesh above = moved(off_centre, box({2, 3, 10 - thickness}, {7, 7, 20}));
    const double exact = 20 * (below.vertices[7].z() - above.vertices[0].z());
    const contact::ContactMeasures found = measured_overlap(below, above);
    EXPECT_NEAR(*found.volume_mm3, exact, found.volume_error_mm3) << thickness;
    // Walls of the thin part are counted too.
    const double mobile = 20 + 18 * thickness;
    EXPECT_NEAR(found.fixed->area_mm2, 20, 1e-8) << thickness;
    EXPECT_NEAR(found.mobile->area_mm2, mobile, 1e-8) << thickness;
  }
}

/// Far from the origin the coordinates themselves are rounded; what comes after keeps to its bound.
TEST(Overlap, KeepsToItsBoundFarFromTheOrigin) {
  for (const double far : {0.0, 1e3, 1e6}) {
    const Pose X = translation({far, -far / 2, far / 4});
    const TriMesh fixed = moved(X, box({1, 1, 1}, {11, 11, 11})),
                  mobile = moved(X, box({9, 8, 7}, {19, 18, 17}));
    const contact::ContactMeasures found = measured_overlap(fixed, mobile);
    EXPECT_NEAR(*found.volume_mm3, 24, found.volume_error_mm3) << far;
    EXPECT_LT(found.volume_error_mm3, 1e-8) << far;
  }
}

TEST(Overlap, IsBoundedByThePatchesOfBothBodies) {
  for (const Case& c : exact_cases()) {
    const contact::Overlap overlap = overlap_at(c.fixed, c.mobile, Pose::Identity());
    // Faces that both bodies have are in both patches; those that two bodies have back to back, by a translation along a triangle,
    // in either or none.
    const std::string_view name = c.name;
    if (name == "itself" || name == "a slab" || name == "shells moved a little") continue;
    EXPECT_NEAR(volume_by_patches(c.fixed, c.mobile, overlap), c.volume, 1e-9 * (1 + c.volume)) << c.name;
  }
}

TEST(Overlap, OfSurfacesThatCoincideBelongsToTheBodiesThatHaveItWithin) {
  const TriMesh ten = moved(off_centre, box({0, 0, 0}, {10, 10, 10}));
  const contact::ContactMeasures itself = measured_overlap(ten, ten);
  EXPECT_NEAR(itself.fixed->area_mm2, 600, 1e-9);
  EXPECT_NEAR(itself.mobile->area_mm2, 600, 1e-9);
  const contact::ContactMeasures on_it =
      measured_overlap(ten, moved(off_centre, box({2, 2, 10}, {5, 5, 20})));
  EXPECT_NEAR(*on_it.volume_mm3, 0, on_it.volume_error_mm3);
  EXPECT_EQ(on_it.fixed->area_mm2, 0);
  EXPECT_EQ(on_it.mobile->area_mm2, 0);
  // Three faces in common with a box inside it.
  const contact::ContactMeasures within = measured_overlap(ten, moved(off_centre, box({0, 0, 0}, {4, 5, 6})));
  EXPECT_NEAR(*within.volume_mm3, 120, within.volume_error_mm3);
  EXPECT_NEAR(within.mobile->area_mm2, 148, 1e-9);
  EXPECT_NEAR(within.fixed->area_mm2, 74, 1e-9);
}

/// Turned, coordinates round, and faces coincide to rounding only: areas there are anybody's guess, the volume is not.
TEST(Overlap, HasTheSameVolumeHoweverBothBodiesAreTurned) {
  const TriMesh ten = moved(off_centre, box({0, 0, 0}, {10, 10, 10}));
  for (const double degrees : {33.0, 71.0, 152.0}) {
    const Pose X = rotation(degrees, {1, 2, -3});
    // The turn's own rounding: some 1e-15 of 10 mm, on 600 mm^2.
    const double turned = 1e-11;
    const auto volume = [&](const TriMesh& mobile) {
      const contact::ContactMeasures found =
          measured_overlap(moved(X, ten), moved(X, moved(off_centre, mobile)));
      EXPECT_LT(found.volume_error_mm3, 1e-8);
      return *found.volume_mm3;
    };
    EXPECT_NEAR(volume(box({0, 0, 0}, {10, 10, 10})), 1000, turned);
    EXPECT_NEAR(volume(box({2, 2, 10}, {5, 5, 20})), 0, turned);
    EXPECT_NEAR(volume(box({0, 0, 0}, {4, 5, 6})), 120, turned);
    EXPECT_NEAR(volume(box({8, 7, 6}, {18, 17, 16})), 24, turned);
  }
}

TEST(Overlap, WithABodyThatCoversSpaceTwiceSaysSo) {
  const TriMesh ten = moved(off_centre, box({0, 0, 0}, {10, 10, 10}));
  // Two components that share 2 x 8 x 8, of which 2 x 4 x 8 lie in the fixed body.
  const TriMesh twice = moved(off_centre, joined(box({1, 6, 1}, {5, 14, 9}), box({3, 6, 1}, {8, 14, 9})));
  const contact::ContactMeasures found = measured_overlap(ten, twice);
  const double both = (4 + 5) * 4 * 8;
  EXPECT_NEAR(*found.volume_mm3, both, found.volume_error_mm3);
  EXPECT_NEAR(found.mobile_covered_again_mm3, 2 * 4 * 8, 1e-9);
  EXPECT_EQ(found.fixed_covered_again_mm3, 0);
  // One component inside another, no surfaces that meet.
  const TriMesh nested = moved(off_centre, joined(box({-5, -5, -5}, {5, 5, 5}), box({1, 1, 1}, {4, 4, 4})));
  const contact::ContactMeasures in_nested = measured_overlap(ten, nested);
  EXPECT_NEAR(*in_nested.volume_mm3, 125 + 27, in_nested.volume_error_mm3);
  EXPECT_NEAR(in_nested.mobile_covered_again_mm3, 27, 1e-9);
  // Boxes of 2 mm that are shifted by s share 2 - s by 2 by 2; all of it, half of it or none is in the other body.
  for (const double s : {0.25, 1.0, 1.9})
    for (const auto& [high, share] : {std::pair(12.0, 1.0), {5.0, 0.5}, {4.0, 0.0}}) {
      const TriMesh two = joined(box({4, 4, 4}, {6, 6, 6}), box({4 + s, 4, 4}, {6 + s, 6, 6}));
      const contact::ContactMeasures in_third = measured_overlap(
          moved(off_centre, two), moved(off_centre, box({0.5, 0.5, 0.5}, {12.5, high, 12.25})));
      EXPECT_NEAR(in_third.fixed_covered_again_mm3, share * 4 * (2 - s), 1e-9) << s << ' ' << high;
      EXPECT_EQ(in_third.mobile_covered_again_mm3, 0);
    }
  // Twice each triangle and thrice: as often again.
  const TriMesh ball = moved(off_centre, icosphere(2, 3, {9, 4, 4}));
  const contact::ContactMeasures single = measured_overlap(ten, ball);
  const double once = *single.volume_mm3;
  TriMesh many = ball;
  for (int times = 2; times <= 3; ++times) {
    TriMesh copy = ball;
    for (Triangle& corners : copy.triangles) corners = {corners[1], corners[2], corners[0]};
    many = joined(many, copy);
    const contact::ContactMeasures again = measured_overlap(ten, many);
    EXPECT_NEAR(*again.volume_mm3, times * once, 2 * again.volume_error_mm3) << times;
    EXPECT_NEAR(again.mobile_covered_again_mm3, (times - 1) * once, 1e-9) << times;
    EXPECT_NEAR(again.mobile->area_mm2, times * single.mobile->area_mm2, 1e-9) << times;
  }
  // One of the three turned over leaves one of them.
  const std::size_t n = ball.triangles.size();
  for (std::size_t t = n; t < 2 * n; ++t) std::swap(many.triangles[t][0], many.triangles[t][1]);
  const contact::ContactMeasures one = measured_overlap(ten, many);
  EXPECT_NEAR(*one.volume_mm3, once, 2 * one.volume_error_mm3);
  EXPECT_EQ(one.mobile_covered_again_mm3, 0);
  EXPECT_NEAR(one.fixed->area_mm2, single.fixed->area_mm2, 1e-9);
}

/// The part of a ball below a plane, triangle by triangle, and the section of the ball there.
struct Cap {
  double area = 0, section = 0;
};

Cap cap_below(const TriMesh& ball, double z) {
  Cap cap;
  for (std::size_t t = 0; t < ball.triangles.size(); ++t) {
    std::vector<Vec3> part;
    Vec3 up = Vec3::Zero(),
         down = Vec3::Zero();  // where the border passes the plane; the same for a triangle that does not

    for (int k = 0; k < 3; ++k) {
      const Vec3 a = ball.corner(t, k), b = ball.corner(t, (k + 1) % 3);
      if (a.z() < z) part.push_back(a);
      if ((a.z() < z) == (b.z() < z)) continue;
      const Vec3 at = a + (z - a.z()) / (b.z() - a.z()) * (b - a);
      part.push_back(at);
      (a.z() < z ? up : down) = at;
    }
    for (std::size_t k = 2; k < part.size(); ++k)
      cap.area += (part[k - 1] - part[0]).cross(part[k] - part[0]).norm() / 2;
    cap.section += (up.x() * down.y() - up.y() * down.x()) / 2;
  }
  cap.section = std::abs(cap.section);
  return cap;
}

/// Contacts of 100, 10 and 0.7 mm^2 of a ball with triangles of 7 mm^2 on a plate with two triangles.
TEST(Overlap, OfABallOnAPlateHasTheAreasOfTheBallsSection) {
  const TriMesh ball = moved(rotation(17, {1, 3, 2}), icosphere(3, 25));
  double lowest = 0;
  for (std::size_t v = 0; v < ball.vertices.size(); ++v) lowest = std::min(lowest, ball.vertices[v].z());
  const std::array<double, 3> depths{0.6, 0.075, 0.012}, sections{93, 12.5, 0.7};
  for (std::size_t i = 0; i < depths.size(); ++i) {
    const double depth = depths[i];
    const TriMesh plate = box({-60, -55, -40}, {57, 61, lowest + depth});
    const Cap cap = cap_below(ball, lowest + depth);
    const contact::ContactMeasures found = measured_overlap(plate, ball);
    EXPECT_NEAR(found.fixed->area_mm2, cap.section, 1e-9) << depth;
    EXPECT_NEAR(found.mobile->area_mm2, cap.area, 1e-9) << depth;
    EXPECT_GT(*found.fixed->mean_depth_mm, 0) << depth;
    EXPECT_LT(*found.mobile->mean_depth_mm, depth) << depth;
    EXPECT_GT(cap.section, sections[i] / 1.5) << depth;
    EXPECT_LT(cap.section, sections[i] * 1.5) << depth;
  }
}

/// Values of an exact integration in another program, and areas by a count.
TEST(Overlap, OfARealHipIsWhatExactIntegrationGives) {
  FOUND_OR_SKIP(hip, hip_vhf_right());
  const contact::JointContact joint(*hip);
  const auto at = [&](double flexion, double adduction, double internal_rotation) {
    return pose_at({.side = Side::right},
                   {Angle::degrees(flexion), Angle::degrees(adduction), Angle::degrees(internal_rotation)});
  };
  const std::vector<std::pair<Pose, double>> cases{{at(110, 15, 35), 832.025917092},
                                                   {at(90, 0, 40), 78.071636459}};
  for (const auto& [X_FM, volume] : cases) {
    const contact::RadialContact contact = joint.radial(X_FM);
    const contact::ContactMeasures found = contact::measure_contact(
        joint, X_FM, contact::MeasuredContact(contact), contact::DistancesOf::vertices_inside);
    EXPECT_NEAR(*found.volume_mm3, volume, 1e-9 + found.volume_error_mm3);
    EXPECT_LT(found.volume_error_mm3, 1e-6);
    const TriMesh femur = posed(X_FM, hip->mobile.mesh);
    EXPECT_NEAR(volume_by_columns(hip->fixed.mesh, femur, 1, 600), volume, 0.01 * volume);
    EXPECT_NEAR(
        volume_by_patches(hip->fixed.mesh, femur, overlap_at(hip->fixed.mesh, hip->mobile.mesh, X_FM)),
        volume, 1e-8);
    // Each triangle in a pair in 1024 parts, and each part by its centre.
    const mesh::WindingNumber in_hip_bone(hip->fixed.mesh);
    double area = 0;
    for (std::size_t t = 0; t < femur.triangles.size(); ++t) {
      const Vec3 a = femur.corner(t, 0), u = (femur.corner(t, 1) - a) / 32, v = (femur.corner(t, 2) - a) / 32;
      if (contact.mobile_in_fixed->state[femur.triangles[t][0]] == PointState::outside &&
          std::none_of(contact.pairs.begin(), contact.pairs.end(),
                       [&](const contact::TrianglePair& pair) { return pair.mobile == t; }))
        continue;
      const double part = u.cross(v).norm() / 2;
      for (int i = 0; i < 32; ++i)
        for (int j = 0; i + j < 32; ++j) {
          const auto inside = [&](double du, double dv) {
            return in_hip_bone.at(a + (i + du) * u + (j + dv) * v).winding > 0;
          };
          area += part * inside(1 / 3.0, 1 / 3.0);
          if (i + j < 31) area += part * inside(2 / 3.0, 2 / 3.0);
        }
    }
    EXPECT_NEAR(found.mobile->area_mm2, area, 0.002 * area);
  }
}

/// Cartilages of a left hip that were made to touch: a thin overlap over large sheets.
TEST(Overlap, OfTouchingCartilagesIsWhatColumnsGive) {
  FOUND_OR_SKIP(data, shared_data());
  const TriMesh fixed = read_ply(*data / "hip_libhip_m1_left/acetabular_cartilage_nogap.ply"),
                mobile = read_ply(*data / "hip_libhip_m1_left/femur_cartilage_nogap.ply");
  for (const auto& [up, about] :
       {std::pair(0.0, 0.4), std::pair(0.01, 2.0), std::pair(0.1, 89.0), std::pair(0.5, 641.0)}) {
    const Pose X_FM = translation({0, up, 0});
    const contact::Overlap overlap = overlap_at(fixed, mobile, X_FM);
    const TriMesh placed = posed(X_FM, mobile);
    // Columns some 0.1 mm apart: 3 % where the overlap is a few spots of a millimetre, by the square root of their number less where it
    // is wide.
    const double columns = volume_by_columns(fixed, placed, 1, 500);
    EXPECT_NEAR(overlap.volume, columns, (up < 0.05 ? 0.05 : 0.005) * columns) << up;
    EXPECT_NEAR(overlap.volume, volume_by_patches(fixed, placed, overlap), 1e-7) << up;
    EXPECT_NEAR(overlap.volume, about, 0.1 * about + 0.1) << up;
    EXPECT_LT(overlap.volume_error, 1e-5) << up;
  }
}

}  // namespace
}  // namespace condyle::test
