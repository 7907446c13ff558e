#include <algorithm>

#include "kinds.hpp"
#include "tetrahedra.hpp"

/// Spatial hashing: M. Teschner, B. Heidelberger, M. Mueller, D. Pomeranets, M. Gross, "Optimized spatial
/// hashing for collision detection of deformable objects" (VMV 2003).
///
/// Taken from it: cells as large as the mean edge of the tetrahedra; the three primes of its hash; vertices
/// put into the table first, then each tetrahedron asks every cell that its box meets for vertices, which are
/// held against the box and then by barycentric coordinates; time stamps instead of clearing the table. Its
/// answer is which vertices are inside, without depth. Differing: only mobile vertices against the fixed
/// body's tetrahedra, and a table of the next prime above twice the vertices, where the paper tries several.
///
/// Also in the form that a rigid fixed body allows: its tetrahedra are put into the table once, and each
/// vertex asks its own cell.

namespace bench {
namespace {

using condyle::Index;
using condyle::Pose;
using condyle::Vec3;

std::uint32_t prime_above(std::size_t n) noexcept {
  const auto is_prime = [](std::size_t p) {
    for (std::size_t d = 2; d * d <= p; ++d)
      if (p % d == 0) return false;
    return true;
  };
  n = std::max<std::size_t>(n, 2);
  while (!is_prime(n)) ++n;
  return static_cast<std::uint32_t>(n);
}

/// Cells of one size, each with a place in a table.
struct HashedCells {
  double per_mm;
  std::uint32_t table_size;

  int step(double at) const noexcept { return static_cast<int>(std::floor(at * per_mm)); }
  std::uint32_t place(int i, int j, int k) const noexcept {
    const auto u = [](int n) { return static_cast<std::uint32_t>(n); };
    return (u(i) * 73856093u ^ u(j) * 19349663u ^ u(k) * 83492791u) % table_size;
  }
  std::uint32_t place_of(const Vec3& p) const noexcept {
    return place(step(p.x()), step(p.y()), step(p.z()));
  }

  /// Calls visit(place) for each cell that a box meets.
  template <class Visit>
  void visit(const Vec3& low, const Vec3& high, const Visit& visit) const {
    for (int k = step(low.z()); k <= step(high.z()); ++k)
      for (int j = step(low.y()); j <= step(high.y()); ++j)
        for (int i = step(low.x()); i <= step(high.x()); ++i) visit(place(i, j, k));
  }
};

/// A tetrahedron's corners and box.
struct Tetrahedron {
  Tetrahedron(const TetMesh& mesh, std::size_t t)
      : a(mesh.vertices[mesh.tetrahedra[t][0]]),
        b(mesh.vertices[mesh.tetrahedra[t][1]]),
        c(mesh.vertices[mesh.tetrahedra[t][2]]),
        d(mesh.vertices[mesh.tetrahedra[t][3]]),
        low(a.cwiseMin(b).cwiseMin(c.cwiseMin(d))),
        high(a.cwiseMax(b).cwiseMax(c.cwiseMax(d))) {}

  bool holds(const Vec3& p) const noexcept {
    if ((p.array() < low.array()).any() || (p.array() > high.array()).any()) return false;
    const Vec3 ab = b - a, ac = c - a, ad = d - a, ap = p - a;
    const Vec3 acd = ac.cross(ad);
    const double volume = ab.dot(acd), sign = volume < 0 ? -1 : 1;
    const double of_b = sign * ap.dot(acd), of_c = sign * ap.dot(ad.cross(ab));
    const double of_d = sign * ap.dot(ab.cross(ac));
    return of_b >= 0 && of_c >= 0 && of_d >= 0 && of_b + of_c + of_d <= sign * volume;
  }

  Vec3 a, b, c, d, low, high;
};

/// Common part of both variants: the tetrahedra, and how they follow the surface.
class FilledBody : public Method {
 public:
  explicit FilledBody(const Bodies& bodies)
      : mobile_(&bodies.mobile), fixed_(std::make_shared<TetMesh>(filled(bodies.fixed))) {}

 protected:
  /// The surface's vertices move, the inner ones stay: right for deformations smaller than a tetrahedron.
  void move_surface(condyle::PointsView vertices) {
    auto moved = std::make_shared<TetMesh>(*fixed_);
    for (std::size_t v = 0; v < vertices.size(); ++v) moved->vertices.set(v, vertices[v]);
    fixed_ = std::move(moved);
  }

  const condyle::TriMesh* mobile_;
  std::shared_ptr<const TetMesh> fixed_;
  condyle::Points posed_;
  std::int64_t cells_ = 0, tests_ = 0;
};

/// As published: vertices are hashed at each pose.
class HashedVertices final : public FilledBody {
 public:
  explicit HashedVertices(const Bodies& bodies)
      : FilledBody(bodies),
        cell_{1 / fixed_->mean_edge_mm(), prime_above(2 * bodies.mobile.vertices.size())},
        place_(cell_.table_size),
        next_(bodies.mobile.vertices.size()),
        found_(next_.size()) {}

  void find_inside(const Pose& X_FM, std::vector<InsideVertex>& out) override {
    out.clear();
    posed(X_FM, mobile_->vertices.view(), posed_);
    ++now_;
    for (Index v = 0; v < posed_.size(); ++v) {
      Place& place = place_[cell_.place_of(posed_[v])];
      next_[v] = place.stamp == now_ ? place.first : condyle::no_index;
      place = {now_, v};
    }
    for (std::size_t t = 0; t < fixed_->tetrahedra.size(); ++t) {
      const Tetrahedron tetrahedron(*fixed_, t);
      cell_.visit(tetrahedron.low, tetrahedron.high, [&](std::uint32_t place) {
        ++cells_;
        if (place_[place].stamp == now_) find_in_place(tetrahedron, place_[place].first, out);
      });
    }
  }

