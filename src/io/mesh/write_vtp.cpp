#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cassert>
#include <cstring>
#include <iterator>
#include <span>
#include <string_view>
#include <variant>

#include "condyle/io/mesh_file.hpp"
#include "io/file/deflate.hpp"
#include "io/file/whole_file.hpp"
#include "io/file/xml_escaped.hpp"
#include "io/mesh/float_valued.hpp"

static_assert(std::endian::native == std::endian::little,
              "VTP files are written as the machine has the numbers");

/// XML PolyData of one piece, as VTK's own reader, ParaView and 3D Slicer read it: arrays appended raw and compressed by zlib
/// in blocks, or written as text.
///
///     <VTKFile><PolyData><Piece><PointData/><CellData/><Points/><Polys/></Piece><FieldData/></PolyData>
///       <AppendedData encoding="raw">_ array array ... </AppendedData></VTKFile>
///     array:  blocks, size of each, size of the last one if it is smaller, compressed sizes: 64 bits each; blocks

namespace condyle::io {
namespace {

template <class T>
constexpr std::string_view type_name;
template <>
constexpr std::string_view type_name<float> = "Float32";
template <>
constexpr std::string_view type_name<double> = "Float64";
template <>
constexpr std::string_view type_name<std::uint8_t> = "UInt8";
template <>
constexpr std::string_view type_name<std::int32_t> = "Int32";
template <>
constexpr std::string_view type_name<std::int64_t> = "Int64";

/// One block is read and uncompressed at a time, and each begins anew to compress: larger ones compress little better.
constexpr std::size_t vtp_block_size = 1 << 20;

std::string compressed_array(std::string_view bytes) {
  std::vector<std::uint64_t> header = {(bytes.size() + vtp_block_size - 1) / vtp_block_size, vtp_block_size,
                                       bytes.size() % vtp_block_size};
  std::string blocks;
  for (std::size_t at = 0; at < bytes.size(); at += vtp_block_size) {
    const std::string block = io::deflated(bytes.substr(at, vtp_block_size));
    header.push_back(block.size());
    blocks += block;
  }
  return std::string(reinterpret_cast<const char*>(header.data()), header.size() * sizeof header[0]) + blocks;
}

/// The document, and behind it what its arrays refer to.
class VtpText {
 public:
  explicit VtpText(VtpEncoding encoding) : encoding_(encoding) {}

  void add(std::string_view text) { text_ += text; }

  /// `tag` is the element's name with its attributes, but for those that say where its values are.
  template <class T>
  void add_array(const std::string& tag, std::span<const T> values) {
    const std::string_view element = std::string_view(tag).substr(0, tag.find(' '));
    if (encoding_ == VtpEncoding::binary) {
      fmt::format_to(std::back_inserter(text_), "<{} format=\"appended\" offset=\"{}\"/>\n", tag,
                     appended_.size());
      appended_ += compressed_array({reinterpret_cast<const char*>(values.data()), values.size_bytes()});
      return;
    }
    fmt::format_to(std::back_inserter(text_), "<{} format=\"ascii\">\n", tag);
    constexpr std::size_t in_a_line = 6;
    for (std::size_t i = 0; i < values.size(); ++i) {
      // A byte is a number here, not a character.
      if constexpr (sizeof(T) == 1)
        fmt::format_to(std::back_inserter(text_), "{}", static_cast<int>(values[i]));
      else
        fmt::format_to(std::back_inserter(text_), "{}", values[i]);
      text_ += (i + 1) % in_a_line == 0 || i + 1 == values.size() ? '\n' : ' ';
    }
    fmt::format_to(std::back_inserter(text_), "</{}>\n", element);
  }

  std::string document() && {
    if (encoding_ == VtpEncoding::binary) {
      text_ += "<AppendedData encoding=\"raw\">\n_";
      text_ += appended_;
      text_ += "\n</AppendedData>\n";
    }
    return std::move(text_) + "</VTKFile>\n";
  }

