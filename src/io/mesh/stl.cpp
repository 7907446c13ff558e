#include <cstdint>

#include "io/mesh/parse.hpp"

namespace condyle::io {
namespace {

constexpr std::size_t header_size = 80, count_size = 4;
constexpr std::size_t normal_size = 12,
                      triangle_size = 50;  // normal, three corners of three floats, two unused bytes

/// How many triangles a binary file announces; 0 if it is too short to announce any.
std::uint32_t announced_triangles(const Source& source) {
  if (source.bytes.size() < header_size + count_size) return 0;
  return ByteCursor(source, header_size).value<std::uint32_t>(std::endian::little);
}

std::uint64_t binary_size(std::uint32_t triangles) {
  return header_size + count_size + std::uint64_t{triangle_size} * triangles;
}

/// Text begins with "solid", but so do the headers of some binary files. One with a zero byte is a binary file gone wrong, for
/// text has none.
bool is_text(const Source& source) {
  if (is_binary_stl(source)) return false;
  TextCursor text(source);
  return io::lower_case(text.word()) == "solid" && source.bytes.find('\0') == std::string_view::npos;
}

void add_triangle(RawMesh& raw) {
  const auto last = static_cast<std::int64_t>(raw.vertices.size());
  raw.triangles.push_back({last - 3, last - 2, last - 1});
}

RawMesh read_text(const Source& source) {
  RawMesh raw;
  TextCursor text(source);
  while (true) {  // solids: a file may hold several, one after the other
    const auto first = text.word();
    if (first.empty()) return raw;
    if (io::lower_case(first) != "solid") text.fail(in_quotes(first) + " should be 'solid'");
    text.rest_of_line();
    while (true) {  // facets
      const auto word = io::lower_case(text.word());
      if (word == "endsolid") break;
      if (word.empty()) text.fail("the file ends before 'endsolid'");
      if (word != "facet") text.fail(in_quotes(word) + " should be 'facet' or 'endsolid'");
      text.expect("normal");
      for (int k = 0; k < 3; ++k) text.word();  // not a number in some files; the corners say it better
      text.expect("outer");
      text.expect("loop");
      for (int corner = 0; corner < 3; ++corner) {
        text.expect("vertex");
        const auto x = text.number<double>("a coordinate");
        const auto y = text.number<double>("a coordinate");
        const auto z = text.number<double>("a coordinate");
        raw.vertices.push_back({x, y, z});
      }
      text.expect("endloop");
      text.expect("endfacet");
      add_triangle(raw);
    }
    text.rest_of_line();  // the solid's name again
  }
}

RawMesh read_binary(const Source& source) {
  if (source.bytes.size() < header_size + count_size) {
    source.fail(fmt::format("header: the file has {} bytes, an STL file at least {}", source.bytes.size(),
                            header_size + count_size));
  }
  const std::uint32_t count = announced_triangles(source);
  if (source.bytes.size() != binary_size(count)) {
    source.fail(fmt::format("header: {} triangles need {} bytes, the file has {}", count, binary_size(count),
                            source.bytes.size()));
  }
  RawMesh raw;
  raw.vertices.reserve(3 * std::size_t{count});
  raw.triangles.reserve(count);
  ByteCursor bytes(source, header_size + count_size);
  for (std::uint32_t t = 0; t < count; ++t) {
    bytes.take(normal_size);
    for (int corner = 0; corner < 3; ++corner) {
      const auto x = bytes.value<float>(std::endian::little);
      const auto y = bytes.value<float>(std::endian::little);
      const auto z = bytes.value<float>(std::endian::little);
      raw.vertices.push_back({x, y, z});
    }
    bytes.take(triangle_size - normal_size - 9 * sizeof(float));
    add_triangle(raw);
  }
  return raw;
}

}  // namespace

bool is_binary_stl(const Source& source) {
  return source.bytes.size() >= header_size + count_size &&
         source.bytes.size() == binary_size(announced_triangles(source));
}

/// The soup of the file: three vertices of its own for every triangle. Normals are not read.
RawMesh read_stl(const Source& source) {
  return is_text(source) ? read_text(source) : read_binary(source);
}

}  // namespace condyle::io
