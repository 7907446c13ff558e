#include "io/mesh/parse.hpp"

#include <algorithm>
#include <cassert>

namespace condyle::io {
namespace {

/// A line feed, or a carriage return that none follows.
bool is_line_end(std::string_view text, std::size_t i) noexcept {
  return text[i] == '\n' || (text[i] == '\r' && (i + 1 == text.size() || text[i + 1] != '\n'));
}

}  // namespace

bool is_space(char c) noexcept {
  return c == ' ' || (c >= '\t' && c <= '\r');
}

std::string_view without_byte_order_mark(std::string_view text) noexcept {
  constexpr std::string_view mark = "\xEF\xBB\xBF";
  return text.starts_with(mark) ? text.substr(mark.size()) : text;
}

std::size_t count_line_ends(std::string_view text) noexcept {
  auto lines = static_cast<std::size_t>(std::count(text.begin(), text.end(), '\n'));
  for (std::size_t i = text.find('\r'); i != text.npos; i = text.find('\r', i + 1))
    lines += is_line_end(text, i);
  return lines;
}

TextCursor::TextCursor(const Source& source, std::size_t offset) : source_(source), at_(offset) {
  const auto& bytes = source.bytes;
  if (offset == 0) {
    if (bytes.starts_with("\xFF\xFE") || bytes.starts_with("\xFE\xFF"))
      source.fail("the text is in UTF-16: save it as UTF-8");
    at_ = bytes.size() - without_byte_order_mark(bytes).size();
  }
  line_ = word_line_ = 1 + count_line_ends(bytes.substr(0, offset));
  feed_ = std::min(bytes.find('\n', at_), bytes.size());
  const std::size_t end = bytes.find_first_of("\r\n");
  const std::size_t after = bytes.find_first_not_of('\r', end);
  ends_with_single_return_ =
      end != bytes.npos && after != end && (after == bytes.npos || bytes[after] != '\n');
}

std::string_view TextCursor::word() {
  const auto& bytes = source_.bytes;
  for (; at_ < bytes.size() && is_space(bytes[at_]); ++at_) line_ += is_line_end(bytes, at_);
  word_line_ = line_;
  const std::size_t first = at_;
  while (at_ < bytes.size() && !is_space(bytes[at_])) ++at_;
  return bytes.substr(first, at_ - first);
}

std::string_view TextCursor::rest_of_line() {
  const auto& bytes = source_.bytes;
  if (feed_ < at_) feed_ = std::min(bytes.find('\n', at_), bytes.size());
  auto text = bytes.substr(at_, feed_ - at_);
  text = text.substr(0, text.find('\r'));
  word_line_ = line_;
  at_ += text.size();
  if (at_ == bytes.size()) return text;
  ++line_;
  // A file that was converted twice has several carriage returns before a line feed. Those before something else end a line each,
  // and are looked at once.
  std::size_t last = at_;
  while (!ends_with_single_return_ && at_ >= single_returns_ && last < bytes.size() && bytes[last] == '\r')
    ++last;
  if (last < bytes.size() && bytes[last] == '\n') {
    at_ = last + 1;
  } else {
    single_returns_ = std::max(single_returns_, last);
    ++at_;
  }
  return text;
}

std::string_view TextCursor::take(std::size_t bytes) noexcept {
  assert(bytes <= remaining());
  const auto taken = source_.bytes.substr(at_, bytes);
  line_ += count_line_ends(taken);
  at_ += bytes;
  return taken;
}

void TextCursor::expect(std::string_view expected) {
  const auto found = word();
  if (found.empty()) fail(fmt::format("the file ends where '{}' should be", expected));
  if (lower_case(found) != lower_case(expected))
    fail(fmt::format("{} should be '{}'", in_quotes(found), expected));
}

std::string without_comments(const Source& source) {
  std::string lines;
  for (TextCursor text(source); !text.at_end();) {
    const std::string_view line = text.rest_of_line();
    const std::size_t first = std::min(line.find_first_not_of(" \t"), line.size());
    if (!line.substr(first).starts_with('#')) lines.append(line).append(1, '\n');
  }
  return lines;
}

const char* ByteCursor::take(std::size_t bytes) noexcept {
  assert(bytes <= remaining());
  const char* first = source_.bytes.data() + at_;
  at_ += bytes;
  return first;
}

bool append_face(RawMesh& raw, std::span<const std::int64_t> corners, PolygonRule rule) {
  if (corners.size() == 3)
    raw.triangles.push_back({corners[0], corners[1], corners[2]});
  else if (corners.size() > 3 && rule != PolygonRule::refuse)
    raw.polygons.push_back({raw.triangles.size(), {corners.begin(), corners.end()}});
  else
    return false;
  return true;
}

void append_strip(RawMesh& raw, std::span<const std::int64_t> corners) {
  for (std::size_t i = 0; i + 2 < corners.size(); ++i) {
    const std::int64_t a = corners[i], b = corners[i + 1], c = corners[i + 2];
    if (a == b || b == c || c == a) continue;
    if (i % 2 == 0)
      raw.triangles.push_back({a, b, c});
    else
      raw.triangles.push_back({b, a, c});
  }
}

std::string refused_face(std::string_view kind, std::uint64_t number, std::size_t corners) {
  return fmt::format("{} {} has {} corners: only triangles are read{}", kind, number, corners,
                     corners > 3 ? ", unless polygons are to be split (--polygons split)" : "");
}

void check_ends(std::span<const std::int64_t> ends, const Source& source) {
  std::int64_t first = 0;
  for (std::size_t i = 0; i < ends.size(); ++i) {
    if (ends[i] < first)
      source.fail(fmt::format("polygon {} ends at corner {}, before it begins", i, ends[i]));
    const auto corners = static_cast<std::size_t>(ends[i] - first);
    if (corners < 3 || (corners > 3 && source.polygons == PolygonRule::refuse))
      source.fail(refused_face("polygon", i, corners));
    first = ends[i];
  }
}

void append_strips(RawMesh& raw, std::span<const std::int64_t> corners, std::span<const std::int64_t> ends,
                   const Source& source) {
  std::int64_t first = 0;
  for (std::size_t i = 0; i < ends.size(); ++i) {
    if (ends[i] < first || std::cmp_greater(ends[i], corners.size()))
      source.fail(fmt::format("triangle strip {} ends at corner {} of {}", i, ends[i], corners.size()));
    if (ends[i] - first < 3)
      source.fail(fmt::format("triangle strip {} has {} corners: it needs 3", i, ends[i] - first));
    append_strip(raw,
                 corners.subspan(static_cast<std::size_t>(first), static_cast<std::size_t>(ends[i] - first)));
    first = ends[i];
  }
  if (std::cmp_not_equal(first, corners.size()))
    source.fail(fmt::format("triangle strips: {} corners, and {} are used", corners.size(), first));
}

void append_cells(RawMesh& raw, std::span<const std::int64_t> corners, std::span<const std::int64_t> ends,
                  const Source& source) {
  if (!ends.empty() && std::cmp_not_equal(ends.back(), corners.size()))
    source.fail(fmt::format("polygons: {} corners, and {} are used", corners.size(), ends.back()));
  std::size_t first = 0;
  for (const std::int64_t end : ends) {
    append_face(raw, corners.subspan(first, static_cast<std::size_t>(end) - first), source.polygons);
    first = static_cast<std::size_t>(end);
  }
}

}  // namespace condyle::io