 private:
  VtpEncoding encoding_;
  std::string text_, appended_;
};

template <class T>
std::string data_array(std::string_view name, std::string_view more = "") {
  return fmt::format("DataArray type=\"{}\" Name=\"{}\"{}", type_name<T>, io::xml_escaped(name), more);
}

template <class Coordinate>
void add_points(VtpText& out, const Points& points) {
  std::vector<Coordinate> xyz;
  xyz.reserve(3 * points.size());
  for (std::size_t i = 0; i < points.size(); ++i)
    for (const double value : {points.x[i], points.y[i], points.z[i]})
      xyz.push_back(static_cast<Coordinate>(value));
  out.add("<Points>\n");
  out.add_array<Coordinate>(data_array<Coordinate>("Points", " NumberOfComponents=\"3\""), xyz);
  out.add("</Points>\n");
}

void add_triangles(VtpText& out, const std::vector<Triangle>& triangles) {
  std::vector<std::int64_t> corners, ends;
  corners.reserve(3 * triangles.size()), ends.reserve(triangles.size());
  for (const Triangle& triangle : triangles) {
    corners.insert(corners.end(), triangle.begin(), triangle.end());
    ends.push_back(static_cast<std::int64_t>(corners.size()));
  }
  out.add("<Polys>\n");
  out.add_array<std::int64_t>(data_array<std::int64_t>("connectivity"), corners);
  out.add_array<std::int64_t>(data_array<std::int64_t>("offsets"), ends);
  out.add("</Polys>\n");
}

/// The first array is the one to colour by.
void add_attributes(VtpText& out, std::string_view element, std::span<const MeshArray> arrays,
                    [[maybe_unused]] std::size_t elements) {
  out.add(arrays.empty()
              ? fmt::format("<{}>\n", element)
              : fmt::format("<{} Scalars=\"{}\">\n", element, io::xml_escaped(arrays.front().name)));
  for (const MeshArray& array : arrays)
    std::visit(
        [&]<class T>(const std::vector<T>& values) {
          assert(values.size() == elements && "one value per element");
          out.add_array<T>(data_array<T>(array.name), values);
        },
        array.values);
  out.add(fmt::format("</{}>\n", element));
}

/// Texts are their characters, each text ended by 0.
void add_fields(VtpText& out, const std::vector<VtpField>& fields) {
  if (fields.empty()) return;
  out.add("<FieldData>\n");
  for (const auto& [name, value] : fields) {
    if (const auto* text = std::get_if<std::string>(&value)) {
      const std::span<const std::uint8_t> characters(reinterpret_cast<const std::uint8_t*>(text->c_str()),
                                                     std::strlen(text->c_str()) + 1);
      out.add_array(
          fmt::format("Array type=\"String\" Name=\"{}\" NumberOfTuples=\"1\"", io::xml_escaped(name)),
          characters);
    } else {
      const auto& numbers = std::get<std::vector<double>>(value);
      out.add_array<double>(data_array<double>(name, fmt::format(" NumberOfTuples=\"{}\"", numbers.size())),
                            numbers);
    }
  }
  out.add("</FieldData>\n");
}

std::string vtp_bytes(const TriMesh& mesh, std::span<const MeshArray> point_arrays,
                      std::span<const MeshArray> cell_arrays, const VtpOptions& options) {
  VtpText out(options.encoding);
  out.add(
      fmt::format("<?xml version=\"1.0\"?>\n<VTKFile type=\"PolyData\" version=\"1.0\" "
                  "byte_order=\"LittleEndian\" header_type=\"UInt64\"{}>\n<PolyData>\n",
                  options.encoding == VtpEncoding::binary ? " compressor=\"vtkZLibDataCompressor\"" : ""));
  out.add(
      fmt::format("<Piece NumberOfPoints=\"{}\" NumberOfVerts=\"0\" NumberOfLines=\"0\" NumberOfStrips=\"0\" "
                  "NumberOfPolys=\"{}\">\n",
                  mesh.vertices.size(), mesh.triangles.size()));
  add_attributes(out, "PointData", point_arrays, mesh.vertices.size());
  add_attributes(out, "CellData", cell_arrays, mesh.triangles.size());
  if (io::is_float_valued(mesh.vertices))
    add_points<float>(out, mesh.vertices);
  else
    add_points<double>(out, mesh.vertices);
  add_triangles(out, mesh.triangles);
  out.add("</Piece>\n");
  // Last, so that the surface is the same bytes wherever its files lie.
  add_fields(out, options.fields);
  out.add("</PolyData>\n");
  return std::move(out).document();
}

}  // namespace

void write_vtp(const std::filesystem::path& path, const TriMesh& mesh,
               std::span<const MeshArray> point_arrays, std::span<const MeshArray> cell_arrays,
               const VtpOptions& options) {
  io::write_whole_file(path, vtp_bytes(mesh, point_arrays, cell_arrays, options));
}

}  // namespace condyle::io
