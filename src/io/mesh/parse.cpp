#include "io/mesh/parse.hpp"

#include <algorithm>
#include <cassert>

namespace condyle::io {
namespace {

char lower(char c) {
  return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
}

}  // namespace

std::string lower_case(std::string_view text) {
  std::string out(text);
  std::transform(out.begin(), out.end(), out.begin(), lower);
  return out;
}

bool is_space(char c) noexcept {
  return c == ' ' || (c >= '\t' && c <= '\r');
}

TextCursor::TextCursor(const Source& source, std::size_t offset) : source_(source), at_(offset) {
  const auto before = source.bytes.substr(0, offset);
  line_ = word_line_ = 1 + static_cast<std::size_t>(std::count(before.begin(), before.end(), '\n'));
}

std::string_view TextCursor::word() {
  const auto& bytes = source_.bytes;
  for (; at_ < bytes.size() && is_space(bytes[at_]); ++at_) line_ += bytes[at_] == '\n';
  word_line_ = line_;
  const std::size_t first = at_;
  while (at_ < bytes.size() && !is_space(bytes[at_])) ++at_;
  return bytes.substr(first, at_ - first);
}

std::string_view TextCursor::rest_of_line() {
  const auto& bytes = source_.bytes;
  const std::size_t end = std::min(bytes.find('\n', at_), bytes.size());
  auto text = bytes.substr(at_, end - at_);
  word_line_ = line_;
  at_ = end;
  if (at_ < bytes.size()) ++at_, ++line_;
  if (text.ends_with('\r')) text.remove_suffix(1);
  return text;
}

std::string_view TextCursor::take(std::size_t bytes) noexcept {
  assert(bytes <= remaining());
  const auto taken = source_.bytes.substr(at_, bytes);
  line_ += static_cast<std::size_t>(std::count(taken.begin(), taken.end(), '\n'));
  at_ += bytes;
  return taken;
}

void TextCursor::expect(std::string_view expected) {
  const auto found = word();
  if (found.empty()) fail(fmt::format("the file ends where '{}' should be", expected));
  if (lower_case(found) != lower_case(expected))
    fail(fmt::format("{} should be '{}'", in_quotes(found), expected));
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
  else if (corners.size() > 3 && rule == PolygonRule::split)
    raw.polygons.push_back({raw.triangles.size(), {corners.begin(), corners.end()}});
  else
    return false;
  return true;
}

std::string refused_face(std::string_view kind, std::uint64_t number, std::size_t corners) {
  return fmt::format("{} {} has {} corners: only triangles are read{}", kind, number, corners,
                     corners > 3 ? ", unless polygons are to be split" : "");
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

void append_cells(RawMesh& raw, std::span<const std::int64_t> corners, std::span<const std::int64_t> ends,
                  const Source& source) {
  if (!ends.empty() && std::cmp_not_equal(ends.back(), corners.size()))
    source.fail(fmt::format("polygons: {} corners, and {} are used", corners.size(), ends.back()));
  raw.triangles.reserve(raw.triangles.size() + ends.size());
  std::size_t first = 0;
  for (const std::int64_t end : ends) {
    append_face(raw, corners.subspan(first, static_cast<std::size_t>(end) - first), source.polygons);
    first = static_cast<std::size_t>(end);
  }
}

}  // namespace condyle::io
