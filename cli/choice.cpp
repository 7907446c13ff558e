#include "choice.hpp"

#include <CLI/CLI.hpp>
#include <algorithm>

namespace condyle::cli {

CLI::Option* add_words(CLI::App& command, const std::string& name, const std::vector<std::string>& words,
                       std::function<void(std::size_t)> choose, const std::string& help,
                       const std::string& otherwise) {
  std::string text;
  for (const std::string& word : words) text += (text.empty() ? "" : "|") + word;
  if (!otherwise.empty()) text += " (" + otherwise + ")";
  return command
      .add_option_function<std::string>(
          name,
          [words, choose = std::move(choose)](const std::string& word) {
            choose(static_cast<std::size_t>(std::find(words.begin(), words.end(), word) - words.begin()));
          },
          help)
      ->check(CLI::IsMember(words))
      ->option_text(text);
}

}  // namespace condyle::cli
