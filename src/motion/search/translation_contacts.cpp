#include "motion/search/translation_contacts.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>

#include "core/pair.hpp"
#include "core/predicates.hpp"
#include "mesh/triangle_tree.hpp"
#include "mesh/vertical_ray.hpp"

namespace condyle::motion {
namespace {

using core::rounding_unit, core::Sign;
using mesh::TriangleCorners;
using Node = mesh::TriangleTree::Node;

constexpr double unbounded = std::numeric_limits<double>::infinity();

/// Vertices of a body whose positions inside the other are taken for contact without a pair of triangles.
constexpr std::size_t most_sliding_probes = 256;

/// Contacts collected before they are united with the rest.
constexpr std::size_t contacts_at_a_time = 256;

/// Positions that are as near as this share of the coordinates to an end of a probe's are left to the pairs.
constexpr double probe_slack = 1e-9;

Sign orientation_2d(const Vec3& a, const Vec3& b, const Vec3& c) noexcept {
  return core::orientation_2d(a.x(), a.y(), b.x(), b.y(), c.x(), c.y());
}

bool has_area(const TriangleCorners& t) noexcept {
  const auto seen = [&](int x, int y) {
    return core::orientation_2d(t[0][x], t[0][y], t[1][x], t[1][y], t[2][x], t[2][y]) != Sign::zero;
  };
  return seen(0, 1) || seen(1, 2) || seen(2, 0);
}

TriMesh placed(const Mesh& body, const AxisFrame& frame, std::vector<Index>& kept) {
  TriMesh out{Points(body.vertices().size()), {}};
  for (std::size_t v = 0; v < body.vertices().size(); ++v)
    out.vertices.set(v, frame.to_axis(body.vertices()[v]));
  for (Index t = 0; t < body.triangles().size(); ++t) {
    if (!has_area({out.vertices[body.triangles()[t][0]], out.vertices[body.triangles()[t][1]],
                   out.vertices[body.triangles()[t][2]]}))
      continue;
    out.triangles.push_back(body.triangles()[t]);
    kept.push_back(t);
  }
  return out;
}

/// A height with a bound on its error.
struct SeenHeight {
  double z, error;
};

/// At a share n / d of the way from a to b, where both have these errors.
SeenHeight height_between(double a, double b, double n, double n_error, double d, double d_error) noexcept {
  const double low = std::min(a, b), high = std::max(a, b);
  const double share = n / d, rest = std::abs(d) - d_error;
  const double share_error = rest > 0 ? (n_error + std::abs(share) * d_error) / rest : unbounded;
  if (!(share_error < 1)) return {low + (high - low) / 2, high - low};
  const double z = std::clamp(a + share * (b - a), low, high);
  return {z, std::min(high - low, share_error * (high - low)) +
                 4 * rounding_unit * std::max(std::abs(a), std::abs(b))};
}

/// Terms of a product that leave less than this share of them have lost digits: a face that the direction lies in is seen as a sliver,
/// and heights on it are quotients of such products.
constexpr double cancelled_share = 0x1p-6;

/// A product of differences that is computed in pairs of doubles is off by less than this share of its terms.
constexpr double pair_rounding = 0x1p-98;

/// (a - o) x (b - p) seen along z, and its error.
struct SeenProduct {
  double value, error;
  SeenProduct(const Vec3& o, const Vec3& a, const Vec3& b) noexcept : SeenProduct(o, a, o, b) {}
  SeenProduct(const Vec3& o, const Vec3& a, const Vec3& p, const Vec3& b) noexcept {
    const double ab = (a.x() - o.x()) * (b.y() - p.y()), ba = (a.y() - o.y()) * (b.x() - p.x());
    const double terms = std::abs(ab) + std::abs(ba);
    value = ab - ba, error = 6 * rounding_unit * terms;
    if (!(std::abs(value) < cancelled_share * terms)) return;
    const auto between = [](double from, double to) { return core::exact_sum(to, -from); };
    const core::Pair exact =
        between(o.x(), a.x()) * between(p.y(), b.y()) - between(o.y(), a.y()) * between(p.x(), b.x());
    value = exact.high, error = rounding_unit * std::abs(value) + pair_rounding * terms;
  }
};

/// Of the triangle below or above p, which it holds as seen.
SeenHeight height_at(const TriangleCorners& t, const Vec3& p) noexcept {
  const double low = std::min({t[0].z(), t[1].z(), t[2].z()}),
               high = std::max({t[0].z(), t[1].z(), t[2].z()});
  const SeenProduct area(t[0], t[1], t[2]), of_b(t[0], p, t[2]), of_c(t[0], t[1], p);
  const double rest = std::abs(area.value) - area.error;
  const double b = t[1].z() - t[0].z(), c = t[2].z() - t[0].z();
  const double z = (of_b.value * b + of_c.value * c) / area.value;
  const double error =
      rest > 0 ? (of_b.error * std::abs(b) + of_c.error * std::abs(c) + std::abs(z) * area.error) / rest
               : unbounded;
  if (!(error < high - low)) return {low + (high - low) / 2, high - low};
  return {std::clamp(t[0].z() + z, low, high),
          error + 6 * rounding_unit * (std::abs(t[0].z()) + std::abs(b) + std::abs(c))};
}

/// All positions at which one pair of triangles meets.
class PairContact {
 public:
  PairContact(const TriangleCorners& fixed, const TriangleCorners& mobile) : f_(fixed), m_(mobile) {
    for (const Vec3& v : mobile) over(fixed, v, [&](const SeenHeight& at) { add(at, {v.z(), 0}, v); });
    for (const Vec3& v : fixed) over(mobile, v, [&](const SeenHeight& at) { add({v.z(), 0}, at, v); });
    for (std::size_t k = 0; k < 3; ++k)
      for (std::size_t l = 0; l < 3; ++l) cross(f_[k], f_[(k + 1) % 3], m_[l], m_[(l + 1) % 3]);
  }

