#include <fcl/geometry/bvh/BVH_model.h>
#include <fcl/narrowphase/collision.h>

#include "kinds.hpp"

namespace bench {
namespace {

using condyle::Index;
using condyle::Pose;
using condyle::TriMesh;

template <class Volume>
class Fcl final : public Method {
 public:
  explicit Fcl(const Bodies& bodies) : fixed_(std::make_shared<Model>()), mobile_(std::make_shared<Model>()) {
    fill(*fixed_, bodies.fixed);
    fill(*mobile_, bodies.mobile);
  }

  bool touch(const Pose& X_FM) override {
    fcl::CollisionResult<double> result;
    return collide(X_FM, 1, false, result) > 0;
  }

  void find_pairs(const Pose& X_FM, std::vector<condyle::TrianglePair>& out) override {
    out.clear();
    fcl::CollisionResult<double> result;
    collide(X_FM, std::numeric_limits<int>::max(), false, result);
    for (std::size_t i = 0; i < result.numContacts(); ++i) {
      const auto& contact = result.getContact(i);
      out.push_back({static_cast<Index>(contact.b1), static_cast<Index>(contact.b2)});
    }
  }

  std::unique_ptr<Method> for_another_thread() override { return std::make_unique<Fcl>(*this); }

 private:
  using Model = fcl::BVHModel<Volume>;

  std::size_t collide(const Pose& X_FM, std::size_t contacts, bool details,
                      fcl::CollisionResult<double>& result) const {
    const fcl::CollisionRequest<double> request(contacts, details);
    return fcl::collide(fixed_.get(), fcl::Transform3d::Identity(), mobile_.get(), X_FM, request, result);
  }

  static void fill(Model& model, const TriMesh& mesh) {
    std::vector<fcl::Vector3d> vertices;
    vertices.reserve(mesh.vertices.size());
    for (std::size_t i = 0; i < mesh.vertices.size(); ++i) vertices.push_back(mesh.vertices[i]);
    std::vector<fcl::Triangle> triangles;
    triangles.reserve(mesh.triangles.size());
    for (const auto& [a, b, c] : mesh.triangles) triangles.emplace_back(a, b, c);
    model.beginModel(static_cast<int>(triangles.size()), static_cast<int>(vertices.size()));
    model.addSubModel(vertices, triangles);
    model.endModel();
  }

  std::shared_ptr<Model> fixed_, mobile_;
};

template <class Volume>
MethodKind kind(std::string name, std::string title) {
  return {std::move(name),
          "bounding volume hierarchies",
          std::move(title),
          {.touch = true, .pairs = true},
          DepthKind::none,
          false,
          [](const Bodies& bodies) { return std::make_unique<Fcl<Volume>>(bodies); }};
}

}  // namespace

std::vector<MethodKind> fcl_kinds() {
  return {
      kind<fcl::OBBRSS<double>>("fcl_obbrss", "FCL, oriented box and swept rectangle"),
  };
}

}  // namespace bench
