#include <algorithm>
#include <cstdint>
#include <limits>
#include <optional>
#include <type_traits>
#include <utility>

#include "io/file/number_type.hpp"
#include "io/mesh/parse.hpp"

namespace condyle::io {
namespace {

enum class Encoding { text, little, big };

struct PlyTypeName {
  std::string_view name;
  NumberType type;
};
constexpr PlyTypeName ply_type_names[] = {
    {"char", NumberType::i8},    {"int8", NumberType::i8},     {"uchar", NumberType::u8},
    {"uint8", NumberType::u8},   {"short", NumberType::i16},   {"int16", NumberType::i16},
    {"ushort", NumberType::u16}, {"uint16", NumberType::u16},  {"int", NumberType::i32},
    {"int32", NumberType::i32},  {"uint", NumberType::u32},    {"uint32", NumberType::u32},
    {"float", NumberType::f32},  {"float32", NumberType::f32}, {"double", NumberType::f64},
    {"float64", NumberType::f64}};

/// What -1 becomes in an unsigned type; -1 for every other type.
std::int64_t largest_unsigned(NumberType type) {
  return with_number_type(type, [](auto zero) -> std::int64_t {
    if constexpr (std::is_unsigned_v<decltype(zero)>) return std::numeric_limits<decltype(zero)>::max();
    return -1;
  });
}

struct Property {
  std::string name;
  NumberType type;
  std::optional<NumberType> count_type;  ///< Type of a list's length.
};

struct Element {
  std::string name;
  std::uint64_t count;
  std::vector<Property> properties;
};

struct Header {
  Encoding encoding = Encoding::text;
  std::vector<Element> elements;
  std::size_t size = 0;  ///< Bytes, up to the first of the data.
};

std::vector<std::string_view> ply_words(std::string_view line) {
  std::vector<std::string_view> words;
  for (std::size_t at = 0; at < line.size();) {
    while (at < line.size() && is_space(line[at])) ++at;
    const std::size_t first = at;
    while (at < line.size() && !is_space(line[at])) ++at;
    if (at > first) words.push_back(line.substr(first, at - first));
  }
  return words;
}

NumberType type_from(std::string_view name, const TextCursor& text) {
  for (const auto& known : ply_type_names) {
    if (known.name == name) return known.type;
  }
  text.fail(in_quotes(name) + " is no type of a PLY file");
}

Encoding encoding_from(const std::vector<std::string_view>& words, const TextCursor& text) {
  const auto name = words.size() > 1 ? words[1] : std::string_view();
  if (name == "ascii") return Encoding::text;
  if (name == "binary_little_endian") return Encoding::little;
  if (name == "binary_big_endian") return Encoding::big;
  text.fail(in_quotes(name) + " is no format of a PLY file");
}

/// Names go into messages as they are: one that could not is refused.
std::string name_from(std::string_view word, const TextCursor& text) {
  if (in_quotes(word) != fmt::format("'{}'", word)) text.fail(in_quotes(word) + " is no name");
  return std::string(word);
}

Element element_from(const std::vector<std::string_view>& words, const TextCursor& text) {
  std::uint64_t count = 0;
  if (words.size() != 3) text.fail("an element needs a name and a count");
  if (!parse_number(words[2], count))
    text.fail(in_quotes(words[2]) + " should be the count of elements " + in_quotes(words[1]));
  return {name_from(words[1], text), count, {}};
}

Property property_from(const std::vector<std::string_view>& words, const TextCursor& text) {
  if (words.size() == 3) return {name_from(words[2], text), type_from(words[1], text), std::nullopt};
  if (words.size() != 5 || words[1] != "list") text.fail("a property needs a type and a name");
  const NumberType count_type = type_from(words[2], text);
  if (is_floating(count_type)) text.fail("the length of a list should be of an integer type");
  return {name_from(words[4], text), type_from(words[3], text), count_type};
}

Header read_header(const Source& source) {
  Header header;
  TextCursor text(source);
  if (text.rest_of_line() != "ply") text.fail("should be 'ply'");
  bool format_seen = false;
  while (true) {
    if (text.at_end()) source.fail("header: the file ends before 'end_header'");
    const auto words = ply_words(text.rest_of_line());
    if (words.empty() || words[0] == "comment" || words[0] == "obj_info") continue;
    if (words[0] == "end_header") break;
    if (words[0] == "format") {
      header.encoding = encoding_from(words, text);
      format_seen = true;
    } else if (words[0] == "element") {
      header.elements.push_back(element_from(words, text));
    } else if (words[0] == "property") {
      if (header.elements.empty()) text.fail("a property before the first element");
      header.elements.back().properties.push_back(property_from(words, text));
    } else {
      text.fail(in_quotes(words[0]) + " is no keyword of a PLY header");
    }
  }
  if (!format_seen) source.fail("header: no 'format'");
  header.size = text.offset();
  return header;
}

/// Gives the values of the data one by one, whichever way they are encoded.
class Values {
 public:
  Values(const Source& source, const Header& header)
      : source_(source),
        encoding_(header.encoding),
        text_(source, header.size),
        bytes_(source, header.size) {}

