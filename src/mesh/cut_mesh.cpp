#include "mesh/cut_mesh.hpp"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <map>
#include <set>
#include <utility>

#include "condyle/error.hpp"
#include "mesh/disjoint_sets.hpp"
#include "mesh/enclosed_volume.hpp"
#include "mesh/plane_outline.hpp"
#include "mesh/require_solid.hpp"
#include "mesh/winding_number.hpp"

namespace condyle::mesh {
namespace {

std::string plane_text(std::size_t plane) {
  return "plane " + std::to_string(plane + 1);
}

[[noreturn]] void refuse_crossing(const std::string& name, std::size_t plane) {
  throw UsageError(plane_text(plane) + " meets " + name +
                   " in an outline that crosses itself, which cannot be closed: move the plane a little, or "
                   "mend the mesh");
}

/// Smaller volumes, mm^3, are not components: a fold that a plane touches.
constexpr double least_solid = 1e-6;

/// How often each directed edge in a plane is used more than its opposite.
class EdgeSum {
 public:
  explicit EdgeSum(const std::vector<double>& heights) : heights_(heights) {}

  void add(Index from, Index to) {
    if (heights_[from] != 0 || heights_[to] != 0) return;
    if (from < to)
      ++uses_[{from, to}];
    else
      --uses_[{to, from}];
  }
  void add(const Triangle& t) {
    for (std::size_t k = 0; k < 3; ++k) add(t[k], t[(k + 1) % 3]);
  }
  /// The edges that close the sum, each as often as it is needed.
  std::vector<DirectedEdge> closing() const {
    std::vector<DirectedEdge> edges;
    for (const auto& [ends, uses] : uses_)
      for (int i = 0; i < std::abs(uses); ++i)
        edges.push_back(uses > 0 ? DirectedEdge{ends.second, ends.first}
                                 : DirectedEdge{ends.first, ends.second});
    return edges;
  }

 private:
  const std::vector<double>& heights_;
  std::map<std::pair<Index, Index>, int> uses_ = {};
};

/// The surface on its way: what is behind all planes so far and what is not, and outlines of the flat faces that close the first.
class PlaneCutter {
 public:
  PlaneCutter(const Mesh& mesh, const std::string& name)
      : name_(name), before_(mesh.vertices().size()), vertices_(mesh.vertices()), inside_(mesh.triangles()) {
    used_.assign(before_, 0);
    for (const Triangle& t : inside_)
      for (const Index v : t) used_[v] = 1;
  }

  void cut(const CuttingPlane& plane) {
    const std::size_t number = planes_.size();
    planes_.push_back(plane);
    measure_heights(plane);
    check_meets(number);
    crossings_.clear();
    std::vector<Triangle> left;
    std::vector<Triangle> cut_off;
    for (const Triangle& t : inside_) divide(t, plane, left, cut_off);
    inside_ = std::move(left);
    if (inside_.empty())
      throw UsageError("nothing of " + name_ + " lies on the inner side of " +
                       (number == 0 ? "its plane" : "planes 1 to " + std::to_string(number + 1)));
    std::vector<std::vector<DirectedEdge>> outlines;
    for (std::size_t k = 0; k < outlines_.size(); ++k) outlines.push_back(clipped(k, plane, number));
    outlines_ = std::move(outlines);
    split_what_was_cut_off();
    outside_.insert(outside_.end(), cut_off.begin(), cut_off.end());

    // Everything else is closed already.
    EdgeSum sum(heights_);
    for (const Triangle& t : inside_) sum.add(t);
    for (const auto& outline : outlines_)
      for (const auto& [from, to] : outline) sum.add(from, to);
    outlines_.push_back(sum.closing());
  }

