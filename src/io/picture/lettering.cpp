#include "io/picture/lettering.hpp"

#include <cmath>
#include <initializer_list>
#include <numbers>
#include <vector>

#include "core/trigonometry.hpp"

/// Letters as strokes of one width, drawn with round ends. Centre lines of digits and tall letters reach from 0.05 to 0.95,
/// those of small letters to 0.61.

namespace condyle::io {
namespace {

constexpr double between_letters = 0.14;

struct Place {
  double x, y;
};

/// A line through places, which may be arcs.
class Stroke {
 public:
  Stroke(std::initializer_list<Place> places) : places_(places) {}

  /// Part of an ellipse, in degrees from the right; counter-clockwise if `to` is larger.
  Stroke& arc(Place centre, double width, double height, double from, double to) {
    constexpr double step = 15;
    const int steps = static_cast<int>(std::ceil(std::abs(to - from) / step));
    for (int i = 0; i <= steps; ++i) {
      const double angle = (from + (to - from) * i / steps) * std::numbers::pi / 180;
      places_.push_back({centre.x + width * core::cosine(angle), centre.y + height * core::sine(angle)});
    }
    return *this;
  }
  Stroke& to(Place place) {
    places_.push_back(place);
    return *this;
  }

  const std::vector<Place>& places() const noexcept { return places_; }

