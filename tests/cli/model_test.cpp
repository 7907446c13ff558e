#include "motion_scene.hpp"
#include "support/knee_model.hpp"

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
class PublishedModel : public CommandTest, public ::testing::WithParamInterface<PublishedContact> {};

TEST_P(PublishedModel, GivesTheNumbersOfAJointFileByHand) {
  if (!has_knee_model()) GTEST_SKIP() << "the shared knee or its model is missing";
  ::setenv("CONDYLE_DATA", fs::absolute(shared_data_folder()).c_str(), 1);
  write_knee_model(here, {"femur", GetParam().mobile});
  const std::string states =
      fs::absolute(shared_data_folder() / "knee_lenhart2015_right/passive_flexion_states.sto").string();
  const Ran made = done(fmt::format("init lenhart2015.osim --joint {} -o joint.toml", GetParam().joint));
  EXPECT_TRUE(says(made.err, "is missing and left out")) << "bones are not there";
  const std::string question = fmt::format(" --motion {} --load --out ", states);
  for (const std::string& from :
       {std::string("joint.toml") + question + "file",
        fmt::format("lenhart2015.osim --joint {}{}model", GetParam().joint, question),
        fmt::format("{}/{}{}hand", CONDYLE_KNEE_BY_HAND, GetParam().by_hand, question)})
    done("motion " + from);
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
class ModelHip : public CommandTest {
 protected:
  void SetUp() override {
    FOUND_OR_SKIP(gait, shared_model("osim_gait2354"));
    gait_ = *gait;
    model = (gait_ / "gait2354_simbody.osim").string();
  }

  /// model.toml by init, and hand.toml: the pelvis is three meshes, and numbers are those that the model's text has.
  void make_both() const {
    done("init " + model + " --joint hip_r -o model.toml");
    const auto split = [&](const char* name, const char* file) {
      return fmt::format("name = \"{}\", mesh = \"{}\", polygons = \"split\"", name,
                         (gait_ / "Geometry" / file).string());
    };
    const std::string at = "[-0.0707, -0.0661, 0.0835]";
    write("hand.toml",
          text_of_joint(
              {.fixed = fmt::format("meshes = [{{ {} }}, {{ {} }}, {{ {} }}]", split("sacrum", "sacrum.vtp"),
                                    split("right", "pelvis.vtp"), split("left", "l_pelvis.vtp")),
               .mobile = fmt::format("meshes = [{{ {} }}]\npose = {{ translation = {} }}",
                                     split("femur", "femur_r.vtp"), at),
               .name = "hip",
               .units = "m",
               .centre = at}));
  }

  fs::path gait_;
  std::string model;
};

TEST_F(ModelHip, HasTheLimitsOfAJointFileByHand) {
  make_both();
  const std::string question = " --accept-reference-contact --bearing count";
  const Json limits = answer("rom model.toml" + question)["motions"],
             wanted = answer("rom hand.toml" + question)["motions"];
  ASSERT_EQ(limits.size(), 12u);
  for (std::size_t i = 0; i < limits.size(); ++i) {
    EXPECT_EQ(limits[i]["reason"], wanted[i]["reason"]);
    if (!wanted[i]["limit_deg"].is_number()) continue;
    EXPECT_NEAR(limits[i]["limit_deg"], wanted[i]["limit_deg"], 1e-6) << limits[i]["name"];
  }
}

TEST_F(ModelHip, HasTheCurvesOfAWalkThatAJointFileByHandHas) {
  const fs::path walk = fs::absolute(shared_data_folder() / "motion_gait2354_walk/subject01_walk1_ik.mot");
  if (!fs::exists(walk)) GTEST_SKIP() << walk << " is missing";
  make_both();
  append("hand.toml",
         "[recorded_motion]\nflexion = \"hip_flexion_r\"\nadduction = \"hip_adduction_r\"\n"
         "internal_rotation = \"hip_rotation_r\"\n");
  for (const char* name : {"model", "hand"}) {
    done(fmt::format("motion {0}.toml --motion {1} --out {0}", name, walk.string()));
  }
  const NumberTable curves = csv_of(folder / "model/curves.csv"), wanted = csv_of(folder / "hand/curves.csv");
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
  const std::string adjusted = (gait_ / "subject01_simbody_adjusted.osim").string();
  const Ran text = done("inspect " + adjusted);
  EXPECT_TRUE(says(text.out, "hip_l: femur_l in pelvis, ball (CustomJoint); meshes found 3 of 3 and 0 of 1"));
  EXPECT_TRUE(says(text.out, "missing: femur_l.vtp of femur_l"));
  const Json json = answer("inspect " + adjusted)["models"][0];
  EXPECT_EQ(json["name"], "subject01");
  EXPECT_EQ(json["joints"].size(), 12u);
  EXPECT_EQ(json["not_used"]["Thelen2003Muscle"], 54);
}

TEST_F(ModelHip, IsARowOfAStudy) {
  write("hips.csv",
        fmt::format("id,opensim_model,opensim_joint\nright,{0},hip_r\nnone,{0},hip\nempty,{0},\n", model));
  done("study hips.csv --accept-reference-contact --out study");
  const std::string failures = text_of("study/failures.csv");
  EXPECT_TRUE(says(failures, "no joint 'hip'"));
  EXPECT_TRUE(says(failures, "column 'opensim_joint': a joint is needed beside opensim_model"));
  EXPECT_FALSE(says(failures, "right,"));
}

TEST_F(ModelHip, SaysInOneLineWhatIsWrong) {
  const std::vector<std::tuple<std::string, int, std::string>> cases = {
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
  for (const auto& [arguments, exit_code, line] : cases) expect_refused(exit_code, arguments, line);
  EXPECT_FALSE(fs::exists(folder / "out.toml")) << "no file is left that cannot be read";
}

TEST_F(ModelHip, NotesAMotionThatLeavesItsRanges) {
  write("far.mot",
        "inDegrees=yes\nendheader\ntime hip_flexion_r hip_adduction_r hip_rotation_r knee_angle_r\n"
        "0 0 0 0 0\n1 130 0 0 20\n2 10 0 0 -60\n");
  for (const char* joint : {"hip_r", "knee_r"}) {
    const Ran ran = done(fmt::format("motion {} --joint {} --motion far.mot --json", model, joint));
    EXPECT_TRUE(says(ran.err, "condyle: note: beyond_range: "));
    const Json notes = Json::parse(ran.out)["notes"];
    EXPECT_TRUE(std::any_of(notes.begin(), notes.end(),
                            [](const Json& note) { return note["code"] == "beyond_range"; }));
    EXPECT_TRUE(says(ran.err, "in 1 of 3 frames"));
    EXPECT_EQ(run(fmt::format("motion {} --joint {} --motion far.mot --strict", model, joint)).exit_code, 4);
  }
}

TEST(RefusedModels, EndInOneLineOnTheCommandLine) {
  FOUND_OR_SKIP(refused, shared_model("osim_small/refused"));
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