  /// Coordinates as doubles: a value declared float is rounded to float first, as it would be in a binary
  /// file.
  double coordinate(NumberType type, std::string_view element, std::uint64_t number) {
    return with_number_type(
        type, [&](auto zero) { return static_cast<double>(next<decltype(zero)>(element, number)); });
  }
  std::int64_t integer(NumberType type, std::string_view element, std::uint64_t number) {
    return with_number_type(
        type, [&](auto zero) { return static_cast<std::int64_t>(next<decltype(zero)>(element, number)); });
  }
  void skip(NumberType type, std::string_view element, std::uint64_t number) {
    with_number_type(type, [&](auto zero) { next<decltype(zero)>(element, number); });
  }
  /// Whether so many values of so many bytes can follow. A value of text takes two bytes, its own and a
  /// space; the last one in the file may lack the space.
  bool can_hold(std::uint64_t count, std::size_t bytes_each, std::size_t values_each) const {
    if (encoding_ != Encoding::text) return bytes_each == 0 || bytes_.has(count, bytes_each);
    return values_each == 0 || count <= (text_.remaining() + 1) / 2 / values_each;
  }
  /// Bytes left over, white space aside.
  std::size_t left_over() const {
    auto rest = source_.bytes.substr(encoding_ == Encoding::text ? text_.offset() : bytes_.offset());
    while (!rest.empty() && is_space(rest.back())) rest.remove_suffix(1);
    return rest.size();
  }

 private:
  template <class T>
  T next(std::string_view element, std::uint64_t number) {
    if (encoding_ == Encoding::text) return next_in_text<T>(element, number);
    if (!bytes_.has(1, sizeof(T)))
      source_.fail(fmt::format("{} {}: the file ends within it", element, number));
    return bytes_.value<T>(encoding_ == Encoding::little ? std::endian::little : std::endian::big);
  }

  template <class T>
  T next_in_text(std::string_view element, std::uint64_t number) {
    if constexpr (sizeof(T) > 1) {
      return text_.number<T>("a number of its declared type");
    } else {  // from_chars takes a type of one byte for a letter
      const auto value = text_.number<int>("a number of its declared type");
      if (!std::in_range<T>(value)) text_.fail(fmt::format("{} is no char: {} {}", value, element, number));
      return static_cast<T>(value);
    }
  }

