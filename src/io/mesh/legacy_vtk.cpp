#include <algorithm>
#include <bit>
#include <cstdint>
#include <limits>
#include <type_traits>
#include <utility>

#include "io/mesh/parse.hpp"
#include "io/mesh/vtk_array.hpp"

namespace condyle::io {
namespace {

struct LegacyTypeName {
  std::string_view name;
  NumberType type;
};
// vtkIdType stands for int in files, whatever it is in memory. "long" has the size it had where it was
// written: not read.
constexpr LegacyTypeName legacy_type_names[] = {
    {"char", NumberType::i8},          {"unsigned_char", NumberType::u8},
    {"short", NumberType::i16},        {"unsigned_short", NumberType::u16},
    {"int", NumberType::i32},          {"unsigned_int", NumberType::u32},
    {"vtktypeint64", NumberType::i64}, {"vtktypeuint64", NumberType::u64},
    {"vtkidtype", NumberType::i32},    {"float", NumberType::f32},
    {"double", NumberType::f64}};

/// From this version on, cells are given by offsets and corners, before by length and corners in turn.
constexpr double first_version_with_offsets = 5;

/// Header and sections of a legacy file: lines of text, between them numbers as text or as big-endian bytes.
class Reader {
 public:
  Reader(const Source& source, std::endian order) : source_(source), text_(source), order_(order) {}

  RawMesh read() {
    read_header();
    RawMesh raw;
    while (true) {
      const auto word = text_.word();
      const auto section = io::lower_case(word);
      // The geometry comes first: what follows belongs to the arrays.
      if (section.empty() || section == "cell_data" || section == "point_data") return raw;
      if (section == "points") {
        raw.vertices = read_points();
      } else if (section == "polygons") {
        const Cells cells = read_cells("polygons");
        check_ends(cells.ends, source_);
        append_cells(raw, cells.corners, cells.ends, source_);
      } else if (section == "vertices" || section == "lines") {
        read_cells(section);  // they bound nothing
      } else if (section == "triangle_strips") {
        const Cells cells = read_cells(section);
        append_strips(raw, cells.corners, cells.ends, source_);
      } else if (section == "field") {
        skip_field();
      } else if (section == "metadata") {
        skip_metadata();
      } else {
        text_.fail(in_quotes(word) + " is no section of a PolyData file");
      }
    }
  }

 private:
  /// Corners of all cells in one row, and where in it each cell ends.
  struct Cells {
    std::vector<std::int64_t> corners, ends;
  };

  void read_header() {
    const auto first = text_.rest_of_line();
    if (!first.starts_with("# vtk DataFile Version ")) text_.fail("should be '# vtk DataFile Version ...'");
    double version = 0;
    const auto number = first.substr(first.rfind(' ') + 1);
    if (!parse_number(number, version))
      text_.fail(in_quotes(number) + " should be the version of the format");
    has_offsets_ = version >= first_version_with_offsets;
    text_.rest_of_line();  // the title
    const auto encoding = text_.word();
    is_text_ = io::lower_case(encoding) == "ascii";
    if (!is_text_ && io::lower_case(encoding) != "binary")
      text_.fail(in_quotes(encoding) + " should be 'ASCII' or 'BINARY'");
    text_.expect("DATASET");
    const auto kind = text_.word();
    if (io::lower_case(kind) != "polydata")
      text_.fail("holds " + in_quotes(kind) + ": only 'POLYDATA' is read");
  }

  Points read_points() {
    const auto count = text_.number<std::uint64_t>("the number of points");
    const NumberType type = read_type();
    if (!is_floating(type)) text_.fail("points should be float or double");
    if (count > largest_count / 3) source_.fail("points: announces more than any file can hold");
    const auto xyz = numbers<double>(type, 3 * count, "points");
    Points points;
    points.reserve(xyz.size() / 3);
    for (std::size_t i = 0; i < xyz.size(); i += 3) points.push_back({xyz[i], xyz[i + 1], xyz[i + 2]});
    return points;
  }

