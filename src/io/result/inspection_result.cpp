#include "io/result/inspection_result.hpp"

#include <fmt/format.h>

#include <utility>

#include "condyle/error.hpp"
#include "condyle/io/mesh_file.hpp"
#include "condyle/version.hpp"
#include "core/rounded.hpp"
#include "io/file/plain_text.hpp"
#include "io/file/shown_point.hpp"
#include "io/file/whole_file.hpp"
#include "io/mesh/polygon_rule.hpp"
#include "io/result/json.hpp"
#include "io/result/provenance_forms.hpp"
#include "io/result/repair_text.hpp"

namespace condyle::io {
namespace {

using io::Json;

std::string text_of(Index element) {
  return fmt::format("{}", element);
}
std::string text_of(const Edge& edge) {
  return fmt::format("{}-{}", edge.from, edge.to);
}
std::string text_of(const TriangleCrossing& pair) {
  return fmt::format("triangles {} and {}", pair.first, pair.second);
}
std::string text_of(const BoundaryLoop& loop) {
  return fmt::format("{} edges from vertex {}, near ({:.6g}, {:.6g}, {:.6g})", loop.edges, loop.first.from,
                     loop.centre.x() + 0.0, loop.centre.y() + 0.0, loop.centre.z() + 0.0);
}

Json json_of(Index element) {
  return element;
}
Json json_of(const Edge& edge) {
  return {edge.from, edge.to};
}
Json json_of(const TriangleCrossing& pair) {
  return {pair.first, pair.second};
}
Json json_of(const BoundaryLoop& loop) {
  return {{"edges", loop.edges}, {"first_edge", json_of(loop.first)}, {"centre", io::numbers(loop.centre)}};
}

/// Calls visit(key, words, finding) for every defect that a report counts: both forms list the same ones in
/// the same order.
template <class Visit>
void for_each_finding(const MeshReport& r, const Visit& visit) {
  visit("boundary_edges", "boundary edges", r.boundary_edges);
  visit("boundary_loops", "boundary loops", r.boundary_loops);
  visit("non_manifold_edges", "non-manifold edges", r.non_manifold_edges);
  visit("non_manifold_vertices", "non-manifold vertices", r.non_manifold_vertices);
  visit("inconsistent_edges", "edges with inconsistent winding", r.inconsistent_edges);
  visit("inverted_components", "components of inverted orientation", r.inverted_components);
  visit("self_crossings", "pairs of triangles that cross", r.self_crossings);
  visit("duplicate_triangles", "duplicate triangles", r.duplicate_triangles);
  visit("degenerate_triangles", "degenerate triangles", r.degenerate_triangles);
  visit("duplicate_vertices", "duplicate vertices", r.duplicate_vertices);
  visit("unreferenced_vertices", "unreferenced vertices", r.unreferenced_vertices);
}

/// A sheet has no genus: said as such, not as a number. Where a component lies matters if there are others.
std::string component_text(const MeshComponent& c, bool is_only) {
  std::string out = fmt::format("{} triangles, {}", c.triangles, c.closed ? "closed" : "open");
  if (c.genus) out += fmt::format(", genus {}", *c.genus);
  if (c.signed_volume) out += fmt::format(", volume {:.6g}", shown(*c.signed_volume));
  if (is_only) return out;
  const Vec3 middle = (c.bounds.low + c.bounds.high) / 2;
  out += fmt::format(", {:.4g} across about {}", c.bounds.diagonal(), core::rounded(middle, 1));
  if (c.inside) out += fmt::format(", inside component {}", *c.inside);
  return out;
}

void append(std::string& out, const MeshInspection& mesh) {
  constexpr std::size_t components_listed = 5;  // the rest of a soup is counted, not listed
  const MeshReport& r = mesh.report;
  out += fmt::format("{}\n  {} vertices, {} triangles, {}\n", io::plain_text(mesh.path.string()), r.vertices,
                     r.triangles, r.is_closed() ? "closed" : "not closed");
  if (mesh.welded_vertices > 0) out += fmt::format("  merged {} duplicate vertices\n", mesh.welded_vertices);
  if (mesh.split_polygons > 0)
    out += fmt::format("  {}\n", split_text(mesh.split_polygons, mesh.guessed_polygons, mesh.guessed_within));
  for (const RepairDone& done : mesh.repairs) out += fmt::format("  repair {}\n", describe(done));
  out += fmt::format("  {} component{}\n", r.components.size(), r.components.size() == 1 ? "" : "s");
  for (std::size_t i = 0; i < std::min(r.components.size(), components_listed); ++i)
    out += fmt::format("    {}: {}\n", i, component_text(r.components[i], r.components.size() == 1));
  if (r.components.size() > components_listed)
    out += fmt::format("    and {} more\n", r.components.size() - components_listed);
  for_each_finding(r, [&](const char*, const char* words, const auto& finding) {
    if (finding.count > 0)
      out += fmt::format("  {} {}, the first: {}\n", finding.count, words, text_of(*finding.first));
  });
  if (!r.two_sided.empty()) out += "  two-sided: " + r.two_sided + "\n";
  const Vec3 low = r.bounds.low, high = r.bounds.high;
  out += fmt::format("  bounds x {:.6g} .. {:.6g}, y {:.6g} .. {:.6g}, z {:.6g} .. {:.6g}\n", shown(low.x()),
                     shown(high.x()), shown(low.y()), shown(high.y()), shown(low.z()), shown(high.z()));
  out += fmt::format("  area {:.6g}", r.area);
  if (r.signed_volume) out += fmt::format(", volume {:.6g}", shown(*r.signed_volume));
  out += fmt::format("; edges {:.4g} .. {:.4g}, median {:.4g}\n", r.edge_lengths.shortest,
                     r.edge_lengths.longest, r.edge_lengths.median);
  out += fmt::format("  unit: {}\n", r.likely_unit.reason);
}

Json json_of(const MeshComponent& c) {
  Json out{{"first_triangle", c.first_triangle}, {"triangles", c.triangles}, {"closed", c.closed}};
  out["genus"] = c.genus ? Json(*c.genus) : Json();
  out["signed_volume"] = c.signed_volume ? Json(*c.signed_volume) : Json();
  out["bounds"] = {{"low", io::numbers(c.bounds.low)}, {"high", io::numbers(c.bounds.high)}};
  out["inside"] = c.inside ? Json(*c.inside) : Json();
  return out;
}

Json json_of(const MeshInspection& mesh) {
  const MeshReport& r = mesh.report;
  Json out{{"file", mesh.path.string()},
           {"vertices", r.vertices},
           {"triangles", r.triangles},
           {"closed", r.is_closed()},
           {"two_sided", r.two_sided.empty() ? Json(nullptr) : Json(r.two_sided)},
           {"welded_vertices", mesh.welded_vertices},
           {"split_polygons", mesh.split_polygons},
           {"guessed_polygons", mesh.guessed_polygons}};
  out["repairs"] = Json::array();
  for (const RepairDone& done : mesh.repairs)
    out["repairs"].push_back({{"repair", name_of(done.repair)}, {"count", done.count}});
  for_each_finding(r, [&](const char* key, const char*, const auto& finding) {
    out[key] = {{"count", finding.count}, {"first", finding.first ? json_of(*finding.first) : Json()}};
  });
  out["components"] = Json::array();
  for (const MeshComponent& component : r.components) out["components"].push_back(json_of(component));
  out["bounds"] = {{"low", io::numbers(r.bounds.low)}, {"high", io::numbers(r.bounds.high)}};
  out["area"] = r.area;
  out["signed_volume"] = r.signed_volume ? Json(*r.signed_volume) : Json();
  out["edge_lengths"] = {{"shortest", r.edge_lengths.shortest},
                         {"median", r.edge_lengths.median},
                         {"longest", r.edge_lengths.longest}};
  const auto& unit = r.likely_unit.unit;
  out["likely_unit"] = !unit ? Json() : Json(name_of(*unit));
  out["likely_unit_reason"] = r.likely_unit.reason;
  return out;
}

}  // namespace

InspectedMesh inspect_file(const std::filesystem::path& path, const std::vector<Repair>& repairs,
                           PolygonRule polygons) {
  io::check_is_file(path);
  const MeshFormat format = mesh_format_of(path);
  const std::string bytes = io::read_whole_file(path);
  MeshFile file = read_mesh(bytes, format, path.string(), polygons);
  MeshInspection inspection{path,
                            digest_of(bytes),
                            file.welded_vertices,
                            file.split_polygons,
                            file.guessed_polygons,
                            file.guessed_within,
                            {},
                            {}};
  try {
    inspection.repairs = repair_mesh(file.mesh, repairs);
  } catch (const MeshError& error) {
    throw MeshError(path.string() + ": " + error.what());
  }
  inspection.report = inspect(file.mesh);
  return {std::move(file.mesh), std::move(inspection)};
}

std::string to_text(std::span<const MeshInspection> meshes) {
  std::string out;
  for (const MeshInspection& mesh : meshes) append(out, mesh);
  return out;
}

std::string inspection_json(std::span<const MeshInspection> meshes, const std::vector<std::string>& command) {
  Json out{{"meshes", Json::array()}};
  Json files = Json::array();
  for (const MeshInspection& mesh : meshes) {
    out["meshes"].push_back(json_of(mesh));
    files.push_back(io::file_json(mesh.path, mesh.digest));
  }
  out["provenance"] = {{"version", version},
                       {"command", command.empty() ? Json(nullptr) : Json(command)},
                       {"meshes", std::move(files)}};
  return io::document(out);
}

}  // namespace condyle::io
