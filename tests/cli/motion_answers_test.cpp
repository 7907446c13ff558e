#include "motion_scene.hpp"

/// What answers on recorded motions say beside their curves.

namespace condyle::test {
namespace {

TEST_F(Motion, FramesThatTheReachCutsOffAreCounted) {
  write("lower.csv", "time,y_mm\n0,-0.25\n0.1,-0.45\n0.2,-0.6\n");
  const auto cut_off = [&](const std::string& options) {
    const Ran ran = run("motion cup.toml --motion lower.csv --json " + options);
    EXPECT_EQ(ran.exit_code, 0) << ran.err;
    return Json::parse(ran.out)["frames_cut_off_by_reach"].get<int>();
  };
  // 24.8 mm in 25 mm: depths of 0.05, 0.25 and 0.4 mm.
  EXPECT_EQ(cut_off(""), 0);
  EXPECT_EQ(cut_off("--reach 0.2"), 2);
  EXPECT_EQ(cut_off("--reach 0.2 --load"), 2);
  EXPECT_EQ(cut_off("--reach 0.3"), 1);
  const std::string text = run("motion cup.toml --motion lower.csv --reach 0.3").out;
  EXPECT_NE(text.find("in 1 frames the reach of 0.3 mm cuts off rays"), text.npos) << text;
}

/// Rays from the top of the ball go through it and, with a long reach, to the inner side of the open cup.
TEST_F(Motion, FramesMetFromTheFrontAreCounted) {
  write("lower.csv", "time,y_mm\n0,0\n0.1,-0.1\n0.2,-0.6\n");
  const auto met = [&](const std::string& reach) {
    const Ran ran = run("motion cup.toml --motion lower.csv --casting mobile --json --reach " + reach);
    EXPECT_EQ(ran.exit_code, 0) << ran.err;
    return Json::parse(ran.out)["frames_met_from_front"].get<int>();
  };
  EXPECT_EQ(met("20"), 0);
  EXPECT_EQ(met("60"), 3);
  const std::string text = run("motion cup.toml --motion lower.csv --casting mobile --reach 60").out;
  EXPECT_NE(text.find("in 3 frames rays met the open target from its front"), text.npos) << text;
}

}  // namespace
}  // namespace condyle::test
