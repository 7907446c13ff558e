#include "contact/overlap.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <optional>

#include "contact/prism_grid.hpp"
#include "core/ordered_sums.hpp"
#include "core/parallel.hpp"
#include "mesh/enclosed_volume.hpp"

namespace condyle::contact {
namespace {

using prisms::Corner, prisms::Crop, prisms::Grid, prisms::Moments, prisms::Polygon, prisms::Prism,
    prisms::unit_rounding;
using prisms::cut, prisms::integral_between, prisms::moments_of;

/// To three directions at right angles, to rounding, along none of which meshes have edges or faces: the rotation of the quaternion
/// (13^1/2, 2^1/2, 5^1/2, -0.3 3^1/2), its entries written out so that they are the same on every machine.
Pose to_general_axes() {
  Pose X = Pose::Identity();
  X.linear() << 0.48001973359644795, 0.49686996148869256, 0.7229808411902907,  //
      0.1271611505326946, 0.7760236803157375, -0.6177518024129265,             //
      -0.8679925674527383, 0.38846813120183127, 0.3093241243216576;
  return X;
}

struct OverlapBox {
  Vec3 low = Vec3::Constant(std::numeric_limits<double>::infinity());
  Vec3 high = Vec3::Constant(-std::numeric_limits<double>::infinity());

  bool empty() const noexcept { return !(low.array() <= high.array()).all(); }
  void add(const Vec3& p) noexcept { low = low.cwiseMin(p), high = high.cwiseMax(p); }
  void add(const OverlapBox& other) noexcept {
    low = low.cwiseMin(other.low), high = high.cwiseMax(other.high);
  }
  OverlapBox common_with(const OverlapBox& other) const noexcept {
    OverlapBox common;
    common.low = low.cwiseMax(other.low), common.high = high.cwiseMin(other.high);
    return common;
  }
};

OverlapBox box_of(const TriMesh& mesh, std::size_t triangle) noexcept {
  OverlapBox box;
  for (int k = 0; k < 3; ++k) box.add(mesh.corner(triangle, k));
  return box;
}

/// Holds everything that is inside both bodies: where the overlap ends along a direction, there is a vertex of one body inside the
/// other, or two triangles meet.
OverlapBox box_of_overlap(const OverlapBody& fixed, const OverlapBody& mobile,
                          std::span<const TrianglePair> pairs) {
  OverlapBox box;
  for (const OverlapBody* body : {&fixed, &mobile})
    for (std::size_t v = 0; v < body->states.size(); ++v)
      if (body->states[v] != PointState::outside) box.add(body->surface.vertices[v]);
  for (const TrianglePair& pair : pairs) {
    const OverlapBox common =
        box_of(fixed.surface, pair.fixed).common_with(box_of(mobile.surface, pair.mobile));
    // Exact tests say that the two meet, for coordinates that were rounded otherwise.
    box.add(common.empty() ? box_of(fixed.surface, pair.fixed) : common);
  }
  return box;
}

/// A volume and what its roundings can amount to, in unit roundings.
struct Sum {
  double volume = 0, error = 0;
};

struct Total {
  mesh::CompensatedSum volume, error;

  void add(const Sum& sum) { volume.add(sum.volume), error.add(sum.error); }
};

/// A body's prisms in the order of triangles. Triangles that coincide are one, with the sum of their signs: a body that has each of them
/// eight times would else have 64 times the pairs.
struct Prisms {
  std::vector<Prism> once;
  std::vector<Prism> again;  ///< those that are one with others, each as it is

