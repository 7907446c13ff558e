#pragma once

#include <CLI/App.hpp>
#include <CLI/Config.hpp>
#include <CLI/Formatter.hpp>
#include <functional>
#include <initializer_list>
#include <optional>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

/// Options that take a value or one of some words, and flags that stand for a value.

namespace condyle::cli {

/// Adds an option with a value, which its help calls `value`.
template <class Target>
CLI::Option* add_value(CLI::App& command, const std::string& name, Target& target, const std::string& value,
                       const std::string& help) {
  return command.add_option(name, target, help)->option_text(value);
}

/// Adds a flag that writes `value` to `target` while arguments are read.
template <class Target>
CLI::Option* add_flag(CLI::App& command, const std::string& name, Target& target,
                      std::type_identity_t<Target> value, const std::string& help) {
  return command.add_flag_callback(
      name, [&target, value] { target = value; }, help);
}

/// Adds the option `name`, which takes one of the words and calls `choose` with its place. Its help ends with the words and, in
/// parentheses, what it is by default, if that is given.
CLI::Option* add_words(CLI::App& command, const std::string& name, const std::vector<std::string>& words,
                       std::function<void(std::size_t)> choose, const std::string& help,
                       const std::string& otherwise);

template <class T>
struct Chosen {
  using Value = T;
};
template <class T>
struct Chosen<std::optional<T>> {
  using Value = T;
};

/// The same for words that stand for values, of which one is written to `target` while arguments are read.
template <class Target>
CLI::Option* add_choice(CLI::App& command, const std::string& name, Target& target,
                        std::initializer_list<std::pair<const char*, typename Chosen<Target>::Value>> choices,
                        const std::string& help, const std::string& otherwise = "") {
  std::vector<std::string> words;
  std::vector<typename Chosen<Target>::Value> values;
  for (const auto& choice : choices) words.emplace_back(choice.first), values.push_back(choice.second);
  return add_words(
      command, name, words, [&target, values](std::size_t place) { target = values[place]; }, help,
      otherwise);
}

}  // namespace condyle::cli
