#include "answer.hpp"

#include <cstdio>
#include <utility>

#include "condyle/error.hpp"
#include "io/file/failure.hpp"

namespace condyle::cli {

void print(std::string_view answer) {
  const bool written = std::fwrite(answer.data(), 1, answer.size(), stdout) == answer.size();
  if (std::fflush(stdout) != 0 || !written) throw FileError("standard output: cannot be written");
}

void note(std::string remark) {
  std::fprintf(stderr, "condyle: note: %s\n", io::one_line(std::move(remark)).c_str());
}

void say_written(const std::vector<std::filesystem::path>& files) {
  std::string names;
  for (const auto& file : files) names += (names.empty() ? "wrote " : ", ") + file.string();
  note(names);
}

}  // namespace condyle::cli