  explicit Prisms(std::vector<Prism> all) : once(std::move(all)) {
    std::vector<std::pair<std::array<double, 6>, std::size_t>> by_box;
    by_box.reserve(once.size());
    for (std::size_t i = 0; i < once.size(); ++i) by_box.emplace_back(once[i].box(), i);
    std::sort(by_box.begin(), by_box.end());
    std::vector<std::vector<std::size_t>> groups;  // of one box, each of triangles that coincide
    std::vector<char> is_one_with(once.size());
    for (std::size_t first = 0, last = 0; first < by_box.size(); first = last) {
      while (last < by_box.size() && by_box[last].first == by_box[first].first) ++last;
      if (last - first == 1) continue;
      groups.clear();
      for (std::size_t at = first; at < last; ++at) {
        const std::size_t i = by_box[at].second;
        const auto group = std::find_if(groups.begin(), groups.end(), [&](const auto& members) {
          return once[members[0]].coincides_with(once[i]);
        });
        group == groups.end() ? groups.push_back({i}) : group->push_back(i);
      }
      for (const auto& group : groups) merge(group, is_one_with);
    }
    if (again.empty()) return;
    std::sort(again.begin(), again.end(),
              [](const Prism& a, const Prism& b) { return a.triangle < b.triangle; });
    std::size_t kept = 0;
    for (std::size_t i = 0; i < once.size(); ++i)
      if (!is_one_with[i] && once[i].sign != 0) once[kept++] = once[i];
    once.erase(once.begin() + static_cast<std::ptrdiff_t>(kept), once.end());
  }

 private:
  void merge(const std::vector<std::size_t>& group, std::vector<char>& is_one_with) {
    if (group.size() < 2) return;
    for (const std::size_t i : group) again.push_back(once[i]);
    for (std::size_t k = 1; k < group.size(); ++k)
      once[group[0]].sign += once[group[k]].sign, is_one_with[group[k]] = 1;
  }
};

/// The overlap's box and both surfaces about it, turned so that nothing runs along z. z is 0 at the box's bottom.
class Columns {
 public:
  Columns(const OverlapBody& fixed, const OverlapBody& mobile, const OverlapBox& box_F)
      : to_axes_(to_general_axes()),
        from_axes_(inverted(to_axes_)),
        origin_(box_F.low + (box_F.high - box_F.low) / 2) {
    const Points of_fixed = turned(fixed.surface.vertices), of_mobile = turned(mobile.surface.vertices);
    Pose sizes = to_axes_;
    sizes.matrix() = sizes.matrix().cwiseAbs();
    const Vec3 half = posed(sizes, (box_F.high - origin_).cwiseMax(origin_ - box_F.low));
    const double margin = 64 * unit_rounding * (half.maxCoeff() + origin_.cwiseAbs().maxCoeff());
    const Vec3 reach = half + Vec3::Constant(margin);
    choose_up(fixed.surface, of_fixed, mobile.surface, of_mobile, reach);
    const Vec3 r = seen(reach).cwiseAbs();
    bottom_ = -r.z();
    crop_ = {-r.x(), r.x(), -r.y(), r.y(), 2 * r.z()};
    Prisms of_fixed_once(prisms_of(fixed.surface, of_fixed)),
        of_mobile_once(prisms_of(mobile.surface, of_mobile));
    fixed_.emplace(Body{Grid(crop_, std::move(of_fixed_once.once)), std::move(of_fixed_once.again)});
    mobile_.emplace(Body{Grid(crop_, std::move(of_mobile_once.once)), std::move(of_mobile_once.again)});
  }

  const Grid& fixed() const noexcept { return fixed_->grid; }
  const Grid& mobile() const noexcept { return mobile_->grid; }

  /// What is below a triangle of the body that has this grid; nothing if that is beside the crop.
  const Prism* below(const Grid& own, Index triangle) const noexcept {
    for (const std::vector<Prism>* prisms :
         {&(&own == &fixed_->grid ? fixed_ : mobile_)->again, &own.prisms()}) {
      const auto found = std::lower_bound(prisms->begin(), prisms->end(), triangle,
                                          [](const Prism& p, Index t) { return p.triangle < t; });
      if (found != prisms->end() && found->triangle == triangle) return &*found;
    }
    return nullptr;
  }

  /// Integral of the product of both bodies' winding numbers over the crop.
  Total common_volume() const {
    std::vector<Sum> sums(mobile().prisms().size());
    core::parallel_chunks(sums.size(), 32, [&](std::size_t first, std::size_t last) {
      for (std::size_t i = first; i < last; ++i) {
        const Prism& prism = mobile().prisms()[i];
        const Polygon part = crop_.of(prism);
        fixed().for_each_near(prism,
                              [&](Index, const Prism& other) { add_common(prism, part, other, 1, sums[i]); });
      }
    });
    Total total;
    for (const Sum& sum : sums) total.add(sum);
    add_placing(total);
    return total;
  }

