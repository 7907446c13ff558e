#include "condyle/io/provenance.hpp"

#include "condyle/io/mesh_file.hpp"
#include "io/file/whole_file.hpp"
#include "io/result/provenance_forms.hpp"
#include "support/joint_text.hpp"
#include "support/test.hpp"

namespace condyle::test {
namespace {

/// A joint in metres, turned and shifted, whose mobile mesh is given in a pose of its own.
class ProvenanceOfAJoint : public ::testing::Test {
 protected:
  ProvenanceOfAJoint() {
    io::write_mesh(folder / "fixed.ply", box({0.3, 0.1, 0.2}, {0.5, 0.4, 0.7}));
    io::write_mesh(folder / "mobile.ply", sphere({0.1, -0.2, 0.3}, 0.04, 2));
    folder.file("joint.toml", joint_text({.side = "left",
                                          .units = "m",
                                          .centre = "[0.1, -0.2, 0.3]",
                                          .axes = "anterior = [0, 0, 1]\nsuperior = [1, 0, 0]\n",
                                          .more = "[reference_pose]\nflexion = 57\nadduction = -10.1\n"}));
  }
  io::LoadedJoint read() const { return io::read_joint(folder / "joint.toml"); }

  const TemporaryFolder folder;
};

/// Coordinates of a few hundred mm, five products and sums each.
constexpr double rounding_mm = 1e-12 * 1000;

void expect_near(const TriMesh& a, const TriMesh& b, double tolerance) {
  EXPECT_EQ(a.triangles, b.triangles);
  EXPECT_LT(farthest(a.vertices, b.vertices), tolerance);
}

TEST_F(ProvenanceOfAJoint, NamesItsFilesBySizeAndDigest) {
  const io::Provenance from = io::provenance_of(read(), {"depth", "joint.toml"});
  EXPECT_EQ(from.fixed.files[0].digest, io::digest_of(io::read_whole_file(folder / "fixed.ply")));
  EXPECT_EQ(from.mobile.files[0].digest, io::digest_of(io::read_whole_file(folder / "mobile.ply")));
  EXPECT_EQ(from.joint_digest, io::digest_of(io::read_whole_file(folder / "joint.toml")));
  EXPECT_EQ(from.fixed.files[0].path, folder / "fixed.ply");
}

TEST_F(ProvenanceOfAJoint, ItsMatricesBringVerticesOfTheFilesIntoTheJointAndBack) {
  const io::LoadedJoint loaded = read();
  const io::Provenance from = io::provenance_of(loaded, {});
  for (const auto& [origin, body] :
       {std::pair(from.fixed, loaded.joint.fixed), {from.mobile, loaded.joint.mobile}}) {
    const TriMesh of_file = io::read_mesh(origin.files[0].path).mesh;
    for (std::size_t v = 0; v < of_file.vertices.size(); ++v) {
      const Vec3 p_joint = body.mesh.vertices()[v];
      EXPECT_LT((origin.joint_from_source * of_file.vertices[v] - p_joint).norm(), rounding_mm);
      EXPECT_LT((origin.source_from_joint * p_joint - of_file.vertices[v]).norm(), rounding_mm / 1000);
    }
  }
}

TEST_F(ProvenanceOfAJoint, TheSourceFrameLaysMeshesOnTheirFilesAndGivesPointsInMillimetres) {
  const io::LoadedJoint loaded = read();
  const io::AnswerFrame source = io::provenance_of(loaded, {}, io::AnswerFrameName::source).frame;
  const TriMesh fixed = io::read_mesh(folder / "fixed.ply").mesh,
                mobile = io::read_mesh(folder / "mobile.ply").mesh;
  expect_near(source.fixed_mesh(loaded.joint.fixed.mesh), fixed, rounding_mm / 1000);
  expect_near(source.mobile_mesh(loaded.joint.mobile.mesh), mobile, rounding_mm / 1000);
  EXPECT_LT((source.fixed_point(loaded.joint.fixed.mesh.vertices()[3]) - 1000 * fixed.vertices[3]).norm(),
            rounding_mm);
  EXPECT_LT((source.mobile_point(loaded.joint.mobile.mesh.vertices()[5]) - 1000 * mobile.vertices[5]).norm(),
            rounding_mm);
  EXPECT_LT((source.fixed_direction({1, 0, 0}) - Vec3(0, 0, 1)).norm(), 1e-15) << "anterior";
}

TEST_F(ProvenanceOfAJoint, TheJointFrameChangesNoBit) {
  const io::LoadedJoint loaded = read();
  const io::AnswerFrame joint = io::provenance_of(loaded, {}).frame;
  EXPECT_EQ(joint.fixed_mesh(loaded.joint.fixed.mesh), loaded.joint.fixed.mesh.arrays());
  EXPECT_EQ(joint.mobile_mesh(loaded.joint.mobile.mesh), loaded.joint.mobile.mesh.arrays());
  EXPECT_EQ(joint.fixed_point({0.1, 0.2, 0.3}), Vec3(0.1, 0.2, 0.3));
}

TEST_F(ProvenanceOfAJoint, IsOneLineForEachThingInACsv) {
  const io::Provenance from =
      io::provenance_of(read(), {"depth", "a b\n.toml", "--pose", "flexion=57 adduction=1"});
  const std::string text = io::provenance_comments(&from);
  expect_says(text, "# condyle_command: condyle depth 'a b?.toml' --pose 'flexion=57 adduction=1'\n");
  expect_says(text, "# side: left\n");
  expect_says(text, "# frame: joint\n");
  expect_says(text, "# units_of_meshes: m\n");
  std::istringstream lines(text);
  for (std::string line; std::getline(lines, line);) expect_begins(line, "# ");
  expect_silent(text, " -0 ");
  EXPECT_EQ(io::provenance_comments(nullptr), "");
  EXPECT_TRUE(io::provenance_json(nullptr).is_null());
}

TEST(AnswerFrameName, IsJointOrSource) {
  for (const auto name : {io::AnswerFrameName::joint, io::AnswerFrameName::source})
    EXPECT_EQ(io::answer_frame_named(name_of(name)), name);
  EXPECT_THROW(io::answer_frame_named("world"), UsageError);
}

}  // namespace
}  // namespace condyle::test
