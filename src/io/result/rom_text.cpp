#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <string_view>
#include <utility>
#include <vector>

#include "answer/living_limit.hpp"
#include "answer/motion_caveats.hpp"
#include "condyle/io/pose_text.hpp"
#include "condyle/joint_checks.hpp"
#include "core/rounded.hpp"
#include "io/result/clock_text.hpp"
#include "io/result/json.hpp"
#include "io/result/limit_files.hpp"
#include "io/result/map_result.hpp"
#include "io/result/parameters.hpp"
#include "io/result/quoted_limit.hpp"
#include "io/result/rom_parts.hpp"
#include "io/result/rom_result.hpp"
#include "io/result/scope_text.hpp"
#include "io/result/text_table.hpp"

namespace condyle::io {
namespace {

/// What does not count and by which numbers; in brief only if it is not as usual.
std::string bearing_text(const RomResult& result, TextForm form) {
  const auto& surface = result.answer.bearing.surface;
  if (!surface)
    return result.answer.bearing.roles.mobile.empty()
               ? fmt::format("  every contact counts: {}\n", result.answer.bearing.why_none)
               : "";
  const bool counts = result.answer.bearing_rule == motion::BearingRule::count;
  const bool is_beside = surface->beside_gap_mm &&
                         *surface->beside_gap_mm <
                             by_head(motion::usual_bearing_margin_mm + motion::rim_reserve_mm, surface->head);
  if (form == TextForm::brief && surface->rim_gap_mm && !counts && !is_beside && surface->parts.empty())
    return "";
  const std::string rim = surface->rim_gap_mm ? fmt::format(", rim {:.2f} mm from it", *surface->rim_gap_mm)
                          : !surface->parts.empty() ? ""
                          : surface->margin_mm == by_head(motion::usual_bearing_margin_mm, surface->head)
                              ? ", no rim was found: the usual margin"
                              : ", no rim was found";
  const std::string within = fmt::format("within {:.2f} mm of the head's sphere", surface->margin_mm);
  const std::string extent = surface->parts.empty()
                                 ? within
                                 : fmt::format("{}, as the joint file says, and what lies {}",
                                               fmt::join(surface->parts, " and "), within);
  const std::string beside = is_beside ? fmt::format(", {} {:.2f} mm beside its socket",
                                                     result.joint.fixed.name, *surface->beside_gap_mm)
                                       : "";
  const std::string of_all = form == TextForm::brief
                                 ? ""
                                 : fmt::format("{} of {} triangles of {}, ", surface->count(),
                                               surface->triangles.size(), result.joint.mobile.name);
  return fmt::format("  bearing surface: {}{}\n    ({} {:.2f} mm{}{}); contact on it {}\n", of_all, extent,
                     surface->parts.empty() ? "radius" : "its sphere has radius", surface->head.radius, rim,
                     beside, counts ? "counts" : "does not end a motion");
}

/// A line for each word that the joint file has for meshes other than bone.
std::string meshes_text(const RomResult& result) {
  const auto meshes_of = [](const Body& body, PartContact contact) {
    std::vector<std::string_view> names;
    for (const BodyPart& part : body.parts)
      if (part.contact == contact) names.push_back(part.name);
    return names;
  };
  const Body &fixed = result.joint.fixed, &mobile = result.joint.mobile;
  std::string text;
  // The bearing surface names its meshes itself.
  if (!result.answer.bearing.surface || has_part(fixed, PartContact::bearing)) {
    const auto of_mobile = meshes_of(mobile, PartContact::bearing),
               of_fixed = meshes_of(fixed, PartContact::bearing);
    const std::string on = of_fixed.empty() ? fixed.name : fmt::format("{}", fmt::join(of_fixed, " and "));
    if (!of_mobile.empty())
      text += fmt::format(
          "  bearing: {} slides on {}; contact of the two {}\n", fmt::join(of_mobile, " and "), on,
          result.answer.bearing_rule == motion::BearingRule::count ? "counts" : "does not end a motion");
  }
  std::vector<std::string_view> soft = meshes_of(fixed, PartContact::soft);
  for (const std::string_view name : meshes_of(mobile, PartContact::soft)) soft.push_back(name);
  if (!soft.empty())
    text += fmt::format("  soft: {}; contact on it does not end a motion\n", fmt::join(soft, " and "));
  return text;
}

std::string_view words_of(const motion::MotionLimit& limit) noexcept {
  if (limit.translation_ends)
    return limit.translation_mm ? "no contact, translation ends" : "unknown: load not carried";
  switch (limit.end.reason) {
    case motion::LimitReason::contact:
      switch (limit.end.kind()) {
        case motion::ContactKind::bearing:
          return "bearing contact";
        case motion::ContactKind::impingement:
          return "impingement";
        case motion::ContactKind::cut:
          return "cut of image: no limit";
        case motion::ContactKind::soft:
          return "soft contact";
        case motion::ContactKind::unknown:
          return "contact";
      }
      return "";
    case motion::LimitReason::end_of_range:
      return "no contact in range";
    case motion::LimitReason::contact_at_start:
      return "in contact at start";
    case motion::LimitReason::ligament:
      return "ligament";
    case motion::LimitReason::strained_at_start:
      return "ligament, at start";
  }
  return "";
}

/// The contact that a motion is listed by, null if it has none.
using ContactOf = const motion::ContactWitness* (*)(const motion::MotionLimit& limit);

const motion::ContactWitness* end_of(const motion::MotionLimit& limit) {
  return limit.end.contact ? &*limit.end.contact : nullptr;
}
const motion::ContactWitness* soft_contact_of(const motion::MotionLimit& limit) {
  const auto& soft = limit.end.soft_contact;
  return soft && soft->contact ? &*soft->contact : nullptr;
}

/// Names of motions under a heading each, in the order of their first ones: a line per heading.
class MotionGroups {
 public:
  void add(const std::string& heading, std::string motion) {
    const auto same = std::find_if(groups_.begin(), groups_.end(),
                                   [&](const auto& group) { return group.first == heading; });
    (same == groups_.end() ? groups_.emplace_back(heading, std::vector<std::string>()) : *same)
        .second.push_back(std::move(motion));
  }
  [[nodiscard]] std::string text() const {
    std::string text;
    for (const auto& [heading, motions] : groups_)
      text += fmt::format("    {}: {}\n", heading, fmt::join(motions, ", "));
    return text;
  }

