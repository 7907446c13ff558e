#include <algorithm>
#include <array>

#include "direction_order.hpp"
#include "embree_query.hpp"
#include "float_pose.hpp"
#include "kinds.hpp"
#include "radial/exact/direction_map.hpp"

/// Embree with everything that is cheap done before it: what an engineer would write who knows that the
/// bodies turn about the centre.
///
/// The mobile vertices are sorted by direction once, so that rays of one packet go nearly one way and
/// Embree's traversal for coherent rays pays. Blocks of them that lie nearer to the centre than the fixed
/// surface anywhere, further than all of it, or outside its box, are passed over by their bounding sphere; of
/// the other blocks each vertex alone. Where the ray need not go, it does not: it ends at the surface's
/// smallest radius.

namespace bench {
namespace {

using condyle::Index;
using condyle::Pose;
using condyle::Vec3;

/// Where the fixed surface is: its box and the radii it takes, widened by more than single precision rounds.
struct SurfaceExtent {
  SurfaceExtent(condyle::PointsView vertices, const std::vector<condyle::Triangle>& triangles) {
    double farthest = 0, nearest = std::numeric_limits<double>::infinity();
    Vec3 low_corner = Vec3::Constant(nearest), high_corner = Vec3::Constant(-nearest);
    for (std::size_t v = 0; v < vertices.size(); ++v) {
      const Vec3 p = vertices[v];
      low_corner = low_corner.cwiseMin(p), high_corner = high_corner.cwiseMax(p);
      nearest = std::min(nearest, p.norm()), farthest = std::max(farthest, p.norm());
    }
    for (const auto& [i, j, k] : triangles) {
      const condyle::radial::Cone t{vertices[i], vertices[j], vertices[k]};
      const double longest = std::sqrt(std::max((t.b - t.a).squaredNorm(), (t.c - t.a).squaredNorm()));
      if (t.a.norm() - longest < nearest) nearest = std::min(nearest, condyle::radial::min_radius(t));
    }
    const double margin = 1e-6 * farthest;
    low = (low_corner.array() - margin).cast<float>(), high = (high_corner.array() + margin).cast<float>();
    min_radius = static_cast<float>(std::max(0.0, nearest - margin));
    max_radius = static_cast<float>(farthest + margin);
  }

  Eigen::Vector3f low, high;
  float min_radius, max_radius;
};

/// Vertices next to each other in the order: a sphere about them, and how far from the joint centre they are.
struct Block {
  float x, y, z, radius;
  float nearest, farthest;
};

/// As many as a packet has rays.
constexpr std::size_t block_size = 16;

/// The mobile vertices in their order, in blocks, the last of which repeats its last vertex until it is full.
struct SortedVertices {
  explicit SortedVertices(condyle::PointsView points) : vertex(by_direction(points)) {
    count = vertex.size();
    while (vertex.size() % block_size != 0) vertex.push_back(vertex.back());
    condyle::Points sorted(vertex.size());
    for (std::size_t i = 0; i < vertex.size(); ++i) sorted.set(i, points[vertex[i]]);
    for (std::size_t first = 0; first < vertex.size(); first += block_size)
      blocks.push_back(block_of(sorted.view().subspan(first, block_size)));
    position = FloatPoints(sorted);
  }

  static Block block_of(condyle::PointsView points) {
    Vec3 low = points[0], high = points[0];
    double nearest = points[0].norm(), farthest = nearest, radius = 0;
    for (std::size_t i = 1; i < points.size(); ++i) {
      low = low.cwiseMin(points[i]), high = high.cwiseMax(points[i]);
      nearest = std::min(nearest, points[i].norm()), farthest = std::max(farthest, points[i].norm());
    }
    const Vec3 centre = 0.5 * (low + high);
    for (std::size_t i = 0; i < points.size(); ++i) radius = std::max(radius, (points[i] - centre).norm());
    const auto x = centre.cast<float>();
    return {x[0],
            x[1],
            x[2],
            static_cast<float>(radius),
            static_cast<float>(nearest),
            static_cast<float>(farthest)};
  }

  std::size_t count;
  std::vector<Index> vertex;
  FloatPoints position;
  std::vector<Block> blocks;
};

/// 1 or 0, without a branch.
int within(float value, float low, float high) noexcept {
  return static_cast<int>(value >= low) & static_cast<int>(value <= high);
}

/// Blocks and vertices that were looked at.
struct CullCount {
  std::int64_t blocks = 0, blocks_kept = 0;
};

class EmbreeCulled final : public Method {
 public:
  explicit EmbreeCulled(const Bodies& bodies)
      : triangles_(&bodies.fixed.triangles),
        scene_(std::make_shared<EmbreeScene>(bodies.fixed, RayRounding::robust)),
        mobile_(std::make_shared<SortedVertices>(bodies.mobile.vertices)),
        extent_(bodies.fixed.vertices, *triangles_) {
    near_.resize(mobile_->vertex.size() + 1);
  }

