#include <fmt/format.h>

#include <cmath>
#include <limits>

#include "condyle/io/pose_text.hpp"
#include "io/result/depth_parts.hpp"
#include "io/result/provenance_forms.hpp"
#include "io/result/scope_text.hpp"

namespace condyle::io {
namespace {

using ArcViews = BodyViews<contact::TangentialBodySummary>;
using Deepest = ArcViews::Deepest<contact::DeepestRotation>;

ArcViews views(const DepthQuestion& question, const contact::TangentialContact& contact) {
  const auto summary_of = [](const std::optional<tangential::TangentialResults>& results) {
    return results ? std::optional(contact::summarise(*results)) : std::nullopt;
  };
  return {question, summary_of(contact.mobile_in_fixed), summary_of(contact.fixed_in_mobile)};
}

std::optional<Deepest> longest(const ArcViews& bodies) {
  return bodies.deepest(&contact::TangentialBodySummary::deepest, &contact::DeepestRotation::depth_mm);
}

std::optional<Deepest> largest(const ArcViews& bodies) {
  return bodies.deepest(&contact::TangentialBodySummary::largest_angle, &contact::DeepestRotation::depth);
}

Json degrees_of(const std::optional<Angle>& angle) {
  return angle ? Json(angle->degrees()) : Json(nullptr);
}

Json body_json(const BodyView<contact::TangentialBodySummary>& view) {
  if (!view.summary) return nullptr;
  const contact::TangentialBodySummary& summary = *view.summary;
  return {{"vertices", view.body.mesh.vertices().size()},
          {"vertices_inside", summary.vertices_inside},
          {"vertices_on_surface", summary.vertices_on_surface},
          {"vertices_without_exit", summary.without_exit},
          {"max_tangential_depth_deg", summary.largest_angle ? summary.largest_angle->depth.degrees() : 0.0},
          {"max_tangential_depth_mm", summary.deepest ? summary.deepest->depth_mm : 0.0},
          {"deepest_vertex", summary.deepest ? Json(summary.deepest->vertex) : Json(nullptr)},
          {"min_gap_deg", degrees_of(summary.min_gap)},
          {"min_gap_mm", io::nullable(summary.min_gap_mm)}};
}

/// "flexion", or a line, in the frame of the answer.
std::string about_text(const DepthQuestion& question, const RotationAxis& axis) {
  if (axis.about) return std::string(name_of(*axis.about, question.joint.anatomy));
  const Vec3 along = question.frame().fixed_direction(axis.direction_F),
             through = question.frame().fixed_point(axis.point_F);
  return fmt::format("the axis ({:.4g}, {:.4g}, {:.4g}) through ({:.4g}, {:.4g}, {:.4g}) mm", along.x(),
                     along.y(), along.z(), through.x(), through.y(), through.z());
}

std::string deepest_line(const char* what, std::string_view about, const Deepest& deepest) {
  return fmt::format("  {}: {:.3f} mm along the arc of {}, {:.3f} deg, {}, {}\n", what,
                     deepest.vertex.depth_mm, about, deepest.vertex.depth.degrees(), deepest.vertex.vertex,
                     deepest.view->body.name, io::place_text(deepest.view->place_of(deepest.vertex.vertex)));
}

std::string arcs_json(const DepthQuestion& question, const DepthAnswer& answer, const ArcDepths& depths) {
  Json json = io::depth_header(question, answer, "tangential");
  io::add_arcs(json, question, depths, &answer.measures);
  json["scope"] = scope_text(question.joint);
  json["provenance"] = io::provenance_json(question.provenance);
  return io::document(json);
}

std::string arcs_text(const DepthQuestion& question, const DepthAnswer& answer, const ArcDepths& depths) {
  const auto& [axis, contact] = depths;
  const ArcViews bodies = views(question, contact);
  const std::string about = about_text(question, axis);
  std::string text = io::depth_headline(question, answer, contact.pairs.size());
  text += io::deepest_arcs_text(question, depths);
  text += io::measures_text(question, answer.measures);
  for (const auto* view : bodies.both()) {
    if (!view->summary) {
      text += io::open_line(view->body);
      continue;
    }
    text += io::inside_line(view->body, view->summary->vertices_inside, view->summary->vertices_on_surface);
    if (view->summary->without_exit > 0) {
      text +=
          fmt::format("  {} of them are inside at every angle of {}\n", view->summary->without_exit, about);
    }
  }
  if (const auto gap = bodies.least(&contact::TangentialBodySummary::min_gap); gap && !contact.in_contact) {
    text += fmt::format("  smallest gap by rotating: {:.3f} deg\n", gap->degrees());
  }
  return text;
}

std::vector<MeshArray> arrays_of(const std::optional<tangential::TangentialResults>& results,
                                 const std::vector<double>& nearest) {
  if (!results) return {io::nearest_array(nearest)};
  const std::size_t count = results->size();
  constexpr double none = std::numeric_limits<double>::quiet_NaN();
  std::vector<std::uint8_t> inside(count), is_reliable(count);
  std::vector<std::int32_t> winding(count), triangle(count);
  std::vector<double> depth(count), angle_depth(count), arc_depth(count), angle_gap(count), arc_gap(count);
  for (std::size_t i = 0; i < count; ++i) {
    const bool reached = std::isfinite(results->angular_gap[i].radians());
    inside[i] = results->state[i] == PointState::inside;
    winding[i] = results->winding[i];
    triangle[i] = results->triangle[i] == no_index ? -1 : static_cast<std::int32_t>(results->triangle[i]);
    angle_gap[i] = reached ? results->angular_gap[i].degrees() + 0.0 : none;
    arc_gap[i] = reached ? results->arc_gap_mm[i] + 0.0 : none;
    is_reliable[i] = inside[i] == 0 || reached;
    if (inside[i] == 0) continue;
    angle_depth[i] = -angle_gap[i];
    arc_depth[i] = -arc_gap[i];
    depth[i] = reached ? arc_depth[i] : nearest[i];
  }
  return {{"depth_mm", std::move(depth)},
          {"depth_is_reliable", std::move(is_reliable)},
          io::nearest_array(nearest),
          {"tangential_depth_mm", std::move(arc_depth)},
          {"tangential_depth_deg", std::move(angle_depth)},
          {"tangential_gap_mm", std::move(arc_gap)},
          {"tangential_gap_deg", std::move(angle_gap)},
          {"inside", std::move(inside)},
          {"triangle", std::move(triangle)},
          {"winding", std::move(winding)}};
}

}  // namespace

void add_arcs(Json& json, const DepthQuestion& question, const ArcDepths& depths,
              const contact::ContactMeasures* measures) {
  const auto& [axis, contact] = depths;
  const ArcViews bodies = views(question, contact);
  const auto deepest = longest(bodies), furthest = largest(bodies);
  json["about"] = axis.about ? Json(name_of(*axis.about, question.joint.anatomy)) : Json(nullptr);
  json["axis"] = io::numbers(question.frame().fixed_direction(axis.direction_F));
  json["axis_point_mm"] = io::numbers(question.frame().fixed_point(axis.point_F));
  bodies.add_counts(json, contact.in_contact, contact.pairs.size());
  if (measures) io::add_measures(json, question, *measures);
  json["max_tangential_depth_deg"] = furthest ? furthest->vertex.depth.degrees() : 0.0;
  json["max_tangential_depth_mm"] = deepest ? deepest->vertex.depth_mm : 0.0;
  io::add_deepest(json, deepest);
  json["min_gap_deg"] = degrees_of(bodies.least(&contact::TangentialBodySummary::min_gap));
  json["min_gap_mm"] = io::nullable(bodies.least(&contact::TangentialBodySummary::min_gap_mm));
  for (const auto* view : bodies.both()) json["bodies"][view->key] = body_json(*view);
}

std::string deepest_arcs_text(const DepthQuestion& question, const ArcDepths& depths) {
  const ArcViews bodies = views(question, depths.contact);
  const std::string about = about_text(question, depths.axis);
  const auto deepest = longest(bodies), furthest = largest(bodies);
  std::string text = deepest ? deepest_line("deepest", about, *deepest) : "";
  if (furthest && (furthest->view != deepest->view || furthest->vertex.vertex != deepest->vertex.vertex))
    text += deepest_line("largest angle", about, *furthest);
  return text;
}

DepthResult arc_result(const DepthQuestion& question, const DepthAnswer& answer, const ArcDepths& depths) {
  const contact::TangentialContact& contact = depths.contact;
  const contact::NearestDistances& nearest = answer.measures.distances;
  return {arcs_text(question, answer, depths), arcs_json(question, answer, depths),
          pairs_csv(question.joint, contact.pairs),
          io::arrays_of(question.joint.fixed, arrays_of(contact.fixed_in_mobile, nearest.fixed),
                        contact.pairs, &contact::TrianglePair::fixed),
          io::arrays_of(question.joint.mobile, arrays_of(contact.mobile_in_fixed, nearest.mobile),
                        contact.pairs, &contact::TrianglePair::mobile)};
}

}  // namespace condyle::io
