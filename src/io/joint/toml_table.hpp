#pragma once

#include <toml++/toml.h>

#include <array>
#include <filesystem>
#include <initializer_list>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "condyle/pose.hpp"

namespace condyle::io {

/// One table of a TOML file, read key by key with errors that name file, line and key. Every reader notes
/// its key; finish() then refuses keys that nobody read, so that a misspelt one is not silently left
/// out.
class TomlTable {
 public:
  /// `path` and `table` are borrowed. `name` is how keys of the table are introduced: "" or "frame".
  TomlTable(const std::filesystem::path& path, const toml::table& table, std::string name);

  bool has(std::string_view key) const;
  bool is_text(std::string_view key) const;

  /// Throws FileError "file: line 7: frame.centre: what is wrong"; the table's own line where the key is
  /// missing.
  [[noreturn]] void fail(std::string_view key, std::string_view what) const;
  /// A key that must be there is not; names one that was most likely meant to be it, and says what it is needed for.
  [[noreturn]] void fail_missing(std::string_view key, std::string_view needed_for = {}) const;

  /// The key's value, or nothing if it is not there. A wrong type fails.
  std::optional<std::string> text(std::string_view key);
  std::optional<double> number(std::string_view key);
  std::optional<long long> integer(std::string_view key);
  std::optional<bool> flag(std::string_view key);
  std::optional<std::array<double, 2>> pair(std::string_view key);
  std::optional<Vec3> triple(std::string_view key);
  /// A list of points, one or more, or one that is no list of its own.
  std::optional<std::vector<Vec3>> triples(std::string_view key);
  std::optional<std::array<double, 16>> sixteen(std::string_view key);
  bool is_list(std::string_view key) const;
  std::optional<std::vector<std::string>> texts(std::string_view key);
  std::optional<TomlTable> table(std::string_view key);
  /// Tables written as [[key]], in their order; none if the key is not there.
  std::vector<TomlTable> tables(std::string_view key);

  /// The same, where the key must be there.
  template <class T>
  T required(std::string_view key, const std::optional<T>& value) const {
    if (!value) fail_missing(key);
    return *value;
  }

  /// One of the words given, by its position among them.
  std::optional<std::size_t> word(std::string_view key, std::initializer_list<std::string_view> words);
  std::size_t required_word(std::string_view key, std::initializer_list<std::string_view> words);

  void finish() const;

  /// The key with the names of the tables that it is in: "fixed.meshes[0].pose".
  std::string full(std::string_view key) const;

 private:
  const toml::node* find(std::string_view key);
  double finite_number(const toml::node& node, std::string_view key) const;
  std::string plain(const toml::node& node, std::string_view key) const;
  template <std::size_t N>
  std::optional<std::array<double, N>> numbers(std::string_view key, std::string_view count);

  const std::filesystem::path* path_;
  const toml::table* table_;
  std::string name_;
  std::set<std::string, std::less<>> known_;
};

}  // namespace condyle::io
