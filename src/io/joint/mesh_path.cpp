#include "io/joint/mesh_path.hpp"

#include <fmt/format.h>

#include <optional>
#include <string>

#include "io/file/environment.hpp"
#include "io/file/in_quotes.hpp"

namespace condyle::io {

std::filesystem::path mesh_path(const TomlTable& table, std::string_view key, std::string_view text) {
  std::string out;
  for (std::size_t at = 0; at < text.size();) {
    const std::size_t begin = text.find("${", at);
    out += text.substr(at, begin == text.npos ? begin : begin - at);
    if (begin == text.npos) break;
    const std::size_t end = text.find('}', begin);
    if (end == text.npos) table.fail(key, "has ${ without }");
    const std::string name(text.substr(begin + 2, end - begin - 2));
    const std::optional<std::string> value = environment_variable(name);
    if (!value) table.fail(key, fmt::format("the environment variable {} is not set", in_quotes(name)));
    out += *value;
    at = end + 1;
  }
  if (out.empty()) table.fail(key, "must name a file");
  return out;
}

}  // namespace condyle::io
