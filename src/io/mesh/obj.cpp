#include <algorithm>
#include <cstdint>
#include <iterator>
#include <string>

#include "io/mesh/parse.hpp"

namespace condyle::io {
namespace {

/// Statements that neither make nor move a polygon: texture, normals, names, materials, lines, points,
/// display. Free-form curves and surfaces are not among them, and a misspelt "v" is not taken for a remark.
bool moves_no_vertex(std::string_view keyword) {
  constexpr std::string_view harmless[] = {"vt",       "vn",       "vp",         "g",        "o",
                                           "s",        "mg",       "l",          "p",        "mtllib",
                                           "usemtl",   "usemap",   "maplib",     "lod",      "bevel",
                                           "c_interp", "d_interp", "shadow_obj", "trace_obj"};
  return std::find(std::begin(harmless), std::end(harmless), keyword) != std::end(harmless);
}

/// Statements whose last word is a name, which may end with a backslash, as a folder of Windows does.
bool ends_with_name(std::string_view keyword) {
  constexpr std::string_view naming[] = {"g",      "o",      "mtllib",     "usemtl",
                                         "usemap", "maplib", "shadow_obj", "trace_obj"};
  return keyword.starts_with('#') ||
         std::find(std::begin(naming), std::end(naming), keyword) != std::end(naming);
}

/// Cuts the backslash off that continues a line on the next; false if there is none.
bool cut_backslash(std::string_view& line) {
  while (!line.empty() && is_space(line.back())) line.remove_suffix(1);
  if (!line.ends_with('\\')) return false;
  line.remove_suffix(1);
  return true;
}

/// The words of one line, in turn.
class Words {
 public:
  explicit Words(std::string_view line) : rest_(line) {}

  std::string_view next() {
    while (!rest_.empty() && is_space(rest_.front())) rest_.remove_prefix(1);
    std::size_t length = 0;
    while (length < rest_.size() && !is_space(rest_[length])) ++length;
    const auto word = rest_.substr(0, length);
    rest_.remove_prefix(length);
    return word;
  }

 private:
  std::string_view rest_;
};

Vec3 vertex_from(Words& words, const TextCursor& text) {
  Vec3 p;
  for (double& coordinate : p) {
    const auto word = words.next();
    if (word.empty()) text.fail("a vertex needs three coordinates");
    if (!parse_number(word, coordinate)) text.fail(in_quotes(word) + " should be a coordinate");
  }
  return p;  // a fourth number is a weight, three more a colour: neither moves the vertex
}

/// Vertex number of a face's corner, from "7", "7/2", "7//3" or "7/2/3"; -1 is the last vertex so far. From
/// 0.
std::int64_t corner_from(std::string_view word, std::size_t vertices_so_far, const TextCursor& text) {
  std::int64_t number = 0;
  if (!parse_number(word.substr(0, word.find('/')), number) || number == 0) {
    text.fail(in_quotes(word) + " should be a vertex number, from 1 or, counted back, from -1");
  }
  if (number > 0) return number - 1;
  const auto so_far = static_cast<std::int64_t>(vertices_so_far);
  if (number < -so_far)
    text.fail(fmt::format("face uses vertex {} after {} vertices", number, vertices_so_far));
  return so_far + number;
}

/// The next line, with those on which a backslash at its end continues it. `whole` holds it then.
std::string_view next_statement(TextCursor& text, std::string& whole) {
  std::string_view line = text.rest_of_line();
  if (ends_with_name(Words(line).next()) || line.find('#') != line.npos) return line;
  std::string_view part = line;
  if (!cut_backslash(part)) return line;
  whole.clear();
  for (bool goes_on = true; goes_on;) {
    whole.append(part).append(1, ' ');
    if (text.at_end()) break;
    part = text.rest_of_line();
    goes_on = cut_backslash(part);
    if (!goes_on) whole.append(part);
  }
  return whole;
}

}  // namespace

/// Vertices and faces; texture, normals, groups, materials, lines and points are passed over.
RawMesh read_obj(const Source& source) {
  RawMesh raw;
  std::vector<std::size_t> line_of;  // by triangle: a face may come before its vertices
  std::vector<std::int64_t> corners;
  std::string whole;
  TextCursor text(source);
  while (!text.at_end()) {
    const std::size_t line = text.line();
    Words words(next_statement(text, whole));
    const auto keyword = words.next();
    if (keyword == "v") {
      raw.vertices.push_back(vertex_from(words, text));
    } else if (keyword == "f") {
      corners.clear();
      for (auto word = words.next(); !word.empty() && !word.starts_with('#'); word = words.next())
        corners.push_back(corner_from(word, raw.vertices.size(), text));
      const std::size_t triangles = raw.triangles.size();
      if (!append_face(raw, corners, source.polygons))
        text.fail(refused_face("face", triangles + raw.polygons.size(), corners.size()));
      if (raw.triangles.size() > triangles) line_of.push_back(line);
    } else if (!keyword.empty() && !keyword.starts_with('#') && !moves_no_vertex(keyword)) {
      text.fail(in_quotes(keyword) + " is no OBJ statement that is read");
    }
  }
  const auto count = static_cast<std::int64_t>(raw.vertices.size());
  for (std::size_t t = 0; t < raw.triangles.size(); ++t) {
    for (const auto corner : raw.triangles[t]) {
      if (corner >= count)
        source.fail(fmt::format("line {}: face uses vertex {} of {}", line_of[t], corner + 1, count));
    }
  }
  return raw;
}

}  // namespace condyle::io
