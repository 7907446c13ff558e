#include "condyle/io/mesh_file.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

#include "condyle/error.hpp"
#include "condyle/inspect.hpp"
#include "core/coordinate_range.hpp"
#include "io/file/compressed.hpp"
#include "io/image/unread_image.hpp"
#include "io/mesh/parse.hpp"
#include "io/mesh/split_polygon.hpp"

namespace condyle::io {
namespace {

using io::RawMesh;
using io::Source;

RawMesh read_raw(const Source& source, MeshFormat format) {
  // The header of a binary STL file may hold any bytes.
  if (const auto packer = io::packed_by(source.bytes);
      !packer.empty() && !(format == MeshFormat::stl && io::is_binary_stl(source)))
    source.fail(fmt::format("is compressed by {}: uncompress it first", packer));
  switch (format) {
    case MeshFormat::stl:
      return io::read_stl(source);
    case MeshFormat::obj:
      return io::read_obj(source);
    case MeshFormat::ply:
      return io::read_ply(source);
    case MeshFormat::vtp:
      return io::read_vtp(source);
    case MeshFormat::vtk:
      break;
  }
  return io::read_legacy_vtk(source);
}

/// Checks everything that TriMesh promises against the file; the only place that does.
MeshFile checked(RawMesh&& raw, const Source& source) {
  const auto count = raw.vertices.size();
  if (count == 0) source.fail("holds no vertices");
  if (count >= no_index) source.fail(fmt::format("holds {} vertices, more than can be numbered", count));
  if (raw.triangles.empty() && raw.polygons.empty())
    source.fail(fmt::format("holds {} vertices but no triangles", count));
  for (std::size_t v = 0; v < count; ++v) {
    for (const auto& [axis, value] :
         {std::pair{'x', raw.vertices.x[v]}, {'y', raw.vertices.y[v]}, {'z', raw.vertices.z[v]}}) {
      if (!std::isfinite(value)) source.fail(fmt::format("vertex {}: coordinate {} is {}", v, axis, value));
      if (std::abs(value) > core::largest_coordinate)
        source.fail(fmt::format("vertex {}: coordinate {} is {}, beyond 1e30", v, axis, value));
    }
  }
  MeshFile file{.mesh = {std::move(raw.vertices), {}}, .split_polygons = raw.polygons.size()};
  TriMesh& mesh = file.mesh;
  mesh.triangles.reserve(raw.triangles.size());
  auto polygon = raw.polygons.begin();
  for (std::size_t t = 0; t <= raw.triangles.size(); ++t) {
    for (; polygon != raw.polygons.end() && polygon->triangles_before == t; ++polygon) {
      const auto off_plane = io::append_split(
          mesh, polygon->corners, static_cast<std::size_t>(polygon - raw.polygons.begin()) + t, source);
      if (!off_plane) continue;
      ++file.guessed_polygons;
      file.guessed_within = std::max(file.guessed_within, *off_plane);
    }
    if (t == raw.triangles.size()) break;
    auto& triangle = mesh.triangles.emplace_back();
    for (std::size_t k = 0; k < 3; ++k) {
      const auto v = raw.triangles[t][k];
      if (v < 0 || std::cmp_greater_equal(v, count)) {
        source.fail(fmt::format("triangle {} uses vertex {} of {}", t, v, count));
      }
      triangle[k] = static_cast<Index>(v);
    }
  }
  return file;
}

/// Volumes of voxels: scans, and label maps of segmentations.
bool is_image(const std::string& name) {
  for (const std::string_view ending : {".nii", ".nii.gz", ".nrrd", ".nhdr", ".mha", ".mhd"})
    if (name.ends_with(ending)) return true;
  return false;
}

}  // namespace

std::optional<MeshFormat> mesh_format_named(const std::filesystem::path& path) {
  const auto extension = io::lower_case(path.extension().string());
  if (extension == ".stl") return MeshFormat::stl;
  if (extension == ".obj") return MeshFormat::obj;
  if (extension == ".ply") return MeshFormat::ply;
  if (extension == ".vtp") return MeshFormat::vtp;
  if (extension == ".vtk") return MeshFormat::vtk;
  return std::nullopt;
}

MeshFormat mesh_format_of(const std::filesystem::path& path) {
  if (const auto format = io::mesh_format_named(path)) return *format;
  const auto extension = io::lower_case(path.extension().string());
  if (extension == ".toml")
    throw FileError(fmt::format(
        "{0}: is a joint file, not a mesh: condyle rom {0} has its limits, condyle frame {0} shows "
        "its bodies; .stl, .obj, .ply, .vtp and .vtk are read",
        path.string()));
  if (extension == ".osim")
    throw FileError(fmt::format(
        "{0}: is a model of OpenSim, not a mesh: condyle init {0} --joint NAME makes a joint file of "
        "one of its joints",
        path.string()));
  io::refuse_unread_image(path);
  if (is_image(io::lower_case(path.filename().string())))
    throw FileError(
        fmt::format("{0}: an image or label map is no mesh: condyle surface {0} --label NAME --out BONE.ply "
                    "makes one of a "
                    "label; condyle hip and condyle init take a label map of both bones, or one of each",
                    path.string()));
  if (extension == ".gz" || extension == ".zip" || extension == ".bz2" || extension == ".xz" ||
      extension == ".zst")
    throw FileError(
        fmt::format("{}: is compressed ('{}'): uncompress it first; .stl, .obj, .ply, .vtp and .vtk are read",
                    path.string(), extension));
  throw FileError(fmt::format("{}: unknown extension '{}': .stl, .obj, .ply, .vtp and .vtk are read",
                              path.string(), path.extension().string()));
}

MeshFile read_mesh(std::string_view bytes, MeshFormat format, std::string_view name, PolygonRule polygons) {
  const Source source{bytes, name, polygons};
  if (bytes.empty()) source.fail("the file is empty");
  MeshFile file = checked(read_raw(source, format), source);
  if (format == MeshFormat::stl) file.welded_vertices = weld_exactly(file.mesh);
  return file;
}

}  // namespace condyle::io