  CutMesh finish() {
    CutMesh done;
    for (std::size_t k = 0; k < planes_.size(); ++k) {
      const auto face = filled_outline(vertices_, outlines_[k], planes_[k].normal);
      if (!face) refuse_crossing(name_, k);
      faces_.insert(faces_.end(), face->begin(), face->end());
      plane_of_.insert(plane_of_.end(), face->size(), k);
    }
    done.pieces_behind = keep_largest();
    done.face_mm2.assign(planes_.size(), 0);
    for (std::size_t t = 0; t < faces_.size(); ++t) {
      const auto [a, b, c] = faces_[t];
      done.face_mm2[plane_of_[t]] +=
          (vertices_[b] - vertices_[a]).cross(vertices_[c] - vertices_[a]).norm() / 2;
    }
    done.inner = side_of(inside_, faces_);
    for (Triangle& t : faces_) std::swap(t[1], t[2]);
    done.outer = side_of(outside_, faces_);
    done.inner_mm3 = enclosed_volume(done.inner.mesh);
    done.outer_mm3 = enclosed_volume(done.outer.mesh);
    done.outer_pieces = solids_in(done.outer.mesh.triangles, done.outer.mesh.vertices).size();
    return done;
  }

 private:
  /// Above the plane, or 0 if it is on it.
  void measure_heights(const CuttingPlane& plane) {
    heights_.resize(vertices_.size());
    for (std::size_t v = 0; v < heights_.size(); ++v) {
      const double height = plane.normal.dot(vertices_[v] - plane.point);
      heights_[v] = std::abs(height) <= on_plane_mm ? 0 : height;
    }
  }

  void check_meets(std::size_t number) const {
    bool above = false, below = false;
    for (std::size_t v = 0; v < before_; ++v)
      if (used_[v]) above |= heights_[v] > 0, below |= heights_[v] < 0;
    if (!above || !below)
      throw UsageError(plane_text(number) + " misses " + name_ + ", which lies wholly on its " +
                       (above ? "outer side, where the normal points" : "inner side"));
  }

  /// Where an edge goes through the plane, the same from both ends.
  Index crossing(Index a, Index b) {
    const auto ends = std::minmax(a, b);
    const auto [at, is_new] = crossings_.try_emplace(ends, static_cast<Index>(vertices_.size()));
    if (is_new) {
      const Vec3 p = vertices_[ends.first], q = vertices_[ends.second];
      const double hp = heights_[ends.first], hq = heights_[ends.second];
      vertices_.push_back(p + hp / (hp - hq) * (q - p));
      heights_.push_back(0);
    }
    return at->second;
  }

  void divide(const Triangle& t, const CuttingPlane& plane, std::vector<Triangle>& left,
              std::vector<Triangle>& cut_off) {
    const auto height = [&](std::size_t k) { return heights_[t[k % 3]]; };
    bool above = false, below = false;
    for (std::size_t k = 0; k < 3; ++k) above |= height(k) > 0, below |= height(k) < 0;
    if (!above && !below) {
      const Vec3 a = vertices_[t[0]], b = vertices_[t[1]], c = vertices_[t[2]];
      above = (b - a).cross(c - a).dot(plane.normal) < 0;
    }
    if (!above) return left.push_back(t);
    if (!below) return cut_off.push_back(t);
    std::vector<Index> low, high;
    for (std::size_t k = 0; k < 3; ++k) {
      if (height(k) <= 0) low.push_back(t[k]);
      if (height(k) >= 0) high.push_back(t[k]);
      if ((height(k) < 0 && height(k + 1) > 0) || (height(k) > 0 && height(k + 1) < 0)) {
        const Index x = crossing(t[k], t[(k + 1) % 3]);
        low.push_back(x), high.push_back(x);
      }
    }
    add_polygon(low, left);
    add_polygon(high, cut_off);
  }

  /// A triangle, or four corners along the shorter diagonal.
  void add_polygon(const std::vector<Index>& p, std::vector<Triangle>& to) const {
    if (p.size() == 3) return to.push_back({p[0], p[1], p[2]});
    const double first = (vertices_[p[0]] - vertices_[p[2]]).squaredNorm(),
                 second = (vertices_[p[1]] - vertices_[p[3]]).squaredNorm();
    if (first <= second)
      to.push_back({p[0], p[1], p[2]}), to.push_back({p[0], p[2], p[3]});
    else
      to.push_back({p[0], p[1], p[3]}), to.push_back({p[1], p[2], p[3]});
  }

