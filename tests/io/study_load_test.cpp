#include "study_of_arms.hpp"
#include "support/test.hpp"

/// Contact pressure and balanced loads in studies.

namespace condyle::test {
namespace {

TEST_F(StudyOfArms, BalancesALoadWhereItIsAskedFor) {
  cohort.write_post(3, 10);
  io::Study loaded = study("out");
  loaded.options.load.emplace();
  loaded.options.load->force_n = Vec3(80, 0, 0);
  loaded.options.load->free_directions = {Vec3(1, 0, 0)};  // flat on flat: nothing holds it in the other two
  loaded.options.load->contact = {.casting = contact::Casting::mobile,
                                  .reach_mm = 10,
                                  .youngs_modulus_mpa = {10},
                                  .poisson_ratio = {0},
                                  .thickness_mm = {2}};
  run(loaded);
  const auto hips = rows_of(folder / "out/hips.csv");
  EXPECT_EQ(hips[0].at("load_outcome"), "pulled_apart");  // its post is farther than the reach
  EXPECT_EQ(hips[0].at("load_force_x_n"), "");
  const auto& hip = hips[2];
  EXPECT_EQ(hip.at("load_outcome"), "balanced");
  const auto value = [&](const char* column) { return std::stod(hip.at(column)); };
  EXPECT_NEAR(value("load_force_x_n"), -80, 1e-6);
  EXPECT_LT(value("load_residual_n"), 1e-6);
  // Flat against flat: two layers in one another's row, p = E d / (2 h), over an area that is counted by whole triangles.
  const double pressure = 80 / value("load_mobile_area_mm2");
  EXPECT_NEAR(value("load_mobile_mean_pressure_mpa"), pressure, 1e-9);
  EXPECT_NEAR(value("load_mobile_max_pressure_mpa"), pressure, 1e-9);
  EXPECT_NEAR(value("load_moved_x_mm"), 9 + pressure * 2 * 2 / 10, 1e-9);
  EXPECT_NEAR(value("load_mobile_centre_x_mm"), 1, 1e-9);
  EXPECT_EQ(hip.at("load_fixed_area_mm2"), "");
}

TEST_F(StudyOfArms, WithoutLayersCarriesNoLoad) {
  io::Study loaded = study("out");
  loaded.options.load.emplace();
  EXPECT_EQ(run(loaded).failures, 13u);
  expect_says(rows_of(folder / "out/failures.csv")[0].at("message"), "no layers to carry a load");
}

TEST_F(StudyOfArms, IsDoneAgainForOtherThicknesses) {
  std::ofstream(folder / "hip1.toml", std::ios::app)
      << "[contact]\n[contact.mobile]\nyoungs_modulus_mpa = 10\npoisson_ratio = 0.3\nthickness_file = "
         "\"h.txt\"\n";
  const auto write = [&](double thickness) {
    std::ofstream out(folder / "h.txt");
    for (std::size_t v = 0; v < 8; ++v) out << thickness << "\n";
  };
  write(2);
  io::Study loaded = study("out");
  loaded.options.load.emplace();
  EXPECT_EQ(run(loaded).failures, 12u);
  EXPECT_TRUE(run(loaded).was_there);
  write(3);
  EXPECT_FALSE(run(loaded).was_there);
}

TEST(StudyOfSamples, CountsAForceToTheSideOfTheJoint) {
  const TemporaryFolder folder;
  io::Study loaded{folder.file("hips.csv", "id,sample,side\na,1,right\nb,1,left\n"), folder / "out"};
  loaded.options.motions = {"flexion"};
  loaded.options.load.emplace();
  loaded.options.load->contact = {.youngs_modulus_mpa = {12}, .poisson_ratio = {0.42}, .thickness_mm = {1.5}};
  loaded.options.load->force_n = Vec3(100, 1500, -300);
  ASSERT_EQ(io::run_study(loaded)->failures, 0u);
  const auto hips = rows_of(folder / "out/hips.csv");
  for (const auto& hip : hips) EXPECT_EQ(hip.at("load_outcome"), "balanced");
  const auto expect_near = [&](const char* column, double sign, double within) {
    EXPECT_NEAR(std::stod(hips[0].at(column)), sign * std::stod(hips[1].at(column)), within) << column;
  };
  EXPECT_NEAR(std::stod(hips[0].at("load_force_z_n")), 300, 1e-6);
  expect_near("load_force_z_n", -1, 2e-6);
  expect_near("load_force_x_n", 1, 2e-6);
  expect_near("load_moved_z_mm", -1, 1e-6);
  expect_near("load_mobile_area_mm2", 1, 1e-3);
}

}  // namespace
}  // namespace condyle::test
