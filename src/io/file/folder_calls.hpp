#pragma once

#include <filesystem>

/// What POSIX calls to make and remove the folders of temporary_folder.hpp. An `int` that is returned is 0 or an error of <cerrno>. What
/// removes or waits may be called by the signal handler that ends a command, which may take no memory.

namespace condyle::io {

/// A name as the system takes it.
using SystemName = std::filesystem::path::string_type;

/// Makes a folder; one that is there is no error.
int make_folder(const std::filesystem::path& folder) noexcept;
/// Makes a folder for this process only, whose name has the place of the last six letters X.
int make_folder_of_own(SystemName& name) noexcept;

/// Removes a folder if it is empty.
void remove_empty_folder(const SystemName& folder) noexcept;
/// Removes a folder that has files and no folders.
void remove_with_files(const SystemName& folder) noexcept;

void wait_a_millisecond() noexcept;

/// Keeps the signals that end a command from this thread, until the other is called: not one within another.
void hold_off_signals() noexcept;
void let_signals_in() noexcept;

}  // namespace condyle::io
