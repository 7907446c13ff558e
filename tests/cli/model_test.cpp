#include <gtest/gtest.h>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <fstream>
#include <nlohmann/json.hpp>

#include "condyle/io/mesh_file.hpp"
#include "motion_scene.hpp"
#include "support/knee_model.hpp"
#include "support/shared_data.hpp"
#include "support/test_meshes.hpp"

/// Models of OpenSim on the command line.

namespace condyle::test {
namespace {

std::optional<fs::path> shared_model(const char* name) {
  const auto data = shared_data();
  if (!data || !fs::exists(*data / name)) return std::nullopt;
  return fs::absolute(*data / name);
}

struct PublishedContact {
  const char *joint, *by_hand, *mobile;
};
class PublishedModel : public ::testing::TestWithParam<PublishedContact> {};

TEST_P(PublishedModel, GivesTheNumbersOfAJointFileByHand) {
  if (!has_knee_model()) GTEST_SKIP() << "the shared knee or its model is missing";
  ::setenv("CONDYLE_DATA", fs::absolute(shared_data_folder()).c_str(), 1);
  const TemporaryFolder folder;
  write_knee_model(folder.path(), {"femur", GetParam().mobile});
  const std::string states =
      fs::absolute(shared_data_folder() / "knee_lenhart2015_right/passive_flexion_states.sto").string();
  const Ran made = run_condyle(
      folder.path(), fmt::format("init lenhart2015.osim --joint {} -o joint.toml", GetParam().joint));
  ASSERT_EQ(made.exit_code, 0) << made.err;
  EXPECT_NE(made.err.find("is missing and left out"), std::string::npos) << "bones are not there";
  const std::string question = fmt::format(" --motion {} --load --out ", states);
  for (const std::string& from :
       {std::string("joint.toml") + question + "file",
        fmt::format("lenhart2015.osim --joint {}{}model", GetParam().joint, question),
        fmt::format("{}/{}{}hand", CONDYLE_KNEE_BY_HAND, GetParam().by_hand, question)}) {
    const Ran ran = run_condyle(folder.path(), "motion " + from);
    ASSERT_EQ(ran.exit_code, 0) << from << "\n" << ran.err;
  }
  const NumberTable file = csv_of(folder / "file/curves.csv"), direct = csv_of(folder / "model/curves.csv"),
                    hand = csv_of(folder / "hand/curves.csv");
  EXPECT_EQ(file.rows, direct.rows);
  ASSERT_EQ(file.columns, hand.columns);
  ASSERT_EQ(file.rows.size(), 251u);
  for (std::size_t row = 0; row < file.rows.size(); ++row)
    for (std::size_t column = 0; column < file.columns.size(); ++column) {
      const double wanted = hand.rows[row][column];
      if (std::isnan(wanted)) continue;
      EXPECT_NEAR(file.rows[row][column], wanted, 1e-10 * std::max(1.0, std::abs(wanted)))
          << file.columns[column] << " in frame " << row;
    }
}

INSTANTIATE_TEST_SUITE_P(Knee, PublishedModel,
                         ::testing::Values(PublishedContact{"knee_r", "tibiofemoral.toml", "tibia"},
                                           PublishedContact{"pf_r", "patellofemoral.toml", "patella"}),
                         [](const auto& test) { return std::string(test.param.joint); });

/// A ball on a rod in a cup of a model, and the same by hand.
class ModelHip : public testing::Test {
 protected:
  void SetUp() override {
    const auto gait = shared_model("osim_gait2354");
    if (!gait) GTEST_SKIP() << "the shared models are missing";
    gait_ = *gait;
  }
  Ran run(const std::string& arguments) const { return run_condyle(folder_.path(), arguments); }

  /// model.toml by init, and hand.toml: the pelvis is three meshes, and numbers are those that the model's text has.
  void make_both() const {
    const Ran made =
        run("init " + (gait_ / "gait2354_simbody.osim").string() + " --joint hip_r -o model.toml");
    ASSERT_EQ(made.exit_code, 0) << made.err;
    const auto mesh = [&](const char* name) { return (gait_ / "Geometry" / name).string(); };
    folder_.file("hand.toml", fmt::format(R"(condyle = 1
name = "hip"
kind = "ball"
side = "right"
units = "m"
[fixed]
meshes = [{{ name = "sacrum", mesh = "{}", polygons = "split" }}, {{ name = "right", mesh = "{}", polygons = "split" }},
          {{ name = "left", mesh = "{}", polygons = "split" }}]
[mobile]
mesh = "{}"
polygons = "split"
pose = {{ translation = [-0.0707, -0.0661, 0.0835] }}
[frame]
centre = [-0.0707, -0.0661, 0.0835]
anterior = [1, 0, 0]
superior = [0, 1, 0]
)",
                                          mesh("sacrum.vtp"), mesh("pelvis.vtp"), mesh("l_pelvis.vtp"),
                                          mesh("femur_r.vtp")));
  }

