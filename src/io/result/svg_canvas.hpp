#pragma once

#include <initializer_list>
#include <span>
#include <string>
#include <string_view>
#include <vector>

/// Drawings as SVG text, without a display, a font or a library: shapes and words in the order in which they
/// are painted. The same calls give the same bytes on every machine.

namespace condyle::io {

/// A place on the drawing in its own pixels: x to the right, y down, (0, 0) the upper left corner.
struct ScreenPoint {
  double x = 0, y = 0;
  friend bool operator==(const ScreenPoint&, const ScreenPoint&) = default;
};

/// How a shape is painted. Colours as SVG writes them ("#0072b2"), "none" for not at all.
struct Ink {
  std::string_view fill = "none";
  std::string_view stroke = "none";
  double stroke_width = 1;     ///< px
  std::string_view dash = "";  ///< SVG's stroke-dasharray, "" for a solid line
};

enum class TextAnchor { start, middle, end };
enum class TextTurn { level, upwards };

struct TextStyle {
  double size = 13;  ///< px
  std::string_view colour = "#222222";
  TextAnchor anchor = TextAnchor::start;
  TextTurn turn = TextTurn::level;
  bool bold = false;
};

/// A closed outline.
using Ring = std::vector<ScreenPoint>;

/// A number as the drawings write it: at most two decimals, no trailing zeros, never "-0". A hundredth of a
/// pixel is below anything that can be seen.
std::string svg_number(double value);

/// Text with everything that XML would read as markup escaped, and characters that no XML document may hold
/// (control characters, bytes that are not UTF-8) as U+FFFD.
std::string xml_escaped(std::string_view text);

/// About how wide a text is, in px: an upper bound for the usual sans-serif faces and Latin text, for laying
/// out. No font is asked: the one that will be used is not known here.
double text_width(std::string_view text, double size) noexcept;

/// The text cut at its end, with an ellipsis, to be no wider than this by text_width().
std::string text_within(std::string_view text, double size, double width);

class SvgCanvas {
 public:
  /// `title` is what a reader without eyes hears and a browser shows as the drawing's name.
  SvgCanvas(double width, double height, std::string_view title);

  double width() const noexcept { return width_; }
  double height() const noexcept { return height_; }

  void line(ScreenPoint a, ScreenPoint b, const Ink& ink);
  void polyline(std::span<const ScreenPoint> points, const Ink& ink);
  void polygon(std::span<const ScreenPoint> points, const Ink& ink);
  void polygon(std::initializer_list<ScreenPoint> points, const Ink& ink) {
    polygon(std::span(points.begin(), points.size()), ink);
  }
  void rectangle(ScreenPoint upper_left, double width, double height, const Ink& ink);
  void circle(ScreenPoint centre, double radius, const Ink& ink);
  /// What an odd number of the rings enclose: holes are rings like others.
  void region(std::span<const Ring> rings, const Ink& ink);
  /// At the left end, middle or right end of its base line.
  void text(ScreenPoint base, std::string_view words, const TextStyle& style = {});

  /// Diagonal hatching as a paint: the value to give as `fill`. One per canvas and colour.
  std::string hatch(std::string_view colour);
  /// The same of dots.
  std::string dots(std::string_view colour);

  /// The whole document, ending in a newline.
  std::string document() const;

 private:
  void shape(std::string_view element, const std::string& geometry, const Ink& ink);
  std::string pattern(std::string_view placing, const std::string& content);

  double width_, height_;
  std::string title_, definitions_, body_;
  int hatches_ = 0;
};

}  // namespace condyle::io
