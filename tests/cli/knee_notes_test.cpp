#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>
#include <nlohmann/json.hpp>
#include <string>
#include <utility>

#include "command.hpp"
#include "condyle/io/mesh_file.hpp"
#include "io/file/whole_file.hpp"
#include "support/drawn_bones.hpp"
#include "support/report_block.hpp"
#include "support/temporary_folder.hpp"

/// Every answer has the evidence of a femur's condyles against a knee.

namespace condyle::test {
namespace {

using Json = nlohmann::json;

class KneeNotes : public ::testing::Test {
 protected:
  void SetUp() override {
    io::write_mesh(folder / "femur.ply", femur_of({}));
    io::write_mesh(folder / "tibia.ply", tibia_of_knee());
    write_joint("right.toml", "right", "[1, 0, 0]");
    write_joint("left.toml", "left", "[1, 0, 0]");
    write_joint("turned.toml", "right", "[-1, 0, 0]");
    std::ofstream(folder / "record.csv") << "time,flexion_deg\n0,0\n1,10\n";
  }
  void write_joint(const char* name, const char* side, const char* anterior,
                   const char* kind = "free") const {
    std::ofstream(folder / name) << "condyle = 1\nname = \"knee\"\nkind = \"" << kind
                                 << "\"\njoint = \"knee\"\nside = \"" << side
                                 << "\"\nunits = \"mm\"\nfixed = { name = \"femur\", mesh = \"femur.ply\" }\n"
                                 << "mobile = { name = \"tibia\", mesh = \"tibia.ply\" }\n"
                                 << "frame = { centre = [0, 0, 0], anterior = " << anterior
                                 << ", superior = [0, 1, 0] }\n";
  }
  Ran run(const std::string& arguments) const { return run_condyle(folder.path(), arguments); }

  const TemporaryFolder folder;
};

bool notes_of_knee_have(const Json& answer, const std::string& code) {
  return std::any_of(answer["notes"].begin(), answer["notes"].end(),
                     [&](const Json& note) { return note["code"] == code; });
}

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
      EXPECT_NE(ran.err.find("condyle: note: " + code + ": "), std::string::npos) << ran.err;
      EXPECT_TRUE(notes_of_knee_have(Json::parse(ran.out), code)) << question;
    }
    const Ran right = asked("right.toml");
    for (const char* wrong : {"wrong_side", "axes_turned", "mirrored", "axes_not_upright"})
      EXPECT_FALSE(notes_of_knee_have(Json::parse(right.out), wrong)) << question;
  }
  EXPECT_EQ(run("rom left.toml --strict").exit_code, 4);
  EXPECT_EQ(run("rom right.toml --motion flexion --strict").exit_code, 0);
}

TEST_F(KneeNotes, StandInReportsAndStudies) {
  ASSERT_EQ(run("report left.toml --follow record.csv --out page.html").exit_code, 0);
  const Json page = report_block(io::read_whole_file(folder / "page.html")).json;
  EXPECT_TRUE(notes_of_knee_have(page["rom"], "wrong_side")) << page["rom"]["notes"];
  write_joint("one.toml", "left", "[1, 0, 0]", "ball");
  write_joint("other.toml", "right", "[1, 0, 0]", "ball");
  std::ofstream(folder / "knees.csv") << "id,joint\none,one.toml\nother,other.toml\n";
  const Ran study = run("study knees.csv --anatomy knee --motion flexion --out study");
  ASSERT_EQ(study.exit_code, 0) << study.err;
  EXPECT_NE(study.err.find("condyle: note: one: wrong_side"), std::string::npos) << study.err;
  EXPECT_NE(study.err.find("condyle: note: other: sliding_surfaces\n"), std::string::npos) << study.err;
}

}  // namespace
}  // namespace condyle::test
