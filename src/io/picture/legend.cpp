#include "io/picture/legend.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "io/picture/lettering.hpp"
#include "io/picture/rasteriser.hpp"

namespace condyle::io {
namespace {

/// Where the parts of a legend are, in pixels.
struct Layout {
  double top, height, width;

  explicit Layout(const Picture& picture, std::size_t legend)
      : top(static_cast<double>(picture.height - legend)),
        height(static_cast<double>(legend)),
        width(static_cast<double>(picture.width)) {}

  double bar_left() const noexcept { return std::round(0.32 * width); }
  double bar_right() const noexcept { return std::round(0.68 * width); }
  double bar_top() const noexcept { return std::round(top + 0.12 * height); }
  double bar_bottom() const noexcept { return std::round(top + 0.42 * height); }
  /// Height of digits; letters are wider than high, so that a narrow picture has smaller ones.
  double letter_size() const noexcept { return std::min(0.24 * height, 0.02 * width); }
};

enum class Alignment { left, centre, right };

/// Letters at places in pixels, drawn all at once.
class Text {
 public:
  void add(const std::string& text, double x, double base_line, double size, Alignment alignment) {
    const TriMesh letters = lettering(text);
    const auto [low, high] = std::minmax_element(letters.vertices.x.begin(), letters.vertices.x.end());
    const double width = size * (*high - *low);
    const double left = x - size * *low -
                        (alignment == Alignment::left    ? 0
                         : alignment == Alignment::right ? width
                                                         : width / 2);
    const auto first = static_cast<Index>(mesh_.vertices.size());
    for (std::size_t v = 0; v < letters.vertices.size(); ++v)
      mesh_.vertices.push_back(
          {left + size * letters.vertices.x[v], base_line - size * letters.vertices.y[v], 0});
    for (const Triangle& t : letters.triangles)
      mesh_.triangles.push_back({first + t[0], first + t[1], first + t[2]});
  }

  /// Over the rows from `top` on.
  void draw(Picture& picture, std::size_t top) const {
    FlatMesh flat{.vertices = Points(mesh_.vertices.size()), .triangles = mesh_.triangles};
    for (std::size_t v = 0; v < mesh_.vertices.size(); ++v)
      flat.vertices.set(
          v, {samples * mesh_.vertices.x[v], samples * (mesh_.vertices.y[v] - static_cast<double>(top)), 0});
    const std::size_t columns = samples * picture.width, rows = samples * (picture.height - top);
    const Rasteriser letters(flat, columns, rows, samples);
    for (std::size_t row = top; row < picture.height; ++row) {
      std::vector<Hit> hits(columns * samples);
      letters.draw(row - top, hits);
      for (std::size_t column = 0; column < picture.width; ++column) {
        std::size_t covered = 0;
        for (std::size_t i = 0; i < samples * samples; ++i)
          covered += hits[i / samples * columns + column * samples + i % samples].triangle != no_index;
        if (covered == 0) continue;
        const double behind = 255.0 * static_cast<double>(samples * samples - covered) / (samples * samples);
        set_pixel(picture, column, row, {behind, behind, behind});
      }
    }
  }

 private:
  TriMesh mesh_;
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

std::string words_of(PictureColour colour) {
  return colour == PictureColour::depth ? "depth, mm"
         : colour == PictureColour::gap ? "gap along rays, mm"
                                        : "nearest distance, mm";
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

std::size_t legend_height(const PictureOptions& options) noexcept {
  if (options.colour == PictureColour::none) return 0;
  return std::max<std::size_t>(24, options.height * 9 / 100);
}

void draw_legend(Picture& picture, const PictureOptions& options, const ColourScale& scale) {
  if (options.colour == PictureColour::none) return;
  const Layout at(picture, legend_height(options));
  const double low = scale.low_mm(), high = scale.range_mm, size = at.letter_size();
  const double left = at.bar_left(), right = at.bar_right(), top = at.bar_top(), bottom = at.bar_bottom();
  fill_framed(picture, left, right, top, bottom,
              [&](double x, double) { return *scale.at(low + (high - low) * (x - left) / (right - left)); });
  const double zero = std::round(left + (right - left) * (0 - low) / (high - low));
  const double below = std::round(bottom + 0.12 * at.height);
  fill(picture, zero - 1, zero + 1, top - 4, below, [](double, double) { return black; });
  Text text;
  const double ticks = below + 1.4 * size, beside = (top + bottom + size) / 2;
  const auto add_tick = [&](double mm) {
    text.add(fmt::format("{:g}", mm), left + (right - left) * (mm - low) / (high - low), ticks, size,
             Alignment::centre);
  };
  if (low < 0) add_tick(low);
  add_tick(0);
  add_tick(high);
  text.add(words_of(options.colour), left - 1.2 * size, beside, size, Alignment::right);
  if (options.colour == PictureColour::depth) {
    const double swatch = std::round(right + 2 * size), end = std::round(swatch + 2 * size);
    fill_framed(picture, swatch, end, top, bottom, hatching);
    text.add("only a bound", end + 0.8 * size, beside, size, Alignment::left);
  }
  text.draw(picture, static_cast<std::size_t>(at.top));
}

}  // namespace condyle::io
