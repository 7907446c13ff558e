#include <fcl/geometry/bvh/BVH_model.h>
#include <fcl/math/bv/utility.h>
#include <fcl/math/motion/interp_motion.h>
#include <fcl/narrowphase/continuous_collision.h>
#include <fcl/narrowphase/detail/traversal/collision/mesh_collision_traversal_node.h>
#include <fcl/narrowphase/detail/traversal/collision_node.h>

#include <algorithm>
#include <type_traits>

#include "kinds.hpp"

namespace bench {
namespace {

using condyle::Index;
using condyle::Pose;
using condyle::TriMesh;

namespace traversal = fcl::detail;

/// Boxes and slabs along the axes cannot turn with their mesh: they are fitted anew at each pose.
template <class Volume>
constexpr bool turns = true;
template <>
constexpr bool turns<fcl::AABB<double>> = false;
template <std::size_t slabs>
constexpr bool turns<fcl::KDOP<double, slabs>> = false;

/// Whether a tree fits anew from its leaves up, each volume about its two children: the library's default,
/// and the cheapest with the query after it. Swept rectangles joined that way do not hold what they should
/// (0.7.0: a refitted tree missed every contact), so that these are fitted from the root down, to their
/// triangles.
template <class Volume>
constexpr bool refits_from_leaves = !std::is_same_v<Volume, fcl::RSS<double>>;

/// How the library walks two trees of these volumes.
template <class Volume>
struct WalkOf {
  using Type = traversal::MeshCollisionTraversalNode<Volume>;
};
template <>
struct WalkOf<fcl::OBB<double>> {
  using Type = traversal::MeshCollisionTraversalNodeOBB<double>;
};
template <>
struct WalkOf<fcl::RSS<double>> {
  using Type = traversal::MeshCollisionTraversalNodeRSS<double>;
};
template <>
struct WalkOf<fcl::OBBRSS<double>> {
  using Type = traversal::MeshCollisionTraversalNodeOBBRSS<double>;
};

/// The Flexible Collision Library, 0.7 (Pan, Chitta, Manocha 2012): a tree of bounding volumes on each body,
/// one triangle in a leaf, with its default splitting, in double.
///
/// We start its walk of two trees as fcl::collide does, without the copy of the mobile model which that makes
/// at each call where the volumes do not turn: there we move one copy that we keep. Its triangle test
/// separates by axes in floating point, with tolerances of its own.
template <class Volume>
class Fcl final : public Method {
 public:
  explicit Fcl(const Bodies& bodies) : fixed_(std::make_shared<Model>()), mobile_(std::make_shared<Model>()) {
    fill(*fixed_, bodies.fixed);
    fill(*mobile_, bodies.mobile);
    if constexpr (!turns<Volume>) keep_resting(*mobile_);
  }

  Fcl(const Fcl& other)
      : fixed_(other.fixed_), mobile_(other.mobile_), resting_(other.resting_), moved_(other.moved_) {
    if constexpr (!turns<Volume>) mobile_ = std::make_shared<Model>(*mobile_);
  }

  bool touch(const Pose& X_FM) override {
    walk(X_FM, {1, false});
    return result_.isCollision();
  }

  void find_pairs(const Pose& X_FM, std::vector<condyle::contact::TrianglePair>& out) override {
    walk(X_FM, {all, false});
    out.clear();
    for (std::size_t i = 0; i < result_.numContacts(); ++i) {
      const auto& contact = result_.getContact(i);
      out.push_back({static_cast<Index>(contact.b1), static_cast<Index>(contact.b2)});
    }
  }

  /// The deepest of all pairs of triangles: the library has a depth of each pair, and none of the bodies.
  BodyDepth find_depth(const Pose& X_FM) override {
    walk(X_FM, {all, true});
    BodyDepth found{result_.isCollision(), 0};
    for (std::size_t i = 0; i < result_.numContacts(); ++i)
      found.depth_mm = std::max(found.depth_mm, result_.getContact(i).penetration_depth);
    return found;
  }

  /// By conservative advancement, which ends at steps of a hundred thousandth of the range.
  std::optional<condyle::Angle> find_first_contact(const condyle::Vec3& axis_F,
                                                   condyle::Angle range) override {
    const Pose start = Pose::Identity(), end(Eigen::AngleAxisd(range.radians(), axis_F));
    const fcl::InterpMotion<double> resting(start, start), rotating(start, end);
    fcl::ContinuousCollisionRequest<double> request;
    request.ccd_solver_type = fcl::CCDC_CONSERVATIVE_ADVANCEMENT;
    fcl::ContinuousCollisionResult<double> found;
    fcl::continuousCollide(fixed_.get(), &resting, mobile_.get(), &rotating, request, found);
    if (!found.is_collide) return std::nullopt;
    return range * found.time_of_contact;
  }

