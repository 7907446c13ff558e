#pragma once

#include <string>
#include <string_view>
#include <vector>

/// What a process has from its system when it starts.

namespace condyle::cli {

/// A closed standard stream would give its number to the next file that is opened, and answers would be written into it: afterwards
/// each is open.
void hold_standard_streams();

/// The words of the command line in UTF-8, without the program's name.
std::vector<std::string> words_of_command_line(int argc, char** argv);

/// Whether somebody sees standard error line by line.
bool standard_error_is_terminal() noexcept;

/// Writes a line as it is, without memory and buffers: a signal handler may call it.
void write_to_standard_error(std::string_view line) noexcept;

}  // namespace condyle::cli
