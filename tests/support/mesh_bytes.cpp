#include "support/mesh_bytes.hpp"

#include <fmt/format.h>
#include <vtkCellArray.h>
#include <vtkCharArray.h>
#include <vtkDoubleArray.h>
#include <vtkFloatArray.h>
#include <vtkIdList.h>
#include <vtkIntArray.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>
#include <vtkPolyDataReader.h>
#include <vtkPolyDataWriter.h>
#include <vtkSmartPointer.h>
#include <vtkXMLPolyDataReader.h>
#include <vtkXMLPolyDataWriter.h>

#include <algorithm>
#include <iterator>
#include <utility>

namespace condyle::test {
namespace {

/// The bytes of a number, most or least significant first, whatever the machine.
template <class T>
void append(std::string& out, T value, bool big_endian = false) {
  std::string bytes(reinterpret_cast<const char*>(&value), sizeof value);
  if (big_endian) std::reverse(bytes.begin(), bytes.end());
  out += bytes;
}

template <class Coordinate>
std::string ply_text(const TriMesh& mesh, const char* type) {
  std::string out = fmt::format(
      "ply\nformat ascii 1.0\ncomment by hand\nobj_info none\nelement vertex {0}\nproperty {1} x\nproperty "
      "{1} y\n"
      "property {1} z\nproperty uchar red\nelement face {2}\nproperty list uchar uint vertex_index\n"
      "property list int float texcoord\nelement edge 1\nproperty int vertex1\nproperty int "
      "vertex2\nend_header\n",
      mesh.vertices.size(), type, mesh.triangles.size());
  for (std::size_t v = 0; v < mesh.vertices.size(); ++v) {
    const auto& p = mesh.vertices;
    out += fmt::format("{} {} {} 255\n", static_cast<Coordinate>(p.x[v]), static_cast<Coordinate>(p.y[v]),
                       static_cast<Coordinate>(p.z[v]));
  }
  for (const auto& [a, b, c] : mesh.triangles) out += fmt::format("3 {} {} {} 2 0.5 0.25\n", a, b, c);
  return out + "0 1\n";
}

template <class Coordinate, class Corner>
std::string ply_binary(const TriMesh& mesh, const char* coordinate_type, const char* corner_type,
                       bool big_endian) {
  std::string out = fmt::format(
      "ply\nformat binary_{3}_endian 1.0\nelement vertex {0}\nproperty short quality\nproperty {1} "
      "x\nproperty {1} y\n"
      "property {1} z\nelement face {2}\nproperty list uchar {4} vertex_indices\nproperty uchar "
      "flags\nend_header\n",
      mesh.vertices.size(), coordinate_type, mesh.triangles.size(), big_endian ? "big" : "little",
      corner_type);
  for (std::size_t v = 0; v < mesh.vertices.size(); ++v) {
    append(out, std::int16_t{7}, big_endian);
    for (const double value : {mesh.vertices.x[v], mesh.vertices.y[v], mesh.vertices.z[v]})
      append(out, static_cast<Coordinate>(value), big_endian);
  }
  for (const auto& triangle : mesh.triangles) {
    append(out, std::uint8_t{3});
    for (const Index v : triangle) append(out, static_cast<Corner>(v), big_endian);
    append(out, std::uint8_t{1});
  }
  return out;
}

template <class Array>
vtkSmartPointer<vtkPolyData> for_vtk(const TriMesh& mesh) {
  vtkNew<Array> xyz;
  xyz->SetNumberOfComponents(3);
  for (std::size_t v = 0; v < mesh.vertices.size(); ++v) {
    const Vec3 p = mesh.vertices[v];
    xyz->InsertNextTuple3(p.x(), p.y(), p.z());
  }
  vtkNew<vtkPoints> points;
  points->SetData(xyz);
  vtkNew<vtkCellArray> cells;
  for (const auto& [a, b, c] : mesh.triangles)
    cells->InsertNextCell({vtkIdType{a}, vtkIdType{b}, vtkIdType{c}});
  vtkNew<vtkIntArray> numbers;
  numbers->SetName("number");
  for (std::size_t v = 0; v < mesh.vertices.size(); ++v) numbers->InsertNextValue(static_cast<int>(v));
  auto data = vtkSmartPointer<vtkPolyData>::New();
  data->SetPoints(points);
  data->SetPolys(cells);
  data->GetPointData()->AddArray(numbers);
  return data;
}

struct Choice {
  const char* name;
  int value;
};
constexpr Choice compressors[] = {
    {"plain", vtkXMLWriter::NONE}, {"zlib", vtkXMLWriter::ZLIB}, {"lz4", vtkXMLWriter::LZ4}};
constexpr Choice lengths[] = {{"UInt32", vtkXMLWriter::UInt32}, {"UInt64", vtkXMLWriter::UInt64}};
constexpr Choice orders[] = {{"little", vtkXMLWriter::LittleEndian}, {"big", vtkXMLWriter::BigEndian}};
enum class Data { text, inline_base64, appended_base64, appended_raw };
constexpr std::pair<const char*, Data> data_modes[] = {{"text", Data::text},
                                                       {"inline", Data::inline_base64},
                                                       {"appended base64", Data::appended_base64},
                                                       {"appended raw", Data::appended_raw}};

std::string vtp_bytes(vtkPolyData* data, Data mode, int compressor, int length, int order) {
  constexpr std::size_t block_size = 128;  // bytes: several blocks and a partial one, even for a small mesh
  vtkNew<vtkXMLPolyDataWriter> writer;
  writer->SetInputData(data);
  writer->SetDataMode(mode == Data::text            ? vtkXMLWriter::Ascii
                      : mode == Data::inline_base64 ? vtkXMLWriter::Binary
                                                    : vtkXMLWriter::Appended);
  writer->SetEncodeAppendedData(mode == Data::appended_base64);
  writer->SetCompressorType(compressor);
  writer->SetHeaderType(length);
  writer->SetByteOrder(order);
  writer->SetIdType(length == vtkXMLWriter::UInt32 ? vtkXMLWriter::Int32 : vtkXMLWriter::Int64);
  writer->SetBlockSize(block_size);
  writer->WriteToOutputStringOn();
  writer->Write();
  return writer->GetOutputString();
}

template <class Array>
void add_vtp_files(const TriMesh& mesh, const char* type, std::vector<MeshBytes>& out) {
  const auto data = for_vtk<Array>(mesh);
  for (const auto& [mode_name, mode] : data_modes) {
    for (const auto& compressor : compressors) {
      for (const auto& length : lengths) {
        for (const auto& order : orders) {
          out.push_back(
              {fmt::format("vtp {} {} {} {} {}", mode_name, compressor.name, length.name, order.name, type),
               io::MeshFormat::vtp, mode != Data::text,
               vtp_bytes(data, mode, compressor.value, length.value, order.value)});
        }
      }
    }
  }
}

template <class Array>
void add_legacy_files(const TriMesh& mesh, const char* type, std::vector<MeshBytes>& out) {
  const auto data = for_vtk<Array>(mesh);
  constexpr Choice encodings[] = {{"text", VTK_ASCII}, {"binary", VTK_BINARY}};
  constexpr Choice versions[] = {{"4.2", vtkDataWriter::VTK_LEGACY_READER_VERSION_4_2},
                                 {"5.1", vtkDataWriter::VTK_LEGACY_READER_VERSION_5_1}};
  for (const auto& encoding : encodings) {
    for (const auto& version : versions) {
      vtkNew<vtkPolyDataWriter> writer;
      writer->SetInputData(data);
      writer->SetFileType(encoding.value);
      writer->SetFileVersion(version.value);
      writer->WriteToOutputStringOn();
      writer->Write();
      out.push_back({fmt::format("vtk {} {} {}", encoding.name, version.name, type), io::MeshFormat::vtk,
                     encoding.value == VTK_BINARY, writer->GetOutputStdString()});
    }
  }
}

TriMesh from_vtk(vtkPolyData* data) {
  TriMesh mesh;
  for (vtkIdType v = 0; v < data->GetNumberOfPoints(); ++v) mesh.vertices.push_back(Vec3(data->GetPoint(v)));
  vtkNew<vtkIdList> corners;
  for (vtkIdType t = 0; t < data->GetNumberOfPolys(); ++t) {
    data->GetPolys()->GetCellAtId(t, corners);
    auto& triangle = mesh.triangles.emplace_back();
    for (int k = 0; k < 3; ++k) triangle[k] = static_cast<Index>(corners->GetId(k));
  }
  return mesh;
}

}  // namespace

std::vector<MeshBytes> stl_files(const TriMesh& mesh) {
  std::string text = "solid a bone\n", binary = "solid as some programs begin a binary file";
  binary.resize(80, ' ');
  append(binary, static_cast<std::uint32_t>(mesh.triangles.size()));
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    text += "facet normal 0 0 0\n outer loop\n";
    for (int k = 0; k < 3; ++k) append(binary, 0.0f);
    for (int k = 0; k < 3; ++k) {
      const Vec3 p = mesh.corner(t, k);
      text += fmt::format("  vertex {} {} {}\n", p.x(), p.y(), p.z());
      for (const double value : p) append(binary, static_cast<float>(value));
    }
    text += " endloop\nendfacet\n";
    append(binary, std::uint16_t{0});
  }
  text += "endsolid a bone\n";
  return {{"stl text", io::MeshFormat::stl, true, text}, {"stl binary", io::MeshFormat::stl, true, binary}};
}

