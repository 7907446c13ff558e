#include "answer.hpp"

#include <cstdio>
#include <utility>

#include "condyle/error.hpp"
#include "io/file/failure.hpp"
#include "io/file/plain_text.hpp"

namespace condyle::cli {

namespace {

/// Notes are said when it is known whether there is an answer: the process has one standard error and one command.
std::vector<std::string>& held_notes() {
  static std::vector<std::string> notes;
  return notes;
}

}  // namespace

void print(std::string_view given) {
  const std::string answer = io::plain_text(given, io::LineEnds::keep);
  say_notes();
  const bool written = std::fwrite(answer.data(), 1, answer.size(), stdout) == answer.size();
  if (std::fflush(stdout) != 0 || !written) throw FileError("standard output: cannot be written");
}

void note(std::string remark) {
  held_notes().push_back(io::one_line(std::move(remark)));
}

void say_notes() {
  for (const std::string& remark : std::exchange(held_notes(), {}))
    std::fprintf(stderr, "condyle: note: %s\n", remark.c_str());
}

void say_written(const std::vector<std::filesystem::path>& files) {
  std::string names;
  for (const auto& file : files) names += (names.empty() ? "wrote " : ", ") + file.string();
  note(names);
}

}  // namespace condyle::cli
