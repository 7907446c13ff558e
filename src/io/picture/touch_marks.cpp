#include "io/picture/touch_marks.hpp"

#include <fmt/format.h>

#include <utility>

#include "core/ordered_sums.hpp"
#include "io/picture/marks.hpp"
#include "io/result/line_mesh.hpp"
#include "mesh/enclosed_volume.hpp"

namespace condyle::io {
namespace {

/// Half the width of lines, as a share of the bodies' size.
constexpr double line_share = 1. / 600;
/// The viewer stands this far out along the way of the mobile body, for 1 beside it: what is in contact is seen from above, and its depth from
/// the side.
constexpr double raised = 0.6;

std::vector<Triangle> meeting(const TriMesh& mesh, const TouchAnswer& answer,
                              Index contact::TrianglePair::*of) {
  std::vector<char> is_met(mesh.triangles.size());
  for (const contact::TrianglePair& pair : answer.pairs) is_met[pair.*of] = 1;
  std::vector<Triangle> met;
  for (std::size_t t = 0; t < is_met.size(); ++t)
    if (is_met[t] != 0) met.push_back(mesh.triangles[t]);
  return met;
}

SurfaceValues values_at(const TriMesh& mesh, const std::vector<Triangle>& met) {
  SurfaceValues values{.mm = {}, .outside = std::vector<double>(mesh.vertices.size(), 1), .is_bound = {}};
  for (const Triangle& triangle : met)
    for (const Index v : triangle) values.outside[v] = -1;
  return values;
}

}  // namespace

std::vector<PictureMark> touch_marks(const TriMesh& fixed, const TriMesh& mobile, const TouchAnswer& answer,
                                     const Vec3& towards_viewer) {
  std::vector<PictureMark> marks;
  for (const auto& [mesh, of] :
       {std::pair{&fixed, &contact::TrianglePair::fixed}, std::pair{&mobile, &contact::TrianglePair::mobile}})
    if (std::vector<Triangle> met = meeting(*mesh, answer, of); !met.empty())
      marks.push_back({{mesh->vertices, std::move(met)}, vermilion, "triangles that meet"});
  if (!answer.deepest && !answer.nearest) return marks;
  const double size = mesh::bounds_of_surface(fixed).diagonal() + mesh::bounds_of_surface(mobile).diagonal();
  // Before all else: seen in parallel, a line that comes towards the viewer stays where it is.
  const Vec3 before = size * towards_viewer;
  const Vec3 from = before + (answer.deepest ? answer.deepest->place : answer.nearest->on_fixed),
             to = before + (answer.deepest ? answer.deepest->exit : answer.nearest->on_mobile);
  const double width = line_share * size;
  TriMesh line;
  add_line(line, from, to, width);
  add_ball(line, from, 2 * width), add_ball(line, to, 2 * width);
  marks.push_back({std::move(line), blue, answer.deepest ? "deepest place and its exit" : "nearest points"});
  return marks;
}

BothValues values_of_touch(const TriMesh& fixed, const TriMesh& mobile, const TouchAnswer& answer) {
  return {values_at(fixed, meeting(fixed, answer, &contact::TrianglePair::fixed)),
          values_at(mobile, meeting(mobile, answer, &contact::TrianglePair::mobile))};
}

std::string touch_line(const TouchAnswer& answer) {
  if (answer.deepest) return fmt::format("in contact, {:.4g} mm deep", answer.deepest->depth_mm);
  return answer.in_contact ? "in contact" : fmt::format("apart, {:.4g} mm", answer.nearest->distance_mm);
}

ViewDirection view_of_touch(const TouchAnswer& answer) {
  Vec3 out = Vec3::UnitZ();
  if (answer.deepest)
    out = answer.deepest->of == BodyRole::mobile ? answer.deepest->normal : Vec3(-answer.deepest->normal);
  else if (answer.nearest && answer.nearest->distance_mm > 0)
    out = core::ordered_direction(answer.nearest->on_mobile - answer.nearest->on_fixed);
  int least = 0;
  out.cwiseAbs().minCoeff(&least);
  const Vec3 beside = core::ordered_direction(out.cross(Vec3::Unit(least)));
  return {core::ordered_direction(beside + raised * out), core::ordered_direction(out - raised * beside)};
}

}  // namespace condyle::io
