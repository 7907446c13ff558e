#pragma once

#include <string>
#include <string_view>

namespace condyle::cli {

/// How an answer is printed.
enum class AnswerForm { text, json };

/// Writes an answer to standard output. Throws FileError where it cannot be written (closed, disk full).
void print(std::string_view answer);

/// Says something that is no answer and no error, as one line on standard error,
/// whatever a name in it holds.
void note(std::string remark);

}  // namespace condyle::cli
