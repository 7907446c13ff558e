#include "condyle/inspect.hpp"

#include <pybind11/stl.h>

#include "arrays.hpp"
#include "bindings.hpp"

namespace condyle::python {
namespace {

py::object element(Index index) {
  return py::int_(index);
}
py::object element(const Edge& edge) {
  return py::make_tuple(edge.from, edge.to);
}
py::object element(const TriangleCrossing& crossing) {
  return py::make_tuple(crossing.first, crossing.second);
}
py::object element(const BoundaryLoop& loop) {
  py::dict dict;
  dict["edges"] = loop.edges;
  dict["first"] = element(loop.first);
  dict["centre"] = array_of(loop.centre);
  return dict;
}

template <class Element>
py::tuple finding(const Finding<Element>& found) {
  return py::make_tuple(found.count, found.first ? element(*found.first) : py::none());
}

py::list components(const MeshReport& report) {
  py::list list;
  for (const MeshComponent& part : report.components) {
    py::dict dict;
    dict["first_triangle"] = part.first_triangle;
    dict["triangles"] = part.triangles;
    dict["is_closed"] = part.closed;
    dict["genus"] = part.genus;
    dict["signed_volume"] = part.signed_volume;
    dict["bounds"] = py::make_tuple(array_of(part.bounds.low), array_of(part.bounds.high));
    dict["inside"] = part.inside;
    list.append(dict);
  }
  return list;
}

py::object unit_of(const LikelyUnit& likely) {
  if (!likely.unit) return py::none();
  return py::str(std::string(name_of(*likely.unit)));
}

py::dict inspected(const Mesh& mesh) {
  const MeshReport report = without_lock([&] { return inspect(mesh); });
  py::dict findings;
  findings["boundary_edges"] = finding(report.boundary_edges);
  findings["boundary_loops"] = finding(report.boundary_loops);
  findings["non_manifold_edges"] = finding(report.non_manifold_edges);
  findings["non_manifold_vertices"] = finding(report.non_manifold_vertices);
  findings["inconsistent_edges"] = finding(report.inconsistent_edges);
  findings["unbalanced_edges"] = finding(report.unbalanced_edges);
  findings["duplicate_triangles"] = finding(report.duplicate_triangles);
  findings["degenerate_triangles"] = finding(report.degenerate_triangles);
  findings["unreferenced_vertices"] = finding(report.unreferenced_vertices);
  findings["duplicate_vertices"] = finding(report.duplicate_vertices);
  findings["inverted_components"] = finding(report.inverted_components);
  findings["self_crossings"] = finding(report.self_crossings);

  py::dict dict;
  dict["vertices"] = report.vertices;
  dict["triangles"] = report.triangles;
  dict["is_closed"] = report.is_closed();
  dict["two_sided"] = report.two_sided.empty() ? py::object(py::none()) : py::str(report.two_sided);
  dict["findings"] = findings;
  dict["components"] = components(report);
  dict["bounds"] = py::make_tuple(array_of(report.bounds.low), array_of(report.bounds.high));
  dict["area"] = report.area;
  dict["signed_volume"] = report.signed_volume;
  dict["edge_lengths"] =
      py::make_tuple(report.edge_lengths.shortest, report.edge_lengths.median, report.edge_lengths.longest);
  dict["likely_unit"] = unit_of(report.likely_unit);
  dict["likely_unit_reason"] = report.likely_unit.reason;
  return dict;
}

}  // namespace

void bind_inspect(py::module_& module) {
  module.def("inspect", &inspected);
}

}  // namespace condyle::python