  /// Integral of w (w - 1) over the crop for one body's winding number w.
  Total covered_again(const Grid& body) const {
    std::vector<Sum> sums(body.prisms().size());
    core::parallel_chunks(sums.size(), 32, [&](std::size_t first, std::size_t last) {
      for (std::size_t i = first; i < last; ++i) {
        const Prism& prism = body.prisms()[i];
        const Polygon part = crop_.of(prism);
        body.for_each_near(prism, [&](Index j, const Prism& other) {
          if (j > i) add_common(prism, part, other, 2, sums[i]);
        });
        if (const double s = prism.sign; s != 1)
          sums[i].volume += s * (s - 1) * integral_between(part, crop_.top);
      }
    });
    Total total;
    for (const Sum& sum : sums) total.add(sum);
    add_placing(total);
    return total;
  }

  /// Integral over the crop of (w - 1)+ of one body where the other is: what the common volume counts again. Seen along z, all prisms near a
  /// triangle divide it into pieces through each of which both winding numbers change alike, and the integral is a sum over pieces of
  /// their heights times the change, because nothing of it is above the crop. Triangles that coincide lie one above the other in the order of
  /// body and number.
  double counted_again(const Grid& body, const Grid& other) const {
    const std::array<const Grid*, 2> grids{&body, &other};
    struct Piece {
      Polygon part;
      std::array<double, 2> above;  // winding numbers of both bodies
    };
    const auto is_again = [](const std::array<double, 2>& w) {
      return w[1] > 0 ? std::max(w[0] - 1, 0.0) : 0.0;
    };
    // Edges that coincide leave slivers as narrow as rounding, which every further edge would cut again; so little is in them that a million
    // are below a rounding of the whole.
    const auto is_sliver = [&](const Polygon& part) {
      return part.count < 3 || std::abs(moments_of(part).area) < 16 * unit_rounding * size_ * size_;
    };
    mesh::CompensatedSum sum;
    for (std::size_t own = 0; own < 2; ++own) {
      const std::vector<Prism>& prisms = grids[own]->prisms();
      std::vector<double> sums(prisms.size());
      core::parallel_chunks(prisms.size(), 8, [&](std::size_t first, std::size_t last) {
        std::vector<Piece> pieces, divided;
        std::vector<Polygon> beyond;
        for (std::size_t i = first; i < last; ++i) {
          const Prism& prism = prisms[i];
          if (prism.low_z > crop_.top) continue;
          pieces.assign(1, {crop_.of(prism), {}});
          for (std::size_t of = 0; of < 2; ++of)
            grids[of]->for_each_near(prism, [&](Index j, const Prism& another) {
              if ((of == own && j == i) || another.high_z < prism.low_z || another.is_beside(prism)) return;
              const double nudge = (std::pair(of, std::size_t{j}) > std::pair(own, i) ? 64 : -64) *
                                   unit_rounding * size_ * (prism.secant + another.secant);
              divided.clear();
              for (const Piece& piece : pieces) {
                if (is_sliver(another.clipped(piece.part))) {
                  divided.push_back(piece);
                  continue;
                }
                beyond.clear();
                const Polygon within = another.divided(piece.part, beyond);
                const auto apart = [&](std::size_t k) {
                  return another.height_at(within.corners[k]) - within.corners[k].z + nudge;
                };
                const auto add = [&](const Polygon& part, double sign) {
                  if (is_sliver(part)) return;
                  divided.push_back({part, piece.above});
                  divided.back().above[of] += sign;
                };
                for (const Polygon& part : beyond) add(part, 0);
                add(cut(within, apart), another.sign);
                add(cut(within, [&](std::size_t k) { return -apart(k); }), 0);
              }
              pieces.swap(divided);
            });
          for (const Piece& piece : pieces) {
            std::array<double, 2> below = piece.above;
            below[own] += prism.sign;
            const double change = is_again(below) - is_again(piece.above);
            if (change != 0) sums[i] += change * integral_between(piece.part, crop_.top);
          }
        }
      });
      for (const double each : sums) sum.add(each);
    }
    return sum.value();
  }

