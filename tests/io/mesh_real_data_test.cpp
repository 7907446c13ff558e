#include <unistd.h>

#include <nlohmann/json.hpp>

#include "condyle/inspect.hpp"
#include "condyle/io/mesh_file.hpp"
#include "support/test.hpp"

namespace condyle {
namespace {

using Json = nlohmann::json;

#define SKIP_WITHOUT_DATA()                                 \
  if (!std::filesystem::exists(test::shared_data_folder())) \
  GTEST_SKIP() << "no real meshes at " << test::shared_data_folder()

Json read_json(const std::filesystem::path& path) {
  std::ifstream file(path);
  return Json::parse(file);
}

/// A stated number is rounded to its last printed digit: half of that away at most.
constexpr double half_of(double last_digit) {
  return 0.5 * last_digit * (1 + 1e-9);
}

/// Unit of the last of `digits` significant digits.
double last_digit(double stated, int digits) {
  return std::pow(10, std::floor(std::log10(std::abs(stated))) - (digits - 1));
}

/// The stated medians count an edge once for each of its triangles, ours once: the same where every edge has
/// two.
double median_side(const TriMesh& mesh) {
  std::vector<double> lengths;
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    for (int k = 0; k < 3; ++k) lengths.push_back((mesh.corner(t, (k + 1) % 3) - mesh.corner(t, k)).norm());
  }
  std::sort(lengths.begin(), lengths.end());
  return (lengths[(lengths.size() - 1) / 2] + lengths[lengths.size() / 2]) / 2;
}

/// Holds a mesh against what a data set states about a mesh. Coordinates there are floats, and the stated
/// measures were made from them.
void expect_as_stated(const TriMesh& mesh, const Json& stated) {
  const MeshReport report = inspect(mesh);
  const std::string file = stated["file"];
  EXPECT_EQ(report.vertices, stated["vertices"]) << file;
  EXPECT_EQ(report.triangles, stated["triangles"]) << file;
  EXPECT_EQ(report.is_closed(), stated["closed"]) << file;
  EXPECT_EQ(report.boundary_edges.count, stated["boundary_edges"]) << file;
  EXPECT_EQ(report.boundary_loops.count, stated["boundary_loops"]) << file;
  EXPECT_EQ(report.non_manifold_edges.count, stated["nonmanifold_edges"]) << file;
  EXPECT_EQ(report.non_manifold_vertices.count, stated["nonmanifold_vertices"]) << file;
  EXPECT_EQ(report.inconsistent_edges.count, stated["inconsistent_edges"]) << file;
  EXPECT_EQ(report.components.size(), stated["components"]) << file;
  const auto largest =
      std::max_element(report.components.begin(), report.components.end(),
                       [](const auto& a, const auto& b) { return a.triangles < b.triangles; });
  ASSERT_NE(largest, report.components.end());
  EXPECT_EQ(largest->genus,
            stated["genus"][0].is_null() ? std::nullopt : std::optional<int>(stated["genus"][0]))
      << file;
  EXPECT_EQ(report.signed_volume.has_value(), !stated["volume_mm3"].is_null()) << file;
  if (report.signed_volume) {
    EXPECT_NEAR(*report.signed_volume, stated["volume_mm3"].get<double>(), half_of(0.01)) << file;
  }
  EXPECT_NEAR(report.area, stated["area_mm2"].get<double>(), half_of(0.01)) << file;
  const double lengths[] = {report.edge_lengths.shortest, median_side(mesh), report.edge_lengths.longest};
  for (int k = 0; k < 3; ++k) {
    const double length = stated["edge_min_median_max_mm"][k];
    EXPECT_NEAR(lengths[k], length, half_of(last_digit(length, 4))) << file;
    EXPECT_NEAR(report.bounds.low[k], stated["bbox_min"][k].get<double>(), half_of(0.001)) << file;
    EXPECT_NEAR(report.bounds.high[k], stated["bbox_max"][k].get<double>(), half_of(0.001)) << file;
  }
  if (report.is_closed()) {
    EXPECT_EQ(report.edge_lengths.median, lengths[1]) << file;
  }
}

void expect_folder_as_stated(const std::string& name, std::size_t meshes) {
  const auto folder = test::shared_data_folder() / name;
  const Json stated = read_json(folder / "meta.json");
  EXPECT_EQ(stated["meshes"].size(), meshes);
  for (const auto& mesh : stated["meshes"]) {
    expect_as_stated(io::read_mesh(folder / mesh["file"].get<std::string>()).mesh, mesh);
  }
}

TEST(RealMeshes, OfTheLibHipSubjectAreAsStated) {
  SKIP_WITHOUT_DATA();
  expect_folder_as_stated("hip_libhip_m1_left", 7);
}

TEST(RealMeshes, OfTheVisibleHumanHipAreAsStated) {
  SKIP_WITHOUT_DATA();
  expect_folder_as_stated("hip_vhf_right", 2);
}

TEST(RealMeshes, OfTheKneeAreAsStated) {
  SKIP_WITHOUT_DATA();
  expect_folder_as_stated("knee_lenhart2015_right", 9);
}

TEST(RealMeshes, OfTheCoarseTeachingModelAreAsStated) {
  SKIP_WITHOUT_DATA();
  expect_folder_as_stated("hip_gait2392_lowres_dirty", 2);
}

TEST(RealMeshes, TheDirtyPelvisHasOneDuplicateTriangle) {
  SKIP_WITHOUT_DATA();
  auto mesh = io::read_mesh(test::shared_data_folder() / "hip_gait2392_lowres_dirty/pelvis_r.ply").mesh;
  const auto report = inspect(mesh);
  EXPECT_EQ(report.duplicate_triangles.count, 1u);
  mesh.triangles.erase(mesh.triangles.begin() + *report.duplicate_triangles.first);
  const auto without = inspect(mesh);
  EXPECT_EQ(without.boundary_edges.count, 17u);
  EXPECT_EQ(without.boundary_loops.count, 4u);
  EXPECT_EQ(without.non_manifold_edges.count, 0u);
}

/// The VTP files are the sources in metres and their own frames; the PLY files the same in millimetres,
/// moved.
TEST(RealMeshes, TheTeachingModelsVtpAndPlyAreOneSurface) {
  SKIP_WITHOUT_DATA();
  const auto folder = test::shared_data_folder() / "hip_gait2392_lowres_dirty";
  for (const auto& [vtp, ply] : {std::pair{"femur_r.vtp", "femur_r.ply"}, {"pelvis.vtp", "pelvis_r.ply"}}) {
    const auto metres = io::read_mesh(folder / vtp).mesh, millimetres = io::read_mesh(folder / ply).mesh;
    EXPECT_EQ(metres.triangles, millimetres.triangles);
    EXPECT_EQ(inspect(metres).likely_unit.unit, LengthUnit::metres);
    EXPECT_EQ(inspect(millimetres).likely_unit.unit, LengthUnit::millimetres);
  }
}

TEST(RealMeshes, TheDirtyFemurIsAsStatedAfterTheExactWeld) {
  SKIP_WITHOUT_DATA();
  const auto folder = test::shared_data_folder() / "femur_libhip_m5_right_dirty";
  const Json stated = read_json(folder / "meta.json");
  const auto read = io::read_mesh(folder / "femur_tracked_surface.stl");
  EXPECT_EQ(read.welded_vertices, stated["exact_duplicate_vertices"]);
  expect_as_stated(read.mesh, stated["after_exact_weld"]);
  EXPECT_EQ(inspect(read.mesh).duplicate_vertices.count, 0u);
}

TEST(RealMeshes, TheMirroredBonesAreInvertedAndCarryOtherBonesVertices) {
  SKIP_WITHOUT_DATA();
  const auto folder = test::shared_data_folder() / "hip_vhf_right/dirty";
  auto femur = io::read_mesh(folder / "FemurL_source.obj").mesh;
  const auto report = inspect(femur);
  EXPECT_TRUE(report.is_closed());
  EXPECT_LT(report.signed_volume.value(), 0);
  EXPECT_EQ(report.inverted_components.count, report.components.size());
  EXPECT_EQ(report.unreferenced_vertices.count, 7547u);
  EXPECT_EQ(report.likely_unit.unit, LengthUnit::metres);

  EXPECT_EQ(drop_unreferenced_vertices(femur), 7547u);
  EXPECT_EQ(flip_inverted(femur), femur.triangles.size());
  const auto repaired = inspect(femur);
  EXPECT_EQ(repaired.unreferenced_vertices.count, 0u);
  EXPECT_EQ(repaired.inverted_components.count, 0u);
  EXPECT_EQ(repaired.signed_volume.value(), -report.signed_volume.value());
  EXPECT_EQ(repaired.area, report.area);

  const auto pelvis = inspect(io::read_mesh(folder / "PelvisL_source.obj").mesh);
  EXPECT_TRUE(pelvis.is_closed());
  EXPECT_LT(pelvis.signed_volume.value(), 0);
}

TEST(RealMeshes, ComeBackBitForBitFromTheFilesWeWrite) {
  SKIP_WITHOUT_DATA();
  const auto mesh =
      io::read_mesh(test::shared_data_folder() / "femur_libhip_m5_right_dirty/femur_tracked_surface.stl")
          .mesh;
  for (const char* extension : {".ply", ".vtp"}) {
    const auto path =
        std::filesystem::temp_directory_path() / ("condyle_real_" + std::to_string(::getpid()) + extension);
    io::write_mesh(path, mesh);
    EXPECT_EQ(io::read_mesh(path).mesh, mesh);
    std::filesystem::remove(path);
  }
}

}  // namespace
}  // namespace condyle