  void find_inside(const Pose& X_FM, std::vector<InsideVertex>& out) override {
    out.clear();
    const FloatPose X(X_FM);
    const float shift = static_cast<float>(X_FM.translation().norm());
    std::size_t kept = 0;
    for (std::size_t b = 0; b < mobile_->blocks.size(); ++b) {
      if (!may_be_inside(X, shift, mobile_->blocks[b])) continue;
      ++count_.blocks_kept;
      kept = keep_near(X, b * block_size, kept);
    }
    count_.blocks += static_cast<std::int64_t>(mobile_->blocks.size());
    rays_(*scene_, near_, kept, out);
  }

  void deform(condyle::PointsView fixed_vertices) override {
    scene_->deform(fixed_vertices);
    extent_ = SurfaceExtent(fixed_vertices, *triangles_);
  }

  std::unique_ptr<Method> for_another_thread() override { return std::make_unique<EmbreeCulled>(*this); }
  std::size_t bytes() const override { return scene_->bytes(); }

  Work work() const override {
    Work work = rays_.work();
    work.insert(work.begin(), {{"blocks", count_.blocks}, {"blocks looked into", count_.blocks_kept}});
    return work;
  }

 private:
  /// Within this radius all vertices are outside; 0 where the centre is in the solid.
  float free_radius() const noexcept { return scene_->centre_is_inside() ? 0 : extent_.min_radius; }

  bool may_be_inside(const FloatPose& X, float shift, const Block& block) const noexcept {
    if (block.farthest + shift < free_radius() || block.nearest - shift > extent_.max_radius) return false;
    for (int i = 0; i < 3; ++i) {
      const float at = X.row(i, block.x, block.y, block.z);
      if (at + block.radius < extent_.low[i] || at - block.radius > extent_.high[i]) return false;
    }
    return true;
  }

  /// Poses a block and adds those of its vertices that may be inside to the `kept` ones; how many those are
  /// then. All are written, and overwritten by the next where not kept: no branch to predict.
  std::size_t keep_near(const FloatPose& X, std::size_t first, std::size_t kept) noexcept {
    const float* x = mobile_->position.x.data() + first;
    const float* y = mobile_->position.y.data() + first;
    const float* z = mobile_->position.z.data() + first;
    std::array<float, block_size> px, py, pz, reach;
    std::array<int, block_size> is_near;
    const float free2 = free_radius() * free_radius(), far2 = extent_.max_radius * extent_.max_radius;
    const auto low = extent_.low, high = extent_.high;
    for (std::size_t i = 0; i < block_size; ++i) {
      px[i] = X.row(0, x[i], y[i], z[i]), py[i] = X.row(1, x[i], y[i], z[i]),
      pz[i] = X.row(2, x[i], y[i], z[i]);
      const float radius2 = px[i] * px[i] + py[i] * py[i] + pz[i] * pz[i];
      reach[i] = 1 - extent_.min_radius / std::sqrt(radius2);
      is_near[i] = within(radius2, free2, far2) & within(px[i], low[0], high[0]) &
                   within(py[i], low[1], high[1]) & within(pz[i], low[2], high[2]);
    }
    const std::size_t size = std::min(block_size, mobile_->count - first);
    for (std::size_t i = 0; i < size; ++i) {
      near_.x[kept] = px[i], near_.y[kept] = py[i], near_.z[kept] = pz[i];
      near_.reach[kept] = reach[i], near_.vertex[kept] = mobile_->vertex[first + i];
      kept += static_cast<std::size_t>(is_near[i]);
    }
    return kept;
  }

  const std::vector<condyle::Triangle>* triangles_;
  std::shared_ptr<EmbreeScene> scene_;
  std::shared_ptr<const SortedVertices> mobile_;
  SurfaceExtent extent_;
  RayQuery<16> rays_{RTC_INTERSECT_CONTEXT_FLAG_COHERENT};
  RayOrigins near_;
  CullCount count_;
};

}  // namespace

MethodKind embree_culled_kind() {
  return {"embree_16_culled",
          "ray casting",
          "Embree, 16 rays at a time, robust, vertices sorted and culled",
          {.inside = true, .deforms = true},
          DepthKind::along_ray,
          false,
          [](const Bodies& bodies) { return std::make_unique<EmbreeCulled>(bodies); }};
}

}  // namespace bench
