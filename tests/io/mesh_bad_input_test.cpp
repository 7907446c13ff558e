#include "condyle/io/mesh_file.hpp"
#include "support/mesh_bytes.hpp"
#include "support/test.hpp"

namespace condyle {
namespace {

/// Message of the reader's error; "accepted" if there is none.
std::string complaint(std::string_view bytes, io::MeshFormat format, std::string_view name = "bone") {
  return test::complaint_of<FileError>([&] { io::read_mesh(bytes, format, name); });
}

std::string complaint(const std::filesystem::path& path) {
  return test::complaint_of<FileError>([&] { io::read_mesh(path); });
}

template <class T>
std::string with_value(std::string bytes, std::size_t at, T value) {
  return bytes.replace(at, sizeof value, reinterpret_cast<const char*>(&value), sizeof value);
}

const TriMesh tetrahedron = test::mesh_of({{0, 0, 0}, {40, 0, 0}, {0, 30, 0}, {0, 0, 20}},
                                          {{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {0, 3, 2}});

const std::string ply_header =
    "ply\nformat ascii 1.0\nelement vertex 3\nproperty double x\nproperty double y\nproperty double z\n"
    "element face 1\nproperty list uchar int vertex_indices\nend_header\n";
const std::string ply_text = ply_header + "0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n";
const std::string obj_text = "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n";
const std::string stl_text =
    "solid s\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 0 1 "
    "0\nendloop\nendfacet\nendsolid s\n";
const std::string vtp_text = R"(<?xml version="1.0"?>
<VTKFile type="PolyData" version="0.1" byte_order="LittleEndian">
<PolyData>
<Piece NumberOfPoints="3" NumberOfVerts="0" NumberOfLines="0" NumberOfStrips="0" NumberOfPolys="1">
<Points>
<DataArray type="Float64" NumberOfComponents="3" format="ascii">
0 0 0
1 0 0
0 1 0
</DataArray>
</Points>
<Polys>
<DataArray type="Int32" Name="connectivity" format="ascii">0 1 2</DataArray>
<DataArray type="Int32" Name="offsets" format="ascii">3</DataArray>
</Polys>
</Piece>
</PolyData>
</VTKFile>
)";
const std::string vtk_text =
    "# vtk DataFile Version 4.2\na bone\nASCII\nDATASET POLYDATA\nPOINTS 3 double\n0 0 0\n1 0 0\n0 1 0\n"
    "POLYGONS 1 4\n3 0 1 2\n";

constexpr io::MeshFormat every_format[] = {io::MeshFormat::stl, io::MeshFormat::obj, io::MeshFormat::ply,
                                           io::MeshFormat::vtp, io::MeshFormat::vtk};

/// A file of which a part is another, and what is said of it behind its name.
struct DamagedText {
  io::MeshFormat format;
  std::string_view from, to, says;
};

const std::string& good_text(io::MeshFormat format) {
  return format == io::MeshFormat::ply   ? ply_text
         : format == io::MeshFormat::obj ? obj_text
         : format == io::MeshFormat::stl ? stl_text
         : format == io::MeshFormat::vtp ? vtp_text
                                         : vtk_text;
}

void expect_damaged(std::initializer_list<DamagedText> all) {
  for (const auto& [format, from, to, says] : all)
    EXPECT_EQ(complaint(test::replaced(good_text(format), from, to), format), "bone: " + std::string(says));
}

/// A whole file, and what is said of it.
struct BadBytes {
  io::MeshFormat format;
  std::string bytes, says;
};

void expect_refused(const std::vector<BadBytes>& all) {
  for (const auto& [format, bytes, says] : all) EXPECT_EQ(complaint(bytes, format), "bone: " + says);
}

TEST(BadMeshFile, TheFilesThatTheOthersAreMadeFromAreGood) {
  for (const io::MeshFormat format : every_format)
    EXPECT_EQ(complaint(good_text(format), format), "accepted");
}

TEST(BadMeshFile, AMissingFileAFolderAndAnUnknownExtensionAreNamed) {
  const test::TemporaryFolder folder;
  const auto missing = folder / "femur.stl", inside = folder / "meshes", unknown = folder / "femur.step";
  std::filesystem::create_directories(inside);
  folder.file("femur.step", obj_text);
  EXPECT_EQ(complaint(missing), missing.string() + ": no such file");
  EXPECT_EQ(complaint(inside), inside.string() + ": is a folder, not a file");
  EXPECT_EQ(complaint(unknown),
            unknown.string() + ": unknown extension '.step': .stl, .obj, .ply, .vtp and .vtk are read");
}

TEST(BadMeshFile, AJointFileIsNamedAsThat) {
  const test::TemporaryFolder folder;
  const std::string joint = folder.file("hip.toml", "condyle = 1\n").string();
  EXPECT_EQ(complaint(joint), joint + ": is a joint file, not a mesh: condyle rom " + joint +
                                  " has its limits, condyle frame " + joint +
                                  " shows its bodies; .stl, .obj, .ply, .vtp and .vtk are read");
}

TEST(BadMeshFile, ExtensionsMayBeInCapitals) {
  const test::TemporaryFolder folder;
  EXPECT_EQ(complaint(folder.file("FEMUR.PLY", ply_text)), "accepted");
}

TEST(BadMeshFile, AnEmptyFileIsSaidToBeEmptyInEveryFormat) {
  for (const io::MeshFormat format : every_format)
    EXPECT_EQ(complaint("", format), "bone: the file is empty");
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
  using enum io::MeshFormat;
  const auto binary = test::stl_files(tetrahedron)[1].bytes;
  expect_refused(
      {{stl, binary.substr(0, 200), "header: 4 triangles need 284 bytes, the file has 200"},
       {stl, "\x01\x02 not long enough", "header: the file has 18 bytes, an STL file at least 84"},
       {stl, stl_text.substr(0, stl_text.find("endsolid")), "line 9: the file ends before 'endsolid'"},
       {stl, stl_text.substr(0, stl_text.find(" 0 0\nvertex 0 1")),
        "line 5: the file ends where a coordinate should be"},
       {obj, obj_text.substr(0, obj_text.size() - 3),
        "line 4: face 0 has 2 corners: only triangles are read"},
       {obj, "v 0 0 0\nv 1 0", "line 2: a vertex needs three coordinates"},
       {ply, "ply\nformat ascii 1.0\n", "header: the file ends before 'end_header'"},
       {ply, ply_text.substr(0, ply_text.size() - 3), "face 0: a list of 3 values does not fit the file"},
       {vtp, vtp_text.substr(0, vtp_text.find("</Points>")), "line 11: the file ends before '</Points>'"},
       {vtk, vtk_text.substr(0, vtk_text.size() - 3),
        "polygons: 4 numbers announced, the file ends before"}});
}

TEST(BadMeshFile, ACoordinateThatIsNoFiniteNumberNamesItsVertex) {
  using enum io::MeshFormat;
  expect_damaged({{ply, "1 0 0", "1 nan 0", "vertex 1: coordinate y is nan"},
                  {ply, "0 1 0\n", "0 1 -inf\n", "vertex 2: coordinate z is -inf"},
                  {obj, "v 1 0 0", "v inf 0 0", "vertex 1: coordinate x is inf"},
                  {stl, "vertex 0 1 0", "vertex 0 NaN 0", "vertex 2: coordinate y is nan"},
                  {vtp, "0 1 0", "0 1 INF", "vertex 2: coordinate z is inf"},
                  {vtk, "0 1 0", "0 1 nan", "vertex 2: coordinate z is nan"}});

  // Triangle 2, second corner, y, in binary: 84 bytes of header, 50 a triangle, 12 of normal, 12 a corner.
  const auto binary = test::stl_files(tetrahedron)[1].bytes;
  EXPECT_EQ(complaint(with_value(binary, 84 + 2 * 50 + 12 + 12 + 4, std::numeric_limits<float>::infinity()),
                      io::MeshFormat::stl),
            "bone: vertex 7: coordinate y is inf");
}

TEST(BadMeshFile, AnIndexOutOfRangeNamesItsTriangle) {
  using enum io::MeshFormat;
  expect_damaged(
      {{ply, "3 0 1 2", "3 0 -1 2", "triangle 0 uses vertex -1 of 3"},
       {obj, "f 1 2 3", "f 1 2 4", "line 4: face uses vertex 4 of 3"},
       {obj, "f 1 2 3", "f -1 -2 -4", "line 4: face uses vertex -4 after 3 vertices"},
       {obj, "f 1 2 3", "f 0 1 2", "line 4: '0' should be a vertex number, from 1 or, counted back, from -1"},
       {vtp, "0 1 2", "0 1 2147483647", "triangle 0 uses vertex 2147483647 of 3"},
       {vtk, "3 0 1 2", "3 0 1 9", "triangle 0 uses vertex 9 of 3"}});
  EXPECT_EQ(complaint(test::replaced(ply_text, "3 0 1 2", "3 0 1 3"), io::MeshFormat::ply, "femur.ply"),
            "femur.ply: triangle 0 uses vertex 3 of 3");
  // Beyond 64 signed bits.
  EXPECT_EQ(complaint(test::replaced(test::replaced(vtp_text, "Int32", "UInt64"), "0 1 2<",
                                     "0 1 18446744073709551615<"),
                      io::MeshFormat::vtp),
            "bone: triangle 0 uses vertex 9223372036854775807 of 3");
}

TEST(BadMeshFile, CountsThatTheFileCannotHoldAreNotBelieved) {
  using enum io::MeshFormat;
  expect_damaged(
      {{ply, "vertex 3", "vertex 99999999999",
        "header: 99999999999 elements 'vertex' announced, more than the rest of the file can hold"},
       {ply, "face 1", "face 18446744073709551615",
        "header: 18446744073709551615 elements 'face' announced, more than the rest of the file can hold"},
       {ply, "vertex 3", "vertex -3", "line 3: '-3' should be the count of elements 'vertex'"},
       {ply, "3 0 1 2", "255 0 1 2", "face 0: a list of 255 values does not fit the file"},
       {vtp, "NumberOfPoints=\"3\"", "NumberOfPoints=\"99999999999\"",
        "array 'Points': has not the 299999999997 numbers that its piece announces"},
       {vtp, "NumberOfPolys=\"1\"", "NumberOfPolys=\"18446744073709551615\"",
        "piece 0: announces more than any file can hold"},
       {vtp, "NumberOfPolys=\"1\"", "NumberOfPolys=\"-1\"", "line 4: '-1' should be 'NumberOfPolys'"},
       {vtk, "POINTS 3", "POINTS 99999999999",
        "points: 299999999997 numbers announced, the file ends before"},
       {vtk, "POLYGONS 1 4", "POLYGONS 1 99999999999",
        "polygons: 99999999999 numbers announced, the file ends before"},
       {vtk, "POLYGONS 1 4", "POLYGONS 99999999999 4", "polygons: 99999999999 cells in 4 numbers"},
       {vtk, "POINTS 3", "POINTS -3", "line 5: '-3' should be the number of points"}});
  EXPECT_EQ(
      complaint(with_value(test::stl_files(tetrahedron)[1].bytes, 80, 0xffffffffu), io::MeshFormat::stl),
      "bone: header: 4294967295 triangles need 214748364834 bytes, the file has 284");
}

TEST(BadMeshFile, CountsTooSmallLeaveSomethingOverAndAreNoticed) {
  using enum io::MeshFormat;
  expect_damaged({{ply, "3 0 1 2\n", "3 0 1 2\n3 1 2 0\n", "8 bytes after the last element"},
                  {vtp, "0 1 0\n", "0 1 0\n1 1 1\n",
                   "array 'Points': has more than the 9 numbers that its piece announces"},
                  {vtk, "3 0 1 2\n", "3 0 1 2\n3 1 2 0\n", "line 11: '3' is no section of a PolyData file"}});
  EXPECT_EQ(
      complaint(test::stl_files(tetrahedron)[1].bytes.substr(5) + "12345", io::MeshFormat::stl).substr(0, 14),
      "bone: header: ");
}

TEST(BadMeshFile, AWordThatIsNoNumberNamesItsLine) {
  using enum io::MeshFormat;
  expect_damaged({{ply, "1 0 0", "1 O 0", "line 11: 'O' should be a number of its declared type"},
                  {ply, "1 0 0", "1 0,5 0", "line 11: '0,5' should be a number of its declared type"},
                  {ply, "1 0 0", "1e999 0 0", "line 11: '1e999' should be a number of its declared type"},
                  {ply, "3 0 1 2", "3 0 1 1.5", "line 13: '1.5' should be a number of its declared type"},
                  {obj, "v 1 0 0", "v 1 0 0x", "line 2: '0x' should be a coordinate"},
                  {stl, "vertex 1 0 0", "vertex 1 - 0", "line 5: '-' should be a coordinate"},
                  {vtp, "1 0 0", "1 zero 0", "line 8: 'zero' should be a number of array Points"},
                  {vtk, "1 0 0", "1 zero 0", "line 7: 'zero' should be a number"}});
}

TEST(BadMeshFile, VerticesWithoutTrianglesAreNoMesh) {
  using enum io::MeshFormat;
  expect_damaged({{vtk, "POLYGONS 1 4\n3 0 1 2\n", "", "holds 3 vertices but no triangles"}});
  expect_refused({{obj, "v 0 0 0\nv 1 0 0\n", "holds 2 vertices but no triangles"},
                  {obj, "# nothing\n", "holds no vertices"},
                  {stl, "solid s\nendsolid s\n", "holds no vertices"},
                  {ply, test::replaced(test::replaced(ply_text, "face 1", "face 0"), "3 0 1 2\n", ""),
                   "holds 3 vertices but no triangles"}});
}

TEST(BadMeshFile, PolygonsThatAreNoTrianglesAreRefusedByName) {
  using enum io::MeshFormat;
  expect_damaged(
      {{ply, "3 0 1 2", "4 0 1 2 1",
        "face 0 has 4 corners: only triangles are read, unless polygons are to be split (--polygons split)"},
       {obj, "f 1 2 3", "f 1 2 3\nf 1 2 3 1",
        "line 5: face 1 has 4 corners: only triangles are read, unless polygons are to be split (--polygons "
        "split)"},
       {vtp, "NumberOfStrips=\"0\"", "NumberOfStrips=\"1\"", "no array 'Strips offsets'"},
       {vtk, "POLYGONS 1 4\n3 0 1 2", "POLYGONS 1 3\n2 0 1",
        "polygon 0 has 2 corners: only triangles are read"}});
  EXPECT_EQ(complaint(test::replaced(test::replaced(vtp_text, "0 1 2", "0 1 2 1"), ">3<", ">4<"),
                      io::MeshFormat::vtp),
            "bone: polygon 0 has 4 corners: only triangles are read, unless polygons are to be split "
            "(--polygons split)");
}

TEST(BadMeshFile, OneFormatUnderTheNameOfAnotherIsRefused) {
  using enum io::MeshFormat;
  expect_damaged(
      {{vtp, "PolyData", "UnstructuredGrid", "line 2: holds 'UnstructuredGrid': only 'PolyData' is read"},
       {vtk, "POLYDATA", "STRUCTURED_POINTS", "line 4: holds 'STRUCTURED_POINTS': only 'POLYDATA' is read"}});
  expect_refused({{ply, obj_text, "line 1: should be 'ply'"},
                  {obj, ply_text, "line 1: 'ply' is no OBJ statement that is read"},
                  {vtk, vtp_text, "line 1: should be '# vtk DataFile Version ...'"},
                  {vtp, vtk_text, "line 11: no XML tag"}});
}

/// One zlib-compressed file with raw appended data and lengths of four bytes: number of blocks, size of a
/// block, size of the last one, compressed sizes; then the blocks.
TEST(BadMeshFile, DamagedCompressedDataIsNoticedWithoutAWordFromVtk) {
  using enum io::MeshFormat;
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
  ASSERT_EQ(complaint(good, io::MeshFormat::vtp), "accepted");

  testing::internal::CaptureStderr();
  expect_refused(
      {{vtp, with_value(good, lengths, 0xffffffffu),
        "array 'Points': more blocks announced than the file can hold"},
       {vtp, with_value(good, lengths + 8, 47u),
        "array 'Points': its blocks do not add up to the 48 bytes it needs"},
       {vtp, with_value(good, lengths + 12, 0xfffffffu), "array 'Points': its data ends within it"},
       {vtp, with_value(good, lengths + 16, 0xffffffffu), "array 'Points': block 0 cannot be uncompressed"}});
  // 100 million points, and lengths that agree with them.
  const std::string many = test::replaced(good, "NumberOfPoints=\"4\"", "NumberOfPoints=\"100000000\"");
  EXPECT_EQ(complaint(with_value(many, lengths_in(many) + 8, 1200000000u), io::MeshFormat::vtp),
            "bone: array 'Points': 1200000000 bytes cannot come out of its blocks");
  EXPECT_EQ(testing::internal::GetCapturedStderr(), "");
}

TEST(BadMeshFile, AHeaderThatContradictsItselfIsRefused) {
  using enum io::MeshFormat;
  expect_damaged(
      {{ply, "element face 1\n", "element vertex 1\nproperty float x\nelement face 1\n",
        "header: element 'vertex' twice"},
       {ply, "double y", "double x", "header: vertex property 'x' twice"},
       {ply, "double y", "int y", "header: vertex property 'y' should be a float or a double"},
       {ply, "double y", "double w", "header: a vertex needs the properties x, y and z"},
       {ply, "vertex_indices", "corners", "header: a face needs one property 'vertex_indices'"},
       {ply, "list uchar", "list float", "line 8: the length of a list should be of an integer type"},
       {ply, "format ascii 1.0\n", "", "header: no 'format'"},
       {vtp, "</Piece>", "</Piece>\n<Piece>\n</Piece>",
        "line 17: a second piece: only files of one piece are read"},
       {vtp, "</Points>", "</Polys>", "line 11: '</Polys>' closes what is not open"},
       {vtp, "NumberOfComponents=\"3\"", "NumberOfComponents=\"2\"",
        "line 6: points need NumberOfComponents=\"3\""},
       {vtp, "offsets", "ends", "no array 'Polys offsets'"},
       {vtp, "version=\"0.1\"", "compressor=\"vtkLZMADataCompressor\"",
        "line 2: compressed by 'vtkLZMADataCompressor': only zlib and LZ4 are read"},
       {vtk, "double", "int", "line 5: points should be float or double"}});
}

TEST(BadMeshFile, AMessageIsOneLineWhateverTheFileHolds) {
  EXPECT_EQ(complaint("v 0 0 \x01\xff\n", io::MeshFormat::obj), "bone: line 1: '?\?' should be a coordinate");
  EXPECT_EQ(complaint("v 0 0 " + std::string(1000, 'x') + "\n", io::MeshFormat::obj),
            "bone: line 1: '" + std::string(40, 'x') + "...' should be a coordinate");
}

}  // namespace
}  // namespace condyle
