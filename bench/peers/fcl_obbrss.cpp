#include "fcl_obbrss.hpp"

#include <fcl/geometry/bvh/BVH_model.h>
#include <fcl/narrowphase/collision.h>

#include <vector>

namespace bench {
namespace {

using Model = fcl::BVHModel<fcl::OBBRSS<double>>;

void fill(Model& model, const condyle::TriMesh& mesh) {
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

}  // namespace

struct FclObbrss::Models {
  Model fixed, mobile;
};

FclObbrss::FclObbrss(const condyle::TriMesh& fixed, const condyle::TriMesh& mobile)
    : models_(std::make_unique<Models>()) {
  fill(models_->fixed, fixed);
  fill(models_->mobile, mobile);
}

FclObbrss::~FclObbrss() = default;

bool FclObbrss::touch(const condyle::Pose& X_FM) const {
  const fcl::CollisionRequest<double> one_contact_and_no_details(1, false);
  fcl::CollisionResult<double> result;
  return fcl::collide(&models_->fixed, fcl::Transform3d::Identity(), &models_->mobile, X_FM,
                      one_contact_and_no_details, result) > 0;
}

}  // namespace bench
