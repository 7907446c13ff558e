#pragma once

#include <filesystem>
#include <optional>

#include "condyle/mesh.hpp"

/// Real joints for the tests of the core, which has no file formats.

namespace condyle::test {

/// Where real joints are looked for: $CONDYLE_DATA, or shared/data beside the repository.
std::filesystem::path shared_data_folder();

/// That folder. None if it is missing; the test then skips with a message.
std::optional<std::filesystem::path> shared_data();

/// Binary little-endian PLY with float vertices x, y, z and faces `list uchar int` of three: what the data
/// holds. Throws std::runtime_error for anything else.
TriMesh read_ply(const std::filesystem::path& path);

}  // namespace condyle::test
