#include "measure/axis_sections.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/trigonometry.hpp"

namespace condyle::measure {
namespace {

/// Whether all of it lies in a face that closes the mesh where it ends: then any part of it ends there.
bool is_in_end(const ContourPiece& piece) {
  return piece.from_end && piece.to_end;
}

/// Keeps the part of a piece between two of its parameters.
bool keep_between(ContourPiece& piece, double low, double high) {
  low = std::max(low, 0.0), high = std::min(high, 1.0);
  if (!(low < high)) return false;
  const Vec2 from = piece.from, along = piece.to - piece.from;
  const bool ends = is_in_end(piece);
  if (low > 0) piece.from = from + low * along, piece.from_end = ends;
  if (high < 1) piece.to = from + high * along, piece.to_end = ends;
  return true;
}

ContourPiece reversed(const ContourPiece& piece) {
  return {piece.to, piece.from, piece.to_end, piece.from_end};
}

Contour half(const Contour& contour, double sign) {
  Contour out;
  for (ContourPiece piece : contour) {
    piece.from.y() *= sign, piece.to.y() *= sign;
    const double a = piece.from.y(), b = piece.to.y();
    if (a < 0 && b < 0) continue;
    if ((a < 0) != (b < 0)) {
      Vec2 on_axis = piece.from + a / (a - b) * (piece.to - piece.from);
      on_axis.y() = 0;
      (a < 0 ? piece.from : piece.to) = on_axis;
      (a < 0 ? piece.from_end : piece.to_end) = is_in_end(piece);
    }
    if (sign < 0) piece = reversed(piece);
    out.push_back(piece);
  }
  return out;
}

}  // namespace

AxisSections::AxisSections(const TriMesh& mesh, const Vec3& centre, const Vec3& axis, const Vec3& zero,
                           const Vec3& quarter, std::vector<char> marks)
    : triangles_(mesh.triangles),
      marks_(std::move(marks)),
      centre_(centre),
      axis_(axis),
      zero_(zero),
      quarter_(quarter),
      along_(mesh.vertices.size()),
      on_zero_(along_.size()),
      on_quarter_(along_.size()),
      is_left_handed_(axis.cross(zero).dot(quarter) < 0) {
  for (std::size_t v = 0; v < along_.size(); ++v) {
    const Vec3 p = mesh.vertices[v] - centre;
    along_[v] = p.dot(axis), on_zero_[v] = p.dot(zero), on_quarter_[v] = p.dot(quarter);
  }
}

Contour AxisSections::at(double turn) const {
  const double c = core::cosine(turn), s = core::sine(turn);
  std::vector<double> above(along_.size());
  for (std::size_t v = 0; v < above.size(); ++v) above[v] = c * on_quarter_[v] - s * on_zero_[v];
  const auto place = [&](Index v) { return Vec2(along_[v], c * on_zero_[v] + s * on_quarter_[v]); };
  const auto crossing = [&](Index i, Index j) {
    if (i > j) std::swap(i, j);  // the same bits in both triangles of an edge
    const Vec2 p = place(i);
    return Vec2(p + above[i] / (above[i] - above[j]) * (place(j) - p));
  };
  const auto ends = [&](Index i, Index j) { return !marks_.empty() && marks_[i] && marks_[j]; };
  Contour contour;
  for (const auto& [i, j, k] : triangles_) {
    const bool a = above[i] < 0, b = above[j] < 0, d = above[k] < 0;
    if (a == b && b == d) continue;
    // The corner that is by itself.
    const auto [one, next, last] = a != b && a != d   ? Triangle{i, j, k}
                                   : b != a && b != d ? Triangle{j, k, i}
                                                      : Triangle{k, i, j};
    const ContourPiece piece{crossing(one, next), crossing(one, last), ends(one, next), ends(one, last)};
    // Counter-clockwise around the triangle its border goes down through the plane where the piece begins, and up where it ends.
    const bool goes_down_first = !(above[one] < 0);
    contour.push_back(goes_down_first != is_left_handed_ ? piece : reversed(piece));
  }
  return contour;
}

Vec3 AxisSections::direction(double turn) const noexcept {
  return core::cosine(turn) * zero_ + core::sine(turn) * quarter_;
}

Vec3 AxisSections::point(double turn, const Vec2& p) const noexcept {
  return centre_ + p.x() * axis_ + p.y() * direction(turn);
}

Contour upper_half(const Contour& contour) {
  return half(contour, 1);
}

Contour lower_half(const Contour& contour) {
  return half(contour, -1);
}

bool faces_outwards(const ContourPiece& piece) {
  return piece.from.x() * piece.to.y() - piece.from.y() * piece.to.x() > 0;
}

bool faces_away_from_axis(const ContourPiece& piece) {
  return piece.to.x() < piece.from.x();
}

bool clip_to_circle(ContourPiece& piece, const Vec2& centre, double radius) {
  const Vec2 p = piece.from - centre, d = piece.to - piece.from;
  const double dd = d.squaredNorm();
  if (!(dd > 0)) return p.norm() <= radius;
  const double middle = -p.dot(d) / dd, rest = (radius * radius - p.squaredNorm()) / dd + middle * middle;
  if (!(rest > 0)) return false;
  const double half_width = std::sqrt(rest);
  return keep_between(piece, middle - half_width, middle + half_width);
}

bool clip_to_range(ContourPiece& piece, double low, double high) {
  const double from = piece.from.x(), along = piece.to.x() - from;
  if (along == 0) return from >= low && from <= high;
  const double a = (low - from) / along, b = (high - from) / along;
  return keep_between(piece, std::min(a, b), std::max(a, b));
}

}  // namespace condyle::measure
