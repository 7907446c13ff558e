#include <optional>

#include "condyle/answer/depth.hpp"
#include "condyle/first_contact.hpp"
#include "condyle/radial.hpp"
#include "condyle/tangential.hpp"
#include "contact/body_pair.hpp"
#include "kinds.hpp"
#include "mesh/surface_distance.hpp"

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

/// The radial table asked for penetrating vertices only, in vectors. Depth, triangle and side of each.
class RadialVectors : public Method {
 public:
  explicit RadialVectors(const Bodies& bodies)
      : table_(std::make_shared<condyle::radial::RadialTable>(bodies.fixed)),
        points_(bodies.mobile.vertices) {
    table_->prepare_penetrations();
  }

  void find_inside(const Pose& X_FM, std::vector<InsideVertex>& out) override {
    table_->penetrations(points_, X_FM, found_, &work_);
    out.resize(found_.size());
    for (std::size_t i = 0; i < found_.size(); ++i)
      out[i] = {found_.point[i], found_.triangle[i], found_.depth_mm[i]};
  }

  void deform(condyle::PointsView fixed_vertices) override {
    table_->update(fixed_vertices);
    table_->prepare_penetrations();
  }

  std::unique_ptr<Method> for_another_thread() override { return std::make_unique<RadialVectors>(*this); }
  std::size_t bytes() const override { return table_->table_size().bytes; }
  Work work() const override {
    const auto count = [](std::uint64_t n) { return static_cast<std::int64_t>(n); };
    return {{"blocks", count(work_.blocks)},
            {"blocks near", count(work_.near_blocks)},
            {"vertices near", count(work_.near_points)},
            {"triangles tried", count(work_.triangles)},
            {"vertices uncertain", count(work_.uncertain)}};
  }

 private:
  std::shared_ptr<condyle::radial::RadialTable> table_;
  condyle::radial::SortedPoints points_;
  condyle::radial::Penetrations found_;
  condyle::radial::PenetrationWork work_;
};

/// The same vertices, and how far each is from the nearest point of the surface, as measures of a contact have it.
class Nearest final : public RadialVectors {
 public:
  explicit Nearest(const Bodies& bodies)
      : RadialVectors(bodies),
        mobile_(&bodies.mobile),
        distance_(std::make_shared<condyle::mesh::SurfaceDistance>(bodies.fixed)) {}

  void find_inside(const Pose& X_FM, std::vector<InsideVertex>& out) override {
    RadialVectors::find_inside(X_FM, out);
    for (InsideVertex& v : out) v.depth_mm = (*distance_)(condyle::posed(X_FM, mobile_->vertices[v.vertex]));
  }

  std::unique_ptr<Method> for_another_thread() override { return std::make_unique<Nearest>(*this); }

 private:
  const TriMesh* mobile_;
  std::shared_ptr<const condyle::mesh::SurfaceDistance> distance_;
};

/// Two meshes without a joint: the answer of `condyle touch` without measures, and contact events about an axis whose
/// tables are made for each question.
class TwoMeshes final : public Method {
 public:
  explicit TwoMeshes(const Bodies& bodies) : bodies_(bodies.fixed, bodies.mobile) {}

  BodyDepth find_depth(const Pose& X_FM) override {
    const condyle::TouchAnswer answer =
        condyle::answer_touch(bodies_, {.X_FM = X_FM, .measures = condyle::TouchMeasures::depth});
    return {answer.in_contact, answer.deepest ? answer.deepest->depth_mm : 0};
  }

  std::optional<condyle::Angle> find_first_contact(const condyle::Vec3& axis_F,
                                                   condyle::Angle range) override {
    const condyle::motion::FirstContact search(bodies_.fixed(), bodies_.mobile(), {{0, 0, 0}, axis_F});
    const auto end = search.limits(Pose::Identity(), {condyle::Angle(), range}).positive;
    if (end.reason == condyle::motion::LimitReason::end_of_range) return std::nullopt;
    return end.turned;
  }

 private:
  condyle::contact::JointContact bodies_;
};

/// Trees of boxes and shells on both bodies.
class Trees final : public Method {
 public:
  explicit Trees(const Bodies& bodies)
      : pair_(std::make_shared<condyle::contact::BodyPair>(bodies.fixed, bodies.mobile)) {}

  bool touch(const Pose& X_FM) override { return pair_->touch(X_FM, last_hit_); }

  void find_pairs(const Pose& X_FM, std::vector<condyle::contact::TrianglePair>& out) override {
    out = pair_->pairs(X_FM);
  }

  std::unique_ptr<Method> for_another_thread() override { return std::make_unique<Trees>(*this); }

 private:
  std::shared_ptr<const condyle::contact::BodyPair> pair_;
  std::optional<condyle::contact::TrianglePair> last_hit_;
};

