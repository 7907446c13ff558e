#include <BulletCollision/Gimpact/btGImpactCollisionAlgorithm.h>
#include <BulletCollision/Gimpact/btGImpactShape.h>
#include <btBulletCollisionCommon.h>

#include <algorithm>

#include "kinds.hpp"

namespace bench {
namespace {

using condyle::Index;
using condyle::Pose;
using condyle::TriMesh;

btTransform transform(const Pose& X) {
  const auto& m = X.matrix();
  const btMatrix3x3 turn(m(0, 0), m(0, 1), m(0, 2), m(1, 0), m(1, 1), m(1, 2), m(2, 0), m(2, 1), m(2, 2));
  return btTransform(turn, btVector3(m(0, 3), m(1, 3), m(2, 3)));
}

/// A mesh as Bullet wants it: it borrows vertices and indices, and keeps a tree of boxes that it can refit.
class Shape {
 public:
  explicit Shape(const TriMesh& mesh) {
    set(mesh.vertices);
    for (const auto& t : mesh.triangles)
      for (const Index v : t) indices_.push_back(static_cast<int>(v));
    arrays_ = std::make_unique<btTriangleIndexVertexArray>(
        static_cast<int>(mesh.triangles.size()), indices_.data(), 3 * static_cast<int>(sizeof(int)),
        static_cast<int>(mesh.vertices.size()), coordinates_.data(), 3 * static_cast<int>(sizeof(btScalar)));
    shape_ = std::make_unique<btGImpactMeshShape>(arrays_.get());
    shape_->setMargin(0);  // the surface itself, not a skin about it
    shape_->updateBound();
    object_.setCollisionShape(shape_.get());
  }

  void move_vertices(condyle::PointsView vertices) {
    set(vertices);
    shape_->postUpdate();
    shape_->updateBound();
  }

  btCollisionObject& object() { return object_; }

  std::size_t tree_bytes() const {
    return shape_->getMeshPart(0)->getBoxSet()->getNodeCount() * sizeof(BT_QUANTIZED_BVH_NODE);
  }

 private:
  void set(condyle::PointsView vertices) {
    coordinates_.clear();
    for (std::size_t i = 0; i < vertices.size(); ++i)
      coordinates_.insert(coordinates_.end(), {vertices.x[i], vertices.y[i], vertices.z[i]});
  }

  std::vector<btScalar> coordinates_;
  std::vector<int> indices_;
  std::unique_ptr<btTriangleIndexVertexArray> arrays_;
  std::unique_ptr<btGImpactMeshShape> shape_;
  btCollisionObject object_;
};

/// Takes the triangles of every contact point; a pair has up to a handful of points, one after the other.
class Collector final : public btManifoldResult {
 public:
  using btManifoldResult::btManifoldResult;

  void addContactPoint(const btVector3&, const btVector3&, btScalar distance) override {
    depth = std::max(depth, -distance);
    const condyle::contact::TrianglePair pair{static_cast<Index>(m_index0), static_cast<Index>(m_index1)};
    if (pairs.empty() || pairs.back() != pair) pairs.push_back(pair);
  }

  std::vector<condyle::contact::TrianglePair> pairs;
  btScalar depth = 0;  ///< of the deepest contact point
};

/// Bullet 3.24 in double: GImpact meshes, the ones that both may move. Trees of boxes whose corners are
/// rounded to 16 bits, pairs of triangles by clipping one against the other, in floating point.
///
/// A pair is in contact where a part of one triangle lies behind the other, within the prism upon it: all
/// that share a point, and more. Its algorithm for two such meshes is called as its dispatcher does, without
/// a world about them, and always finds all contacts: whether bodies touch costs as much as which triangles
/// do.
class Bullet final : public Method {
 public:
  explicit Bullet(const Bodies& bodies)
      : fixed_(bodies.fixed), mobile_(bodies.mobile), dispatcher_(&configuration_) {
    btGImpactCollisionAlgorithm::registerAlgorithm(&dispatcher_);
  }

  bool touch(const Pose& X_FM) override {
    collide(X_FM, found_);
    return !found_.empty();
  }

  void find_pairs(const Pose& X_FM, std::vector<condyle::contact::TrianglePair>& out) override {
    collide(X_FM, out);
  }

  BodyDepth find_depth(const Pose& X_FM) override {
    const double depth = collide(X_FM, found_);
    return {!found_.empty(), depth};
  }

  void deform(condyle::PointsView fixed_vertices) override { fixed_.move_vertices(fixed_vertices); }

  std::size_t bytes() const override { return fixed_.tree_bytes() + mobile_.tree_bytes(); }

 private:
  /// Returns the depth of the deepest contact point.
  double collide(const Pose& X_FM, std::vector<condyle::contact::TrianglePair>& out) {
    mobile_.object().setWorldTransform(transform(X_FM));
    const auto wrapped = [](btCollisionObject& object) {
      return btCollisionObjectWrapper(nullptr, object.getCollisionShape(), &object,
                                      object.getWorldTransform(), -1, -1);
    };
    const auto fixed = wrapped(fixed_.object()), mobile = wrapped(mobile_.object());
    Collector collector(&fixed, &mobile);
    collector.pairs.swap(out);
    collector.pairs.clear();
    btCollisionAlgorithm* algorithm =
        dispatcher_.findAlgorithm(&fixed, &mobile, nullptr, BT_CONTACT_POINT_ALGORITHMS);
    algorithm->processCollision(&fixed, &mobile, btDispatcherInfo(), &collector);
    algorithm->~btCollisionAlgorithm();
    dispatcher_.freeCollisionAlgorithm(algorithm);
    collector.pairs.swap(out);
    return collector.depth;
  }

  Shape fixed_, mobile_;
  btDefaultCollisionConfiguration configuration_;
  btCollisionDispatcher dispatcher_;
  std::vector<condyle::contact::TrianglePair> found_;
};

}  // namespace

std::vector<MethodKind> bullet_kinds() {
  return {{"bullet_gimpact",
           "what people use today",
           "Bullet, GImpact meshes",
           {.touch = true, .pairs = true, .deforms = true, .depth = true},
           DepthKind::none,
           false,
           [](const Bodies& bodies) { return std::make_unique<Bullet>(bodies); }}};
}

}  // namespace bench
