#include "command.hpp"
#include "condyle/sample/cartilages.hpp"

namespace condyle::test {
namespace {

/// The cartilages as `condyle sample cartilages` writes them, in the folder `made`.
struct Made {
  const TemporaryFolder folder;
  const Ran ran =
      run_condyle(folder.path(), "sample cartilages --scenario 6 --side left --clearance 0.3 --out made");
};

const Made& made() {
  static const Made once;
  return once;
}

Json answer(const std::string& arguments) {
  const Ran ran = run_condyle(made().folder.path(), arguments + " --json");
  EXPECT_EQ(ran.exit_code, 0) << ran.err;
  return Json::parse(ran.out);
}

TEST(SampleCartilagesJoint, HasTheMeshesThatTheLibraryMakes) {
  ASSERT_EQ(made().ran.exit_code, 0) << made().ran.err;
  sample::CartilageParameters parameters;
  parameters.clearance_mm = 0.3;
  const sample::SampleCartilages expected =
      mirrored(sample::sample_cartilages({}, parameters, sample::CartilageScenario::six));
  EXPECT_EQ(io::read_mesh(made().folder / "made/acetabular_cartilage.ply").mesh, expected.acetabular);
  EXPECT_EQ(io::read_mesh(made().folder / "made/femoral_cartilage.ply").mesh, expected.femoral);
}

TEST(SampleCartilagesJoint, IsFreeByTheClearanceAndStaysSoHoweverFarItRotates) {
  const Json depth = answer("depth made/cartilages.toml");
  EXPECT_EQ(depth["side"], "left");
  EXPECT_FALSE(depth["in_contact"]);
  // Less what flat triangles sag, at most 0.1 mm.
  EXPECT_GT(depth["min_gap_mm"], 0.2);
  EXPECT_LE(depth["min_gap_mm"], 0.3 + 1e-9);
  const Json range = answer("rom made/cartilages.toml --motion flexion");
  EXPECT_EQ(range["motions"][0]["reason"], "end_of_range");
}

TEST(SampleCartilagesJoint, ThatTouchOrArePressedLookRight) {
  const TemporaryFolder folder;
  for (const char* clearance : {"0", "-0.3"}) {
    ASSERT_EQ(run_condyle(folder.path(), std::string("sample cartilages --scenario 7 --out ") + clearance +
                                             " --clearance=" + clearance)
                  .exit_code,
              0);
    const Ran ran =
        run_condyle(folder.path(), "frame ./" + std::string(clearance) + "/cartilages.toml --strict");
    EXPECT_EQ(ran.exit_code, 0) << ran.err;
  }
}

}  // namespace
}  // namespace condyle::test
