#include "contact/points_inside.hpp"

#include <utility>
#include <vector>

#include "condyle/inspect.hpp"

namespace condyle::contact {
namespace {

/// RadialTable::penetrations() is fast up to here: translations, in distances of the surface from the origin.
constexpr double farthest_translation = 4;

/// A surface that deforms before each question is never prepared; one that has come to rest soon is.
constexpr int undecided_after_update = 16;

/// Whether no ray from a point outside first meets a surface from behind. Then winding numbers are nowhere below 0,
/// and points outside have 0.
bool is_plain_solid(const Mesh& mesh) {
  if (!mesh.is_closed()) return false;
  const MeshReport report = inspect(mesh);
  return report.self_crossings.count == 0 && report.inverted_components.count == 0;
}

}  // namespace

PointsInside::PointsInside(Mesh surface, double nearest_mm, Points points)
    : surface_(std::move(surface)), nearest_(nearest_mm), points_(std::move(points)), undecided_(0) {}

void PointsInside::update_points(Points points, bool are_same) {
  const Points before = std::exchange(points_, std::move(points));
  std::optional<Prepared>* prepared = prepared_.current();
  if (!prepared || !*prepared) return;
  if (!are_same) {
    (*prepared)->points = radial::SortedPoints(points_);
    return;
  }
  std::vector<char> is_moved(points_.size());
  for (std::size_t i = 0; i < is_moved.size(); ++i) is_moved[i] = points_[i] != before[i];
  (*prepared)->points.update(points_, is_moved);
}

void PointsInside::update_surface(Mesh surface, double nearest_mm) {
  surface_ = std::move(surface), nearest_ = nearest_mm;
  prepared_.make_out_of_date();
  undecided_ = undecided_after_update;
}

bool PointsInside::find(const Pose& X_of_points, radial::Penetrations& out) const {
  if (!surface_.is_closed() || !(nearest_ > 0) ||
      !(X_of_points.translation().norm() <= farthest_translation * nearest_))
    return false;
  if (undecided_.load(std::memory_order_relaxed) > 0) {
    undecided_.fetch_sub(1, std::memory_order_relaxed);
    return false;
  }
  const auto& prepared = prepared_.get([&](std::optional<Prepared>& made) {
    made.reset();
    if (is_plain_solid(surface_))
      made.emplace(Prepared{radial::RadialTable(surface_), radial::SortedPoints(points_)});
  });
  if (prepared) prepared->table.penetrations(prepared->points, X_of_points, out);
  return prepared.has_value();
}

}  // namespace condyle::contact
