#include <CGAL/AABB_face_graph_triangle_primitive.h>
#include <CGAL/AABB_traits.h>
#include <CGAL/AABB_tree.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Rigid_triangle_mesh_collision_detection.h>
#include <CGAL/Side_of_triangle_mesh.h>
#include <CGAL/Surface_mesh.h>
#include <CGAL/box_intersection_d.h>

#include <iterator>

#include "kinds.hpp"

namespace bench {
namespace {

using condyle::Index;
using condyle::Pose;
using condyle::TriMesh;

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Point = Kernel::Point_3;
using Mesh = CGAL::Surface_mesh<Point>;
using VertexPoints = boost::property_map<Mesh, boost::vertex_point_t>::const_type;
/// With the triangles kept in the tree (the last argument), which its manual calls faster and larger.
using Primitive =
    CGAL::AABB_face_graph_triangle_primitive<Mesh, VertexPoints, CGAL::Tag_true, CGAL::Tag_true>;
using Tree = CGAL::AABB_tree<CGAL::AABB_traits<Kernel, Primitive>>;

Point point(const condyle::Vec3& p) {
  return {p.x(), p.y(), p.z()};
}

Mesh surface_mesh(const TriMesh& mesh) {
  Mesh out;
  std::vector<Mesh::Vertex_index> vertex;
  vertex.reserve(mesh.vertices.size());
  for (std::size_t i = 0; i < mesh.vertices.size(); ++i)
    vertex.push_back(out.add_vertex(point(mesh.vertices[i])));
  for (const auto& [a, b, c] : mesh.triangles) out.add_face(vertex[a], vertex[b], vertex[c]);
  return out;
}

struct MeshAndTree {
  explicit MeshAndTree(const TriMesh& triangles)
      : mesh(surface_mesh(triangles)), tree(mesh.faces().begin(), mesh.faces().end(), mesh) {
    tree.build();
  }

  std::size_t tree_bytes() const {
    return tree.size() * (sizeof(CGAL::AABB_node<Tree::AABB_traits>) + sizeof(Primitive));
  }

  Mesh mesh;
  Tree tree;
};

/// The Computational Geometry Algorithms Library, 5.5, with exact predicates: a tree of boxes on the fixed
/// mesh, asked once per mobile triangle or vertex, as its manual shows. A vertex is inside by the parity of a
/// ray's crossings; how deep, by the nearest point of the surface, in double.
///
/// The tree has no way to follow moving vertices: it is built anew.
class CgalTree final : public Method {
 public:
  explicit CgalTree(const Bodies& bodies)
      : mobile_(&bodies.mobile), fixed_(std::make_shared<Fixed>(bodies.fixed)) {}

  bool touch(const Pose& X_FM) override {
    pose(X_FM);
    for (const auto& t : mobile_->triangles)
      if (fixed_->body.tree.do_intersect(triangle(t))) return true;
    return false;
  }

  void find_pairs(const Pose& X_FM, std::vector<condyle::contact::TrianglePair>& out) override {
    pose(X_FM);
    out.clear();
    for (std::size_t t = 0; t < mobile_->triangles.size(); ++t) {
      faces_.clear();
      fixed_->body.tree.all_intersected_primitives(triangle(mobile_->triangles[t]),
                                                   std::back_inserter(faces_));
      for (const Mesh::Face_index face : faces_)
        out.push_back({static_cast<Index>(face), static_cast<Index>(t)});
    }
  }

  void find_inside(const Pose& X_FM, std::vector<InsideVertex>& out) override {
    pose(X_FM);
    out.clear();
    for (std::size_t v = 0; v < posed_.size(); ++v) {
      if (fixed_->side(posed_[v]) == CGAL::ON_UNBOUNDED_SIDE) continue;
      const auto [nearest, face] = fixed_->body.tree.closest_point_and_primitive(posed_[v]);
      out.push_back({static_cast<Index>(v), static_cast<Index>(face),
                     std::sqrt(CGAL::squared_distance(posed_[v], nearest))});
    }
  }

  std::unique_ptr<Method> for_another_thread() override { return std::make_unique<CgalTree>(*this); }

  /// Without the vertices that it keeps, sorted, to begin its search for the nearest point.
  std::size_t bytes() const override { return fixed_->body.tree_bytes(); }

 private:
  struct Fixed {
    explicit Fixed(const TriMesh& mesh) : body(mesh), side(body.tree) {
      body.tree.accelerate_distance_queries();
    }

    MeshAndTree body;
    CGAL::Side_of_triangle_mesh<Mesh, Kernel, VertexPoints, Tree> side;
  };

  void pose(const Pose& X_FM) {
    posed_.resize(mobile_->vertices.size());
    for (std::size_t v = 0; v < posed_.size(); ++v)
      posed_[v] = point(condyle::posed(X_FM, mobile_->vertices[v]));
  }

