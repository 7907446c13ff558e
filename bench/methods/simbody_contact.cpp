#include "simbody_contact.hpp"

#include <SimTKmath.h>

#include <set>

namespace bench {
namespace {

SimTK::ContactGeometry::TriangleMesh geometry_of(const PlainMesh& mesh) {
  SimTK::Array_<SimTK::Vec3> vertices;
  for (std::size_t i = 0; i < mesh.coordinates.size(); i += 3)
    vertices.push_back({mesh.coordinates[i], mesh.coordinates[i + 1], mesh.coordinates[i + 2]});
  const SimTK::Array_<int> corners(mesh.corners.begin(), mesh.corners.end());
  return {vertices, corners};
}

}  // namespace

struct SimbodyContact::Meshes {
  Meshes(const PlainMesh& f, const PlainMesh& m) : fixed(geometry_of(f)), mobile(geometry_of(m)) {}

  SimTK::ContactGeometry::TriangleMesh fixed, mobile;
  SimTK::ContactTracker::TriangleMeshTriangleMesh tracker;
  SimTK::UntrackedContact not_seen_before{SimTK::ContactSurfaceIndex(0), SimTK::ContactSurfaceIndex(1)};
  std::vector<int> buried;
};

SimbodyContact::SimbodyContact(const PlainMesh& fixed, const PlainMesh& mobile)
    : meshes_(std::make_unique<Meshes>(fixed, mobile)) {}
SimbodyContact::~SimbodyContact() = default;

const std::vector<int>& SimbodyContact::buried_mobile_triangles(const PoseRows& X_FM) {
  const auto& [x, y, z] = X_FM;
  const SimTK::Mat33 turn(x[0], x[1], x[2], y[0], y[1], y[2], z[0], z[1], z[2]);
  const SimTK::Transform X(SimTK::Rotation(turn, true), SimTK::Vec3(x[3], y[3], z[3]));
  SimTK::Contact found;
  meshes_->tracker.trackContact(meshes_->not_seen_before, SimTK::Transform(), meshes_->fixed, X,
                                meshes_->mobile, 0, found);
  meshes_->buried.clear();
  if (!found.isEmpty() && SimTK::TriangleMeshContact::isInstance(found)) {
    const std::set<int>& faces = SimTK::TriangleMeshContact::getAs(found).getSurface2Faces();
    meshes_->buried.assign(faces.begin(), faces.end());
  }
  return meshes_->buried;
}

SimbodyContact::Nearest SimbodyContact::nearest(const std::array<double, 3>& point) const {
  const SimTK::Vec3 p(point[0], point[1], point[2]);
  Nearest answer{};
  SimTK::Vec2 uv;
  const SimTK::Vec3 at = meshes_->fixed.findNearestPoint(p, answer.is_inside, answer.triangle, uv);
  answer.distance = (at - p).norm();
  return answer;
}

}  // namespace bench
