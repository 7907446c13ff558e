#include "condyle/contact.hpp"
#include "condyle/io/joint_file.hpp"
#include "condyle/io/mesh_file.hpp"
#include "condyle/io/provenance.hpp"
#include "io/result/frame_result.hpp"
#include "support/joint_text.hpp"
#include "support/test.hpp"

/// Bodies of several meshes.

namespace condyle {
namespace {

TriMesh bone() {
  return test::box({-25, -300, -35}, {25, -20, 35});
}
TriMesh meniscus() {
  return test::sphere({0, -10, 20}, 8, 2);
}

class JointParts : public ::testing::Test {
 protected:
  void SetUp() override {
    io::write_mesh(folder / "femur.ply", test::box({-30, 0, -40}, {30, 300, 40}));
    io::write_mesh(folder / "tibia.ply", bone());
    io::write_mesh(folder / "meniscus.ply", meniscus());
  }
  std::filesystem::path write(std::string_view mobile) const {
    const std::string named = "name = \"shank\"\n" + std::string(mobile);
    return folder.file("joint.toml", test::joint_text({.kind = "free",
                                                       .keys = "joint = \"knee\"\n",
                                                       .fixed = "mesh = \"femur.ply\"",
                                                       .mobile = named}));
  }
  std::string refusal(std::string_view mobile) const { return test::joint_refusal(write(mobile)); }

  const test::TemporaryFolder folder;
  static constexpr const char* two =
      "meshes = [{ name = \"tibia\", mesh = \"tibia.ply\" },\n"
      "          { name = \"meniscus\", mesh = \"meniscus.ply\", repair = [\"weld\"] }]";
};

TEST_F(JointParts, AreOneMeshThatKnowsItsParts) {
  const auto [joint, report] = io::read_joint(write(two));
  const Body& shank = joint.mobile;
  ASSERT_EQ(shank.parts.size(), 2u);
  EXPECT_EQ(shank.mesh.vertices().size(), bone().vertices.size() + meniscus().vertices.size());
  EXPECT_TRUE(shank.mesh.is_closed());
  EXPECT_EQ(mesh_of_part(shank, "tibia").arrays(), bone());
  EXPECT_EQ(mesh_of_part(shank, "meniscus").arrays(), meniscus());
  EXPECT_THROW(mesh_of_part(shank, "fibula"), UsageError);
  EXPECT_EQ(report.mobile.size(), 2u);
  EXPECT_EQ(report.mobile[1].repairs.size(), 1u);
  EXPECT_TRUE(joint.fixed.parts.empty());
}

TEST_F(JointParts, CanBeBearing) {
  const Body shank =
      io::read_joint(write("meshes = [{ name = \"tibia\", mesh = \"tibia.ply\" },\n"
                           "  { name = \"meniscus\", mesh = \"meniscus.ply\", bearing = true }]"))
          .joint.mobile;
  EXPECT_EQ(shank.parts[0].contact, PartContact::ends);
  EXPECT_EQ(shank.parts[1].contact, PartContact::bearing);
  EXPECT_EQ(refusal("meshes = [{ name = \"tibia\", mesh = \"tibia.ply\", bearing = true }]"),
            "line 11: mobile.meshes: none of them ends a motion: one needs contact = \"ends\"");
  EXPECT_EQ(refusal("meshes = [{ name = \"tibia\", mesh = \"tibia.ply\", bearing = 1 }]"),
            "line 11: mobile.meshes[0].bearing: must be true or false, not a whole number");
}

TEST_F(JointParts, NameThePartOfAVertexAndATriangle) {
  const Body shank = io::read_joint(write(two)).joint.mobile;
  const std::size_t vertices = bone().vertices.size(), triangles = bone().triangles.size();
  EXPECT_EQ(part_of_vertex(shank, vertices - 1)->name, "tibia");
  EXPECT_EQ(part_of_vertex(shank, vertices)->name, "meniscus");
  EXPECT_EQ(part_of_triangle(shank, triangles - 1)->name, "tibia");
  EXPECT_EQ(part_of_triangle(shank, triangles)->name, "meniscus");
  EXPECT_EQ(part_of_vertex({"one", bone()}, 0), nullptr);
}

TEST_F(JointParts, AreMetAsIfTheyWereBodiesOfTheirOwn) {
  const Joint joint = io::read_joint(write(two)).joint;
  Pose X_FM(Eigen::Translation3d(
      0, 6, 0));  // the meniscus reaches 4 mm into the femur, the tibia stays 14 mm below it
  const contact::JointContact whole(joint),
      meniscus_only(joint.fixed.mesh, mesh_of_part(joint.mobile, "meniscus"));
  auto pairs = whole.pairs(X_FM);
  EXPECT_FALSE(pairs.empty());
  for (contact::TrianglePair& pair : pairs)
    pair.mobile -= static_cast<Index>(joint.mobile.parts[1].first_triangle);
  const auto expected = meniscus_only.pairs(X_FM);
  ASSERT_EQ(pairs.size(), expected.size());
  for (std::size_t i = 0; i < pairs.size(); ++i) {
    EXPECT_EQ(pairs[i].fixed, expected[i].fixed);
    EXPECT_EQ(pairs[i].mobile, expected[i].mobile);
  }
}

TEST_F(JointParts, AreReportedOneByOneWithTheirFiles) {
  const io::LoadedJoint loaded = io::read_joint(write(two));
  const io::Provenance from = io::provenance_of(loaded, {});
  ASSERT_EQ(from.mobile.files.size(), 2u);
  EXPECT_EQ(from.mobile.files[1].part, "meniscus");
  EXPECT_EQ(from.mobile.files[1].path, folder / "meniscus.ply");
  test::expect_says(io::to_text(loaded), "shank, meniscus: ");
  test::expect_says(io::frame_json(loaded, {}, &from), "\"name\": \"meniscus\"");
}

TEST_F(JointParts, WithoutSenseAreRefusedByLineAndKey) {
  EXPECT_EQ(refusal("mesh = \"tibia.ply\"\n" + std::string(two)),
            "line 11: mobile.mesh: with meshes each of them has its own");
  EXPECT_EQ(refusal("meshes = []"), "line 11: mobile.meshes: must name one mesh or more");
  EXPECT_EQ(refusal("meshes = [{ mesh = \"tibia.ply\" }]"), "line 11: mobile.meshes[0].name: is missing");
  EXPECT_EQ(
      refusal("meshes = [{ name = \"a\", mesh = \"tibia.ply\" }, { name = \"a\", mesh = \"tibia.ply\" }]"),
      "line 11: mobile.meshes[1].name: \"a\" is given twice");
  test::expect_says(refusal("meshes = [{ name = \"a\", mesh = \"no.ply\" }]"),
                    "mobile.meshes[0].mesh: there is no file");
  EXPECT_EQ(refusal("meshes = [{ name = \"a\", mesh = \"tibia.ply\", poze = 1 }]").substr(0, 36),
            "line 11: mobile.meshes[0].poze: unkn");
}

}  // namespace
}  // namespace condyle
