#include "condyle/joint.hpp"
#include "support/test.hpp"

/// What testBlankevoort1991Ligament asks in testForces.cpp of OpenSim (github.com/opensim-org/opensim-core, Apache 2.0): its
/// sizes, lengths and expectations are facts from there; the model and its motion are made anew. Metres there, millimetres here.

namespace condyle {
namespace {

using std::numbers::pi;

/// To what OpenSim expects forces in N, energies in J and stiffnesses in N/m.
constexpr double opensim_tolerance = 1e-3;
constexpr double mm_per_m = 1000;

/// The block of 0.1 kg that hangs on a ligament of 10 N per strain and 1.2 m. It goes from the ground up around a cylinder of radius 0.1 at
/// height 0.4, through a point at height 0.6 above its axis, and down around it to the block, straight below its side.
///
///         o  fixed point
///       /   \          the part on this side is of one length: it stands as a straight detour
///      (  +  )
///      |     |
///      o     # block, height h
struct HangingBlock {
  static constexpr double mass_kg = 0.1, gravity = 9.8065;
  Ligament ligament = {.name = "ligament",
                       .fixed = {Vec3(0, 0, 0), Vec3(100, 600, 0)},
                       .mobile = {Vec3::Zero()},
                       .wrap = LigamentWrap{.shape = WrapShape::cylinder,
                                            .body = BodyRole::fixed,
                                            .centre = Vec3(100, 400, 0),
                                            .axis = Vec3::UnitZ(),
                                            .radius_mm = 100},
                       .slack_length_mm = 1200,
                       .stiffness_n = 10};
  /// Up 400, an arc of 30 degrees, a tangent from a point at twice the radius.
  const double same_mm = 400 + 100 * pi / 6 + 100 * std::sqrt(3.0);

  HangingBlock() { ligament.fixed[0] = ligament.fixed[1] - Vec3(same_mm, 0, 0); }

  LigamentState at(double height_m) const {
    Pose X_FM(Eigen::Translation3d(200, mm_per_m * height_m, 0));
    return ligament_state(ligament, X_FM).value();
  }
  double acceleration(double height_m) const { return at(height_m).force_n.y() / mass_kg - gravity; }
  double energy_j(double height_m, double speed) const {
    return at(height_m).energy_nmm / mm_per_m + mass_kg * (gravity * height_m + speed * speed / 2);
  }
};

struct BlockMotion {
  double height_m, speed;
};

/// One step of Runge and Kutta's method of fourth order.
BlockMotion stepped(const HangingBlock& block, const BlockMotion& from, double dt) {
  const auto slope = [&](const BlockMotion& at) {
    return BlockMotion{at.speed, block.acceleration(at.height_m)};
  };
  const auto along = [&](const BlockMotion& by, double time) {
    return BlockMotion{from.height_m + time * by.height_m, from.speed + time * by.speed};
  };
  const BlockMotion a = slope(from), b = slope(along(a, dt / 2)), c = slope(along(b, dt / 2)),
                    d = slope(along(c, dt));
  return {from.height_m + dt / 6 * (a.height_m + 2 * b.height_m + 2 * c.height_m + d.height_m),
          from.speed + dt / 6 * (a.speed + 2 * b.speed + 2 * c.speed + d.speed)};
}

TEST(OpenSimLigament, HoldsABlockAndKeepsItsEnergy) {
  const HangingBlock block;
  EXPECT_NEAR(block.at(0.1).length_mm, 2 * block.same_mm - 100, 1e-9);
  EXPECT_TRUE(block.at(0.1).wraps);
  EXPECT_LT(block.at(0.1).strain, 0);
  constexpr double dt = 1e-4;
  BlockMotion before = {0.1, 0}, now = before;
  const double energy = block.energy_j(now.height_m, now.speed);
  double most_strain = 0;
  for (int step = 0; step < 30000; ++step) {
    before = now;
    now = stepped(block, now, dt);
    most_strain = std::max(most_strain, block.at(now.height_m).strain);
  }
  EXPECT_GT(most_strain, block.ligament.transition_strain);
  EXPECT_NEAR(block.energy_j(now.height_m, now.speed), energy, opensim_tolerance);
  // The ligament pulls straight up, by its weight and what accelerates it: here by how its speed changed over the last step.
  const double middle = (before.height_m + now.height_m) / 2;
  EXPECT_NEAR(tension_n(block.ligament, block.at(middle).strain),
              block.mass_kg * (block.gravity + (now.speed - before.speed) / dt), opensim_tolerance);
}

TEST(OpenSimLigament, StretchesFromSlackThroughItsToeToItsLinearPart) {
  const Ligament ligament = {
      .fixed = {Vec3::Zero()}, .mobile = {Vec3::Zero()}, .slack_length_mm = 1000, .stiffness_n = 10};
  const auto at = [&](double length_m) {
    Pose X_FM = Pose::Identity();
    X_FM.translation().x() = mm_per_m * length_m;
    return ligament_state(ligament, X_FM).value();
  };
  const LigamentState slack = at(0.95), toe = at(1.05), linear = at(1.07);
  EXPECT_LT(slack.strain, 0);
  EXPECT_EQ(slack.energy_nmm, 0);
  EXPECT_EQ(slack.tension_n, 0);
  EXPECT_LT(toe.strain, ligament.transition_strain);
  EXPECT_GT(linear.strain, ligament.transition_strain);
  EXPECT_GT(linear.tension_n, toe.tension_n);
  EXPECT_GT(linear.energy_nmm, toe.energy_nmm);
  const double n_per_m = (at(1.08).tension_n - at(1.06).tension_n) / 0.02;
  EXPECT_NEAR(n_per_m, 10, opensim_tolerance);
}

TEST(OpenSimLigament, HasTheForceAndTheStrainThatItsSlackLengthWasMadeFor) {
  // 2.5 N are a strain of 0.28 beyond the toe, where tension is 10 (e - 0.03).
  for (const auto& [strain, tension] : {std::pair{0.28, 2.5}, std::pair{0.05, 10 * 0.05 * 0.05 / 0.12}}) {
    const Ligament ligament = {.fixed = {Vec3::Zero()},
                               .mobile = {Vec3(1100, 0, 0)},
                               .slack_length_mm = 1100 / (1 + strain),
                               .stiffness_n = 10};
    const LigamentState state = ligament_state(ligament, Pose::Identity()).value();
    EXPECT_NEAR(state.strain, strain, 1e-12);
    EXPECT_NEAR(state.tension_n, tension, 1e-12);
  }
}

}  // namespace
}  // namespace condyle