  bool empty() const noexcept { return !(low_.at_mm <= high_.at_mm); }
  const TranslationEnd& low() const noexcept { return low_; }
  const TranslationEnd& high() const noexcept { return high_; }

 private:
  void add(const SeenHeight& fixed, const SeenHeight& mobile, const Vec3& seen) noexcept {
    const double t = fixed.z - mobile.z;
    const double error =
        fixed.error + mobile.error + 2 * rounding_unit * (std::abs(fixed.z) + std::abs(mobile.z));
    const Vec3 point(seen.x(), seen.y(), fixed.z);
    if (t - error < low_.at_mm) low_.at_mm = t - error, low_.point = point;
    if (t + error > high_.at_mm) high_.at_mm = t + error, high_.point = point;
    low_.sure_mm = std::min(low_.sure_mm, t + error);
    high_.sure_mm = std::max(high_.sure_mm, t - error);
  }

  /// with(height) for what of the triangle is over or under p.
  template <class With>
  static void over(const TriangleCorners& t, const Vec3& p, const With& with) {
    const Sign sense = orientation_2d(t[0], t[1], t[2]);
    if (sense != Sign::zero) {
      for (std::size_t k = 0; k < 3; ++k)
        if (orientation_2d(t[k], t[(k + 1) % 3], p) == -sense) return;
      with(height_at(t, p));
      return;
    }
    // Seen from its edge: no more than its edges.
    for (std::size_t k = 0; k < 3; ++k) {
      const Vec3 &a = t[k], &b = t[(k + 1) % 3];
      if (orientation_2d(a, b, p) != Sign::zero) continue;
      const bool is_wide = std::abs(a.x() - b.x()) >= std::abs(a.y() - b.y());
      const int axis = is_wide ? 0 : 1;
      if (p[axis] < std::min(a[axis], b[axis]) || p[axis] > std::max(a[axis], b[axis])) continue;
      if (p[1 - axis] < std::min(a[1 - axis], b[1 - axis]) ||
          p[1 - axis] > std::max(a[1 - axis], b[1 - axis]))
        continue;
      if (a[axis] == b[axis]) {
        with({a.z(), 0}), with({b.z(), 0});
      } else {
        const double n = p[axis] - a[axis], d = b[axis] - a[axis];
        with(height_between(a.z(), b.z(), n, rounding_unit * std::abs(n), d, rounding_unit * std::abs(d)));
      }
    }
  }

  /// Where two edges go through each other as seen; where one ends on the other, corners do.
  void cross(const Vec3& p, const Vec3& q, const Vec3& r, const Vec3& s) noexcept {
    const Sign at_r = orientation_2d(p, q, r), at_p = orientation_2d(r, s, p);
    if (at_r == Sign::zero || at_p == Sign::zero || orientation_2d(p, q, s) != -at_r ||
        orientation_2d(r, s, q) != -at_p)
      return;
    const SeenProduct across(p, q, r, s), of_p(p, r, r, s), of_r(p, r, q);
    const SeenHeight fixed = height_between(p.z(), q.z(), of_p.value, of_p.error, across.value, across.error);
    const SeenHeight mobile =
        height_between(r.z(), s.z(), of_r.value, of_r.error, across.value, across.error);
    const double share = std::clamp(of_p.value / across.value, 0.0, 1.0);
    add(fixed, mobile, p + share * (q - p));
  }

