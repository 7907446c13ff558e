#include "answer.hpp"

#include <cstdio>

#include "condyle/core/error.hpp"

namespace condyle::cli {

void print(std::string_view answer) {
  const bool written = std::fwrite(answer.data(), 1, answer.size(), stdout) == answer.size();
  if (std::fflush(stdout) != 0 || !written) throw FileError("standard output: cannot be written");
}

void note(std::string_view remark) {
  std::fprintf(stderr, "condyle: note: %.*s\n", static_cast<int>(remark.size()), remark.data());
}

}  // namespace condyle::cli
