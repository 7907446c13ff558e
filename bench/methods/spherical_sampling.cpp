#include <numeric>

#include "kinds.hpp"
#include "radial/exact/direction_map.hpp"
#include "sphere_raster.hpp"

/// Spherical sampling, after A. Maciel, R. Boulic, D. Thalmann, "Efficient collision detection within
/// deforming spherical sliding contact", IEEE Transactions on Visualization and Computer Graphics 13 (2007).
///
/// Taken from it: rays leave the centre of the joint in directions spread over the sphere, each knows at
/// which radii it crosses the fixed surface, and a mobile vertex is compared with the ray nearest to it: so
/// each costs one look-up whatever the sizes of the meshes. Differing: the rays go through the middles of a
/// cube map's cells, so that the nearest is found without searching; a ray keeps all its crossings, so that
/// bones, not only the facing surfaces of cartilage, have an inside; and it keeps radii alone: what a vertex
/// is told is true of its ray, up to half a cell beside it. After a deformation all rays are cast again.

namespace bench {
namespace {

using condyle::Index;
using condyle::Pose;

class SphericalSampling final : public Method {
 public:
  SphericalSampling(const Bodies& bodies, int cells_per_side)
      : mobile_(&bodies.mobile),
        triangles_(bodies.fixed.triangles),
        map_(cells_per_side),
        cells_per_side_(cells_per_side) {
    cast_rays(bodies.fixed.vertices);
  }

  void find_inside(const Pose& X_FM, std::vector<InsideVertex>& out) override {
    out.clear();
    posed(X_FM, mobile_->vertices.view(), posed_);
    for (std::size_t v = 0; v < posed_.size(); ++v) {
      const condyle::Vec3 p = posed_[v];
      const double squared_radius = p.squaredNorm();
      if (squared_radius == 0) continue;
      const auto layers = rays_->at(map_.cell_of(p));
      if (!layers.empty()) look_up(static_cast<Index>(v), std::sqrt(squared_radius), layers, out);
    }
    lookups_ += static_cast<std::int64_t>(posed_.size());
  }

  void deform(condyle::PointsView fixed_vertices) override { cast_rays(fixed_vertices); }
  std::unique_ptr<Method> for_another_thread() override { return std::make_unique<SphericalSampling>(*this); }
  std::size_t bytes() const override { return rays_->bytes(); }
  Work work() const override { return {{"look-ups", lookups_}}; }

 private:
  void cast_rays(condyle::PointsView fixed_vertices) {
    auto rays = std::make_shared<LayeredImage>();
    draw_on_sphere(fixed_vertices, triangles_, cells_per_side_, *rays);
    // Far out nothing is inside: the steps on the way there undo what is wound about the centre.
    const auto layers = rays->at(0);
    winding_at_centre_ = -std::accumulate(layers.begin(), layers.end(), 0,
                                          [](int sum, const Layer& layer) { return sum + layer.step; });
    rays_ = std::move(rays);
  }

  /// The skins of the solid on each side of the vertex, as along a ray of condyle::RadialTable.
  void look_up(Index vertex, double radius, std::span<const Layer> layers,
               std::vector<InsideVertex>& out) const {
    const Layer *before = nullptr, *after = nullptr;
    int winding = winding_at_centre_;
    bool is_inside = winding > 0;
    for (const Layer& layer : layers) {
      const bool was_in = winding > 0;
      winding += layer.step;
      const bool is_skin = was_in != (winding > 0);
      if (layer.position < radius) {
        is_inside = winding > 0;
        if (is_skin) before = &layer;
      } else {
        if (!is_inside) return;
        if (is_skin) {
          after = &layer;
          break;
        }
      }
    }
    if (!is_inside) return;
    const auto depth = [&](const Layer* skin) {
      return skin ? std::abs(skin->position - radius) : std::numeric_limits<double>::infinity();
    };
    const Layer* exit = depth(before) <= depth(after) ? before : after;
    if (exit) out.push_back({vertex, exit->triangle, depth(exit)});
  }

  const condyle::TriMesh* mobile_;
  std::span<const condyle::Triangle> triangles_;
  condyle::radial::CubeMap map_;
  int cells_per_side_;
  std::shared_ptr<const LayeredImage> rays_;
  int winding_at_centre_ = 0;
  condyle::Points posed_;
  std::int64_t lookups_ = 0;
};

MethodKind spherical_sampling(int cells_per_side) {
  const std::string side = std::to_string(cells_per_side);
  return {"spherical_sampling_" + side,
          "spherical sampling",
          "rays from the centre, 6 x " + side + " x " + side,
          {.inside = true, .deforms = true},
          DepthKind::along_ray,
          false,
          [cells_per_side](const Bodies& bodies) {
            return std::make_unique<SphericalSampling>(bodies, cells_per_side);
          }};
}

}  // namespace

std::vector<MethodKind> spherical_sampling_kinds() {
  return {spherical_sampling(64), spherical_sampling(256)};
}

}  // namespace bench
