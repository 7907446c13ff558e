#include "log_plot.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "io/result/plot_axes.hpp"
#include "io/result/svg_canvas.hpp"

namespace bench {
namespace {

namespace palette = condyle::io::palette;
using condyle::io::Ink;
using condyle::io::PlotScale;
using condyle::io::ScreenPoint;
using condyle::io::SvgCanvas;
using condyle::io::TextAnchor;

constexpr double width = 1120, left = 84, right = 620, label_left = 650, top = 76;  // px
constexpr double line_height = 15, type_size = 12, zero_row = 34;                   // px

/// Okabe and Ito's colours in the order in which families appear; Condyle comes first.
constexpr std::array<std::string_view, 9> colours = {palette::vermilion, palette::blue,   "#009e73",
                                                     "#cc79a7",          palette::orange, "#56b4e9",
                                                     "#000000",          palette::grey,   "#a6761d"};

struct Legend {
  std::vector<std::string> families;

  std::string_view colour(const std::string& family) {
    const auto at = std::find(families.begin(), families.end(), family);
    const auto number = static_cast<std::size_t>(at - families.begin());
    if (at == families.end()) families.push_back(family);
    return colours[number % colours.size()];
  }
};

/// Logarithms to base 10, so that a linear scale draws them.
struct Range {
  double low = std::numeric_limits<double>::infinity(), high = -low;

  void take(double value) {
    if (value <= 0) return;
    low = std::min(low, std::log10(value)), high = std::max(high, std::log10(value));
  }
  /// Whole decades where that wastes little, and never nothing.
  void round() {
    if (low > high) low = 0, high = 1;
    low = std::floor(low * 2) / 2, high = std::ceil(high * 2) / 2;
    if (high - low < 0.5) high = low + 0.5;
  }
};

std::string decade_text(int exponent) {
  if (exponent >= 0 && exponent <= 5) return fmt::format("{}", std::lround(std::pow(10, exponent)));
  if (exponent < 0 && exponent >= -4) return fmt::format("{:.{}f}", std::pow(10, exponent), -exponent);
  return fmt::format("1e{}", exponent);
}

void draw_axes(SvgCanvas& canvas, const LogPlot& plot, const PlotScale& x, const PlotScale& y,
               double bottom) {
  const Ink grid{.stroke = palette::light_grey}, axis{.stroke = palette::axis};
  for (int decade = static_cast<int>(std::ceil(x.low)); decade <= std::floor(x.high); ++decade) {
    canvas.line({x(decade), top}, {x(decade), bottom}, grid);
    canvas.text({x(decade), bottom + 18}, decade_text(decade),
                {.size = type_size, .anchor = TextAnchor::middle});
  }
  for (int decade = static_cast<int>(std::ceil(y.low)); decade <= std::floor(y.high); ++decade) {
    canvas.line({left, y(decade)}, {right, y(decade)}, grid);
    canvas.text({left - 8, y(decade) + 4}, decade_text(decade),
                {.size = type_size, .anchor = TextAnchor::end});
  }
  canvas.line({left, bottom}, {right, bottom}, axis);
  canvas.line({left, top}, {left, bottom}, axis);
  canvas.text({(left + right) / 2, bottom + 42}, plot.x_label, {.anchor = TextAnchor::middle});
  canvas.text({22, (top + bottom) / 2}, plot.y_label,
              {.anchor = TextAnchor::middle, .turn = condyle::io::TextTurn::upwards});
}

/// Heights of labels as near to where they belong as their own height lets them: pushed down in order, then
/// the whole column pulled back up where it ran over.
std::vector<double> spread(std::vector<double> wanted, double lowest) {
  for (std::size_t i = 1; i < wanted.size(); ++i)
    wanted[i] = std::max(wanted[i], wanted[i - 1] + line_height);
  double limit = lowest;
  for (std::size_t i = wanted.size(); i-- > 0; limit -= line_height) wanted[i] = std::min(wanted[i], limit);
  return wanted;
}

struct Label {
  ScreenPoint from;
  std::string words;
  std::string_view colour;
};

void draw_labels(SvgCanvas& canvas, std::vector<Label> labels, double bottom) {
  std::stable_sort(labels.begin(), labels.end(),
                   [](const Label& a, const Label& b) { return a.from.y < b.from.y; });
  std::vector<double> wanted;
  for (const Label& label : labels) wanted.push_back(std::max(label.from.y, top));
  const std::vector<double> heights = spread(std::move(wanted), bottom);
  for (std::size_t i = 0; i < labels.size(); ++i) {
    canvas.line(labels[i].from, {label_left - 4, heights[i]}, {.stroke = palette::light_grey});
    canvas.text({label_left, heights[i] + 4}, labels[i].words,
                {.size = type_size, .colour = labels[i].colour});
  }
}

}  // namespace

std::string svg_text(const LogPlot& plot) {
  Range xs, ys;
  for (const Series& series : plot.series)
    for (const auto& [size, cost] : series.points) xs.take(size), ys.take(cost);
  xs.round(), ys.round();

  const double labels_height = line_height * static_cast<double>(plot.series.size());
  const double bottom = top + std::max(420.0, labels_height);
  const double least = plot.zero_label.empty() ? bottom : bottom - zero_row;
  SvgCanvas canvas(width, bottom + 110, plot.title);
  draw_heading(canvas, {plot.title, plot.subtitle});
  const PlotScale x{xs.low, xs.high, left + 10, right}, y{ys.low, ys.high, least, top};
  draw_axes(canvas, plot, x, y, bottom);
  if (!plot.zero_label.empty()) {
    canvas.line({left, least + zero_row / 4}, {right, least + zero_row / 4},
                {.stroke = palette::grey, .dash = "4 3"});
    canvas.text({left - 8, bottom - zero_row / 3}, plot.zero_label,
                {.size = type_size, .anchor = TextAnchor::end});
  }

  Legend legend;
  std::vector<Label> labels;
  for (const Series& series : plot.series) {
    const std::string_view colour = legend.colour(series.family);
    std::vector<ScreenPoint> points;
    for (const auto& [size, cost] : series.points)
      points.push_back({x(std::log10(size)), cost > 0 ? y(std::log10(cost)) : bottom - zero_row / 2});
    if (points.empty()) continue;
    const bool is_first_family = series.family == plot.series.front().family;
    canvas.polyline(points, {.stroke = colour, .stroke_width = is_first_family ? 2.5 : 1.2});
    for (const ScreenPoint& point : points) canvas.circle(point, is_first_family ? 4 : 3, {.fill = colour});
    labels.push_back({points.back(), series.label, colour});
  }
  draw_labels(canvas, std::move(labels), bottom);

  double at = left;
  double line = bottom + 68;
  for (const std::string& family : legend.families) {
    const double room = 22 + condyle::io::text_width(family, type_size) + 18;
    if (at + room > width - 20) at = left, line += line_height + 2;
    canvas.circle({at + 6, line - 4}, 4, {.fill = legend.colour(family)});
    canvas.text({at + 16, line}, family, {.size = type_size});
    at += room;
  }
  return canvas.document();
}

}  // namespace bench
