#include "io/result/svg_canvas.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cassert>
#include <cmath>
#include <cstddef>

namespace condyle::io {
namespace {

constexpr std::string_view replacement_character = "\xEF\xBF\xBD";

/// Length of the well-formed UTF-8 sequence at the start of the text, 0 where there is none. Overlong forms,
/// surrogates and numbers past U+10FFFF are not well formed.
std::size_t utf8_length(std::string_view text) noexcept {
  const auto byte = [&](std::size_t i) { return static_cast<unsigned char>(text[i]); };
  const auto follows = [&](std::size_t i, unsigned low = 0x80, unsigned high = 0xBF) {
    return i < text.size() && byte(i) >= low && byte(i) <= high;
  };
  const unsigned first = byte(0);
  if (first < 0x80) return 1;
  if (first >= 0xC2 && first <= 0xDF) return follows(1) ? 2 : 0;
  if (first >= 0xE0 && first <= 0xEF) {
    const bool second = follows(1, first == 0xE0 ? 0xA0 : 0x80, first == 0xED ? 0x9F : 0xBF);
    return second && follows(2) ? 3 : 0;
  }
  if (first >= 0xF0 && first <= 0xF4) {
    const bool second = follows(1, first == 0xF0 ? 0x90 : 0x80, first == 0xF4 ? 0x8F : 0xBF);
    return second && follows(2) && follows(3) ? 4 : 0;
  }
  return 0;
}

/// Whether an XML 1.0 document may hold it: tab and line ends of the control characters, and all others but
/// U+FFFE and U+FFFF.
bool allowed_in_xml(std::string_view character) noexcept {
  if (character.size() == 1) {
    const char c = character[0];
    return static_cast<unsigned char>(c) >= 0x20 || c == '\t' || c == '\n' || c == '\r';
  }
  return character != "\xEF\xBF\xBE" && character != "\xEF\xBF\xBF";
}

std::string point_text(ScreenPoint p) {
  return fmt::format("{},{}", svg_number(p.x), svg_number(p.y));
}

std::string points_text(std::span<const ScreenPoint> points) {
  std::string text;
  for (const ScreenPoint& p : points) text += fmt::format("{}{}", text.empty() ? "" : " ", point_text(p));
  return text;
}

std::string_view anchor_name(TextAnchor anchor) noexcept {
  switch (anchor) {
    case TextAnchor::start:
      return "start";
    case TextAnchor::middle:
      return "middle";
    case TextAnchor::end:
      return "end";
  }
  return "start";
}

/// Width of a character over the size of the type, on the wide side of Arial, Helvetica and DejaVu Sans.
double advance(std::string_view character) noexcept {
  constexpr std::string_view narrow = "iljtfrI.,:;'|!()[] ", wide = "mwMW%@";
  if (character.size() > 1) return 0.70;
  if (narrow.find(character[0]) != narrow.npos) return 0.42;
  if (wide.find(character[0]) != wide.npos) return 0.99;
  return character[0] >= 'A' && character[0] <= 'Z' ? 0.73 : 0.64;
}

/// Calls visit(character) for each; bytes that are not UTF-8 come one by one.
template <class Visit>
void for_each_character(std::string_view text, const Visit& visit) {
  while (!text.empty()) {
    const std::size_t length = std::max<std::size_t>(1, utf8_length(text));
    visit(text.substr(0, length));
    text.remove_prefix(length);
  }
}

}  // namespace

std::string svg_number(double value) {
  assert(std::isfinite(value));
  std::string text = fmt::format("{:.2f}", value);
  text.erase(text.find_last_not_of('0') + 1);
  if (text.back() == '.') text.pop_back();
  return text == "-0" ? "0" : text;
}

std::string xml_escaped(std::string_view text) {
  std::string out;
  while (!text.empty()) {
    const std::size_t length = utf8_length(text);
    const std::string_view character = text.substr(0, std::max<std::size_t>(1, length));
    text.remove_prefix(character.size());
    if (length == 0 || !allowed_in_xml(character))
      out += replacement_character;
    else if (character == "&")
      out += "&amp;";
    else if (character == "<")
      out += "&lt;";
    else if (character == ">")
      out += "&gt;";
    else if (character == "\"")
      out += "&quot;";
    else
      out += character;
  }
  return out;
}

double text_width(std::string_view text, double size) noexcept {
  double width = 0;
  for_each_character(text, [&](std::string_view character) { width += advance(character) * size; });
  return width;
}

std::string text_within(std::string_view text, double size, double width) {
  if (text_width(text, size) <= width) return std::string(text);
  constexpr std::string_view ellipsis = "\xE2\x80\xA6";
  const double room = width - text_width(ellipsis, size);
  std::string out;
  double used = 0;
  for_each_character(text, [&](std::string_view character) {
    used += advance(character) * size;
    if (used <= room) out += character;
  });
  return out.append(ellipsis);
}

SvgCanvas::SvgCanvas(double width, double height, std::string_view title)
    : width_(width), height_(height), title_(title) {}

void SvgCanvas::shape(std::string_view element, const std::string& geometry, const Ink& ink) {
  body_ += fmt::format("<{} {} fill=\"{}\"", element, geometry, ink.fill);
  if (ink.stroke != "none") {
    body_ += fmt::format(" stroke=\"{}\" stroke-width=\"{}\"", ink.stroke, svg_number(ink.stroke_width));
    if (!ink.dash.empty()) body_ += fmt::format(" stroke-dasharray=\"{}\"", ink.dash);
  }
  body_ += "/>\n";
}

void SvgCanvas::line(ScreenPoint a, ScreenPoint b, const Ink& ink) {
  shape("line",
        fmt::format("x1=\"{}\" y1=\"{}\" x2=\"{}\" y2=\"{}\"", svg_number(a.x), svg_number(a.y),
                    svg_number(b.x), svg_number(b.y)),
        ink);
}

void SvgCanvas::polyline(std::span<const ScreenPoint> points, const Ink& ink) {
  if (!points.empty()) shape("polyline", fmt::format("points=\"{}\"", points_text(points)), ink);
}

void SvgCanvas::polygon(std::span<const ScreenPoint> points, const Ink& ink) {
  if (!points.empty()) shape("polygon", fmt::format("points=\"{}\"", points_text(points)), ink);
}

void SvgCanvas::rectangle(ScreenPoint upper_left, double width, double height, const Ink& ink) {
  shape("rect",
        fmt::format("x=\"{}\" y=\"{}\" width=\"{}\" height=\"{}\"", svg_number(upper_left.x),
                    svg_number(upper_left.y), svg_number(width), svg_number(height)),
        ink);
}

void SvgCanvas::circle(ScreenPoint centre, double radius, const Ink& ink) {
  shape("circle",
        fmt::format("cx=\"{}\" cy=\"{}\" r=\"{}\"", svg_number(centre.x), svg_number(centre.y),
                    svg_number(radius)),
        ink);
}

void SvgCanvas::region(std::span<const Ring> rings, const Ink& ink) {
  std::string path;
  for (const Ring& ring : rings)
    if (!ring.empty()) path += fmt::format("M{}Z", points_text(ring));
  if (!path.empty()) shape("path", fmt::format("d=\"{}\" fill-rule=\"evenodd\"", path), ink);
}

void SvgCanvas::text(ScreenPoint base, std::string_view words, const TextStyle& style) {
  const std::string turn =
      style.turn == TextTurn::level ? "" : fmt::format(" transform=\"rotate(-90 {})\"", point_text(base));
  body_ += fmt::format(
      "<text x=\"{}\" y=\"{}\" font-size=\"{}\" fill=\"{}\" text-anchor=\"{}\"{}{}>{}</text>\n",
      svg_number(base.x), svg_number(base.y), svg_number(style.size), style.colour, anchor_name(style.anchor),
      style.bold ? " font-weight=\"bold\"" : "", turn, xml_escaped(words));
}

std::string SvgCanvas::pattern(std::string_view placing, const std::string& content) {
  const std::string id = fmt::format("hatch{}", ++hatches_);
  definitions_ += fmt::format(
      "<pattern id=\"{}\" width=\"6\" height=\"6\" patternUnits=\"userSpaceOnUse\"{}>{}</pattern>\n", id,
      placing, content);
  return fmt::format("url(#{})", id);
}

std::string SvgCanvas::hatch(std::string_view colour) {
  return pattern(
      " patternTransform=\"rotate(45)\"",
      fmt::format("<line x1=\"0\" y1=\"0\" x2=\"0\" y2=\"6\" stroke=\"{}\" stroke-width=\"1.6\"/>", colour));
}

std::string SvgCanvas::dots(std::string_view colour) {
  return pattern("", fmt::format("<circle cx=\"3\" cy=\"3\" r=\"0.9\" fill=\"{}\"/>", colour));
}

std::string SvgCanvas::document() const {
  const std::string w = svg_number(width_), h = svg_number(height_);
  std::string out = "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n";
  out += fmt::format(
      "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{0}\" height=\"{1}\" viewBox=\"0 0 {0} {1}\" "
      "role=\"img\" font-family=\"Helvetica, Arial, 'DejaVu Sans', sans-serif\">\n",
      w, h);
  out += fmt::format("<title>{}</title>\n", xml_escaped(title_));
  if (!definitions_.empty()) out += fmt::format("<defs>\n{}</defs>\n", definitions_);
  out += fmt::format("<rect width=\"{}\" height=\"{}\" fill=\"#ffffff\"/>\n", w, h);
  return out + body_ + "</svg>\n";
}

}  // namespace condyle::io
