#include "embree_query.hpp"
#include "float_pose.hpp"
#include "kinds.hpp"

namespace bench {
namespace {

using condyle::Index;
using condyle::Pose;

/// A ray for every mobile vertex, in the mesh's order, with Embree's default traversal. The one for coherent
/// rays costs 1.7 times as much on the sample hip's scenario 1 and saves a sixth on scenario 3 (16 rays at a
/// time): it is used where vertices are sorted.
template <unsigned Width>
class EmbreeAll final : public Method {
 public:
  EmbreeAll(const Bodies& bodies, RayRounding rounding)
      : scene_(std::make_shared<EmbreeScene>(bodies.fixed, rounding)),
        mobile_(std::make_shared<FloatPoints>(bodies.mobile.vertices)),
        rays_(RTC_INTERSECT_CONTEXT_FLAG_INCOHERENT) {
    points_.resize(mobile_->size());
    for (Index v = 0; v < mobile_->size(); ++v) points_.vertex[v] = v, points_.reach[v] = 1;
  }

  void find_inside(const Pose& X_FM, std::vector<InsideVertex>& out) override {
    out.clear();
    const FloatPose X(X_FM);
    const auto& [x, y, z] = *mobile_;
    for (std::size_t v = 0; v < x.size(); ++v) points_.x[v] = X.row(0, x[v], y[v], z[v]);
    for (std::size_t v = 0; v < x.size(); ++v) points_.y[v] = X.row(1, x[v], y[v], z[v]);
    for (std::size_t v = 0; v < x.size(); ++v) points_.z[v] = X.row(2, x[v], y[v], z[v]);
    rays_(*scene_, points_, x.size(), out);
  }

  void deform(condyle::PointsView fixed_vertices) override { scene_->deform(fixed_vertices); }
  std::unique_ptr<Method> for_another_thread() override { return std::make_unique<EmbreeAll>(*this); }
  std::size_t bytes() const override { return scene_->bytes(); }
  Work work() const override { return rays_.work(); }

 private:
  std::shared_ptr<EmbreeScene> scene_;
  std::shared_ptr<const FloatPoints> mobile_;
  RayQuery<Width> rays_;
  RayOrigins points_;
};

template <unsigned Width>
MethodKind all_rays(std::string name, std::string title, RayRounding rounding) {
  return {std::move(name),
          "ray casting",
          std::move(title),
          {.inside = true, .deforms = true},
          DepthKind::along_ray,
          false,
          [rounding](const Bodies& bodies) { return std::make_unique<EmbreeAll<Width>>(bodies, rounding); }};
}

}  // namespace

std::vector<MethodKind> embree_kinds() {
  return {
      all_rays<1>("embree_1_robust", "Embree, a ray at a time, robust", RayRounding::robust),
      all_rays<8>("embree_8_robust", "Embree, 8 rays at a time, robust", RayRounding::robust),
      all_rays<16>("embree_16_robust", "Embree, 16 rays at a time, robust", RayRounding::robust),
      all_rays<16>("embree_16", "Embree, 16 rays at a time, not watertight", RayRounding::fast),
      embree_culled_kind(),
  };
}

}  // namespace bench
