#pragma once

#include <cstdint>
#include <cstdio>
#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

/// What POSIX calls to look at, read and write files. An `int` that is returned is 0 or an error of <cerrno>, whose text is one of
/// std::generic_category(). Nothing is recorded: readers use input_file.hpp.

namespace condyle::io {

/// Identity of a file, whatever its names.
using FileId = std::pair<std::uint64_t, std::uint64_t>;

/// What has a name, links followed, or is open.
struct FileStatus {
  enum class Kind : std::uint8_t {
    file,
    folder,
    characters,  ///< a FIFO, or a device that takes characters one after the other
    other        ///< a socket, or a disk as a device
  };
  Kind kind = Kind::other;
  std::uint64_t size = 0;
  FileId id;
};

/// Looks at what has the name, or is open; begun again where a signal breaks it off.
int look_at(const std::filesystem::path& path, FileStatus& status) noexcept;
int look_at_open(int stream, FileStatus& status) noexcept;

/// Whether the call that gave this error may succeed the next time though nothing changed that an answer depends on.
bool passes(int error) noexcept;

/// Opens for reading, without waiting for whoever would write into it.
int open_to_read(const std::filesystem::path& path, int& stream) noexcept;
/// Reads from a place on; got is 0 at the end only.
int read_at(int stream, std::uint64_t at, std::span<char> out, std::size_t& got) noexcept;
void close_stream(int stream) noexcept;

/// Whether the process may, or why it may not.
bool is_readable(const std::filesystem::path& path) noexcept;
int why_not_writable(const std::filesystem::path& path) noexcept;

/// All names in a folder, in any order.
int names_in(const std::filesystem::path& folder, std::vector<std::string>& names);

/// The value of an environment variable, nothing if it is not set.
std::optional<std::string> variable_of_process(const std::string& name);

/// A file that was not there, for writing; or what is there, of which nothing is cut off. Null with errno set.
std::FILE* new_file(const std::filesystem::path& path) noexcept;
std::FILE* opened_to_write_into(const std::filesystem::path& path) noexcept;

/// Gives a file another name on its disk, which takes the place of the one that had it, at once.
int move_file(const std::filesystem::path& from, const std::filesystem::path& to) noexcept;
int remove_file(const std::filesystem::path& path) noexcept;

/// No other process that lives has it.
int number_of_process() noexcept;

}  // namespace condyle::io
