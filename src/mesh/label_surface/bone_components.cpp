#include "mesh/label_surface/bone_components.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <optional>
#include <vector>

#include "condyle/inspect.hpp"
#include "mesh/edge_table.hpp"
#include "mesh/enclosed_volume.hpp"
#include "mesh/winding_number.hpp"

namespace condyle::mesh {
namespace {

constexpr std::size_t none = static_cast<std::size_t>(-1);

struct Component {
  std::size_t first_triangle = 0;
  std::size_t triangles = 0;
  CompensatedSum signed_volume;
  Vec3 low = Vec3::Constant(INFINITY), high = Vec3::Constant(-INFINITY);

  double volume() const { return signed_volume.value(); }
  bool may_hold(const Component& other) const {
    return (low.array() < other.low.array()).all() && (high.array() > other.high.array()).all();
  }
};

std::vector<Component> measure(const TriMesh& mesh, const ConnectedComponents& components) {
  std::vector<Component> found(components.first_triangle.size());
  for (std::size_t c = 0; c < found.size(); ++c) found[c].first_triangle = components.first_triangle[c];
  const BoundingBox bounds = bounds_of_surface(mesh);
  const Vec3 centre = (bounds.low + bounds.high) / 2;
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    Component& c = found[components.of_triangle[t]];
    ++c.triangles;
    c.signed_volume.add(volume_below(mesh, t, centre));
    for (int k = 0; k < 3; ++k) {
      c.low = c.low.cwiseMin(mesh.corner(t, k));
      c.high = c.high.cwiseMax(mesh.corner(t, k));
    }
  }
  return found;
}

/// Which components stay. They do not meet, so that one vertex decides which others hold a component.
class Choice {
 public:
  Choice(const TriMesh& mesh, const ConnectedComponents& components, const ComponentChoice& choice)
      : mesh_(mesh), components_(components), choice_(choice), component_(measure(mesh, components)) {}

  std::vector<bool> kept() {
    std::vector<std::size_t> by_volume(component_.size());
    std::iota(by_volume.begin(), by_volume.end(), std::size_t{0});
    std::stable_sort(by_volume.begin(), by_volume.end(), [&](std::size_t a, std::size_t b) {
      return std::abs(component_[a].volume()) > std::abs(component_[b].volume());
    });
    solid_.resize(component_.size());
    std::vector<bool> kept(component_.size());
    bool is_first_solid = true;
    for (std::size_t at = 0; at < by_volume.size(); ++at) {
      const std::size_t c = by_volume[at];
      const std::size_t parent = smallest_around(c, by_volume, at);
      const bool is_solid = component_[c].volume() > 0;
      if (parent == none) {
        kept[c] = is_solid && (choice_.all_pieces || is_first_solid);
        is_first_solid = is_first_solid && !is_solid;
      } else {
        kept[c] = kept[parent] && (is_solid ? choice_.all_pieces : choice_.keep_cavities);
      }
    }
    return kept;
  }

 private:
  /// The component of least volume that holds component c, among the first `count` by volume.
  std::size_t smallest_around(std::size_t c, const std::vector<std::size_t>& by_volume, std::size_t count) {
    const Vec3 p = mesh_.corner(component_[c].first_triangle, 0);
    for (std::size_t at = count; at-- > 0;) {
      const std::size_t other = by_volume[at];
      if (component_[other].may_hold(component_[c]) && solid(other).at(p).winding != 0) return other;
    }
    return none;
  }

  const WindingNumber& solid(std::size_t c) {
    auto& made = solid_[c];
    if (!made) {
      TriMesh alone{mesh_.vertices, {}};
      for (std::size_t t = 0; t < mesh_.triangles.size(); ++t)
        if (components_.of_triangle[t] == c) alone.triangles.push_back(mesh_.triangles[t]);
      drop_unreferenced_vertices(alone);
      made.emplace(Mesh(std::move(alone)));
    }
    return *made;
  }

  const TriMesh& mesh_;
  const ConnectedComponents& components_;
  ComponentChoice choice_;
  std::vector<Component> component_;
  std::vector<std::optional<WindingNumber>> solid_;
};

}  // namespace

std::size_t drop_components(Contour& contour, const ComponentChoice& choice) {
  TriMesh& mesh = contour.mesh;
  const ConnectedComponents components = EdgeTable(mesh).components();
  const std::size_t count = components.first_triangle.size();
  if (count <= 1) return 0;
  const std::vector<bool> kept = Choice(mesh, components, choice).kept();
  const auto dropped = static_cast<std::size_t>(std::count(kept.begin(), kept.end(), false));
  if (dropped == 0) return 0;
  std::size_t next = 0;
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    if (!kept[components.of_triangle[t]]) continue;
    mesh.triangles[next] = mesh.triangles[t];
    contour.cap[next++] = contour.cap[t];
  }
  mesh.triangles.resize(next);
  contour.cap.resize(next);
  drop_unreferenced_vertices(mesh);
  return dropped;
}

}  // namespace condyle::mesh
