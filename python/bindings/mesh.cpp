#include "condyle/mesh.hpp"

#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

#include "arrays.hpp"
#include "bindings.hpp"
#include "condyle/inspect.hpp"
#include "condyle/io/mesh_file.hpp"
#include "io/mesh/polygon_rule.hpp"
#include "io/result/repair_text.hpp"

namespace condyle::python {
namespace {

Mesh mesh_of(const py::object& vertices, const py::object& triangles) {
  TriMesh arrays;
  const PointsIn points(vertices, "vertices", NotFinite::leave);
  const PointsView view = points.view();
  arrays.vertices.x.assign(view.x.begin(), view.x.end());
  arrays.vertices.y.assign(view.y.begin(), view.y.end());
  arrays.vertices.z.assign(view.z.begin(), view.z.end());
  arrays.triangles = triangles_in(triangles, points.size());
  const py::gil_scoped_release released;
  return Mesh(std::move(arrays));
}

py::array triangles_of(const py::object& self) {
  const auto& triangles = self.cast<const Mesh&>().triangles();
  constexpr auto size = static_cast<py::ssize_t>(sizeof(Index));
  return view_of(triangles.empty() ? nullptr : triangles.front().data(),
                 {static_cast<py::ssize_t>(triangles.size()), 3}, {3 * size, size}, self);
}

/// The mesh with vertices of the same coordinates made one, and for each vertex as given its number in it.
py::tuple merged(const Mesh& mesh) {
  std::vector<Index> number;
  auto merge = [&] {
    const py::gil_scoped_release released;
    number = first_of_same_coordinates(mesh.vertices());
    TriMesh arrays;
    for (Index v = 0; v < number.size(); ++v) {
      if (number[v] == v) {
        number[v] = static_cast<Index>(arrays.vertices.size());
        arrays.vertices.push_back(mesh.vertices()[v]);
      } else {
        number[v] = number[number[v]];  // the first of them came before
      }
    }
    arrays.triangles = mesh.triangles();
    for (Triangle& triangle : arrays.triangles)
      for (Index& corner : triangle) corner = number[corner];
    return Mesh(std::move(arrays));
  };
  Mesh result = merge();
  return py::make_tuple(std::move(result), array_of(std::move(number)));
}

py::tuple read_arrays(const std::filesystem::path& path, const std::string& polygons) {
  auto [mesh, welded, split] = [&] {
    const py::gil_scoped_release released;
    io::MeshFile file = io::read_mesh(path, io::polygon_rule_named(polygons));
    return std::tuple(Mesh(std::move(file.mesh)), file.welded_vertices,
                      io::split_text(file.split_polygons, file.guessed_polygons, file.guessed_within));
  }();
  return py::make_tuple(std::move(mesh), welded, split);
}

py::tuple repaired(const Mesh& mesh, const std::vector<std::string>& names) {
  std::vector<Repair> repairs;
  for (const std::string& name : names) repairs.push_back(io::repair_named(name));
  std::vector<std::string> done;
  Mesh result = [&] {
    const py::gil_scoped_release released;
    TriMesh arrays = mesh.arrays();
    for (const RepairDone& repair : repair_mesh(arrays, repairs)) done.push_back(io::describe(repair));
    return Mesh(std::move(arrays));
  }();
  return py::make_tuple(std::move(result), done);
}

Mesh largest_of(const Mesh& mesh) {
  const py::gil_scoped_release released;
  return Mesh(largest_piece(mesh));
}

Mesh piece_nearest(const Mesh& mesh, const py::object& point) {
  const Vec3 p = vector_in(point, "point");
  const py::gil_scoped_release released;
  return Mesh(piece_at(mesh, p));
}

}  // namespace

void bind_mesh(py::module_& module) {
  py::class_<Mesh>(module, "Mesh")
      .def(py::init(&mesh_of))
      .def_property_readonly("vertices", [](const Mesh& mesh) { return array_of(mesh.vertices()); })
      .def_property_readonly("triangles", &triangles_of)
      .def_property_readonly("vertex_count", [](const Mesh& mesh) { return mesh.vertices().size(); })
      .def_property_readonly("triangle_count", [](const Mesh& mesh) { return mesh.triangles().size(); })
      .def_property_readonly("is_closed", &Mesh::is_closed);
  module.def("merged", &merged);
  module.def("repaired", &repaired);
  module.def("largest_piece", &largest_of);
  module.def("piece_at", &piece_nearest);
  module.def("read_mesh", &read_arrays);
  module.def("write_mesh", [](const std::filesystem::path& path, const Mesh& mesh) {
    const py::gil_scoped_release released;
    io::write_mesh(path, mesh.arrays());
  });
}

}  // namespace condyle::python