  /// Parts that an earlier plane cut off share edges with the remaining part: both are halved together.
  void split_what_was_cut_off() {
    std::vector<Triangle> split;
    for (const Triangle& t : outside_) {
      std::vector<Index> corners;
      std::size_t halved = 0;
      for (std::size_t k = 0; k < 3; ++k) {
        corners.push_back(t[k]);
        const auto found = crossings_.find(std::minmax(t[k], t[(k + 1) % 3]));
        if (found == crossings_.end()) continue;
        corners.push_back(found->second);
        ++halved;
      }
      // Every new point is cut off with a corner beside it, until a triangle or four corners are left.
      while (corners.size() > 4) {
        const auto is_new = [&](std::size_t i) {
          return std::find(t.begin(), t.end(), corners[i % corners.size()]) == t.end();
        };
        std::size_t i = 0;
        while (is_new(i) || !is_new(i + 1) || !is_new(i + corners.size() - 1)) ++i;
        split.push_back({corners[(i + corners.size() - 1) % corners.size()], corners[i],
                         corners[(i + 1) % corners.size()]});
        corners.erase(corners.begin() + static_cast<std::ptrdiff_t>(i));
      }
      if (halved == 1) {
        // The new point lies on the side between two of the four: the way to the third parts them.
        std::size_t i = 0;
        while (std::find(t.begin(), t.end(), corners[i]) != t.end()) ++i;
        const auto at = [&](std::size_t k) { return corners[(i + k) % 4]; };
        split.push_back({at(0), at(1), at(2)}), split.push_back({at(0), at(2), at(3)});
      } else {
        add_polygon(corners, split);
      }
    }
    outside_ = std::move(split);
  }

  /// The part of an earlier face's outline that a plane leaves.
  std::vector<DirectedEdge> clipped(std::size_t face, const CuttingPlane& plane, std::size_t number) {
    std::vector<DirectedEdge> left;
    std::set<Index> on_line;
    for (const auto& [a, b] : outlines_[face]) {
      const double ha = heights_[a], hb = heights_[b];
      if (ha <= 0 && hb <= 0) {
        if (ha < 0 || hb < 0)
          left.push_back({a, b});
        else
          on_line.insert({a, b});
      } else if (ha < 0) {
        left.push_back({a, crossing(a, b)});
      } else if (hb < 0) {
        left.push_back({crossing(a, b), b});
      }
    }
    // The rest of the outline runs along the line in which both planes meet, with what is left on its left.
    std::map<Index, int> ending;
    for (const Index v : on_line) ending[v] = 0;
    for (const auto& [a, b] : left) --ending[a], ++ending[b];
    const Vec3 along = planes_[face].normal.cross(plane.normal);
    std::vector<std::pair<double, Index>> line;
    for (const auto& [v, count] : ending)
      if (count != 0 || on_line.count(v) > 0) line.emplace_back(along.dot(vertices_[v]), v);
    std::sort(line.begin(), line.end());
    int open = 0;
    for (std::size_t i = 0; i < line.size(); ++i) {
      open += ending[line[i].second];
      if (open == 0) continue;
      if (open != 1 || i + 1 == line.size()) refuse_crossing(name_, number);
      left.push_back({line[i].second, line[i + 1].second});
    }
    return left;
  }

  struct Solid {
    Index representative = 0;
    double volume = 0;
  };

  /// Pieces that hang together in vertices and have a volume: no cavities.
  static std::vector<Solid> solids_in(const std::vector<Triangle>& triangles, const Points& vertices) {
    DisjointSets sets(vertices.size());
    for (const Triangle& t : triangles) sets.join(t[0], t[1]), sets.join(t[1], t[2]);
    std::map<Index, double> volumes;
    for (const Triangle& t : triangles)
      volumes[sets.find(t[0])] += vertices[t[0]].dot(vertices[t[1]].cross(vertices[t[2]])) / 6;
    std::vector<Solid> solids;
    for (const auto& [representative, volume] : volumes)
      if (volume > least_solid) solids.push_back({representative, volume});
    return solids;
  }

