#include "standard_streams.hpp"

#include <fcntl.h>
#include <unistd.h>

#include <algorithm>

namespace condyle::cli {

void hold_standard_streams() {
  // Opened for reading, the number is taken and writing still fails.
  for (const int stream : {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO})
    while (::fcntl(stream, F_GETFD) == -1)
      if (::open("/dev/null", O_RDONLY) == -1) return;
}

std::vector<std::string> words_of_command_line(int argc, char** argv) {
  return {argv + std::min(argc, 1), argv + argc};
}

bool standard_error_is_terminal() noexcept {
  return ::isatty(STDERR_FILENO) != 0;
}

void write_to_standard_error(std::string_view line) noexcept {
  [[maybe_unused]] const auto written = ::write(STDERR_FILENO, line.data(), line.size());
}

}  // namespace condyle::cli
