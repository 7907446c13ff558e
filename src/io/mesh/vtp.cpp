#include <algorithm>
#include <cstdint>
#include <iterator>
#include <limits>
#include <optional>
#include <utility>

#include "io/mesh/parse.hpp"
#include "io/mesh/vtk_array.hpp"
#include "io/mesh/xml.hpp"

namespace condyle::io {
namespace {

constexpr std::string_view end_of_file = "</VTKFile>";

struct VtpTypeName {
  std::string_view name;
  NumberType type;
};
constexpr VtpTypeName vtp_type_names[] = {{"Int8", NumberType::i8},     {"UInt8", NumberType::u8},
                                          {"Int16", NumberType::i16},   {"UInt16", NumberType::u16},
                                          {"Int32", NumberType::i32},   {"UInt32", NumberType::u32},
                                          {"Int64", NumberType::i64},   {"UInt64", NumberType::u64},
                                          {"Float32", NumberType::f32}, {"Float64", NumberType::f64}};

/// An array as its tag describes it; where an appended one begins is known only once the file's end is
/// reached.
struct Description {
  VtkArray array;
  std::optional<std::uint64_t> appended_at;
};

/// Corners of all cells of a kind in one row, and where each cell ends.
struct Cells {
  std::optional<Description> connectivity, offsets;
};

struct Piece {
  std::uint64_t points = 0, polygons = 0, strips = 0;
  std::optional<Description> coordinates;
  Cells of_polygons, of_strips;
};

struct AppendedData {
  VtkArray::Format format;
  std::string_view data;
};

std::string_view required(const XmlTag& tag, std::string_view attribute, const XmlCursor& xml) {
  const auto value = tag.find(attribute);
  if (!value) xml.fail(fmt::format("{} needs {}", in_quotes(tag.name), in_quotes(attribute)));
  return *value;
}

/// A count from an attribute; 0 if it is not given.
std::uint64_t count_from(const XmlTag& tag, std::string_view attribute, const XmlCursor& xml) {
  std::uint64_t count = 0;
  const auto value = tag.find(attribute);
  if (value && !parse_number(*value, count))
    xml.fail(fmt::format("{} should be {}", in_quotes(*value), in_quotes(attribute)));
  return count;
}

VtkEncoding encoding_from(const XmlTag& tag, const XmlCursor& xml) {
  if (tag.name != "VTKFile") xml.fail(in_quotes(tag.name) + " should be 'VTKFile'");
  const auto type = required(tag, "type", xml);
  if (type != "PolyData") xml.fail("holds " + in_quotes(type) + ": only 'PolyData' is read");

  VtkEncoding encoding;
  const auto order = tag.find("byte_order").value_or("LittleEndian");
  if (order == "BigEndian") {
    encoding.order = std::endian::big;
  } else if (order != "LittleEndian") {
    xml.fail(in_quotes(order) + " is no byte order");
  }
  const auto header = tag.find("header_type").value_or("UInt32");
  if (header == "UInt64") {
    encoding.header_word = sizeof(std::uint64_t);
  } else if (header != "UInt32") {
    xml.fail(in_quotes(header) + " is no header type");
  }
  const auto compressor = tag.find("compressor").value_or("");
  if (compressor == "vtkZLibDataCompressor") {
    encoding.compressor = Compressor::zlib;
  } else if (compressor == "vtkLZ4DataCompressor") {
    encoding.compressor = Compressor::lz4;
  } else if (!compressor.empty()) {
    xml.fail("compressed by " + in_quotes(compressor) + ": only zlib and LZ4 are read");
  }
  return encoding;
}

Piece piece_from(const XmlTag& tag, const XmlCursor& xml) {
  Piece piece;
  piece.points = count_from(tag, "NumberOfPoints", xml);
  piece.polygons = count_from(tag, "NumberOfPolys", xml);
  piece.strips = count_from(tag, "NumberOfStrips", xml);
  return piece;
}

Description description_from(const XmlTag& tag, std::string label, const XmlCursor& xml) {
  Description description{{std::move(label), NumberType::f32, VtkArray::Format::text, {}}, std::nullopt};
  auto& array = description.array;
  const auto type = required(tag, "type", xml);
  const auto* known = std::find_if(std::begin(vtp_type_names), std::end(vtp_type_names),
                                   [&](const VtpTypeName& candidate) { return candidate.name == type; });
  if (known == std::end(vtp_type_names)) xml.fail(in_quotes(type) + " is no type of an array");
  array.type = known->type;

  const auto format = tag.find("format").value_or("ascii");
  if (format == "appended") {
    required(tag, "offset", xml);
    description.appended_at = count_from(tag, "offset", xml);
    return description;
  }
  if (format == "binary") {
    array.format = VtkArray::Format::base64;
  } else if (format != "ascii") {
    xml.fail(in_quotes(format) + " is no format of an array");
  }
  array.data = tag.kind == XmlTag::Kind::open ? xml.text() : std::string_view();
  return description;
}

/// Where in the piece an array's description belongs; null for the arrays that make no surface.
std::optional<Description>* place_of(const XmlTag& tag, Piece& piece, std::string_view section) {
  if (section == "Points") return &piece.coordinates;
  if (section != "Polys" && section != "Strips") return nullptr;
  Cells& cells = section == "Polys" ? piece.of_polygons : piece.of_strips;
  const auto name = tag.find("Name").value_or("");
  return name == "connectivity" ? &cells.connectivity : name == "offsets" ? &cells.offsets : nullptr;
}

void add_array(const XmlTag& tag, Piece& piece, const XmlCursor& xml) {
  const auto& path = xml.path();
  const std::size_t depth = path.size() - (tag.kind == XmlTag::Kind::open ? 1 : 0);
  if (depth < 2 || path[depth - 2] != "Piece") return;
  const auto section = path[depth - 1];
  auto* place = place_of(tag, piece, section);
  if (place == nullptr) return;
  if (place->has_value()) xml.fail("a second array of " + in_quotes(section));
  if (section == "Points" && tag.find("NumberOfComponents") != "3")
    xml.fail("points need NumberOfComponents=\"3\"");
  *place = description_from(
      tag, section == "Points" ? "Points" : fmt::format("{} {}", section, tag.find("Name").value_or("")),
      xml);
}

AppendedData appended_from(const XmlTag& tag, const XmlCursor& xml, const Source& source) {
  const auto encoding = required(tag, "encoding", xml);
  if (encoding != "raw" && encoding != "base64")
    xml.fail(in_quotes(encoding) + " is no encoding of appended data");
  auto data = source.bytes.substr(xml.offset());
  while (!data.empty() && is_space(data.front())) data.remove_prefix(1);
  if (!data.starts_with('_')) xml.fail("appended data should begin with '_'");
  data.remove_prefix(1);
  // A file cut off at its end need not lack bytes of any array that is read.
  auto end = source.bytes;
  while (!end.empty() && is_space(end.back())) end.remove_suffix(1);
  if (!end.ends_with(end_of_file))
    source.fail(fmt::format("appended data: the file ends before '{}'", end_of_file));
  return {encoding == "raw" ? VtkArray::Format::raw : VtkArray::Format::base64, data};
}

VtkArray located(const std::optional<Description>& description, const std::optional<AppendedData>& appended,
                 std::string_view label, const Source& source) {
  if (!description) source.fail(fmt::format("no array {}", in_quotes(label)));
  VtkArray array = description->array;
  if (!description->appended_at) return array;
  if (!appended) source.fail(fmt::format("array {}: no appended data", in_quotes(array.label)));
  if (*description->appended_at > appended->data.size()) {
    source.fail(fmt::format("array {}: begins after the end of the file", in_quotes(array.label)));
  }
  array.format = appended->format;
  array.data = appended->data.substr(*description->appended_at);
  return array;
}

RawMesh mesh_from(const Piece& piece, const VtkEncoding& encoding,
                  const std::optional<AppendedData>& appended, const Source& source) {
  // Three numbers each, and neither text nor base64 nor a compressed block goes without its bytes: a count so
  // large that three times it overflows cannot be true.
  constexpr std::uint64_t largest = std::numeric_limits<std::uint64_t>::max() / 3;
  if (piece.points > largest || piece.polygons > largest || piece.strips > largest)
    source.fail("piece 0: announces more than any file can hold");
  RawMesh raw;
  if (piece.points > 0) {
    const auto xyz = read_coordinates(located(piece.coordinates, appended, "Points", source), encoding,
                                      3 * piece.points, source);
    raw.vertices.reserve(piece.points);
    for (std::size_t i = 0; i < xyz.size(); i += 3) raw.vertices.push_back({xyz[i], xyz[i + 1], xyz[i + 2]});
  }
  const auto ends_of = [&](const Cells& cells, std::uint64_t count, std::string_view label) {
    return read_integers(located(cells.offsets, appended, label, source), encoding, count, source);
  };
  const auto corners_of = [&](const Cells& cells, std::int64_t count, std::string_view label) {
    return read_integers(located(cells.connectivity, appended, label, source), encoding,
                         static_cast<std::uint64_t>(count), source);
  };
  if (piece.polygons > 0) {
    const auto ends = ends_of(piece.of_polygons, piece.polygons, "Polys offsets");
    check_ends(ends, source);
    append_cells(raw, corners_of(piece.of_polygons, ends.back(), "Polys connectivity"), ends, source);
  }
  if (piece.strips > 0) {
    const auto ends = ends_of(piece.of_strips, piece.strips, "Strips offsets");
    if (ends.back() < 0) source.fail(fmt::format("triangle strips end at corner {}", ends.back()));
    append_strips(raw, corners_of(piece.of_strips, ends.back(), "Strips connectivity"), ends, source);
  }
  return raw;
}

}  // namespace

/// XML PolyData of one piece. Vertex and line cells bound nothing and are passed over, as are the data
/// arrays.
RawMesh read_vtp(const Source& source) {
  XmlCursor xml(source);
  const VtkEncoding encoding = encoding_from(*xml.next(), xml);
  std::optional<Piece> piece;
  std::optional<AppendedData> appended;
  while (const auto tag = xml.next()) {
    if (tag->kind == XmlTag::Kind::close) continue;
    if (tag->name == "Piece") {
      if (piece) xml.fail("a second piece: only files of one piece are read");
      piece = piece_from(*tag, xml);
    } else if (tag->name == "DataArray" && piece) {
      add_array(*tag, *piece, xml);
    } else if (tag->name == "AppendedData") {
      appended = appended_from(*tag, xml, source);
      break;
    }
  }
  if (!piece) source.fail("no piece");
  return mesh_from(*piece, encoding, appended, source);
}

}  // namespace condyle::io
