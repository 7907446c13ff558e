#include "io/result/plot_limits.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "io/result/quoted_limit.hpp"

namespace condyle::io {
namespace {

constexpr double canvas_width = 800, margin = 24, heading_height = 78, row_height = 32;
constexpr double band_height = 22, bar_height = 9, name_size = 13, longest_name = 250;
constexpr double value_column = 74, quoted_column = 132, legend_line = 22, footer_height = 34,
                 axis_height = 56;

/// What ended a motion, as the plot tells them apart.
enum class End { impingement, contact, bearing, end_of_range, contact_at_start };

End end_of(const MotionLimit& limit) noexcept {
  switch (limit.end.reason) {
    case LimitReason::contact:
      return limit.end.kind() == ContactKind::bearing       ? End::bearing
             : limit.end.kind() == ContactKind::impingement ? End::impingement
                                                            : End::contact;
    case LimitReason::end_of_range:
      return End::end_of_range;
    case LimitReason::contact_at_start:
      return End::contact_at_start;
  }
  return End::end_of_range;
}

struct EndStyle {
  std::string_view colour, words;
};

EndStyle style_of(End end) noexcept {
  switch (end) {
    case End::impingement:
      return {palette::blue, "impingement: contact outside the bearing surface"};
    case End::contact:
      return {palette::blue, "contact"};
    case End::bearing:
      return {palette::orange, "bearing contact: the sliding surfaces meet"};
    case End::end_of_range:
      return {palette::grey, "no contact in the range of the motion"};
    case End::contact_at_start:
      return {palette::vermilion, "in contact at the start already"};
  }
  return {};
}

/// Each end has a shape of its own: the plot must read without colour.
void draw_mark(SvgCanvas& canvas, End end, ScreenPoint at) {
  const Ink ink{.fill = style_of(end).colour, .stroke = palette::paper, .stroke_width = 1.2};
  const auto [x, y] = at;
  switch (end) {
    case End::impingement:
    case End::contact:
      canvas.circle(at, 6.5, ink);
      break;
    case End::bearing:
      canvas.polygon({{x - 7.5, y}, {x, y - 7.5}, {x + 7.5, y}, {x, y + 7.5}}, ink);
      break;
    case End::end_of_range:
      canvas.polygon({{x - 4, y - 7}, {x + 8, y}, {x - 4, y + 7}}, ink);
      break;
    case End::contact_at_start: {
      const Ink stroke{.stroke = style_of(end).colour, .stroke_width = 2.6};
      canvas.line({x - 5, y - 5}, {x + 5, y + 5}, stroke);
      canvas.line({x - 5, y + 5}, {x + 5, y - 5}, stroke);
      break;
    }
  }
}

/// Of other joints nothing is known here.
std::optional<Angle> normal_range(std::string_view motion, NormalRanges shown) noexcept {
  return shown == NormalRanges::of_hip ? normal_hip_range(motion) : std::nullopt;
}

double longest_turn(std::span<const MotionLimit> limits, std::span<const LimitBand> bands,
                    NormalRanges shown_ranges) {
  double longest = 10;  // degrees: an axis of some length when nothing turns at all
  for (const MotionLimit& limit : limits) {
    longest = std::max(longest, limit.end.turned.degrees());
    if (const auto normal = normal_range(limit.motion.name, shown_ranges))
      longest = std::max(longest, normal->degrees());
  }
  for (const LimitBand& band : bands) longest = std::max(longest, band.p95.degrees());
  return longest;
}

constexpr Ink whisker_ink{.stroke = palette::axis, .stroke_width = 1.4};

/// From the low end of the band to the high one, and its median.
void draw_whisker(SvgCanvas& canvas, double low, double median, double high, double y) {
  canvas.line({low, y}, {high, y}, whisker_ink);
  for (const double end : {low, high}) canvas.line({end, y - 6}, {end, y + 6}, whisker_ink);
  canvas.line({median, y - 3}, {median, y + 3}, whisker_ink);
}

/// `band`: null where there is none.
void draw_row(SvgCanvas& canvas, const MotionLimit& limit, const LimitBand* band, NormalRanges shown_ranges,
              const PlotScale& x, double y) {
  const double zero = x(0), end = x(limit.end.turned.degrees());
  canvas.text({x.px_low - 12, y + name_size / 3},
              text_within(readable_name(limit.motion.name), name_size, x.px_low - 12 - margin),
              {.size = name_size, .anchor = TextAnchor::end});
  if (const auto normal = normal_range(limit.motion.name, shown_ranges)) {
    const double edge = x(normal->degrees());
    canvas.rectangle({zero, y - band_height / 2}, edge - zero, band_height, {.fill = palette::light_grey});
    canvas.line({edge, y - band_height / 2}, {edge, y + band_height / 2},
                {.stroke = palette::quiet_text, .stroke_width = 1.5});
  }
  canvas.rectangle({zero, y - bar_height / 2}, end - zero, bar_height,
                   {.fill = style_of(end_of(limit)).colour});
  if (const auto& bearing = limit.end.bearing_contact)
    draw_mark(canvas, End::bearing, {x(bearing->turned.degrees()), y});
  draw_mark(canvas, end_of(limit), {end, y});
  if (band) draw_whisker(canvas, x(band->p5.degrees()), x(band->median.degrees()), x(band->p95.degrees()), y);
  canvas.text({canvas_width - margin, y + name_size / 3},
              band ? quoted_limit(limit.end.turned, *band)
                   : fmt::format("{:.2f}\xC2\xB0", limit.end.turned.degrees()),
              {.size = name_size, .anchor = TextAnchor::end});
}

}  // namespace

std::optional<Angle> normal_hip_range(std::string_view motion) noexcept {
  struct Range {
    std::string_view motion;
    double degrees;
  };
  static constexpr std::array ranges{Range{"flexion", 120},          Range{"extension", 30},
                                     Range{"abduction", 45},         Range{"adduction", 30},
                                     Range{"internal_rotation", 45}, Range{"external_rotation", 45}};
  for (const Range& range : ranges)
    if (range.motion == motion) return Angle::degrees(range.degrees);
  return std::nullopt;
}

std::string limits_plot(const PlotHeading& heading, std::span<const MotionLimit> limits,
                        std::span<const LimitBand> bands, NormalRanges shown_ranges) {
  const auto shown = [&](End end) {
    return std::any_of(limits.begin(), limits.end(), [&](const MotionLimit& l) {
      return end_of(l) == end || (end == End::bearing && l.end.bearing_contact);
    });
  };
  std::vector<End> legend;
  for (const End end :
       {End::impingement, End::contact, End::bearing, End::end_of_range, End::contact_at_start})
    if (shown(end)) legend.push_back(end);
  const bool any_normal = std::any_of(limits.begin(), limits.end(), [&](const auto& l) {
    return normal_range(l.motion.name, shown_ranges).has_value();
  });
  double names = 0;
  for (const MotionLimit& limit : limits)
    names = std::max(names, text_width(readable_name(limit.motion.name), name_size));

  const double rows = row_height * static_cast<double>(limits.size());
  const double legend_height =
      legend_line * static_cast<double>(legend.size() + (any_normal ? 1 : 0) + (bands.empty() ? 0 : 1));
  const double bottom = heading_height + rows;
  SvgCanvas canvas(canvas_width, bottom + axis_height + legend_height + footer_height,
                   heading.joint + ": " + heading.subject);
  draw_heading(canvas, heading);

  const double longest = longest_turn(limits, bands, shown_ranges), step = tick_step(longest, 8);
  const PlotScale x{0, step * std::ceil(longest / step), margin + std::min(names, longest_name) + 12,
                    canvas_width - margin - (bands.empty() ? value_column : quoted_column)};
  for (const double value : ticks(0, x.high, step))
    canvas.line({x(value), heading_height}, {x(value), bottom}, {.stroke = palette::light_grey});
  for (std::size_t i = 0; i < limits.size(); ++i)
    draw_row(canvas, limits[i], bands.empty() ? nullptr : &bands[i], shown_ranges, x,
             heading_height + row_height * (static_cast<double>(i) + 0.5));
  draw_bottom_axis(canvas, x, bottom, 8, "turned from the start of the motion, degrees");

  double y = bottom + axis_height + legend_line / 2;
  const double words = margin + 34;
  for (const End end : legend) {
    draw_mark(canvas, end, {margin + 12, y});
    canvas.text({words, y + 4}, style_of(end).words, {.size = 12});
    y += legend_line;
  }
  if (!bands.empty()) {
    draw_whisker(canvas, margin, margin + 12, margin + 24, y);
    canvas.text({words, y + 4},
                "band, 5 to 95 %: centre, axes and surfaces moved as far as they are uncertain",
                {.size = 12});
    y += legend_line;
  }
  if (any_normal) {
    canvas.rectangle({margin, y - 6}, 24, 12, {.fill = palette::light_grey});
    canvas.line({margin + 24, y - 6}, {margin + 24, y + 6},
                {.stroke = palette::quiet_text, .stroke_width = 1.5});
    canvas.text({words, y + 4}, fmt::format("normal range of the living hip ({})", normal_hip_range_source),
                {.size = 12});
  }
  draw_footer(canvas);
  return canvas.document();
}

}  // namespace condyle::io
