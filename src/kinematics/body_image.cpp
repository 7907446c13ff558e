#include <algorithm>
#include <cmath>

#include "condyle/joint.hpp"

namespace condyle {
namespace {

bool is_on(const ImageCut& cut, const Vec3& point) noexcept {
  return std::abs(cut.normal.dot(point) - cut.offset_mm) <= on_cut_mm;
}

}  // namespace

bool is_on_cut(const std::vector<ImageCut>& cuts, const Vec3& point) noexcept {
  return std::any_of(cuts.begin(), cuts.end(), [&](const ImageCut& cut) { return is_on(cut, point); });
}

bool is_on_cut(const Body& body, const Vec3& point) noexcept {
  return body.image && is_on_cut(body.image->cuts, point);
}

double cut_area_mm2(const Body& body) {
  if (!body.image) return 0;
  double area = 0;
  for (std::size_t t = 0; t < body.mesh.triangles().size(); ++t) {
    const Vec3 a = body.mesh.corner(t, 0), b = body.mesh.corner(t, 1), c = body.mesh.corner(t, 2);
    for (const ImageCut& cut : body.image->cuts)
      if (is_on(cut, a) && is_on(cut, b) && is_on(cut, c)) {
        area += (b - a).cross(c - a).norm() / 2;
        break;
      }
  }
  return area;
}

}  // namespace condyle
