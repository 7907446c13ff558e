#include <algorithm>

#include "kinds.hpp"
#include "simbody_contact.hpp"

namespace bench {
namespace {

using condyle::Index;
using condyle::Pose;
using condyle::TriMesh;

PlainMesh plain(const TriMesh& mesh) {
  PlainMesh out;
  for (std::size_t i = 0; i < mesh.vertices.size(); ++i) {
    const condyle::Vec3 p = mesh.vertices[i];
    out.coordinates.insert(out.coordinates.end(), {p.x(), p.y(), p.z()});
  }
  for (const auto& t : mesh.triangles)
    for (const Index v : t) out.corners.push_back(static_cast<int>(v));
  return out;
}

/// Simbody 3.7, the engine under OpenSim: its tracker of two triangle meshes and its nearest point of a mesh,
/// which are the two steps of its elastic foundation contact. In double, with trees of oriented boxes.
///
/// The tracker reports the triangles of each mesh that are partly or wholly inside the other: bodies touch
/// if there are such triangles. It does not report which one meets which. The nearest point is queried for the
/// corners of the mobile ones, where the elastic foundation asks it for their middles; it also says whether
/// the point is inside, from the normals there.
class Simbody final : public Method {
 public:
  explicit Simbody(const Bodies& bodies)
      : mobile_(&bodies.mobile), contact_(plain(bodies.fixed), plain(bodies.mobile)) {}

  bool touch(const Pose& X_FM) override { return !contact_.buried_mobile_triangles(rows(X_FM)).empty(); }

  void find_inside(const Pose& X_FM, std::vector<InsideVertex>& out) override {
    vertices_.clear();
    for (const int t : contact_.buried_mobile_triangles(rows(X_FM)))
      for (const Index v : mobile_->triangles[t]) vertices_.push_back(v);
    std::sort(vertices_.begin(), vertices_.end());
    vertices_.erase(std::unique(vertices_.begin(), vertices_.end()), vertices_.end());
    asked_ += static_cast<std::int64_t>(vertices_.size());

    out.clear();
    for (const Index v : vertices_) {
      const condyle::Vec3 p = condyle::posed(X_FM, mobile_->vertices[v]);
      const auto [is_inside, triangle, distance] = contact_.nearest({p.x(), p.y(), p.z()});
      if (is_inside) out.push_back({v, static_cast<Index>(triangle), distance});
    }
  }

  Work work() const override { return {{"vertices of buried triangles", asked_}}; }

 private:
  static SimbodyContact::PoseRows rows(const Pose& X) {
    SimbodyContact::PoseRows out{};
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j < 4; ++j) out[i][j] = X.matrix()(i, j);
    return out;
  }

  const TriMesh* mobile_;
  SimbodyContact contact_;
  std::vector<Index> vertices_;
  std::int64_t asked_ = 0;
};

}  // namespace

std::vector<MethodKind> simbody_kinds() {
  return {{"simbody_mesh",
           "what people use today",
           "Simbody, contact of triangle meshes",
           {.touch = true, .inside = true},
           DepthKind::nearest_surface,
           false,
           [](const Bodies& bodies) { return std::make_unique<Simbody>(bodies); },
           false,
           100'000}};
}

}  // namespace bench
