#include <array>

#include "depth_raster.hpp"
#include "kinds.hpp"

/// Layered depth images: B. Heidelberger, M. Teschner, M. Gross, "Real-time volumetric intersections of
/// deforming objects" (VMV 2003) and "Detection of collisions and self-collisions using image-space
/// techniques" (WSCG 2004).
///
/// As published: the volume of interest is what the boxes of both bodies share; the fixed body is drawn
/// there, anew at each pose, into an orthogonal image that keeps every layer, where the lines of sight enter
/// and leave it; a mobile vertex in the volume is inside where its pixel's line is, at the vertex's depth.
/// Differing: drawn in software, in double; we look along the volume's longest side, which makes its pixels
/// smallest; layers are counted by the direction in which they are crossed, where the paper counts front and
/// back faces from a side of the volume that is outside. A vertex is judged by the middle of its pixel, up to
/// half a pixel's diagonal away: that is the method's error.

namespace bench {
namespace {

using condyle::Pose;
using condyle::Vec3;

struct Box {
  explicit Box(condyle::PointsView points) {
    const std::array<std::span<const double>, 3> coordinates = {points.x, points.y, points.z};
    for (int k = 0; k < 3; ++k) {
      const auto [least, most] = std::minmax_element(coordinates[k].begin(), coordinates[k].end());
      low[k] = *least, high[k] = *most;
    }
  }
  Vec3 low, high;
};

class LayeredDepth final : public Method {
 public:
  LayeredDepth(const Bodies& bodies, int pixels)
      : mobile_(&bodies.mobile),
        fixed_(bodies.fixed.vertices),
        triangles_(bodies.fixed.triangles),
        box_(fixed_),
        pixels_(pixels) {}

  void find_inside(const Pose& X_FM, std::vector<InsideVertex>& out) override {
    out.clear();
    posed(X_FM, mobile_->vertices.view(), posed_);
    const Box mobile(posed_);
    const Vec3 low = box_.low.cwiseMax(mobile.low), high = box_.high.cwiseMin(mobile.high);
    if ((low.array() >= high.array()).any()) return;
    const ImagePlane plane = plane_along_longest_side(low, high);
    raster_.draw(fixed_, triangles_, plane, high[plane.axis], image_);
    layers_ += static_cast<std::int64_t>(image_.layers());
    find_in_image(plane, low, high, out);
  }

  void deform(condyle::PointsView fixed_vertices) override {
    fixed_ = fixed_vertices;
    box_ = Box(fixed_);
  }

  std::unique_ptr<Method> for_another_thread() override { return std::make_unique<LayeredDepth>(*this); }
  /// Memory of the image that was drawn last.
  std::size_t bytes() const override { return image_.bytes(); }
  Work work() const override { return {{"layers", layers_}, {"vertices in the volume", looked_up_}}; }

 private:
  ImagePlane plane_along_longest_side(const Vec3& low, const Vec3& high) const {
    ImagePlane plane;
    (high - low).maxCoeff(&plane.axis);
    const std::array<int, 2> across = {plane.column_axis(), plane.row_axis()};
    for (int k = 0; k < 2; ++k) {
      plane.low[k] = low[across[k]];
      plane.pixel[k] = (high[across[k]] - low[across[k]]) / pixels_;
      plane.size[k] = pixels_;
    }
    return plane;
  }

  void find_in_image(const ImagePlane& plane, const Vec3& low, const Vec3& high,
                     std::vector<InsideVertex>& out) {
    const auto pixel = [&](int k, double at) {
      return std::min(pixels_ - 1, static_cast<int>((at - plane.low[k]) / plane.pixel[k]));
    };
    for (std::size_t v = 0; v < posed_.size(); ++v) {
      const Vec3 p = posed_[v];
      if ((p.array() < low.array()).any() || (p.array() > high.array()).any()) continue;
      ++looked_up_;
      const auto cell = plane.cell(pixel(0, p[plane.column_axis()]), pixel(1, p[plane.row_axis()]));
      if (winding_at(image_.at(cell), p[plane.axis]) > 0)
        out.push_back({static_cast<condyle::Index>(v), condyle::no_index});
    }
  }

  const condyle::TriMesh* mobile_;
  condyle::PointsView fixed_;
  std::span<const condyle::Triangle> triangles_;
  Box box_;
  int pixels_;
  DepthRaster raster_;
  LayeredImage image_;
  condyle::Points posed_;
  std::int64_t layers_ = 0, looked_up_ = 0;
};

MethodKind layered_depth(int pixels) {
  const std::string side = std::to_string(pixels);
  return {"layered_depth_" + side,
          "image space",
          "layered depth image, " + side + " x " + side,
          {.inside = true, .deforms = true},
          DepthKind::none,
          false,
          [pixels](const Bodies& bodies) { return std::make_unique<LayeredDepth>(bodies, pixels); }};
}

}  // namespace

std::vector<MethodKind> layered_depth_kinds() {
  return {layered_depth(64), layered_depth(128), layered_depth(256), layered_depth(512)};
}

}  // namespace bench