 private:
  std::vector<Place> places_;
};

struct Letter {
  double width;
  std::vector<Stroke> strokes;
};

Stroke arc(Place centre, double width, double height, double from, double to) {
  return Stroke({}).arc(centre, width, height, from, to);
}

/// The round part of a small letter.
Stroke bowl(double x) {
  return arc({x, 0.33}, 0.23, 0.28, 0, 360);
}

Letter digit(char c) {
  switch (c) {
    case '0':
      return {0.6, {arc({0.3, 0.5}, 0.24, 0.45, 0, 360)}};
    case '1':
      return {0.6, {{{0.12, 0.75}, {0.34, 0.95}, {0.34, 0.05}}}};
    case '2':
      return {0.6, {arc({0.3, 0.68}, 0.24, 0.27, 160, -35).to({0.06, 0.05}).to({0.54, 0.05})}};
    case '3':
      return {0.6, {arc({0.28, 0.72}, 0.22, 0.23, 150, -90).arc({0.28, 0.27}, 0.25, 0.22, 90, -150)}};
    case '4':
      return {0.6, {{{0.42, 0.05}, {0.42, 0.95}, {0.05, 0.3}, {0.57, 0.3}}}};
    case '5':
      return {0.6,
              {Stroke({{0.5, 0.95}, {0.12, 0.95}, {0.09, 0.53}}).arc({0.29, 0.33}, 0.25, 0.28, 125, -145)}};
    case '6':
      return {0.6, {arc({0.3, 0.32}, 0.24, 0.27, 0, 360), arc({0.52, 0.35}, 0.46, 0.6, 180, 95)}};
    case '7':
      return {0.6, {{{0.06, 0.95}, {0.54, 0.95}, {0.22, 0.05}}}};
    case '8':
      return {0.6, {arc({0.3, 0.72}, 0.21, 0.23, 0, 360), arc({0.3, 0.27}, 0.25, 0.22, 0, 360)}};
    default:
      return {0.6, {arc({0.3, 0.68}, 0.24, 0.27, 0, 360), arc({0.08, 0.65}, 0.46, 0.6, 0, -85)}};
  }
}

Letter letter_of(char c) {
  if (c >= '0' && c <= '9') return digit(c);
  switch (c) {
    case 'a':
      return {0.56, {bowl(0.28), {{0.51, 0.61}, {0.51, 0.05}}}};
    case 'b':
      return {0.56, {bowl(0.28), {{0.05, 0.95}, {0.05, 0.05}}}};
    case 'c':
      return {0.5, {arc({0.29, 0.33}, 0.24, 0.28, 45, 315)}};
    case 'd':
      return {0.56, {bowl(0.28), {{0.51, 0.95}, {0.51, 0.05}}}};
    case 'e':
      return {0.54, {Stroke({{0.05, 0.35}}).arc({0.28, 0.33}, 0.23, 0.28, 5, 320)}};
    case 'f':
      return {0.36,
              {Stroke({{0.14, 0.05}}).arc({0.32, 0.77}, 0.18, 0.18, 180, 80), {{0.02, 0.61}, {0.32, 0.61}}}};
    case 'g':
      return {0.56, {bowl(0.28), Stroke({{0.51, 0.61}}).arc({0.28, -0.04}, 0.23, 0.21, 0, -145)}};
    case 'h':
      return {0.52, {{{0.05, 0.95}, {0.05, 0.05}}, arc({0.26, 0.38}, 0.21, 0.23, 180, 0).to({0.47, 0.05})}};
    case 'i':
      return {0.1, {{{0.05, 0.61}, {0.05, 0.05}}, {{0.05, 0.86}}}};
    case 'j':
      return {0.2, {Stroke({{0.15, 0.61}}).arc({0.01, -0.1}, 0.14, 0.15, 0, -90), {{0.15, 0.86}}}};
    case 'k':
      return {0.5,
              {{{0.05, 0.95}, {0.05, 0.05}}, {{0.45, 0.61}, {0.05, 0.25}}, {{0.2, 0.385}, {0.47, 0.05}}}};
    case 'l':
      return {0.1, {{{0.05, 0.95}, {0.05, 0.05}}}};
    case 'm':
      return {0.8,
              {{{0.05, 0.61}, {0.05, 0.05}},
               arc({0.225, 0.41}, 0.175, 0.2, 180, 0).to({0.4, 0.05}),
               arc({0.575, 0.41}, 0.175, 0.2, 180, 0).to({0.75, 0.05})}};
    case 'n':
      return {0.52, {{{0.05, 0.61}, {0.05, 0.05}}, arc({0.26, 0.38}, 0.21, 0.23, 180, 0).to({0.47, 0.05})}};
    case 'o':
      return {0.56, {bowl(0.28)}};
    case 'p':
      return {0.56, {bowl(0.28), {{0.05, 0.61}, {0.05, -0.25}}}};
    case 'q':
      return {0.56, {bowl(0.28), {{0.51, 0.61}, {0.51, -0.25}}}};
    case 'r':
      return {0.36, {{{0.05, 0.61}, {0.05, 0.05}}, arc({0.25, 0.36}, 0.2, 0.25, 180, 65)}};
    case 's':
      return {0.46, {arc({0.23, 0.475}, 0.17, 0.135, 40, 270).arc({0.23, 0.195}, 0.19, 0.145, 90, -145)}};
    case 't':
      return {0.34,
              {Stroke({{0.15, 0.85}}).arc({0.29, 0.19}, 0.14, 0.14, 180, 290), {{0.02, 0.61}, {0.31, 0.61}}}};
    case 'u':
      return {0.52,
              {Stroke({{0.05, 0.61}}).arc({0.26, 0.26}, 0.21, 0.21, 180, 360).to({0.47, 0.61}),
               {{0.47, 0.3}, {0.47, 0.05}}}};
    case 'v':
      return {0.5, {{{0.04, 0.61}, {0.25, 0.05}, {0.46, 0.61}}}};
    case 'w':
      return {0.74, {{{0.04, 0.61}, {0.2, 0.05}, {0.37, 0.61}, {0.54, 0.05}, {0.7, 0.61}}}};
    case 'x':
      return {0.48, {{{0.04, 0.61}, {0.44, 0.05}}, {{0.44, 0.61}, {0.04, 0.05}}}};
    case 'y':
      return {0.5, {{{0.04, 0.61}, {0.26, 0.05}}, {{0.46, 0.61}, {0.14, -0.25}}}};
    case 'z':
      return {0.46, {{{0.04, 0.61}, {0.42, 0.61}, {0.04, 0.05}, {0.42, 0.05}}}};
    case 'A':
      return {0.64, {{{0.04, 0.05}, {0.32, 0.95}, {0.6, 0.05}}, {{0.15, 0.36}, {0.49, 0.36}}}};
    case 'I':
      return {0.1, {{{0.05, 0.95}, {0.05, 0.05}}}};
    case 'L':
      return {0.5, {{{0.05, 0.95}, {0.05, 0.05}, {0.47, 0.05}}}};
    case 'P':
      return {0.56,
              {Stroke({{0.05, 0.05}, {0.05, 0.95}}).arc({0.28, 0.71}, 0.23, 0.24, 90, -90).to({0.05, 0.47})}};
    case 'R':
      return {0.58,
              {Stroke({{0.05, 0.05}, {0.05, 0.95}}).arc({0.28, 0.71}, 0.23, 0.24, 90, -90).to({0.05, 0.47}),
               {{0.28, 0.47}, {0.54, 0.05}}}};
    case 'S':
      return {0.58, {arc({0.29, 0.72}, 0.23, 0.23, 40, 270).arc({0.29, 0.27}, 0.25, 0.22, 90, -145)}};
    case '<':
      return {0.46, {{{0.4, 0.72}, {0.06, 0.45}, {0.4, 0.18}}}};
    case '>':
      return {0.46, {{{0.06, 0.72}, {0.4, 0.45}, {0.06, 0.18}}}};
    case '-':
      return {0.4, {{{0.05, 0.42}, {0.35, 0.42}}}};
    case '+':
      return {0.5, {{{0.05, 0.42}, {0.45, 0.42}}, {{0.25, 0.22}, {0.25, 0.62}}}};
    case '.':
      return {0.1, {{{0.05, 0.05}}}};
    case ':':
      return {0.1, {{{0.05, 0.05}}, {{0.05, 0.5}}}};
    case ',':
      return {0.14, {{{0.1, 0.06}, {0.04, -0.12}}}};
    case ' ':
      return {0.22, {}};
    default:  // a box
      return {0.5, {{{0.05, 0.05}, {0.45, 0.05}, {0.45, 0.95}, {0.05, 0.95}, {0.05, 0.05}}}};
  }
}

Index add_place(TriMesh& mesh, double x, double y) {
  mesh.vertices.push_back({x, y, 0});
  return static_cast<Index>(mesh.vertices.size() - 1);
}

/// An octagon: ends and corners are round at the size of letters.
void add_dot(TriMesh& mesh, Place at, double half_width) {
  constexpr Index corners = 8;
  const auto first = static_cast<Index>(mesh.vertices.size());
  for (Index i = 0; i < corners; ++i) {
    const double angle = 2 * std::numbers::pi * i / corners;
    add_place(mesh, at.x + half_width * core::cosine(angle), at.y + half_width * core::sine(angle));
  }
  for (Index i = 2; i < corners; ++i) mesh.triangles.push_back({first, first + i - 1, first + i});
}

void add_line(TriMesh& mesh, Place from, Place to, double half_width) {
  const double length = core::hypotenuse(to.x - from.x, to.y - from.y);
  if (!(length > 0)) return;
  const double across_x = -half_width * (to.y - from.y) / length,
               across_y = half_width * (to.x - from.x) / length;
  const Index a = add_place(mesh, from.x + across_x, from.y + across_y),
              b = add_place(mesh, from.x - across_x, from.y - across_y),
              c = add_place(mesh, to.x - across_x, to.y - across_y),
              d = add_place(mesh, to.x + across_x, to.y + across_y);
  mesh.triangles.push_back({a, b, c});
  mesh.triangles.push_back({a, c, d});
}

}  // namespace

TriMesh lettering(const std::string& text, double half_width) {
  TriMesh mesh;
  double left = 0;
  for (const char c : text) {
    const Letter letter = letter_of(c);
    for (const Stroke& stroke : letter.strokes) {
      const std::vector<Place>& places = stroke.places();
      for (std::size_t i = 0; i < places.size(); ++i) {
        const Place at{left + places[i].x, places[i].y};
        add_dot(mesh, at, half_width);
        if (i > 0) add_line(mesh, {left + places[i - 1].x, places[i - 1].y}, at, half_width);
      }
    }
    left += letter.width + between_letters;
  }
  return mesh;
}

}  // namespace condyle::io