  /// Keeps the tree and fits its volumes anew. Replacing, not updating: that would enclose the vertices
  /// before and after, for contacts between two frames.
  void deform(condyle::PointsView fixed_vertices) override {
    if (fixed_.use_count() > 1) fixed_ = std::make_shared<Model>(*fixed_);
    moved_.resize(fixed_vertices.size());
    for (std::size_t i = 0; i < moved_.size(); ++i) moved_[i] = fixed_vertices[i];
    refit(*fixed_);
  }

  std::unique_ptr<Method> for_another_thread() override { return std::make_unique<Fcl>(*this); }

  /// The two trees; the library's copies of the meshes are left out.
  std::size_t bytes() const override {
    const auto of = [](const Model& model) {
      return model.getNumBVs() * sizeof(fcl::BVNode<Volume>) + model.num_tris * sizeof(unsigned);
    };
    return of(*fixed_) + of(*mobile_);
  }

  Work work() const override {
    return {{"volume tests", volume_tests_}, {"triangle tests", triangle_tests_}};
  }

 private:
  using Model = fcl::BVHModel<Volume>;
  using Walk = typename WalkOf<Volume>::Type;

  static constexpr std::size_t all = std::numeric_limits<std::size_t>::max();

  void walk(const Pose& X_FM, const fcl::CollisionRequest<double>& request) {
    result_.clear();
    Walk node;
    node.enable_statistics = true;
    if constexpr (turns<Volume>) {
      const Model &fixed = *fixed_, &mobile = *mobile_;
      traversal::initialize(node, fixed, Pose::Identity(), mobile, X_FM, request, result_);
    } else {
      moved_.resize(resting_->size());
      for (std::size_t i = 0; i < moved_.size(); ++i) moved_[i] = condyle::posed(X_FM, (*resting_)[i]);
      refit(*mobile_);
      Pose already_posed = Pose::Identity();
      traversal::initialize(node, *fixed_, already_posed, *mobile_, already_posed, request, result_, true,
                            true);
    }
    traversal::collide(&node);
    volume_tests_ += node.num_bv_tests;
    triangle_tests_ += node.num_leaf_tests;
  }

  void refit(Model& model) {
    model.beginReplaceModel();
    model.replaceSubModel(moved_);
    model.endReplaceModel(true, refits_from_leaves<Volume>);
  }

  void keep_resting(const Model& model) {
    resting_ = std::make_shared<Vertices>(model.vertices, model.vertices + model.num_vertices);
  }

  static void fill(Model& model, const TriMesh& mesh) {
    Vertices vertices;
    vertices.reserve(mesh.vertices.size());
    for (std::size_t i = 0; i < mesh.vertices.size(); ++i) vertices.push_back(mesh.vertices[i]);
    std::vector<fcl::Triangle> triangles;
    triangles.reserve(mesh.triangles.size());
    for (const auto& [a, b, c] : mesh.triangles) triangles.emplace_back(a, b, c);
    model.beginModel(static_cast<int>(triangles.size()), static_cast<int>(vertices.size()));
    model.addSubModel(vertices, triangles);
    model.endModel();
  }

  using Vertices = std::vector<fcl::Vector3d>;
  std::shared_ptr<Model> fixed_, mobile_;
  std::shared_ptr<const Vertices> resting_;  ///< In M; where the volumes do not turn.
  Vertices moved_;
  fcl::CollisionResult<double> result_;
  std::int64_t volume_tests_ = 0, triangle_tests_ = 0;
};

template <class Volume>
MethodKind kind(std::string name, std::string title) {
  return {std::move(name),
          "bounding volume hierarchies",
          std::move(title),
          {.touch = true,
           .pairs = true,
           .deforms = true,
           .depth = true,
           .first_contact = std::is_same_v<Volume, fcl::OBBRSS<double>>},
          DepthKind::none,
          false,
          [](const Bodies& bodies) { return std::make_unique<Fcl<Volume>>(bodies); }};
}

}  // namespace

std::vector<MethodKind> fcl_kinds() {
  return {
      kind<fcl::AABB<double>>("fcl_aabb", "FCL, boxes along the axes, refitted at each pose"),
      kind<fcl::OBB<double>>("fcl_obb", "FCL, oriented boxes"),
      kind<fcl::KDOP<double, 18>>("fcl_kdop18", "FCL, 18 slabs, refitted at each pose"),
      kind<fcl::RSS<double>>("fcl_rss", "FCL, swept rectangles"),
      kind<fcl::OBBRSS<double>>("fcl_obbrss", "FCL, oriented boxes and swept rectangles"),
  };
}

}  // namespace bench
