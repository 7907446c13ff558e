#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "condyle/mesh.hpp"

/// Mesh files in and out. Every function here raises FileError, one line "file: element: what is wrong", and
/// nothing else, whatever the file holds. Elements are counted from 0 as ParaView shows them; lines, and the
/// vertex numbers of an OBJ file, from 1 as the format does.

namespace condyle::io {

/// Identifies a file by its contents, whatever its name and date.
struct FileDigest {
  std::uintmax_t bytes = 0;
  std::string sha256;  ///< 64 hexadecimal digits, as `sha256sum` prints them

  friend bool operator==(const FileDigest&, const FileDigest&) = default;
};

/// Digest of a file's whole contents. Some 3 ms per MB.
[[nodiscard]] FileDigest digest_of(std::string_view contents);

/// A mesh as its file has it, in the file's own unit: a mesh file does not say which one that is.
struct MeshFile {
  TriMesh mesh;  ///< every index in range, every coordinate finite, at least one triangle
  /// STL only: duplicate corners that were merged with an earlier one.
  std::size_t welded_vertices = 0;
  std::size_t split_polygons = 0;    ///< into triangles, as asked
  std::size_t guessed_polygons = 0;  ///< of these, twisted or crossing themselves: their surface is a guess
  double guessed_within = 0;         ///< how far their corners are from one plane, at most
};

/// Polygons of more than three corners. A file does not say what surface is inside of one: `split` takes the triangles round
/// its first corner from which all of them turn one way; of a flat one without such a corner any, since all cover the same. It refuses a
/// twisted one without such a corner, and one that crosses itself; `guess` splits these too: docs/mesh-files.md.
enum class PolygonRule { refuse, split, guess };

enum class MeshFormat { stl, obj, ply, vtp, vtk };

/// Reads .stl (text and binary), .obj, .ply, .vtp (XML PolyData) or .vtk (legacy PolyData); the extension
/// decides, in upper or lower case. Coordinates keep every bit the file gives.
[[nodiscard]] MeshFile read_mesh(const std::filesystem::path& path,
                                 PolygonRule polygons = PolygonRule::refuse);

/// The same from memory; `name` is what errors call the file.
[[nodiscard]] MeshFile read_mesh(std::string_view bytes, MeshFormat format, std::string_view name,
                                 PolygonRule polygons = PolygonRule::refuse);

/// The format that the extension names.
[[nodiscard]] MeshFormat mesh_format_of(const std::filesystem::path& path);

/// Writes .vtp or .ply, as the extension says: binary, in floats where every coordinate is one and else in
/// doubles, so that reading gives the same bits back. The file appears whole under its name or not at all.
void write_mesh(const std::filesystem::path& path, const TriMesh& mesh);

/// Throws what write_mesh() throws for a file whose extension it does not write.
void check_written_mesh(const std::filesystem::path& path);

/// A named array with one value per vertex or per triangle.
struct MeshArray {
  std::string name;
  std::variant<std::vector<double>, std::vector<std::int32_t>, std::vector<std::uint8_t>> values;
};

/// How a VTP file holds numbers: as bytes, or as text to the last bit, which OpenSim asks for.
enum class VtpEncoding { binary, text };

/// A named value of the whole file: a text, or numbers.
struct VtpField {
  std::string name;
  std::variant<std::string, std::vector<double>> value;
};

struct VtpOptions {
  VtpEncoding encoding = VtpEncoding::binary;
  std::vector<VtpField> fields = {};
};

/// Writes a mesh with its results as XML PolyData, for ParaView and 3D Slicer. Point arrays have one value
/// per vertex, cell arrays one per triangle; the first of each is what viewers colour by.
void write_vtp(const std::filesystem::path& path, const TriMesh& mesh,
               std::span<const MeshArray> point_arrays, std::span<const MeshArray> cell_arrays,
               const VtpOptions& options = {});

}  // namespace condyle::io
