#include <fmt/format.h>

#include "io/result/contact_terms.hpp"
#include "io/result/depth_parts.hpp"
#include "io/result/pressure_map.hpp"
#include "io/result/provenance_forms.hpp"
#include "io/result/scope_text.hpp"

namespace condyle::io {
namespace {

using View = BodyView<contact::NormalCast>;
using NormalViews = BodyViews<contact::NormalCast>;

NormalViews views(const DepthQuestion& question, const contact::NormalContact& contact) {
  return {question, contact.mobile, contact.fixed};
}

const View& other_of(const NormalViews& bodies, const View& view) {
  return &view == &bodies.mobile ? bodies.fixed : bodies.mobile;
}

/// Where the contact of a body that is in contact has its centre, in F.
Vec3 centre_of(const View& view) {
  return view.frame.fixed_point(posed(view.X_F, *view.summary->surface.totals.centre_of_depth));
}

Json body_json(const NormalViews& bodies, const View& view) {
  if (!view.summary) return nullptr;
  const auto& [surface, cut_off_by_reach] = *view.summary;
  const contact::ContactTotals& totals = surface.totals;
  const contact::FaceContact* deepest = io::deepest_of(surface);
  Json json{{"target", other_of(bodies, view).body.name},
            {"triangles", view.body.mesh.triangles().size()},
            {"triangles_in_contact", totals.triangles},
            {"area_mm2", totals.area_mm2},
            {"mean_normal_depth_mm", totals.mean_depth_mm},
            {"max_normal_depth_mm", totals.max_depth_mm},
            {"deepest_triangle", deepest ? Json(deepest->face) : Json(nullptr)}};
  if (deepest) io::add_triangle_part(json, "deepest_part", view.body, deepest->face);
  const auto& centre = totals.centre_of_depth;
  json["centre_mm"] = centre ? io::numbers(centre_of(view)) : Json(nullptr);
  json["centre_own_mm"] = !centre                   ? Json(nullptr)
                          : &view == &bodies.mobile ? io::numbers(view.frame.mobile_point(*centre))
                                                    : io::numbers(view.frame.fixed_point(*centre));
  json["met_from_front"] = surface.met_from_front;
  json["rim_faces"] = surface.rim_faces;
  json["oblique_area_mm2"] = surface.oblique_area_mm2;
  json["peak_is_oblique"] = surface.peak_is_oblique;
  json["cut_off_by_reach"] = cut_off_by_reach;
  return json;
}

/// The rays that the answer rests on.
ContactEntry rays_of(const DepthAnswer& answer) {
  return {.casting = answer.request.casting.value_or(contact::Casting::both),
          .rays = answer.request.rays.value_or(contact::NormalDepthOptions{})};
}

std::string normal_json(const DepthQuestion& question, const DepthAnswer& answer,
                        const contact::NormalContact& contact) {
  const NormalViews bodies = views(question, contact);
  Json json = io::depth_header(question, answer, "normal");
  json["in_contact"] = contact.in_contact;
  json["triangle_pairs"] = contact.pairs.size();
  json["rays"] = io::contact_caveats(rays_of(answer), false);
  io::add_nearest(json, question, answer.measures);
  for (const auto* view : bodies.both()) json["bodies"][view->key] = body_json(bodies, *view);
  json["scope"] = scope_text(question.joint);
  json["provenance"] = io::provenance_json(question.provenance);
  return io::document(json);
}

std::string body_text(const NormalViews& bodies, const View& view, const contact::NormalDepthOptions& rays) {
  const auto& [surface, cut_off_by_reach] = *view.summary;
  const contact::ContactTotals& totals = surface.totals;
  const std::string& target = other_of(bodies, view).body.name;
  std::string text = fmt::format("  from {} to {}: ", view.body.name, target);
  if (const contact::FaceContact* deepest = io::deepest_of(surface)) {
    text += fmt::format(
        "{:.2f} mm2 of {} triangles, centred {}\n"
        "    depth along normals {:.3f} mm in the mean, {:.3f} at most, triangle {}{}\n",
        totals.area_mm2, totals.triangles, io::place_text(centre_of(view)), totals.mean_depth_mm,
        totals.max_depth_mm, deepest->face, io::triangle_part_text(view.body, deepest->face));
  } else {
    text += "no depth along normals\n";
  }
  if (surface.met_from_front > 0)
    text += fmt::format("    {} rays met {}, which is open, from its front: overlap there may be none\n",
                        surface.met_from_front, target);
  if (surface.rim_faces > 0)
    text += fmt::format("    {} triangles at the rim of {}, cut along it or decided by 16 parts of each\n",
                        surface.rim_faces, target);
  text += io::oblique_text(surface, rays.rule);
  if (cut_off_by_reach > 0)
    text += fmt::format("    the reach of {} mm cuts off {} rays that would be in contact\n", rays.reach_mm,
                        cut_off_by_reach);
  return text;
}

std::string normal_text(const DepthQuestion& question, const DepthAnswer& answer,
                        const contact::NormalContact& contact) {
  const NormalViews bodies = views(question, contact);
  const ContactEntry rays = rays_of(answer);
  std::string text = io::depth_headline(question, answer, contact.pairs.size());
  text += io::contact_caveats_text(rays, {question.joint.fixed, question.joint.mobile}, false);
  bool any_depth = false;
  for (const auto* view : bodies.both()) {
    if (!view->summary) continue;
    text += body_text(bodies, *view, rays.rays);
    any_depth |= view->summary->surface.totals.triangles > 0;
  }
  if (any_depth && !contact.in_contact)
    text += "  the surfaces do not meet: what open ones overlap by may be none\n";
  return text + io::nearest_text(answer.measures);
}

std::vector<MeshArray> arrays_of(const std::optional<contact::NormalCast>& cast, const Body& body) {
  if (!cast) return {};
  return io::pressure_map(cast->surface, body, false);
}

}  // namespace

DepthResult normal_result(const DepthQuestion& question, const DepthAnswer& answer,
                          const contact::NormalContact& contact) {
  const Body &fixed = question.joint.fixed, &mobile = question.joint.mobile;
  const contact::NearestDistances& nearest = answer.measures.distances;
  return {normal_text(question, answer, contact), normal_json(question, answer, contact),
          pairs_csv(question.joint, contact.pairs),
          io::arrays_of(fixed, {nearest_array(nearest.fixed)}, contact.pairs, &contact::TrianglePair::fixed,
                        arrays_of(contact.fixed, fixed)),
          io::arrays_of(mobile, {nearest_array(nearest.mobile)}, contact.pairs,
                        &contact::TrianglePair::mobile, arrays_of(contact.mobile, mobile))};
}

}  // namespace condyle::io
