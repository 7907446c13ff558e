#include <fmt/format.h>

#include "condyle/inspect.hpp"
#include "condyle/io/mesh_file.hpp"
#include "support/test.hpp"

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
  return test::complaint_of<FileError>([&] { split(vertices, face); });
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

using Shape = std::vector<Vec3>;

std::string vertices_of(const Shape& shape, const char* format = "v {} {} {}\n") {
  std::string text;
  for (const Vec3& p : shape) text += fmt::format(fmt::runtime(format), p.x(), p.y(), p.z());
  return text;
}

/// A face that takes all corners from `first` on, forwards or backwards.
std::string face_of(std::size_t corners, std::size_t first = 0, bool backwards = false) {
  std::string text = "f";
  for (std::size_t i = 0; i < corners; ++i)
    text += fmt::format(" {}", 1 + (backwards ? first + corners - i : first + i) % corners);
  return text;
}

Vec3 area_vector(const TriMesh& mesh) {
  Vec3 sum = Vec3::Zero();
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t)
    sum += (mesh.corner(t, 1) - mesh.corner(t, 0)).cross(mesh.corner(t, 2) - mesh.corner(t, 0)) / 2;
  return sum;
}

/// A comb with so many teeth of width 1 and height 2, 1 apart, on a bar of height 1: no corner sees all of it.
Shape comb(int teeth) {
  Shape shape{{0, 0, 0}, {2.0 * teeth - 1, 0, 0}};
  for (int i = teeth - 1; i >= 0; --i) {
    shape.push_back({2.0 * i + 1, 3, 0}), shape.push_back({2.0 * i, 3, 0});
    if (i > 0) shape.push_back({2.0 * i, 1, 0}), shape.push_back({2.0 * i - 1, 1, 0});
  }
  return shape;
}
double area_of_comb(int teeth) {
  return 2.0 * teeth - 1 + 2 * teeth;
}

/// A square of 3 with a hole of 1, whose boundaries are joined by an edge that is there twice.
const Shape with_hole{{0, 0, 0}, {3, 0, 0}, {3, 3, 0}, {0, 3, 0}, {0, 0, 0},
                      {1, 1, 0}, {1, 2, 0}, {2, 2, 0}, {2, 1, 0}, {1, 1, 0}};

const Shape spiral{{0, 0, 0}, {7, 0, 0}, {7, 7, 0}, {0, 7, 0}, {0, 2, 0}, {5, 2, 0}, {5, 5, 0}, {2, 5, 0},
                   {2, 4, 0}, {4, 4, 0}, {4, 3, 0}, {1, 3, 0}, {1, 6, 0}, {6, 6, 0}, {6, 1, 0}, {0, 1, 0}};
const double area_of_spiral = [] {  // the shoelace formula
  double sum = 0;
  for (std::size_t i = 0; i < spiral.size(); ++i) {
    const Vec3 &p = spiral[i], &q = spiral[(i + 1) % spiral.size()];
    sum += p.x() * q.y() - q.x() * p.y();
  }
  return sum / 2;
}();

TEST(Polygons, ThatAreFlatHaveTheirAreaWhateverTheirShape) {
  struct Case {
    const char* name;
    Shape shape;
    double area;
  };
  Shape spiked = comb(2), doubled = comb(2), straight = comb(2);
  spiked.insert(spiked.begin() + 2, {{3, 1, 0}, {4, 1, 0}, {3, 1, 0}});  // out and back again
  doubled.insert(doubled.begin() + 4, doubled[4]);
  straight.insert(straight.begin() + 1, {{1, 0, 0}, {2, 0, 0}});
  const Case cases[] = {{"comb", comb(2), area_of_comb(2)},
                        {"longer comb", comb(9), area_of_comb(9)},
                        {"hole", with_hole, 8},
                        {"spiral", spiral, area_of_spiral},
                        {"spike", spiked, area_of_comb(2)},
                        {"a corner twice", doubled, area_of_comb(2)},
                        {"corners on a line", straight, area_of_comb(2)}};
  for (const Case& each : cases) {
    const std::size_t n = each.shape.size();
    for (std::size_t first = 0; first < n; ++first)
      for (const bool backwards : {false, true}) {
        const TriMesh mesh = split(vertices_of(each.shape), face_of(n, first, backwards));
        EXPECT_EQ(mesh.triangles.size(), n - 2) << each.name;
        EXPECT_DOUBLE_EQ(inspect(mesh).area, each.area) << each.name << " from " << first;
        EXPECT_DOUBLE_EQ(area_vector(mesh).z(), backwards ? -each.area : each.area)
            << each.name << " from " << first;
      }
  }
}

TEST(Polygons, ThatWereTurnedAndRoundedAreFlat) {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> number(-1, 1);
  for (int round = 0; round < 200; ++round) {
    const Eigen::Quaterniond turn =
        Eigen::Quaterniond(number(random), number(random), number(random), number(random)).normalized();
    Shape shape = round % 2 == 0 ? spiral : comb(5);
    for (Vec3& p : shape) p = turn * p + Vec3(100, -200, 300);
    const double area = round % 2 == 0 ? area_of_spiral : area_of_comb(5);
    for (const char* digits : {"v {} {} {}\n", "v {:.6g} {:.6g} {:.6g}\n"}) {
      const TriMesh mesh = split(vertices_of(shape, digits), face_of(shape.size()));
      // Half of the sixth digit along three axes moves each of the edges, 64 long together at most, by less than a thousandth.
      EXPECT_NEAR(area_vector(mesh).norm(), area, 64e-3) << round;
      EXPECT_NEAR(inspect(mesh).area, area, 64e-3) << round;
    }
  }
}