/// The plain radial table: a vertex at a time.
class Radial final : public Method {
 public:
  Radial(const Bodies& bodies, condyle::radial::RadialOptions options)
      : mobile_(&bodies.mobile), table_(std::make_shared<Table>(bodies.fixed, options)) {}

  void find_inside(const Pose& X_FM, std::vector<InsideVertex>& out) override {
    posed(X_FM, mobile_->vertices.view(), posed_);
    table_->query(posed_, hits_);
    out.clear();
    for (std::size_t v = 0; v < hits_.size(); ++v)
      if (hits_.state[v] != PointState::outside)
        out.push_back({static_cast<condyle::Index>(v), hits_.triangle[v], -hits_.radial_gap_mm[v]});
  }

  void deform(condyle::PointsView fixed_vertices) override { table_->update(fixed_vertices); }

  std::unique_ptr<Method> for_another_thread() override { return std::make_unique<Radial>(*this); }
  std::size_t bytes() const override { return table_->table_size().bytes; }

 private:
  using Table = condyle::radial::RadialTable;
  const TriMesh* mobile_;
  std::shared_ptr<Table> table_;
  condyle::Points posed_;
  condyle::radial::RadialResults hits_;
};

/// Rings about the flexion axis.
class Tangential final : public Method {
 public:
  Tangential(const Bodies& bodies, condyle::tangential::TangentialRule rule)
      : rule_(rule),
        fixed_(&bodies.fixed),
        mobile_(&bodies.mobile),
        table_(std::make_shared<condyle::tangential::RingTable>(bodies.fixed, arc_axis())) {}

  void find_inside(const Pose& X_FM, std::vector<InsideVertex>& out) override {
    posed(X_FM, mobile_->vertices.view(), posed_);
    table_->query(posed_, hits_, rule_);
    out.clear();
    for (std::size_t v = 0; v < hits_.size(); ++v)
      if (hits_.state[v] != PointState::outside)
        out.push_back({static_cast<condyle::Index>(v), hits_.triangle[v], -hits_.arc_gap_mm[v]});
  }

  void deform(condyle::PointsView fixed_vertices) override {
    table_ =
        std::make_shared<condyle::tangential::RingTable>(with_vertices(fixed_vertices, *fixed_), arc_axis());
  }

  std::unique_ptr<Method> for_another_thread() override { return std::make_unique<Tangential>(*this); }
  std::size_t bytes() const override { return table_->table_size().bytes; }

 private:
  condyle::tangential::TangentialRule rule_;
  const TriMesh *fixed_, *mobile_;
  std::shared_ptr<const condyle::tangential::RingTable> table_;
  condyle::Points posed_;
  condyle::tangential::TangentialResults hits_;
};

MethodKind radial_vectors() {
  return {"radial",
          "Condyle",
          "radial, cube map, in vectors",
          {.inside = true, .deforms = true},
          DepthKind::along_ray,
          true,
          [](const Bodies& bodies) { return std::make_unique<RadialVectors>(bodies); }};
}

MethodKind trees() {
  return {"trees",
          "Condyle",
          "trees of boxes and shells",
          {.touch = true, .pairs = true},
          DepthKind::none,
          true,
          [](const Bodies& bodies) { return std::make_unique<Trees>(bodies); }};
}

MethodKind nearest() {
  return {"nearest",
          "Condyle",
          "radial, then the nearest point of each vertex inside",
          {.inside = true},
          DepthKind::nearest_surface,
          true,
          [](const Bodies& bodies) { return std::make_unique<Nearest>(bodies); }};
}

MethodKind two_meshes() {
  return {"two_meshes",
          "Condyle",
          "two meshes without a joint",
          {.depth = true, .first_contact = true},
          DepthKind::none,
          true,
          [](const Bodies& bodies) { return std::make_unique<TwoMeshes>(bodies); }};
}

MethodKind radial(std::string name, std::string title, condyle::radial::DirectionMapKind map) {
  return {std::move(name),
          "Condyle",
          std::move(title),
          {.inside = true, .deforms = true},
          DepthKind::along_ray,
          true,
          [map](const Bodies& bodies) {
            return std::make_unique<Radial>(bodies,
                                            condyle::radial::RadialOptions{.map = map, .cells_per_side = {}});
          }};
}

MethodKind tangential(std::string name, std::string title, condyle::tangential::TangentialRule rule,
                      bool is_exact) {
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
  using condyle::radial::DirectionMapKind, condyle::tangential::TangentialRule;
  return {
      radial_vectors(),
      trees(),
      nearest(),
      two_meshes(),
      radial("radial_plain", "radial, cube map, a vertex at a time", DirectionMapKind::cube),
      radial("radial_cartesian", "radial, the paper's map", DirectionMapKind::cartesian),
      tangential("tangential", "tangential, all crossings in their order", TangentialRule::alternating, true),
      tangential("tangential_nearest_arc", "tangential, the paper's rule", TangentialRule::nearest_arc,
                 false),
  };
}

}  // namespace bench
