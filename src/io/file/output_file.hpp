#pragma once

#include <filesystem>
#include <span>
#include <string_view>
#include <vector>

namespace condyle::io {

/// What a file is, and how its name ends, in small letters: any other name promises another format.
struct FileKind {
  std::string_view what;
  std::vector<std::string_view> endings;
  std::string_view hint = {};
};

/// Throws FileError if write_output_file() could not put a file there, or where it would take the place of one of those
/// that were `read` or of one that Condyle did not write, and UsageError if a new file would have another ending than its kind: to be called before long work. Leaves
/// nothing.
void check_output_file(const std::filesystem::path& path, std::span<const std::filesystem::path> read = {},
                       const FileKind& kind = {});

/// An answer that is one file: whole or not at all, in a folder that is made where it is missing. Where the name is a link, what it
/// leads to is replaced; a FIFO or a device that takes characters is written into. Throws FileError.
void write_output_file(const std::filesystem::path& path, std::string_view bytes);

}  // namespace condyle::io