  Kernel::Triangle_3 triangle(const condyle::Triangle& t) const {
    return {posed_[t[0]], posed_[t[1]], posed_[t[2]]};
  }

  const TriMesh* mobile_;
  std::shared_ptr<const Fixed> fixed_;
  std::vector<Point> posed_;
  std::vector<Mesh::Face_index> faces_;
};

/// CGAL's detection for rigid meshes: both bodies in trees of boxes, those of one moved as they are met.
class CgalRigid final : public Method {
 public:
  explicit CgalRigid(const Bodies& bodies)
      : bodies_(std::make_shared<TwoBodies>(bodies.fixed, bodies.mobile)),
        fixed_(detection_.add_mesh(bodies_->fixed.tree, bodies_->fixed.mesh)),
        mobile_(detection_.add_mesh(bodies_->mobile.tree, bodies_->mobile.mesh)) {}

  bool touch(const Pose& X_FM) override {
    const auto& m = X_FM.matrix();
    detection_.set_transformation(
        mobile_, Kernel::Aff_transformation_3(m(0, 0), m(0, 1), m(0, 2), m(0, 3), m(1, 0), m(1, 1), m(1, 2),
                                              m(1, 3), m(2, 0), m(2, 1), m(2, 2), m(2, 3)));
    return !detection_.get_all_intersections(fixed_).empty();
  }

  std::unique_ptr<Method> for_another_thread() override { return std::make_unique<CgalRigid>(*this); }
  std::size_t bytes() const override { return bodies_->fixed.tree_bytes() + bodies_->mobile.tree_bytes(); }

 private:
  struct TwoBodies {
    TwoBodies(const TriMesh& f, const TriMesh& m) : fixed(f), mobile(m) {}
    MeshAndTree fixed, mobile;
  };

  std::shared_ptr<const TwoBodies> bodies_;
  CGAL::Rigid_triangle_mesh_collision_detection<Mesh, VertexPoints, Kernel, Tree> detection_;
  std::size_t fixed_, mobile_;
};

/// CGAL's intersection of two sets of boxes (Zomorodian and Edelsbrunner 2002), without a tree: what it finds is decided
/// by exact predicates.
class CgalBoxes final : public Method {
 public:
  explicit CgalBoxes(const Bodies& bodies)
      : mobile_(&bodies.mobile), fixed_boxes_(boxes_of(bodies.fixed, Pose::Identity())) {}

  void find_pairs(const Pose& X_FM, std::vector<condyle::contact::TrianglePair>& out) override {
    out.clear();
    mobile_boxes_ = boxes_of(*mobile_, X_FM);
    const auto meet = [&](const Box& f, const Box& m) {
      if (CGAL::do_intersect(f.handle()->triangle, m.handle()->triangle))
        out.push_back({f.handle()->number, m.handle()->number});
    };
    CGAL::box_intersection_d(fixed_boxes_.boxes.begin(), fixed_boxes_.boxes.end(),
                             mobile_boxes_.boxes.begin(), mobile_boxes_.boxes.end(), meet);
  }

 private:
  struct Numbered {
    Kernel::Triangle_3 triangle;
    Index number;
  };
  using Box = CGAL::Box_intersection_d::Box_with_handle_d<double, 3, std::vector<Numbered>::const_iterator>;
  struct Boxes {
    std::vector<Numbered> triangles;
    std::vector<Box> boxes;
  };

  static Boxes boxes_of(const TriMesh& mesh, const Pose& X) {
    const TriMesh in_F = condyle::posed(X, mesh);
    Boxes out;
    for (std::size_t t = 0; t < in_F.triangles.size(); ++t)
      out.triangles.push_back({{point(in_F.corner(t, 0)), point(in_F.corner(t, 1)), point(in_F.corner(t, 2))},
                               static_cast<Index>(t)});
    for (auto t = out.triangles.cbegin(); t != out.triangles.cend(); ++t)
      out.boxes.emplace_back(t->triangle.bbox(), t);
    return out;
  }

  const TriMesh* mobile_;
  Boxes fixed_boxes_, mobile_boxes_;
};

}  // namespace

std::vector<MethodKind> cgal_kinds() {
  return {{"cgal_tree",
           "what people use today",
           "CGAL, tree of boxes, exact predicates",
           {.touch = true, .pairs = true, .inside = true},
           DepthKind::nearest_surface,
           true,
           [](const Bodies& bodies) { return std::make_unique<CgalTree>(bodies); }},
          {"cgal_rigid",
           "what people use today",
           "CGAL, two trees of boxes, exact predicates",
           {.touch = true},
           DepthKind::none,
           true,
           [](const Bodies& bodies) { return std::make_unique<CgalRigid>(bodies); }},
          {"cgal_boxes",
           "what people use today",
           "CGAL, two sets of boxes, exact predicates",
           {.pairs = true},
           DepthKind::none,
           true,
           [](const Bodies& bodies) { return std::make_unique<CgalBoxes>(bodies); }}};
}

}  // namespace bench