  Cells read_cells(std::string_view section) {
    const auto first = text_.number<std::uint64_t>("a number of cells");
    const auto second = text_.number<std::uint64_t>("a size of the cells");
    return has_offsets_ ? cells_by_offsets(first, second, section) : cells_by_length(first, second, section);
  }

  Cells cells_by_offsets(std::uint64_t offsets, std::uint64_t corners, std::string_view section) {
    Cells cells;
    if (offsets == 0) return cells;
    text_.expect("OFFSETS");
    cells.ends = numbers<std::int64_t>(read_type(), offsets, section);
    text_.expect("CONNECTIVITY");
    cells.corners = numbers<std::int64_t>(read_type(), corners, section);
    if (cells.ends.front() != 0) source_.fail(fmt::format("{}: the first offset should be 0", section));
    cells.ends.erase(cells.ends.begin());
    return cells;
  }

  Cells cells_by_length(std::uint64_t count, std::uint64_t size, std::string_view section) {
    const auto row = numbers<std::int64_t>(NumberType::i32, size, section);
    if (count > row.size()) source_.fail(fmt::format("{}: {} cells in {} numbers", section, count, size));
    Cells cells;
    std::size_t at = 0;
    for (std::uint64_t i = 0; i < count; ++i) {
      if (at == row.size() || row[at] < 0 || std::cmp_greater(row[at], row.size() - at - 1)) {
        source_.fail(fmt::format("{}: cell {} goes beyond the {} numbers of all", section, i, size));
      }
      const auto first = row.begin() + static_cast<std::ptrdiff_t>(at) + 1;
      cells.corners.insert(cells.corners.end(), first, first + row[at]);
      cells.ends.push_back(static_cast<std::int64_t>(cells.corners.size()));
      at += 1 + static_cast<std::size_t>(row[at]);
    }
    return cells;
  }

  void skip_field() {
    text_.word();  // its name
    const auto arrays = text_.number<std::uint64_t>("a number of arrays");
    for (std::uint64_t i = 0; i < arrays; ++i) {
      while (io::lower_case(text_.word()) == "metadata") skip_metadata();
      const auto components = text_.number<std::uint64_t>("a number of components");
      const auto tuples = text_.number<std::uint64_t>("a number of tuples");
      if (components > 0 && tuples > largest_count / components)
        source_.fail("field: announces more than any file can hold");
      skip_array(components * tuples);
    }
  }

  /// Whatever an array of the field data holds: numbers, texts, bits.
  void skip_array(std::uint64_t count) {
    const auto word = text_.word();
    const auto name = io::lower_case(word);
    if (name == "string" || name == "utf8_string") return skip_texts(count);
    if (name == "bit") {
      if (is_text_)
        numbers<double>(NumberType::u8, count, "field");
      else
        numbers<double>(NumberType::u8, count / 8 + (count % 8 > 0 ? 1 : 0), "field");
      return;
    }
    numbers<double>(type_of(word), count, "field");
  }

  /// Texts, as 3D Slicer puts its coordinate system here: one in a line, or each with its length before it.
  void skip_texts(std::uint64_t count) {
    text_.rest_of_line();
    if (count > text_.remaining() + 1)
      source_.fail(fmt::format("field: {} texts announced, the file ends before", count));
    for (std::uint64_t i = 0; i < count; ++i) {
      if (is_text_) {
        if (text_.at_end()) source_.fail(fmt::format("field: the file ends before text {} of {}", i, count));
        text_.rest_of_line();
        continue;
      }
      const std::uint64_t length = length_of_text();
      if (length > text_.remaining()) source_.fail(fmt::format("field: the file ends within text {}", i));
      text_.take(static_cast<std::size_t>(length));
    }
  }