  /// Gives pieces behind all planes but the largest back to the rest, whole as they were. Cavities go with what they are in.
  std::size_t keep_largest() {
    std::vector<Triangle> all = inside_;
    all.insert(all.end(), faces_.begin(), faces_.end());
    const std::vector<Solid> solids = solids_in(all, vertices_);
    if (solids.size() < 2) return solids.size();
    const Solid& largest = *std::max_element(
        solids.begin(), solids.end(), [](const Solid& a, const Solid& b) { return a.volume < b.volume; });
    DisjointSets sets(vertices_.size());
    for (const Triangle& t : all) sets.join(t[0], t[1]), sets.join(t[1], t[2]);
    std::set<Index> own = {largest.representative};
    TriMesh shell{vertices_, {}};
    std::set<Index> cavities;
    for (const Triangle& t : all) {
      const Index piece = sets.find(t[0]);
      if (piece == largest.representative)
        shell.triangles.push_back(t);
      else if (std::none_of(solids.begin(), solids.end(),
                            [&](const Solid& solid) { return solid.representative == piece; }))
        cavities.insert(piece);
    }
    if (!cavities.empty()) {
      const WindingNumber winding{Mesh(std::move(shell))};
      for (const Index cavity : cavities)
        if (winding.at(vertices_[cavity]).winding > 0) own.insert(cavity);
    }
    const auto is_own = [&](const Triangle& t) { return own.count(sets.find(t[0])) > 0; };
    const auto other = std::stable_partition(inside_.begin(), inside_.end(), is_own);
    outside_.insert(outside_.end(), other, inside_.end());
    inside_.erase(other, inside_.end());
    std::vector<Triangle> faces;
    std::vector<std::size_t> plane_of;
    for (std::size_t t = 0; t < faces_.size(); ++t)
      if (is_own(faces_[t])) faces.push_back(faces_[t]), plane_of.push_back(plane_of_[t]);
    faces_ = std::move(faces), plane_of_ = std::move(plane_of);
    return solids.size();
  }

  CutSide side_of(const std::vector<Triangle>& surface, const std::vector<Triangle>& faces) const {
    std::vector<Index> number(vertices_.size(), no_index);
    for (const auto* triangles : {&surface, &faces})
      for (const Triangle& t : *triangles)
        for (const Index v : t) number[v] = 0;
    CutSide side;
    side.cut_triangles = faces.size();
    for (std::size_t v = 0; v < number.size(); ++v) {
      if (number[v] == no_index) continue;
      number[v] = static_cast<Index>(side.mesh.vertices.size());
      side.mesh.vertices.push_back(vertices_[v]);
      side.vertex_before.push_back(v < before_ ? static_cast<Index>(v) : no_index);
    }
    for (const auto* triangles : {&surface, &faces})
      for (const Triangle& t : *triangles)
        side.mesh.triangles.push_back({number[t[0]], number[t[1]], number[t[2]]});
    return side;
  }

  const std::string& name_;
  std::size_t before_;  ///< vertices of the mesh that is cut
  Points vertices_;
  std::vector<Triangle> inside_, outside_ = {};
  std::vector<char> used_ = {};
  std::vector<CuttingPlane> planes_ = {};
  std::vector<double> heights_ = {};
  std::map<std::pair<Index, Index>, Index> crossings_ = {};
  std::vector<std::vector<DirectedEdge>> outlines_ = {};  ///< of each plane's face, as the inner side has it
  std::vector<Triangle> faces_ = {};
  std::vector<std::size_t> plane_of_ = {};
};

}  // namespace

CutMesh cut_by_planes(const Mesh& mesh, const std::string& name, std::span<const CuttingPlane> planes) {
  require_solid(mesh, name);
  PlaneCutter cutter(mesh, name);
  for (const CuttingPlane& plane : planes) cutter.cut(plane);
  CutMesh done = cutter.finish();
  for (const CutSide* side : {&done.inner, &done.outer})
    if (!Mesh(side->mesh).is_closed())
      throw UsageError("the planes meet " + name +
                       " where its surface touches itself, which cannot be closed: move them a little");
  return done;
}

}  // namespace condyle::mesh
