#pragma once

#include <filesystem>
#include <string>
#include <string_view>

namespace condyle::test {

/// Output of a run of the command.
struct Ran {
  int exit_code;  ///< -1 where it was killed
  std::string out, err;
};

/// Runs `condyle ARGUMENTS` in a folder, by the shell, with `redirections` after it ("" for none: both are
/// caught).
Ran run_condyle(const std::filesystem::path& folder, const std::string& arguments,
                const std::string& redirections = "");

/// What `condyle sample ARGUMENTS` makes, in this folder; made once per process for all tests that ask for the same.
void sample_into(const std::filesystem::path& folder, const std::string& arguments);

/// Standard error without notes on a joint, which may come before an error.
std::string without_notes(const std::string& text);

/// Whether a text is one line "condyle: ..." and nothing else.
bool is_one_error_line(const std::string& text);

/// That a run ended with this exit code and one line on standard error, which says this, and gave no answer.
void expect_refusal(const Ran& ran, int exit_code, std::string_view saying, const std::string& arguments);

}  // namespace condyle::test
