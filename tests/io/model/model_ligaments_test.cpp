#include "condyle/answer.hpp"
#include "condyle/io/model_file.hpp"
#include "condyle/io/recorded_motion.hpp"
#include "support/knee_model.hpp"
#include "support/test.hpp"

/// Ligaments of a published knee against lengths, strains and forces that OpenSim printed along its passive flexion.

namespace condyle {
namespace {

namespace fs = std::filesystem;

class ModelLigaments : public testing::Test {
 protected:
  void SetUp() override {
    if (!test::has_knee_model()) GTEST_SKIP() << "no published knee in CONDYLE_DATA";
    folder_ = fs::path(testing::TempDir()) / "model_ligaments";
    test::write_knee_model(folder_, {"femur", "tibia", "patella"});
    reference_ = io::read_motion_table(test::shared_data_folder() /
                                       "osim_lenhart2015/passive_flexion_ligament_reference.sto");
  }
  void TearDown() override {
    if (!folder_.empty()) fs::remove_all(folder_);
  }

  /// What OpenSim printed for a ligament in a frame.
  double printed(const std::string& column, std::size_t row) const {
    const auto at = std::find(reference_.columns.begin(), reference_.columns.end(), column);
    EXPECT_NE(at, reference_.columns.end()) << column;
    return reference_.values[static_cast<std::size_t>(at - reference_.columns.begin())][row];
  }

  struct Compared {
    std::size_t ligaments = 0, known = 0, unknown = 0;
    double length_m = 0, strain = 0, force_n = 0;
  };
  io::LoadedJoint joint_of_model(const std::string& joint) const {
    io::ModelJointRequest request;
    request.joint = joint;
    return io::read_joint(io::read_model(folder_ / "lenhart2015.osim"), request);
  }
  static io::MotionTable flexion() {
    return io::read_motion_table(test::shared_data_folder() /
                                 "knee_lenhart2015_right/passive_flexion_states.sto");
  }
  /// Compared with what was printed, by their names without numbers.
  std::map<std::string, Compared> compared(const std::string& joint) {
    const io::LoadedJoint loaded = joint_of_model(joint);
    const auto along = ligaments_along(loaded.joint.ligaments, io::motion_of(loaded, flexion()).X_FM);
    std::map<std::string, Compared> groups;
    for (const LigamentAlong& ligament : along) {
      Compared& group = groups[ligament.name.substr(0, ligament.name.find_first_of("0123456789"))];
      ++group.ligaments;
      for (std::size_t row = 0; row < 51; ++row) {
        const auto& state = ligament.frames[5 * row];
        ++(state ? group.known : group.unknown);
        if (!state) continue;
        const auto take = [&](double& worst, double ours, const char* what) {
          worst = std::max(worst, std::abs(ours - printed(ligament.name + what, row)));
        };
        take(group.length_m, state->length_mm / 1000, ".length");
        take(group.strain, state->strain, ".strain");
        take(group.force_n, state->tension_n, ".force_spring");
      }
    }
    return groups;
  }

