#include "condyle/io/mesh_file.hpp"
#include "support/mesh_bytes.hpp"
#include "support/same_bits.hpp"
#include "support/test.hpp"

namespace condyle {
namespace {

/// Coordinates that a float holds, none of them a round decimal, one of them -0.
TriMesh float_valued_mesh() {
  return test::in_floats(test::sphere({0.1, -20.3, 300.7}, 25.1, 2));
}

/// STL stores no vertex numbers: vertices come back in the order in which triangles use them.
TriMesh in_order_of_use(const TriMesh& mesh) {
  TriMesh out;
  std::vector<Index> number(mesh.vertices.size(), no_index);
  for (const auto& triangle : mesh.triangles) {
    auto& renumbered = out.triangles.emplace_back();
    for (int k = 0; k < 3; ++k) {
      auto& n = number[triangle[k]];
      if (n == no_index) {
        n = static_cast<Index>(out.vertices.size());
        out.vertices.push_back(mesh.vertices[triangle[k]]);
      }
      renumbered[k] = n;
    }
  }
  return out;
}

using test::expect_same_bits;

TEST(MeshFormats, EveryWayOfWritingAMeshReadsBackBitForBit) {
  const TriMesh mesh = float_valued_mesh();
  std::size_t compared = 0;
  for (const auto& file : test::all_files(mesh)) {
    if (!file.exact) continue;
    ++compared;
    const auto read = io::read_mesh(file.bytes, file.format, file.name);
    expect_same_bits(read.mesh, file.format == io::MeshFormat::stl ? in_order_of_use(mesh) : mesh, file.name);
  }
  EXPECT_GT(compared, 40u);
}

TEST(MeshFormats, DoublesKeepTheirLastBitWhereTheFormatHasDoubles) {
  const TriMesh mesh = test::sphere({0.1, -20.3, 300.7}, 25.1, 2);
  std::size_t with_doubles = 0;
  for (const auto& file : test::all_files(mesh)) {
    const bool doubles = file.name.find("double") != std::string::npos || file.format == io::MeshFormat::obj;
    if (!file.exact || !doubles) continue;
    ++with_doubles;
    expect_same_bits(io::read_mesh(file.bytes, file.format, file.name).mesh, mesh, file.name);
  }
  EXPECT_GT(with_doubles, 20u);
}

TEST(MeshFormats, VtkReadsItsFilesAsWeDo) {
  const TriMesh mesh = test::torus(30.1, 7.7, 12, 7);
  for (auto* written : {test::vtp_files, test::legacy_vtk_files}) {
    for (const auto& file : written(mesh)) {
      expect_same_bits(io::read_mesh(file.bytes, file.format, file.name).mesh, test::as_vtk_reads(file),
                       file.name);
    }
  }
}

TEST(MeshFormats, AnStlSoupIsWeldedWithoutTolerance) {
  const double next = std::nextafter(1.0, 2.0);
  TriMesh soup = test::mesh_of({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {-0.0, 0, 0}, {0, 1, -0.0}, {next, 0, 0}},
                               {{0, 1, 2}, {3, 4, 5}});
  const auto read = io::read_mesh(test::stl_files(soup)[0].bytes, io::MeshFormat::stl, "soup.stl");
  EXPECT_EQ(read.welded_vertices, 2u);
  EXPECT_EQ(read.mesh.triangles, (std::vector<Triangle>{{0, 1, 2}, {0, 2, 3}}));
  EXPECT_EQ(read.mesh.vertices.x[3], next);
}

TEST(MeshFormats, TextStlMayHoldSeveralSolidsAndCapitals) {
  const std::string solid =
      "SOLID one\r\nFACET NORMAL 0 0 1\r\nOUTER LOOP\r\nVERTEX 0 0 0\r\nVERTEX +1.0E0 0 0\r\nVERTEX 0 1 "
      "0\r\nENDLOOP\r\n"
      "ENDFACET\r\nENDSOLID one\r\n";
  const auto read = io::read_mesh(solid + solid, io::MeshFormat::stl, "two.stl");
  EXPECT_EQ(read.mesh.triangles.size(), 2u);
  EXPECT_EQ(read.welded_vertices, 3u);
}

TEST(MeshFormats, ObjVertexWeightsAndColoursAreNoCoordinates) {
  const auto read =
      io::read_mesh("v 0 0 0 1\nv 1 0 0 0.5 0.5 0.5\nv 0 1 0\nf 1 2 3\n", io::MeshFormat::obj, "colours.obj");
  EXPECT_EQ(read.mesh.vertices.size(), 3u);
  EXPECT_EQ(read.mesh.vertices[1], Vec3(1, 0, 0));
}

TEST(MeshFormats, NumbersDeclaredFloatAreRoundedToFloatOnce) {
  // Between two floats, a hair beyond the middle: by way of a double it would fall back to the even one.
  const std::string text =
      "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty float z\n"
      "element face 1\nproperty list uchar int vertex_indices\nend_header\n"
      "1.00000005960464477539062500001 0 0\n1 0 0\n0 1 0\n3 0 1 2\n";
  EXPECT_EQ(io::read_mesh(text, io::MeshFormat::ply, "a.ply").mesh.vertices.x[0], 1 + 0x1p-23);
}

}  // namespace
}  // namespace condyle
