#include "io/result/plot_map.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>
#include <span>

#include "io/result/contour_fill.hpp"

namespace condyle::io {
namespace {

constexpr double canvas_width = 800, canvas_height = 640;
constexpr double left = 92, right = 640, top = 84, bottom = 516;  // px, of the plotted area
constexpr double bar_left = 668, bar_width = 22, legend_y = 588;
constexpr double curve_right = 768;  // px, of a curve, which has no colour bar beside it
constexpr int most_bands = 12, axis_steps = 9;

constexpr double none = std::numeric_limits<double>::quiet_NaN();

/// Bands [low + k step, low + (k + 1) step) that hold all values.
struct Bands {
  double low, step;
  int count;

  double level(int k) const noexcept { return low + k * step; }
  std::string colour(int k) const { return sequential_colour(count > 1 ? double(k) / (count - 1) : 0.5); }
};

Bands bands_for(std::span<const double> values) {
  double low = std::numeric_limits<double>::infinity(), high = -low;
  for (const double value : values)
    if (!std::isnan(value)) low = std::min(low, value), high = std::max(high, value);
  if (low > high) return {0, 1, 0};
  // No band is narrower than a degree: the contours of a nearly level field would show its rounding.
  const double step = std::max(tick_step(std::max(high - low, 1.0), most_bands - 1), 1.0);
  const double first = std::floor(low / step);
  return {first * step, step, static_cast<int>(std::floor(high / step) - first) + 1};
}

/// The values, NaN where there is none.
std::vector<double> known_values(const MapPlot& map) {
  std::vector<double> values = map.values;
  for (std::size_t i = 0; i < values.size(); ++i)
    if (map.reasons[i] == LimitReason::contact_at_start) values[i] = none;
  return values;
}

PlotScale scale_over(std::span<const double> values, double px_low, double px_high) {
  const double low = values.front(), high = values.back();
  return high > low ? PlotScale{low, high, px_low, px_high} : PlotScale{low - 1, high + 1, px_low, px_high};
}

Ring on_screen(const Ring& ring, const PlotScale& x, const PlotScale& y) {
  Ring out;
  for (const ScreenPoint& p : ring) out.push_back({x(p.x), y(p.y)});
  return out;
}

std::vector<Ring> on_screen(const std::vector<Ring>& rings, const PlotScale& x, const PlotScale& y) {
  std::vector<Ring> out;
  for (const Ring& ring : rings) out.push_back(on_screen(ring, x, y));
  return out;
}

bool any_of_reason(const MapPlot& map, LimitReason reason) {
  return std::find(map.reasons.begin(), map.reasons.end(), reason) != map.reasons.end();
}

void draw_frame(SvgCanvas& canvas, double right_px) {
  canvas.rectangle({left, top}, right_px - left, bottom - top, {.stroke = palette::axis});
}

/// What the hatchings mean, in one row below the plot.
void draw_legend(SvgCanvas& canvas, const MapPlot& map, std::string_view at_start, std::string_view at_end) {
  double x = left;
  const auto entry = [&](std::string_view ground, std::string_view hatch, std::string_view words) {
    canvas.rectangle({x, legend_y - 10}, 24, 13,
                     {.fill = ground, .stroke = palette::axis, .stroke_width = 0.5});
    canvas.rectangle({x, legend_y - 10}, 24, 13, {.fill = hatch});
    canvas.text({x + 32, legend_y + 1}, words, {.size = 12});
    x += 32 + text_width(words, 12) + 24;
  };
  if (any_of_reason(map, LimitReason::contact_at_start))
    entry(palette::light_grey, at_start, "in contact at the start already");
  if (any_of_reason(map, LimitReason::end_of_range))
    entry(sequential_colour(1), at_end, "end of the range asked for, no contact");
}

void draw_colour_bar(SvgCanvas& canvas, const Bands& bands, std::string_view quantity) {
  if (bands.count == 0) return;
  const double height = (bottom - top) / bands.count;
  for (int k = 0; k < bands.count; ++k)
    canvas.rectangle({bar_left, bottom - height * (k + 1)}, bar_width, height, {.fill = bands.colour(k)});
  canvas.rectangle({bar_left, top}, bar_width, bottom - top, {.stroke = palette::axis});
  for (int k = 0; k <= bands.count; ++k) {
    const double y = bottom - height * k;
    canvas.line({bar_left + bar_width, y}, {bar_left + bar_width + 4, y}, {.stroke = palette::axis});
    canvas.text({bar_left + bar_width + 8, y + 4}, tick_text(bands.level(k), bands.step), {.size = 12});
  }
  canvas.text({canvas_width - 34, (top + bottom) / 2},
              text_within(std::string(quantity) + ", degrees", 13, 430),
              {.anchor = TextAnchor::middle, .turn = TextTurn::upwards});
}

void draw_contours(SvgCanvas& canvas, const MapPlot& map) {
  const std::vector<double> values = known_values(map);
  const PlotScale x = scale_over(map.x, left, right), y = scale_over(map.y, bottom, top);
  const Bands bands = bands_for(values);
  const std::string at_start = canvas.hatch("#b5b5b5"), at_end = canvas.hatch("#555555");

  canvas.rectangle({left, top}, right - left, bottom - top, {.fill = palette::light_grey});
  canvas.rectangle({left, top}, right - left, bottom - top, {.fill = at_start});
  const GridField field{map.x, map.y, values};
  for (int k = 0; k < bands.count; ++k) {
    const ContourRegion region = region_at_or_above(field, bands.level(k));
    const std::string colour = bands.colour(k);
    canvas.region(on_screen(region.rings, x, y), {.fill = colour});
    for (const Ring& line : region.lines)
      canvas.polyline(on_screen(line, x, y), {.stroke = palette::paper, .stroke_width = 0.6});
  }
  if (any_of_reason(map, LimitReason::end_of_range)) {
    std::vector<double> ended(values.size());
    for (std::size_t i = 0; i < ended.size(); ++i)
      ended[i] = std::isnan(values[i]) ? none : map.reasons[i] == LimitReason::end_of_range ? 1 : 0;
    // Only between points that all ended so: at 1, not half way to the next point that has a contact.
    const ContourRegion region = region_at_or_above({map.x, map.y, ended}, 1);
    canvas.region(on_screen(region.rings, x, y), {.fill = at_end});
  }
  draw_frame(canvas, right);
  draw_bottom_axis(canvas, x, bottom, axis_steps, map.x_label);
  draw_left_axis(canvas, y, left, axis_steps, map.y_label);
  draw_colour_bar(canvas, bands, map.quantity);
  draw_legend(canvas, map, at_start, at_end);
}

/// A map along one held angle: the limit as a curve, broken where there is none.
void draw_curve(SvgCanvas& canvas, const MapPlot& map) {
  const bool along_x = map.y.size() == 1;
  const std::vector<double>& held = along_x ? map.x : map.y;
  const std::vector<double> values = known_values(map);
  const Bands bands = bands_for(values);
  const PlotScale x = scale_over(held, left, curve_right);
  const PlotScale y{bands.level(bands.count > 1 ? 0 : -1), bands.level(std::max(bands.count, 1)), bottom,
                    top};

  const double step = tick_step(y.high - y.low, axis_steps);
  for (const double value : ticks(y.low, y.high, step))
    canvas.line({left, y(value)}, {curve_right, y(value)}, {.stroke = palette::light_grey});
  const Ink curve{.stroke = palette::blue, .stroke_width = 2};
  Ring run;
  for (std::size_t i = 0; i <= held.size(); ++i) {
    if (i < held.size() && !std::isnan(values[i])) {
      run.push_back({x(held[i]), y(values[i])});
      continue;
    }
    if (run.size() > 1) canvas.polyline(run, curve);
    if (run.size() == 1) canvas.circle(run[0], 4, {.fill = palette::blue});
    run.clear();
  }
  bool hollow = false, crossed = false;
  for (std::size_t i = 0; i < held.size(); ++i) {
    const double px = x(held[i]);
    if (map.reasons[i] == LimitReason::end_of_range) {
      canvas.circle({px, y(values[i])}, 3.5, {.fill = palette::paper, .stroke = palette::blue});
      hollow = true;
    } else if (map.reasons[i] == LimitReason::contact_at_start) {
      const Ink ink{.stroke = palette::vermilion, .stroke_width = 2};
      canvas.line({px - 4, bottom - 4}, {px + 4, bottom + 4}, ink);
      canvas.line({px - 4, bottom + 4}, {px + 4, bottom - 4}, ink);
      crossed = true;
    }
  }
  draw_frame(canvas, curve_right);
  draw_bottom_axis(canvas, x, bottom, axis_steps, along_x ? map.x_label : map.y_label);
  draw_left_axis(canvas, y, left, axis_steps, map.quantity + ", degrees");
  double at = left;
  if (crossed) {
    const Ink ink{.stroke = palette::vermilion, .stroke_width = 2};
    canvas.line({at, legend_y - 8}, {at + 8, legend_y}, ink);
    canvas.line({at, legend_y}, {at + 8, legend_y - 8}, ink);
    canvas.text({at + 18, legend_y + 1}, "in contact at the start already", {.size = 12});
    at += 250;
  }
  if (hollow) {
    canvas.circle({at + 4, legend_y - 4}, 3.5, {.fill = palette::paper, .stroke = palette::blue});
    canvas.text({at + 18, legend_y + 1}, "end of the range asked for, no contact", {.size = 12});
  }
}

}  // namespace

std::string map_plot(const MapPlot& map) {
  assert(!map.x.empty() && !map.y.empty());
  assert(map.values.size() == map.x.size() * map.y.size() && map.reasons.size() == map.values.size());
  SvgCanvas canvas(canvas_width, canvas_height, map.heading.joint + ": " + map.heading.subject);
  draw_heading(canvas, map.heading);
  if (map.x.size() > 1 && map.y.size() > 1)
    draw_contours(canvas, map);
  else
    draw_curve(canvas, map);
  draw_footer(canvas);
  return canvas.document();
}

}  // namespace condyle::io
