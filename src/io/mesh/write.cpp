#include <fmt/format.h>

#include <bit>
#include <limits>

#include "condyle/error.hpp"
#include "condyle/io/mesh_file.hpp"
#include "condyle/version.hpp"
#include "io/file/whole_file.hpp"
#include "io/mesh/float_valued.hpp"
#include "io/mesh/parse.hpp"
#include "io/mesh/ply_bytes.hpp"

static_assert(std::endian::native == std::endian::little,
              "PLY files are written as the machine has the numbers");

namespace condyle::io {
namespace {

template <class T>
void append(std::string& bytes, T value) {
  bytes.append(reinterpret_cast<const char*>(&value), sizeof value);
}

template <class Coordinate>
std::string bytes_of(const TriMesh& mesh, std::string_view coordinate_name) {
  std::string bytes = fmt::format(
      "ply\nformat binary_little_endian 1.0\n"
      "element vertex {0}\nproperty {1} x\nproperty {1} y\nproperty {1} z\n"
      "element face {2}\nproperty list uchar int vertex_indices\nend_header\n",
      mesh.vertices.size(), coordinate_name, mesh.triangles.size());
  constexpr std::size_t face_size = 1 + 3 * sizeof(std::int32_t);
  bytes.reserve(bytes.size() + 3 * sizeof(Coordinate) * mesh.vertices.size() +
                face_size * mesh.triangles.size());
  for (std::size_t v = 0; v < mesh.vertices.size(); ++v) {
    for (const double value : {mesh.vertices.x[v], mesh.vertices.y[v], mesh.vertices.z[v]}) {
      append(bytes, static_cast<Coordinate>(value));
    }
  }
  for (const auto& triangle : mesh.triangles) {
    append(bytes, std::uint8_t{3});
    for (const Index v : triangle) append(bytes, static_cast<std::int32_t>(v));
  }
  return bytes;
}

/// Most programs know the indices of a PLY file as int only.
void write_ply(const std::filesystem::path& path, const TriMesh& mesh) {
  if (mesh.vertices.size() > std::numeric_limits<std::int32_t>::max()) {
    throw FileError(path.string() + ": cannot be written: more vertices than a PLY file can number");
  }
  io::write_whole_file(path, ply_bytes(mesh));
}

}  // namespace

std::string ply_bytes(const TriMesh& mesh) {
  return io::is_float_valued(mesh.vertices) ? bytes_of<float>(mesh, "float")
                                            : bytes_of<double>(mesh, "double");
}

void check_written_mesh(const std::filesystem::path& path) {
  const auto extension = io::lower_case(path.extension().string());
  if (extension != ".ply" && extension != ".vtp")
    throw FileError(fmt::format("{}: unknown extension '{}': .vtp and .ply are written", path.string(),
                                path.extension().string()));
}

void write_mesh(const std::filesystem::path& path, const TriMesh& mesh) {
  check_written_mesh(path);
  if (io::lower_case(path.extension().string()) == ".ply")
    write_ply(path, mesh);
  else
    write_vtp(path, mesh, {}, {}, {.fields = {{"condyle_version", std::string(version)}}});
}

}  // namespace condyle::io
