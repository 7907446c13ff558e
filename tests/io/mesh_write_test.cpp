#include <sys/resource.h>
#include <unistd.h>
#include <vtkCellData.h>
#include <vtkDataArray.h>
#include <vtkFieldData.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPolyData.h>
#include <vtkStringArray.h>
#include <vtkXMLPolyDataReader.h>

#include <csignal>
#include <iterator>

#include "condyle/io/mesh_file.hpp"
#include "io/file/whole_file.hpp"
#include "support/same_bits.hpp"
#include "support/test.hpp"

namespace condyle {
namespace {

class WrittenMesh : public testing::Test {
 protected:
  std::size_t files() const {
    return static_cast<std::size_t>(std::distance(std::filesystem::directory_iterator(folder_.path()), {}));
  }

  const test::TemporaryFolder folder_;
};

using test::expect_same_bits;

TriMesh float_valued() {
  return test::in_floats(test::sphere({0.1, -20.3, 300.7}, 25.1, 3));
}

/// Doubles that a float would round, or that would vanish in it.
TriMesh double_valued() {
  TriMesh mesh = test::sphere({0.1, -20.3, 300.7}, 25.1, 3);
  mesh.vertices.x[0] = -0.0;
  mesh.vertices.x[1] = std::numeric_limits<double>::denorm_min();
  mesh.vertices.y[2] = -1e30;
  mesh.vertices.z[3] = 1 + std::numeric_limits<double>::epsilon();
  return mesh;
}

TEST_F(WrittenMesh, IsReadBackBitForBit) {
  for (const char* name : {"a.ply", "a.vtp", "B.PLY", "B.VTP"}) {
    for (const TriMesh& mesh : {float_valued(), double_valued()}) {
      io::write_mesh(folder_ / name, mesh);
      expect_same_bits(io::read_mesh(folder_ / name).mesh, mesh);
    }
  }
  EXPECT_EQ(files(), 4u);
}

TEST_F(WrittenMesh, TakesFloatsWhereTheyLoseNothing) {
  for (const char* name : {"a.ply", "a.vtp"}) {
    io::write_mesh(folder_ / name, float_valued());
    const auto with_floats = io::read_whole_file(folder_ / name);
    io::write_mesh(folder_ / name, double_valued());
    const auto with_doubles = io::read_whole_file(folder_ / name);
    if (std::string_view(name) == "a.ply") {
      const std::size_t vertices = float_valued().vertices.size(),
                        triangles = float_valued().triangles.size();
      EXPECT_EQ(with_floats.size() - with_floats.find("end_header\n") - 11, 12 * vertices + 13 * triangles);
      EXPECT_EQ(with_doubles.size() - with_doubles.find("end_header\n") - 11, 24 * vertices + 13 * triangles);
    }
    test::expect_says(with_floats, name[2] == 'p' ? "property float x" : "Float32");
    test::expect_silent(with_doubles, name[2] == 'p' ? "property float x" : "Float32");
  }
}

TEST_F(WrittenMesh, HasTheSameBytesEveryTime) {
  for (const char* extension : {".ply", ".vtp"}) {
    const auto one = folder_ / (std::string("one") + extension),
               two = folder_ / (std::string("two") + extension);
    io::write_mesh(one, double_valued());
    io::write_mesh(two, double_valued());
    EXPECT_EQ(io::read_whole_file(one), io::read_whole_file(two));
  }
}

TEST_F(WrittenMesh, CarriesItsArraysForVtk) {
  const TriMesh mesh = test::box({0, 0, 0}, {1, 2, 3});
  const std::vector<double> gap = {0.1, -0.2, 0.3, 1e-300, 5, 6, 7, 8};
  const std::vector<std::int32_t> triangle = {-1, 0, 1, 2, 3, 4, 5, 11};
  const std::vector<std::uint8_t> touching = {1, 0, 0, 1, 0, 0, 0, 0, 0, 0, 0, 255};
  io::write_vtp(folder_ / "a.vtp", mesh,
                std::array{io::MeshArray{"radial_gap_mm", gap}, io::MeshArray{"triangle", triangle}},
                std::array{io::MeshArray{"in_contact", touching}});

  vtkNew<vtkXMLPolyDataReader> reader;
  reader->SetFileName((folder_ / "a.vtp").c_str());
  reader->Update();
  vtkPolyData* data = reader->GetOutput();
  ASSERT_EQ(data->GetNumberOfPoints(), 8);
  ASSERT_EQ(data->GetNumberOfPolys(), 12);
  auto* gaps = data->GetPointData()->GetArray("radial_gap_mm");
  auto* triangles = data->GetPointData()->GetArray("triangle");
  auto* contacts = data->GetCellData()->GetArray("in_contact");
  ASSERT_NE(gaps, nullptr);
  ASSERT_NE(triangles, nullptr);
  ASSERT_NE(contacts, nullptr);
  EXPECT_EQ(gaps->GetDataType(), VTK_DOUBLE);
  EXPECT_EQ(triangles->GetDataType(), VTK_INT);
  EXPECT_EQ(contacts->GetDataType(), VTK_UNSIGNED_CHAR);
  for (vtkIdType i = 0; i < 8; ++i) {
    EXPECT_EQ(gaps->GetTuple1(i), gap[static_cast<std::size_t>(i)]);
    EXPECT_EQ(triangles->GetTuple1(i), triangle[static_cast<std::size_t>(i)]);
  }
  for (vtkIdType i = 0; i < 12; ++i) EXPECT_EQ(contacts->GetTuple1(i), touching[static_cast<std::size_t>(i)]);
  expect_same_bits(io::read_mesh(folder_ / "a.vtp").mesh, mesh);
}

TEST_F(WrittenMesh, HasEveryBitOfPointsArraysAndFieldsInBothEncodings) {
  const TriMesh mesh = test::box({0.1, -1.0 / 3, 1e-7}, {1.0 / 7, 2, 3e5});
  std::vector<double> gap(mesh.vertices.size(), 1.0 / 3);
  gap[0] = -0x1.fffffffffffffp-3;
  for (const io::VtpEncoding encoding : {io::VtpEncoding::binary, io::VtpEncoding::text}) {
    const io::VtpOptions options{
        encoding, {{"command", "condyle depth 'a & b'"}, {"matrix", std::vector{0.1, -2e-17}}}};
    const auto path = folder_ / "a.vtp";
    io::write_vtp(path, mesh, std::array{io::MeshArray{"gap", gap}}, {}, options);
    expect_same_bits(io::read_mesh(path).mesh, mesh);
    const bool is_text = io::read_whole_file(path).find("format=\"appended\"") == std::string::npos;
    EXPECT_EQ(is_text, encoding == io::VtpEncoding::text);

    vtkNew<vtkXMLPolyDataReader> reader;
    reader->SetFileName(path.c_str());
    reader->Update();
    vtkPolyData* data = reader->GetOutput();
    ASSERT_NE(data->GetPointData()->GetScalars(), nullptr) << "what viewers colour by";
    EXPECT_STREQ(data->GetPointData()->GetScalars()->GetName(), "gap");
    for (std::size_t v = 0; v < gap.size(); ++v)
      EXPECT_EQ(data->GetPointData()->GetScalars()->GetTuple1(static_cast<vtkIdType>(v)), gap[v]);
    auto* command = vtkStringArray::SafeDownCast(data->GetFieldData()->GetAbstractArray("command"));
    auto* matrix = data->GetFieldData()->GetArray("matrix");
    ASSERT_NE(command, nullptr);
    ASSERT_NE(matrix, nullptr);
    EXPECT_EQ(command->GetValue(0), "condyle depth 'a & b'");
    EXPECT_EQ(matrix->GetTuple1(0), 0.1);
    EXPECT_EQ(matrix->GetTuple1(1), -2e-17);
  }
}

TEST_F(WrittenMesh, LeavesNothingBehindWhereItCannotBeWritten) {
  const TriMesh mesh = test::box({0, 0, 0}, {1, 2, 3});
  const auto no_folder = folder_ / "nowhere/a.ply";
  EXPECT_EQ(test::complaint_of<FileError>([&] { io::write_mesh(no_folder, mesh); }),
            no_folder.string() + ": cannot be written: No such file or directory");
  // A folder in the way: the temporary file is written, and then cannot take the name.
  std::filesystem::create_directories(folder_ / "taken.vtp/inside");
  EXPECT_THROW(io::write_mesh(folder_ / "taken.vtp", mesh), FileError);
  EXPECT_THROW(io::write_mesh(folder_ / "a.stl", mesh), FileError);
  EXPECT_EQ(files(), 1u);
}

/// A limit on the size of files stands in for a full disk: writing fails halfway.
TEST_F(WrittenMesh, AFullDiskIsNoticedAndTheOldFileStays) {
  const auto path = folder_ / "a.ply";
  const TriMesh old = test::box({0, 0, 0}, {1, 1, 1});
  io::write_mesh(path, old);

  rlimit before;
  ASSERT_EQ(getrlimit(RLIMIT_FSIZE, &before), 0);
  const rlimit little{1000, before.rlim_max};  // bytes
  const auto old_handler = std::signal(SIGXFSZ, SIG_IGN);
  ASSERT_EQ(setrlimit(RLIMIT_FSIZE, &little), 0);
  const std::string complaint = test::complaint_of<FileError>([&] { io::write_mesh(path, double_valued()); });
  setrlimit(RLIMIT_FSIZE, &before);
  std::signal(SIGXFSZ, old_handler);

  EXPECT_EQ(complaint, path.string() + ": cannot be written: File too large");
  EXPECT_EQ(io::read_mesh(path).mesh, old);
  EXPECT_EQ(files(), 1u);
}

TEST_F(WrittenMesh, TakesThePlaceOfAnOlderOneOnlyWhenWhole) {
  const auto path = folder_ / "a.ply";
  io::write_mesh(path, test::box({0, 0, 0}, {1, 1, 1}));
  io::write_mesh(path, test::box({0, 0, 0}, {2, 2, 2}));
  EXPECT_EQ(io::read_mesh(path).mesh, test::box({0, 0, 0}, {2, 2, 2}));
  EXPECT_EQ(files(), 1u);
}

}  // namespace
}  // namespace condyle
