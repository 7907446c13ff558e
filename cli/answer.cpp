#include "answer.hpp"

#include <cstdio>

#include "condyle/core/error.hpp"

namespace condyle::cli {

void print(std::string_view answer) {
  const bool written = std::fwrite(answer.data(), 1, answer.size(), stdout) == answer.size();
  if (std::fflush(stdout) != 0 || !written) throw FileError("standard output: cannot be written");
}

}  // namespace condyle::cli
