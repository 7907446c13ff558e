#pragma once

#include <fmt/format.h>

#include <array>
#include <bit>
#include <charconv>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <filesystem>
#include <limits>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <vector>

#include "condyle/error.hpp"
#include "condyle/io/mesh_file.hpp"
#include "condyle/mesh.hpp"
#include "core/lower_case.hpp"
#include "io/file/in_quotes.hpp"

/// Common parts of the mesh readers. They are our own, every format: VTK's drop digits of a double (STL,
/// OBJ, PLY readers keep floats), merge with tolerances, read past a truncation and print, and believe any
/// count a header gives. Here no byte is read past the end, no memory is allocated before the bytes that
/// justify it are known to be there, and the first bad element has a name.

namespace condyle::io {

/// A mesh as a file states it: numbers neither checked nor narrowed yet.
struct RawMesh {
  Points vertices;
  std::vector<std::array<std::int64_t, 3>> triangles;

  /// A polygon of more than three corners, and how many triangles stand before it.
  struct Polygon {
    std::size_t triangles_before;
    std::vector<std::int64_t> corners;
  };
  std::vector<Polygon> polygons = {};
};

/// The bytes of a file and the name under which to complain about them.
struct Source {
  std::string_view bytes;
  std::string_view name;
  PolygonRule polygons = PolygonRule::refuse;

  [[noreturn]] void fail(std::string_view what) const { throw FileError(fmt::format("{}: {}", name, what)); }
};

using core::lower_case;
bool is_space(char c) noexcept;

/// The number a word spells, all of it. A leading + is allowed; nan and inf are numbers here. Nothing where
/// it is no number, or one that T cannot hold (1e999 overflows, 1e-999 would become 0).
template <class T>
bool parse_number(std::string_view word, T& value) {
  if (word.starts_with('+')) word.remove_prefix(1);
  const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
  return error == std::errc() && end == word.data() + word.size();
}

/// The text without the mark of UTF-8 before it, which some editors write.
std::string_view without_byte_order_mark(std::string_view text) noexcept;

/// Lines of a text that end with a line feed, or with a carriage return, or with both.
std::size_t count_line_ends(std::string_view text) noexcept;

/// Reads words and lines, and counts lines for messages. A line ends with a line feed, with a single carriage return, as Rhino
/// and spreadsheets of a Macintosh write it, or with both; a byte order mark at the start is passed over.
class TextCursor {
 public:
  /// Raises FileError for a text in UTF-16.
  explicit TextCursor(const Source& source, std::size_t offset = 0);

  bool at_end() const noexcept { return at_ == source_.bytes.size(); }
  std::size_t line() const noexcept { return line_; }
  std::size_t offset() const noexcept { return at_; }
  std::size_t remaining() const noexcept { return source_.bytes.size() - at_; }

  /// The next word, across line ends; empty at the end of the file.
  std::string_view word();
  /// The rest of this line without its end; the cursor then stands at the start of the next.
  std::string_view rest_of_line();
  /// So many bytes, which the caller has made sure are there.
  std::string_view take(std::size_t bytes) noexcept;
  /// The next word, which must be this one, in upper or lower case.
  void expect(std::string_view word);
  /// The next word as a number; `what` says in a message what should have been there.
  template <class T>
  T number(std::string_view what) {
    const auto text = word();
    if (text.empty()) fail(fmt::format("the file ends where {} should be", what));
    T value{};
    if (!parse_number(text, value)) fail(fmt::format("{} should be {}", in_quotes(text), what));
    return value;
  }
  [[noreturn]] void fail(std::string_view what) const {
    source_.fail(fmt::format("line {}: {}", word_line_, what));
  }

 private:
  Source source_;
  std::size_t at_, line_, word_line_;
  std::size_t feed_;  ///< the next line feed, if it is not behind
  std::size_t single_returns_ =
      0;  ///< carriage returns before here that are not behind have no line feed after them
  /// How the first line ends says how a line before binary data ends, whose first byte may look like a line feed.
  bool ends_with_single_return_ = false;
};

/// The lines of a text but for comments, those that begin with '#' as numpy writes them.
std::string without_comments(const Source& source);

/// Reads fixed-size values, and never past the end.
class ByteCursor {
 public:
  explicit ByteCursor(const Source& source, std::size_t offset = 0) : source_(source), at_(offset) {}

  std::size_t remaining() const noexcept { return source_.bytes.size() - at_; }
  std::size_t offset() const noexcept { return at_; }

  /// Whether count elements of so many bytes each can still follow; no product overflows.
  bool has(std::uint64_t count, std::size_t bytes_each) const noexcept {
    return count <= remaining() / bytes_each;
  }
  /// The next bytes; the caller has made sure that they are there.
  const char* take(std::size_t bytes) noexcept;

  template <class T>
  T value(std::endian order) noexcept {
    std::array<char, sizeof(T)> bytes;
    std::memcpy(bytes.data(), take(sizeof(T)), sizeof(T));
    if (order != std::endian::native) {
      for (std::size_t i = 0; i < sizeof(T) / 2; ++i) std::swap(bytes[i], bytes[sizeof(T) - 1 - i]);
    }
    return std::bit_cast<T>(bytes);
  }

 private:
  Source source_;
  std::size_t at_;
};

/// A number of a file as the type it is kept in. Unsigned integers beyond 64 signed bits become the largest
/// of these, which no mesh has as an index.
template <class Out, class T>
Out as(T value) noexcept {
  if constexpr (std::is_same_v<T, std::uint64_t> && std::is_same_v<Out, std::int64_t>) {
    constexpr auto largest = std::numeric_limits<std::int64_t>::max();
    if (value > static_cast<std::uint64_t>(largest)) return largest;
  }
  return static_cast<Out>(value);
}

/// Appends a face. False, and nothing done, for fewer than three corners, and for more where the rule refuses them.
bool append_face(RawMesh& raw, std::span<const std::int64_t> corners, PolygonRule rule);

/// Appends a strip: corners i, i + 1, i + 2 are a triangle, every second one wound the other way. What names a vertex twice only
/// joins two strips and is left out.
void append_strip(RawMesh& raw, std::span<const std::int64_t> corners);

/// Its message: "face 12 has 4 corners: ...".
std::string refused_face(std::string_view kind, std::uint64_t number, std::size_t corners);

/// Holds that cells which end at these places in the row of all corners are faces that are read.
void check_ends(std::span<const std::int64_t> ends, const Source& source);

/// Appends cells that check_ends() has let pass.
void append_cells(RawMesh& raw, std::span<const std::int64_t> corners, std::span<const std::int64_t> ends,
                  const Source& source);

/// Appends strips that end at these places in the row of all corners. Fails for ends that do not ascend or do not use every
/// corner, and for a strip of fewer than three corners.
void append_strips(RawMesh& raw, std::span<const std::int64_t> corners, std::span<const std::int64_t> ends,
                   const Source& source);

/// The format that the name of a file ends in; empty if it is none of a mesh.
std::optional<MeshFormat> mesh_format_named(const std::filesystem::path& path);

/// Whether the file has exactly the size that the count after a binary header of STL implies.
bool is_binary_stl(const Source& source);

// One reader per format; each raises FileError only.
RawMesh read_stl(const Source& source);
RawMesh read_obj(const Source& source);
RawMesh read_ply(const Source& source);
RawMesh read_vtp(const Source& source);
RawMesh read_legacy_vtk(const Source& source);

}  // namespace condyle::io
