#include <pybind11/stl.h>

#include <mutex>
#include <shared_mutex>
#include <type_traits>

#include "arrays.hpp"
#include "bindings.hpp"
#include "condyle/radial.hpp"
#include "condyle/tangential.hpp"
#include "vertex_gaps.hpp"

/// The tables themselves, for those who build on the core.

namespace condyle::python {
namespace {

/// A table that any thread may ask and any thread update: an update waits for the questions before it.
class SharedRadialTable {
 public:
  explicit SharedRadialTable(const Mesh& mesh, radial::RadialOptions options) : table_(mesh, options) {}

  py::dict query(const py::object& given) const {
    const PointsIn points(given, "points");
    return dict_of(read([&](const radial::RadialTable& table) { return table.query(points.view()); }));
  }

  py::array radial_gaps(const py::object& given) const {
    const PointsIn points(given, "points");
    return array_of(read([&](const radial::RadialTable& table) { return table.radial_gaps(points.view()); }));
  }

  void update(const py::object& given) {
    const PointsIn vertices(given, "vertices");
    const py::gil_scoped_release released;
    const std::unique_lock lock(mutex_);
    table_.update(vertices.view());
  }

  void update_some(const py::object& moved, const py::object& given) {
    const PointsIn positions(given, "vertices");
    const std::vector<Index> vertices = vertices_in(moved, "moved", positions.size());
    const py::gil_scoped_release released;
    const std::unique_lock lock(mutex_);
    table_.update(vertices, positions.view());
  }

  Mesh mesh() const {
    return read([](const radial::RadialTable& table) { return Mesh(table.mesh()); });
  }

  py::dict size() const {
    const radial::RadialTableSize size =
        read([](const radial::RadialTable& table) { return table.table_size(); });
    py::dict dict;
    dict["cells"] = size.cells;
    dict["entries"] = size.entries;
    dict["bytes"] = size.bytes;
    dict["longest_list"] = size.longest_list;
    return dict;
  }

  std::optional<int> winding_at_centre() const {
    return read([](const radial::RadialTable& table) { return table.winding_at_centre(); });
  }

 private:
  /// The interpreter's lock is given away before the table's is waited for: other threads go on during an update.
  template <class Read>
  std::invoke_result_t<Read, const radial::RadialTable&> read(const Read& from) const {
    const py::gil_scoped_release released;
    const std::shared_lock lock(mutex_);
    return from(table_);
  }

  mutable std::shared_mutex mutex_;
  radial::RadialTable table_;
};

std::unique_ptr<SharedRadialTable> radial_table(const Mesh& mesh, bool is_cube, std::optional<int> cells) {
  const radial::RadialOptions options{
      is_cube ? radial::DirectionMapKind::cube : radial::DirectionMapKind::cartesian, cells};
  const py::gil_scoped_release released;
  return std::make_unique<SharedRadialTable>(mesh, options);
}

tangential::RingTable ring_table(const Mesh& mesh, const py::object& point, const py::object& direction,
                                 double cells_per_triangle) {
  const Vec3 on_axis = vector_in(point, "point");
  const AxisFrame frame(on_axis, vector_in(direction, "direction"));
  const py::gil_scoped_release released;
  return tangential::RingTable(mesh, frame, tangential::RingTableOptions{cells_per_triangle});
}

py::dict query_rings(const tangential::RingTable& table, const py::object& given, bool is_nearest_arc) {
  const PointsIn points(given, "points");
  tangential::TangentialResults results = without_lock([&] {
    return table.query(points.view(), is_nearest_arc ? tangential::TangentialRule::nearest_arc
                                                     : tangential::TangentialRule::alternating);
  });
  return dict_of(std::move(results));
}

/// Arcs of all points, point i owning [offset[i], offset[i + 1]).
py::dict occupied_arcs(const tangential::RingTable& table, const py::object& given) {
  const PointsIn points(given, "points");
  std::vector<std::int64_t> offset{0};
  std::vector<double> begin_deg, end_deg;
  std::vector<Index> enters, leaves;
  {
    const py::gil_scoped_release released;
    const tangential::OccupiedArcs arcs = table.occupied_arcs(points.view());
    for (std::size_t i = 0; i < arcs.size(); ++i) {
      for (const tangential::OccupiedArc& arc : arcs.of(i)) {
        begin_deg.push_back(arc.begin.degrees());
        end_deg.push_back(arc.end.degrees());
        enters.push_back(arc.enters);
        leaves.push_back(arc.leaves);
      }
      offset.push_back(static_cast<std::int64_t>(begin_deg.size()));
    }
  }
  py::dict dict;
  dict["offset"] = array_of(std::move(offset));
  dict["begin_deg"] = array_of(std::move(begin_deg));
  dict["end_deg"] = array_of(std::move(end_deg));
  dict["enters"] = array_of(std::move(enters));
  dict["leaves"] = array_of(std::move(leaves));
  return dict;
}

}  // namespace

void bind_tables(py::module_& module) {
  py::class_<SharedRadialTable>(module, "RadialTable")
      .def(py::init(&radial_table))
      .def("query", &SharedRadialTable::query)
      .def("radial_gaps", &SharedRadialTable::radial_gaps)
      .def("update", &SharedRadialTable::update)
      .def("update_some", &SharedRadialTable::update_some)
      .def_property_readonly("mesh", &SharedRadialTable::mesh)
      .def_property_readonly("size", &SharedRadialTable::size)
      .def_property_readonly("winding_at_centre", &SharedRadialTable::winding_at_centre);
  py::class_<tangential::RingTable>(module, "RingTable")
      .def(py::init(&ring_table))
      .def("query", &query_rings)
      .def("occupied_arcs", &occupied_arcs);
}

}  // namespace condyle::python