  /// The part of a body's triangle that is inside the other body; nothing if that is no more than rounding.
  std::optional<PatchPart> part_inside(const Prism& prism, const Grid& other_body) const {
    Polygon part = crop_.of(prism);
    part = cut(part, [&](std::size_t k) { return part.corners[k].z; });
    part = cut(part, [&](std::size_t k) { return crop_.top - part.corners[k].z; });
    if (part.count < 3) return std::nullopt;
    double area = 0, noise = 0;
    Vec3 moment = Vec3::Zero();
    other_body.for_each_near(prism, [&](Index, const Prism& other) {
      if (other.high_z < prism.low_z || prism.is_beside(other)) return;
      const Polygon common = other.clipped(part);
      if (common.count < 3) return;
      // A little below the surface, on its body's inner side: surfaces that coincide do not leave it to rounding.
      const double below = prism.sign * 64 * unit_rounding * size_ * (prism.secant + other.secant);
      const Polygon covered = cut(common, [&](std::size_t k) {
        return other.height_at(common.corners[k]) - common.corners[k].z + below;
      });
      if (covered.count < 3) return;
      const Corner& o = covered.corners[0];
      for (std::size_t k = 2; k < covered.count; ++k) {
        const Corner &a = covered.corners[k - 1], &b = covered.corners[k];
        const double piece = other.sign * ((a.x - o.x) * (b.y - o.y) - (a.y - o.y) * (b.x - o.x)) / 2;
        area += piece;
        moment += piece / 3 * Vec3(o.x + a.x + b.x, o.y + a.y + b.y, o.z + a.z + b.z);
      }
      noise += std::abs(other.sign) * width_of_common(prism, other);
    });
    // Two units for each length that is cut, times its coordinates.
    if (!(area > 64 * unit_rounding * size_ * noise)) return std::nullopt;
    Vec3 centroid = moment / area;
    centroid = centroid.cwiseMax(Vec3(prism.low_x, prism.low_y, prism.low_z))
                   .cwiseMin(Vec3(prism.high_x, prism.high_y, prism.high_z));
    return PatchPart{prism.triangle, std::min(area / (prism.twice_area / 2), 1.0) * prism.area,
                     in_F(centroid)};
  }

 private:
  Points turned(const Points& points) const {
    Points out(points.size());
    core::parallel_chunks(points.size(), 4096, [&](std::size_t first, std::size_t last) {
      for (std::size_t v = first; v < last; ++v) out.set(v, posed(to_axes_, points[v] - origin_));
    });
    return out;
  }

  /// Coordinates of `turned` in those of the columns: another axis is z, up or down.
  Vec3 seen(const Vec3& p) const noexcept {
    const int x = (up_ + 1) % 3, y = (up_ + 2) % 3;
    return is_down_ ? Vec3(p[y], p[x], -p[up_]) : Vec3(p[x], p[y], p[up_]);
  }
  Vec3 in_F(const Vec3& p) const noexcept {
    const int x = (up_ + 1) % 3, y = (up_ + 2) % 3;
    const double z = p.z() + bottom_;
    Vec3 turned_back;
    turned_back[x] = is_down_ ? p.y() : p.x();
    turned_back[y] = is_down_ ? p.x() : p.y();
    turned_back[up_] = is_down_ ? -z : z;
    return posed(from_axes_, turned_back) + origin_;
  }

