#pragma once

#include <cstddef>
#include <string>

namespace condyle::io {

/// How a command ends, as --help and the documentation say; also in tables of hips that could not be answered.
enum ExitCode {
  answered = 0,
  bad_usage = 2,
  bad_file = 3,
  unfit_mesh = 4,
  internal_error = 5,
  reference_contact = 6,
  interrupted = 130
};

/// Why something could not be answered.
struct Failure {
  ExitCode exit_code;
  std::string message;  ///< one line, whatever a file or its name holds
};

/// Bytes of a line on standard error or in failures.csv: twenty lines of a terminal.
inline constexpr std::size_t longest_message = 2000;

/// Failure for the exception that is being handled.
Failure failure_of_current_exception();

/// With a blank in the place of what a terminal would obey, as plain_text(), and at most longest_message bytes: of a longer one, which
/// names something that is longer still, start and end.
std::string one_line(std::string text);

}  // namespace condyle::io
