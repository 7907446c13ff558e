#include "condyle/io/depth_result_parts.hpp"

#include <fmt/format.h>

#include <cmath>
#include <limits>

namespace condyle {
namespace {

const char* name_of(DepthKind kind) {
  return kind == DepthKind::radial ? "radial" : "tangential";
}

/// One body's vertices against the other body, with where its deepest vertex is in F.
struct BodyView {
  const char* key;
  const Body& body;
  std::optional<RadialBodySummary> summary;
  Pose X_F;  // pose of this body in F

  Vec3 in_fixed_frame(Index vertex) const { return posed(X_F, body.mesh.vertices[vertex]); }
};

std::array<BodyView, 2> views(const DepthQuestion& question, const RadialSummary& summary) {
  return {{{"mobile", question.joint.mobile, summary.mobile, question.X_FM},
           {"fixed", question.joint.fixed, summary.fixed, Pose::Identity()}}};
}

/// The deepest vertex of either body.
struct Deepest {
  const BodyView* view;
  DeepestVertex vertex;
};

template <class Select>
std::optional<Deepest> deepest_of(const std::array<BodyView, 2>& bodies, const Select& select) {
  std::optional<Deepest> deepest;
  for (const BodyView& view : bodies) {
    if (!view.summary) continue;
    const std::optional<DeepestVertex>& candidate = select(*view.summary);
    if (candidate && (!deepest || candidate->depth_mm > deepest->vertex.depth_mm))
      deepest = {&view, *candidate};
  }
  return deepest;
}

const std::optional<DeepestVertex>& any_angle(const RadialBodySummary& summary) {
  return summary.deepest;
}
const std::optional<DeepestVertex>& facing(const RadialBodySummary& summary) {
  return summary.deepest_facing;
}

std::optional<double> min_gap(const std::array<BodyView, 2>& bodies) {
  std::optional<double> gap;
  for (const BodyView& view : bodies) {
    if (view.summary && view.summary->min_gap_mm && (!gap || *view.summary->min_gap_mm < *gap)) {
      gap = view.summary->min_gap_mm;
    }
  }
  return gap;
}

Json body_json(const BodyView& view) {
  if (!view.summary) return nullptr;
  const RadialBodySummary& summary = *view.summary;
  Json json = {
      {"vertices", view.body.mesh.vertices.size()},
      {"vertices_inside", summary.vertices_inside},
      {"vertices_on_surface", summary.vertices_on_surface},
      {"vertices_inside_oblique", summary.oblique_inside},
      {"max_radial_depth_mm", summary.deepest ? summary.deepest->depth_mm : 0.0},
      {"max_facing_radial_depth_mm", summary.deepest_facing ? summary.deepest_facing->depth_mm : 0.0},
      {"min_gap_mm", nullable(summary.min_gap_mm)}};
  json["deepest_vertex"] = summary.deepest ? Json(summary.deepest->vertex) : Json(nullptr);
  return json;
}

}  // namespace

std::string depth_json(const DepthQuestion& question, const RadialContact& contact,
                       const RadialSummary& summary) {
  const auto bodies = views(question, summary);
  const auto& [mobile, fixed] = bodies;
  const auto deepest = deepest_of(bodies, any_angle), meaningful = deepest_of(bodies, facing);
  const auto inside = [](const BodyView& view) {
    return view.summary ? Json(view.summary->vertices_inside) : Json(nullptr);
  };

  Json json = depth_header(question, "radial");
  json["in_contact"] = contact.in_contact;
  json["mobile_vertices_inside"] = inside(mobile);
  json["fixed_vertices_inside"] = inside(fixed);
  json["triangle_pairs"] = contact.pairs.size();
  json["max_radial_depth_mm"] = deepest ? deepest->vertex.depth_mm : 0.0;
  json["max_facing_radial_depth_mm"] = meaningful ? meaningful->vertex.depth_mm : 0.0;
  json["deepest_body"] = deepest ? Json(deepest->view->key) : Json(nullptr);
  json["deepest_vertex"] = deepest ? Json(deepest->vertex.vertex) : Json(nullptr);
  json["deepest_point_mm"] =
      deepest ? numbers(deepest->view->in_fixed_frame(deepest->vertex.vertex)) : Json(nullptr);
  json["deepest_ray_to_normal_deg"] = deepest ? Json(deepest->vertex.ray_to_normal.degrees()) : Json(nullptr);
  json["deepest_shortest_way_out_mm"] = deepest ? Json(deepest->vertex.shortest_way_out_mm) : Json(nullptr);
  json["depth_to_read"] = deepest ? Json(name_of(deepest->vertex.applies())) : Json(nullptr);
  json["min_gap_mm"] = nullable(min_gap(bodies));
  for (const BodyView& view : bodies) json["bodies"][view.key] = body_json(view);
  json["scope"] = scope_note;
  return json.dump(2) + "\n";
}

std::string depth_text(const DepthQuestion& question, const RadialContact& contact,
                       const RadialSummary& summary) {
  const auto bodies = views(question, summary);
  std::string text = depth_headline(question, contact.in_contact, contact.pairs.size());
  for (const BodyView& view : bodies) {
    if (!view.summary) {
      text += fmt::format("  {}: no answer, the other mesh is open and has no inside\n", view.body.name);
      continue;
    }
    text += inside_line(view.body, view.summary->vertices_inside, view.summary->vertices_on_surface);
  }
  if (const auto deepest = deepest_of(bodies, any_angle)) {
    const Vec3 p = deepest->view->in_fixed_frame(deepest->vertex.vertex);
    text += fmt::format(
        "  deepest: {:.3f} mm along the ray, vertex {} of {}, at ({:.2f}, {:.2f}, {:.2f}) mm\n",
        deepest->vertex.depth_mm, deepest->vertex.vertex, deepest->view->body.name, p.x(), p.y(), p.z());
    if (deepest->vertex.applies() == DepthKind::tangential) {
      text += fmt::format(
          "  there it is a length along the bone, not a depth: the nearest surface is {:.3f} mm away; read "
          "the "
          "tangential depth (--method tangential)\n",
          deepest->vertex.shortest_way_out_mm);
      if (const auto meaningful = deepest_of(bodies, facing)) {
        text +=
            fmt::format("  deepest where the surface faces the ray: {:.3f} mm, vertex {} of {}\n",
                        meaningful->vertex.depth_mm, meaningful->vertex.vertex, meaningful->view->body.name);
      }
    }
  }
  if (const auto gap = min_gap(bodies)) text += fmt::format("  smallest gap along a ray: {:.3f} mm\n", *gap);
  return text;
}

std::vector<MeshArray> depth_arrays(const std::optional<RadialHits>& hits) {
  if (!hits) return {};
  const std::size_t count = hits->size();
  std::vector<std::uint8_t> inside(count);
  std::vector<std::int32_t> winding(count), triangle(count);
  std::vector<double> gap(count), angle(count);
  for (std::size_t i = 0; i < count; ++i) {
    inside[i] = hits->state[i] == PointState::inside;
    winding[i] = hits->winding[i];
    triangle[i] = hits->triangle[i] == no_index ? -1 : static_cast<std::int32_t>(hits->triangle[i]);
    gap[i] =
        std::isfinite(hits->radial_gap[i]) ? hits->radial_gap[i] : std::numeric_limits<double>::quiet_NaN();
    angle[i] = Angle::radians(hits->ray_to_normal[i]).degrees();
  }
  return {{"inside", std::move(inside)},
          {"radial_gap_mm", std::move(gap)},
          {"triangle", std::move(triangle)},
          {"winding", std::move(winding)},
          {"ray_to_normal_deg", std::move(angle)}};
}

}  // namespace condyle
