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
  // No band beyond the highest value: where limits end at the end of the range, none is higher.
  const double first = std::floor(low / step), last = std::max(std::ceil(high / step), first + 1);
  return {first * step, step, static_cast<int>(last - first)};
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

bool any(const std::vector<bool>& marks) {
  return std::find(marks.begin(), marks.end(), true) != marks.end();
}

/// Half way to the neighbours of each value, and as far beyond the outer ones, cut off at the frame.
std::vector<double> cell_borders(const std::vector<double>& values, const PlotScale& scale) {
  std::vector<double> borders;
  borders.push_back(scale(values.front()));
  for (std::size_t i = 0; i + 1 < values.size(); ++i)
    borders.push_back(scale((values[i] + values[i + 1]) / 2));
  borders.push_back(scale(values.back()));
  return borders;
}

/// Covers the cells of the points that are marked, neighbours in a row at once.
template <class Marked>
void cover_cells(SvgCanvas& canvas, const MapPlot& map, const PlotScale& x, const PlotScale& y,
                 const Marked& marked, std::string_view paint) {
  const std::vector<double> across = cell_borders(map.x, x), up = cell_borders(map.y, y);
  for (std::size_t row = 0; row < map.y.size(); ++row)
    for (std::size_t first = 0; first < map.x.size(); ++first) {
      if (!marked(row * map.x.size() + first)) continue;
      std::size_t last = first;
      while (last + 1 < map.x.size() && marked(row * map.x.size() + last + 1)) ++last;
      canvas.rectangle({across[first], up[row + 1]}, across[last + 1] - across[first], up[row] - up[row + 1],
                       {.fill = paint});
      first = last;
    }
}

/// The value of a contour at the middle of its longest line, where the line is long enough to carry it.
void label_contour(SvgCanvas& canvas, const std::vector<Ring>& lines, std::string_view words) {
  constexpr double size = 10;
  const auto longest = std::max_element(lines.begin(), lines.end(),
                                        [](const Ring& a, const Ring& b) { return a.size() < b.size(); });
  if (longest == lines.end() || longest->size() < 8) return;
  const ScreenPoint at = (*longest)[longest->size() / 2];
  const double width = text_width(words, size);
  if (at.x < left + width || at.x > right - width || at.y < top + size || at.y > bottom - size) return;
  canvas.rectangle({at.x - width / 2 - 1, at.y - size / 2 - 1}, width + 2, size + 2,
                   {.fill = palette::paper});
  canvas.text({at.x, at.y + size / 3}, words, {.size = size, .anchor = TextAnchor::middle});
}

/// Paints of what is hatched.
struct Hatches {
  std::string nowhere, at_end, not_at_start, islands;

  explicit Hatches(SvgCanvas& canvas)
      : nowhere(canvas.hatch("#b5b5b5")),
        at_end(canvas.hatch("#555555")),
        not_at_start(canvas.hatch(palette::vermilion)),
        islands(canvas.dots("#222222")) {}
};

/// What the hatchings mean, in one row below the plot.
void draw_legend(SvgCanvas& canvas, const MapPlot& map, const Hatches& hatches) {
  double x = left;
  const auto entry = [&](std::string_view ground, std::string_view hatch, std::string_view words) {
    canvas.rectangle({x, legend_y - 10}, 24, 13,
                     {.fill = ground, .stroke = palette::axis, .stroke_width = 0.5});
    canvas.rectangle({x, legend_y - 10}, 24, 13, {.fill = hatch});
    canvas.text({x + 32, legend_y + 1}, words, {.size = 12});
    x += 32 + text_width(words, 12) + 24;
  };
  if (any_of_reason(map, LimitReason::contact_at_start))
    entry(palette::light_grey, hatches.nowhere, "free nowhere");
  if (any(map.starts_in_contact))
    entry(sequential_colour(0.7), hatches.not_at_start, "not free at the start");
  if (any(map.has_islands)) entry(sequential_colour(0.7), hatches.islands, "free again beyond contact");
  if (any_of_reason(map, LimitReason::end_of_range))
    entry(sequential_colour(1), hatches.at_end, "no contact up to the end of the range");
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
  const Hatches hatches(canvas);

  canvas.rectangle({left, top}, right - left, bottom - top, {.fill = palette::light_grey});
  canvas.rectangle({left, top}, right - left, bottom - top, {.fill = hatches.nowhere});
  const GridField field{map.x, map.y, values};
  std::vector<std::vector<Ring>> lines;
  for (int k = 0; k < bands.count; ++k) {
    const ContourRegion region = region_at_or_above(field, bands.level(k));
    const std::string colour = bands.colour(k);
    canvas.region(on_screen(region.rings, x, y), {.fill = colour});
    lines.push_back(on_screen(region.lines, x, y));
    for (const Ring& line : lines.back())
      canvas.polyline(line, {.stroke = palette::paper, .stroke_width = 0.6});
  }
  const auto cover = [&](const auto& marked, std::string_view paint) {
    cover_cells(canvas, map, x, y, marked, paint);
  };
  cover([&](std::size_t i) { return map.reasons[i] == LimitReason::end_of_range; }, hatches.at_end);
  if (any(map.starts_in_contact))
    cover([&](std::size_t i) { return map.starts_in_contact[i]; }, hatches.not_at_start);
  if (any(map.has_islands)) cover([&](std::size_t i) { return map.has_islands[i]; }, hatches.islands);
  for (int k = 1; k < bands.count; ++k)
    label_contour(canvas, lines[static_cast<std::size_t>(k)], tick_text(bands.level(k), bands.step));
  draw_frame(canvas, right);
  draw_bottom_axis(canvas, x, bottom, axis_steps, map.x_label);
  draw_left_axis(canvas, y, left, axis_steps, map.y_label);
  draw_colour_bar(canvas, bands, map.quantity);
  draw_legend(canvas, map, hatches);
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
    canvas.text({at + 18, legend_y + 1}, "free nowhere", {.size = 12});
    at += 250;
  }
  if (hollow) {
    canvas.circle({at + 4, legend_y - 4}, 3.5, {.fill = palette::paper, .stroke = palette::blue});
    canvas.text({at + 18, legend_y + 1}, "no contact up to the end of the range", {.size = 12});
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
