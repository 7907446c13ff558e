#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

namespace condyle::io {

/// Marks of a body's vertices, of which there must be so many: 0 or 1 in a line for each. Throws FileError naming the line.
std::vector<std::uint8_t> read_vertex_marks(const std::filesystem::path& path, std::size_t vertices,
                                            const std::string& body);

}  // namespace condyle::io
