#include <fmt/format.h>
#include <vtkBitArray.h>
#include <vtkCellArray.h>
#include <vtkDoubleArray.h>
#include <vtkFieldData.h>
#include <vtkNew.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>
#include <vtkPolyDataWriter.h>
#include <vtkStringArray.h>
#include <vtkXMLPolyDataWriter.h>

#include <bit>

#include "condyle/inspect.hpp"
#include "condyle/io/mesh_file.hpp"
#include "support/mesh_bytes.hpp"
#include "support/test.hpp"

// What other programs put round the triangles: strips, texts, line ends, marks, orders of bytes, packers.

namespace condyle {
namespace {

using io::MeshFormat;

const TriMesh box = test::box({0, 0, 0}, {2, 3, 4});

/// Corners of the box, and its surface as two strips: round the sides and over top and bottom, 8 triangles and 4.
constexpr double corners[8][3] = {{0, 0, 0}, {2, 0, 0}, {2, 3, 0}, {0, 3, 0},
                                  {0, 0, 4}, {2, 0, 4}, {2, 3, 4}, {0, 3, 4}};
const std::vector<std::vector<vtkIdType>> strips = {
    {4, 0, 5, 1, 6, 2, 7, 3, 4, 0}, {0, 3, 1, 2}, {4, 5, 7, 6}};

void expect_box(const TriMesh& mesh, const std::string& name) {
  const MeshReport report = inspect(mesh);
  EXPECT_EQ(report.triangles, 12u) << name;
  EXPECT_TRUE(report.is_closed()) << name;
  EXPECT_EQ(report.inconsistent_edges.count, 0u) << name;
  ASSERT_TRUE(report.signed_volume) << name;
  EXPECT_DOUBLE_EQ(*report.signed_volume, 24) << name;
}

std::string refusal(std::string_view bytes, MeshFormat format) {
  return test::complaint_of<FileError>([&] { io::read_mesh(bytes, format, "bone"); });
}

vtkNew<vtkPolyData> box_for_vtk(const std::vector<std::vector<vtkIdType>>& as_strips) {
  vtkNew<vtkPoints> points;
  for (const auto& p : corners) points->InsertNextPoint(p);
  vtkNew<vtkCellArray> polygons, of_strips;
  for (const auto& strip : as_strips)
    of_strips->InsertNextCell(static_cast<vtkIdType>(strip.size()), strip.data());
  if (as_strips.empty())
    for (const auto& [a, b, c] : box.triangles)
      polygons->InsertNextCell({vtkIdType{a}, vtkIdType{b}, vtkIdType{c}});
  vtkNew<vtkPolyData> data;
  if (as_strips.empty()) {
    points->Reset();
    for (std::size_t v = 0; v < box.vertices.size(); ++v) points->InsertNextPoint(box.vertices[v].data());
    data->SetPolys(polygons);
  } else {
    data->SetStrips(of_strips);
  }
  data->SetPoints(points);
  return data;
}

std::string legacy(vtkPolyData* data, int type, int version) {
  vtkNew<vtkPolyDataWriter> writer;
  writer->SetInputData(data);
  writer->SetFileType(type);
  writer->SetFileVersion(version);
  writer->WriteToOutputStringOn();
  writer->Write();
  return {writer->GetOutputString(), static_cast<std::size_t>(writer->GetOutputStringLength())};
}

constexpr int versions[] = {vtkDataWriter::VTK_LEGACY_READER_VERSION_4_2,
                            vtkDataWriter::VTK_LEGACY_READER_VERSION_5_1};

TEST(MeshStrips, AreTrianglesWoundAlternatelyInLegacyVtk) {
  const auto data = box_for_vtk(strips);
  for (const int type : {VTK_ASCII, VTK_BINARY})
    for (const int version : versions)
      expect_box(io::read_mesh(legacy(data, type, version), MeshFormat::vtk, "box").mesh,
                 fmt::format("type {} version {}", type, version));
}

TEST(MeshStrips, AreTrianglesWoundAlternatelyInVtp) {
  const auto data = box_for_vtk(strips);
  for (const int mode : {vtkXMLWriter::Ascii, vtkXMLWriter::Binary, vtkXMLWriter::Appended}) {
    vtkNew<vtkXMLPolyDataWriter> writer;
    writer->SetInputData(data);
    writer->SetDataMode(mode);
    writer->WriteToOutputStringOn();
    writer->Write();
    expect_box(io::read_mesh(writer->GetOutputString(), MeshFormat::vtp, "box").mesh,
               fmt::format("mode {}", mode));
  }
}

std::string ply_of_strips(std::string_view type, std::string_view lists, std::size_t count) {
  std::string text = fmt::format(
      "ply\nformat ascii 1.0\nelement vertex 8\nproperty float x\nproperty float y\nproperty float z\n"
      "element tristrips {}\nproperty list int {} vertex_indices\nend_header\n",
      count, type);
  for (const auto& p : corners) text += fmt::format("{} {} {}\n", p[0], p[1], p[2]);
  return text + std::string(lists);
}

TEST(MeshStrips, OfPlyBeginAnewAtMinusOne) {
  const std::string one = "20 4 0 5 1 6 2 7 3 4 0 -1 0 3 1 2 -1 4 5 7 6\n";
  expect_box(io::read_mesh(ply_of_strips("int", one, 1), MeshFormat::ply, "box").mesh, "one list");
  expect_box(
      io::read_mesh(
          ply_of_strips("int", test::replaced(test::replaced(one, "20 ", "22 "), " 6\n", " 6 -1 -1\n"), 1),
          MeshFormat::ply, "box")
          .mesh,
      "ends that begin nothing");
  const std::string two = "10 4 0 5 1 6 2 7 3 4 0\n9 0 3 1 2 -1 4 5 7 6\n";
  expect_box(io::read_mesh(ply_of_strips("int", two, 2), MeshFormat::ply, "box").mesh, "two lists");
  const std::string largest = "20 4 0 5 1 6 2 7 3 4 0 4294967295 0 3 1 2 4294967295 4 5 7 6\n";
  expect_box(io::read_mesh(ply_of_strips("uint", largest, 1), MeshFormat::ply, "box").mesh, "unsigned");
}

TEST(MeshStrips, JoinedByTrianglesOfTwoVerticesAreOneSurface) {
  // 0 is there twice and so is 3: four triangles without area lead from one strip to the next.
  const TriMesh mesh =
      io::read_mesh(ply_of_strips("int", "16 4 0 5 1 6 2 7 3 4 0 0 0 0 3 1 2\n", 1), MeshFormat::ply, "box")
          .mesh;
  EXPECT_EQ(mesh.triangles.size(), 10u);
  EXPECT_EQ(inspect(mesh).inconsistent_edges.count, 0u);
  EXPECT_EQ(inspect(mesh).degenerate_triangles.count, 0u);
}

TEST(MeshStrips, ThatAreTooShortOrLeaveTheMeshAreRefused) {
  EXPECT_EQ(refusal(ply_of_strips("int", "2 0 1\n", 1), MeshFormat::ply),
            "bone: tristrips 0: a triangle strip has 2 corners: it needs 3");
  EXPECT_EQ(refusal(ply_of_strips("int", "3 0 1 8\n", 1), MeshFormat::ply),
            "bone: triangle 0 uses vertex 8 of 8");
  EXPECT_EQ(refusal(ply_of_strips("float", "3 0 1 2\n", 1), MeshFormat::ply),
            "bone: header: property 'vertex_indices' of strips should be a list of integers");
  const std::string vtk = legacy(box_for_vtk(strips), VTK_ASCII, versions[0]);
  EXPECT_EQ(refusal(test::replaced(vtk, "TRIANGLE_STRIPS 3 21", "TRIANGLE_STRIPS 1 3\n2 0 1\nMETADATA"),
                    MeshFormat::vtk),
            "bone: triangle strip 0 has 2 corners: it needs 3");
}

TEST(LegacyVtk, OfVeryManySectionsOfPolygonsIsRead) {
  constexpr std::size_t many = 300'000;
  std::string text =
      "# vtk DataFile Version 3.0\nt\nASCII\nDATASET POLYDATA\nPOINTS 3 float\n0 0 0 1 0 0 0 1 0\n";
  for (std::size_t i = 0; i < many; ++i) text += "POLYGONS 1 4\n3 0 1 2\n";
  EXPECT_EQ(io::read_mesh(text, MeshFormat::vtk, "m").mesh.triangles.size(), many);
}

TEST(LegacyVtk, PassesOverTextsAndBitsInItsFieldData) {
  const auto data = box_for_vtk({});
  // One whose length takes one byte, two and four; names and texts with blanks, per cent and lines.
  vtkNew<vtkStringArray> space, several;
  space->SetName("SPACE");
  space->InsertNextValue("LPS");
  several->SetName("a name of 100 %");
  for (const std::size_t length :
       {std::size_t{0}, std::size_t{63}, std::size_t{64}, std::size_t{16383}, std::size_t{16384}})
    several->InsertNextValue(std::string(length, 'x'));
  several->InsertNextValue("two\nlines, 5 %, POINTS 9 float");
  vtkNew<vtkDoubleArray> numbers;
  numbers->SetName("numbers");
  for (int i = 0; i < 9; ++i) numbers->InsertNextValue(i);
  vtkNew<vtkBitArray> bits;
  bits->SetName("bits");
  for (int i = 0; i < 9; ++i) bits->InsertNextValue(i % 2);
  for (vtkAbstractArray* array :
       {static_cast<vtkAbstractArray*>(space.Get()), static_cast<vtkAbstractArray*>(several.Get()),
        static_cast<vtkAbstractArray*>(numbers.Get()), static_cast<vtkAbstractArray*>(bits.Get())})
    data->GetFieldData()->AddArray(array);
  for (const int type : {VTK_ASCII, VTK_BINARY})
    for (const int version : versions) {
      const std::string bytes = legacy(data, type, version);
      test::expect_says(bytes, "SPACE 1 1 string");
      expect_box(io::read_mesh(bytes, MeshFormat::vtk, "box").mesh,
                 fmt::format("type {} version {}", type, version));
    }
}

TEST(LegacyVtk, RefusesTextsThatTheFileIsTooShortFor) {
  const auto data = box_for_vtk({});
  vtkNew<vtkStringArray> space;
  space->SetName("SPACE");
  space->InsertNextValue("LPS");
  data->GetFieldData()->AddArray(space);
  const std::string text = legacy(data, VTK_ASCII, versions[1]),
                    binary = legacy(data, VTK_BINARY, versions[1]);
  EXPECT_EQ(refusal(test::replaced(text, "SPACE 1 1 string", "SPACE 1 99999999 string"), MeshFormat::vtk),
            "bone: field: 99999999 texts announced, the file ends before");
  EXPECT_EQ(refusal(test::replaced(binary, "\xC3LPS", std::string("\0\xFF\xFF\xFF\xFF\xFF\xFF\xFF", 8)),
                    MeshFormat::vtk),
            "bone: field: the file ends within text 0");
  EXPECT_EQ(refusal(test::replaced(text, " string", " variant"), MeshFormat::vtk),
            "bone: line 6: 'variant' is no type of numbers that is read");
}

TEST(LegacyVtk, SaysThatItsNumbersAreLittleEndian) {
  const auto little = [](int version, const std::vector<std::vector<vtkIdType>>& as_strips) {
    // All numbers of the file have four bytes or eight, and stand behind the lines that name their type.
    std::string bytes = legacy(box_for_vtk(as_strips), VTK_BINARY, version);
    const auto turn = [&](std::string_view line, std::size_t size, std::size_t count) {
      std::size_t at = bytes.find(line);
      ASSERT_NE(at, bytes.npos) << line;
      at = bytes.find('\n', at) + 1;
      for (std::size_t i = 0; i < count; ++i, at += size)
        std::reverse(bytes.begin() + static_cast<std::ptrdiff_t>(at),
                     bytes.begin() + static_cast<std::ptrdiff_t>(at + size));
    };
    turn("POINTS", 4, 24);
    if (version == versions[1]) {
      turn("OFFSETS", 8, as_strips.empty() ? 13 : 4);
      turn("CONNECTIVITY", 8, as_strips.empty() ? 36 : 18);
    } else {
      turn(as_strips.empty() ? "POLYGONS" : "TRIANGLE_STRIPS", 4, as_strips.empty() ? 48 : 21);
    }
    return bytes;
  };
  for (const int version : versions)
    for (const auto& as_strips : {std::vector<std::vector<vtkIdType>>{}, strips})
      EXPECT_EQ(refusal(little(version, as_strips), MeshFormat::vtk),
                "bone: its binary numbers are little-endian, those of a legacy VTK file are big-endian: "
                "write it anew as text, "
                "or as .vtp");
  // One that is wrong in both orders keeps the reason of the right one.
  const std::string cut = legacy(box_for_vtk({}), VTK_BINARY, versions[0]);
  test::expect_silent(refusal(cut.substr(0, cut.size() - 9), MeshFormat::vtk), "endian");
}

/// Line feeds as other systems write them; binary data stay.
std::string with_line_ends(const std::string& bytes, std::string_view end, std::size_t up_to) {
  std::string out;
  for (const char c : bytes.substr(0, up_to)) out += c == '\n' ? std::string(end) : std::string(1, c);
  return out + bytes.substr(up_to);
}

TEST(MeshLineEnds, OfAnySystemAndAMarkOfUtf8AreReadInEveryFormat) {
  std::size_t read = 0;
  for (const auto& file : test::all_files(box)) {
    const bool is_binary_stl = file.name.find("stl binary") != std::string::npos;
    if (is_binary_stl) continue;
    const std::size_t ply_data = file.bytes.find("end_header\n");
    const bool is_text =
        file.name.find("binary") == std::string::npos && file.name.find("raw") == std::string::npos;
    if (!is_text && ply_data == std::string::npos) continue;
    const std::size_t up_to = is_text ? file.bytes.size() : ply_data + 11;
    const TriMesh expected = io::read_mesh(file.bytes, file.format, file.name).mesh;
    for (const std::string_view end : {"\r", "\r\n", "\r\r\n"})
      for (const std::string_view mark : {"", "\xEF\xBB\xBF"}) {
        EXPECT_EQ(
            io::read_mesh(std::string(mark) + with_line_ends(file.bytes, end, up_to), file.format, file.name)
                .mesh,
            expected)
            << file.name;
        ++read;
      }
  }
  EXPECT_GT(read, 60u);
}

TEST(MeshLineEnds, ASingleReturnBeforeDataThatBeginWithALineFeedIsTheLineEnd) {
  // 1.0e-38 and so on: the lowest byte of x of the first vertex is 10, which is a line feed.
  std::string bytes =
      "ply\rformat binary_little_endian 1.0\relement vertex 3\rproperty float x\rproperty float y\rproperty "
      "float z\r"
      "element face 1\rproperty list uchar uchar vertex_indices\rend_header\r";
  const float points[9] = {std::bit_cast<float>(0x3F80000Au), 0, 0, 1, 0, 0, 0, 1, 0};
  bytes.append(reinterpret_cast<const char*>(points), sizeof points);
  bytes += std::string("\3\0\1\2", 4);
  const TriMesh mesh = io::read_mesh(bytes, MeshFormat::ply, "a.ply").mesh;
  EXPECT_EQ(mesh.vertices.x[0], static_cast<double>(points[0]));
  EXPECT_EQ(mesh.vertices.y[2], 1);
}

TEST(MeshLineEnds, LinesOfMixedEndsAreLines) {
  // A comment that ends with a line feed, and vertices that end with carriage returns.
  const auto file = io::read_mesh("# made\nv 0 0 0\rv 1 0 0\rv 0 1 0\rf 1 2 3\r", MeshFormat::obj, "a.obj");
  EXPECT_EQ(file.mesh.vertices.size(), 3u);
  EXPECT_EQ(refusal("# made\rv 0 0 0\rv 1 zero 0\r", MeshFormat::obj),
            "bone: line 3: 'zero' should be a coordinate");
}

TEST(MeshLineEnds, AMillionReturnsInARowAreLinesOfTheirOwn) {
  // Behind a first line that ends with both, each return might be one of several before a line feed.
  std::string text = "v 0 0 0\r\nv 2 0 0\r\nv 0 3 0\r\nf 1 2 3" + std::string(2'000'000, '\r') + "what 1";
  EXPECT_EQ(test::complaint_of<FileError>([&] { io::read_mesh(text, MeshFormat::obj, "m"); }),
            "m: line 2000004: 'what' is no OBJ statement that is read");
  text.resize(text.size() - 6);
  EXPECT_EQ(io::read_mesh(text + "\nf 1 3 2", MeshFormat::obj, "m").mesh.triangles.size(), 2u);
}

TEST(Vtp, RefusesACommentWithinNumbers) {
  const auto vtp = [](std::string_view points) {
    return fmt::format(
        R"(<VTKFile type="PolyData"><PolyData><Piece NumberOfPoints="3" NumberOfPolys="1"><Points>
<DataArray type="Float64" NumberOfComponents="3">{}</DataArray></Points><Polys><DataArray type="Int32" Name="connectivity">0 1 2</DataArray>
<DataArray type="Int32" Name="offsets">3</DataArray></Polys></Piece></PolyData></VTKFile>)",
        points);
  };
  EXPECT_EQ(io::read_mesh(vtp("0 0 0 1 0 0 0 1 0"), MeshFormat::vtp, "m").mesh.vertices[1].x(), 1);
  // XML joins the two to 01, then 10; the first part by itself is a whole mesh.
  for (const char* points :
       {"0 0 0 1 0 0 0 1 0<!-- -->1", "0 0 0 1<!-- -->0 0 0 0 1 0", "<!-- -->0 0 0 1 0 0 0 1 0",
        "0 0 0 1 0 0 0 1 0 <?x?> 7", "0 0 0 1 0 0 0 1 0<![CDATA[1]]>"}) {
    const std::string said =
        test::complaint_of<FileError>([&] { io::read_mesh(vtp(points), MeshFormat::vtp, "m"); });
    test::expect_says(said, "m: line 2: ");
    test::expect_says(said, "stands inside a text or number");
  }
}

TEST(MeshText, InUtf16IsRefusedByName) {
  EXPECT_EQ(refusal(std::string("\xFF\xFEv\0 \0", 6), MeshFormat::obj),
            "bone: the text is in UTF-16: save it as UTF-8");
  EXPECT_EQ(refusal(std::string("\xFE\xFF\0p\0l", 6), MeshFormat::ply),
            "bone: the text is in UTF-16: save it as UTF-8");
}

TEST(ObjLines, GoOnAfterABackslash) {
  const auto file = io::read_mesh("v 0 0 0\nv 1 \\\n0 0\nv 0 1 \\ \r\n\\\n0\nf 1 \\\n2 \\\n3\nf 1 2 \\\n3",
                                  MeshFormat::obj, "a.obj");
  EXPECT_EQ(file.mesh.triangles, (std::vector<Triangle>{{0, 1, 2}, {0, 1, 2}}));
  EXPECT_EQ(file.mesh.vertices[2], Vec3(0, 1, 0));
  // Folders and remarks may end with one: the next line is a line.
  const auto names = io::read_mesh(
      "# C:\\bones\\\nmtllib C:\\bones\\\ng femur\\\nv 0 0 0 # see C:\\\nv 1 0 0\nv 0 1 0\nf 1 2 3",
      MeshFormat::obj, "a.obj");
  EXPECT_EQ(names.mesh.vertices.size(), 3u);
  EXPECT_EQ(refusal("v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 \\\nx\n", MeshFormat::obj),
            "bone: line 5: 'x' should be a vertex number, from 1 or, counted back, from -1");
}

TEST(PackedMesh, IsRefusedWithItsPacker) {
  const std::pair<std::string, const char*> starts[] = {{std::string("\x1F\x8B\x08\0\0", 5), "gzip"},
                                                        {std::string("PK\3\4\0", 5), "zip"},
                                                        {"BZh91AY", "bzip2"},
                                                        {std::string("\xFD"
                                                                     "7zXZ\0\0",
                                                                     7),
                                                         "xz"},
                                                        {"\x28\xB5\x2F\xFD-", "zstd"}};
  for (const auto& [bytes, packer] : starts)
    for (const auto format :
         {MeshFormat::stl, MeshFormat::obj, MeshFormat::ply, MeshFormat::vtp, MeshFormat::vtk})
      EXPECT_EQ(refusal(bytes + std::string(100, 'x'), format),
                fmt::format("bone: is compressed by {}: uncompress it first", packer));
  // The header of a binary STL file may hold any bytes.
  for (const auto& file : test::stl_files(box)) {
    if (file.name.find("binary") == std::string::npos) continue;
    const std::string bytes = std::string("\x1F\x8B\x08") + file.bytes.substr(3);
    EXPECT_EQ(io::read_mesh(bytes, MeshFormat::stl, "a").mesh.triangles.size(), 12u);
  }
  const test::TemporaryFolder folder;
  for (const char* name : {"bone.stl.gz", "bone.zip"}) {
    const auto path = folder.file(name, "x");
    test::expect_says(test::complaint_of<FileError>([&] { io::read_mesh(path); }), "is compressed");
  }
}

TEST(UnreadImage, UnderAMeshsNameSaysWhatConvertsIt) {
  const test::TemporaryFolder folder;
  const std::string dicom = std::string(128, '\0') + "DICM and more";
  const std::pair<std::filesystem::path, const char*> files[] = {
      {folder.file("aseg.mgz", "x"), "mri_convert"},
      {folder.file("aseg.MGH", "x"), "mri_convert"},
      {folder.file("ct.dcm", "x"), "3D Slicer"},
      {folder.file("IM000001", dicom), "3D Slicer"}};
  for (const auto& [path, program] : files)
    test::expect_says(test::complaint_of<FileError>([&] { io::mesh_format_of(path); }), program);
  EXPECT_EQ(io::mesh_format_of(folder.file("odd.stl", dicom)), MeshFormat::stl) << "its name says what it is";
}

}  // namespace
}  // namespace condyle
