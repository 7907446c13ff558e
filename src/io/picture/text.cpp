#include "io/picture/text.hpp"

#include <algorithm>
#include <vector>

#include "io/picture/legend.hpp"
#include "io/picture/lettering.hpp"
#include "io/picture/rasteriser.hpp"

namespace condyle::io {
namespace {

/// Thickness of the halo beside a stroke, letters being 1 high; around a box, in pixels.
constexpr double halo_width = 0.16, halo_pixels = 2;

std::pair<double, double> extent_of(const TriMesh& letters) {
  const auto [low, high] = std::minmax_element(letters.vertices.x.begin(), letters.vertices.x.end());
  return {*low, *high};
}

void append_letters(TriMesh& mesh, const TriMesh& letters, double left, double base_line, double size) {
  const auto first = static_cast<Index>(mesh.vertices.size());
  for (std::size_t v = 0; v < letters.vertices.size(); ++v)
    mesh.vertices.push_back(
        {left + size * letters.vertices.x[v], base_line - size * letters.vertices.y[v], 0});
  for (const Triangle& t : letters.triangles)
    mesh.triangles.push_back({first + t[0], first + t[1], first + t[2]});
}

void append_box(TriMesh& mesh, double left, double right, double top, double bottom) {
  const auto first = static_cast<Index>(mesh.vertices.size());
  for (const auto& [x, y] :
       {std::pair{left, top}, std::pair{right, top}, std::pair{right, bottom}, std::pair{left, bottom}})
    mesh.vertices.push_back({x, y, 0});
  mesh.triangles.push_back({first, first + 1, first + 2});
  mesh.triangles.push_back({first, first + 2, first + 3});
}

/// As much of each pixel as the mesh covers has the colour.
void cover(Picture& picture, Rows rows, const TriMesh& mesh, const Rgb& colour) {
  FlatMesh flat{.vertices = Points(mesh.vertices.size()), .triangles = mesh.triangles};
  for (std::size_t v = 0; v < mesh.vertices.size(); ++v)
    flat.vertices.set(v, {samples * mesh.vertices.x[v],
                          samples * (mesh.vertices.y[v] - static_cast<double>(rows.first)), 0});
  const std::size_t columns = samples * picture.width;
  const Rasteriser shapes(flat, columns, samples * (rows.end - rows.first), samples);
  std::vector<Hit> hits;
  for (std::size_t row = rows.first; row < rows.end; ++row) {
    if (shapes.is_empty(row - rows.first)) continue;
    hits.assign(columns * samples, {});
    shapes.draw(row - rows.first, hits);
    for (std::size_t column = 0; column < picture.width; ++column) {
      std::size_t covered = 0;
      for (std::size_t i = 0; i < samples * samples; ++i)
        covered += hits[i / samples * columns + column * samples + i % samples].triangle != no_index;
      if (covered == 0) continue;
      const double share = static_cast<double>(covered) / (samples * samples);
      Rgb mixed = colour;
      for (std::size_t k = 0; k < 3; ++k)
        mixed[k] = share * colour[k] + (1 - share) * picture.rgb[3 * (row * picture.width + column) + k];
      set_pixel(picture, column, row, mixed);
    }
  }
}

}  // namespace

double width_of(const std::string& text) {
  const auto [low, high] = extent_of(lettering(text));
  return high - low;
}

void Text::add(const std::string& text, double x, double base_line, double size, Alignment alignment) {
  const TriMesh letters = lettering(text);
  const auto [low, high] = extent_of(letters);
  const double width = size * (high - low);
  const double left = x - size * low -
                      (alignment == Alignment::left    ? 0
                       : alignment == Alignment::right ? width
                                                       : width / 2);
  append_letters(mesh_, letters, left, base_line, size);
  append_letters(halo_, lettering(text, stroke_half_width + halo_width), left, base_line, size);
}

void Text::add_box(double left, double right, double top, double bottom) {
  append_box(mesh_, left, right, top, bottom);
  append_box(halo_, left - halo_pixels, right + halo_pixels, top - halo_pixels, bottom + halo_pixels);
}

void Text::draw(Picture& picture, Rows rows) const {
  cover(picture, rows, halo_, white);
  cover(picture, rows, mesh_, black);
}

}  // namespace condyle::io
