#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "io/result/svg_canvas.hpp"

/// What all plots share: colours, scales, ticks, heading and footer.

namespace condyle::io {

/// Colours that stay apart for all common kinds of colour blindness, and in grey: Okabe and Ito, Color
/// Universal Design, 2008.
namespace palette {
inline constexpr std::string_view blue = "#0072b2", orange = "#e69f00", vermilion = "#d55e00",
                                  grey = "#8c8c8c", light_grey = "#e4e4e4", axis = "#444444",
                                  text = "#222222", quiet_text = "#666666", paper = "#ffffff";
}

/// A colour from dark blue-violet (0) over green to yellow (1), even in lightness and safe for colour-blind
/// readers: nine samples of matplotlib's viridis (S. van der Walt and N. Smith, 2015), joined linearly.
std::string sequential_colour(double fraction);

/// A linear scale from values to pixels.
struct PlotScale {
  double low, high;        ///< values, low < high
  double px_low, px_high;  ///< where they are drawn

  double operator()(double value) const noexcept {
    return px_low + (value - low) / (high - low) * (px_high - px_low);
  }
};

/// The distance between ticks for about this many steps over `span` > 0 degrees: 1, 2, 5 times a power of ten
/// below one degree; above it also 15, 30, 45 and 90, as people divide angles. Never more than `steps` steps.
double tick_step(double span, int steps);

/// Multiples of the step from low to high, both ends included where they are multiples to rounding.
std::vector<double> ticks(double low, double high, double step);

/// "-20" with a true minus sign, as many decimals as a step of this size needs.
std::string tick_text(double value, double step);

/// "flexion" of a motion's name: underscores to spaces, a capital first letter, FADIR and FABER in capitals,
/// the degrees of "_at_90_flexion" with their sign.
std::string readable_name(std::string_view name);

/// Joint (with its side, unless the name says so already) on top, what is shown below it.
struct PlotHeading {
  std::string joint;
  std::string subject;
};
void draw_heading(SvgCanvas& canvas, const PlotHeading& heading);

/// The scope of every result, at the lower edge.
void draw_footer(SvgCanvas& canvas);

/// Lines and numbers of a horizontal axis below, and of a vertical one to the left.
void draw_bottom_axis(SvgCanvas& canvas, const PlotScale& x, double y_px, int steps, std::string_view label);
void draw_left_axis(SvgCanvas& canvas, const PlotScale& y, double x_px, int steps, std::string_view label);

}  // namespace condyle::io
