#include "io/image/text_header.hpp"

#include <fmt/format.h>

#include "io/file/words.hpp"
#include "io/mesh/parse.hpp"

namespace condyle::io {
namespace {

constexpr std::size_t line_block_size = std::size_t{1} << 14;
constexpr std::uint64_t longest_header = std::uint64_t{1} << 24;  // bytes

}  // namespace

/// Appends the bytes that follow; false at the end of the file.
bool HeaderLines::read_block() {
  const std::size_t before = block_.size();
  const std::uint64_t at = offset_ + before - used_;
  if (at > longest_header) source_.fail("the header is longer than 16 MB");
  block_.resize(before + line_block_size);
  block_.resize(before + source_.read(at, std::span(block_).subspan(before)));
  return block_.size() > before;
}

/// Where the text begins, and how its lines end.
void HeaderLines::begin() {
  read_block();
  used_ = block_.size() - without_byte_order_mark(block_).size();
  offset_ = used_;
  const std::size_t first = block_.find_first_of("\r\n");
  if (first == std::string::npos || block_[first] == '\n') return;
  if (first + 1 == block_.size()) read_block();
  const std::size_t after = block_.find_first_not_of('\r', first);
  if (after == std::string::npos || block_[after] != '\n') end_ = '\r';
}

std::optional<std::string> HeaderLines::next() {
  if (line_ == 0) begin();
  std::size_t searched = used_;
  while (true) {
    const std::size_t end = block_.find(end_, searched);
    if (end != std::string::npos) {
      std::string line = block_.substr(used_, end - used_);
      offset_ += line.size() + 1;
      used_ = end + 1;
      ++line_;
      if (line.ends_with('\r')) line.pop_back();
      return line;
    }
    block_.erase(0, used_);
    used_ = 0;
    searched = block_.size();
    if (read_block()) continue;
    if (block_.empty()) return std::nullopt;
    // The last line of a file may lack its end.
    std::string line = std::move(block_);
    block_.clear();
    offset_ += line.size();
    ++line_;
    return line;
  }
}

void HeaderLines::fail(std::string_view what) const {
  source_.fail(fmt::format("line {}: {}", line_, what));
}

std::optional<std::string_view> HeaderFields::find(const std::string& key) const {
  const auto found = values_.find(key);
  if (found == values_.end()) return std::nullopt;
  return found->second;
}

std::string_view HeaderFields::need(const std::string& key) const {
  const auto value = find(key);
  if (!value) fail(key, "is missing");
  return *value;
}

template <class T>
std::vector<T> HeaderFields::parsed(const std::string& key, std::size_t count, std::string_view what) const {
  const auto words = io::words_of(need(key));
  if (words.size() != count) fail(key, fmt::format("has {} values instead of {}", words.size(), count));
  std::vector<T> values(count);
  for (std::size_t i = 0; i < count; ++i)
    if (!parse_number(words[i], values[i])) fail(key, fmt::format("{} is no {}", in_quotes(words[i]), what));
  return values;
}

std::vector<double> HeaderFields::numbers(const std::string& key, std::size_t count) const {
  return parsed<double>(key, count, "number");
}

std::vector<std::int64_t> HeaderFields::whole_numbers(const std::string& key, std::size_t count) const {
  return parsed<std::int64_t>(key, count, "whole number");
}

void HeaderFields::fail(std::string_view key, std::string_view what) const {
  source_.fail(fmt::format("{}: {}", key, what));
}

}  // namespace condyle::io
