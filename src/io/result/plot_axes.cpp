#include "io/result/plot_axes.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>

namespace condyle::io {
namespace {

constexpr double margin = 24;      // px
constexpr double tick_length = 5;  // px
constexpr double tick_size = 12;   // px, of the type
constexpr std::string_view minus_sign = "\xE2\x88\x92", degree_sign = "\xC2\xB0";

const Ink axis_ink{.stroke = palette::axis, .stroke_width = 1};

/// Whether two values that stand for multiples of the step are the same one.
bool same_tick(double a, double b, double step) noexcept {
  return std::abs(a - b) < step * 1e-9;
}

/// The text with the first `from` replaced.
void replace_first(std::string& text, std::string_view from, std::string_view to) {
  if (const auto at = text.find(from); at != text.npos) text.replace(at, from.size(), to);
}

}  // namespace

std::string sequential_colour(double fraction) {
  using Rgb = std::array<int, 3>;
  static constexpr std::array<Rgb, 9> samples{{{68, 1, 84},
                                               {71, 44, 122},
                                               {59, 81, 139},
                                               {44, 113, 142},
                                               {33, 144, 141},
                                               {39, 173, 129},
                                               {92, 200, 99},
                                               {170, 220, 50},
                                               {253, 231, 37}}};
  const double at = std::clamp(fraction, 0.0, 1.0) * (samples.size() - 1);
  const auto below = std::min(static_cast<std::size_t>(at), samples.size() - 2);
  const double t = at - static_cast<double>(below);
  const auto channel = [&](std::size_t c) {
    return static_cast<int>(std::lround(samples[below][c] + t * (samples[below + 1][c] - samples[below][c])));
  };
  return fmt::format("#{:02x}{:02x}{:02x}", channel(0), channel(1), channel(2));
}

double tick_step(double span, int steps) {
  assert(span > 0 && steps > 0);
  for (double decade = 1e-6; decade < 1; decade *= 10)
    for (const double digit : {1.0, 2.0, 5.0})
      if (digit * decade < 0.75 && digit * decade * steps >= span) return digit * decade;
  for (const double step : {1.0, 2.0, 5.0, 10.0, 15.0, 20.0, 30.0, 45.0, 60.0})
    if (step * steps >= span) return step;
  return 90 * std::ceil(span / (90 * steps));
}

std::vector<double> ticks(double low, double high, double step) {
  std::vector<double> out;
  double first = std::ceil(low / step);
  if (same_tick((first - 1) * step, low, step)) --first;
  for (double i = first; i * step <= high || same_tick(i * step, high, step); ++i) out.push_back(i * step);
  return out;
}

std::string tick_text(double value, double step) {
  const int decimals = std::clamp(static_cast<int>(std::ceil(-std::log10(step) - 1e-9)), 0, 6);
  const std::string digits = fmt::format("{:.{}f}", std::abs(value), decimals);
  const bool is_zero = digits.find_first_not_of("0.") == digits.npos;
  return value < 0 && !is_zero ? std::string(minus_sign) + digits : digits;
}

std::string readable_name(std::string_view name) {
  if (name == "fadir") return "FADIR";
  if (name == "faber") return "FABER";
  std::string text(name);
  replace_first(text, "_at_90_flexion", fmt::format(" at 90{} flexion", degree_sign));
  std::replace(text.begin(), text.end(), '_', ' ');
  if (!text.empty() && text[0] >= 'a' && text[0] <= 'z') text[0] = static_cast<char>(text[0] - 'a' + 'A');
  return text;
}

void draw_heading(SvgCanvas& canvas, const PlotHeading& heading) {
  constexpr double joint_size = 19, subject_size = 14;
  const double room = canvas.width() - 2 * margin;
  canvas.text({margin, 34}, text_within(heading.joint, joint_size, room), {.size = joint_size, .bold = true});
  canvas.text({margin, 56}, text_within(heading.subject, subject_size, room),
              {.size = subject_size, .colour = palette::quiet_text});
}

void draw_footer(SvgCanvas& canvas) {
  canvas.text({margin, canvas.height() - 14}, "osseous contact; research software, not a medical device",
              {.size = 11, .colour = palette::quiet_text});
}

void draw_bottom_axis(SvgCanvas& canvas, const PlotScale& x, double y_px, int steps, std::string_view label) {
  const double step = tick_step(x.high - x.low, steps);
  canvas.line({x.px_low, y_px}, {x.px_high, y_px}, axis_ink);
  for (const double value : ticks(x.low, x.high, step)) {
    canvas.line({x(value), y_px}, {x(value), y_px + tick_length}, axis_ink);
    canvas.text({x(value), y_px + tick_length + tick_size + 2}, tick_text(value, step),
                {.size = tick_size, .anchor = TextAnchor::middle});
  }
  canvas.text({(x.px_low + x.px_high) / 2, y_px + 42}, label, {.anchor = TextAnchor::middle});
}

void draw_left_axis(SvgCanvas& canvas, const PlotScale& y, double x_px, int steps, std::string_view label) {
  const double step = tick_step(y.high - y.low, steps);
  canvas.line({x_px, y.px_low}, {x_px, y.px_high}, axis_ink);
  for (const double value : ticks(y.low, y.high, step)) {
    canvas.line({x_px, y(value)}, {x_px - tick_length, y(value)}, axis_ink);
    canvas.text({x_px - tick_length - 4, y(value) + tick_size / 3}, tick_text(value, step),
                {.size = tick_size, .anchor = TextAnchor::end});
  }
  canvas.text({x_px - 48, (y.px_low + y.px_high) / 2}, label,
              {.anchor = TextAnchor::middle, .turn = TextTurn::upwards});
}

}  // namespace condyle::io