  fs::path gait_;
  TemporaryFolder folder_;
};

TEST_F(ModelHip, HasTheLimitsOfAJointFileByHand) {
  make_both();
  const std::string question = " --accept-reference-contact --bearing count --json";
  const Ran by_model = run("rom model.toml" + question), by_hand = run("rom hand.toml" + question);
  ASSERT_EQ(by_model.exit_code, 0) << by_model.err;
  ASSERT_EQ(by_hand.exit_code, 0) << by_hand.err;
  const Json limits = Json::parse(by_model.out)["motions"], wanted = Json::parse(by_hand.out)["motions"];
  ASSERT_EQ(limits.size(), 12u);
  for (std::size_t i = 0; i < limits.size(); ++i) {
    EXPECT_EQ(limits[i]["reason"], wanted[i]["reason"]);
    if (!wanted[i]["limit_deg"].is_number()) continue;
    EXPECT_NEAR(limits[i]["limit_deg"].get<double>(), wanted[i]["limit_deg"].get<double>(), 1e-6)
        << limits[i]["name"];
  }
}

TEST_F(ModelHip, HasTheCurvesOfAWalkThatAJointFileByHandHas) {
  const fs::path walk = fs::absolute(shared_data_folder() / "motion_gait2354_walk/subject01_walk1_ik.mot");
  if (!fs::exists(walk)) GTEST_SKIP() << walk << " is missing";
  make_both();
  std::ofstream(folder_ / "hand.toml", std::ios::app)
      << "[recorded_motion]\nflexion = \"hip_flexion_r\"\nadduction = \"hip_adduction_r\"\n"
         "internal_rotation = \"hip_rotation_r\"\n";
  for (const char* name : {"model", "hand"}) {
    const Ran ran = run(fmt::format("motion {0}.toml --motion {1} --out {0}", name, walk.string()));
    ASSERT_EQ(ran.exit_code, 0) << ran.err;
  }
  const NumberTable curves = csv_of(folder_ / "model/curves.csv"),
                    wanted = csv_of(folder_ / "hand/curves.csv");
  ASSERT_EQ(curves.columns, wanted.columns);
  ASSERT_EQ(curves.rows.size(), wanted.rows.size());
  ASSERT_GT(curves.rows.size(), 60u);
  for (std::size_t row = 0; row < curves.rows.size(); ++row)
    for (std::size_t column = 0; column < curves.columns.size(); ++column) {
      const double by_hand = wanted.rows[row][column];
      if (std::isnan(by_hand))
        EXPECT_TRUE(std::isnan(curves.rows[row][column]));
      else
        EXPECT_NEAR(curves.rows[row][column], by_hand, 1e-9 * std::max(1.0, std::abs(by_hand)))
            << curves.columns[column] << " in frame " << row;
    }
}

TEST_F(ModelHip, IsInspected) {
  const std::string model = (gait_ / "subject01_simbody_adjusted.osim").string();
  const Ran text = run("inspect " + model);
  ASSERT_EQ(text.exit_code, 0) << text.err;
  EXPECT_NE(text.out.find("hip_l: femur_l in pelvis, ball (CustomJoint); meshes found 3 of 3 and 0 of 1"),
            std::string::npos)
      << text.out;
  EXPECT_NE(text.out.find("missing: femur_l.vtp of femur_l"), std::string::npos) << text.out;
  const Json json = Json::parse(run("inspect " + model + " --json").out)["models"][0];
  EXPECT_EQ(json["name"], "subject01");
  EXPECT_EQ(json["joints"].size(), 12u);
  EXPECT_EQ(json["not_used"]["Thelen2003Muscle"], 54);
}

TEST_F(ModelHip, IsARowOfAStudy) {
  folder_.file("hips.csv",
               fmt::format("id,opensim_model,opensim_joint\nright,{0},hip_r\nnone,{0},hip\nempty,{0},\n",
                           (gait_ / "gait2354_simbody.osim").string()));
  const Ran ran = run("study hips.csv --accept-reference-contact --out study");
  ASSERT_EQ(ran.exit_code, 0) << ran.err;
  std::ifstream file(folder_ / "study/failures.csv");
  const std::string failures((std::istreambuf_iterator<char>(file)), {});
  EXPECT_NE(failures.find("no joint 'hip'"), std::string::npos) << failures;
  EXPECT_NE(failures.find("column 'opensim_joint': a joint is needed beside opensim_model"),
            std::string::npos)
      << failures;
  EXPECT_EQ(failures.find("right,"), std::string::npos) << failures;
}

TEST_F(ModelHip, SaysInOneLineWhatIsWrong) {
  const std::string model = (gait_ / "gait2354_simbody.osim").string();
  const struct {
    std::string arguments;
    int exit_code;
    std::string line;
  } cases[] = {
      {"init " + model, 2, "--joint: is needed, one of ground_pelvis, hip_r"},
      {"init " + model + " --joint hipr", 2, "no joint 'hipr' (did you mean \"hip_r\"?)"},
      {"init " + model + " --joint hip_l -o out.toml", 3, "no mesh of body 'femur_l' was found; looked for"},
      {"init " + model + " femur.ply --joint hip_r", 2, "MOBILE: a model has both bodies"},
      {"init " + model + " --joint hip_r --contact tf", 2, "no contact 'tf'; there are none"},
      {"init " + model + " --joint hip_r --axes LPS", 2,
       "--axes: is for label maps, and " + model + " is none"},
      {"init " + model + " --joint hip_r --task total", 2, "--task: is for label maps"},
      {"init a.ply b.ply --pieces all", 2, "--pieces: is for label maps, and a.ply is none"},
      {"inspect " + model + " --axes LPS", 2, "--axes: is for label maps"},
      {"inspect femur.ply --elsewhere", 2, "--elsewhere: is for label maps"},
      {"init " + model + " --joint hip_r --geometry nowhere", 3,
       "nowhere: is no folder that meshes can be looked"},
      {"inspect " + model + " --geometry femur.ply", 3, "femur.ply: is no folder that meshes can be looked"},
      {"motion " + model + " --joint hip_r --motion a.mot --geometry nowhere", 3, "nowhere: is no folder"},
      {"init a.ply b.ply --anatomy knee", 2, "are for models of OpenSim"},
      {"init a.ply b.ply --joint ne", 2, "two meshes are a hip, knee, ankle, elbow or shoulder, not ne"},
      {"motion hip.toml --motion a.mot --joint hip_r", 2, "are for models of OpenSim"},
      {"inspect " + model + " femur.ply", 2, "are inspected one after the other"},
      {"inspect femur.ply --geometry .", 2, "--geometry: is for models of OpenSim"},
      {"inspect nowhere.osim", 3, "nowhere.osim: no such file"},
  };
  for (const auto& [arguments, exit_code, line] : cases) {
    const Ran ran = run(arguments);
    EXPECT_EQ(ran.exit_code, exit_code) << arguments << "\n" << ran.err;
    EXPECT_NE(ran.err.find(line), std::string::npos) << arguments << "\n" << ran.err;
    EXPECT_EQ(ran.out, "") << arguments;
  }
  EXPECT_FALSE(fs::exists(folder_ / "out.toml")) << "no file is left that cannot be read";
}

TEST_F(ModelHip, NotesAMotionThatLeavesItsRanges) {
  const std::string model = (gait_ / "gait2354_simbody.osim").string();
  folder_.file("far.mot",
               "inDegrees=yes\nendheader\ntime hip_flexion_r hip_adduction_r hip_rotation_r knee_angle_r\n"
               "0 0 0 0 0\n1 130 0 0 20\n2 10 0 0 -60\n");
  for (const char* joint : {"hip_r", "knee_r"}) {
    const Ran ran = run(fmt::format("motion {} --joint {} --motion far.mot --json", model, joint));
    ASSERT_EQ(ran.exit_code, 0) << ran.err;
    EXPECT_NE(ran.err.find("condyle: note: beyond_range: "), std::string::npos) << ran.err;
    const Json notes = Json::parse(ran.out)["notes"];
    EXPECT_TRUE(std::any_of(notes.begin(), notes.end(),
                            [](const Json& note) { return note["code"] == "beyond_range"; }));
    EXPECT_NE(ran.err.find("in 1 of 3 frames"), std::string::npos) << ran.err;
    EXPECT_EQ(run(fmt::format("motion {} --joint {} --motion far.mot --strict", model, joint)).exit_code, 4);
  }
}

TEST(RefusedModels, EndInOneLineOnTheCommandLine) {
  const auto refused = shared_model("osim_small/refused");
  if (!refused) GTEST_SKIP() << "no models to refuse";
  const TemporaryFolder folder;
  std::size_t files = 0;
  for (const auto& entry : fs::directory_iterator(*refused)) {
    const std::string file = entry.path().string();
    SCOPED_TRACE(file);
    Ran ran = run_condyle(folder.path(), "inspect --json " + file);
    if (ran.exit_code == 0) {
      std::string joint;
      const Json joints = Json::parse(ran.out)["models"][0]["joints"];
      for (const Json& each : joints)
        if (!each["refused"].is_null()) joint = each["name"].get<std::string>();
      ASSERT_FALSE(joint.empty()) << "nothing is refused";
      ran = run_condyle(folder.path(),
                        fmt::format("init {} --joint {} --anatomy knee --side right -o a.toml", file, joint));
    }
    EXPECT_EQ(ran.exit_code, 3) << ran.err;
    EXPECT_TRUE(is_one_error_line(ran.err)) << ran.err;
    EXPECT_EQ(ran.err.find("condyle: " + file + ": "), 0u) << ran.err;
    EXPECT_EQ(ran.out, "");
    EXPECT_FALSE(fs::exists(folder / "a.toml"));
    ++files;
  }
  EXPECT_EQ(files, 17u);
}

}  // namespace
}  // namespace condyle::test
