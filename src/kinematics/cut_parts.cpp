#include "kinematics/cut_parts.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "condyle/error.hpp"
#include "condyle/make_joint.hpp"
#include "core/formatted.hpp"
#include "core/lazy.hpp"
#include "core/one_line.hpp"
#include "mesh/cut_mesh.hpp"
#include "mesh/findings.hpp"

namespace condyle::kinematics {
namespace {

using core::formatted;

[[noreturn]] void refuse_part(const PosedPart& part, const std::string& what) {
  throw UsageError("part " + part.name + ": " + what);
}

std::string mesh_names(const Body& body) {
  std::string names;
  for (const BodyPart& known : body.parts) names += (names.empty() ? "" : ", ") + known.name;
  return core::one_line(names, 2000);
}

/// A body of one mesh as a list of one.
std::vector<BodyPart> meshes_of(const Body& body) {
  if (!body.parts.empty()) return body.parts;
  return {{body.name, 0, body.mesh.vertices().size(), 0, body.mesh.triangles().size()}};
}

std::size_t number_of(const std::vector<BodyPart>& meshes, const std::string& name) {
  return static_cast<std::size_t>(
      std::find_if(meshes.begin(), meshes.end(), [&](const BodyPart& known) { return known.name == name; }) -
      meshes.begin());
}

/// Which mesh the part is cut from.
std::size_t mesh_to_cut(const PosedPart& part, const Body& body, const std::vector<BodyPart>& meshes) {
  if (part.meshes.empty()) {
    if (meshes.size() > 1)
      refuse_part(part,
                  "meshes: the first must name the mesh that it is cut from; there are " + mesh_names(body));
    return 0;
  }
  for (const std::string& name : part.meshes)
    if (number_of(meshes, name) == meshes.size())
      refuse_part(part, "the body has no mesh \"" + core::one_line(name) + "\"; there are " +
                            (body.parts.empty() ? core::one_line(body.name) : mesh_names(body)));
  return number_of(meshes, part.meshes.front());
}

TriMesh mesh_alone(const Body& body, const BodyPart& part) {
  TriMesh mesh;
  for (std::size_t v = 0; v < part.vertices; ++v)
    mesh.vertices.push_back(body.mesh.vertices()[part.first_vertex + v]);
  const auto first = static_cast<Index>(part.first_vertex);
  for (std::size_t t = 0; t < part.triangles; ++t) {
    const auto [a, b, c] = body.mesh.triangles()[part.first_triangle + t];
    mesh.triangles.push_back({a - first, b - first, c - first});
  }
  return mesh;
}

/// Meshes that go with the part lie behind its planes.
void check_goes_along(const PosedPart& part, const Body& body, const BodyPart& mesh) {
  for (std::size_t v = mesh.first_vertex; v < mesh.first_vertex + mesh.vertices; ++v)
    for (std::size_t k = 0; k < part.cut.size(); ++k)
      if (part.cut[k].normal.dot(body.mesh.vertices()[v] - part.cut[k].point) > mesh::on_plane_mm)
        refuse_part(part, "cut: " + core::one_line(mesh.name) +
                              formatted(" reaches beyond plane %zu: ", k + 1) +
                              "only the first of its meshes is cut, the others go with it");
}

/// A body in the making.
class BodyOfMeshes {
 public:
  void add(BodyPart part, const TriMesh& mesh, std::size_t cut_triangles, std::vector<Index> before) {
    const auto first = static_cast<Index>(arrays_.vertices.size());
    part.first_vertex = first, part.vertices = mesh.vertices.size();
    part.first_triangle = arrays_.triangles.size(), part.triangles = mesh.triangles.size();
    part.cut_triangles = cut_triangles;
    for (std::size_t v = 0; v < mesh.vertices.size(); ++v) arrays_.vertices.push_back(mesh.vertices[v]);
    for (const auto& [a, b, c] : mesh.triangles)
      arrays_.triangles.push_back({first + a, first + b, first + c});
    vertex_before_.insert(vertex_before_.end(), before.begin(), before.end());
    parts_.push_back(std::move(part));
  }
  std::vector<Index> give_to(Body& body) {
    body.mesh = Mesh(std::move(arrays_));
    body.parts = std::move(parts_);
    return std::move(vertex_before_);
  }

