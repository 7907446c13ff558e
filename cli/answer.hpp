#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace condyle::cli {

/// How an answer is printed.
enum class AnswerForm { text, json };

/// Writes an answer to standard output. Throws FileError where it cannot be written (closed, disk full).
void print(std::string_view answer);

/// Says something that is no answer and no error, as one line on standard error,
/// whatever a name in it holds.
void note(std::string remark);

/// Says on standard error which files were written; paths as OutputFolder::commit() returns them.
void say_written(const std::vector<std::filesystem::path>& files);

}  // namespace condyle::cli
