#include "answer.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <cstdio>
#include <limits>
#include <utility>

#include "condyle/error.hpp"
#include "io/file/failure.hpp"
#include "io/file/plain_text.hpp"

namespace condyle::cli {

namespace {

/// Notes are said when it is known whether there is an answer: the process has one standard error and one command.
struct HeldNote {
  std::string line, code;
};
std::vector<HeldNote>& held_notes() {
  static std::vector<HeldNote> notes;
  return notes;
}

std::size_t most_notes = std::numeric_limits<std::size_t>::max();

}  // namespace

void print(std::string_view given) {
  const std::string answer = io::plain_text(given, io::LineEnds::keep);
  say_notes();
  const bool written = std::fwrite(answer.data(), 1, answer.size(), stdout) == answer.size();
  if (std::fflush(stdout) != 0 || !written) throw FileError("standard output: cannot be written");
}

void note(std::string remark, std::string code) {
  held_notes().push_back({io::one_line(std::move(remark)), std::move(code)});
}

void say_at_most(std::size_t count) {
  most_notes = count;
}

void say_notes() {
  const std::vector<HeldNote> held = std::exchange(held_notes(), {});
  std::vector<std::string> more;
  std::size_t said = 0;
  const auto say = [](const std::string& line) { std::fprintf(stderr, "condyle: note: %s\n", line.c_str()); };
  for (const auto& [line, code] : held)
    if (code.empty() || said++ < most_notes)
      say(line);
    else
      more.push_back(code);
  if (!more.empty())
    say(fmt::format("{} more {} by --verbose: {}", more.size(), more.size() == 1 ? "note" : "notes",
                    fmt::join(more, ", ")));
}

void say_written(const std::vector<std::filesystem::path>& files) {
  std::string names;
  for (const auto& file : files) names += (names.empty() ? "wrote " : ", ") + file.string();
  note(names);
}

}  // namespace condyle::cli