  Source source_;
  Encoding encoding_;
  TextCursor text_;
  ByteCursor bytes_;
};

/// A count in a header is believed only as far as the file has bytes for it.
void check_count(const Source& source, const Element& element, const Values& values) {
  std::size_t bytes = 0;
  for (const auto& property : element.properties)
    bytes += bytes_of(property.count_type.value_or(property.type));
  if (!values.can_hold(element.count, bytes, element.properties.size())) {
    source.fail(fmt::format("header: {} elements {} announced, more than the rest of the file can hold",
                            element.count, in_quotes(element.name)));
  }
}

/// Length of the list that follows.
std::uint64_t list_length(const Property& list, const Element& element, std::uint64_t number, Values& values,
                          const Source& source) {
  const auto length = values.integer(*list.count_type, element.name, number);
  if (length < 0 || !values.can_hold(static_cast<std::uint64_t>(length), bytes_of(list.type), 1)) {
    source.fail(
        fmt::format("{} {}: a list of {} values does not fit the file", element.name, number, length));
  }
  return static_cast<std::uint64_t>(length);
}

void skip_property(const Property& property, const Element& element, std::uint64_t number, Values& values,
                   const Source& source) {
  const auto count = property.count_type ? list_length(property, element, number, values, source) : 1;
  for (std::uint64_t i = 0; i < count; ++i) values.skip(property.type, element.name, number);
}

void skip_element(const Element& element, Values& values, const Source& source) {
  if (element.properties.empty()) return;
  for (std::uint64_t i = 0; i < element.count; ++i) {
    for (const auto& property : element.properties) skip_property(property, element, i, values, source);
  }
}

Points read_vertices(const Element& element, Values& values, const Source& source) {
  std::array<bool, 3> found = {};
  std::vector<std::size_t> axis;  // by property; 3 is none
  for (const auto& property : element.properties) {
    const std::string_view name = property.name;
    axis.push_back(name == "x" ? 0 : name == "y" ? 1 : name == "z" ? 2 : 3);
    if (axis.back() == 3) continue;
    if (property.count_type || !is_floating(property.type)) {
      source.fail(fmt::format("header: vertex property '{}' should be a float or a double", name));
    }
    if (std::exchange(found[axis.back()], true))
      source.fail(fmt::format("header: vertex property '{}' twice", name));
  }
  if (found != std::array{true, true, true}) source.fail("header: a vertex needs the properties x, y and z");

  Points points;
  points.reserve(element.count);
  for (std::uint64_t i = 0; i < element.count; ++i) {
    Vec3 p;
    for (std::size_t k = 0; k < element.properties.size(); ++k) {
      const auto& property = element.properties[k];
      if (axis[k] < 3) {
        p[static_cast<Eigen::Index>(axis[k])] = values.coordinate(property.type, element.name, i);
      } else {
        skip_property(property, element, i, values, source);
      }
    }
    points.push_back(p);
  }
  return points;
}

bool is_corner_list(const Property& property) {
  return property.name == "vertex_indices" || property.name == "vertex_index";
}

void read_faces(const Element& element, Values& values, RawMesh& raw, const Source& source) {
  const auto lists = std::count_if(element.properties.begin(), element.properties.end(), is_corner_list);
  if (lists != 1) source.fail("header: a face needs one property 'vertex_indices'");
  raw.triangles.reserve(element.count);
  std::vector<std::int64_t> corners;
  for (std::uint64_t i = 0; i < element.count; ++i) {
    for (const auto& property : element.properties) {
      if (!is_corner_list(property)) {
        skip_property(property, element, i, values, source);
        continue;
      }
      if (!property.count_type || is_floating(property.type)) {
        source.fail(fmt::format("header: face property '{}' should be a list of integers", property.name));
      }
      const auto count = list_length(property, element, i, values, source);
      if (count < 3 || (count > 3 && source.polygons == PolygonRule::refuse))
        source.fail(refused_face("face", i, count));
      corners.clear();
      for (std::uint64_t k = 0; k < count; ++k)
        corners.push_back(values.integer(property.type, element.name, i));
      append_face(raw, corners, source.polygons);
    }
  }
}

/// Strips of triangles, one list or several; -1, or the largest number of an unsigned type, begins a new strip.
void read_strips(const Element& element, Values& values, RawMesh& raw, const Source& source) {
  const auto lists = std::count_if(element.properties.begin(), element.properties.end(), is_corner_list);
  if (lists != 1) source.fail("header: triangle strips need one property 'vertex_indices'");
  const auto vertices = static_cast<std::int64_t>(raw.vertices.size());
  std::vector<std::int64_t> corners;
  for (std::uint64_t i = 0; i < element.count; ++i) {
    for (const auto& property : element.properties) {
      if (!is_corner_list(property)) {
        skip_property(property, element, i, values, source);
        continue;
      }
      if (!property.count_type || is_floating(property.type))
        source.fail(
            fmt::format("header: property '{}' of strips should be a list of integers", property.name));
      const std::int64_t restart = largest_unsigned(property.type);
      const auto count = list_length(property, element, i, values, source);
      corners.clear();
      for (std::uint64_t k = 0; k <= count; ++k) {
        const std::int64_t corner = k < count ? values.integer(property.type, element.name, i) : -1;
        const bool begins_new = corner == -1 || (corner == restart && corner >= vertices);
        if (!begins_new) {
          corners.push_back(corner);
          continue;
        }
        if (corners.size() == 1 || corners.size() == 2)
          source.fail(fmt::format("{} {}: a triangle strip has {} corners: it needs 3", element.name, i,
                                  corners.size()));
        append_strip(raw, corners);
        corners.clear();
      }
    }
  }
}

}  // namespace

/// Elements "vertex" (x, y, z), "face" and "tristrips" (vertex_indices or vertex_index); all others, and all other
/// properties, are passed over.
RawMesh read_ply(const Source& source) {
  const Header header = read_header(source);
  Values values(source, header);
  RawMesh raw;
  bool has_vertices = false, has_faces = false;
  for (const auto& element : header.elements) {
    check_count(source, element, values);
    if (element.name == "vertex") {
      if (std::exchange(has_vertices, true)) source.fail("header: element 'vertex' twice");
      raw.vertices = read_vertices(element, values, source);
    } else if (element.name == "face") {
      if (std::exchange(has_faces, true)) source.fail("header: element 'face' twice");
      read_faces(element, values, raw, source);
    } else if (element.name == "tristrips") {
      read_strips(element, values, raw, source);
    } else {
      skip_element(element, values, source);
    }
  }
  if (values.left_over() > 0) source.fail(fmt::format("{} bytes after the last element", values.left_over()));
  return raw;
}

}  // namespace condyle::io
