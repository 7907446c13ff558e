#include "fuzz/mesh_reader_promise.hpp"

#include <algorithm>
#include <cmath>

#include "condyle/error.hpp"
#include "core/one_line.hpp"

namespace condyle::test {
namespace {

constexpr std::string_view mesh_name = "some.file";
constexpr std::size_t longest_message = 400;  // characters: a line, however much of the file it quotes

bool is_finite(const std::vector<double>& values) {
  return std::all_of(values.begin(), values.end(), [](double value) { return std::isfinite(value); });
}

std::string broken_promise(const TriMesh& mesh) {
  if (mesh.triangles.empty()) return "a mesh without triangles";
  if (!is_finite(mesh.vertices.x) || !is_finite(mesh.vertices.y) || !is_finite(mesh.vertices.z)) {
    return "a coordinate that is not finite";
  }
  for (const auto& triangle : mesh.triangles) {
    for (const Index v : triangle) {
      if (v >= mesh.vertices.size()) return "an index out of range";
    }
  }
  return {};
}

std::string broken_promise(std::string_view message) {
  if (!message.starts_with(std::string(mesh_name) + ": ")) return "a message without the file's name";
  if (core::one_line(message, message.size()) != message)
    return "a message that is not one line of characters that no terminal obeys";
  if (core::one_line(message, longest_message).size() < message.size())
    return "a message too long for a line";
  return {};
}

}  // namespace

std::string broken_promise(std::string_view bytes, io::MeshFormat format) {
  for (const io::PolygonRule rule :
       {io::PolygonRule::refuse, io::PolygonRule::split, io::PolygonRule::guess}) {
    std::string broken;
    try {
      broken = broken_promise(io::read_mesh(bytes, format, mesh_name, rule).mesh);
    } catch (const FileError& error) {
      broken = broken_promise(std::string_view(error.what()));
    }
    if (!broken.empty()) return broken;
  }
  return {};
}

}  // namespace condyle::test