 private:
  std::vector<std::pair<std::string, std::vector<std::string>>> groups_;
};

/// Which meshes met in which motions, if a body has several.
std::string met_text(const RomResult& result, std::string_view heading, ContactOf contact_of) {
  const Joint& joint = result.joint;
  MotionGroups met;
  for (const motion::MotionLimit& limit : result.answer.limits) {
    const motion::ContactWitness* contact = contact_of(limit);
    if (!contact) continue;
    const BodyPart *fixed = part_of(joint.fixed, contact->fixed_feature),
                   *mobile = part_of(joint.mobile, contact->mobile_feature);
    if (fixed || mobile)
      met.add(fmt::format("{} on {}", mobile ? mobile->name : joint.mobile.name,
                          fixed ? fixed->name : joint.fixed.name),
              limit.motion.name);
  }
  const std::string text = met.text();
  return text.empty() ? "" : fmt::format("  {}:\n", heading) + wrapped(text);
}

/// Source of the column of closed forms, or the reason why an implant has none.
std::string closed_text(const RomResult& result) {
  const Joint& joint = result.joint;
  if (!joint.implant || !result.answer.depths.empty()) return "";
  const plan::ClosedForm form = plan::closed_form(joint);
  if (!form.pair) return wrapped(fmt::format("  no closed form: {}\n", form.why_none));
  return wrapped(fmt::format(
      "  closed form: {} on {} as bodies of revolution, in contact where their axes are {:.4f} deg apart\n",
      joint.implant->mobile_mesh.empty() ? joint.mobile.name : joint.implant->mobile_mesh,
      joint.implant->fixed_mesh.empty() ? joint.fixed.name : joint.implant->fixed_mesh,
      form.pair->half_angle.degrees()));
}

/// "0.84 mm (CT segmented by people; Soodmand 2018: ...)", "0.25 mm (assumed)" or, as it is stated, "0.3 mm".
std::string surface_text(const motion::Uncertainty& sigma, const Joint& joint) {
  const bool fixed = sigma.is_by_voxels(joint.fixed), mobile = sigma.is_by_voxels(joint.mobile);
  const std::string voxels = fmt::format("{:g} voxels", sigma.surface_voxels);
  std::string mm = fmt::format("{:g} mm", sigma.surface_mm);
  for (const motion::SurfaceOrigin& origin : motion::surface_origins())
    if (origin.name == sigma.surface_from)
      return fmt::format("{}{} ({}; {})", mm, fixed || mobile ? " and " + voxels + " of images" : "",
                         origin.what, origin.source);
  if (fixed && mobile) return voxels;
  if (sigma.surface_voxels > 0) mm += " (assumed)";
  return fixed || mobile
             ? fmt::format("{} ({}) and {}", voxels, (fixed ? joint.fixed : joint.mobile).name, mm)
             : mm;
}

/// Where the bands come from, and as a whole what widens them; without bands a line that says how to get them.
std::string band_text(const RomResult& result, TextForm form) {
  if (result.answer.bands.empty())
    return result.answer.depths.empty() && !result.answer.follows
               ? "  band unknown: --band computes how far these limits move with what is uncertain\n"
               : "";
  const motion::BandOptions& options = result.answer.band_options;
  const std::string text = fmt::format(
      "  band: 5 to 95 % of {} joints; SD: centre {:g} mm, axes {:g} deg, surfaces {}{}; seed {}{}\n",
      options.samples, options.sigma.centre_mm, options.sigma.axes.degrees(),
      surface_text(options.sigma, result.joint), io::sigmas_text(result.joint), options.seed,
      form == TextForm::brief ? "" : "; its width where only one of them is moved:");
  if (form == TextForm::brief) return wrapped(text);
  TextColumn name{Align::left, {"motion"}}, median{Align::right, {"median"}}, low{Align::right, {"5 %"}},
      high{Align::right, {"95 %"}}, centre{Align::right, {"centre"}}, axes{Align::right, {"axes"}},
      surface{Align::right, {"surface"}}, parameters{Align::right, {"parameters"}},
      free{Align::right, {"no contact"}};
  for (std::size_t i = 0; i < result.answer.bands.size(); ++i) {
    const motion::LimitBand& band = result.answer.bands[i];
    name.cells.push_back(result.answer.limits[i].motion.name);
    const auto add = [](TextColumn& column, Angle angle) {
      column.cells.push_back(fmt::format("{:.1f}", angle.degrees()));
    };
    for (const auto& [column, angle] : {std::pair(&median, band.median), {&low, band.p5}, {&high, band.p95}})
      column->cells.push_back((angle < result.answer.limits[i].motion.range ? "" : ">") +
                              fmt::format("{:.1f}", angle.degrees()));
    add(centre, band.width_from.centre), add(axes, band.width_from.axes),
        add(surface, band.width_from.surface);
    add(parameters, band.width_from.parameters);
    free.cells.push_back(fmt::format("{:.0f} %", 100 * band.share_without_contact));
  }
  std::vector<TextColumn> columns{name, median, low, high, centre, axes, surface};
  if (has_uncertain_parameters(result.joint)) columns.push_back(parameters);
  columns.push_back(free);
  return wrapped(text) + table_text(columns);
}

/// Caveats on the usual ends of motions like these: a line for each, with its motions; in brief those by which a living joint ends earlier.
std::string caveat_text(const RomResult& result, TextForm form) {
  MotionGroups caveats;
  std::vector<std::string_view> soft, labrum;
  std::string_view of_labrum;
  for (std::size_t i = 0; i < result.answer.limits.size(); ++i) {
    const motion::MotionLimit& limit = result.answer.limits[i];
    const auto living = living_limit(result.answer, i);
    bool is_soft = living && living->gap && living->gap->closeness != Closeness::close;
    for (const MotionCaveat& caveat : motion_caveats(result.joint, limit.motion)) {
      is_soft |= !(living && living->gap) && (caveat.code == MotionCaveatCode::soft_tissue_ends ||
                                              caveat.code == MotionCaveatCode::soft_tissue_close);
      if (caveat.code == MotionCaveatCode::labrum_not_modelled)
        of_labrum = caveat.summary, labrum.push_back(limit.motion.name);
      // The lines on living hips say more of it than whether bone usually ends it.
      if (living && living->gap && caveat.code != MotionCaveatCode::labrum_not_modelled) continue;
      const std::string source = caveat.source.empty() ? "" : fmt::format(" ({})", caveat.source);
      caveats.add(std::string(caveat.summary) + source, limit.motion.name);
    }
    if (is_soft) soft.push_back(limit.motion.name);
  }
  if (form == TextForm::whole) {
    const std::string text = caveats.text();
    return text.empty() ? "" : wrapped("  caveats, by studies of other hips:\n" + text);
  }
  std::string text = soft.empty() ? "" : fmt::format("soft tissue first: {}", fmt::join(soft, ", "));
  if (!labrum.empty())
    text += fmt::format("{}{}: {}", text.empty() ? "" : "; ", of_labrum, fmt::join(labrum, ", "));
  return caveats.text().empty()
             ? ""
             : wrapped(fmt::format("  {}{}more: --verbose\n", text, text.empty() ? "" : "; "));
}

/// What the words in the column of living hips mean, and as a whole which motions soft tissue ends first; empty if nothing is known.
std::string living_text(const RomResult& result, TextForm form) {
  int hips = 0;
  bool any_people = false;
  std::string far_off;
  for (std::size_t i = 0; i < result.answer.limits.size(); ++i) {
    const auto living = living_limit(result.answer, i);
    if (!living) continue;
    if (living->expected) hips = living->gap->hips;
    any_people |= living->people && !living->expected;
    if (living->gap && living->gap->closeness != Closeness::close)
      far_off += (far_off.empty() ? "" : ", ") + result.answer.limits[i].motion.name;
  }
  std::string text;
  if (hips > 0) text += fmt::format("; \"some\": less what soft tissue took in {} cadavers", hips);
  if (any_people) text += "; means: of other people";
  if (form == TextForm::whole && !(text + far_off).empty()) text += "; sources by --json";
  if (!text.empty()) text = "  living hips: " + text.substr(2) + "\n";
  if (form == TextForm::whole && !far_off.empty())
    text += "    usually ended by soft tissue before bone: " + far_off + "\n";
  return wrapped(text);
}

/// Limits beside those of simulations of bone; in brief those that are as short as with a cam.
std::string bone_text(const RomResult& result, TextForm form) {
  std::string text;
  for (const motion::MotionLimit& limit : result.answer.limits)
    if (const auto bone = bone_reference(result.joint, limit)) {
      const bool is_early = is_short(*bone, limit);
      if (form == TextForm::whole)
        text += wrapped(fmt::format(
            "  bone ends {} at {:.1f} deg in {} simulated healthy hips, {:.1f} in as many with a cam and no "
            "complaints, {:.1f} in as many patients ({}); no spread is given{}\n",
            limit.motion.name, bone->healthy.degrees(), bone->people_each,
            bone->cam_without_complaints.degrees(), bone->patients.degrees(), bone->source,
            is_early ? ": here it ends it as early as in hips with a cam" : ""));
      else if (is_early)
        text += wrapped(
            fmt::format("  bone ends {} as early as in hips with a cam ({:.1f} deg, healthy {:.1f})\n",
                        limit.motion.name, bone->cam_without_complaints.degrees(), bone->healthy.degrees()));
    }
  return text;
}

/// Where angles count from, and whether limits may be held against clinical ranges; the plane in which hours are read, in brief if it is
/// not the usual one.
std::string zero_words(const RomResult& result, TextForm form) {
  const ZeroPose zero = zero_pose(result.joint);
  const bool is_hip = result.joint.is_hip(), by_rim = result.answer.clock_plane == motion::ClockPlane::rim;
  return wrapped(
      fmt::format("  zero: {}{}\n{}", zero_text(result.joint, zero),
                  is_hip && !zero.is_neutral() ? "; limits are not compared with clinical ranges" : "",
                  is_hip && by_rim ? "  clock: hours in the plane of the rim, 6 at the notch and 3 anterior\n"
                  : is_hip && form == TextForm::whole
                      ? "  clock: hours in the sagittal plane, 12 superior and 3 anterior\n"
                      : ""));
}

/// Digits after the point of a limit, by its band.
int digits_of(const RangeAnswer& answer, const motion::MotionLimit& limit) {
  return answer.bands.empty()
             ? 2
             : limit_digits(answer.bands[static_cast<std::size_t>(&limit - answer.limits.data())]);
}

/// From contact to contact of opposite motions, wherever zero is, as their limits are printed; nothing if none have it. In brief what one
/// line holds.
std::string arcs_text(const RomResult& result, TextForm form) {
  constexpr std::size_t line = 100;
  std::string text;
  for (const io::OppositeLimits& pair : io::opposite_limits(result.answer.limits)) {
    const std::string arc =
        fmt::format("{}{} to {} {:.{}f}", text.empty() ? "  total arcs (deg): " : ", ", pair.one->motion.name,
                    pair.other->motion.name, pair.arc().degrees(),
                    std::min(digits_of(result.answer, *pair.one), digits_of(result.answer, *pair.other)));
    if (form == TextForm::brief && !text.empty() && text.size() + arc.size() > line) break;
    text += arc;
  }
  return text.empty() ? "" : wrapped(text + "\n");
}

/// The features that meet past each limit; nothing without zones.
std::string zones_text(const RomResult& result) {
  if (std::none_of(result.answer.zones.begin(), result.answer.zones.end(),
                   [](const auto& zone) { return zone.has_value(); }))
    return "";
  TextColumn name{Align::left, {"motion"}},
      of_fixed{Align::right, {"area of " + result.joint.fixed.name + " (mm2)"}},
      of_mobile{Align::right, {"of " + result.joint.mobile.name}}, depth{Align::right, {"depth (mm)"}},
      clock{Align::right, {"clock"}}, place{Align::left, {"centre (mm)"}};
  double past_deg = 0;
  for (const auto& zone : result.answer.zones) {
    if (!zone) continue;
    past_deg = zone->past.degrees();
    name.cells.push_back(zone->limit.motion.name);
    of_fixed.cells.push_back(fmt::format("{:.1f}", zone->fixed.area_mm2));
    of_mobile.cells.push_back(fmt::format("{:.1f}", zone->mobile.area_mm2));
    double deepest = 0;
    bool any_depth = false;
    for (const motion::BodyZone* body : {&zone->fixed, &zone->mobile}) {
      for (const double arc_mm : body->tangential_depth_mm)
        if (std::isfinite(arc_mm)) deepest = std::max(deepest, arc_mm);
      any_depth |= !body->tangential_depth_mm.empty();
    }
    depth.cells.push_back(any_depth ? fmt::format("{:.2f}", deepest) : "-");
    clock.cells.push_back(zone->zone_hour ? io::clock_text(*zone->zone_hour) : "-");
    const auto& centre = zone->fixed.centroid_mm;
    place.cells.push_back(centre ? core::rounded(frame_of(result).fixed_point(*centre), 2) : "-");
  }
  const std::string heading = fmt::format(
      "  zones {:g} deg past the limit: triangles that meet, the deepest vertex along the motion's arc, and "
      "where on {}:\n",
      past_deg, result.joint.fixed.name);
  return wrapped(heading) + (result.joint.is_hip()
                                 ? table_text(std::array{name, of_fixed, of_mobile, depth, clock})
                                 : table_text(std::array{name, of_fixed, of_mobile, depth, place}));
}

}  // namespace

std::string limit_words(const RangeAnswer& answer, std::size_t i) {
  const motion::MotionLimit& limit = answer.limits[i];
  if (limit.translation_ends && !limit.translation_mm) return "-";
  const motion::LimitBand* band = answer.bands.empty() ? nullptr : &answer.bands[i];
  // Where what a translation follows ends, the motion is known to there, not free beyond.
  if (limit.end.reason == motion::LimitReason::end_of_range && !limit.translation_ends)
    return io::beyond_range(limit, band);
  return band ? io::quoted_limit(limit, *band) : fmt::format("{:.2f}", limit.end.turned.degrees());
}

std::string rom_text(const RomResult& result, TextForm form) {
  const bool is_whole = form == TextForm::whole;
  TextColumn name{Align::left, {"motion"}}, turned{Align::right, {"limit (deg)"}},
      reason{Align::left, {"ended by"}}, point{Align::left, {"contact point (mm)"}},
      clock{Align::right, {"clock"}}, bearing{Align::right, {"bearing (deg)"}},
      soft{Align::right, {"soft (deg)"}}, closed{Align::right, {"closed form"}},
      living{Align::left, {"living hips"}};
  const auto earlier_text = [](const std::optional<motion::EarlierContact>& contact) {
    return contact ? fmt::format("{:.2f}", contact->turned.degrees()) : "-";
  };
  for (std::size_t i = 0; i < result.answer.limits.size(); ++i) {
    const motion::MotionLimit& limit = result.answer.limits[i];
    name.cells.push_back(limit.motion.name);
    turned.cells.push_back(limit_words(result.answer, i));
    living.cells.push_back(text_of(living_limit(result.answer, i)));
    const auto side = motion::contact_side(result.joint, limit);
    reason.cells.push_back(
        std::string(words_of(limit)) + (side ? fmt::format(", {}", name_of(*side)) : "") +
        (limit.end.ligament ? fmt::format(" {}", result.joint.ligaments[*limit.end.ligament].name) : ""));
    point.cells.push_back(limit.end.contact
                              ? core::rounded(frame_of(result).fixed_point(limit.end.contact->fixed_point), 2)
                              : "-");
    bearing.cells.push_back(earlier_text(limit.end.bearing_contact));
    soft.cells.push_back(earlier_text(limit.end.soft_contact));
    if (!result.answer.closed.empty())
      closed.cells.push_back(result.answer.closed[i].reason == motion::LimitReason::end_of_range
                                 ? "-"
                                 : fmt::format("{:.2f}", result.answer.closed[i].turned.degrees()));
    const auto hour = clock_hour(result.answer, limit);
    clock.cells.push_back(hour ? io::clock_text(*hour) : "-");
  }
  const Joint& joint = result.joint;
  const std::string bodies = fmt::format("{} in {}", joint.mobile.name, joint.fixed.name);
  std::string text = wrapped(fmt::format("{}{}, {} side{}\n", joint.name == bodies ? "" : joint.name + ": ",
                                         bodies, name_of(joint.side), whose_text(joint)));
  text += wrapped(io::parameters_text(joint));
  text += wrapped(bearing_text(result, form) + meshes_text(result));
  for (const std::string& caveat : result.answer.caveats) text += wrapped(fmt::format("  {}\n", caveat));
  text += zero_words(result, form);
  // The figures that people quote, within a terminal's width; the rest is in JSON and CSV.
  const bool has_living =
      std::any_of(living.cells.begin() + 1, living.cells.end(), [](const auto& cell) { return cell != "-"; });
  std::vector<TextColumn> shown{std::move(name), std::move(turned)};
  if (has_living) shown.push_back(std::move(living));
  shown.push_back(std::move(reason));
  shown.push_back(std::move(joint.is_hip() ? clock : point));
  if (std::any_of(result.answer.limits.begin(), result.answer.limits.end(),
                  [](const motion::MotionLimit& limit) { return limit.end.bearing_contact.has_value(); }))
    shown.push_back(std::move(bearing));
  if (std::any_of(result.answer.limits.begin(), result.answer.limits.end(),
                  [](const motion::MotionLimit& limit) { return limit.end.soft_contact.has_value(); }))
    shown.push_back(std::move(soft));
  if (!result.answer.closed.empty()) shown.push_back(std::move(closed));
  text += table_text(shown);
  text += living_text(result, form);
  if (!is_whole) text += caveat_text(result, form);
  text += bone_text(result, form);
  text += arcs_text(result, form);
  text += closed_text(result);
  text += met_text(result, "ended by", end_of);
  text += met_text(result, "soft meshes touched on the way", soft_contact_of);
  text += zones_text(result);
  text += band_text(result, form);
  if (is_whole &&
      std::any_of(result.answer.limits.begin(), result.answer.limits.end(),
                  [](const motion::MotionLimit& limit) { return is_as_defined_here(limit.motion); }))
    text += "  fadir and faber: as defined here (--list-motions); no angles are agreed on\n";
  if (is_whole) text += caveat_text(result, form);
  if (result.answer.map) text += wrapped(map_text(*result.answer.map));
  if (result.box) text += limit_box_text(*result.box);
  return text + wrapped(fmt::format("  {}\n", scope_text(result.joint)));
}

}  // namespace condyle::io
