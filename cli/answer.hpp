#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace condyle::cli {

/// How an answer is printed.
enum class AnswerForm { text, json };

/// Writes an answer to standard output, after the notes; what a terminal would obey is left out (plain_text()). Throws FileError
/// if it cannot be written (closed, disk full).
void print(std::string_view answer);

/// Something that is no answer and no error, one line on standard error whatever a name in it holds. It waits for the
/// answer, or for the refusal that it may explain.
/// One of an answer has a `code`.
void note(std::string remark, std::string code = {});

/// Limits the notes that are printed to the first `count`; one line names the codes of the others.
void say_at_most(std::size_t count);

/// Says the notes that wait.
void say_notes();

/// Notes which files were written; paths as OutputFolder::commit() returns them.
void say_written(const std::vector<std::filesystem::path>& files);

}  // namespace condyle::cli
