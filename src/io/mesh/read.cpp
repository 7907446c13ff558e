#include "condyle/io/mesh_file.hpp"

#include <fmt/format.h>

#include <cmath>
#include <string>
#include <utility>

#include "condyle/error.hpp"
#include "condyle/inspect.hpp"
#include "core/coordinate_range.hpp"
#include "io/mesh/parse.hpp"
#include "io/mesh/split_polygon.hpp"

namespace condyle::io {
namespace {

using io::RawMesh;
using io::Source;

RawMesh read_raw(const Source& source, MeshFormat format) {
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
TriMesh checked(RawMesh&& raw, const Source& source) {
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
  TriMesh mesh{std::move(raw.vertices), {}};
  mesh.triangles.reserve(raw.triangles.size());
  auto polygon = raw.polygons.begin();
  for (std::size_t t = 0; t <= raw.triangles.size(); ++t) {
    for (; polygon != raw.polygons.end() && polygon->triangles_before == t; ++polygon)
      io::append_split(mesh, polygon->corners, static_cast<std::size_t>(polygon - raw.polygons.begin()) + t,
                       source);
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
  return mesh;
}

/// Volumes of voxels: scans, and label maps of segmentations.
bool is_image(const std::string& name) {
  for (const std::string_view ending : {".nii", ".nii.gz", ".nrrd", ".nhdr", ".mha", ".mhd", ".mgz", ".dcm"})
    if (name.ends_with(ending)) return true;
  return false;
}

}  // namespace

MeshFormat mesh_format_of(const std::filesystem::path& path) {
  const auto extension = io::lower_case(path.extension().string());
  if (extension == ".stl") return MeshFormat::stl;
  if (extension == ".obj") return MeshFormat::obj;
  if (extension == ".ply") return MeshFormat::ply;
  if (extension == ".vtp") return MeshFormat::vtp;
  if (extension == ".vtk") return MeshFormat::vtk;
  if (is_image(io::lower_case(path.filename().string())))
    throw FileError(fmt::format(
        "{}: an image or label map is no mesh: .stl, .obj, .ply, .vtp and .vtk are read. Export the "
        "surface of each bone from the program that segmented it (3D Slicer: Segmentations, Export to "
        "files, STL)",
        path.string()));
  throw FileError(fmt::format("{}: unknown extension '{}': .stl, .obj, .ply, .vtp and .vtk are read",
                              path.string(), path.extension().string()));
}

MeshFile read_mesh(std::string_view bytes, MeshFormat format, std::string_view name, PolygonRule polygons) {
  const Source source{bytes, name, polygons};
  if (bytes.empty()) source.fail("the file is empty");
  RawMesh raw = read_raw(source, format);
  MeshFile file{.mesh = {}, .split_polygons = raw.polygons.size()};
  file.mesh = checked(std::move(raw), source);
  if (format == MeshFormat::stl) file.welded_vertices = weld_exactly(file.mesh);
  return file;
}

}  // namespace condyle::io
