#include "io/image/nrrd_header.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "io/file/words.hpp"
#include "io/mesh/parse.hpp"

namespace condyle::io {
namespace {

/// Every field of the format; those in pairs are two spellings of one.
bool is_field(std::string_view name) {
  constexpr std::array<std::string_view, 36> names = {
      "dimension",  "type",         "block size",  "blocksize", "encoding",
      "endian",     "content",      "old min",     "oldmin",    "old max",
      "oldmax",     "min",          "max",         "data file", "datafile",
      "line skip",  "lineskip",     "byte skip",   "byteskip",  "number",
      "sizes",      "sample units", "sampleunits", "spacings",  "thicknesses",
      "axis mins",  "axismins",     "axis maxs",   "axismaxs",  "centers",
      "centerings", "labels",       "units",       "kinds",     "measurement frame",
      "space"};
  constexpr std::array<std::string_view, 4> of_space = {"space dimension", "space units", "space origin",
                                                        "space directions"};
  return std::find(names.begin(), names.end(), name) != names.end() ||
         std::find(of_space.begin(), of_space.end(), name) != of_space.end();
}

std::string one_spelling(std::string name) {
  if (name == "datafile") return "data file";
  if (name == "lineskip") return "line skip";
  if (name == "byteskip") return "byte skip";
  return name;
}

/// Undoes "\n" and "\\" of a value.
std::string unescaped(std::string_view text) {
  std::string out;
  for (std::size_t i = 0; i < text.size(); ++i) {
    const bool is_escape =
        text[i] == '\\' && i + 1 < text.size() && (text[i + 1] == 'n' || text[i + 1] == '\\');
    if (is_escape) ++i;
    out += is_escape && text[i] == 'n' ? '\n' : text[i];
  }
  return out;
}

void check_magic(const std::optional<std::string>& line, const ByteSource& source) {
  if (!line || !line->starts_with("NRRD")) source.fail("does not begin with 'NRRD000': no NRRD file");
  const std::string_view version = std::string_view(*line).substr(4);
  if (version.size() != 4 || !version.starts_with("000") || version[3] < '1' || version[3] > '5')
    source.fail(fmt::format("{}: versions 1 to 5 of NRRD are read", in_quotes(*line)));
}

}  // namespace

NrrdHeader read_nrrd_header(const ByteSource& source) {
  NrrdHeader header{HeaderFields(source), {}, 0};
  HeaderLines lines(source);
  check_magic(lines.next(), source);
  while (const auto line = lines.next()) {
    if (line->empty()) break;
    if (line->starts_with('#')) continue;
    const auto colon = line->find(": ");
    const auto field = io::lower_case(line->substr(0, std::min(colon, line->size())));
    // A value may hold ": ", a key too: only what is a field is one.
    if (colon != std::string::npos && is_field(field)) {
      if (!header.fields.add(one_spelling(field), std::string(trimmed(line->substr(colon + 2)))))
        lines.fail(fmt::format("the field {} is given twice", in_quotes(field)));
      if (field == "data file" || field == "datafile") {
        const auto file = trimmed(std::string_view(*line).substr(colon + 2));
        if (file.starts_with("LIST")) break;  // names follow; the reader refuses them
      }
      continue;
    }
    const auto pair = line->find(":=");
    if (pair == std::string::npos) lines.fail(fmt::format("{} is no field of NRRD", in_quotes(*line)));
    if (!header.pairs.emplace(unescaped(line->substr(0, pair)), unescaped(line->substr(pair + 2))).second)
      lines.fail(fmt::format("the key {} is given twice", in_quotes(line->substr(0, pair))));
  }
  header.data_offset = lines.offset();
  return header;
}

std::optional<std::array<double, 3>> next_vector(const HeaderFields& fields, const std::string& key,
                                                 std::string_view& text) {
  text = trimmed(text);
  if (text.starts_with("none")) {
    text.remove_prefix(4);
    return std::nullopt;
  }
  const auto end = text.find(')');
  if (!text.starts_with('(') || end == std::string_view::npos)
    fields.fail(key, fmt::format("{} is no vector", in_quotes(text)));
  auto inside = text.substr(1, end - 1);
  text.remove_prefix(end + 1);
  std::array<double, 3> vector{};
  for (std::size_t i = 0; i < vector.size(); ++i) {
    const auto comma = inside.find(',');
    if ((comma == std::string_view::npos) != (i + 1 == vector.size()))
      fields.fail(key, "a vector has another number of components than 3");
    const auto word = trimmed(inside.substr(0, comma));
    if (!parse_number(word, vector[i])) fields.fail(key, fmt::format("{} is no number", in_quotes(word)));
    if (comma != std::string_view::npos) inside.remove_prefix(comma + 1);
  }
  return vector;
}

}  // namespace condyle::io
