#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <limits>

#include "condyle/error.hpp"
#include "condyle/io/mesh_file.hpp"
#include "support/mesh_bytes.hpp"
#include "support/test_meshes.hpp"

namespace condyle {
namespace {

/// Message of the reader's error; "read" if there is none.
std::string complaint(std::string_view bytes, io::MeshFormat format, std::string_view name = "bone") {
  try {
    io::read_mesh(bytes, format, name);
  } catch (const FileError& error) {
    return error.what();
  }
  return "read";
}

std::string complaint(const std::filesystem::path& path) {
  try {
    io::read_mesh(path);
  } catch (const FileError& error) {
    return error.what();
  }
  return "read";
}

std::string with(std::string text, std::string_view old_part, std::string_view new_part) {
  const auto at = text.find(old_part);
  EXPECT_NE(at, std::string::npos) << old_part;
  return text.replace(at, old_part.size(), new_part);
}

template <class T>
std::string with_value(std::string bytes, std::size_t at, T value) {
  return bytes.replace(at, sizeof value, reinterpret_cast<const char*>(&value), sizeof value);
}

const TriMesh tetrahedron = {
    [] {
      Points points;
      for (const Vec3& p : {Vec3(0, 0, 0), Vec3(40, 0, 0), Vec3(0, 30, 0), Vec3(0, 0, 20)}) {
        points.push_back(p);
      }
      return points;
    }(),
    {{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {0, 3, 2}}};

const std::string ply_header =
    "ply\nformat ascii 1.0\nelement vertex 3\nproperty double x\nproperty double y\nproperty double z\n"
    "element face 1\nproperty list uchar int vertex_indices\nend_header\n";
const std::string ply_text = ply_header + "0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n";
const std::string obj_text = "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n";
const std::string stl_text =
    "solid s\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 0 1 "
    "0\nendloop\nendfacet\nendsolid s\n";
const std::string vtp_text =
    "<?xml version=\"1.0\"?>\n<VTKFile type=\"PolyData\" version=\"0.1\" "
    "byte_order=\"LittleEndian\">\n<PolyData>\n"
    "<Piece NumberOfPoints=\"3\" NumberOfVerts=\"0\" NumberOfLines=\"0\" NumberOfStrips=\"0\" "
    "NumberOfPolys=\"1\">\n"
    "<Points>\n<DataArray type=\"Float64\" NumberOfComponents=\"3\" format=\"ascii\">\n0 0 0\n1 0 0\n0 1 "
    "0\n</DataArray>\n"
    "</Points>\n<Polys>\n<DataArray type=\"Int32\" Name=\"connectivity\" format=\"ascii\">0 1 2</DataArray>\n"
    "<DataArray type=\"Int32\" Name=\"offsets\" "
    "format=\"ascii\">3</DataArray>\n</Polys>\n</Piece>\n</PolyData>\n"
    "</VTKFile>\n";
const std::string vtk_text =
    "# vtk DataFile Version 4.2\na bone\nASCII\nDATASET POLYDATA\nPOINTS 3 double\n0 0 0\n1 0 0\n0 1 "
    "0\nPOLYGONS 1 4\n"
    "3 0 1 2\n";

class Folder {
 public:
  Folder()
      : path_(std::filesystem::temp_directory_path() / ("condyle_bad_input_" + std::to_string(::getpid()))) {
    std::filesystem::create_directories(path_);
  }
  ~Folder() { std::filesystem::remove_all(path_); }
  Folder(const Folder&) = delete;
  Folder& operator=(const Folder&) = delete;

  std::filesystem::path operator/(const std::string& name) const { return path_ / name; }

 private:
  std::filesystem::path path_;
};

TEST(BadMeshFile, TheFilesThatTheOthersAreMadeFromAreGood) {
  EXPECT_EQ(complaint(ply_text, io::MeshFormat::ply), "read");
  EXPECT_EQ(complaint(obj_text, io::MeshFormat::obj), "read");
  EXPECT_EQ(complaint(stl_text, io::MeshFormat::stl), "read");
  EXPECT_EQ(complaint(vtp_text, io::MeshFormat::vtp), "read");
  EXPECT_EQ(complaint(vtk_text, io::MeshFormat::vtk), "read");
}

TEST(BadMeshFile, AMissingFileAFolderAndAnUnknownExtensionAreNamed) {
  const Folder folder;
  const auto missing = folder / "femur.stl", inside = folder / "meshes", unknown = folder / "femur.step";
  std::filesystem::create_directories(inside);
  std::ofstream(unknown) << obj_text;
  EXPECT_EQ(complaint(missing), missing.string() + ": no such file");
  EXPECT_EQ(complaint(inside), inside.string() + ": is a folder, not a file");
  EXPECT_EQ(complaint(unknown),
            unknown.string() + ": unknown extension '.step': .stl, .obj, .ply, .vtp and .vtk are read");
}

TEST(BadMeshFile, AJointFileIsNamedAsThat) {
  const Folder folder;
  const std::string joint = (folder / "hip.toml").string();
  std::ofstream(joint) << "condyle = 1\n";
  EXPECT_EQ(complaint(joint), joint + ": is a joint file, not a mesh: condyle rom " + joint +
                                  " has its limits, condyle frame " + joint +
                                  " shows its bodies; .stl, .obj, .ply, .vtp and .vtk are read");
}

TEST(BadMeshFile, ExtensionsMayBeInCapitals) {
  const Folder folder;
  std::ofstream(folder / "FEMUR.PLY") << ply_text;
  EXPECT_EQ(complaint(folder / "FEMUR.PLY"), "read");
}

TEST(BadMeshFile, AnEmptyFileIsSaidToBeEmptyInEveryFormat) {
  for (const auto format : {io::MeshFormat::stl, io::MeshFormat::obj, io::MeshFormat::ply,
                            io::MeshFormat::vtp, io::MeshFormat::vtk}) {
    EXPECT_EQ(complaint("", format), "bone: the file is empty");
  }
}

/// A cut leaves either nothing to be read, or the whole mesh where only a line end or a closing remark went.
/// In an OBJ file nothing says where it ends: one cut at a line's end is a smaller mesh, and only that.
TEST(BadMeshFile, ACutAnywhereIsNoticedInEveryEncoding) {
  for (const auto& file : test::all_files(tetrahedron)) {
    const TriMesh whole = io::read_mesh(file.bytes, file.format, file.name).mesh;
    int refused = 0;
    for (std::size_t size = 0; size < file.bytes.size(); ++size) {
      try {
        const TriMesh cut =
            io::read_mesh(std::string_view(file.bytes).substr(0, size), file.format, "cut").mesh;
        if (file.format == io::MeshFormat::obj) {
          ASSERT_LE(cut.triangles.size(), whole.triangles.size());
          ASSERT_TRUE(std::equal(cut.triangles.begin(), cut.triangles.end(), whole.triangles.begin()))
              << file.name << " at " << size;
        } else {
          ASSERT_EQ(cut, whole) << file.name << " at " << size;
        }
      } catch (const FileError& error) {
        const std::string line = error.what();
        ASSERT_EQ(line.rfind("cut: ", 0), 0u) << line;
        ASSERT_EQ(line.find('\n'), std::string::npos) << line;
        ++refused;
      }
    }
    EXPECT_GT(refused, 0) << file.name;
  }
}

TEST(BadMeshFile, ACutSaysWhereTheFileEnds) {
  const auto stl = test::stl_files(tetrahedron)[1].bytes;
  EXPECT_EQ(complaint(std::string_view(stl).substr(0, 200), io::MeshFormat::stl),
            "bone: header: 4 triangles need 284 bytes, the file has 200");
  EXPECT_EQ(complaint(std::string_view("\x01\x02 not long enough"), io::MeshFormat::stl),
            "bone: header: the file has 18 bytes, an STL file at least 84");
  EXPECT_EQ(complaint(std::string_view(stl_text).substr(0, stl_text.find("endsolid")), io::MeshFormat::stl),
            "bone: line 9: the file ends before 'endsolid'");
  EXPECT_EQ(
      complaint(std::string_view(stl_text).substr(0, stl_text.find(" 0 0\nvertex 0 1")), io::MeshFormat::stl),
      "bone: line 5: the file ends where a coordinate should be");
  EXPECT_EQ(complaint(std::string_view(obj_text).substr(0, obj_text.size() - 3), io::MeshFormat::obj),
            "bone: line 4: face 0 has 2 corners: only triangles are read");
  EXPECT_EQ(complaint("v 0 0 0\nv 1 0", io::MeshFormat::obj),
            "bone: line 2: a vertex needs three coordinates");
  EXPECT_EQ(complaint("ply\nformat ascii 1.0\n", io::MeshFormat::ply),
            "bone: header: the file ends before 'end_header'");
  EXPECT_EQ(complaint(std::string_view(ply_text).substr(0, ply_text.size() - 3), io::MeshFormat::ply),
            "bone: face 0: a list of 3 values does not fit the file");
  EXPECT_EQ(complaint(std::string_view(vtp_text).substr(0, vtp_text.find("</Points>")), io::MeshFormat::vtp),
            "bone: line 11: the file ends before '</Points>'");
  EXPECT_EQ(complaint(std::string_view(vtk_text).substr(0, vtk_text.size() - 3), io::MeshFormat::vtk),
            "bone: polygons: 4 numbers announced, the file ends before");
}

TEST(BadMeshFile, ACoordinateThatIsNoFiniteNumberNamesItsVertex) {
  EXPECT_EQ(complaint(with(ply_text, "1 0 0", "1 nan 0"), io::MeshFormat::ply),
            "bone: vertex 1: coordinate y is nan");
  EXPECT_EQ(complaint(with(ply_text, "0 1 0\n", "0 1 -inf\n"), io::MeshFormat::ply),
            "bone: vertex 2: coordinate z is -inf");
  EXPECT_EQ(complaint(with(obj_text, "v 1 0 0", "v inf 0 0"), io::MeshFormat::obj),
            "bone: vertex 1: coordinate x is inf");
  EXPECT_EQ(complaint(with(stl_text, "vertex 0 1 0", "vertex 0 NaN 0"), io::MeshFormat::stl),
            "bone: vertex 2: coordinate y is nan");
  EXPECT_EQ(complaint(with(vtp_text, "0 1 0", "0 1 INF"), io::MeshFormat::vtp),
            "bone: vertex 2: coordinate z is inf");
  EXPECT_EQ(complaint(with(vtk_text, "0 1 0", "0 1 nan"), io::MeshFormat::vtk),
            "bone: vertex 2: coordinate z is nan");

  // Triangle 2, second corner, y, in binary: 84 bytes of header, 50 a triangle, 12 of normal, 12 a corner.
  const auto stl = test::stl_files(tetrahedron)[1].bytes;
  EXPECT_EQ(complaint(with_value(stl, 84 + 2 * 50 + 12 + 12 + 4, std::numeric_limits<float>::infinity()),
                      io::MeshFormat::stl),
            "bone: vertex 7: coordinate y is inf");
}

TEST(BadMeshFile, AnIndexOutOfRangeNamesItsTriangle) {
  EXPECT_EQ(complaint(with(ply_text, "3 0 1 2", "3 0 1 3"), io::MeshFormat::ply, "femur.ply"),
            "femur.ply: triangle 0 uses vertex 3 of 3");
  EXPECT_EQ(complaint(with(ply_text, "3 0 1 2", "3 0 -1 2"), io::MeshFormat::ply),
            "bone: triangle 0 uses vertex -1 of 3");
  EXPECT_EQ(complaint(with(obj_text, "f 1 2 3", "f 1 2 4"), io::MeshFormat::obj),
            "bone: line 4: face uses vertex 4 of 3");
  EXPECT_EQ(complaint(with(obj_text, "f 1 2 3", "f -1 -2 -4"), io::MeshFormat::obj),
            "bone: line 4: face uses vertex -4 after 3 vertices");
  EXPECT_EQ(complaint(with(obj_text, "f 1 2 3", "f 0 1 2"), io::MeshFormat::obj),
            "bone: line 4: '0' should be a vertex number, from 1 or, counted back, from -1");
  EXPECT_EQ(complaint(with(vtp_text, "0 1 2", "0 1 2147483647"), io::MeshFormat::vtp),
            "bone: triangle 0 uses vertex 2147483647 of 3");
  EXPECT_EQ(complaint(with(vtk_text, "3 0 1 2", "3 0 1 9"), io::MeshFormat::vtk),
            "bone: triangle 0 uses vertex 9 of 3");
  // Beyond 64 signed bits.
  EXPECT_EQ(complaint(with(with(vtp_text, "Int32", "UInt64"), "0 1 2<", "0 1 18446744073709551615<"),
                      io::MeshFormat::vtp),
            "bone: triangle 0 uses vertex 9223372036854775807 of 3");
}

TEST(BadMeshFile, CountsThatTheFileCannotHoldAreNotBelieved) {
  EXPECT_EQ(complaint(with(ply_text, "vertex 3", "vertex 99999999999"), io::MeshFormat::ply),
            "bone: header: 99999999999 elements 'vertex' announced, more than the rest of the file can hold");
  EXPECT_EQ(complaint(with(ply_text, "face 1", "face 18446744073709551615"), io::MeshFormat::ply),
            "bone: header: 18446744073709551615 elements 'face' announced, more than the rest of the file "
            "can hold");
  EXPECT_EQ(complaint(with(ply_text, "vertex 3", "vertex -3"), io::MeshFormat::ply),
            "bone: line 3: '-3' should be the count of elements 'vertex'");
  EXPECT_EQ(complaint(with(ply_text, "3 0 1 2", "255 0 1 2"), io::MeshFormat::ply),
            "bone: face 0: a list of 255 values does not fit the file");
  EXPECT_EQ(
      complaint(with_value(test::stl_files(tetrahedron)[1].bytes, 80, 0xffffffffu), io::MeshFormat::stl),
      "bone: header: 4294967295 triangles need 214748364834 bytes, the file has 284");
  EXPECT_EQ(complaint(with(vtp_text, "NumberOfPoints=\"3\"", "NumberOfPoints=\"99999999999\""),
                      io::MeshFormat::vtp),
            "bone: array 'Points': has not the 299999999997 numbers that its piece announces");
  EXPECT_EQ(complaint(with(vtp_text, "NumberOfPolys=\"1\"", "NumberOfPolys=\"18446744073709551615\""),
                      io::MeshFormat::vtp),
            "bone: piece 0: announces more than any file can hold");
  EXPECT_EQ(complaint(with(vtp_text, "NumberOfPolys=\"1\"", "NumberOfPolys=\"-1\""), io::MeshFormat::vtp),
            "bone: line 4: '-1' should be 'NumberOfPolys'");
  EXPECT_EQ(complaint(with(vtk_text, "POINTS 3", "POINTS 99999999999"), io::MeshFormat::vtk),
            "bone: points: 299999999997 numbers announced, the file ends before");
  EXPECT_EQ(complaint(with(vtk_text, "POLYGONS 1 4", "POLYGONS 1 99999999999"), io::MeshFormat::vtk),
            "bone: polygons: 99999999999 numbers announced, the file ends before");
  EXPECT_EQ(complaint(with(vtk_text, "POLYGONS 1 4", "POLYGONS 99999999999 4"), io::MeshFormat::vtk),
            "bone: polygons: 99999999999 cells in 4 numbers");
  EXPECT_EQ(complaint(with(vtk_text, "POINTS 3", "POINTS -3"), io::MeshFormat::vtk),
            "bone: line 5: '-3' should be the number of points");
}

TEST(BadMeshFile, CountsTooSmallLeaveSomethingOverAndAreNoticed) {
  EXPECT_EQ(complaint(with(ply_text, "3 0 1 2\n", "3 0 1 2\n3 1 2 0\n"), io::MeshFormat::ply),
            "bone: 8 bytes after the last element");
  EXPECT_EQ(
      complaint(test::stl_files(tetrahedron)[1].bytes.substr(5) + "12345", io::MeshFormat::stl).substr(0, 14),
      "bone: header: ");
  EXPECT_EQ(complaint(with(vtp_text, "0 1 0\n", "0 1 0\n1 1 1\n"), io::MeshFormat::vtp),
            "bone: array 'Points': has more than the 9 numbers that its piece announces");
  EXPECT_EQ(complaint(with(vtk_text, "3 0 1 2\n", "3 0 1 2\n3 1 2 0\n"), io::MeshFormat::vtk),
            "bone: line 11: '3' is no section of a PolyData file");
}

TEST(BadMeshFile, AWordThatIsNoNumberNamesItsLine) {
  EXPECT_EQ(complaint(with(ply_text, "1 0 0", "1 O 0"), io::MeshFormat::ply),
            "bone: line 11: 'O' should be a number of its declared type");
  EXPECT_EQ(complaint(with(ply_text, "1 0 0", "1 0,5 0"), io::MeshFormat::ply),
            "bone: line 11: '0,5' should be a number of its declared type");
  EXPECT_EQ(complaint(with(ply_text, "1 0 0", "1e999 0 0"), io::MeshFormat::ply),
            "bone: line 11: '1e999' should be a number of its declared type");
  EXPECT_EQ(complaint(with(ply_text, "3 0 1 2", "3 0 1 1.5"), io::MeshFormat::ply),
            "bone: line 13: '1.5' should be a number of its declared type");
  EXPECT_EQ(complaint(with(obj_text, "v 1 0 0", "v 1 0 0x"), io::MeshFormat::obj),
            "bone: line 2: '0x' should be a coordinate");
  EXPECT_EQ(complaint(with(stl_text, "vertex 1 0 0", "vertex 1 - 0"), io::MeshFormat::stl),
            "bone: line 5: '-' should be a coordinate");
  EXPECT_EQ(complaint(with(vtp_text, "1 0 0", "1 zero 0"), io::MeshFormat::vtp),
            "bone: line 8: 'zero' should be a number of array Points");
  EXPECT_EQ(complaint(with(vtk_text, "1 0 0", "1 zero 0"), io::MeshFormat::vtk),
            "bone: line 7: 'zero' should be a number");
}

TEST(BadMeshFile, VerticesWithoutTrianglesAreNoMesh) {
  EXPECT_EQ(complaint("v 0 0 0\nv 1 0 0\n", io::MeshFormat::obj), "bone: holds 2 vertices but no triangles");
  EXPECT_EQ(complaint("# nothing\n", io::MeshFormat::obj), "bone: holds no vertices");
  EXPECT_EQ(complaint("solid s\nendsolid s\n", io::MeshFormat::stl), "bone: holds no vertices");
  EXPECT_EQ(complaint(with(with(ply_text, "face 1", "face 0"), "3 0 1 2\n", ""), io::MeshFormat::ply),
            "bone: holds 3 vertices but no triangles");
  EXPECT_EQ(complaint(with(vtk_text, "POLYGONS 1 4\n3 0 1 2\n", ""), io::MeshFormat::vtk),
            "bone: holds 3 vertices but no triangles");
}

TEST(BadMeshFile, PolygonsThatAreNoTrianglesAreRefusedByName) {
  EXPECT_EQ(complaint(with(ply_text, "3 0 1 2", "4 0 1 2 1"), io::MeshFormat::ply),
            "bone: face 0 has 4 corners: only triangles are read, unless polygons are to be split "
            "(--polygons split)");
  EXPECT_EQ(complaint(with(obj_text, "f 1 2 3", "f 1 2 3\nf 1 2 3 1"), io::MeshFormat::obj),
            "bone: line 5: face 1 has 4 corners: only triangles are read, unless polygons are to be split "
            "(--polygons split)");
  EXPECT_EQ(complaint(with(with(vtp_text, "0 1 2", "0 1 2 1"), ">3<", ">4<"), io::MeshFormat::vtp),
            "bone: polygon 0 has 4 corners: only triangles are read, unless polygons are to be split "
            "(--polygons split)");
  EXPECT_EQ(complaint(with(vtp_text, "NumberOfStrips=\"0\"", "NumberOfStrips=\"1\""), io::MeshFormat::vtp),
            "bone: no array 'Strips offsets'");
  EXPECT_EQ(complaint(with(vtk_text, "POLYGONS 1 4\n3 0 1 2", "POLYGONS 1 3\n2 0 1"), io::MeshFormat::vtk),
            "bone: polygon 0 has 2 corners: only triangles are read");
}

TEST(BadMeshFile, OneFormatUnderTheNameOfAnotherIsRefused) {
  EXPECT_EQ(complaint(obj_text, io::MeshFormat::ply), "bone: line 1: should be 'ply'");
  EXPECT_EQ(complaint(ply_text, io::MeshFormat::obj), "bone: line 1: 'ply' is no OBJ statement that is read");
  EXPECT_EQ(complaint(vtp_text, io::MeshFormat::vtk), "bone: line 1: should be '# vtk DataFile Version ...'");
  EXPECT_EQ(complaint(vtk_text, io::MeshFormat::vtp), "bone: line 11: no XML tag");
  EXPECT_EQ(complaint(with(vtp_text, "PolyData", "UnstructuredGrid"), io::MeshFormat::vtp),
            "bone: line 2: holds 'UnstructuredGrid': only 'PolyData' is read");
  EXPECT_EQ(complaint(with(vtk_text, "POLYDATA", "STRUCTURED_POINTS"), io::MeshFormat::vtk),
            "bone: line 4: holds 'STRUCTURED_POINTS': only 'POLYDATA' is read");
}

/// One zlib-compressed file with raw appended data and lengths of four bytes: number of blocks, size of a
/// block, size of the last one, compressed sizes; then the blocks.
TEST(BadMeshFile, DamagedCompressedDataIsNoticedWithoutAWordFromVtk) {
  const auto files = test::vtp_files(tetrahedron);
  const auto file = std::find_if(files.begin(), files.end(), [](const auto& candidate) {
    return candidate.name == "vtp appended raw zlib UInt32 little float";
  });
  ASSERT_NE(file, files.end());
  const std::string& good = file->bytes;
  const auto lengths_in = [](const std::string& bytes) {  // where the lengths before the points are
    const auto attribute =
        bytes.find("offset=\"", bytes.find("<Points>")) + std::string_view("offset=\"").size();
    return bytes.find('_', bytes.find("<AppendedData")) + 1 + std::stoul(bytes.substr(attribute));
  };
  const auto lengths = lengths_in(good);
  ASSERT_EQ(complaint(good, io::MeshFormat::vtp), "read");

  testing::internal::CaptureStderr();
  EXPECT_EQ(complaint(with_value(good, lengths, 0xffffffffu), io::MeshFormat::vtp),
            "bone: array 'Points': more blocks announced than the file can hold");
  EXPECT_EQ(complaint(with_value(good, lengths + 8, 47u), io::MeshFormat::vtp),
            "bone: array 'Points': its blocks do not add up to the 48 bytes it needs");
  EXPECT_EQ(complaint(with_value(good, lengths + 12, 0xfffffffu), io::MeshFormat::vtp),
            "bone: array 'Points': its data ends within it");
  EXPECT_EQ(complaint(with_value(good, lengths + 16, 0xffffffffu), io::MeshFormat::vtp),
            "bone: array 'Points': block 0 cannot be uncompressed");
  // 100 million points, and lengths that agree with them.
  const std::string many = with(good, "NumberOfPoints=\"4\"", "NumberOfPoints=\"100000000\"");
  EXPECT_EQ(complaint(with_value(many, lengths_in(many) + 8, 1200000000u), io::MeshFormat::vtp),
            "bone: array 'Points': 1200000000 bytes cannot come out of its blocks");
  EXPECT_EQ(testing::internal::GetCapturedStderr(), "");
}

TEST(BadMeshFile, AHeaderThatContradictsItselfIsRefused) {
  EXPECT_EQ(
      complaint(with(ply_text, "element face 1\n", "element vertex 1\nproperty float x\nelement face 1\n"),
                io::MeshFormat::ply),
      "bone: header: element 'vertex' twice");
  EXPECT_EQ(complaint(with(ply_text, "double y", "double x"), io::MeshFormat::ply),
            "bone: header: vertex property 'x' twice");
  EXPECT_EQ(complaint(with(ply_text, "double y", "int y"), io::MeshFormat::ply),
            "bone: header: vertex property 'y' should be a float or a double");
  EXPECT_EQ(complaint(with(ply_text, "double y", "double w"), io::MeshFormat::ply),
            "bone: header: a vertex needs the properties x, y and z");
  EXPECT_EQ(complaint(with(ply_text, "vertex_indices", "corners"), io::MeshFormat::ply),
            "bone: header: a face needs one property 'vertex_indices'");
  EXPECT_EQ(complaint(with(ply_text, "list uchar", "list float"), io::MeshFormat::ply),
            "bone: line 8: the length of a list should be of an integer type");
  EXPECT_EQ(complaint(with(ply_text, "format ascii 1.0\n", ""), io::MeshFormat::ply),
            "bone: header: no 'format'");
  EXPECT_EQ(complaint(with(vtp_text, "</Piece>", "</Piece>\n<Piece>\n</Piece>"), io::MeshFormat::vtp),
            "bone: line 17: a second piece: only files of one piece are read");
  EXPECT_EQ(complaint(with(vtp_text, "</Points>", "</Polys>"), io::MeshFormat::vtp),
            "bone: line 11: '</Polys>' closes what is not open");
  EXPECT_EQ(
      complaint(with(vtp_text, "NumberOfComponents=\"3\"", "NumberOfComponents=\"2\""), io::MeshFormat::vtp),
      "bone: line 6: points need NumberOfComponents=\"3\"");
  EXPECT_EQ(complaint(with(vtp_text, "offsets", "ends"), io::MeshFormat::vtp),
            "bone: no array 'Polys offsets'");
  EXPECT_EQ(complaint(with(vtp_text, "version=\"0.1\"", "compressor=\"vtkLZMADataCompressor\""),
                      io::MeshFormat::vtp),
            "bone: line 2: compressed by 'vtkLZMADataCompressor': only zlib and LZ4 are read");
  EXPECT_EQ(complaint(with(vtk_text, "double", "int"), io::MeshFormat::vtk),
            "bone: line 5: points should be float or double");
}

TEST(BadMeshFile, AMessageIsOneLineWhateverTheFileHolds) {
  EXPECT_EQ(complaint("v 0 0 \x01\xff\n", io::MeshFormat::obj), "bone: line 1: '?\?' should be a coordinate");
  EXPECT_EQ(complaint("v 0 0 " + std::string(1000, 'x') + "\n", io::MeshFormat::obj),
            "bone: line 1: '" + std::string(40, 'x') + "...' should be a coordinate");
}

}  // namespace
}  // namespace condyle
