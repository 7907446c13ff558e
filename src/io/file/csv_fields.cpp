#include "io/file/csv_fields.hpp"
#include "io/file/words.hpp"

#include <fmt/format.h>

#include "io/file/words.hpp"
#include "io/motion/table_builder.hpp"

namespace condyle::io {

std::vector<std::string> csv_fields(std::string_view line, std::size_t number, const Source& source) {
  std::vector<std::string> fields(1);
  bool in_quotes = false;
  for (std::size_t at = 0; at < line.size(); ++at) {
    const char c = line[at];
    if (c == '"' && in_quotes && line.substr(at + 1).starts_with('"'))
      fields.back() += line[++at];
    else if (c == '"')
      in_quotes = !in_quotes;
    else if (c == ',' && !in_quotes)
      fields.emplace_back();
    else
      fields.back() += c;
  }
  if (in_quotes) source.fail(fmt::format("line {}: a quote is not closed", number));
  for (std::string& field : fields) field = trimmed(field);
  return fields;
}

}  // namespace condyle::io
