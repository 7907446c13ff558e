#include <openvdb/openvdb.h>
#include <openvdb/tools/Interpolation.h>
#include <openvdb/tools/MeshToVolume.h>

#include <limits>

#include "kinds.hpp"

/// Signed distance field in OpenVDB 10, the sparse volume of film and simulation, read at each mobile vertex.
///
/// meshToVolume computes the distance to the surface at each voxel of the whole inside, so that the deepest
/// vertex has a depth, and of a band outside that trilinear reading needs; its signs come from flooding the
/// outside, not from normals. A vertex is inside where the value interpolated between eight voxels
/// (BoxSampler) is negative, and as deep as it is: features finer than a voxel are rounded off. The field
/// cannot follow a deforming body; it is made anew.

namespace bench {
namespace {

using condyle::Pose;
using openvdb::FloatGrid;

/// OpenVDB's default; two would do for reading between eight voxels.
constexpr float outer_band_voxels = 3;
constexpr float whole_inside = std::numeric_limits<float>::max();

FloatGrid::Ptr signed_distance(const condyle::TriMesh& mesh, double voxel_mm) {
  openvdb::initialize();
  std::vector<openvdb::Vec3s> points;
  for (std::size_t v = 0; v < mesh.vertices.size(); ++v) {
    const condyle::Vec3 p = mesh.vertices[v] / voxel_mm;
    points.emplace_back(p.x(), p.y(), p.z());
  }
  std::vector<openvdb::Vec3I> triangles;
  for (const auto& [a, b, c] : mesh.triangles) triangles.emplace_back(a, b, c);
  const openvdb::tools::QuadAndTriangleDataAdapter<openvdb::Vec3s, openvdb::Vec3I> in_voxels(points,
                                                                                             triangles);
  return openvdb::tools::meshToVolume<FloatGrid>(
      in_voxels, *openvdb::math::Transform::createLinearTransform(voxel_mm), outer_band_voxels, whole_inside);
}

class OpenVdb final : public Method {
 public:
  OpenVdb(const Bodies& bodies, double voxel_mm)
      : mobile_(&bodies.mobile),
        voxel_mm_(voxel_mm),
        field_(signed_distance(bodies.fixed, voxel_mm)),
        box_(field_->evalActiveVoxelBoundingBox()) {}

  void find_inside(const Pose& X_FM, std::vector<InsideVertex>& out) override {
    out.clear();
    posed(X_FM, mobile_->vertices.view(), posed_);
    auto voxels = field_->getConstAccessor();
    const double per_mm = 1 / voxel_mm_;
    const openvdb::Vec3d low = box_.min().asVec3d(), high = box_.max().asVec3d();
    for (std::size_t v = 0; v < posed_.size(); ++v) {
      const openvdb::Vec3d at(posed_.x[v] * per_mm, posed_.y[v] * per_mm, posed_.z[v] * per_mm);
      if (at.x() < low.x() || at.y() < low.y() || at.z() < low.z() || at.x() > high.x() ||
          at.y() > high.y() || at.z() > high.z())
        continue;
      ++samples_;
      const float distance = openvdb::tools::BoxSampler::sample(voxels, at);
      if (distance < 0) out.push_back({static_cast<condyle::Index>(v), condyle::no_index, -distance});
    }
  }

  std::unique_ptr<Method> for_another_thread() override { return std::make_unique<OpenVdb>(*this); }
  std::size_t bytes() const override { return field_->memUsage(); }
  Work work() const override { return {{"samples", samples_}}; }

 private:
  const condyle::TriMesh* mobile_;
  double voxel_mm_;
  FloatGrid::ConstPtr field_;
  openvdb::CoordBBox box_;
  condyle::Points posed_;
  std::int64_t samples_ = 0;
};

MethodKind openvdb(std::string name, std::string title, double voxel_mm) {
  return {std::move(name),
          "distance fields",
          std::move(title),
          {.inside = true},
          DepthKind::nearest_surface,
          false,
          [voxel_mm](const Bodies& bodies) { return std::make_unique<OpenVdb>(bodies, voxel_mm); },
          voxel_mm < 0.75};
}

}  // namespace

std::vector<MethodKind> openvdb_kinds() {
  return {
      openvdb("openvdb_1mm", "OpenVDB signed distance, 1 mm", 1),
      openvdb("openvdb_0.5mm", "OpenVDB signed distance, 0.5 mm", 0.5),
      openvdb("openvdb_0.25mm", "OpenVDB signed distance, 0.25 mm", 0.25),
  };
}

}  // namespace bench
