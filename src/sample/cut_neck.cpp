#include "sample/cut_neck.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <vector>

#include "condyle/error.hpp"

namespace condyle::sample {
namespace {

constexpr Index gone = std::numeric_limits<Index>::max();

[[noreturn]] void refuse_cut() {
  throw UsageError("sample replacement: the neck of the femur cannot be cut across where neck and stem meet");
}

/// 1 for each vertex on the side of the head that edges join to the deepest one.
std::vector<std::uint8_t> head_side(const TriMesh& bone, const std::vector<double>& beyond) {
  std::vector<std::vector<Index>> neighbours(beyond.size());
  for (const Triangle& t : bone.triangles)
    for (std::size_t k = 0; k < 3; ++k) neighbours[t[k]].push_back(t[(k + 1) % 3]);
  std::vector<std::uint8_t> cut(beyond.size());
  std::vector<Index> front = {
      static_cast<Index>(std::min_element(beyond.begin(), beyond.end()) - beyond.begin())};
  if (!(beyond[front.front()] < 0)) refuse_cut();
  cut[front.front()] = 1;
  while (!front.empty()) {
    const Index v = front.back();
    front.pop_back();
    for (const Index other : neighbours[v])
      if (beyond[other] < 0 && cut[other] == 0) cut[other] = 1, front.push_back(other);
  }
  return cut;
}

/// The mesh that is left, and the directed edges of the cut as its triangles run along them.
class Remainder {
 public:
  Remainder(const TriMesh& bone, const Vec3& normal, double offset) : bone_(bone) {
    for (std::size_t v = 0; v < bone.vertices.size(); ++v)
      beyond_.push_back(normal.dot(bone.vertices[v]) - offset);
    const std::vector<std::uint8_t> cut = head_side(bone, beyond_);
    kept_.assign(cut.size(), gone);
    for (std::size_t v = 0; v < cut.size(); ++v)
      if (cut[v] == 0) {
        kept_[v] = static_cast<Index>(mesh_.vertices.size());
        mesh_.vertices.push_back(bone.vertices[v]);
      }
    for (const Triangle& t : bone.triangles) add(t);
  }

  TriMesh closed(const Vec3& normal) {
    if (next_.empty()) refuse_cut();
    std::vector<Index> ring = {next_.begin()->first};
    while (ring.size() <= next_.size()) {
      const auto found = next_.find(ring.back());
      if (found == next_.end()) refuse_cut();
      if (found->second == ring.front()) break;
      ring.push_back(found->second);
    }
    if (ring.size() != next_.size()) refuse_cut();
    Vec3 middle = Vec3::Zero();
    for (const Index v : ring) middle += mesh_.vertices[v] / static_cast<double>(ring.size());
    const auto centre = static_cast<Index>(mesh_.vertices.size());
    mesh_.vertices.push_back(middle);
    for (std::size_t i = 0; i < ring.size(); ++i) {
      // The face runs along each edge the other way, and looks against the normal.
      const Index a = ring[(i + 1) % ring.size()], b = ring[i];
      const Vec3 area = (mesh_.vertices[a] - middle).cross(mesh_.vertices[b] - middle);
      if (!(area.dot(normal) < 0)) refuse_cut();
      mesh_.triangles.push_back({centre, a, b});
    }
    return mesh_;
  }

 private:
  void add(const Triangle& t) {
    const auto is_kept = [&](std::size_t k) { return kept_[t[k % 3]] != gone; };
    const int count = is_kept(0) + is_kept(1) + is_kept(2);
    if (count == 0) return;
    if (count == 3) {
      mesh_.triangles.push_back({kept_[t[0]], kept_[t[1]], kept_[t[2]]});
      return;
    }
    // Turned so that corner 0 is the one of its kind.
    std::size_t first = 0;
    while (is_kept(first) != (count == 1)) ++first;
    const Index a = t[first], b = t[(first + 1) % 3], c = t[(first + 2) % 3];
    const Index ab = crossing(a, b), ac = crossing(a, c);
    if (count == 1) {
      mesh_.triangles.push_back({kept_[a], ab, ac});
      next_[ab] = ac;
    } else {
      mesh_.triangles.push_back({ab, kept_[b], kept_[c]});
      mesh_.triangles.push_back({ab, kept_[c], ac});
      next_[ac] = ab;
    }
  }

  Index crossing(Index a, Index b) {
    const auto edge = std::minmax(a, b);
    const auto [at, is_new] = crossings_.try_emplace(edge, static_cast<Index>(mesh_.vertices.size()));
    if (is_new) {
      const double da = beyond_[edge.first], db = beyond_[edge.second];
      const Vec3 p = bone_.vertices[edge.first], q = bone_.vertices[edge.second];
      mesh_.vertices.push_back(p + da / (da - db) * (q - p));
    }
    return at->second;
  }

  const TriMesh& bone_;
  std::vector<double> beyond_;
  std::vector<Index> kept_;
  TriMesh mesh_;
  std::map<std::pair<Index, Index>, Index> crossings_;
  std::map<Index, Index> next_;  ///< from each vertex of the cut to the next one
};

}  // namespace

TriMesh cut_neck(const TriMesh& bone, const Vec3& normal, double offset_mm) {
  return Remainder(bone, normal, offset_mm).closed(normal);
}

}  // namespace condyle::sample