  /// Chooses the one of six directions along which fewest triangles of both bodies lie beyond the box.
  void choose_up(const TriMesh& fixed, const Points& of_fixed, const TriMesh& mobile, const Points& of_mobile,
                 const Vec3& reach) {
    using Counts = std::array<double, 6>;
    const auto counts_of = [&](const TriMesh& mesh, const Points& points) {
      Counts counts{};
      for (const Triangle& t : mesh.triangles) {
        const Vec3 a = points[t[0]], b = points[t[1]], c = points[t[2]];
        const Vec3 low = a.cwiseMin(b).cwiseMin(c), high = a.cwiseMax(b).cwiseMax(c);
        const auto within = [&](int axis) { return low[axis] <= reach[axis] && high[axis] >= -reach[axis]; };
        const std::array<bool, 3> in{within(0), within(1), within(2)};
        for (int axis = 0; axis < 3; ++axis) {
          const auto k = static_cast<std::size_t>(axis);
          if (!in[(k + 1) % 3] || !in[(k + 2) % 3]) continue;
          counts[2 * k] += high[axis] > -reach[axis];
          counts[2 * k + 1] += low[axis] < reach[axis];
        }
      }
      return counts;
    };
    const Counts f = counts_of(fixed, of_fixed), m = counts_of(mobile, of_mobile);
    double fewest = std::numeric_limits<double>::infinity();
    for (int k = 0; k < 6; ++k) {
      const int x = (k / 2 + 1) % 3, y = (k / 2 + 2) % 3;
      const auto i = static_cast<std::size_t>(k);
      const double pairs = f[i] * m[i] / (reach[x] * reach[y]);
      if (pairs < fewest) fewest = pairs, up_ = k / 2, is_down_ = k % 2 == 1;
    }
  }

  std::vector<Prism> prisms_of(const TriMesh& mesh, const Points& points) {
    std::vector<Prism> prisms;
    for (Index t = 0; t < mesh.triangles.size(); ++t) {
      std::array<Corner, 3> corners;
      for (std::size_t k = 0; k < 3; ++k) {
        const Vec3 p = seen(points[mesh.triangles[t][k]]);
        corners[k] = {p.x(), p.y(), p.z() - bottom_};
      }
      const auto [a, b, c] = corners;
      if (std::max({a.x, b.x, c.x}) < crop_.low_x || std::min({a.x, b.x, c.x}) > crop_.high_x ||
          std::max({a.y, b.y, c.y}) < crop_.low_y || std::min({a.y, b.y, c.y}) > crop_.high_y ||
          std::max({a.z, b.z, c.z}) <= 0)
        continue;
      const auto prism = Prism::below(t, corners);
      if (!prism) continue;
      prisms.push_back(*prism);
      surface_ += prism->area;
      for (const double extent :
           {-prism->low_x, prism->high_x, -prism->low_y, prism->high_y, -prism->low_z, prism->high_z})
        size_ = std::max(size_, extent);
    }
    return prisms;
  }

  static double width_of_common(const Prism& a, const Prism& b) noexcept {
    return std::min(a.high_x, b.high_x) - std::max(a.low_x, b.low_x) + std::min(a.high_y, b.high_y) -
           std::max(a.low_y, b.low_y);
  }

  /// s_i s_j times the integral of min(z_i, z_j), cut off below the box and above it. `part` is prism i in the crop.
  ///
  /// Roundings: a cut places a corner to within 16 units of the coordinates from where it belongs, by which the border of what is
  /// common moves; its height is that of triangle i there, to as much times the secant, and that of triangle j to as much times
  /// that triangle's steepness. Four cuts and the sums double that.
  void add_common(const Prism& i, const Polygon& part, const Prism& j, double times,
                  Sum& sum) const noexcept {
    if (i.is_beside(j)) return;
    const Polygon common = j.clipped(part);
    if (common.count < 3) return;
    std::array<double, Polygon::most> apart;  // z_i - z_j
    double highest = 0;
    bool any_above = false;
    for (std::size_t k = 0; k < common.count; ++k) {
      const double z_j = j.height_at(common.corners[k]);
      apart[k] = common.corners[k].z - z_j;
      any_above |= apart[k] > 0;
      highest = std::max(highest, std::min(common.corners[k].z, z_j));
    }
    highest = std::min(highest, crop_.top);
    const double area = moments_of(common).area;
    // Less where j is lower. Where the two coincide the sign of what is between them is anybody's guess, and so is the part; what is
    // taken off there is rounding all the same.
    double volume = integral_between(common, crop_.top);
    if (any_above) {
      Polygon part_above = cut(common, [&](std::size_t k) { return apart[k]; });
      volume -= integral_between(part_above, crop_.top);
      for (std::size_t k = 0; k < part_above.count; ++k)
        part_above.corners[k].z = j.height_at(part_above.corners[k]);
      volume += integral_between(part_above, crop_.top);
    }
    sum.volume += times * i.sign * j.sign * volume;
    sum.error += times * std::abs(i.sign * j.sign) * 64 * size_ *
                 (2 * width_of_common(i, j) * highest + std::abs(area) * (1 + i.secant + j.steepness));
  }

