#include "condyle/radial.hpp"

#include <string>

#include "condyle/error.hpp"
#include "core/coordinate_range.hpp"
#include "radial/direction_table.hpp"

namespace condyle::radial {

void RadialResults::resize(std::size_t count) {
  state.resize(count), winding.resize(count), radial_gap_mm.resize(count);
  triangle.resize(count), direction.resize(count), ray_to_normal.resize(count);
}

void Penetrations::clear() {
  resize(0);
  ray_to_normal.clear();
}

void Penetrations::resize(std::size_t count) {
  point.resize(count), state.resize(count), winding.resize(count);
  triangle.resize(count), depth_mm.resize(count), direction.resize(count);
}

SortedPoints::SortedPoints(PointsView points, const Vec3& centre)
    : blocks_((core::require_in_range(points), std::make_shared<PointBlocks>(points, centre))) {}

void SortedPoints::update(PointsView points) {
  update(points, {});
}

void SortedPoints::update(PointsView points, std::span<const char> is_moved) {
  if (points.size() != size())
    throw UsageError("an update of " + std::to_string(size()) + " points gives " +
                     std::to_string(points.size()));
  core::require_in_range(points);
  if (blocks_.use_count() > 1) blocks_ = std::make_shared<PointBlocks>(*blocks_);
  blocks_->move(points, is_moved);
}

std::size_t SortedPoints::size() const noexcept {
  return blocks_->size();
}

RadialTable::RadialTable(Mesh mesh, RadialOptions options)
    : table_(std::make_unique<DirectionTable>(std::move(mesh), options)) {}

RadialTable::RadialTable(const RadialTable& other)
    : table_(std::make_unique<DirectionTable>(*other.table_)) {}

RadialTable& RadialTable::operator=(const RadialTable& other) {
  if (this != &other) table_ = std::make_unique<DirectionTable>(*other.table_);
  return *this;
}

RadialTable::RadialTable(RadialTable&&) noexcept = default;
RadialTable& RadialTable::operator=(RadialTable&&) noexcept = default;
RadialTable::~RadialTable() = default;

void RadialTable::update(PointsView vertices) {
  table_->update(vertices);
}

void RadialTable::update(std::span<const Index> moved, PointsView positions) {
  table_->update(moved, positions);
}

void RadialTable::query(PointsView points, RadialResults& out) const {
  core::require_in_range(points);
  table_->query(points, out);
}

RadialResults RadialTable::query(PointsView points) const {
  RadialResults out;
  query(points, out);
  return out;
}

std::vector<double> RadialTable::radial_gaps(PointsView points) const {
  core::require_in_range(points);
  return table_->radial_gaps(points);
}

void RadialTable::penetrations(const SortedPoints& points, const Pose& X_FM, Penetrations& out,
                               PenetrationWork* work) const {
  core::require_in_range(X_FM);
  table_->penetrations(points.blocks(), X_FM, out, work);
}

void RadialTable::penetrations(const SortedPoints& points, std::span<const Pose> X_FM,
                               std::span<Penetrations> out) const {
  for (const Pose& X : X_FM) core::require_in_range(X);
  table_->penetrations(points.blocks(), X_FM, out);
}

void RadialTable::add_ray_to_normal(PointsView points, const Pose& X_FM, Penetrations& out) const {
  table_->add_ray_to_normal(points, X_FM, out);
}

void RadialTable::prepare_penetrations() const {
  table_->prepare_penetrations();
}

const TriMesh& RadialTable::mesh() const noexcept {
  return table_->mesh();
}

bool RadialTable::is_closed() const noexcept {
  return table_->is_closed();
}

std::optional<int> RadialTable::winding_at_centre() const noexcept {
  return table_->winding_at_centre();
}

RadialTableSize RadialTable::table_size() const noexcept {
  return table_->table_size();
}

}  // namespace condyle::radial
