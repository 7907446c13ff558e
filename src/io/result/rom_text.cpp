#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <span>
#include <string_view>
#include <vector>

#include "condyle/io/pose_text.hpp"
#include "core/rounded.hpp"
#include "io/file/format_version.hpp"
#include "io/result/caveats.hpp"
#include "io/result/clock_hour.hpp"
#include "io/result/json.hpp"
#include "io/result/map_result.hpp"
#include "io/result/quoted_limit.hpp"
#include "io/result/rom_parts.hpp"
#include "io/result/rom_result.hpp"

namespace condyle {
namespace {

/// One line or two: what does not count and by which numbers.
std::string bearing_text(const RomResult& result) {
  const auto& surface = result.bearing.surface;
  if (!surface) return fmt::format("  every contact counts: {}\n", result.bearing.why_none);
  const std::string rim = surface->rim_gap_mm ? fmt::format(", rim {:.2f} mm from it", *surface->rim_gap_mm)
                          : !surface->parts.empty() ? ""
                          : surface->margin_mm == usual_bearing_margin_mm
                              ? ", no rim was found: the usual margin"
                              : ", no rim was found";
  const std::string within = fmt::format("within {:.2f} mm of the head's sphere", surface->margin_mm);
  const std::string extent = surface->parts.empty()
                                 ? within
                                 : fmt::format("{}, as the joint file says, and what lies {}",
                                               fmt::join(surface->parts, " and "), within);
  return fmt::format(
      "  bearing surface: {} of {} triangles of {}, {}\n"
      "    ({} {:.2f} mm{}); contact on it {}\n",
      surface->count(), surface->triangles.size(), result.joint.mobile.name, extent,
      surface->parts.empty() ? "radius" : "its sphere has radius", surface->head.radius, rim,
      result.bearing_rule == BearingRule::count ? "counts" : "does not end a motion");
}

std::string_view words_of(const MotionLimit& limit) noexcept {
  switch (limit.end.reason) {
    case LimitReason::contact:
      switch (limit.end.kind()) {
        case ContactKind::bearing:
          return "bearing contact";
        case ContactKind::impingement:
          return "impingement";
        case ContactKind::unknown:
          return "contact";
      }
      return "";
    case LimitReason::end_of_range:
      return "no contact in range";
    case LimitReason::contact_at_start:
      return "in contact at start";
  }
  return "";
}

/// Characters of well-formed UTF-8: what a terminal shows, for the usual scripts.
std::size_t shown_width(std::string_view text) noexcept {
  return static_cast<std::size_t>(
      std::count_if(text.begin(), text.end(), [](unsigned char c) { return (c & 0xC0) != 0x80; }));
}

enum class Align { left, right };

struct Column {
  Align align;
  std::vector<std::string> cells;  ///< its heading first
};

std::string table_text(std::span<const Column> columns) {
  std::string text;
  for (std::size_t row = 0; row < columns.front().cells.size(); ++row) {
    std::string line = " ";
    for (const Column& column : columns) {
      std::size_t widest = 0;
      for (const std::string& cell : column.cells) widest = std::max(widest, shown_width(cell));
      const std::string& cell = column.cells[row];
      const std::string blanks(widest - shown_width(cell), ' ');
      line += fmt::format(" {} ", column.align == Align::left ? cell + blanks : blanks + cell);
    }
    text += line.substr(0, line.find_last_not_of(' ') + 1) + "\n";
  }
  return text;
}

/// The bands and where they come from; without bands a line that says how to get them.
std::string band_text(const RomResult& result) {
  if (result.bands.empty())
    return result.depths.empty()
               ? "  band unknown: --band tells how far these limits move with what is uncertain\n"
               : "";
  const BandOptions& options = result.band_options;
  std::string text = fmt::format(
      "  band: 5 to 95 % of {} joints with the centre moved by {:g} mm, the axes by {:g} deg and the "
      "surfaces by {:g} mm\n"
      "    (standard deviations, seed {}); its width where only one of them is moved:\n",
      options.samples, options.sigma.centre_mm, options.sigma.axes.degrees(), options.sigma.surface_mm,
      options.seed);
  Column name{Align::left, {"motion"}}, median{Align::right, {"median"}}, low{Align::right, {"5 %"}},
      high{Align::right, {"95 %"}}, centre{Align::right, {"centre"}}, axes{Align::right, {"axes"}},
      surface{Align::right, {"surface"}}, free{Align::right, {"no contact"}};
  for (std::size_t i = 0; i < result.bands.size(); ++i) {
    const LimitBand& band = result.bands[i];
    name.cells.push_back(result.limits[i].motion.name);
    const auto add = [](Column& column, Angle angle) {
      column.cells.push_back(fmt::format("{:.1f}", angle.degrees()));
    };
    add(median, band.median), add(low, band.p5), add(high, band.p95);
    add(centre, band.width_from.centre), add(axes, band.width_from.axes),
        add(surface, band.width_from.surface);
    free.cells.push_back(fmt::format("{:.0f} %", 100 * band.share_without_contact));
  }
  return text + table_text(std::array{name, median, low, high, centre, axes, surface, free});
}

/// What usually ends motions like these: a line for each caveat, with the motions that it is about.
std::string caveat_text(const RomResult& result) {
  struct Line {
    MotionCaveat caveat;
    std::vector<std::string_view> motions;
  };
  std::vector<Line> lines;
  for (const MotionLimit& limit : result.limits)
    for (const MotionCaveat& caveat : motion_caveats(result.joint, limit.motion)) {
      const auto same = std::find_if(lines.begin(), lines.end(), [&](const Line& line) {
        return line.caveat.summary == caveat.summary && line.caveat.source == caveat.source;
      });
      if (same == lines.end())
        lines.push_back({caveat, {limit.motion.name}});
      else
        same->motions.push_back(limit.motion.name);
    }
  std::string text = lines.empty() ? "" : "  caveats, by studies of other hips:\n";
  for (const auto& [caveat, motions] : lines)
    text += fmt::format("    {}{}: {}\n", caveat.summary,
                        caveat.source.empty() ? "" : fmt::format(" ({})", caveat.source),
                        fmt::join(motions, ", "));
  return text;
}

/// What meets past each limit; nothing without zones.
std::string zones_text(const RomResult& result) {
  if (std::none_of(result.zones.begin(), result.zones.end(),
                   [](const auto& zone) { return zone.has_value(); }))
    return "";
  Column name{Align::left, {"motion"}},
      of_fixed{Align::right, {"area of " + result.joint.fixed.name + " (mm2)"}},
      of_mobile{Align::right, {"of " + result.joint.mobile.name}}, depth{Align::right, {"depth (mm)"}},
      clock{Align::right, {result.clock_plane == ClockPlane::rim ? "rim clock" : "sagittal clock"}},
      place{Align::left, {"centre (mm)"}};
  double past_deg = 0;
  for (const auto& zone : result.zones) {
    if (!zone) continue;
    past_deg = zone->past.degrees();
    name.cells.push_back(zone->limit.motion.name);
    of_fixed.cells.push_back(fmt::format("{:.1f}", zone->fixed.area_mm2));
    of_mobile.cells.push_back(fmt::format("{:.1f}", zone->mobile.area_mm2));
    double deepest = 0;
    bool any_depth = false;
    for (const BodyZone* body : {&zone->fixed, &zone->mobile}) {
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
  return heading + (result.joint.is_hip()
                        ? table_text(std::array{name, of_fixed, of_mobile, depth, clock, place})
                        : table_text(std::array{name, of_fixed, of_mobile, depth, place}));
}

}  // namespace

std::string rom_text(const RomResult& result) {
  const auto limit_text = [&](std::size_t i) {
    const Angle turned = result.limits[i].end.turned;
    return result.bands.empty() ? fmt::format("{:.2f}", turned.degrees())
                                : io::quoted_limit(turned, result.bands[i]);
  };
  Column name{Align::left, {"motion"}}, turned{Align::right, {"limit (deg)"}},
      reason{Align::left, {"ended by"}}, point{Align::left, {"contact point (mm)"}},
      clock{Align::right, {result.clock_plane == ClockPlane::rim ? "rim clock" : "sagittal clock"}},
      bearing{Align::right, {"bearing (deg)"}}, centres{Align::right, {"centres (mm)"}},
      space{Align::right, {"space (mm)"}};
  for (std::size_t i = 0; i < result.limits.size(); ++i) {
    const MotionLimit& limit = result.limits[i];
    name.cells.push_back(limit.motion.name);
    turned.cells.push_back(limit_text(i));
    reason.cells.emplace_back(words_of(limit));
    point.cells.push_back(limit.end.contact
                              ? core::rounded(frame_of(result).fixed_point(limit.end.contact->fixed_point), 2)
                              : "-");
    const auto& sliding = limit.end.bearing_contact;
    bearing.cells.push_back(sliding ? fmt::format("{:.2f}", sliding->turned.degrees()) : "-");
    const bool distance = limit.head && limit.head->centre_distance_mm;
    centres.cells.push_back(distance ? fmt::format("{:.2f}", *limit.head->centre_distance_mm) : "-");
    const bool spaced = limit.head && limit.head->joint_space_mm;
    space.cells.push_back(spaced ? fmt::format("{:.2f}", *limit.head->joint_space_mm) : "-");
    const auto hour = io::clock_hour(result, limit);
    clock.cells.push_back(hour ? io::clock_text(*hour) : "-");
  }
  const Joint& joint = result.joint;
  std::string text = fmt::format("{}: {} in {}, {} side\n", joint.name, joint.mobile.name, joint.fixed.name,
                                 name_of(joint.side));
  text += bearing_text(result);
  for (const std::string& caveat : result.caveats) text += fmt::format("  {}\n", caveat);
  text += result.bearing.surface
              ? table_text(std::array{name, turned, reason, clock, point, bearing, centres, space})
          : joint.is_hip() ? table_text(std::array{name, turned, reason, clock, point})
                           : table_text(std::array{name, turned, reason, point});
  text += zones_text(result);
  text += band_text(result);
  if (std::any_of(result.limits.begin(), result.limits.end(),
                  [](const MotionLimit& limit) { return io::is_as_defined_here(limit.motion); }))
    text += "  fadir and faber: as defined here (--list-motions); no angles are agreed on\n";
  text += caveat_text(result);
  if (result.map) text += map_text(*result.map);
  return text + fmt::format("  {}\n", scope_text(result.joint));
}

}  // namespace condyle
