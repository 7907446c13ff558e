#include "io/picture/legend.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "io/picture/text.hpp"

namespace condyle::io {
namespace {

/// Where the parts of a legend are, in pixels.
struct Layout {
  double top, height, width;

  Layout(const Picture& picture, std::size_t legend, std::size_t scale)
      : top(static_cast<double>(picture.height - legend)),
        height(static_cast<double>(scale)),
        width(static_cast<double>(picture.width)) {}

  double bar_left() const noexcept { return std::round(0.32 * width); }
  double bar_right() const noexcept { return std::round(0.68 * width); }
  double bar_top() const noexcept { return std::round(top + 0.12 * height); }
  double bar_bottom() const noexcept { return std::round(top + 0.42 * height); }
  /// Height of digits; letters are wider than high, so that a narrow picture has smaller ones.
  double letter_size() const noexcept { return std::min(0.24 * height, 0.02 * width); }
};

/// Colours pixels whose middles lie in a rectangle by colour_at(x, y).
template <class ColourAt>
void fill(Picture& picture, double left, double right, double top, double bottom, const ColourAt& colour_at) {
  for (auto row = static_cast<std::size_t>(top); row < static_cast<std::size_t>(bottom); ++row)
    for (auto column = static_cast<std::size_t>(left); column < static_cast<std::size_t>(right); ++column)
      set_pixel(picture, column, row,
                colour_at(static_cast<double>(column) + 0.5, static_cast<double>(row) + 0.5));
}

template <class ColourAt>
void fill_framed(Picture& picture, double left, double right, double top, double bottom,
                 const ColourAt& colour_at) {
  fill(picture, left - 1, right + 1, top - 1, bottom + 1, [](double, double) { return black; });
  fill(picture, left, right, top, bottom, colour_at);
}

std::string words_of(const PictureOptions& options) {
  return options.about                            ? "depth along arcs, mm"
         : options.colour == PictureColour::depth ? "depth, mm"
         : options.colour == PictureColour::gap   ? "gap along rays, mm"
                                                  : "nearest distance, mm";
}

std::size_t scale_height(const PictureOptions& options) noexcept {
  return options.colour == PictureColour::none ? 0 : std::max<std::size_t>(24, options.height * 9 / 100);
}

std::size_t key_height(const PictureOptions& options) noexcept {
  const bool has_key =
      options.is_annotated && std::any_of(options.marks.begin(), options.marks.end(),
                                          [](const PictureMark& mark) { return !mark.meaning.empty(); });
  return has_key ? std::max<std::size_t>(16, options.height * 5 / 100) : 0;
}

/// In one line, each meaning once.
void draw_key(Picture& picture, const PictureOptions& options) {
  const auto height = static_cast<double>(key_height(options)), width = static_cast<double>(picture.width);
  if (!(height > 0)) return;
  std::vector<const PictureMark*> shown;
  // Widths where letters are 1 high: a swatch, its meaning, and what is free after either.
  constexpr double swatch = 1.6, before_word = 0.6, after_word = 1.8;
  double wide = 0;
  for (const PictureMark& mark : options.marks) {
    const bool is_shown = std::any_of(
        shown.begin(), shown.end(), [&](const PictureMark* other) { return other->meaning == mark.meaning; });
    if (mark.meaning.empty() || is_shown) continue;
    shown.push_back(&mark);
    wide += swatch + before_word + width_of(mark.meaning) + after_word;
  }
  const double size = std::min({0.45 * height, 0.02 * width, width / wide});
  const double top = std::round(static_cast<double>(picture.height) - 0.8 * height);
  Text text;
  double left = (width - size * (wide - after_word)) / 2;
  for (const PictureMark* mark : shown) {
    const double from = std::round(left), end = std::max(from + 1, std::round(left + swatch * size));
    const Rgb colour{double(mark->rgb[0]), double(mark->rgb[1]), double(mark->rgb[2])};
    fill_framed(picture, from, end, top, std::round(top + 1.3 * size),
                [&](double, double) { return colour; });
    left += (swatch + before_word) * size;
    text.add(mark->meaning, left, top + 1.15 * size, size, Alignment::left);
    left += (width_of(mark->meaning) + after_word) * size;
  }
  text.draw(picture, {picture.height - key_height(options), picture.height});
}

void draw_scale(Picture& picture, const PictureOptions& options, const ColourScale& scale) {
  if (options.colour == PictureColour::none) return;
  const Layout at(picture, legend_height(options), scale_height(options));
  const double low = scale.low_mm(), high = scale.range_mm, size = at.letter_size();
  const double left = at.bar_left(), right = at.bar_right(), top = at.bar_top(), bottom = at.bar_bottom();
  fill_framed(picture, left, right, top, bottom,
              [&](double x, double) { return *scale.at(low + (high - low) * (x - left) / (right - left)); });
  const double zero = std::round(left + (right - left) * (0 - low) / (high - low));
  const double below = std::round(bottom + 0.12 * at.height);
  fill(picture, zero - 1, zero + 1, top - 4, below, [](double, double) { return black; });
  Text text;
  const double ticks = below + 1.4 * size, beside = (top + bottom + size) / 2;
  double right_end = right, left_end = left;
  // Values beyond the scale have none of its colours: a swatch of its own on that side.
  const auto add_beyond = [&](bool is_above) {
    const double wide = std::round(2 * size), gap = std::round(0.5 * size);
    const double from = is_above ? right + gap : left - gap - wide;
    fill_framed(picture, from, from + wide, top, bottom, [&](double x, double y) {
      return scale.is_plain_above() && is_above ? fixed_bone
                                                : striped(*scale.at(is_above ? high : low), x, y);
    });
    text.add(is_above ? ">" : "<", from + wide / 2, ticks, size, Alignment::centre);
    (is_above ? right_end : left_end) = is_above ? from + wide : from;
  };
  if (scale.may_end_within) add_beyond(true);
  if (low < 0) add_beyond(false);
  const auto add_tick = [&](double mm) {
    text.add(fmt::format("{:g}", mm), left + (right - left) * (mm - low) / (high - low), ticks, size,
             Alignment::centre);
  };
  if (low < 0) add_tick(low);
  add_tick(0);
  add_tick(high);
  text.add(words_of(options), left_end - 1.2 * size, beside, size, Alignment::right);
  if (options.colour == PictureColour::depth) {
    const double swatch = std::round(right_end + 2 * size), end = std::round(swatch + 2 * size);
    fill_framed(picture, swatch, end, top, bottom, hatching);
    text.add("only a bound", end + 0.8 * size, beside, size, Alignment::left);
  }
  const auto first = static_cast<std::size_t>(at.top);
  text.draw(picture, {first, first + scale_height(options)});
}

}  // namespace

void set_pixel(Picture& picture, std::size_t column, std::size_t row, const Rgb& colour) noexcept {
  for (std::size_t k = 0; k < 3; ++k)
    picture.rgb[3 * (row * picture.width + column) + k] = static_cast<std::uint8_t>(std::lround(colour[k]));
}

Rgb hatching(double x, double y) noexcept {
  constexpr double period = 8, dark = 3;
  return std::fmod(x + y, period) < dark ? hatch_dark : hatch_light;
}

Rgb striped(const Rgb& colour, double x, double y) noexcept {
  constexpr double period = 8, light = 2;
  const double across = std::fmod(x - y, period);
  return (across < 0 ? across + period : across) < light ? white : colour;
}

std::size_t legend_height(const PictureOptions& options) noexcept {
  return scale_height(options) + key_height(options);
}

void draw_legend(Picture& picture, const PictureOptions& options, const ColourScale& scale) {
  draw_scale(picture, options, scale);
  draw_key(picture, options);
}

}  // namespace condyle::io