  /// Turning moved each vertex by some units of its coordinates, and what is common by that times the surface.
  void add_placing(Total& total) const {
    total.error.add(16 * size_ * surface_);
    total.error.add(4 * std::abs(total.volume.value()));
  }

  Pose to_axes_, from_axes_;
  Vec3 origin_;
  int up_ = 2;
  bool is_down_ = false;
  double bottom_ = 0;
  Crop crop_{};
  double size_ = 0, surface_ = 0;
  struct Body {
    Grid grid;
    std::vector<Prism> again;
  };
  std::optional<Body> fixed_, mobile_;
};

/// Triangles that are in a pair, in their order.
std::vector<Index> cut_triangles(std::span<const TrianglePair> pairs, Index TrianglePair::*of) {
  std::vector<Index> triangles;
  triangles.reserve(pairs.size());
  for (const TrianglePair& pair : pairs) triangles.push_back(pair.*of);
  std::sort(triangles.begin(), triangles.end());
  triangles.erase(std::unique(triangles.begin(), triangles.end()), triangles.end());
  return triangles;
}

/// A triangle in no pair is inside with all of it or with none.
PatchPart whole_triangle(const TriMesh& mesh, Index triangle) {
  const Vec3 a = mesh.corner(triangle, 0), b = mesh.corner(triangle, 1), c = mesh.corner(triangle, 2);
  return {triangle, core::ordered_norm((b - a).cross(c - a)) / 2, (a + b + c) / 3};
}

std::vector<PatchPart> patch_of(const OverlapBody& body, const std::vector<Index>& in_pairs,
                                const Columns& columns, const Grid& own, const Grid& other) {
  std::vector<std::optional<PatchPart>> parts(in_pairs.size());
  core::parallel_chunks(in_pairs.size(), 16, [&](std::size_t first, std::size_t last) {
    for (std::size_t i = first; i < last; ++i)
      if (const Prism* prism = columns.below(own, in_pairs[i])) parts[i] = columns.part_inside(*prism, other);
  });
  std::vector<PatchPart> patch;
  std::size_t next = 0;
  for (Index t = 0; t < body.surface.triangles.size(); ++t) {
    if (next < in_pairs.size() && in_pairs[next] == t) {
      if (parts[next]) patch.push_back(*parts[next]);
      ++next;
    } else if (body.states[body.surface.triangles[t][0]] == PointState::inside) {
      patch.push_back(whole_triangle(body.surface, t));
    }
  }
  return patch;
}

}  // namespace

Overlap overlap_of(const OverlapBody& fixed, const OverlapBody& mobile, std::span<const TrianglePair> pairs) {
  Overlap out;
  const OverlapBox box = box_of_overlap(fixed, mobile, pairs);
  if (box.empty()) return out;
  const Columns columns(fixed, mobile, box);
  if (!fixed.states.empty())
    out.fixed = patch_of(fixed, cut_triangles(pairs, &TrianglePair::fixed), columns, columns.fixed(),
                         columns.mobile());
  if (!mobile.states.empty())
    out.mobile = patch_of(mobile, cut_triangles(pairs, &TrianglePair::mobile), columns, columns.mobile(),
                          columns.fixed());
  if (fixed.states.empty() || mobile.states.empty()) return out;
  const Total common = columns.common_volume();
  out.volume = common.volume.value();
  out.volume_error = unit_rounding * common.error.value();
  if (out.has_volume()) out.volume = std::max(0.0, out.volume);
  // Most bodies cover nothing about the overlap more than once, which takes pairs of triangles only.
  const auto counted_again = [&](const Grid& body, const Grid& other) {
    const Total covered = columns.covered_again(body);
    const double rounding = unit_rounding * covered.error.value();
    if (!(covered.volume.value() > rounding)) return 0.0;
    const double again = columns.counted_again(body, other);
    return again > rounding ? again : 0;
  };
  out.fixed_covered_again = counted_again(columns.fixed(), columns.mobile());
  out.mobile_covered_again = counted_again(columns.mobile(), columns.fixed());
  return out;
}

}  // namespace condyle::contact