  /// The two highest bits of the first byte say how many bytes the length has: 3 one, 2 two, 1 four, 0 eight.
  std::uint64_t length_of_text() {
    if (text_.remaining() == 0) source_.fail("field: the file ends before a text");
    std::uint64_t length = static_cast<unsigned char>(text_.take(1).front());
    const std::size_t more = (std::size_t{1} << (3 - (length >> 6))) - 1;
    if (more > text_.remaining()) source_.fail("field: the file ends within the length of a text");
    length &= 0x3F;
    for (const char c : text_.take(more)) length = length << 8 | static_cast<unsigned char>(c);
    return length;
  }

  /// Up to the next empty line.
  void skip_metadata() {
    text_.rest_of_line();
    while (!text_.at_end() && !text_.rest_of_line().empty()) {
    }
  }

  NumberType read_type() { return type_of(text_.word()); }

  NumberType type_of(std::string_view word) {
    const auto name = io::lower_case(word);
    for (const auto& known : legacy_type_names) {
      if (known.name == name) return known.type;
    }
    text_.fail(in_quotes(word) + " is no type of numbers that is read");
  }

  /// So many numbers. No memory is allocated before the file is known to have the bytes.
  template <class Out>
  std::vector<Out> numbers(NumberType type, std::uint64_t count, std::string_view what) {
    return with_number_type(type, [&](auto zero) { return numbers_of<decltype(zero), Out>(count, what); });
  }

  template <class T, class Out>
  std::vector<Out> numbers_of(std::uint64_t count, std::string_view what) {
    if constexpr (std::is_floating_point_v<T> && std::is_integral_v<Out>) {
      text_.fail(fmt::format("{}: should be of an integer type", what));
    } else {
      if (!is_text_ && count > 0) text_.rest_of_line();
      const std::size_t most = is_text_ ? (text_.remaining() + 1) / 2 : text_.remaining() / sizeof(T);
      if (count > most)
        source_.fail(fmt::format("{}: {} numbers announced, the file ends before", what, count));
      std::vector<Out> values;
      values.reserve(count);
      if (is_text_) {
        using Parsed =
            std::conditional_t<sizeof(T) == 1, int, T>;  // from_chars takes a type of one byte for a letter
        for (std::uint64_t i = 0; i < count; ++i) values.push_back(as<Out>(text_.number<Parsed>("a number")));
      } else {
        ByteCursor bytes({text_.take(count * sizeof(T)), source_.name});
        for (std::uint64_t i = 0; i < count; ++i) values.push_back(as<Out>(bytes.value<T>(order_)));
      }
      return values;
    }
  }

  // No count times three, and no length of a row in bytes, overflows below this.
  static constexpr std::uint64_t largest_count = std::numeric_limits<std::uint64_t>::max() / 2;

  Source source_;
  TextCursor text_;
  std::endian order_;
  bool is_text_ = true, has_offsets_ = false;
};

/// Whether the numbers make sense from their lowest byte on.
bool is_little_endian(const Source& source) {
  try {
    const RawMesh raw = Reader({source.bytes, source.name, PolygonRule::split}, std::endian::little).read();
    const auto are_there = [&](const auto& corners) {
      return std::all_of(corners.begin(), corners.end(),
                         [&](std::int64_t v) { return v >= 0 && std::cmp_less(v, raw.vertices.size()); });
    };
    return raw.triangles.size() + raw.polygons.size() > 0 &&
           std::all_of(raw.triangles.begin(), raw.triangles.end(), are_there) &&
           std::all_of(raw.polygons.begin(), raw.polygons.end(),
                       [&](const RawMesh::Polygon& polygon) { return are_there(polygon.corners); });
  } catch (const FileError&) {
    return false;
  }
}

}  // namespace

/// Legacy PolyData, text and binary, both forms of cells. A binary file whose counts make sense only in the other order of bytes is
/// refused with that reason: its coordinates could look right. Arrays after the geometry are not read.
RawMesh read_legacy_vtk(const Source& source) {
  try {
    return Reader(source, std::endian::big).read();
  } catch (const FileError&) {
    if (!is_little_endian(source)) throw;
  }
  source.fail(
      "its binary numbers are little-endian, those of a legacy VTK file are big-endian: write it anew as "
      "text, or as .vtp");
}

}  // namespace condyle::io
