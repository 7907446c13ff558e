#pragma once

#include <string>
#include <string_view>

#include "condyle/io/mesh_file.hpp"

namespace condyle::test {

/// Reads bytes and holds the outcome against what the readers promise for any bytes at all: a mesh with every
/// index in range, every coordinate finite and at least one triangle, or a FileError of one line that begins
/// with the file's name. What was broken, in words; empty if the promise was kept. Other exceptions go
/// through.
std::string broken_promise(std::string_view bytes, io::MeshFormat format);

}  // namespace condyle::test
