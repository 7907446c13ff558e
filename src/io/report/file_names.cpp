#include "io/report/file_names.hpp"

#include <algorithm>
#include <array>
#include <string>
#include <string_view>

namespace condyle::io {
namespace {

constexpr std::array<std::string_view, 4> with_text = {"--title", "--case", "--note", "--date"};

bool is_text_option(std::string_view word) {
  return std::find(with_text.begin(), with_text.end(), word.substr(0, word.find('='))) != with_text.end();
}

/// "--out=folder/hip.html" becomes "--out=hip.html".
std::string without_folders(const std::string& word) {
  const std::size_t last = word.find_last_of("/\\");
  if (last == word.npos) return word;
  const std::size_t equals = word.find('=');
  const std::size_t head = word.starts_with("--") && equals < last ? equals + 1 : 0;
  return word.substr(0, head) + word.substr(last + 1);
}

void shorten_command(Json& command) {
  bool is_text = false;
  for (Json& word : command) {
    const std::string said = word.get<std::string>();
    if (!is_text && !is_text_option(said)) word = without_folders(said);
    is_text = is_text_option(said) && said.find('=') == said.npos;
  }
}

}  // namespace

void name_files_only(Json& provenance) {
  if (provenance.is_array())
    for (Json& item : provenance) name_files_only(item);
  if (!provenance.is_object()) return;
  for (auto& [key, value] : provenance.items()) {
    if (key == "command" && value.is_array())
      shorten_command(value);
    else if (key == "path" && value.is_string())
      value = without_folders(value.get<std::string>());
    else
      name_files_only(value);
  }
}

}  // namespace condyle::io
