#include "io/picture/depth_bands.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace condyle::io {
namespace {

/// From little to much.
constexpr std::array<std::array<std::uint8_t, 3>, 7> depth_colours{{{255, 237, 160},
                                                                    {254, 217, 118},
                                                                    {254, 178, 76},
                                                                    {253, 141, 60},
                                                                    {252, 78, 42},
                                                                    {213, 20, 28},
                                                                    {128, 0, 38}}};

struct DeepPoint {
  Vec3 at;
  double depth;
};

/// The part of a convex piece on one side of a depth: deeper for sense 1, less deep for -1.
std::vector<DeepPoint> clipped(const std::vector<DeepPoint>& piece, double depth, double sense) {
  std::vector<DeepPoint> kept;
  for (std::size_t i = 0; i < piece.size(); ++i) {
    const DeepPoint &a = piece[i], &b = piece[(i + 1) % piece.size()];
    const double from = sense * (a.depth - depth), to = sense * (b.depth - depth);
    if (from >= 0) kept.push_back(a);
    if ((from < 0 && to > 0) || (from > 0 && to < 0))
      kept.push_back({a.at + from / (from - to) * (b.at - a.at), depth});
  }
  return kept;
}

void add_piece(TriMesh& mesh, const std::vector<DeepPoint>& piece) {
  const auto first = static_cast<Index>(mesh.vertices.size());
  for (const DeepPoint& p : piece) mesh.vertices.push_back(p.at);
  for (Index i = 2; i < piece.size(); ++i) mesh.triangles.push_back({first, first + i - 1, first + i});
}

/// Shallower than this nothing is drawn, mm.
constexpr double least_drawn_mm = 0.01;

}  // namespace

double depth_band_mm(const plan::CutBone& cut) {
  for (const double width : {0.25, 0.5, 1.0})
    if (cut.deepest_mm <= width * static_cast<double>(depth_colours.size())) return width;
  return 2;
}

std::vector<PictureMark> depth_bands(const plan::CutBone& cut) {
  const double width = depth_band_mm(cut);
  std::vector<PictureMark> bands;
  double from = 0;
  for (const auto& colour : depth_colours) {
    const double to = from + width;
    const bool is_open = bands.size() + 1 == depth_colours.size() && cut.deepest_mm > to;
    bands.push_back(
        {{}, colour, is_open ? fmt::format("over {:g}", from) : fmt::format("{:g}-{:g}", from, to)});
    from = to;
  }
  for (const Triangle& t : cut.before.triangles) {
    std::vector<DeepPoint> triangle;
    for (const Index v : t) triangle.push_back({cut.before.vertices[v], cut.depth_mm[v]});
    for (std::size_t band = 0; band < bands.size(); ++band) {
      auto piece = clipped(triangle, std::max(least_drawn_mm, static_cast<double>(band) * width), 1);
      if (band + 1 < bands.size()) piece = clipped(piece, static_cast<double>(band + 1) * width, -1);
      if (piece.size() > 2) add_piece(bands[band].mesh, piece);
    }
  }
  std::erase_if(bands, [](const PictureMark& band) { return band.mesh.triangles.empty(); });
  if (!bands.empty()) bands.back().meaning += " mm deep";
  return bands;
}

ViewDirection view_of(const plan::CutBone& cut) {
  Vec3 outwards = Vec3::Zero();
  for (const Triangle& t : cut.before.triangles) {
    const Vec3 a = cut.before.vertices[t[0]], b = cut.before.vertices[t[1]], c = cut.before.vertices[t[2]];
    outwards += (cut.depth_mm[t[0]] + cut.depth_mm[t[1]] + cut.depth_mm[t[2]]) * (b - a).cross(c - a);
  }
  if (!(outwards.norm() > 0)) return {};
  outwards.normalize();
  // Superior is up, or anterior where one looks along it.
  constexpr double along = 0.95;
  const Vec3 up = std::abs(outwards.y()) < along ? Vec3::UnitY() : Vec3::UnitX();
  return {outwards, (up - up.dot(outwards) * outwards).normalized()};
}

double field_of(const plan::CutBone& cut, const ViewDirection& view) {
  constexpr double head_and_neck_mm = 110, width_to_height = 4. / 3, with_border = 1.1;
  const Vec3 across = view.up.cross(view.towards_viewer);
  double beside = 0;
  for (std::size_t v = 0; v < cut.depth_mm.size(); ++v)
    if (cut.depth_mm[v] > least_drawn_mm) {
      const Vec3 p = cut.before.vertices[v];
      beside = std::max({beside, std::abs(p.dot(view.up)), std::abs(p.dot(across)) / width_to_height});
    }
  return std::max(head_and_neck_mm, 2 * with_border * beside);
}

}  // namespace condyle::io
