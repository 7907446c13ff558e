#include <fmt/format.h>

#include <cmath>
#include <limits>

#include "io/result/depth_parts.hpp"
#include "io/result/provenance_forms.hpp"

namespace condyle {
namespace {

using Views = io::BodyViews<RadialBodySummary>;

const char* name_of(DepthKind kind) {
  return kind == DepthKind::radial ? "radial" : "tangential";
}

Views views(const DepthQuestion& question, const RadialSummary& summary) {
  return {question, summary.mobile, summary.fixed};
}

auto deepest_of(const Views& bodies) {
  return bodies.deepest(&RadialBodySummary::deepest, &DeepestVertex::depth_mm);
}

/// The deepest of those whose radial depth is a depth.
auto deepest_facing_of(const Views& bodies) {
  return bodies.deepest(&RadialBodySummary::deepest_facing, &DeepestVertex::depth_mm);
}

io::Json body_json(const io::BodyView<RadialBodySummary>& view) {
  if (!view.summary) return nullptr;
  const RadialBodySummary& summary = *view.summary;
  return {{"vertices", view.body.mesh.vertices().size()},
          {"vertices_inside", summary.vertices_inside},
          {"vertices_on_surface", summary.vertices_on_surface},
          {"vertices_inside_oblique", summary.oblique_inside},
          {"max_radial_depth_mm", summary.deepest ? summary.deepest->depth_mm : 0.0},
          {"max_facing_radial_depth_mm", summary.deepest_facing ? summary.deepest_facing->depth_mm : 0.0},
          {"deepest_vertex", summary.deepest ? io::Json(summary.deepest->vertex) : io::Json(nullptr)},
          {"min_gap_mm", io::nullable(summary.min_gap_mm)}};
}

std::string json_of(const DepthQuestion& question, const RadialContact& contact,
                    const RadialSummary& summary) {
  const Views bodies = views(question, summary);
  const auto deepest = deepest_of(bodies), facing = deepest_facing_of(bodies);
  io::Json json = io::depth_header(question, "radial");
  bodies.add_counts(json, contact.in_contact, contact.pairs.size());
  json["max_radial_depth_mm"] = deepest ? deepest->vertex.depth_mm : 0.0;
  json["max_facing_radial_depth_mm"] = facing ? facing->vertex.depth_mm : 0.0;
  io::add_deepest(json, deepest);
  json["deepest_ray_to_normal_deg"] =
      deepest ? io::Json(deepest->vertex.ray_to_normal.degrees()) : io::Json(nullptr);
  json["deepest_shortest_exit_mm"] = deepest ? io::Json(deepest->vertex.shortest_exit_mm) : io::Json(nullptr);
  json["depth_to_read"] = deepest ? io::Json(name_of(deepest->vertex.applies())) : io::Json(nullptr);
  json["min_gap_mm"] = io::nullable(bodies.least(&RadialBodySummary::min_gap_mm));
  for (const auto* view : bodies.both()) json["bodies"][view->key] = body_json(*view);
  json["scope"] = io::scope_note;
  json["provenance"] = io::provenance_json(question.provenance);
  return io::document(json);
}

std::string text_of(const DepthQuestion& question, const RadialContact& contact,
                    const RadialSummary& summary) {
  const Views bodies = views(question, summary);
  std::string text = io::depth_headline(question, contact.in_contact, contact.pairs.size());
  for (const auto* view : bodies.both()) {
    text += view->summary ? io::inside_line(view->body, view->summary->vertices_inside,
                                            view->summary->vertices_on_surface)
                          : io::open_line(view->body);
  }
  if (const auto deepest = deepest_of(bodies)) {
    text += fmt::format("  deepest: {:.3f} mm along the ray, vertex {} of {}, {}\n", deepest->vertex.depth_mm,
                        deepest->vertex.vertex, deepest->view->body.name,
                        io::place_text(deepest->view->place_of(deepest->vertex.vertex)));
    if (deepest->vertex.applies() == DepthKind::tangential) {
      text += fmt::format(
          "  there it is a length along the bone, not a depth: the nearest surface is {:.3f} mm away; read "
          "the tangential depth (--method tangential)\n",
          deepest->vertex.shortest_exit_mm);
      if (const auto facing = deepest_facing_of(bodies)) {
        text += fmt::format("  deepest where the surface faces the ray: {:.3f} mm, vertex {} of {}\n",
                            facing->vertex.depth_mm, facing->vertex.vertex, facing->view->body.name);
      }
    }
  }
  if (const auto gap = bodies.least(&RadialBodySummary::min_gap_mm)) {
    text += fmt::format("  smallest gap along a ray: {:.3f} mm\n", *gap);
  }
  return text;
}

std::vector<MeshArray> arrays_of(const std::optional<RadialResults>& results) {
  if (!results) return {};
  const std::size_t count = results->size();
  std::vector<std::uint8_t> inside(count);
  std::vector<std::int32_t> winding(count), triangle(count);
  std::vector<double> gap(count), angle(count);
  for (std::size_t i = 0; i < count; ++i) {
    inside[i] = results->state[i] == PointState::inside;
    winding[i] = results->winding[i];
    triangle[i] = results->triangle[i] == no_index ? -1 : static_cast<std::int32_t>(results->triangle[i]);
    gap[i] = std::isfinite(results->radial_gap_mm[i]) ? results->radial_gap_mm[i]
                                                      : std::numeric_limits<double>::quiet_NaN();
    angle[i] = results->ray_to_normal[i].degrees();
  }
  return {{"inside", std::move(inside)},
          {"radial_gap_mm", std::move(gap)},
          {"triangle", std::move(triangle)},
          {"winding", std::move(winding)},
          {"ray_to_normal_deg", std::move(angle)}};
}

}  // namespace

DepthResult depth_result(const DepthQuestion& question, const RadialContact& contact,
                         const RadialSummary& summary) {
  return {text_of(question, contact, summary), json_of(question, contact, summary),
          io::pairs_csv(contact.pairs),
          io::arrays_of(question.joint.fixed, arrays_of(contact.fixed_in_mobile), contact.pairs,
                        &TrianglePair::fixed),
          io::arrays_of(question.joint.mobile, arrays_of(contact.mobile_in_fixed), contact.pairs,
                        &TrianglePair::mobile)};
}

}  // namespace condyle
