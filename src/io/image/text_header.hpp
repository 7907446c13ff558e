#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "io/image/byte_source.hpp"

namespace condyle::io {

/// The lines of a text header that data follow, as TextCursor has them: a byte order mark before them is passed over, and where the first
/// line ends with a single carriage return all do.
class HeaderLines {
 public:
  explicit HeaderLines(const ByteSource& source) : source_(source) {}

  /// The next line without its end, nothing at the end of the file. Raises FileError for a header of more than 16 MB, which no
  /// program writes.
  std::optional<std::string> next();
  /// Where the line after the last one begins.
  std::uint64_t offset() const noexcept { return offset_; }
  /// Number of the last line, from 1.
  std::size_t line() const noexcept { return line_; }
  /// FileError "name: line 3: what"
  [[noreturn]] void fail(std::string_view what) const;

 private:
  bool read_block();
  void begin();

  const ByteSource& source_;
  std::string block_;  ///< read bytes; lines have taken those before used_
  std::size_t used_ = 0, line_ = 0;
  std::uint64_t offset_ = 0;
  char end_ = '\n';
};

/// Keys of a text header and their values.
class HeaderFields {
 public:
  explicit HeaderFields(const ByteSource& source) : source_(source) {}

  /// False for a key that is there already.
  bool add(std::string key, std::string value) {
    return values_.emplace(std::move(key), std::move(value)).second;
  }
  std::optional<std::string_view> find(const std::string& key) const;
  std::string_view need(const std::string& key) const;
  /// The words of a value, which must be so many numbers.
  std::vector<double> numbers(const std::string& key, std::size_t count) const;
  std::vector<std::int64_t> whole_numbers(const std::string& key, std::size_t count) const;
  std::int64_t whole_number(const std::string& key) const { return whole_numbers(key, 1).front(); }
  /// FileError "name: key: what"
  [[noreturn]] void fail(std::string_view key, std::string_view what) const;
  const ByteSource& source() const noexcept { return source_; }

 private:
  template <class T>
  std::vector<T> parsed(const std::string& key, std::size_t count, std::string_view what) const;

  const ByteSource& source_;
  std::map<std::string, std::string> values_;
};

}  // namespace condyle::io
