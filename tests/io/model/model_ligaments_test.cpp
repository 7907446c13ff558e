#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "condyle/answer.hpp"
#include "condyle/io/model_file.hpp"
#include "condyle/io/recorded_motion.hpp"
#include "support/knee_model.hpp"
#include "support/shared_data.hpp"

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
  /// The ligaments of a joint along the flexion, damped by its frames.
  std::vector<LigamentAlong> along_flexion(const std::string& joint) {
    const fs::path data = test::shared_data_folder();
    io::ModelJointRequest request;
    request.joint = joint;
    const io::LoadedJoint loaded = io::read_joint(io::read_model(folder_ / "lenhart2015.osim"), request);
    const io::JointMotion motion = io::motion_of(
        loaded, io::read_motion_table(data / "knee_lenhart2015_right/passive_flexion_states.sto"));
    reference_ = io::read_motion_table(data / "osim_lenhart2015/passive_flexion_ligament_reference.sto");
    return ligaments_along(loaded.joint.ligaments, motion.X_FM,
                           motions_along(motion.X_FM, motion.times.values));
  }
  /// Compared with what was printed, by their names without numbers.
  std::map<std::string, Compared> compared(const std::string& joint) {
    const auto along = along_flexion(joint);
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

/// The file of the flexion has no speeds: its samples give them to about a hundredth.
TEST_F(ModelLigaments, AreDampedAsOpenSimPrintedAsFarAsSpeedsFollowFromTheFrames) {
  std::vector<double> off;
  for (const char* joint : {"knee_r", "pf_r"})
    for (const LigamentAlong& ligament : along_flexion(joint))
      for (std::size_t row = 0; row < 51; ++row) {
        if (!ligament.frames[5 * row] || ligament.name.starts_with("pCAP")) continue;
        const double damping = printed(ligament.name + ".force_damping", row);
        // Printed to 1e-8 each.
        EXPECT_NEAR(printed(ligament.name + ".force_total", row),
                    ligament.frames[5 * row]->tension_n + damping, 1.51e-8)
            << ligament.name;
        if (damping > 1e-6) {
          off.push_back(std::abs(ligament.damping[5 * row]->damping_n / damping - 1));
        } else if (ligament.frames[5 * row]->strain <= 0) {
          EXPECT_EQ(ligament.damping[5 * row]->damping_n, 0) << ligament.name;
        }
      }
  ASSERT_GT(off.size(), 400u);
  std::sort(off.begin(), off.end());
  RecordProperty("median", std::to_string(off[off.size() / 2]));
  EXPECT_LT(off[off.size() / 2], 0.01);
  EXPECT_LT(off[off.size() * 9 / 10], 0.15);
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
