#pragma once

#include <gtest/gtest.h>

#include <exception>
#include <filesystem>
#include <string>
#include <string_view>

/// Texts that tests give and get. Each check of a text is one line that fails where it stands.

namespace condyle::test {

/// The text with one part of it replaced, which must be there.
inline std::string replaced(std::string text, std::string_view from, std::string_view to) {
  const auto at = text.find(from);
  EXPECT_NE(at, text.npos) << from;
  return at == text.npos ? text : text.replace(at, from.size(), to);
}

/// What a refused call says, or "accepted". Another kind of exception escapes.
template <class Error = std::exception, class Call>
std::string complaint_of(Call&& call) {
  try {
    call();
  } catch (const Error& error) {
    return error.what();
  }
  return "accepted";
}

/// What reading a file is refused with behind the file's name, in one line; or "accepted".
template <class Error = std::exception, class Read>
std::string complaint_about(const std::filesystem::path& file, Read&& read) {
  std::string text = complaint_of<Error>([&] { read(file); });
  if (text == "accepted") return text;
  const std::string start = file.string() + ": ";
  EXPECT_EQ(text.find('\n'), text.npos) << text;
  EXPECT_TRUE(text.starts_with(start)) << text;
  return text.erase(0, start.size());
}

/// Something to refuse, and what is said about it or a piece of that.
struct Refusal {
  std::string given, says;
};

/// Where a check stands. std::source_location is not in every compiler that is supported: clang 14 has none.
struct SourcePlace {
  const char* file = "";
  int line = 0;

  static SourcePlace current(const char* file = __builtin_FILE(), int line = __builtin_LINE()) {
    return {file, line};
  }
};

/// Whether it holds; if not, the failure stands at the place and shows the text.
inline void expect_of_text(bool holds, std::string_view text, std::string_view what, std::string_view wanted,
                           const SourcePlace& place) {
  if (!holds)
    ADD_FAILURE_AT(place.file, place.line) << "'" << text << "'\n  " << what << " '" << wanted << "'";
}

inline void expect_says(std::string_view text, std::string_view piece,
                        SourcePlace place = SourcePlace::current()) {
  expect_of_text(text.find(piece) != text.npos, text, "does not say", piece, place);
}
inline void expect_silent(std::string_view text, std::string_view piece,
                          SourcePlace place = SourcePlace::current()) {
  expect_of_text(text.find(piece) == text.npos, text, "says", piece, place);
}
inline void expect_begins(std::string_view text, std::string_view start,
                          SourcePlace place = SourcePlace::current()) {
  expect_of_text(text.starts_with(start), text, "does not begin with", start, place);
}
inline void expect_ends(std::string_view text, std::string_view end,
                        SourcePlace place = SourcePlace::current()) {
  expect_of_text(text.ends_with(end), text, "does not end with", end, place);
}

}  // namespace condyle::test
