#include <algorithm>

#include "core/parallel.hpp"
#include "depth_raster.hpp"
#include "kinds.hpp"
#include "mesh/surface_distance.hpp"

/// Signed distance field on a dense grid over the fixed body's box: the plain form of what OpenVDB stores
/// sparsely. One multiplication finds a voxel; every voxel is stored, inside or not.
///
/// Signs come from lines through the voxels along z and the layers at which they cross the surface. The
/// distance to the surface is exact, in single precision, at every voxel inside and at their neighbours
/// outside, which interpolation between eight needs; further out only "outside" is kept. A vertex is inside
/// where the interpolated value is negative. After a deformation the field is made anew.

namespace bench {
namespace {

using condyle::Index;
using condyle::Pose;
using condyle::Vec3;

/// Values at low + (i, j, k) * step, k * rows * columns + j * columns + i after one another.
class DistanceGrid {
 public:
  DistanceGrid(const condyle::TriMesh& mesh, double step_mm) : step_(step_mm), per_mm_(1 / step_mm) {
    low_ = Vec3::Constant(std::numeric_limits<double>::infinity());
    Vec3 high = -low_;
    for (std::size_t v = 0; v < mesh.vertices.size(); ++v)
      low_ = low_.cwiseMin(mesh.vertices[v]), high = high.cwiseMax(mesh.vertices[v]);
    low_.array() -= step_;
    for (int k = 0; k < 3; ++k)
      size_[k] = static_cast<std::size_t>(std::ceil((high[k] - low_[k]) / step_)) + 2;
    value_.assign(size_[0] * size_[1] * size_[2], outside());
    mark_inside(mesh);
    measure(mesh);
  }

  /// Interpolated between eight voxels; positive, and no more is promised, outside.
  float at(const Vec3& p) const noexcept {
    const Vec3 steps = (p - low_) * per_mm_;
    std::size_t cell = 0, stride = 1;
    float f[3];
    for (int k = 0; k < 3; ++k) {
      // Also false for what lies before the first voxel.
      if (!(steps[k] >= 0 && steps[k] < static_cast<double>(size_[k] - 1))) return outside();
      const auto whole = static_cast<std::size_t>(steps[k]);
      f[k] = static_cast<float>(steps[k] - static_cast<double>(whole));
      cell += whole * stride;
      stride *= size_[k];
    }
    const float* v = value_.data() + cell;
    const std::size_t row = size_[0], layer = size_[0] * size_[1];
    const auto along_x = [&](const float* a) { return a[0] + f[0] * (a[1] - a[0]); };
    const auto along_xy = [&](const float* a) {
      const float first = along_x(a);
      return first + f[1] * (along_x(a + row) - first);
    };
    const float first = along_xy(v);
    return first + f[2] * (along_xy(v + layer) - first);
  }

  std::size_t bytes() const noexcept { return value_.size() * sizeof(float); }

 private:
  float outside() const noexcept { return static_cast<float>(step_); }
  std::size_t voxel(std::size_t i, std::size_t j, std::size_t k) const noexcept {
    return (k * size_[1] + j) * size_[0] + i;
  }

  /// Negative where the layers of the voxel's line say that it is inside.
  void mark_inside(const condyle::TriMesh& mesh) {
    ImagePlane plane{2,
                     {low_.x() - 0.5 * step_, low_.y() - 0.5 * step_},
                     {step_, step_},
                     {static_cast<int>(size_[0]), static_cast<int>(size_[1])}};
    LayeredImage image;
    DepthRaster().draw(mesh.vertices, mesh.triangles, plane, std::numeric_limits<double>::infinity(), image);
    for (std::size_t j = 0; j < size_[1]; ++j) {
      for (std::size_t i = 0; i < size_[0]; ++i) {
        const auto layers = image.at(plane.cell(static_cast<int>(i), static_cast<int>(j)));
        if (layers.empty()) continue;
        for (std::size_t k = 0; k < size_[2]; ++k) {
          const double z = low_.z() + static_cast<double>(k) * step_;
          if (winding_at(layers, z) > 0) value_[voxel(i, j, k)] = -outside();
        }
      }
    }
  }

  /// The distance itself, where a voxel or one of its 26 neighbours is inside. No voxel of the outermost
  /// layers is.
  void measure(const condyle::TriMesh& mesh) {
    std::vector<std::uint8_t> is_near(value_.size());
    for (std::size_t k = 1; k + 1 < size_[2]; ++k)
      for (std::size_t j = 1; j + 1 < size_[1]; ++j)
        for (std::size_t i = 1; i + 1 < size_[0]; ++i)
          if (value_[voxel(i, j, k)] < 0) mark_neighbours(i, j, k, is_near);
    const condyle::mesh::SurfaceDistance distance(mesh);
    condyle::core::parallel_chunks(size_[2], 1, [&](std::size_t first, std::size_t last) {
      for (std::size_t k = first; k < last; ++k)
        for (std::size_t j = 0; j < size_[1]; ++j)
          for (std::size_t i = 0; i < size_[0]; ++i) {
            const std::size_t here = voxel(i, j, k);
            if (!is_near[here]) continue;
            const Vec3 steps(static_cast<double>(i), static_cast<double>(j), static_cast<double>(k));
            const auto mm = static_cast<float>(distance(low_ + step_ * steps));
            value_[here] = value_[here] < 0 ? -mm : mm;
          }
    });
  }

  void mark_neighbours(std::size_t i, std::size_t j, std::size_t k,
                       std::vector<std::uint8_t>& is_near) const {
    for (std::size_t c = k - 1; c <= k + 1; ++c)
      for (std::size_t b = j - 1; b <= j + 1; ++b) std::fill_n(is_near.begin() + voxel(i - 1, b, c), 3, 1);
  }

  Vec3 low_;
  double step_, per_mm_;
  std::size_t size_[3];
  std::vector<float> value_;
};

class DenseDistance final : public Method {
 public:
  DenseDistance(const Bodies& bodies, double step_mm)
      : mobile_(&bodies.mobile), grid_(std::make_shared<DistanceGrid>(bodies.fixed, step_mm)) {}

  void find_inside(const Pose& X_FM, std::vector<InsideVertex>& out) override {
    out.clear();
    posed(X_FM, mobile_->vertices.view(), posed_);
    for (std::size_t v = 0; v < posed_.size(); ++v) {
      const float distance = grid_->at(posed_[v]);
      if (distance < 0) out.push_back({static_cast<Index>(v), condyle::no_index, -distance});
    }
  }

  std::unique_ptr<Method> for_another_thread() override { return std::make_unique<DenseDistance>(*this); }
  std::size_t bytes() const override { return grid_->bytes(); }

 private:
  const condyle::TriMesh* mobile_;
  std::shared_ptr<const DistanceGrid> grid_;
  condyle::Points posed_;
};

MethodKind dense_distance(std::string name, std::string title, double step_mm) {
  return {std::move(name),
          "distance fields",
          std::move(title),
          {.inside = true},
          DepthKind::nearest_surface,
          false,
          [step_mm](const Bodies& bodies) { return std::make_unique<DenseDistance>(bodies, step_mm); },
          step_mm < 0.75};
}

}  // namespace

std::vector<MethodKind> dense_distance_kinds() {
  return {
      dense_distance("dense_distance_1mm", "dense grid of signed distances, 1 mm", 1),
      dense_distance("dense_distance_0.5mm", "dense grid of signed distances, 0.5 mm", 0.5),
  };
}

}  // namespace bench
