#include "io/result/text_table.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstddef>

namespace condyle::io {
namespace {

/// Characters of well-formed UTF-8: what a terminal shows, for the usual scripts.
std::size_t shown_width(std::string_view text) noexcept {
  return static_cast<std::size_t>(
      std::count_if(text.begin(), text.end(), [](unsigned char c) { return (c & 0xC0) != 0x80; }));
}

}  // namespace

std::string wrapped(std::string_view lines) {
  constexpr std::size_t width = 100;
  std::string text;
  for (std::size_t end = 0; !lines.empty(); lines.remove_prefix(std::min(end + 1, lines.size()))) {
    end = lines.find('\n');
    std::string_view line = lines.substr(0, end);
    if (end == lines.npos) end = lines.size();
    const std::size_t indent = std::min(line.find_first_not_of(' '), line.size());
    std::size_t column = 0;
    for (std::string_view blanks; !line.empty();) {
      const std::size_t begin = std::min(line.find_first_not_of(' '), line.size());
      blanks = line.substr(0, begin), line.remove_prefix(begin);
      const std::string_view word = line.substr(0, line.find(' '));
      if (column > indent && column + begin + shown_width(word) > width) {
        text += "\n" + std::string(indent + 2, ' ');
        column = indent + 2;
      } else {
        text += blanks, column += begin;
      }
      text += word, column += shown_width(word);
      line.remove_prefix(word.size());
    }
    text += "\n";
  }
  return text;
}

std::string table_text(std::span<const TextColumn> columns) {
  std::string text;
  for (std::size_t row = 0; row < columns.front().cells.size(); ++row) {
    std::string line = " ";
    for (const TextColumn& column : columns) {
      std::size_t widest = 0;
      for (const std::string& cell : column.cells) widest = std::max(widest, shown_width(cell));
      const std::string& cell = column.cells[row];
      const std::string blanks(widest - shown_width(cell), ' ');
      line += fmt::format(" {} ", column.align == Align::left ? cell + blanks : blanks + cell);
    }
    text += line.substr(0, line.find_last_not_of(' ') + 1) + "\n";
  }
  return text;
}

}  // namespace condyle::io
