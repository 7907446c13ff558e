#include "condyle/io/mesh_file.hpp"
#include "io/file/whole_file.hpp"

namespace condyle::io {

MeshFile read_mesh(const std::filesystem::path& path, PolygonRule polygons) {
  io::check_is_file(path);
  const auto format = mesh_format_of(path);
  return read_mesh(io::read_whole_file(path), format, path.string(), polygons);
}

}  // namespace condyle::io
