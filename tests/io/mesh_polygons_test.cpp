#include <gtest/gtest.h>

#include <fmt/format.h>

#include <string>

#include "condyle/error.hpp"
#include "condyle/inspect.hpp"
#include "condyle/io/mesh_file.hpp"

// Polygons of more than three corners: refused, or split as asked.

namespace condyle {
namespace {

constexpr std::string_view corners_of_box = "0 0 0\n2 0 0\n2 3 0\n0 3 0\n0 0 4\n2 0 4\n2 3 4\n0 3 4\n";
constexpr int quads[6][4] = {{0, 3, 2, 1}, {4, 5, 6, 7}, {0, 1, 5, 4},
                             {1, 2, 6, 5}, {2, 3, 7, 6}, {3, 0, 4, 7}};

std::string obj_box() {
  std::string text;
  for (std::size_t at = 0; at < corners_of_box.size();) {
    const std::size_t end = corners_of_box.find('\n', at);
    text += fmt::format("v {}\n", corners_of_box.substr(at, end - at));
    at = end + 1;
  }
  for (const auto& quad : quads)
    text += fmt::format("f {} {} {} {}\n", quad[0] + 1, quad[1] + 1, quad[2] + 1, quad[3] + 1);
  return text;
}

std::string ply_box() {
  std::string text = fmt::format(
      "ply\nformat ascii 1.0\nelement vertex 8\nproperty float x\nproperty float y\nproperty float z\n"
      "element face 6\nproperty list uchar int vertex_indices\nend_header\n{}",
      corners_of_box);
  for (const auto& quad : quads) text += fmt::format("4 {} {} {} {}\n", quad[0], quad[1], quad[2], quad[3]);
  return text;
}

std::string vtp_box() {
  std::string connectivity, offsets;
  for (int i = 0; i < 6; ++i) {
    connectivity += fmt::format("{} {} {} {} ", quads[i][0], quads[i][1], quads[i][2], quads[i][3]);
    offsets += fmt::format("{} ", 4 * (i + 1));
  }
  return fmt::format(
      R"(<VTKFile type="PolyData" version="0.1" byte_order="LittleEndian"><PolyData>
<Piece NumberOfPoints="8" NumberOfVerts="0" NumberOfLines="0" NumberOfStrips="0" NumberOfPolys="6">
<Points><DataArray type="Float32" NumberOfComponents="3" format="ascii">{}</DataArray></Points>
<Polys><DataArray type="Int32" Name="connectivity" format="ascii">{}</DataArray>
<DataArray type="Int32" Name="offsets" format="ascii">{}</DataArray></Polys></Piece></PolyData></VTKFile>)",
      corners_of_box, connectivity, offsets);
}

std::string vtk_box() {
  std::string text = fmt::format(
      "# vtk DataFile Version 3.0\nbox\nASCII\nDATASET POLYDATA\nPOINTS 8 float\n{}POLYGONS 6 30\n",
      corners_of_box);
  for (const auto& quad : quads) text += fmt::format("4 {} {} {} {}\n", quad[0], quad[1], quad[2], quad[3]);
  return text;
}

TEST(Polygons, AreSplitIntoTheSameTrianglesOfEveryFormat) {
  const std::pair<std::string, io::MeshFormat> files[] = {{obj_box(), io::MeshFormat::obj},
                                                          {ply_box(), io::MeshFormat::ply},
                                                          {vtp_box(), io::MeshFormat::vtp},
                                                          {vtk_box(), io::MeshFormat::vtk}};
  const TriMesh first = io::read_mesh(files[0].first, files[0].second, "box", io::PolygonRule::split).mesh;
  for (const auto& [bytes, format] : files) {
    EXPECT_THROW(io::read_mesh(bytes, format, "box"), FileError);
    const io::MeshFile file = io::read_mesh(bytes, format, "box", io::PolygonRule::split);
    EXPECT_EQ(file.split_polygons, 6u);
    EXPECT_EQ(file.mesh, first);
    const MeshReport report = inspect(file.mesh);
    EXPECT_TRUE(report.is_closed());
    EXPECT_DOUBLE_EQ(report.signed_volume.value(), 24);
    EXPECT_DOUBLE_EQ(report.area, 2 * (6 + 8 + 12));
  }
}

TriMesh split(std::string_view vertices, std::string_view face) {
  return io::read_mesh(fmt::format("{}\n{}", vertices, face), io::MeshFormat::obj, "bone",
                       io::PolygonRule::split)
      .mesh;
}

std::string refusal(std::string_view vertices, std::string_view face) {
  try {
    split(vertices, face);
  } catch (const FileError& error) {
    return error.what();
  }
  return "accepted";
}

TEST(Polygons, KeepTheirPlaceAmongTriangles) {
  const TriMesh mesh = split("v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nv 5 5 5", "f 1 2 5\nf 1 2 3 4\nf 2 3 5");
  const std::vector<Triangle> wanted = {{0, 1, 4}, {0, 1, 2}, {0, 2, 3}, {1, 2, 4}};
  EXPECT_EQ(mesh.triangles, wanted);
}

TEST(Polygons, AreSplitRoundACornerThatSeesTheWhole) {
  // A dart: only its tip and the corner turned inwards see all of it.
  const TriMesh dart = split("v 0 0 0\nv 2 1 0\nv 0 2 0\nv 1 1 0", "f 1 2 3 4");
  const std::vector<Triangle> wanted = {{1, 2, 3}, {1, 3, 0}};
  EXPECT_EQ(dart.triangles, wanted);
  EXPECT_DOUBLE_EQ(inspect(dart).area, 1);
}

TEST(Polygons, MayHaveCornersOnALine) {
  const TriMesh mesh = split("v 0 0 0\nv 1 0 0\nv 2 0 0\nv 2 2 0\nv 1 2 0\nv 0 2 0", "f 1 2 3 4 5 6");
  EXPECT_EQ(mesh.triangles.size(), 4u);
  EXPECT_DOUBLE_EQ(inspect(mesh).area, 4);
}

TEST(Polygons, AreRefusedWhereNoCornerSeesTheWhole) {
  const std::string comb = "v 0 0 0\nv 7 0 0\nv 7 3 0\nv 5 3 0\nv 5 1 0\nv 2 1 0\nv 2 3 0\nv 0 3 0";
  EXPECT_EQ(refusal(comb, "f 1 2 3 4 5 6 7 8"),
            "bone: face 0 of 8 corners is convex from none of them: it cannot be split");
  EXPECT_EQ(refusal("v 0 0 0\nv 1 0 0\nv 2 0 0\nv 3 0 0", "f 1 2 3 4"),
            "bone: face 0 of 4 corners is convex from none of them: it cannot be split");
  EXPECT_EQ(refusal("v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0", "f 1 2 3 5"), "bone: face 0 uses vertex 4 of 4");
  std::string many = "f";
  for (int i = 0; i < 101; ++i) many += fmt::format(" {}", 1 + i % 4);
  EXPECT_EQ(refusal("v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0", many),
            "bone: face 0 has 101 corners: polygons of more than 100 are not split");
}

}  // namespace
}  // namespace condyle
