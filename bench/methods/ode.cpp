#include <ode/ode.h>

#include <algorithm>
#include <cstdarg>

#include "kinds.hpp"

namespace bench {
namespace {

using condyle::Index;
using condyle::Pose;
using condyle::TriMesh;

/// It prints each overflow of its table of contacts to the terminal; the accuracy of the answer shows it to us.
void say_nothing(int, const char*, va_list) {}

/// The library as a whole, for as long as any mesh of it is alive.
class Library {
 public:
  Library() {
    dInitODE2(0);
    dSetMessageHandler(say_nothing);
  }
  ~Library() { dCloseODE(); }
  Library(const Library&) = delete;
  Library& operator=(const Library&) = delete;
};

std::shared_ptr<Library> library() {
  static std::weak_ptr<Library> alive;
  auto shared = alive.lock();
  if (!shared) alive = shared = std::make_shared<Library>();
  return shared;
}

/// A mesh as ODE wants it: it borrows vertices and indices.
class Geometry {
 public:
  explicit Geometry(const TriMesh& mesh) {
    for (std::size_t i = 0; i < mesh.vertices.size(); ++i) {
      const condyle::Vec3 p = mesh.vertices[i];
      coordinates_.insert(coordinates_.end(), {p.x(), p.y(), p.z()});
    }
    for (const auto& t : mesh.triangles) indices_.insert(indices_.end(), t.begin(), t.end());
    data_ = dGeomTriMeshDataCreate();
    dGeomTriMeshDataBuildDouble(data_, coordinates_.data(), 3 * sizeof(double),
                                static_cast<int>(mesh.vertices.size()), indices_.data(),
                                static_cast<int>(indices_.size()), 3 * sizeof(dTriIndex));
    id_ = dCreateTriMesh(nullptr, data_, nullptr, nullptr, nullptr);
  }
  ~Geometry() {
    dGeomDestroy(id_);
    dGeomTriMeshDataDestroy(data_);
  }
  Geometry(const Geometry&) = delete;
  Geometry& operator=(const Geometry&) = delete;

  /// At rest: with its transform a step before being the same. Contact points depend on it.
  void pose(const Pose& X) {
    const auto& m = X.matrix();
    const dMatrix3 rotation = {m(0, 0), m(0, 1), m(0, 2), 0,       m(1, 0), m(1, 1),
                               m(1, 2), 0,       m(2, 0), m(2, 1), m(2, 2), 0};
    dGeomSetRotation(id_, rotation);
    dGeomSetPosition(id_, m(0, 3), m(1, 3), m(2, 3));
    const dMatrix4 before = {m(0, 0), m(1, 0), m(2, 0), 0, m(0, 1), m(1, 1), m(2, 1), 0,
                             m(0, 2), m(1, 2), m(2, 2), 0, m(0, 3), m(1, 3), m(2, 3), 1};
    dGeomTriMeshSetLastTransform(id_, before);
  }

  dGeomID id() const { return id_; }

 private:
  std::vector<double> coordinates_;
  std::vector<dTriIndex> indices_;
  dTriMeshDataID data_;
  dGeomID id_;
};

/// The Open Dynamics Engine 0.16, in double: two triangle meshes, by dCollide. Within it, OPCODE finds the
/// pairs by trees of boxes in single precision, and contact points are made of them one after the other.
///
/// It reports contact points, 65535 at most, with the two triangles of each, and leaves out points that are
/// near to others or that it finds no normal for: bodies that touch are found, of their pairs only a part.
class Ode final : public Method {
 public:
  explicit Ode(const Bodies& bodies) : fixed_(bodies.fixed), mobile_(bodies.mobile) {
    fixed_.pose(Pose::Identity());
  }

  bool touch(const Pose& X_FM) override { return contacts(X_FM, 1 | CONTACTS_UNIMPORTANT) > 0; }

  void find_pairs(const Pose& X_FM, std::vector<condyle::contact::TrianglePair>& out) override {
    const int count = contacts(X_FM, static_cast<int>(contacts_.size()));
    out.clear();
    for (int i = 0; i < count; ++i)
      out.push_back({static_cast<Index>(contacts_[i].side1), static_cast<Index>(contacts_[i].side2)});
    std::sort(out.begin(), out.end());
    out.erase(std::unique(out.begin(), out.end()), out.end());
  }

  /// That of the deepest contact point.
  BodyDepth find_depth(const Pose& X_FM) override {
    const int count = contacts(X_FM, static_cast<unsigned>(contacts_.size()));
    BodyDepth found{count > 0, 0};
    for (int i = 0; i < count; ++i) found.depth_mm = std::max(found.depth_mm, contacts_[i].depth);
    return found;
  }

 private:
  int contacts(const Pose& X_FM, unsigned flags) {
    mobile_.pose(X_FM);
    return dCollide(fixed_.id(), mobile_.id(), static_cast<int>(flags), contacts_.data(),
                    sizeof(dContactGeom));
  }

  std::shared_ptr<Library> library_ = library();
  Geometry fixed_, mobile_;
  std::vector<dContactGeom> contacts_ = std::vector<dContactGeom>(0xffff);
};

}  // namespace

std::vector<MethodKind> ode_kinds() {
  return {{"ode_trimesh",
           "what people use today",
           "ODE, triangle meshes",
           {.touch = true, .pairs = true, .depth = true},
           DepthKind::none,
           false,
           [](const Bodies& bodies) { return std::make_unique<Ode>(bodies); }}};
}

}  // namespace bench