  fs::path folder_;
  io::MotionTable reference_;
};

/// Speeds of coordinates in some rows, rad/s and m/s, which the excerpt of the flexion lacks: facts of passive_flexion_states.sto of
/// opensim-jam, commit fb77705.
struct RecordedRow {
  std::size_t row;
  std::vector<double> speeds;
};
const std::vector<std::string> recorded_coordinates = {
    "knee_r/knee_flex_r", "knee_r/knee_add_r", "knee_r/knee_rot_r", "knee_r/knee_tx_r",
    "knee_r/knee_ty_r",   "knee_r/knee_tz_r",  "pf_r/pf_flex_r",    "pf_r/pf_rot_r",
    "pf_r/pf_tilt_r",     "pf_r/pf_tx_r",      "pf_r/pf_ty_r",      "pf_r/pf_tz_r"};
const std::vector<RecordedRow> recorded_rows = {
    {10,
     {0.001360514129117346, -0.0002153985941030038, -0.0008093265124484835, 0.0003516066898147573,
      1.665845613913511e-05, -5.621689486058449e-06, 0.01662570260467502, -0.01825628781037407,
      -0.08646716490366461, -0.0002872624749776883, 0.0002174028823132487, -0.0009013153549175289}},
    {40,
     {1.148644801559472, -0.01341144587876415, -0.05811377130894893, 0.00416834989640614,
      -0.01237341132405435, -0.002927938651595562, 0.8331399719174514, 0.02800376116791527,
      -0.04942595015416421, -0.03903504148498519, -0.01953667028191347, 0.00127779927550206}},
    {50,
     {1.41371076029656, 0.02809547723585139, -0.08583315674452982, -0.01010218914121448,
      -0.008358885037917946, -0.0004740501040018208, 0.9558256437544045, -0.04549841556371238,
      0.1074424162366826, -0.04319301565829342, 0.005684900083043218, -0.003604077868154268}}};

TEST_F(ModelLigaments, AreDampedAsOpenSimPrinted) {
  std::size_t damped = 0;
  for (const char* joint : {"knee_r", "pf_r"}) {
    const io::LoadedJoint loaded = joint_of_model(joint);
    io::MotionTable table = flexion();
    for (std::size_t c = 0; c < recorded_coordinates.size(); ++c) {
      table.columns.push_back("/jointset/" + recorded_coordinates[c] + "/speed");
      auto& column = table.values.emplace_back(table.rows, std::nan(""));
      for (const RecordedRow& each : recorded_rows) column[5 * each.row] = each.speeds[c];
    }
    const auto along = ligaments_along(loaded.joint.ligaments, io::motion_of(loaded, table).X_FM,
                                       io::recorded_speeds(loaded, table));
    for (const LigamentAlong& ligament : along)
      for (const RecordedRow& each : recorded_rows) {
        // OpenSim's own path over a cylinder is another.
        if (!ligament.frames[5 * each.row] || ligament.name.starts_with("pCAP")) continue;
        ASSERT_TRUE(ligament.damping[5 * each.row]) << ligament.name;
        const double damping = printed(ligament.name + ".force_damping", each.row);
        damped += damping > 1e-6;
        // Half of the last printed digit, and rounding.
        EXPECT_NEAR(ligament.damping[5 * each.row]->damping_n, damping, 0.51e-8) << ligament.name;
        EXPECT_NEAR(ligament.damping[5 * each.row]->total_n,
                    printed(ligament.name + ".force_total", each.row), 0.51e-8)
            << ligament.name;
      }
  }
  EXPECT_GT(damped, 50u);
}

TEST_F(ModelLigaments, HaveTheLengthsAndForcesThatOpenSimPrinted) {
  auto knee = compared("knee_r");
  std::size_t straight = 0;
  for (const char* name : {"ACLpl", "ACLam", "PCLal", "PCLpm", "LCL", "PFL", "MCLd"}) {
    const Compared& group = knee[name];
    EXPECT_EQ(group.unknown, 0u) << name;
    EXPECT_EQ(group.known, 51 * group.ligaments) << name;
    EXPECT_LE(group.length_m, 0.51e-8) << name;  // half of the last digit
    EXPECT_LE(group.force_n, 1e-8 * 1.01) << name;
    straight += group.ligaments;
  }
  EXPECT_EQ(straight, 36u);
  auto patella = compared("pf_r");
  EXPECT_EQ(patella["lPFL"].ligaments + patella["mPFL"].ligaments, 14u);
  for (const char* name : {"lPFL", "mPFL"}) {
    EXPECT_LE(patella[name].length_m, 0.51e-8) << name;
    EXPECT_LE(patella[name].force_n, 1e-8 * 1.01) << name;
  }
  // On an ellipsoid in every frame: no length, and none that is wrong. Over a cylinder: near to OpenSim's own.
  EXPECT_EQ(knee["MCLs"].known, 0u);
  EXPECT_EQ(knee["pCAP"].unknown, 0u);
  RecordProperty("cylinder_mm", std::to_string(1000 * knee["pCAP"].length_m));
  EXPECT_LE(knee["pCAP"].length_m, 1e-5);
}

}  // namespace
}  // namespace condyle