  const TriangleCorners &f_, &m_;
  TranslationEnd low_{unbounded, unbounded, no_index, no_index, Vec3::Zero()};
  TranslationEnd high_{-unbounded, -unbounded, no_index, no_index, Vec3::Zero()};
};

/// Contacts that are united as they come.
class ContactUnion {
 public:
  /// Whether all positions between are known to be in contact, those too that a sum may have rounded off.
  bool holds(double low, double high) const noexcept {
    low -= 2 * rounding_unit * std::abs(low), high += 2 * rounding_unit * std::abs(high);
    const auto after = std::upper_bound(
        found_.begin(), found_.end(), low,
        [](double value, const TranslationContact& contact) { return value < contact.low.at_mm; });
    return after != found_.begin() && (after - 1)->high.at_mm >= high;
  }
  void add(const TranslationContact& more) {
    fresh_.push_back(more);
    if (fresh_.size() == contacts_at_a_time) unite();
  }
  std::vector<TranslationContact> all() {
    unite();
    return std::move(found_);
  }
  void unite() {
    found_.insert(found_.end(), fresh_.begin(), fresh_.end());
    fresh_.clear();
    std::stable_sort(found_.begin(), found_.end(),
                     [](const auto& a, const auto& b) { return a.low.at_mm < b.low.at_mm; });
    std::vector<TranslationContact> apart;
    for (const TranslationContact& each : found_) {
      if (apart.empty() || each.low.at_mm > apart.back().high.at_mm) {
        apart.push_back(each);
        continue;
      }
      TranslationContact& known = apart.back();
      known.low.sure_mm = std::min(known.low.sure_mm, each.low.sure_mm);
      const double sure = std::max(known.high.sure_mm, each.high.sure_mm);
      if (each.high.at_mm > known.high.at_mm) known.high = each.high;
      known.high.sure_mm = sure;
    }
    found_ = std::move(apart);
  }