TEST(Polygons, OfHundredsOfCornersAreSplit) {
  const Shape shape = comb(249);
  EXPECT_EQ(shape.size(), 996u);
  EXPECT_DOUBLE_EQ(inspect(split(vertices_of(shape), face_of(shape.size()))).area, area_of_comb(249));
  const Shape many = comb(251);
  EXPECT_EQ(refusal(vertices_of(many), face_of(many.size())),
            "bone: face 0 has 1004 corners: polygons of more than 1000 are not split");
}

TEST(Polygons, WithoutAreaAreSplitInAnyWay) {
  EXPECT_EQ(inspect(split("v 0 0 0\nv 1 0 0\nv 2 0 0\nv 3 0 0", "f 1 2 3 4")).area, 0);
  EXPECT_EQ(inspect(split("v 0 0 0\nv 30 0 0\nv 10 0 0\nv 20 0 0", "f 1 2 3 4")).area, 0);
  EXPECT_EQ(inspect(split("v 5 5 5\nv 5 5 5\nv 5 5 5\nv 5 5 5", "f 1 2 3 4")).area, 0);
  // There and back again over a bend.
  EXPECT_EQ(inspect(split("v 0 0 0\nv 10 0 0\nv 10 10 0", "f 1 2 3 2")).area, 0);
  // On a line that six digits round.
  EXPECT_LT(
      inspect(split("v 33.3333 66.6667 0\nv 66.6667 133.333 0\nv 100 200 0\nv 0 0 0", "f 1 3 2 4")).area,
      0.1);
}

/// A comb whose corners are above and below their plane by turns.
Shape twisted_comb() {
  Shape shape = comb(2);
  for (std::size_t i = 0; i < shape.size(); ++i) shape[i].z() = i % 2 == 0 ? -0.25 : 0.25;
  return shape;
}

TEST(Polygons, ThatAreTwistedAreSplitWhereAGuessIsAskedFor) {
  const Shape twisted = twisted_comb();
  EXPECT_EQ(refusal(vertices_of(twisted), face_of(8)),
            "bone: face 0 of 8 corners is twisted, and convex from none of them: it can only be split by a "
            "guess (polygons: "
            "guess)");
  const io::MeshFile file = io::read_mesh(vertices_of(twisted) + face_of(8) + "\nf 1 2 3\nf 1 2 3 4\n",
                                          io::MeshFormat::obj, "bone", io::PolygonRule::guess);
  EXPECT_EQ(file.split_polygons, 2u);
  EXPECT_EQ(file.guessed_polygons, 1u);
  EXPECT_EQ(file.mesh.triangles.size(), 6u + 1 + 2);
  // Whatever the triangles, their boundary is that of the polygon, and so is the sum of their area vectors.
  Vec3 sum = Vec3::Zero(), of_polygon = Vec3::Zero();
  for (std::size_t t = 0; t < 6; ++t)
    sum += (file.mesh.corner(t, 1) - file.mesh.corner(t, 0))
               .cross(file.mesh.corner(t, 2) - file.mesh.corner(t, 0)) /
           2;
  for (std::size_t i = 0; i < 8; ++i) of_polygon += twisted[i].cross(twisted[(i + 1) % 8]) / 2;
  EXPECT_LT((sum - of_polygon).norm(), 1e-12);
  Vec3 middle = Vec3::Zero();
  for (const Vec3& p : twisted) middle += p / 8;
  double farthest = 0;
  for (const Vec3& p : twisted)
    farthest = std::max(farthest, std::abs((p - middle).dot(of_polygon.normalized())));
  EXPECT_DOUBLE_EQ(file.guessed_within, farthest);
}

TEST(Polygons, ThatCrossThemselvesAreRefusedUnlessAGuessIsAskedFor) {
  const std::string bow = "v 0 0 0\nv 4 2 0\nv 4 0 0\nv 0 1 0\n";
  EXPECT_EQ(refusal(bow, "f 1 2 3 4"),
            "bone: face 0 of 4 corners crosses itself: it can only be split by a guess (polygons: guess)");
  const io::MeshFile file =
      io::read_mesh(bow + "f 1 2 3 4\n", io::MeshFormat::obj, "bone", io::PolygonRule::guess);
  EXPECT_EQ(file.guessed_polygons, 1u);
  EXPECT_EQ(file.mesh.triangles, (std::vector<Triangle>{{0, 1, 2}, {0, 2, 3}}));
}

TEST(Polygons, AreFlatToAThousandthOfTheirSize) {
  Shape shape = comb(2);  // 3 by 3: a size of 4.24
  shape[3].z() = 4e-3;
  EXPECT_EQ(split(vertices_of(shape), face_of(8)).triangles.size(), 6u);
  shape[3].z() = 8e-3;
  test::expect_says(refusal(vertices_of(shape), face_of(8)), "is twisted");
}

TEST(Polygons, AreRefusedWhereTheyUseAVertexThatIsNotThere) {
  EXPECT_EQ(refusal("v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0", "f 1 2 3 5"), "bone: face 0 uses vertex 4 of 4");
}

}  // namespace
}  // namespace condyle
