#pragma once

#include <array>
#include <optional>
#include <string>

#include "io/result/depth_result.hpp"
#include "io/result/json.hpp"

/// Common parts of the results of all methods.

namespace condyle::io {

/// The question and the answers that do not depend on the method.
Json depth_header(const DepthQuestion& question, const DepthAnswer& answer, const char* method);

/// "right hip: femur in hip bone, flexion 90, ...", and whether they touch; two lines.
std::string depth_headline(const DepthQuestion& question, const DepthAnswer& answer, std::size_t pairs);

/// The part of the body that a vertex is of and its number there, under this key; nothing if the body is one mesh.
void add_part(Json& json, const char* key, const Body& body, Index vertex);

/// "vertex 12 of femur", and of which part of it where it has several.
std::string vertex_text(const Body& body, Index vertex);

/// "  femur: 25 of 7349 vertices inside" and what is worth saying besides; one line.
std::string inside_line(const Body& body, std::size_t inside, std::size_t on_surface);

/// One body's vertices against the other body; without a summary where the other mesh is open.
template <class Summary>
struct BodyView {
  const char* key;
  const Body& body;
  std::optional<Summary> summary;
  Pose X_F;  // pose of this body in F
  AnswerFrame frame;

  Vec3 place_of(Index vertex) const { return frame.fixed_point(posed(X_F, body.mesh.vertices()[vertex])); }
};

/// Both bodies of a result.
template <class Summary>
struct BodyViews {
  BodyView<Summary> mobile, fixed;

  BodyViews(const DepthQuestion& question, std::optional<Summary> of_mobile, std::optional<Summary> of_fixed)
      : mobile{"mobile", question.joint.mobile, std::move(of_mobile), question.X_FM, question.frame()},
        fixed{"fixed", question.joint.fixed, std::move(of_fixed), Pose::Identity(), question.frame()} {}
  std::array<const BodyView<Summary>*, 2> both() const { return {&mobile, &fixed}; }

  /// The least of one measured gap over both bodies.
  template <class Value>
  std::optional<Value> least(std::optional<Value> Summary::*gap) const {
    std::optional<Value> least;
    for (const auto* view : both()) {
      if (!view->summary) continue;
      const std::optional<Value>& candidate = (*view->summary).*gap;
      if (candidate && (!least || *candidate < *least)) least = candidate;
    }
    return least;
  }

  /// The vertex of either body that is deepest by `measure`, of those that `candidate` offers.
  template <class Vertex>
  struct Deepest {
    const BodyView<Summary>* view;
    Vertex vertex;
  };
  template <class Vertex, class Measure>
  std::optional<Deepest<Vertex>> deepest(std::optional<Vertex> Summary::*candidate,
                                         Measure Vertex::*measure) const {
    std::optional<Deepest<Vertex>> deepest;
    for (const auto* view : both()) {
      if (!view->summary) continue;
      const std::optional<Vertex>& offered = (*view->summary).*candidate;
      if (offered && (!deepest || (*offered).*measure > deepest->vertex.*measure)) deepest = {view, *offered};
    }
    return deepest;
  }

  /// The counts that methods with an inside give, under the keys of docs/depths.md.
  void add_counts(Json& json, bool in_contact, std::size_t pairs) const {
    const auto inside = [](const BodyView<Summary>& view) {
      return view.summary ? Json(view.summary->vertices_inside) : Json(nullptr);
    };
    json["in_contact"] = in_contact;
    json["mobile_vertices_inside"] = inside(mobile);
    json["fixed_vertices_inside"] = inside(fixed);
    json["triangle_pairs"] = pairs;
  }
};

/// Where the deepest vertex is, under the keys of docs/depths.md; nulls where there is none.
template <class Deepest>
void add_deepest(Json& json, const std::optional<Deepest>& deepest) {
  json["deepest_body"] = deepest ? Json(deepest->view->key) : Json(nullptr);
  json["deepest_vertex"] = deepest ? Json(deepest->vertex.vertex) : Json(nullptr);
  if (deepest) add_part(json, "deepest_part", deepest->view->body, deepest->vertex.vertex);
  json["deepest_point_mm"] =
      deepest ? numbers(deepest->view->place_of(deepest->vertex.vertex)) : Json(nullptr);
}

/// "at (17.97, 20.65, 8.54) mm".
std::string place_text(const Vec3& p);

/// Areas, volume and nearest distance, one line each for those there are; and under the keys of docs/depths.md.
std::string measures_text(const DepthQuestion& question, const contact::ContactMeasures& measures);
void add_measures(Json& json, const DepthQuestion& question, const contact::ContactMeasures& measures);

/// The nearest distance only, out of all measures.
std::string nearest_text(const contact::ContactMeasures& measures);
void add_nearest(Json& json, const DepthQuestion& question, const contact::ContactMeasures& measures);

/// Nearest distances as the one array that a body has where the other mesh is open.
MeshArray nearest_array(const std::vector<double>& distances);

/// Arrays of one body, with those of its triangles marked that are in a pair.
DepthArrays arrays_of(const Body& body, std::vector<MeshArray> points,
                      const std::vector<contact::TrianglePair>& pairs, Index contact::TrianglePair::*triangle,
                      std::vector<MeshArray> triangles = {});

/// Intersecting triangle pairs as CSV text with a header line; with their parts where a body has several.
std::string pairs_csv(const Joint& joint, const std::vector<contact::TrianglePair>& pairs);

/// Why a body has no figures; one line.
std::string open_line(const Body& body);

/// The angle about whose axis a depth of this kind goes; empty for those along a line.
std::optional<JointAngle> angle_of(contact::DepthKind kind) noexcept;

/// Adds the line of the axis, the contact's measures if there are any, the largest depths along arcs and the least gaps, under the keys
/// of docs/depths.md.
void add_arcs(Json& json, const DepthQuestion& question, const ArcDepths& depths,
              const contact::ContactMeasures* measures = nullptr);
/// Lines that say where the largest depths along arcs are.
std::string deepest_arcs_text(const DepthQuestion& question, const ArcDepths& depths);

/// depth_result() of each method.
DepthResult ray_result(const DepthQuestion& question, const DepthAnswer& answer, const RayDepths& depths);
DepthResult arc_result(const DepthQuestion& question, const DepthAnswer& answer, const ArcDepths& depths);
DepthResult normal_result(const DepthQuestion& question, const DepthAnswer& answer,
                          const contact::NormalContact& contact);

}  // namespace condyle::io