 private:
  TriMesh arrays_;
  std::vector<BodyPart> parts_;
  std::vector<Index> vertex_before_;
};

/// Numbers in the body of vertices of one of its meshes.
std::vector<Index> in_body(std::vector<Index> of_mesh, std::size_t first_vertex) {
  for (Index& v : of_mesh)
    if (v != no_index) v += static_cast<Index>(first_vertex);
  return of_mesh;
}

/// A second part would have faces of the first for surface of the bone.
void refuse_second_cut(const PosedPart& part, const BodyPart& mesh) {
  if (mesh.cut_triangles > 0)
    refuse_part(part, "cut: " + core::one_line(mesh.name) + " is cut already: one part is cut from a mesh");
}

std::string cut_text(const PosedPart& part, const std::string& from, const mesh::CutMesh& cut) {
  double area = 0;
  std::size_t unused = 0;
  for (const double face : cut.face_mm2) area += face, unused += face == 0;
  std::string text =
      part.name + ": cut from " + core::one_line(from) +
      formatted(" by %zu plane%s: %.0f mm3 of %.0f, faces of %.0f mm2", cut.face_mm2.size(),
                cut.face_mm2.size() == 1 ? "" : "s", cut.inner_mm3, cut.inner_mm3 + cut.outer_mm3, area);
  if (unused > 0)
    for (std::size_t k = 0; k < cut.face_mm2.size(); ++k)
      if (cut.face_mm2[k] == 0)
        text += formatted("; plane %zu cuts off nothing that the others leave", k + 1);
  if (cut.pieces_behind > 1)
    text += formatted("; the largest of %zu pieces behind them, the others stay with the rest",
                      cut.pieces_behind);
  if (cut.outer_pieces > 1) text += formatted("; the rest is in %zu pieces", cut.outer_pieces);
  return text;
}

/// Cuts one part; of each vertex of the body its number before.
std::vector<Index> cut_part(PosedPart& part, Body& body, std::vector<std::string>& processing) {
  const std::vector<BodyPart> meshes = meshes_of(body);
  const std::size_t from = mesh_to_cut(part, body, meshes);
  const BodyPart& mesh = meshes[from];
  refuse_second_cut(part, mesh);
  for (const BodyPart& known : meshes)
    if (known.name == part.name)
      refuse_part(part,
                  "the part that is cut off would have the name of the mesh " + core::one_line(known.name));
  std::vector<mesh::CuttingPlane> planes;
  for (std::size_t k = 0; k < part.cut.size(); ++k) {
    const CutPlane& plane = part.cut[k];
    if (!std::isfinite(plane.point.sum()) || !(std::abs(plane.normal.norm() - 1) <= axis_tolerance))
      refuse_part(part, formatted("cut: plane %zu: ", k + 1) + "needs a finite point and a unit normal");
    planes.push_back({plane.point, plane.normal});
  }
  for (const std::string& other : part.meshes)
    if (const BodyPart& along = meshes[number_of(meshes, other)]; &along != &mesh)
      check_goes_along(part, body, along);
  mesh::CutMesh cut;
  try {
    cut = mesh::cut_by_planes(Mesh(mesh_alone(body, mesh)), core::one_line(mesh.name), planes);
  } catch (const UsageError& error) {
    refuse_part(part, std::string("cut: ") + error.what());
  } catch (const MeshError& error) {
    throw MeshError("part " + part.name + ": cut: " + error.what());
  }
  processing.push_back(cut_text(part, mesh.name, cut));
  part.cut_from = mesh.name;
  if (part.meshes.empty()) part.meshes.push_back({});
  part.meshes.front() = part.name;

  BodyOfMeshes made;
  for (std::size_t i = 0; i < meshes.size(); ++i) {
    const BodyPart& known = meshes[i];
    if (i != from) {
      std::vector<Index> same(known.vertices);
      for (std::size_t v = 0; v < same.size(); ++v) same[v] = static_cast<Index>(v);
      made.add(known, mesh_alone(body, known), known.cut_triangles,
               in_body(std::move(same), known.first_vertex));
      continue;
    }
    made.add(known, cut.outer.mesh, cut.outer.cut_triangles,
             in_body(std::move(cut.outer.vertex_before), known.first_vertex));
    BodyPart inner = known;
    inner.name = part.name;
    made.add(std::move(inner), cut.inner.mesh, cut.inner.cut_triangles,
             in_body(std::move(cut.inner.vertex_before), known.first_vertex));
  }
  return made.give_to(body);
}

struct KeptSurface {
  core::Lazy<std::optional<Mesh>> uncut;
};

}  // namespace

CutParts cut_parts(std::vector<PosedPart>& parts, Body& fixed, Body& mobile) {
  CutParts done;
  for (PosedPart& part : parts) {
    if (part.cut.empty()) continue;
    const bool is_fixed = part.body == BodyRole::fixed;
    std::vector<Index> before = cut_part(part, is_fixed ? fixed : mobile, done.processing);
    if (is_fixed) continue;
    if (!done.mobile_vertex_before.empty())
      for (Index& v : before)
        if (v != no_index) v = done.mobile_vertex_before[v];
    done.mobile_vertex_before = std::move(before);
  }
  return done;
}

const Mesh& uncut_surface(const Body& body) {
  if (!is_cut(body)) return body.mesh;
  const auto& kept =
      mesh::findings_of(body.mesh).get<KeptSurface>().uncut.get([&](std::optional<Mesh>& made) {
        TriMesh surface{body.mesh.vertices(), {}};
        for (const BodyPart& part : body.parts) {
          const auto first = body.mesh.triangles().begin() + static_cast<std::ptrdiff_t>(part.first_triangle);
          surface.triangles.insert(surface.triangles.end(), first,
                                   first + static_cast<std::ptrdiff_t>(part.triangles - part.cut_triangles));
        }
        made.emplace(std::move(surface));
      });
  return *kept;
}

std::vector<char> cut_vertices(const Body& body) {
  std::vector<char> cut;
  if (!is_cut(body)) return cut;
  cut.assign(body.mesh.vertices().size(), 0);
  for (std::size_t t = 0; t < body.mesh.triangles().size(); ++t)
    if (is_cut_face(body, t))
      for (const Index v : body.mesh.triangles()[t]) cut[v] = 1;
  return cut;
}

}  // namespace condyle::kinematics
