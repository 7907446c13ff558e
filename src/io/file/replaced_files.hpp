#pragma once

#include <filesystem>
#include <span>

namespace condyle::io {

/// Raises FileError, naming the file, where one of those that are to be written is one of those that were read, or that this
/// thread's InputRecorder has: by another name, a hard or a symbolic link too.
void check_replaces_none(std::span<const std::filesystem::path> written,
                         std::span<const std::filesystem::path> read);

/// Throws FileError if there is a file of this name, not empty, that bears none of the marks of what Condyle writes: it is somebody's own, and lost
/// if it were replaced.
void check_is_own(const std::filesystem::path& path);

/// Kind of the file that already has a result's name.
enum class NameTaken {
  replaceable,  ///< nothing, a regular file, or a link to one or to nothing
  folder,
  written_into,  ///< a FIFO, or a device that takes characters one after the other: nothing can take its place
  refused,       ///< a socket, or a disk as a device
};
NameTaken what_has_the_name(const std::filesystem::path& path);

}  // namespace condyle::io