std::vector<MeshBytes> obj_files(const TriMesh& mesh) {
  std::string vertices = "# by hand\nmtllib a.mtl\no bone\n", plain, slashes, backwards;
  for (std::size_t v = 0; v < mesh.vertices.size(); ++v)
    vertices += fmt::format("v {} {} {}\n", mesh.vertices.x[v], mesh.vertices.y[v], mesh.vertices.z[v]);
  vertices += "vt 0 0\nvn 0 0 1\ng all\ns off\n";
  const auto count = static_cast<int>(mesh.vertices.size());
  for (const auto& [a, b, c] : mesh.triangles) {
    plain += fmt::format("f {} {} {}\n", a + 1, b + 1, c + 1);
    slashes += fmt::format("f {}/1 {}/1/1 {}//1 # a remark\r\n", a + 1, b + 1, c + 1);
    backwards += fmt::format("f {} {} {}\n", static_cast<int>(a) - count, static_cast<int>(b) - count,
                             static_cast<int>(c) - count);
  }
  return {{"obj", io::MeshFormat::obj, true, vertices + plain},
          {"obj with texture and normals", io::MeshFormat::obj, true, vertices + slashes},
          {"obj counted back", io::MeshFormat::obj, true, vertices + backwards},
          {"obj, faces first", io::MeshFormat::obj, true, plain + vertices}};
}

