#include <nlohmann/json.hpp>

#include "condyle/io/model_file.hpp"
#include "io/model/pose_of_rows.hpp"
#include "support/test.hpp"

// Poses of every joint of the shared models as an evaluator of another hand has them, which OpenSim's own positions of
// bodies confirm: their READMEs.

namespace condyle {
namespace {

using Json = nlohmann::json;

class ReferencePoses : public ::testing::TestWithParam<const char*> {
 protected:
  void SetUp() override {
    FOUND_OR_SKIP(data, test::shared_data());
    folder_ = *data / GetParam();
    if (!std::filesystem::exists(folder_)) GTEST_SKIP() << folder_ << " is missing";
    std::ifstream file(folder_ / "reference_poses.json");
    models_ = Json::parse(file)["models"];
  }

  std::filesystem::path folder_;
  Json models_;
};

TEST_P(ReferencePoses, AreThoseOfEveryJoint) {
  std::size_t poses = 0;
  for (const Json& of_model : models_) {
    const io::Model model = io::read_model(folder_ / of_model["model"].get<std::string>());
    EXPECT_EQ(model.version, of_model["version"].get<int>());
    for (const Json& expected : of_model["joints"]) {
      SCOPED_TRACE(model.path.string() + " " + expected["joint"].get<std::string>());
      const io::ModelJoint& joint = io::joint_named(model, expected["joint"].get<std::string>());
      EXPECT_EQ(joint.type, expected["type"].get<std::string>());
      EXPECT_EQ(joint.parent_body, expected["parent_body"].get<std::string>());
      EXPECT_EQ(joint.child_body, expected["child_body"].get<std::string>());
      EXPECT_TRUE(joint.X_PF.isApprox(test::pose_of_rows(expected["parent_frame_in_parent_body"]), 1e-15));
      EXPECT_TRUE(joint.X_CM.isApprox(test::pose_of_rows(expected["child_frame_in_child_body"]), 1e-15));
      ASSERT_EQ(joint.coordinates.size(), expected["coordinates"].size());
      for (std::size_t i = 0; i < joint.coordinates.size(); ++i) {
        const Json& coordinate = expected["coordinates"][i];
        EXPECT_EQ(joint.coordinates[i].name, coordinate["name"].get<std::string>());
        EXPECT_EQ(joint.coordinates[i].default_value, coordinate["default"].get<double>());
        EXPECT_EQ(joint.coordinates[i].is_locked, coordinate["locked"].get<bool>());
        EXPECT_EQ(joint.coordinates[i].is_clamped, coordinate["clamped"].get<bool>());
      }
      for (const Json& pose : expected["poses"]) {
        const Pose X = io::pose_of(joint, pose["q"].get<std::vector<double>>());
        const double off =
            (X.matrix() - test::pose_of_rows(pose["child_in_parent"]).matrix()).cwiseAbs().maxCoeff();
        EXPECT_LE(off, 1e-12) << pose["q"];
        ++poses;
      }
    }
  }
  EXPECT_GT(poses, 30u);
}

TEST_P(ReferencePoses, AreOfBodiesWithTheseMeshes) {
  for (const Json& of_model : models_) {
    const io::Model model = io::read_model(folder_ / of_model["model"].get<std::string>());
    for (const Json& expected : of_model["joints"]) {
      const io::ModelJoint& joint = io::joint_named(model, expected["joint"].get<std::string>());
      SCOPED_TRACE(model.path.string() + " " + joint.name);
      for (const auto& [role, key] :
           {std::pair{BodyRole::fixed, "meshes_of_parent"}, {BodyRole::mobile, "meshes_of_child"}}) {
        std::vector<io::ModelMesh> meshes = io::meshes_of(model, joint, role);
        const std::string& body = role == BodyRole::fixed ? joint.parent_body : joint.child_body;
        std::erase_if(meshes, [&](const io::ModelMesh& mesh) { return mesh.body != body; });  // welded to it
        std::string ours, theirs;
        for (const io::ModelMesh& mesh : meshes) ours += mesh.file + " ";
        for (const Json& mesh : expected[key]) theirs += mesh["file"].get<std::string>() + " ";
        ASSERT_EQ(ours, theirs) << key;
        for (std::size_t i = 0; i < meshes.size(); ++i) {
          const Json& mesh = expected[key][i];
          for (int k = 0; k < 3; ++k)
            EXPECT_EQ(meshes[i].scale[k], mesh["scale_factors"][static_cast<std::size_t>(k)].get<double>());
          EXPECT_TRUE(meshes[i].X_BG.isApprox(test::pose_of_rows(mesh["pose_in_body"]), 1e-14))
              << mesh["file"];
        }
      }
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Models, ReferencePoses,
                         ::testing::Values("osim_lenhart2015", "osim_gait2354", "osim_small"),
                         [](const auto& test) { return std::string(test.param); });

TEST(RefusedModels, EndInOneLine) {
  const auto data = test::shared_data();
  if (!data || !std::filesystem::exists(*data / "osim_small" / "refused"))
    GTEST_SKIP() << "no models to refuse";
  std::size_t files = 0;
  for (const auto& entry : std::filesystem::directory_iterator(*data / "osim_small" / "refused")) {
    SCOPED_TRACE(entry.path().string());
    try {
      const io::Model model = io::read_model(entry.path());
      std::string why;
      for (const io::ModelJoint& joint : model.joints)
        if (!joint.transform) why = joint.why_not;
      EXPECT_FALSE(why.empty()) << "nothing was refused";
      throw FileError(why);
    } catch (const FileError& error) {
      const std::string line = error.what();
      test::expect_silent(line, "\n");
      EXPECT_EQ(line.find(entry.path().string() + ": "), 0u) << line;
      EXPECT_LT(line.size(), 400u);
      ::testing::Test::RecordProperty(entry.path().stem().string(), line);
    }
    ++files;
  }
  EXPECT_GE(files, 17u);
}

}  // namespace
}  // namespace condyle
