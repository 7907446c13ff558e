#include <fmt/format.h>
#include <vtkCellArray.h>
#include <vtkCellData.h>
#include <vtkDataArray.h>
#include <vtkDoubleArray.h>
#include <vtkFieldData.h>
#include <vtkFloatArray.h>
#include <vtkIntArray.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>
#include <vtkSmartPointer.h>
#include <vtkStringArray.h>
#include <vtkUnsignedCharArray.h>
#include <vtkXMLPolyDataWriter.h>

#include <algorithm>
#include <cassert>
#include <cmath>
#include <cstring>
#include <limits>
#include <new>
#include <span>

#include "condyle/error.hpp"
#include "condyle/io/mesh_file.hpp"
#include "io/file/whole_file.hpp"
#include "io/mesh/parse.hpp"
#include "io/mesh/vtk_silence.hpp"

static_assert(std::endian::native == std::endian::little,
              "PLY files are written as the machine has the numbers");

namespace condyle {
namespace {

/// Whether floats hold these numbers to the last bit. What a float cannot reach overflows: compare before
/// converting.
bool is_float_valued(std::span<const double> values) {
  constexpr double largest = std::numeric_limits<float>::max();
  return std::all_of(values.begin(), values.end(), [](double value) {
    return std::abs(value) <= largest && static_cast<double>(static_cast<float>(value)) == value;
  });
}

bool is_float_valued(const Points& points) {
  return is_float_valued(points.x) && is_float_valued(points.y) && is_float_valued(points.z);
}

template <class T>
void append(std::string& bytes, T value) {
  bytes.append(reinterpret_cast<const char*>(&value), sizeof value);
}

template <class Coordinate>
std::string ply_bytes(const TriMesh& mesh, std::string_view coordinate_name) {
  std::string bytes = fmt::format(
      "ply\nformat binary_little_endian 1.0\n"
      "element vertex {0}\nproperty {1} x\nproperty {1} y\nproperty {1} z\n"
      "element face {2}\nproperty list uchar int vertex_indices\nend_header\n",
      mesh.vertices.size(), coordinate_name, mesh.triangles.size());
  constexpr std::size_t face_size = 1 + 3 * sizeof(std::int32_t);
  bytes.reserve(bytes.size() + 3 * sizeof(Coordinate) * mesh.vertices.size() +
                face_size * mesh.triangles.size());
  for (std::size_t v = 0; v < mesh.vertices.size(); ++v) {
    for (const double value : {mesh.vertices.x[v], mesh.vertices.y[v], mesh.vertices.z[v]}) {
      append(bytes, static_cast<Coordinate>(value));
    }
  }
  for (const auto& triangle : mesh.triangles) {
    append(bytes, std::uint8_t{3});
    for (const Index v : triangle) append(bytes, static_cast<std::int32_t>(v));
  }
  return bytes;
}

/// Most programs know the indices of a PLY file as int only.
void write_ply(const std::filesystem::path& path, const TriMesh& mesh) {
  if (mesh.vertices.size() > std::numeric_limits<std::int32_t>::max()) {
    throw FileError(path.string() + ": cannot be written: more vertices than a PLY file can number");
  }
  io::write_whole_file(path, is_float_valued(mesh.vertices) ? ply_bytes<float>(mesh, "float")
                                                            : ply_bytes<double>(mesh, "double"));
}

template <class Array>
vtkSmartPointer<vtkPoints> points_for_vtk(const Points& points) {
  vtkNew<Array> xyz;
  xyz->SetNumberOfComponents(3);
  xyz->SetNumberOfTuples(static_cast<vtkIdType>(points.size()));
  auto* out = xyz->GetPointer(0);
  for (std::size_t i = 0; i < points.size(); ++i) {
    for (const double value : {points.x[i], points.y[i], points.z[i]}) {
      *out++ = static_cast<typename Array::ValueType>(value);
    }
  }
  auto result = vtkSmartPointer<vtkPoints>::New();
  result->SetData(xyz);
  return result;
}

vtkSmartPointer<vtkCellArray> triangles_for_vtk(const std::vector<Triangle>& triangles) {
  auto cells = vtkSmartPointer<vtkCellArray>::New();
  cells->AllocateExact(static_cast<vtkIdType>(triangles.size()),
                       static_cast<vtkIdType>(3 * triangles.size()));
  for (const auto& [a, b, c] : triangles) cells->InsertNextCell({vtkIdType{a}, vtkIdType{b}, vtkIdType{c}});
  return cells;
}

template <class Array, class T>
vtkSmartPointer<vtkDataArray> filled(const std::vector<T>& values) {
  auto array = vtkSmartPointer<Array>::New();
  array->SetNumberOfValues(static_cast<vtkIdType>(values.size()));
  std::copy(values.begin(), values.end(), array->GetPointer(0));
  return array;
}

struct ArrayForVtk {
  vtkSmartPointer<vtkDataArray> operator()(const std::vector<double>& values) const {
    return filled<vtkDoubleArray>(values);
  }
  vtkSmartPointer<vtkDataArray> operator()(const std::vector<std::int32_t>& values) const {
    return filled<vtkIntArray>(values);
  }
  vtkSmartPointer<vtkDataArray> operator()(const std::vector<std::uint8_t>& values) const {
    return filled<vtkUnsignedCharArray>(values);
  }
};

void add_arrays(std::span<const MeshArray> arrays, [[maybe_unused]] std::size_t elements,
                vtkDataSetAttributes* out) {
  for (const auto& array : arrays) {
    auto values = std::visit(ArrayForVtk{}, array.values);
    assert(static_cast<std::size_t>(values->GetNumberOfTuples()) == elements && "one value per element");
    values->SetName(array.name.c_str());
    out->AddArray(values);
  }
  if (!arrays.empty()) out->SetActiveScalars(arrays.front().name.c_str());
}

void add_fields(const std::vector<VtpField>& fields, vtkFieldData* out) {
  for (const auto& [name, value] : fields) {
    vtkSmartPointer<vtkAbstractArray> array;
    if (const auto* text = std::get_if<std::string>(&value)) {
      auto words = vtkSmartPointer<vtkStringArray>::New();
      words->InsertNextValue(*text);
      array = words;
    } else {
      array = filled<vtkDoubleArray>(std::get<std::vector<double>>(value));
    }
    array->SetName(name.c_str());
    out->AddArray(array);
  }
}

/// VTK writes into memory, so that a full disk is noticed here and nothing half done keeps the name.
std::string vtp_bytes(const TriMesh& mesh, std::span<const MeshArray> point_arrays,
                      std::span<const MeshArray> cell_arrays, const VtpOptions& options) {
  const io::VtkSilence silence;
  vtkNew<vtkPolyData> data;
  data->SetPoints(is_float_valued(mesh.vertices) ? points_for_vtk<vtkFloatArray>(mesh.vertices)
                                                 : points_for_vtk<vtkDoubleArray>(mesh.vertices));
  data->SetPolys(triangles_for_vtk(mesh.triangles));
  add_arrays(point_arrays, mesh.vertices.size(), data->GetPointData());
  add_arrays(cell_arrays, mesh.triangles.size(), data->GetCellData());
  add_fields(options.fields, data->GetFieldData());

  vtkNew<vtkXMLPolyDataWriter> writer;
  writer->SetInputData(data);
  if (options.encoding == VtpEncoding::text) {
    writer->SetDataModeToAscii();
  } else {
    writer->SetDataModeToAppended();
    writer->EncodeAppendedDataOff();
  }
  writer->SetHeaderTypeToUInt64();
  writer->WriteToOutputStringOn();
  // Its stream stops where memory ends, without an exception.
  const bool written = writer->Write() != 0 && writer->GetErrorCode() == 0;
  std::string bytes = writer->GetOutputString();
  if (!written || !bytes.ends_with("</VTKFile>\n")) throw std::bad_alloc();
  return bytes;
}

}  // namespace

void write_vtp(const std::filesystem::path& path, const TriMesh& mesh,
               std::span<const MeshArray> point_arrays, std::span<const MeshArray> cell_arrays,
               const VtpOptions& options) {
  io::write_whole_file(path, vtp_bytes(mesh, point_arrays, cell_arrays, options));
}

void write_mesh(const std::filesystem::path& path, const TriMesh& mesh) {
  const auto extension = io::lower_case(path.extension().string());
  if (extension == ".ply") {
    write_ply(path, mesh);
  } else if (extension == ".vtp") {
    write_vtp(path, mesh, {}, {});
  } else {
    throw FileError(fmt::format("{}: unknown extension '{}': .vtp and .ply are written", path.string(),
                                path.extension().string()));
  }
}

}  // namespace condyle