 private:
  std::vector<TranslationContact> found_, fresh_;
};

/// Positions at which some vertices of the probing body are inside the other, which is closed; `sense` is 1 if the probing body moves.
void add_probed(const SlidingBody& probing, const SlidingBody& closed, double sense, ContactUnion& found) {
  const double slack = probe_slack * (probing.size + closed.size);
  const auto& vertices = probing.tree.vertices();
  const std::size_t step = vertices.size() / most_sliding_probes + 1;
  struct Crossing {
    double z;
    int sense;
  };
  for (std::size_t v = 0; v < vertices.size(); v += step) {
    const Vec3& p = vertices[v];
    std::vector<Crossing> crossings;
    bool is_sure = true;  // or even the order of the crossings may be another
    std::vector<Index> open = {0};
    while (!open.empty()) {
      const Node& node = closed.tree.nodes()[open.back()];
      open.pop_back();
      if (std::abs(p.x() - node.centre[0]) > node.half[0] || std::abs(p.y() - node.centre[1]) > node.half[1])
        continue;
      if (!node.is_leaf()) {
        open.insert(open.end(), {node.child, node.child + 1});
        continue;
      }
      for (Index t = node.first; t < node.last; ++t) {
        const TriangleCorners corners = closed.tree.corners(t);
        if (const int crossed = mesh::vertical_crossing(corners, p); crossed != 0) {
          const SeenHeight at = height_at(corners, p);
          crossings.push_back({at.z, crossed});
          is_sure &= at.error < slack;
        }
      }
    }
    if (!is_sure) continue;
    std::sort(crossings.begin(), crossings.end(),
              [](const Crossing& a, const Crossing& b) { return a.z < b.z; });
    int winding = 0;  // a line from below enters where normals point down
    for (std::size_t i = 0; i + 1 < crossings.size(); ++i) {
      winding -= crossings[i].sense;
      const double enters = crossings[i].z + slack, leaves = crossings[i + 1].z - slack;
      if (winding <= 0 || !(enters < leaves)) continue;
      const double a = sense * (enters - p.z()), b = sense * (leaves - p.z());
      const double low = std::min(a, b), high = std::max(a, b);
      found.add({{low, low, no_index, no_index, p}, {high, high, no_index, no_index, p}});
    }
  }
  found.unite();
}

struct PlacedNodes {
  Index fixed, mobile;
};

/// Positions at which the triangles of two nodes may meet.
struct PositionWindow {
  double low, high;
  PositionWindow(const Node& fixed, const Node& mobile) noexcept
      : low((double(fixed.centre[2]) - fixed.half[2]) - (double(mobile.centre[2]) + mobile.half[2])),
        high((double(fixed.centre[2]) + fixed.half[2]) - (double(mobile.centre[2]) - mobile.half[2])) {}
};

bool overlap_along(const Node& a, const Node& b) noexcept {
  return std::abs(double(a.centre[0]) - b.centre[0]) <= double(a.half[0]) + b.half[0] &&
         std::abs(double(a.centre[1]) - b.centre[1]) <= double(a.half[1]) + b.half[1];
}

bool overlap_along(const TriangleCorners& a, const TriangleCorners& b) noexcept {
  for (int k = 0; k < 2; ++k)
    if (std::max({a[0][k], a[1][k], a[2][k]}) < std::min({b[0][k], b[1][k], b[2][k]}) ||
        std::max({b[0][k], b[1][k], b[2][k]}) < std::min({a[0][k], a[1][k], a[2][k]}))
      return false;
  return true;
}

double lowest(const TriangleCorners& t) noexcept {
  return std::min({t[0].z(), t[1].z(), t[2].z()});
}
double highest(const TriangleCorners& t) noexcept {
  return std::max({t[0].z(), t[1].z(), t[2].z()});
}

void compare_as_seen(const SlidingBody& fixed, const Node& f, const SlidingBody& mobile, const Node& m,
                     ContactUnion& found) {
  for (Index i = f.first; i < f.last; ++i) {
    const TriangleCorners a = fixed.tree.corners(i);
    for (Index j = m.first; j < m.last; ++j) {
      const TriangleCorners b = mobile.tree.corners(j);
      if (!overlap_along(a, b) || found.holds(lowest(a) - highest(b), highest(a) - lowest(b))) continue;
      const PairContact pair(a, b);
      if (pair.empty()) continue;
      TranslationContact contact{pair.low(), pair.high()};
      for (TranslationEnd* end : {&contact.low, &contact.high})
        end->fixed_triangle = fixed.number(i), end->mobile_triangle = mobile.number(j);
      found.add(contact);
    }
  }
}

}  // namespace

SlidingBody::SlidingBody(const Mesh& body, const AxisFrame& frame)
    : mesh(placed(body, frame, kept)), tree(mesh), is_closed(body.is_closed()) {
  for (std::size_t v = 0; v < mesh.vertices.size(); ++v)
    size = std::max(size, mesh.vertices[v].cwiseAbs().maxCoeff());
}

std::vector<TranslationContact> translation_contacts(const Mesh& fixed, const Mesh& mobile_in_F,
                                                     const Vec3& direction) {
  const AxisFrame frame(Vec3::Zero(), direction);
  return translation_contacts(SlidingBody(fixed, frame), SlidingBody(mobile_in_F, frame), frame, {});
}

std::vector<TranslationContact> translation_contacts(const SlidingBody& fixed, const SlidingBody& mobile,
                                                     const AxisFrame& frame, const SlideRange& range) {
  ContactUnion found;
  const auto add_beyond = [&](double low, double high) {
    const auto end = [](double at) { return TranslationEnd{at, at, no_index, no_index, Vec3::Zero()}; };
    if (low < high) found.add({end(low), end(high)});
  };
  add_beyond(-unbounded, range.negative_mm);
  add_beyond(range.positive_mm, unbounded);
  found.unite();
  if (fixed.tree.empty() || mobile.tree.empty()) return found.all();
  if (fixed.is_closed) add_probed(mobile, fixed, 1, found);
  if (mobile.is_closed) add_probed(fixed, mobile, -1, found);
  std::vector<PlacedNodes> open = {{0, 0}};
  while (!open.empty()) {
    const PlacedNodes pair = open.back();
    open.pop_back();
    const Node &f = fixed.tree.nodes()[pair.fixed], &m = mobile.tree.nodes()[pair.mobile];
    const PositionWindow window(f, m);
    if (!overlap_along(f, m) || found.holds(window.low, window.high)) continue;
    if (f.is_leaf() && m.is_leaf()) {
      compare_as_seen(fixed, f, mobile, m, found);
    } else if (!f.is_leaf() && (m.is_leaf() || f.size() >= m.size())) {
      open.push_back({f.child, pair.mobile}), open.push_back({f.child + 1, pair.mobile});
    } else {
      open.push_back({pair.fixed, m.child}), open.push_back({pair.fixed, m.child + 1});
    }
  }
  std::vector<TranslationContact> contacts = found.all();
  for (TranslationContact& contact : contacts)
    for (TranslationEnd* end : {&contact.low, &contact.high}) end->point = frame.from_axis(end->point);
  return contacts;
}

}  // namespace condyle::motion
