#include <gtest/gtest.h>

#include <array>
#include <numbers>

#include "answer/records/limit_box_record.hpp"
#include "condyle/io/joint_file.hpp"
#include "condyle/io/model_file.hpp"
#include "io/result/limit_files.hpp"
#include "support/duct_model.hpp"
#include "support/simbody_stop.hpp"
#include "support/temporary_folder.hpp"

/// The stop of Simbody, which OpenSim's CoordinateLinearStopForce is, with the ends that a written model has: it acts where bone does.

namespace condyle::test {
namespace {

TEST(WrittenStop, OfSimbodyActsWhereTheRodMeetsThePlate) {
  const TemporaryFolder folder;
  write_duct_model(folder / "model.osim");
  const io::LoadedJoint joint =
      io::read_joint(io::read_model(folder / "model.osim"), {.joint = "hip_r", .joint_file = {}});
  const io::LimitFile file{folder / "limited.osim", io::StopForce::linear, folder / "model.osim"};
  const io::LimitCoordinates known_by = io::limit_coordinates(joint, file, nullptr, false);
  const RangeRequest request;
  const auto box =
      io::limit_box(known_by, joint, answer_range(joint, request), request, LimitSource::bony, {});
  io::write_limits(file, *box, joint, known_by, nullptr);

  const io::Model model = io::read_model(file.path);
  const auto& written = io::joint_named(model, "hip_r").coordinates;
  const struct {
    std::array<double, 3> axis;
    std::array<std::array<double, 3>, 2>
        corners;  ///< of the rod, that meet the plates at the lower and the upper end
    std::array<double, 2> degrees, plates;
    std::size_t direction;
  } cases[] = {{{0, 0, -1},
                {{{rod_half, -rod_length, 0}, {-rod_half, -rod_length, 0}}},
                {-duct_flexion_deg()[0], duct_flexion_deg()[1]},
                {plate_anterior, -plate_posterior},
                0},
               {{1, 0, 0},
                {{{0, -rod_length, rod_half}, {0, -rod_length, -rod_half}}},
                {-duct_adduction_deg()[1], duct_adduction_deg()[0]},
                {plate_right, -plate_left},
                2}};
  for (std::size_t i = 0; i < 2; ++i) {
    ASSERT_TRUE(written[i].stop);
    const SimbodyStop stop{cases[i].axis, *written[i].stop};
    for (std::size_t end = 0; end < 2; ++end) {
      const double begin = stop.begin(end == 0 ? -1 : 1);
      EXPECT_NEAR(begin * 180 / std::numbers::pi, cases[i].degrees[end], 1e-6) << written[i].name;
      EXPECT_NEAR(stop.posed(cases[i].corners[end], begin)[cases[i].direction], cases[i].plates[end], 1e-8)
          << written[i].name;
    }
  }
}

}  // namespace
}  // namespace condyle::test
