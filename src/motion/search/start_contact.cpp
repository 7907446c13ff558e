#include "motion/search/start_contact.hpp"

#include <algorithm>
#include <limits>
#include <vector>

#include "mesh/triangle_intersection.hpp"
#include "motion/search/node_pairs.hpp"

namespace condyle::motion {
namespace {

/// How far p is from the triangle, in mm and roughly: 0 on it, and growing away from it in its plane and
/// across.
double off(const mesh::TriangleCorners& t, const Vec3& p) {
  const Vec3 normal = (t[1] - t[0]).cross(t[2] - t[0]).normalized();
  double beside = 0;
  for (std::size_t k = 0; k < 3; ++k) {
    const Vec3 outwards = (t[(k + 1) % 3] - t[k]).normalized().cross(normal);
    beside = std::max(beside, outwards.dot(p - t[k]));
  }
  return beside + std::abs(normal.dot(p - t[0]));
}

/// A point of both triangles, which are known to meet, to rounding. They meet at a corner of one, where an
/// edge of one crosses the other's plane or, both in one plane, where two edges cross: of all these the one
/// nearest to both.
Vec3 common_point(const mesh::TriangleCorners& a, const mesh::TriangleCorners& b) {
  Vec3 best = a[0];
  double least = std::numeric_limits<double>::infinity();
  const auto consider = [&](const Vec3& p) {
    const double distance = off(a, p) + off(b, p);
    if (distance < least) least = distance, best = p;
  };
  const auto consider_edges_of = [&](const mesh::TriangleCorners& t, const mesh::TriangleCorners& other) {
    const Vec3 normal = (other[1] - other[0]).cross(other[2] - other[0]);
    for (std::size_t k = 0; k < 3; ++k) {
      const Vec3 p = t[k], q = t[(k + 1) % 3];
      consider(p);
      const double at_p = normal.dot(p - other[0]), at_q = normal.dot(q - other[0]);
      if (at_p != at_q) consider(p + std::clamp(at_p / (at_p - at_q), 0.0, 1.0) * (q - p));
      for (std::size_t l = 0; l < 3; ++l) {
        const Vec3 r = other[l], along = other[(l + 1) % 3] - r, across = (q - p).cross(along);
        const double size = across.squaredNorm();
        if (size > 0) consider(p + std::clamp((r - p).cross(along).dot(across) / size, 0.0, 1.0) * (q - p));
      }
    }
  };
  consider_edges_of(a, b);
  consider_edges_of(b, a);
  return best;
}

mesh::TriangleCorners corners_of(const FeatureTree& tree, const CylinderFeatures& features, Index triangle) {
  mesh::TriangleCorners out;
  for (std::size_t k = 0; k < 3; ++k) {
    const auto& p = features.points[tree.triangles()[triangle][k]];
    out[k] = {p.x, p.y, p.z};
  }
  return out;
}

}  // namespace

template <class Stationary>
std::optional<ContactWitness> faces_in_contact_at_start(Stationary& stationary, RotatingBody& rotating,
                                                        SearchWork& work) {
  const FeatureTree &mt = rotating.tree(), &ft = stationary.tree();
  const auto near_now = [](const CylinderBox& a, const CylinderBox& b) {
    return a.overlaps_profile(b) && arcs_meet(a, b);
  };
  std::vector<NodePair> open;
  const auto push = [&](Index m, Index f) {
    ++work.node_pairs;
    if (near_now(rotating.node_box(m), stationary.node_box(f))) open.push_back({m, f, 0});
  };
  push(0, 0);
  while (!open.empty()) {
    const NodePair pair = open.back();
    open.pop_back();
    const auto &m = mt.nodes()[pair.rotating], &f = ft.nodes()[pair.stationary];
    if (!m.is_leaf() || !f.is_leaf()) {
      split(mt, ft, pair, push);
      continue;
    }
    const CylinderFeatures &mf = rotating.leaf_features(pair.rotating),
                           &ff = stationary.leaf_features(pair.stationary);
    for (Index s = m.first; s < m.last; ++s) {
      for (Index t = f.first; t < f.last; ++t) {
        if (!near_now(mf.triangle_boxes[s], ff.triangle_boxes[t])) continue;
        ++work.triangle_tests;
        const auto a = corners_of(mt, mf, s), b = corners_of(ft, ff, t);
        if (!mesh::triangles_intersect(a, b)) continue;
        const Vec3 p = common_point(a, b);
        return ContactWitness{{FeatureKind::face, ft.mesh_triangle(t)},
                              {FeatureKind::face, mt.mesh_triangle(s)},
                              stationary.to_own(p),
                              rotating.to_own(p)};
      }
    }
  }
  return std::nullopt;
}

std::optional<ContactWitness> faces_touching(const contact::BodyPair& bodies, const Mesh& fixed,
                                             const Mesh& mobile, const Pose& X_FM) {
  std::optional<contact::TrianglePair> pair;
  if (!bodies.touch(X_FM, pair) || !pair) return std::nullopt;
  const auto corners = [](const Mesh& mesh, Index triangle) {
    const auto& [a, b, c] = mesh.triangles()[triangle];
    return mesh::TriangleCorners{mesh.vertices()[a], mesh.vertices()[b], mesh.vertices()[c]};
  };
  mesh::TriangleCorners of_mobile = corners(mobile, pair->mobile);
  for (Vec3& p : of_mobile) p = posed(X_FM, p);
  const Vec3 p = common_point(corners(fixed, pair->fixed), of_mobile);
  return ContactWitness{
      {FeatureKind::face, pair->fixed}, {FeatureKind::face, pair->mobile}, p, posed(inverted(X_FM), p)};
}

template <class Stationary>
bool one_inside_other_at_start(Stationary& stationary, RotatingBody& rotating) {
  const FeatureTree &mt = rotating.tree(), &ft = stationary.tree();
  const auto inside_stationary = [&](Index v) {
    return winding_number(stationary, rotating.placed_vertex(v)) > 0;
  };
  const auto inside_rotating = [&](Index v) {
    return winding_number(rotating, stationary.placed_vertex(v)) > 0;
  };
  return (ft.is_closed() &&
          std::any_of(mt.component_vertices().begin(), mt.component_vertices().end(), inside_stationary)) ||
         (mt.is_closed() &&
          std::any_of(ft.component_vertices().begin(), ft.component_vertices().end(), inside_rotating));
}

template std::optional<ContactWitness> faces_in_contact_at_start(const RotationTable&, RotatingBody&,
                                                                 SearchWork&);
template std::optional<ContactWitness> faces_in_contact_at_start(RotatingBody&, RotatingBody&, SearchWork&);
template bool one_inside_other_at_start(const RotationTable&, RotatingBody&);
template bool one_inside_other_at_start(RotatingBody&, RotatingBody&);

}  // namespace condyle::motion
