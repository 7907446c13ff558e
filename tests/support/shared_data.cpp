#include "support/shared_data.hpp"

#include <array>
#include <bit>
#include <cstdlib>
#include <fstream>
#include <stdexcept>
#include <string>

namespace condyle::test {

std::filesystem::path shared_data_folder() {
  const char* named = std::getenv("CONDYLE_DATA");
  return named ? std::filesystem::path(named) : std::filesystem::path(CONDYLE_SOURCE_DIR) / "../shared/data";
}

std::optional<std::filesystem::path> shared_data() {
  const std::filesystem::path folder = shared_data_folder();
  if (!std::filesystem::is_directory(folder)) return std::nullopt;
  return folder;
}

TriMesh read_ply(const std::filesystem::path& path) {
  static_assert(std::endian::native == std::endian::little);
  std::ifstream file(path, std::ios::binary);
  std::size_t vertices = 0, faces = 0;
  std::string header;
  for (std::string line; std::getline(file, line) && line != "end_header";) {
    if (line.starts_with("element vertex ")) vertices = std::stoul(line.substr(15));
    if (line.starts_with("element face ")) faces = std::stoul(line.substr(13));
    if (!line.starts_with("comment")) header += line + '\n';
  }
  const std::string expected = "ply\nformat binary_little_endian 1.0\nelement vertex " +
                               std::to_string(vertices) +
                               "\nproperty float x\nproperty float y\nproperty float z\nelement face " +
                               std::to_string(faces) + "\nproperty list uchar int vertex_indices\n";
  if (header != expected) throw std::runtime_error(path.string() + ": not the kind of PLY the tests read");
  const auto read = [&](auto& value) { file.read(reinterpret_cast<char*>(&value), sizeof value); };
  TriMesh mesh;
  mesh.vertices.reserve(vertices), mesh.triangles.reserve(faces);
  for (std::size_t v = 0; v < vertices; ++v) {
    std::array<float, 3> p{};
    read(p);
    mesh.vertices.push_back({p[0], p[1], p[2]});
  }
  for (std::size_t f = 0; f < faces; ++f) {
    unsigned char corners = 0;
    std::array<std::int32_t, 3> face{};
    read(corners), read(face);
    if (corners != 3) throw std::runtime_error(path.string() + ": a face is not a triangle");
    mesh.triangles.push_back(
        {static_cast<Index>(face[0]), static_cast<Index>(face[1]), static_cast<Index>(face[2])});
  }
  if (!file) throw std::runtime_error(path.string() + ": ends early");
  return mesh;
}

}  // namespace condyle::test
