#include <iterator>

#include "condyle/contact.hpp"
#include "condyle/inspect.hpp"
#include "condyle/range_of_motion.hpp"
#include "support/brute_force.hpp"
#include "support/test.hpp"

/// Meshes as the world has them: each defect that inspect() reports, by itself and with every other one. An answer is
/// that of brute force on the very triangles, or it is refused in one line, and then the mesh is open.

namespace condyle::test {
namespace {

struct Defect {
  std::string name;
  std::function<void(TriMesh&)> make;
  std::function<bool(const MeshReport&)> is_reported;
};

void add_triangle(TriMesh& mesh, Index a, Index b, Index c) {
  mesh.triangles.push_back({a, b, c});
}

Index add_vertex(TriMesh& mesh, const Vec3& p) {
  mesh.vertices.push_back(p);
  return static_cast<Index>(mesh.vertices.size() - 1);
}

/// A tetrahedron outside on the mesh's vertex 0, sharing it.
void add_tetrahedron_at_vertex(TriMesh& mesh) {
  const Vec3 apex = mesh.vertices[0], out = (apex - Vec3(0, -20, 4)).normalized();
  const Vec3 side = out.unitOrthogonal(), other = out.cross(side);
  const Index a = add_vertex(mesh, apex + 2 * out + side), b = add_vertex(mesh, apex + 2 * out + other),
              c = add_vertex(mesh, apex + 2 * out - side - other);
  add_triangle(mesh, 0, b, a), add_triangle(mesh, 0, c, b), add_triangle(mesh, 0, a, c),
      add_triangle(mesh, a, b, c);
}

/// An edge is split at a copy of its start on one side, and the gap closed: two triangles without area.
void split_with_sliver(TriMesh& mesh) {
  const auto [a, b, c] = mesh.triangles[11];
  const Index copy = add_vertex(mesh, mesh.vertices[a]);
  mesh.triangles[11] = {a, copy, c};
  add_triangle(mesh, copy, b, c);
  add_triangle(mesh, a, b, copy);
}

const std::vector<Defect>& defects() {
  static const std::vector<Defect> all = {
      {"hole", [](TriMesh& m) { m.triangles.erase(m.triangles.begin() + 40); },
       [](const MeshReport& r) { return r.boundary_edges.count > 0; }},
      {"flipped_triangle", [](TriMesh& m) { std::swap(m.triangles[50][0], m.triangles[50][1]); },
       [](const MeshReport& r) { return r.inconsistent_edges.count > 0; }},
      {"duplicate_triangle", [](TriMesh& m) { m.triangles.push_back(m.triangles[7]); },
       [](const MeshReport& r) { return r.duplicate_triangles.count > 0; }},
      {"triangle_there_and_back",
       [](TriMesh& m) {
         const auto [a, b, c] = m.triangles[20];
         add_triangle(m, a, b, c), add_triangle(m, a, c, b);
       },
       [](const MeshReport& r) { return r.non_manifold_edges.count > 0; }},
      {"vertex_twice_in_a_triangle", [](TriMesh& m) { add_triangle(m, 3, 3, 4); },
       [](const MeshReport& r) { return r.degenerate_triangles.count > 0; }},
      {"triangle_without_area", split_with_sliver,
       [](const MeshReport& r) { return r.degenerate_triangles.count == 2; }},
      {"unreferenced_vertex",
       [](TriMesh& m) {
         add_vertex(m, {100, 0, 0});
       },
       [](const MeshReport& r) { return r.unreferenced_vertices.count > 0; }},
      {"duplicate_vertices",
       [](TriMesh& m) {
         for (Index& v : m.triangles[3]) v = add_vertex(m, m.vertices[v]);
       },
       [](const MeshReport& r) { return r.duplicate_vertices.count > 0; }},
      {"non_manifold_vertex", add_tetrahedron_at_vertex,
       [](const MeshReport& r) { return r.non_manifold_vertices.count > 0; }},
      {"inverted", [](TriMesh& m) { m = flipped(std::move(m)); },
       [](const MeshReport& r) { return r.inverted_components.count + r.unbalanced_edges.count > 0; }},
      {"second_component_inside",
       [](TriMesh& m) {
         m = joined(m, sphere({0, -20, 4}, 3, 1));
       },
       [](const MeshReport& r) { return r.components.size() > 1; }},
      {"self_crossing",
       [](TriMesh& m) {
         m = joined(m, sphere({3, -15, 4}, 9, 1));
       },
       [](const MeshReport& r) { return r.self_crossings.count > 0; }},
  };
  return all;
}

TriMesh fixed_body() {
  return sphere({0, -20, 4}, 10, 2);
}
/// An dirty_arm from the joint centre that hangs beside the ball and swings into it.
TriMesh dirty_arm() {
  return box({-24, -30, -1}, {-20, -2, 9});
}

Pose turned(double degrees) {
  Pose X = Pose::Identity();
  const double t = degrees * 3.14159265358979323846 / 180, c = std::cos(t), s = std::sin(t);
  X.matrix() << c, -s, 0, 0, s, c, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1;
  return X;
}

using Pairs = std::vector<std::pair<Index, Index>>;

/// Elements of one of the two that are not in the other.
Pairs differing(const Pairs& a, const Pairs& b) {
  Pairs either;
  std::set_symmetric_difference(a.begin(), a.end(), b.begin(), b.end(), std::back_inserter(either));
  return either;
}

void expect_one_line(const std::string& what) {
  EXPECT_FALSE(what.empty());
  EXPECT_EQ(what.find('\n'), what.npos) << what;
}

Pairs found_pairs(const contact::JointContact& joint, const Pose& X_FM) {
  Pairs pairs;
  for (const contact::TrianglePair& pair : joint.pairs(X_FM)) pairs.emplace_back(pair.fixed, pair.mobile);
  std::sort(pairs.begin(), pairs.end());
  return pairs;
}

/// Every vertex of the dirty_arm against exact winding numbers; says whether there was an answer.
bool expect_right_states(const contact::JointContact& joint, const TriMesh& fixed, const TriMesh& mobile,
                         const Pose& X_FM) {
  std::optional<radial::RadialResults> found;
  try {
    found = joint.radial(X_FM).mobile_in_fixed;
  } catch (const MeshError& error) {
    expect_one_line(error.what());
    EXPECT_NE(std::string(error.what()).find("centre"), std::string::npos) << error.what();
    return false;
  }
  if (!found) return false;
  for (std::size_t v = 0; v < mobile.vertices.size(); ++v) {
    const BruteWinding exact = test::winding_number(fixed, mobile.vertices[v]);
    const PointState state = exact.on_surface    ? PointState::on_surface
                             : exact.winding > 0 ? PointState::inside
                                                 : PointState::outside;
    EXPECT_EQ(found->state[v], state) << "vertex " << v;
    if (!exact.on_surface) {
      EXPECT_EQ(found->winding[v], exact.winding) << "vertex " << v;
    }
  }
  return true;
}

/// Where the dirty_arm stops by contact it is free before and in contact past the bound.
void expect_right_limit(const Mesh& fixed, const TriMesh& mobile) {
  const motion::RangeOfMotion range(
      {"dirty", JointKind::ball, Side::right, {"ball", fixed}, {"arm", Mesh(mobile)}},
      {.bearing = {.rule = motion::BearingRule::count}});
  const motion::Limit limit =
      range.both_limits(JointAngle::flexion, {}, {Angle(), Angle::degrees(90)}).positive;
  ASSERT_EQ(limit.reason, motion::LimitReason::contact);
  const auto meets = [&](double degrees) {
    return !intersecting_pairs(fixed.arrays(), posed(turned(degrees), mobile)).empty();
  };
  const double at = limit.turned.degrees();
  for (const double share : {0.3, 0.9, 0.999}) EXPECT_FALSE(meets(share * at)) << share * at;
  EXPECT_TRUE(meets(at + limit.error_bound.degrees() + 1e-3)) << at;
}

void check(const TriMesh& dirty, const std::vector<const Defect*>& made) {
  const Mesh fixed(dirty);
  const MeshReport report = inspect(fixed);
  if (made.size() == 1) {
    EXPECT_TRUE(made[0]->is_reported(report));
  }
  const TriMesh mobile = dirty_arm();
  const contact::JointContact joint(fixed, Mesh(mobile)), exchanged(Mesh(mobile), fixed);
  for (const double degrees : {30.0, 45.0, 60.0}) {
    const Pose X_FM = turned(degrees);
    const TriMesh there = posed(X_FM, mobile);
    EXPECT_EQ(differing(found_pairs(joint, X_FM), intersecting_pairs(dirty, there)), Pairs());
    EXPECT_EQ(differing(found_pairs(exchanged, X_FM), intersecting_pairs(mobile, posed(X_FM, dirty))),
              Pairs());
    const bool answered = expect_right_states(joint, dirty, there, X_FM);
    EXPECT_EQ(answered, report.is_closed());
  }
  if (!report.is_closed()) {
    radial::Penetrations out;
    try {
      joint.mobile_in_fixed(turned(45), out);
      ADD_FAILURE() << "an open mesh has no inside";
    } catch (const MeshError& error) {
      expect_one_line(error.what());
    }
  }
  expect_right_limit(fixed, mobile);
}

TEST(DirtyMeshes, ACleanBallIsRight) {
  check(fixed_body(), {});
}

TEST(DirtyMeshes, WithOneDefectAreRightOrRefused) {
  for (const Defect& defect : defects()) {
    SCOPED_TRACE(defect.name);
    TriMesh mesh = fixed_body();
    defect.make(mesh);
    check(mesh, {&defect});
  }
}

TEST(DirtyMeshes, WithTwoDefectsAreRightOrRefused) {
  for (const Defect& first : defects())
    for (const Defect& second : defects()) {
      SCOPED_TRACE(first.name + ", then " + second.name);
      TriMesh mesh = fixed_body();
      first.make(mesh);
      second.make(mesh);
      check(mesh, {&first, &second});
    }
}

TEST(DirtyMeshes, ThatAreNoMeshAreRefusedNamingTheElement) {
  const auto expect_refused = [](TriMesh mesh, const std::string& naming) {
    try {
      const Mesh made(std::move(mesh));
      ADD_FAILURE() << naming;
    } catch (const MeshError& error) {
      expect_one_line(error.what());
      EXPECT_NE(std::string(error.what()).find(naming), std::string::npos) << error.what();
    }
  };
  TriMesh mesh = fixed_body();
  mesh.triangles[5][1] = 4000;
  expect_refused(mesh, "triangle 5");
  mesh = fixed_body();
  mesh.vertices.y[9] = std::nan("");
  expect_refused(mesh, "vertex 9");
  mesh = fixed_body();
  mesh.vertices.z[2] = INFINITY;
  expect_refused(mesh, "vertex 2");
}

}  // namespace
}  // namespace condyle::test
