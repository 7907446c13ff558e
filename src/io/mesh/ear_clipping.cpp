#include "io/mesh/ear_clipping.hpp"

#include <algorithm>

#include "core/predicates.hpp"

namespace condyle::io {
namespace {

using core::Sign;

/// What may be cut off, in the order in which it is looked for.
enum class Ear {
  spike,     ///< there and back again: encloses nothing
  clear,     ///< with no other corner in it or on its border
  touched,   ///< with no other corner inside
  straight,  ///< a corner on the line between its neighbours
};

/// The corners that are left.
class Ring {
 public:
  Ring(const std::vector<Vec3>& corners, const Vec3& normal) : corners_(corners) {
    Eigen::Index axis = 0;
    normal.cwiseAbs().maxCoeff(&axis);
    u_ = (axis + 1) % 3, v_ = (axis + 2) % 3;
    sense_ = core::sign_of(normal[axis]);
    for (std::size_t i = 0; i < corners.size(); ++i) left_.push_back(i);
  }

  std::vector<std::array<std::size_t, 3>> clipped() {
    std::vector<std::array<std::size_t, 3>> triangles;
    while (left_.size() > 3) {
      const std::size_t at = next_ear();
      if (at == left_.size()) return {};
      triangles.push_back(triangle_at(at));
      left_.erase(left_.begin() + static_cast<std::ptrdiff_t>(at));
      begin_ = at < left_.size() ? at : 0;
    }
    const auto last = triangle_at(1);
    if (turn(last[0], last[1], last[2]) == Sign::negative) return {};
    triangles.push_back(last);
    return triangles;
  }

 private:
  std::array<std::size_t, 3> triangle_at(std::size_t at) const {
    const std::size_t n = left_.size();
    return {left_[(at + n - 1) % n], left_[at], left_[(at + 1) % n]};
  }

  /// Positive where three corners turn as the polygon does.
  Sign turn(std::size_t a, std::size_t b, std::size_t c) const {
    const Vec3 &p = corners_[a], &q = corners_[b], &r = corners_[c];
    return sense_ * core::orientation_2d(p[u_], p[v_], q[u_], q[v_], r[u_], r[v_]);
  }

  bool same(std::size_t a, std::size_t b) const {
    return corners_[a][u_] == corners_[b][u_] && corners_[a][v_] == corners_[b][v_];
  }

  /// From where the last ear was, so that ears alternate round the polygon and none of its corners gets all of them.
  std::size_t next_ear() const {
    const std::size_t n = left_.size();
    for (const Ear kind : {Ear::spike, Ear::clear, Ear::touched, Ear::straight})
      for (std::size_t i = 0; i < n; ++i)
        if (is_ear((begin_ + i) % n, kind)) return (begin_ + i) % n;
    return n;
  }

  bool is_ear(std::size_t at, Ear kind) const {
    const auto [a, b, c] = triangle_at(at);
    const Sign sign = turn(a, b, c);
    if (kind == Ear::straight) return sign == Sign::zero;
    if (kind == Ear::spike) {
      const Vec3 back = corners_[a] - corners_[b], on = corners_[c] - corners_[b];
      return sign == Sign::zero && back[u_] * on[u_] + back[v_] * on[v_] >= 0;
    }
    return sign == Sign::positive && !is_entered(at, kind);
  }

  /// Whether another part of the polygon is in an ear.
  bool is_entered(std::size_t at, Ear kind) const {
    const auto [a, b, c] = triangle_at(at);
    const std::size_t n = left_.size();
    for (std::size_t i = 2; i + 1 < n; ++i) {
      const std::size_t place = (at + i) % n, w = left_[place];
      if (same(w, a) || same(w, c)) continue;
      if (same(w, b)) {
        const auto [before, here, after] = triangle_at(place);
        if (is_inside_corner(before, a, b, c) || is_inside_corner(after, a, b, c)) return true;
        continue;
      }
      const auto least = std::min({turn(a, b, w), turn(b, c, w), turn(c, a, w)});
      if (least == Sign::positive || (least == Sign::zero && kind == Ear::clear)) return true;
    }
    return false;
  }

  bool is_inside_corner(std::size_t w, std::size_t a, std::size_t b, std::size_t c) const {
    return turn(a, b, w) == Sign::positive && turn(b, c, w) == Sign::positive;
  }

  const std::vector<Vec3>& corners_;
  Eigen::Index u_, v_;
  Sign sense_;
  std::vector<std::size_t> left_;
  std::size_t begin_ = 0;
};

}  // namespace

std::vector<std::array<std::size_t, 3>> clipped_ears(const std::vector<Vec3>& corners, const Vec3& normal) {
  return Ring(corners, normal).clipped();
}

}  // namespace condyle::io
