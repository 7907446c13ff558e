#include "command.hpp"
#include "support/drawn_bones.hpp"
#include "support/report_block.hpp"

/// Every answer has the evidence of a femur's condyles against a knee.

namespace condyle::test {
namespace {

class KneeNotes : public CommandTest {
 protected:
  void SetUp() override {
    io::write_mesh(folder / "femur.ply", femur_of({}));
    io::write_mesh(folder / "tibia.ply", tibia_of_knee());
    write_joint("right.toml", "right", "[1, 0, 0]");
    write_joint("left.toml", "left", "[1, 0, 0]");
    write_joint("turned.toml", "right", "[-1, 0, 0]");
    write("record.csv", "time,flexion_deg\n0,0\n1,10\n");
  }
  void write_joint(const char* name, const char* side, const char* anterior,
                   const char* kind = "free") const {
    write(name, text_of_joint({.fixed = "name = \"femur\"\nmesh = \"femur.ply\"",
                               .mobile = "name = \"tibia\"\nmesh = \"tibia.ply\"",
                               .kind = kind,
                               .name = "knee",
                               .side = side,
                               .joint = "knee",
                               .anterior = anterior}));
  }
};

TEST_F(KneeNotes, StandInEveryAnswer) {
  for (const std::string question :
       {"frame {} --json", "depth {} --pose flexion=5 --json", "rom {} --motion flexion --json",
        "motion {} --motion record.csv --json"}) {
    const auto asked = [&](const std::string& of) {
      std::string arguments = question;
      return run(arguments.replace(arguments.find("{}"), 2, of));
    };
    for (const auto& [joint, code] :
         {std::pair<std::string, std::string>{"left.toml", "wrong_side"}, {"turned.toml", "axes_turned"}}) {
      const Ran ran = asked(joint);
      ASSERT_EQ(ran.exit_code, 0) << ran.err;
      EXPECT_TRUE(says(ran.err, "condyle: note: " + code + ": "));
      EXPECT_TRUE(has_note(Json::parse(ran.out), code)) << question;
    }
    const Ran right = asked("right.toml");
    for (const char* wrong : {"wrong_side", "axes_turned", "mirrored", "axes_not_upright"})
      EXPECT_FALSE(has_note(Json::parse(right.out), wrong)) << question;
  }
  EXPECT_EQ(run("rom left.toml --strict").exit_code, 4);
  done("rom right.toml --motion flexion --strict");
}

TEST_F(KneeNotes, StandInReportsAndStudies) {
  done("report left.toml --follow record.csv --out page.html");
  const Json page = report_block(text_of("page.html")).json;
  EXPECT_TRUE(has_note(page["rom"], "wrong_side")) << page["rom"]["notes"];
  write_joint("one.toml", "left", "[1, 0, 0]", "ball");
  write_joint("other.toml", "right", "[1, 0, 0]", "ball");
  write("knees.csv", "id,joint\none,one.toml\nother,other.toml\n");
  const Ran study = done("study knees.csv --anatomy knee --motion flexion --out study");
  EXPECT_TRUE(says(study.err, "condyle: note: one: wrong_side"));
  EXPECT_TRUE(says(study.err, "condyle: note: other: sliding_surfaces\n"));
}

}  // namespace
}  // namespace condyle::test
