#include "io/mesh/vertex_marks.hpp"

#include <fmt/format.h>

#include "io/file/in_quotes.hpp"
#include "io/file/whole_file.hpp"
#include "io/mesh/parse.hpp"

namespace condyle::io {

std::vector<std::uint8_t> read_vertex_marks(const std::filesystem::path& path, std::size_t vertices,
                                            const std::string& body) {
  const std::string text = read_whole_file(path), name = path.string();
  const Source source{text, name};
  TextCursor cursor(source);
  std::vector<std::uint8_t> marks;
  for (auto word = cursor.word(); !word.empty(); word = cursor.word()) {
    if (word != "0" && word != "1")
      source.fail(fmt::format("line {}: {} is no mark: 1 to keep a vertex, 0 if it may go", cursor.line(),
                              in_quotes(word)));
    marks.push_back(word == "1");
  }
  if (marks.size() != vertices)
    source.fail(fmt::format("{} marks for the {} vertices of {}", marks.size(), vertices, body));
  return marks;
}

}  // namespace condyle::io
