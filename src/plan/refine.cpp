#include "plan/refine.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <numeric>

#include "mesh/edge_table.hpp"

namespace condyle::plan {
namespace {

/// A mesh on its way: which triangle of the first one each comes from, of which part each vertex is, and which triangles may yet be halved.
struct Pieces {
  TriMesh mesh;
  std::vector<Index> before;
  std::vector<Index> part_of_vertex;
  std::vector<std::uint8_t> asked;
};

double length(const TriMesh& mesh, const std::array<Index, 2>& edge) {
  return (mesh.vertices[edge[0]] - mesh.vertices[edge[1]]).norm();
}

/// Edges to be halved, by their numbers: the share 0.5 for each.
std::vector<double> edges_to_halve(const Pieces& pieces, const mesh::EdgeTable& edges,
                                   const std::vector<std::uint8_t>& wanted, double longest) {
  const std::size_t triangles = pieces.mesh.triangles.size();
  std::vector<double> halve(edges.size(), 0);
  const auto edge = [&](std::size_t t, int k) { return edges.edge_of(static_cast<Index>(3 * t + k)); };
  for (std::size_t t = 0; t < triangles; ++t)
    for (int k = 0; k < 3; ++k)
      if (wanted[t] && edge(t, k) != no_index && length(pieces.mesh, edges.ends(edge(t, k))) > longest)
        halve[edge(t, k)] = 0.5;
  std::vector<Index> open;  // halved, and the triangles around not yet looked at
  for (Index e = 0; e < halve.size(); ++e)
    if (halve[e] > 0) open.push_back(e);
  while (!open.empty()) {
    const Index halved = open.back();
    open.pop_back();
    for (const mesh::HalfEdge h : edges.half_edges(halved)) {
      Index longest_side = no_index;
      double most = 0;
      for (int k = 0; k < 3; ++k) {
        const Index e = edge(h / 3, k);
        if (e == no_index) continue;
        const double l = length(pieces.mesh, edges.ends(e));
        // If two are as long, both neighbours choose the same one.
        if (l > most || (l == most && e < longest_side)) most = l, longest_side = e;
      }
      if (longest_side == no_index || halve[longest_side] > 0) continue;
      halve[longest_side] = 0.5;
      open.push_back(longest_side);
    }
  }
  return halve;
}

/// How many triangles a split makes beyond those that there are: one for each side of each that is split.
std::size_t added_by_split(const mesh::EdgeTable& edges, const std::vector<double>& shares) {
  std::size_t added = 0;
  for (std::size_t e = 0; e < shares.size(); ++e)
    if (shares[e] > 0) added += edges.half_edges(e).size();
  return added;
}

/// Splits edges at a share of the way along them; 0 where they stay whole.
void split(Pieces& pieces, const mesh::EdgeTable& edges, const std::vector<double>& shares) {
  std::vector<Index> middle(edges.size(), no_index);
  for (std::size_t e = 0; e < shares.size(); ++e) {
    if (shares[e] == 0) continue;
    const auto [a, b] = edges.ends(e);
    middle[e] = static_cast<Index>(pieces.mesh.vertices.size());
    const Vec3 from = pieces.mesh.vertices[a], to = pieces.mesh.vertices[b];
    pieces.mesh.vertices.push_back((1 - shares[e]) * from + shares[e] * to);
    pieces.part_of_vertex.push_back(pieces.part_of_vertex[a]);
  }

  std::vector<Triangle> triangles;
  std::vector<Index> before;
  std::vector<std::uint8_t> asked;
  for (std::size_t t = 0; t < pieces.mesh.triangles.size(); ++t) {
    const auto add = [&](Index a, Index b, Index c) {
      triangles.push_back({a, b, c});
      before.push_back(pieces.before[t]);
      asked.push_back(pieces.asked[t]);
    };
    std::array<Index, 3> m{};
    for (int k = 0; k < 3; ++k) {
      const Index e = edges.edge_of(static_cast<Index>(3 * t + k));
      m[k] = e == no_index ? no_index : middle[e];
    }
    const Triangle& v = pieces.mesh.triangles[t];
    const auto halved = std::count_if(m.begin(), m.end(), [](Index i) { return i != no_index; });
    if (halved == 0) {
      add(v[0], v[1], v[2]);
    } else if (halved == 3) {
      add(v[0], m[0], m[2]), add(m[0], v[1], m[1]), add(m[2], m[1], v[2]), add(m[0], m[1], m[2]);
    } else {
      // Turned so that side 0, from a to b, is halved, and with two the side after it too.
      int k = 0;
      while (m[k] == no_index || (halved == 2 && m[(k + 1) % 3] == no_index)) ++k;
      const Index a = v[k], b = v[(k + 1) % 3], c = v[(k + 2) % 3], ab = m[k], bc = m[(k + 1) % 3];
      if (halved == 1) {
        add(a, ab, c), add(ab, b, c);
      } else {
        add(ab, b, bc);
        // The four-cornered rest along its shorter diagonal.
        const auto& at = pieces.mesh.vertices;
        if ((at[a] - at[bc]).squaredNorm() <= (at[ab] - at[c]).squaredNorm())
          add(a, ab, bc), add(a, bc, c);
        else
          add(a, ab, c), add(ab, bc, c);
      }
    }
  }
  pieces.mesh.triangles = std::move(triangles);
  pieces.before = std::move(before);
  pieces.asked = std::move(asked);
}

enum class Halved : std::uint8_t { some, nothing, too_many };

Halved halve_once(Pieces& pieces, const ToRefine& to_refine, double longest, std::size_t most) {
  pieces.asked = to_refine(pieces.mesh, pieces.before, pieces.asked);
  const mesh::EdgeTable edges(pieces.mesh);
  const std::vector<double> halves = edges_to_halve(pieces, edges, pieces.asked, longest);
  if (std::all_of(halves.begin(), halves.end(), [](double share) { return share == 0; }))
    return Halved::nothing;
  if (pieces.mesh.triangles.size() + added_by_split(edges, halves) > most) return Halved::too_many;
  split(pieces, edges, halves);
  return Halved::some;
}

/// A body as one piece each.
Pieces pieces_of(const Body& body) {
  const std::size_t triangles = body.mesh.triangles().size();
  Pieces pieces{
      body.mesh.arrays(), std::vector<Index>(triangles), {}, std::vector<std::uint8_t>(triangles, 1)};
  std::iota(pieces.before.begin(), pieces.before.end(), Index{0});
  pieces.part_of_vertex.assign(pieces.mesh.vertices.size(), 0);
  for (std::size_t p = 0; p < body.parts.size(); ++p)
    std::fill_n(pieces.part_of_vertex.begin() + static_cast<std::ptrdiff_t>(body.parts[p].first_vertex),
                body.parts[p].vertices, static_cast<Index>(p));
  return pieces;
}

/// Vertices and triangles in the order of the parts; with the places of vertices to be put in the same order.
RefinedBody in_order_of_parts(Pieces pieces, const Body& body, std::vector<Between>* places = nullptr) {
  RefinedBody refined{body, {}};
  if (body.parts.empty()) {
    refined.body.mesh = Mesh(std::move(pieces.mesh));
    refined.triangle_before = std::move(pieces.before);
    return refined;
  }
  const std::vector<Index>& part = pieces.part_of_vertex;
  std::vector<Index> order(part.size()), place(part.size());
  std::iota(order.begin(), order.end(), Index{0});
  std::stable_sort(order.begin(), order.end(), [&](Index a, Index b) { return part[a] < part[b]; });
  TriMesh sorted;
  for (Index i = 0; i < order.size(); ++i) {
    place[order[i]] = i;
    sorted.vertices.push_back(pieces.mesh.vertices[order[i]]);
  }
  if (places) {
    std::vector<Between> of_sorted;
    for (const Index v : order) of_sorted.push_back((*places)[v]);
    *places = std::move(of_sorted);
  }
  // Pieces of triangles follow each other in the order of these already.
  for (const Triangle& t : pieces.mesh.triangles)
    sorted.triangles.push_back({place[t[0]], place[t[1]], place[t[2]]});
  std::size_t vertex = 0, triangle = 0;
  for (std::size_t p = 0; p < body.parts.size(); ++p) {
    BodyPart& of = refined.body.parts[p];
    const std::size_t past = of.first_triangle + of.triangles;
    const auto vertices =
        static_cast<std::size_t>(std::count(part.begin(), part.end(), static_cast<Index>(p)));
    const auto triangles =
        static_cast<std::size_t>(std::count_if(pieces.before.begin(), pieces.before.end(), [&](Index t) {
          return t >= body.parts[p].first_triangle && t < past;
        }));
    of.first_vertex = vertex, of.vertices = vertices, vertex += vertices;
    of.first_triangle = triangle, of.triangles = triangles, triangle += triangles;
  }
  refined.body.mesh = Mesh(std::move(sorted));
  refined.triangle_before = std::move(pieces.before);
  return refined;
}

}  // namespace

std::optional<RefinedBody> refined(const Body& body, const ToRefine& to_refine, double longest_edge_mm,
                                   std::size_t most_added) {
  Pieces pieces = pieces_of(body);
  const std::size_t most = pieces.mesh.triangles.size() + most_added;
  Halved halved = Halved::some;
  while (halved == Halved::some) halved = halve_once(pieces, to_refine, longest_edge_mm, most);
  if (halved == Halved::too_many) return std::nullopt;
  return in_order_of_parts(std::move(pieces), body);
}

std::optional<SplitBody> split_at(const Body& body, const std::vector<double>& shares, std::size_t most) {
  const mesh::EdgeTable edges(body.mesh);
  if (body.mesh.triangles().size() + added_by_split(edges, shares) > most) return std::nullopt;
  Pieces pieces = pieces_of(body);
  std::vector<Between> vertices;
  for (Index v = 0; v < pieces.mesh.vertices.size(); ++v) vertices.push_back({v, v, 0});
  for (std::size_t e = 0; e < shares.size(); ++e)
    if (shares[e] > 0) vertices.push_back({edges.ends(e)[0], edges.ends(e)[1], shares[e]});
  split(pieces, edges, shares);
  RefinedBody refined = in_order_of_parts(std::move(pieces), body, &vertices);
  return SplitBody{std::move(refined), std::move(vertices)};
}

}  // namespace condyle::plan