  void deform(condyle::PointsView fixed_vertices) override { move_surface(fixed_vertices); }
  std::unique_ptr<Method> for_another_thread() override { return std::make_unique<HashedVertices>(*this); }
  std::size_t bytes() const override {
    return fixed_->bytes() + place_.size() * sizeof(Place) + 2 * next_.size() * sizeof(Index);
  }
  Work work() const override { return {{"cells", cells_}, {"vertex-tetrahedron tests", tests_}}; }

 private:
  /// The vertices of a place of the table, where its stamp is the present pose's, as a chain.
  struct Place {
    std::uint32_t stamp = 0;
    Index first = condyle::no_index;
  };

  void find_in_place(const Tetrahedron& tetrahedron, Index first, std::vector<InsideVertex>& out) {
    for (Index v = first; v != condyle::no_index; v = next_[v]) {
      ++tests_;
      if (found_[v] == now_ || !tetrahedron.holds(posed_[v])) continue;
      found_[v] = now_;
      out.push_back({v, condyle::no_index});
    }
  }

  HashedCells cell_;
  std::vector<Place> place_;
  std::vector<Index> next_;
  std::vector<std::uint32_t> found_;  ///< The pose at which a vertex was last found inside.
  std::uint32_t now_ = 0;
};

/// The tetrahedra hashed once:
///   offset_        0     2  2        5  ...      one entry per place, plus one
///   tetrahedron_  | a b |  | c d e |    ...      place i owns [offset_[i], offset_[i+1])
class HashedTetrahedra final : public FilledBody {
 public:
  explicit HashedTetrahedra(const Bodies& bodies) : FilledBody(bodies) { hash(); }

  void find_inside(const Pose& X_FM, std::vector<InsideVertex>& out) override {
    out.clear();
    posed(X_FM, mobile_->vertices.view(), posed_);
    for (Index v = 0; v < posed_.size(); ++v) {
      const Vec3 p = posed_[v];
      if ((p.array() < low_.array()).any() || (p.array() > high_.array()).any()) continue;
      if (is_in_one(p)) out.push_back({v, condyle::no_index});
    }
  }

  void deform(condyle::PointsView fixed_vertices) override {
    move_surface(fixed_vertices);
    hash();
  }
  std::unique_ptr<Method> for_another_thread() override { return std::make_unique<HashedTetrahedra>(*this); }
  std::size_t bytes() const override {
    return fixed_->bytes() + (offset_->size() + tetrahedron_->size()) * sizeof(Index);
  }
  Work work() const override { return {{"cells", cells_}, {"vertex-tetrahedron tests", tests_}}; }

 private:
  using Numbers = std::shared_ptr<const std::vector<Index>>;

  void hash() {
    cell_ = {1 / fixed_->mean_edge_mm(), prime_above(2 * fixed_->tetrahedra.size())};
    std::vector<Index> offset(cell_.table_size + 1), tetrahedra;
    low_ = Vec3::Constant(std::numeric_limits<double>::infinity()), high_ = -low_;
    for (std::size_t t = 0; t < fixed_->tetrahedra.size(); ++t) {
      const Tetrahedron box(*fixed_, t);
      low_ = low_.cwiseMin(box.low), high_ = high_.cwiseMax(box.high);
      cell_.visit(box.low, box.high, [&](std::uint32_t place) { ++offset[place + 1]; });
    }
    for (std::size_t i = 1; i < offset.size(); ++i) offset[i] += offset[i - 1];
    tetrahedra.resize(offset.back());
    std::vector<Index> next(offset.begin(), offset.end() - 1);
    for (Index t = 0; t < fixed_->tetrahedra.size(); ++t) {
      const Tetrahedron box(*fixed_, t);
      cell_.visit(box.low, box.high, [&](std::uint32_t place) { tetrahedra[next[place]++] = t; });
    }
    offset_ = std::make_shared<std::vector<Index>>(std::move(offset));
    tetrahedron_ = std::make_shared<std::vector<Index>>(std::move(tetrahedra));
  }

  bool is_in_one(const Vec3& p) {
    ++cells_;
    const std::uint32_t place = cell_.place_of(p);
    for (Index i = (*offset_)[place]; i < (*offset_)[place + 1]; ++i) {
      ++tests_;
      if (Tetrahedron(*fixed_, (*tetrahedron_)[i]).holds(p)) return true;
    }
    return false;
  }

  HashedCells cell_{};
  Vec3 low_, high_;
  Numbers offset_, tetrahedron_;
};

template <class Hashing>
MethodKind hashing(std::string name, std::string title) {
  return {std::move(name),
          "spatial hashing",
          std::move(title),
          {.inside = true, .deforms = true},
          DepthKind::none,
          false,
          [](const Bodies& bodies) { return std::make_unique<Hashing>(bodies); }};
}

}  // namespace

std::vector<MethodKind> spatial_hashing_kinds() {
  return {
      hashing<HashedVertices>("hashing_vertices", "tetrahedra, vertices hashed at each pose"),
      hashing<HashedTetrahedra>("hashing_tetrahedra", "tetrahedra hashed once"),
  };
}

}  // namespace bench
