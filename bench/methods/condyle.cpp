#include <optional>

#include "condyle/radial/radial_table.hpp"
#include "condyle/tangential/ring_table.hpp"
#include "kinds.hpp"

namespace bench {
namespace {

using condyle::PointState;
using condyle::Pose;
using condyle::TriMesh;

TriMesh with_vertices(condyle::PointsView vertices, const TriMesh& mesh) {
  TriMesh moved;
  moved.vertices.x.assign(vertices.x.begin(), vertices.x.end());
  moved.vertices.y.assign(vertices.y.begin(), vertices.y.end());
  moved.vertices.z.assign(vertices.z.begin(), vertices.z.end());
  moved.triangles = mesh.triangles;
  return moved;
}

/// The plain radial table: a vertex at a time.
class Radial final : public Method {
 public:
  Radial(const Bodies& bodies, condyle::RadialOptions options)
      : options_(options), mobile_(&bodies.mobile), table_(std::make_shared<Table>(bodies.fixed, options)) {}

  void find_pairs(const Pose& X_FM, std::vector<condyle::TrianglePair>& out) override {
    out = intersecting_pairs(*table_, posed(X_FM, *mobile_));
  }

  void find_inside(const Pose& X_FM, std::vector<InsideVertex>& out) override {
    posed(X_FM, mobile_->vertices.view(), posed_);
    table_->query(posed_, hits_);
    out.clear();
    for (std::size_t v = 0; v < hits_.size(); ++v)
      if (hits_.state[v] != PointState::outside)
        out.push_back({static_cast<condyle::Index>(v), hits_.triangle[v], -hits_.radial_gap[v]});
  }

  void deform(condyle::PointsView fixed_vertices) override {
    table_ = std::make_shared<Table>(with_vertices(fixed_vertices, table_->mesh()), options_);
  }

  std::unique_ptr<Method> for_another_thread() override { return std::make_unique<Radial>(*this); }
  std::size_t bytes() const override { return table_->table_size().bytes; }

 private:
  using Table = condyle::RadialTable;
  condyle::RadialOptions options_;
  const TriMesh* mobile_;
  std::shared_ptr<const Table> table_;
  condyle::Points posed_;
  condyle::RadialHits hits_;
};

/// Rings about the flexion axis.
class Tangential final : public Method {
 public:
  Tangential(const Bodies& bodies, condyle::TangentialRule rule)
      : rule_(rule),
        mobile_(&bodies.mobile),
        table_(std::make_shared<condyle::RingTable>(bodies.fixed, arc_axis())) {}

  void find_inside(const Pose& X_FM, std::vector<InsideVertex>& out) override {
    posed(X_FM, mobile_->vertices.view(), posed_);
    table_->query(posed_, hits_, rule_);
    out.clear();
    for (std::size_t v = 0; v < hits_.size(); ++v)
      if (hits_.state[v] != PointState::outside)
        out.push_back({static_cast<condyle::Index>(v), hits_.triangle[v], -hits_.arc_gap[v]});
  }

  void deform(condyle::PointsView fixed_vertices) override {
    table_ = std::make_shared<condyle::RingTable>(with_vertices(fixed_vertices, table_->mesh()), arc_axis());
  }

  std::unique_ptr<Method> for_another_thread() override { return std::make_unique<Tangential>(*this); }
  std::size_t bytes() const override { return table_->table_size().bytes; }

 private:
  condyle::TangentialRule rule_;
  const TriMesh* mobile_;
  std::shared_ptr<const condyle::RingTable> table_;
  condyle::Points posed_;
  condyle::TangentialHits hits_;
};

MethodKind radial(std::string name, std::string title, condyle::DirectionMapKind map) {
  return {std::move(name),
          "Condyle",
          std::move(title),
          {.pairs = true, .inside = true},
          DepthKind::along_ray,
          true,
          [map](const Bodies& bodies) {
            return std::make_unique<Radial>(bodies, condyle::RadialOptions{.map = map});
          }};
}

MethodKind tangential(std::string name, std::string title, condyle::TangentialRule rule, bool is_exact) {
  return {std::move(name),
          "Condyle",
          std::move(title),
          {.inside = true},
          DepthKind::along_arc,
          is_exact,
          [rule](const Bodies& bodies) { return std::make_unique<Tangential>(bodies, rule); }};
}

}  // namespace

std::vector<MethodKind> condyle_kinds() {
  using condyle::DirectionMapKind, condyle::TangentialRule;
  return {
      radial("radial_plain", "radial, cube map, a vertex at a time", DirectionMapKind::cube),
      radial("radial_cartesian", "radial, the paper's map", DirectionMapKind::cartesian),
      tangential("tangential", "tangential, all crossings in their order", TangentialRule::alternating, true),
      tangential("tangential_nearest_arc", "tangential, the paper's rule", TangentialRule::nearest_arc,
                 false),
  };
}

}  // namespace bench
