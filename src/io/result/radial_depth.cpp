#include <fmt/format.h>

#include <cmath>
#include <limits>

#include "condyle/io/pose_text.hpp"
#include "io/result/depth_parts.hpp"
#include "io/result/provenance_forms.hpp"
#include "io/result/scope_text.hpp"

namespace condyle::io {
namespace {

using RadialViews = BodyViews<contact::RadialBodySummary>;

RadialViews views(const DepthQuestion& question, const contact::RadialSummary& summary) {
  return {question, summary.mobile, summary.fixed};
}

auto deepest_of(const RadialViews& bodies) {
  return bodies.deepest(&contact::RadialBodySummary::deepest, &contact::DeepestVertex::depth_mm);
}

/// The deepest of those whose radial depth is a depth.
auto deepest_facing_of(const RadialViews& bodies) {
  return bodies.deepest(&contact::RadialBodySummary::deepest_facing, &contact::DeepestVertex::depth_mm);
}

Json body_json(const BodyView<contact::RadialBodySummary>& view) {
  if (!view.summary) return nullptr;
  const contact::RadialBodySummary& summary = *view.summary;
  return {{"vertices", view.body.mesh.vertices().size()},
          {"vertices_inside", summary.vertices_inside},
          {"vertices_on_surface", summary.vertices_on_surface},
          {"vertices_inside_oblique", summary.oblique_inside},
          {"max_radial_depth_mm", summary.deepest ? summary.deepest->depth_mm : 0.0},
          {"max_facing_radial_depth_mm", summary.deepest_facing ? summary.deepest_facing->depth_mm : 0.0},
          {"deepest_vertex", summary.deepest ? Json(summary.deepest->vertex) : Json(nullptr)},
          {"min_gap_mm", io::nullable(summary.min_gap_mm)}};
}

/// The body whose vertex is deepest by the depth to read, and that vertex.
struct DeepestOf {
  const BodyView<contact::RadialBodySummary>* view = nullptr;
  contact::DeepestReliable vertex;
};

std::optional<DeepestOf> deepest_of(const RadialViews& bodies, const contact::ReliableContact& reliable) {
  const auto deepest = condyle::contact::deepest_of(reliable);
  if (!deepest) return std::nullopt;
  return DeepestOf{deepest->is_mobile ? &bodies.mobile : &bodies.fixed, deepest->vertex};
}

const contact::ExitRotation* rotation_of(const contact::DeepestReliable& vertex) noexcept {
  const auto angle = io::angle_of(vertex.kind);
  return angle ? &*vertex.rotations[static_cast<std::size_t>(*angle)] : nullptr;
}

Json reliable_json(const std::optional<DeepestOf>& deepest, Anatomy joint) {
  if (!deepest) return nullptr;
  const auto& [view, vertex] = *deepest;
  const auto angle = io::angle_of(vertex.kind);
  const contact::ExitRotation* rotation = rotation_of(vertex);
  Json json{{"depth_mm", vertex.depth_mm},
            {"kind", angle ? "tangential" : "radial"},
            {"about", angle ? Json(name_of(*angle, joint)) : Json(nullptr)},
            {"depth_deg", rotation ? Json(rotation->angle.degrees()) : Json(nullptr)},
            {"body", view->key},
            {"vertex", vertex.vertex},
            {"point_mm", io::numbers(view->place_of(vertex.vertex))},
            {"nearest_distance_mm", vertex.nearest_distance_mm},
            {"radial_depth_mm", vertex.radial_depth_mm},
            {"ray_to_normal_deg", vertex.ray_to_normal.degrees()}};
  io::add_part(json, "part", view->body, vertex.vertex);
  for (const JointAngle about : all_joint_angles) {
    const auto& exit = vertex.rotations[static_cast<std::size_t>(about)];
    json["rotations"][name_of(about, joint)] =
        exit ? Json{{"depth_deg", exit->angle.degrees()}, {"depth_mm", exit->arc_mm}} : Json(nullptr);
  }
  return json;
}

std::string rays_json(const DepthQuestion& question, const DepthAnswer& answer, const RayDepths& depths,
                      const contact::RadialSummary& summary) {
  const auto& [contact, reliable] = depths;
  const RadialViews bodies = views(question, summary);
  const auto deepest = deepest_of(bodies);
  const auto facing = deepest_facing_of(bodies);
  Json json = io::depth_header(question, answer,
                               answer.request.method == DepthMethod::reliable ? "reliable" : "radial");
  bodies.add_counts(json, contact.in_contact, contact.pairs.size());
  json["reliable_depth"] = reliable_json(deepest_of(bodies, reliable), question.joint.anatomy);
  json["vertices_without_depth"] = contact::without_depth(reliable);
  io::add_measures(json, question, answer.measures);
  json["max_radial_depth_mm"] = deepest ? deepest->vertex.depth_mm : 0.0;
  json["max_facing_radial_depth_mm"] = facing ? facing->vertex.depth_mm : 0.0;
  io::add_deepest(json, deepest);
  json["deepest_ray_to_normal_deg"] = deepest ? Json(deepest->vertex.ray_to_normal.degrees()) : Json(nullptr);
  json["deepest_shortest_exit_mm"] = deepest ? Json(deepest->vertex.shortest_exit_mm) : Json(nullptr);
  json["depth_to_read"] =
      deepest ? Json(deepest->vertex.radial_is_depth() ? "radial" : "tangential") : Json(nullptr);
  json["min_gap_mm"] = io::nullable(bodies.least(&contact::RadialBodySummary::min_gap_mm));
  for (const auto* view : bodies.both()) json["bodies"][view->key] = body_json(*view);
  json["scope"] = scope_text(question.joint);
  json["provenance"] = io::provenance_json(question.provenance);
  return io::document(json);
}

std::string reliable_text(const DeepestOf& deepest, Anatomy joint, const char* head) {
  const auto& [view, vertex] = deepest;
  const contact::ExitRotation* rotation = rotation_of(vertex);
  const std::string along =
      rotation ? fmt::format("along the arc of {}, {:.3f} deg", name_of(*io::angle_of(vertex.kind), joint),
                             rotation->angle.degrees())
               : "along the ray";
  return fmt::format("{}{:.3f} mm {}, {}, {},\n    {:.3f} mm from its nearest surface\n", head,
                     vertex.depth_mm, along, io::vertex_text(view->body, vertex.vertex),
                     io::place_text(view->place_of(vertex.vertex)), vertex.nearest_distance_mm);
}

std::string rays_text(const DepthQuestion& question, const DepthAnswer& answer, const RayDepths& depths,
                      const contact::RadialSummary& summary) {
  const auto& [contact, reliable] = depths;
  const RadialViews bodies = views(question, summary);
  std::string text = io::depth_headline(question, answer, contact.pairs.size());
  if (const auto deepest = deepest_of(bodies, reliable))
    text += reliable_text(*deepest, question.joint.anatomy, answer.deepest_place ? "    " : "  depth: ");
  if (const std::size_t count = contact::without_depth(reliable); count > 0)
    text += fmt::format("  {} vertices inside have no {}, only a nearest distance\n", count,
                        answer.request.method == DepthMethod::reliable
                            ? "depth along their ray or an arc"
                            : "depth along their ray (--method reliable finds one along an arc)");
  text += io::measures_text(question, answer.measures);
  for (const auto* view : bodies.both()) {
    text += view->summary ? io::inside_line(view->body, view->summary->vertices_inside,
                                            view->summary->vertices_on_surface)
                          : io::open_line(view->body);
  }
  // In contact it would be the gap of whatever vertex is nearest to being inside.
  if (const auto gap = bodies.least(&contact::RadialBodySummary::min_gap_mm); gap && !contact.in_contact)
    text += fmt::format("  smallest gap along a ray: {:.3f} mm\n", *gap);
  return text;
}

std::vector<MeshArray> arrays_of(const std::optional<radial::RadialResults>& results,
                                 const std::vector<double>& nearest,
                                 const std::optional<contact::ReliableDepths>& reliable) {
  if (!results) return {io::nearest_array(nearest)};
  constexpr double none = std::numeric_limits<double>::quiet_NaN();
  const std::size_t count = results->size();
  std::vector<std::uint8_t> inside(count), kind(count), is_reliable(count);
  std::vector<std::int32_t> winding(count), triangle(count);
  std::vector<double> gap(count), depth(count), angle(count);
  for (std::size_t i = 0; i < count; ++i) {
    const double radial_gap =
        std::isfinite(results->radial_gap_mm[i]) ? results->radial_gap_mm[i] + 0.0 : none;
    inside[i] = results->state[i] == PointState::inside;
    kind[i] = static_cast<std::uint8_t>(reliable->kind[i]);
    is_reliable[i] = reliable->kind[i] != contact::DepthKind::nearest;
    gap[i] = radial_gap;
    depth[i] = inside[i] != 0 ? -radial_gap : 0;
    angle[i] = results->ray_to_normal[i].degrees();
    triangle[i] = results->triangle[i] == no_index ? -1 : static_cast<std::int32_t>(results->triangle[i]);
    winding[i] = results->winding[i];
  }
  return {{"depth_mm", reliable->depth_mm},        {"depth_is_reliable", std::move(is_reliable)},
          {"depth_kind", std::move(kind)},         io::nearest_array(nearest),
          {"radial_depth_mm", std::move(depth)},   {"radial_gap_mm", std::move(gap)},
          {"ray_to_normal_deg", std::move(angle)}, {"inside", std::move(inside)},
          {"triangle", std::move(triangle)},       {"winding", std::move(winding)}};
}

}  // namespace

DepthResult ray_result(const DepthQuestion& question, const DepthAnswer& answer, const RayDepths& depths) {
  const auto& [contact, reliable] = depths;
  const contact::NearestDistances& nearest = answer.measures.distances;
  const contact::RadialSummary summary = contact::summarise(contact, nearest);
  return {
      rays_text(question, answer, depths, summary), rays_json(question, answer, depths, summary),
      pairs_csv(question.joint, contact.pairs),
      io::arrays_of(question.joint.fixed, arrays_of(contact.fixed_in_mobile, nearest.fixed, reliable.fixed),
                    contact.pairs, &contact::TrianglePair::fixed),
      io::arrays_of(question.joint.mobile,
                    arrays_of(contact.mobile_in_fixed, nearest.mobile, reliable.mobile), contact.pairs,
                    &contact::TrianglePair::mobile)};
}

}  // namespace condyle::io
