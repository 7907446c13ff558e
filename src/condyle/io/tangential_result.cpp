#include <fmt/format.h>

#include <array>
#include <cmath>
#include <limits>

#include "condyle/io/depth_result_parts.hpp"
#include "condyle/io/pose_text.hpp"

namespace condyle {
namespace {

/// One body's vertices against the other body.
struct BodyView {
  const char* key;
  const Body& body;
  std::optional<TangentialBodySummary> summary;
  Pose X_F;  // pose of this body in F

  Vec3 in_fixed_frame(Index vertex) const { return posed(X_F, body.mesh.vertices[vertex]); }
};

std::array<BodyView, 2> views(const DepthQuestion& question, const TangentialContact& contact) {
  const auto summary_of = [](const std::optional<TangentialHits>& hits) {
    return hits ? std::optional(summarise(*hits)) : std::nullopt;
  };
  return {{{"mobile", question.joint.mobile, summary_of(contact.mobile_in_fixed), question.X_FM},
           {"fixed", question.joint.fixed, summary_of(contact.fixed_in_mobile), Pose::Identity()}}};
}

/// The vertex of either body that comes first by `less`, of those that `select` offers.
struct Deepest {
  const BodyView* view;
  DeepestTurn turn;
};

template <class Select, class Measure>
std::optional<Deepest> deepest_of(const std::array<BodyView, 2>& bodies, Select select, Measure measure) {
  std::optional<Deepest> deepest;
  for (const BodyView& view : bodies) {
    if (!view.summary) continue;
    const std::optional<DeepestTurn>& candidate = (*view.summary).*select;
    if (candidate && (!deepest || (*candidate).*measure > deepest->turn.*measure))
      deepest = {&view, *candidate};
  }
  return deepest;
}

std::optional<Deepest> longest(const std::array<BodyView, 2>& bodies) {
  return deepest_of(bodies, &TangentialBodySummary::deepest, &DeepestTurn::depth_mm);
}

std::optional<Deepest> largest(const std::array<BodyView, 2>& bodies) {
  return deepest_of(bodies, &TangentialBodySummary::largest_angle, &DeepestTurn::depth);
}

template <class Value>
std::optional<Value> least(const std::array<BodyView, 2>& bodies,
                           std::optional<Value> TangentialBodySummary::*member) {
  std::optional<Value> gap;
  for (const BodyView& view : bodies) {
    if (!view.summary) continue;
    const std::optional<Value>& candidate = (*view.summary).*member;
    if (candidate && (!gap || *candidate < *gap)) gap = candidate;
  }
  return gap;
}

Json degrees_of(const std::optional<Angle>& angle) {
  return angle ? Json(angle->degrees()) : Json(nullptr);
}

Json body_json(const BodyView& view) {
  if (!view.summary) return nullptr;
  const TangentialBodySummary& summary = *view.summary;
  return {{"vertices", view.body.mesh.vertices.size()},
          {"vertices_inside", summary.vertices_inside},
          {"vertices_on_surface", summary.vertices_on_surface},
          {"vertices_without_way_out", summary.without_way_out},
          {"max_tangential_depth_deg", summary.largest_angle ? summary.largest_angle->depth.degrees() : 0.0},
          {"max_tangential_depth_mm", summary.deepest ? summary.deepest->depth_mm : 0.0},
          {"deepest_vertex", summary.deepest ? Json(summary.deepest->vertex) : Json(nullptr)},
          {"min_gap_deg", degrees_of(summary.min_gap)},
          {"min_gap_mm", nullable(summary.min_gap_mm)}};
}

}  // namespace

std::string depth_json(const DepthQuestion& question, const TurnAxis& axis,
                       const TangentialContact& contact) {
  const auto bodies = views(question, contact);
  const auto& [mobile, fixed] = bodies;
  const auto deepest = longest(bodies), furthest = largest(bodies);
  const auto inside = [](const BodyView& view) {
    return view.summary ? Json(view.summary->vertices_inside) : Json(nullptr);
  };

  Json json = depth_header(question, "tangential");
  json["about"] = name_of(axis.about);
  json["axis"] = numbers(axis.direction_F);
  json["in_contact"] = contact.in_contact;
  json["mobile_vertices_inside"] = inside(mobile);
  json["fixed_vertices_inside"] = inside(fixed);
  json["triangle_pairs"] = contact.pairs.size();
  json["max_tangential_depth_deg"] = furthest ? furthest->turn.depth.degrees() : 0.0;
  json["max_tangential_depth_mm"] = deepest ? deepest->turn.depth_mm : 0.0;
  json["deepest_body"] = deepest ? Json(deepest->view->key) : Json(nullptr);
  json["deepest_vertex"] = deepest ? Json(deepest->turn.vertex) : Json(nullptr);
  json["deepest_point_mm"] =
      deepest ? numbers(deepest->view->in_fixed_frame(deepest->turn.vertex)) : Json(nullptr);
  json["min_gap_deg"] = degrees_of(least(bodies, &TangentialBodySummary::min_gap));
  json["min_gap_mm"] = nullable(least(bodies, &TangentialBodySummary::min_gap_mm));
  for (const BodyView& view : bodies) json["bodies"][view.key] = body_json(view);
  json["scope"] = scope_note;
  return json.dump(2) + "\n";
}

std::string depth_text(const DepthQuestion& question, const TurnAxis& axis,
                       const TangentialContact& contact) {
  const auto bodies = views(question, contact);
  std::string text = depth_headline(question, contact.in_contact, contact.pairs.size());
  for (const BodyView& view : bodies) {
    if (!view.summary) {
      text += fmt::format("  {}: no answer, the other mesh is open and has no inside\n", view.body.name);
      continue;
    }
    text += inside_line(view.body, view.summary->vertices_inside, view.summary->vertices_on_surface);
    if (view.summary->without_way_out > 0) {
      text += fmt::format("  {} of them are inside at every angle of {}\n", view.summary->without_way_out,
                          name_of(axis.about));
    }
  }
  const auto line = [&](const char* what, const Deepest& deepest) {
    const Vec3 p = deepest.view->in_fixed_frame(deepest.turn.vertex);
    text += fmt::format(
        "  {}: {:.3f} mm along the arc of {}, {:.3f} deg, vertex {} of {}, at ({:.2f}, {:.2f}, {:.2f}) mm\n",
        what, deepest.turn.depth_mm, name_of(axis.about), deepest.turn.depth.degrees(), deepest.turn.vertex,
        deepest.view->body.name, p.x(), p.y(), p.z());
  };
  const auto deepest = longest(bodies), furthest = largest(bodies);
  if (deepest) line("deepest", *deepest);
  if (furthest && (furthest->view != deepest->view || furthest->turn.vertex != deepest->turn.vertex)) {
    line("largest angle", *furthest);
  }
  if (const auto gap = least(bodies, &TangentialBodySummary::min_gap)) {
    text += fmt::format("  smallest gap by turning: {:.3f} deg\n", gap->degrees());
  }
  return text;
}

std::vector<MeshArray> depth_arrays(const std::optional<TangentialHits>& hits) {
  if (!hits) return {};
  const std::size_t count = hits->size();
  constexpr double none = std::numeric_limits<double>::quiet_NaN();
  std::vector<std::uint8_t> inside(count);
  std::vector<std::int32_t> winding(count), triangle(count);
  std::vector<double> angle(count), arc(count);
  for (std::size_t i = 0; i < count; ++i) {
    const bool reached = std::isfinite(hits->angular_gap[i]);
    inside[i] = hits->state[i] == PointState::inside;
    winding[i] = hits->winding[i];
    triangle[i] = hits->triangle[i] == no_index ? -1 : static_cast<std::int32_t>(hits->triangle[i]);
    // A depth is positive inside: the gap with its sign turned.
    angle[i] = reached ? -Angle::radians(hits->angular_gap[i]).degrees() : none;
    arc[i] = reached ? -hits->arc_gap[i] : none;
  }
  return {{"inside", std::move(inside)},
          {"tangential_depth_deg", std::move(angle)},
          {"tangential_depth_mm", std::move(arc)},
          {"triangle", std::move(triangle)},
          {"winding", std::move(winding)}};
}

}  // namespace condyle