std::vector<MeshBytes> ply_files(const TriMesh& mesh) {
  std::vector<MeshBytes> files = {
      {"ply text, float", io::MeshFormat::ply, true, ply_text<float>(mesh, "float")},
      {"ply text, double", io::MeshFormat::ply, true, ply_text<double>(mesh, "float64")}};
  for (const bool big : {false, true}) {
    const std::string name = big ? "ply big-endian, " : "ply little-endian, ";
    const auto add = [&](const char* type, std::string bytes) {
      files.push_back({name + type, io::MeshFormat::ply, true, std::move(bytes)});
    };
    add("float and int", ply_binary<float, std::int32_t>(mesh, "float32", "int32", big));
    add("double and uint", ply_binary<double, std::uint32_t>(mesh, "double", "uint", big));
    const std::size_t vertices = mesh.vertices.size();
    if (vertices <= 0x8000)
      add("double and short", ply_binary<double, std::int16_t>(mesh, "double", "short", big));
    if (vertices <= 0x10000)
      add("float and ushort", ply_binary<float, std::uint16_t>(mesh, "float", "uint16", big));
    if (vertices <= 0x100)
      add("float and uchar", ply_binary<float, std::uint8_t>(mesh, "float", "uchar", big));
  }
  return files;
}

std::vector<MeshBytes> vtp_files(const TriMesh& mesh) {
  std::vector<MeshBytes> files;
  add_vtp_files<vtkFloatArray>(mesh, "float", files);
  add_vtp_files<vtkDoubleArray>(mesh, "double", files);
  return files;
}

std::vector<MeshBytes> legacy_vtk_files(const TriMesh& mesh) {
  std::vector<MeshBytes> files;
  add_legacy_files<vtkFloatArray>(mesh, "float", files);
  add_legacy_files<vtkDoubleArray>(mesh, "double", files);
  return files;
}

std::vector<MeshBytes> all_files(const TriMesh& mesh) {
  std::vector<MeshBytes> files;
  for (auto* written : {stl_files, obj_files, ply_files, vtp_files, legacy_vtk_files}) {
    auto some = written(mesh);
    std::move(some.begin(), some.end(), std::back_inserter(files));
  }
  return files;
}

TriMesh as_vtk_reads(const MeshBytes& file) {
  if (file.format == io::MeshFormat::vtp) {
    vtkNew<vtkXMLPolyDataReader> reader;
    reader->ReadFromInputStringOn();
    reader->SetInputString(file.bytes);
    reader->Update();
    return from_vtk(reader->GetOutput());
  }
  vtkNew<vtkCharArray> bytes;
  bytes->SetNumberOfValues(static_cast<vtkIdType>(file.bytes.size()));
  std::copy(file.bytes.begin(), file.bytes.end(), bytes->GetPointer(0));
  vtkNew<vtkPolyDataReader> reader;
  reader->ReadFromInputStringOn();
  reader->SetInputArray(bytes);
  reader->Update();
  return from_vtk(reader->GetOutput());
}

}  // namespace condyle::test
