#include "motion/rotation_scenes.hpp"

#include <map>

#include "support/brute_force.hpp"
#include "support/test_meshes.hpp"

namespace condyle::test {
namespace {

using Point = motion::Triple<double>;

std::vector<Point> points_about_axis(const TriMesh& mesh, const AxisFrame& axis) {
  std::vector<Point> points;
  for (std::size_t v = 0; v < mesh.vertices.size(); ++v) {
    const Vec3 p = axis.to_axis(mesh.vertices[v]);
    points.push_back({p.x(), p.y(), p.z()});
  }
  return points;
}

std::vector<std::array<Index, 2>> edges_of(const TriMesh& mesh) {
  std::map<std::array<Index, 2>, bool> edges;
  for (const auto& t : mesh.triangles) {
    for (std::size_t k = 0; k < 3; ++k) {
      const auto [low, high] = std::minmax({t[k], t[(k + 1) % 3]});
      edges[{low, high}] = true;
    }
  }
  std::vector<std::array<Index, 2>> out;
  for (const auto& entry : edges) out.push_back(entry.first);
  return out;
}

double uniform(std::mt19937& random, double low, double high) {
  return std::uniform_real_distribution<double>(low, high)(random);
}
Vec3 random_direction(std::mt19937& random) {
  std::normal_distribution<double> normal;
  return Vec3(normal(random), normal(random), normal(random)).normalized();
}

}  // namespace

motion::RotationLimits limits(const RotationScene& scene, const motion::RotationRange& range) {
  return motion::FirstContact(scene.stationary, scene.rotating, scene.axis).limits(Pose::Identity(), range);
}

RotationScene moved(const Pose& X, const RotationScene& scene) {
  return {posed(X, scene.rotating), posed(X, scene.stationary),
          AxisFrame(X * scene.axis.point(), X.linear() * scene.axis.direction())};
}

RotationScene exchanged(const RotationScene& scene) {
  return {scene.stationary, scene.rotating, scene.axis};
}

TriMesh turned(const RotationScene& scene, double angle) {
  TriMesh mesh = in_axis_frame(scene.axis, scene.rotating);
  const double c = std::cos(angle), s = std::sin(angle);
  for (std::size_t v = 0; v < mesh.vertices.size(); ++v) {
    const Vec3 p = mesh.vertices[v];
    mesh.vertices.set(v, {c * p.x() - s * p.y(), s * p.x() + c * p.y(), p.z()});
  }
  return mesh;
}

namespace {

/// All events of pairs of features: the size of the rotation in the sense, and the pair.
template <class Visit>
void for_each_contact(const RotationScene& scene, RotationSense sense, const Visit& visit) {
  const auto m = points_about_axis(scene.rotating, scene.axis),
             f = points_about_axis(scene.stationary, scene.axis);
  const auto record = [&](const motion::ContactEvents& events, const motion::Feature& rotating,
                          const motion::Feature& stationary) {
    for (const motion::ContactEvent& event : events) {
      const double size = sense == RotationSense::positive ? event.angle : two_pi - event.angle;
      visit(BruteLimit{std::max(0.0, size - event.error), {rotating, stationary}});
    }
  };
  const auto face = [](const TriMesh& mesh, const std::vector<Point>& points, Index t) {
    const auto [a, b, c] = mesh.triangles[t];
    return motion::Corners{points[a], points[b], points[c]};
  };
  for (Index v = 0; v < m.size(); ++v) {
    for (Index t = 0; t < scene.stationary.triangles.size(); ++t) {
      record(motion::vertex_meets_face(m[v], face(scene.stationary, f, t)), {motion::FeatureKind::vertex, v},
             {motion::FeatureKind::face, t});
    }
  }
  for (Index t = 0; t < scene.rotating.triangles.size(); ++t) {
    for (Index v = 0; v < f.size(); ++v) {
      record(motion::face_meets_vertex(face(scene.rotating, m, t), f[v]), {motion::FeatureKind::face, t},
             {motion::FeatureKind::vertex, v});
    }
  }
  const auto stationary_edges = edges_of(scene.stationary);
  for (const auto& [a, b] : edges_of(scene.rotating)) {
    for (const auto& [c, d] : stationary_edges) {
      record(motion::edges_meet(m[a], m[b], f[c], f[d]), {motion::FeatureKind::edge, a, b},
             {motion::FeatureKind::edge, c, d});
    }
  }
}

}  // namespace

std::optional<BruteLimit> brute_first_contact(const RotationScene& scene, RotationSense sense) {
  std::optional<BruteLimit> best;
  for_each_contact(scene, sense, [&](const BruteLimit& found) {
    if (!best || std::tie(found.size, found.features) < std::tie(best->size, best->features)) best = found;
  });
  return best;
}

std::map<motion::Feature, double> brute_feature_contacts(const RotationScene& scene, RotationSense sense,
                                                         double range) {
  std::map<motion::Feature, double> first;
  for_each_contact(scene, sense, [&](const BruteLimit& found) {
    if (found.size > range) return;
    const auto [place, is_new] = first.try_emplace(found.features.rotating, found.size);
    if (!is_new) place->second = std::min(place->second, found.size);
  });
  return first;
}

bool brute_contact_at(const RotationScene& scene, double angle) {
  const TriMesh m = turned(scene, angle), f = in_axis_frame(scene.axis, scene.stationary);
  const auto box_of = [](const TriMesh& mesh, std::size_t t) {
    Eigen::AlignedBox3d box;
    for (int k = 0; k < 3; ++k) box.extend(mesh.corner(t, k));
    return box;
  };
  for (std::size_t i = 0; i < m.triangles.size(); ++i) {
    const auto box = box_of(m, i);
    for (std::size_t j = 0; j < f.triangles.size(); ++j) {
      if (box.intersects(box_of(f, j)) &&
          triangles_intersect({m.corner(i, 0), m.corner(i, 1), m.corner(i, 2)},
                              {f.corner(j, 0), f.corner(j, 1), f.corner(j, 2)})) {
        return true;
      }
    }
  }
  return false;
}

TriMesh random_solid(std::mt19937& random, const Vec3& centre, double size) {
  const int kind = std::uniform_int_distribution<int>(0, 2)(random);
  TriMesh mesh = sphere(Vec3::Zero(), 1, kind == 2 ? 1 : 0);
  if (kind == 0) {
    mesh.vertices = Points();
    for (const Vec3& p : {Vec3(1, 1, 1), Vec3(-1, -1, 1), Vec3(-1, 1, -1), Vec3(1, -1, -1)})
      mesh.vertices.push_back(p);
    mesh.triangles = {{0, 1, 3}, {0, 2, 1}, {0, 3, 2}, {1, 2, 3}};
  }
  const Pose turn(Eigen::AngleAxisd(uniform(random, 0, two_pi), random_direction(random)));
  for (std::size_t v = 0; v < mesh.vertices.size(); ++v) {
    mesh.vertices.set(v, centre + turn * (size * uniform(random, 0.5, 1) * mesh.vertices[v]));
  }
  return mesh;
}

RotationScene random_scene(std::mt19937& random) {
  const auto solid = [&](double from, double to) {
    const double theta = uniform(random, from, to), rho = uniform(random, 0.5, 3);
    const Vec3 centre(rho * std::cos(theta), rho * std::sin(theta), uniform(random, -1, 1));
    return random_solid(random, centre, uniform(random, 0.3, 1.5));
  };
  TriMesh rotating = solid(0, two_pi), stationary = solid(0, two_pi);
  return {std::move(rotating), std::move(stationary)};
}

Pose far_away(std::mt19937& random) {
  return Eigen::Translation3d(1e4 * random_direction(random)) *
         Eigen::AngleAxisd(uniform(random, 0, two_pi), random_direction(random));
}

TriMesh prism(const std::vector<Eigen::Vector2d>& outline, double low, double high) {
  const auto n = static_cast<Index>(outline.size());
  TriMesh mesh;
  for (const double z : {low, high}) {
    for (const auto& p : outline) mesh.vertices.push_back({p.x(), p.y(), z});
    mesh.vertices.push_back({0, 0, z});
  }
  const Index bottom_centre = n, top = n + 1, top_centre = 2 * n + 1;
  for (Index i = 0; i < n; ++i) {
    const Index j = (i + 1) % n;
    mesh.triangles.push_back({bottom_centre, j, i});
    mesh.triangles.push_back({top_centre, top + i, top + j});
    mesh.triangles.push_back({i, j, top + j});
    mesh.triangles.push_back({i, top + j, top + i});
  }
  return mesh;
}

TriMesh split_in_four(const TriMesh& mesh) {
  TriMesh finer{mesh.vertices, {}};
  std::map<std::array<Index, 2>, Index> middles;
  const auto middle = [&](Index a, Index b) {
    const auto [low, high] = std::minmax({a, b});
    const auto [at, is_new] = middles.try_emplace({low, high}, static_cast<Index>(finer.vertices.size()));
    if (is_new) finer.vertices.push_back((mesh.vertices[low] + mesh.vertices[high]) / 2);
    return at->second;
  };
  for (const auto& [a, b, c] : mesh.triangles) {
    const Index ab = middle(a, b), bc = middle(b, c), ca = middle(c, a);
    finer.triangles.insert(finer.triangles.end(), {{a, ab, ca}, {ab, b, bc}, {ca, bc, c}, {ab, bc, ca}});
  }
  return finer;
}

}  // namespace condyle::test
