#pragma once

#include <string_view>

namespace condyle::cli {

/// How an answer is printed.
enum class AnswerForm { text, json };

/// Writes an answer to standard output. Throws FileError where it cannot be written (closed, disk full).
void print(std::string_view answer);

/// Says something that is no answer and no error, as one line on standard error.
void note(std::string_view remark);

}  // namespace condyle::cli
