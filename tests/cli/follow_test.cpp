#include "command.hpp"
#include "support/report_block.hpp"

/// `condyle rom --follow` and `--follow-load`: the centre is not held.

namespace condyle::test {
namespace {

/// An arm on a ball in a cup with a post, as a free joint, with cartilage on ball and cup.
class Follow : public CommandTest {
 protected:
  void SetUp() override {
    io::write_mesh(folder / "arm.ply", box({-1, -100, -1}, {1, -50, 1}));
    io::write_mesh(folder / "post.ply", box({40, -80, -10}, {60, -60, 10}));
    io::write_mesh(folder / "ball.ply", sphere({0, 0, 0}, 20, 4));
    io::write_mesh(folder / "cup.ply", socket({0, 0, 0}, 20.5, 24, 4));
    const std::string layer = " = { youngs_modulus_mpa = 12, poisson_ratio = 0.42, thickness = 1.5 }\n";
    write("joint.toml",
          text_of_joint({.fixed = "name = \"frame\"\nmeshes = [{ name = \"post\", mesh = \"post.ply\" },\n"
                                  "  { name = \"cup\", mesh = \"cup.ply\", contact = \"bearing\" }]",
                         .mobile = "name = \"limb\"\nmeshes = [{ name = \"arm\", mesh = \"arm.ply\" },\n"
                                   "  { name = \"ball\", mesh = \"ball.ply\", contact = \"bearing\" }]",
                         .more = "[contact]\nfixed_part = \"cup\"\nmobile_part = \"ball\"\nfixed" + layer +
                                 "mobile" + layer,
                         .kind = "free",
                         .name = "swing",
                         .joint = "hip"}));
    std::string record = "time,flexion_deg,x_mm\n";
    for (int i = 0; i <= 60; ++i) record += fmt::format("{},{},{}\n", i * 0.1, i, -0.1 * i);
    write("record.csv", record);
  }
};

TEST_F(Follow, ARecordedMotionMovesTheCentre) {
  const Json json = answer("rom joint.toml --follow record.csv");
  EXPECT_EQ(json["exact"], false);
  ASSERT_EQ(json["motions"].size(), 1u) << "the record leads along flexion only";
  const Json& limit = json["motions"][0];
  EXPECT_EQ(limit["name"], "flexion");
  EXPECT_EQ(limit["reason"], "contact");
  EXPECT_EQ(limit["features"]["fixed"]["part"], "post");
  EXPECT_NEAR(limit["translation_mm"][0], -0.1 * limit["limit_deg"].get<double>(), 1e-9);
  EXPECT_TRUE(says(limit["guarantee"].get<std::string>(), "bounded, not exact"));
  const Json held = answer("rom joint.toml --motion flexion");
  EXPECT_EQ(held["exact"], true);
  EXPECT_TRUE(held["motions"][0]["translation_mm"].is_null());
  EXPECT_GT(limit["limit_deg"].get<double>(), held["motions"][0]["limit_deg"].get<double>() + 0.5)
      << "the arm moves away from the post";
  EXPECT_TRUE(says(run("rom joint.toml --follow record.csv").out, "limits are bounded"));
}

TEST_F(Follow, ALoadMovesTheCentre) {
  const Json limit = answer("rom joint.toml --motion flexion --follow-load --force 300 900 0")["motions"][0];
  EXPECT_EQ(limit["reason"], "contact");
  EXPECT_GT(limit["translation_mm"][0].get<double>(), 0.1);
  EXPECT_EQ(limit["bearing_contact_deg"], 0.0) << "the cartilage is pressed together from the start";
}

TEST_F(Follow, WhatItFollowsMayEndBeforeTheMotion) {
  write("short.csv", "time,flexion_deg,x_mm\n0,0,0\n1,12,-1\n");
  const auto motion = [&](const std::string& follow) {
    const Ran ran = done("rom joint.toml --motion flexion --json " + follow);
    return Json::parse(ran.out)["motions"][0];
  };
  EXPECT_EQ(motion("--follow record.csv")["translation_ends"], false);
  EXPECT_TRUE(answer("rom joint.toml --motion flexion")["motions"][0]["translation_ends"].is_null());
  const Json ends = motion("--follow short.csv");
  EXPECT_EQ(ends["translation_ends"], true);
  EXPECT_NEAR(ends["limit_deg"], 12, 1e-9);
  EXPECT_EQ(ends["guarantee"],
            "free over 12 deg, as far as what the translation follows goes; unknown past it");
  const Ran text = run("rom joint.toml --motion flexion --follow short.csv");
  EXPECT_TRUE(says(text.out, "12.00  no contact, translation ends"));
  EXPECT_FALSE(says(text.out, "no contact in range"));

  const std::string out_of_the_cup = "--follow-load --force 0 -900 0";
  const Json none = motion(out_of_the_cup);
  EXPECT_EQ(none["translation_ends"], true);
  EXPECT_TRUE(none["translation_mm"].is_null());
  EXPECT_EQ(none["guarantee"], "none: no contact carries the load at the start");
  const Ran said = run("rom joint.toml --motion flexion " + out_of_the_cup);
  EXPECT_TRUE(says(said.out, "-  unknown: load not carried"));
  EXPECT_TRUE(says(said.err,
                   "note: translation_ends: flexion: no contact carries the load 0 degrees past its start"));
}

TEST_F(Follow, IsRefusedInOneLine) {
  write("back.csv", "time,flexion_deg\n0,0\n1,20\n2,10\n3,30\n");
  for (const auto& [arguments, code, saying] :
       {std::tuple("--follow nothere.csv", 3, "nothere.csv"),
        {"--motion extension --follow record.csv", 2, "record.csv: extension: the recorded angle"},
        {"--follow-load", 2, "needs --force"},
        {"--force 1 2 3", 2, "--follow-load"},
        {"--follow record.csv --band", 2, "--band"},
        {"--follow back.csv", 2, "turns back"}})
    expect_refused(code, std::string("rom joint.toml ") + arguments, saying);
}

TEST_F(Follow, WhatLooksWrongIsNoted) {
  const auto codes = [&](const std::string& arguments) {
    const Ran ran = done("rom joint.toml --motion flexion --json " + arguments);
    std::string codes;
    const Json notes = Json::parse(ran.out)["notes"];
    for (const Json& note : notes) {
      const auto code = note["code"].get<std::string>();
      EXPECT_TRUE(says(ran.err, "condyle: note: " + code));
      codes += code + " ";
    }
    return codes;
  };
  const std::string usual = codes("--follow record.csv");
  write("far.csv", "time,flexion_deg,x_mm,z_mm\n0,0,0,0\n1,30,-3,0\n2,60,-6,2000\n");
  EXPECT_EQ(codes("--follow far.csv"), usual + "unlikely_translation ");
  EXPECT_EQ(run("rom joint.toml --motion flexion --strict --follow far.csv").exit_code, 4);
  const std::string loaded = codes("--follow-load --force 300 900 0");
  EXPECT_EQ(codes("--follow-load --force 3000 9000 0").find("unlikely_load"), loaded.size())
      << "after notes on limits and layers";
}

TEST_F(Follow, AReportHasTheSameLimitsAndSaysThatTheyAreBounded) {
  for (const std::string follow :
       {"--follow record.csv", "--follow-load --force 300 900 0 --along 1 0 0 0 1 0"}) {
    SCOPED_TRACE(follow);
    done("report joint.toml --out page.html " + follow);
    Json page = report_block(text_of("page.html")).json;
    const Json rom = answer("rom joint.toml " + follow);
    EXPECT_EQ(page["rom"]["exact"], false);
    EXPECT_EQ(page["rom"]["motions"], rom["motions"]);
    EXPECT_EQ(page["rom"]["caveats"], rom["caveats"]);
    EXPECT_EQ(page["rom"]["notes"], rom["notes"]);
    ASSERT_GE(page["poses"].size(), 2u);
    const Json& limit = rom["motions"][0];
    const Json& pose = page["poses"][1];
    EXPECT_EQ(pose["name"], limit["name"]);
    for (std::size_t axis = 0; axis < 3; ++axis)
      EXPECT_EQ(pose["pose"][4 * axis + 3], limit["translation_mm"][axis]) << "where it is at the limit";
  }
  for (const char* option :
       {"--band", "--translation \"x=1\"", "--past 5", "--map flexion=0:20:10 adduction=0:10:10"})
    EXPECT_EQ(run(std::string("report joint.toml --out p.html --follow record.csv ") + option).exit_code, 2)
        << option;
  EXPECT_TRUE(says(run("report joint.toml --out p.html --follow-load").err, "needs --force"));
  EXPECT_FALSE(fs::exists(folder / "p.html"));
}

std::string field(const std::vector<std::string>& lines, std::size_t row, const std::string& name) {
  const std::vector<std::string> names = fields_of(lines.at(0));
  const auto at = std::find(names.begin(), names.end(), name);
  EXPECT_NE(at, names.end()) << name;
  return at == names.end() ? "" : fields_of(lines.at(row)).at(static_cast<std::size_t>(at - names.begin()));
}

TEST_F(Follow, AStudyHasTheSameLimits) {
  write("joints.csv",
        "id,joint,follow\nled,joint.toml,record.csv\nheld,joint.toml,\n"
        "gone,joint.toml,none.csv\nback,joint.toml,back.csv\n");
  write("back.csv", "time,flexion_deg\n0,0\n1,20\n2,10\n3,30\n");
  done("study joints.csv --out study");
  const Json limit = answer("rom joint.toml --follow record.csv")["motions"][0];
  const auto limits = lines_of(text_of("study/limits.csv")), hips = lines_of(text_of("study/hips.csv")),
             failures = lines_of(text_of("study/failures.csv"));
  ASSERT_EQ(limits.size(), 2u);
  EXPECT_EQ(std::stod(field(limits, 1, "limit_deg")), limit["limit_deg"].get<double>());
  EXPECT_EQ(std::stod(field(limits, 1, "translation_x_mm")), limit["translation_mm"][0].get<double>());
  EXPECT_EQ(field(limits, 1, "translation_ends"), "false");
  EXPECT_EQ(field(hips, 1, "exact"), "0");
  ASSERT_EQ(failures.size(), 4u);
  EXPECT_TRUE(says(field(failures, 1, "message"), "is a free joint"));
  EXPECT_TRUE(says(field(failures, 2, "message"), "none.csv: no such file"));
  EXPECT_TRUE(says(field(failures, 3, "message"), "joints.csv: line 5: column 'follow'"));
  // Once more: nothing changed. A changed record is another input.
  EXPECT_TRUE(says(run("study joints.csv --out study").err, "is there already"));
  write("record.csv", "time,flexion_deg,x_mm\n0,0,0\n1,60,-3\n");
  EXPECT_FALSE(says(run("study joints.csv --out study").err, "is there already"));
}

TEST_F(Follow, AStudyFollowsALoad) {
  write("joints.csv", "id,joint\none,joint.toml\n");
  const std::string force = " --motion flexion --follow-load --force 300 900 0";
  done("study joints.csv --out study" + force);
  const Json limit = answer("rom joint.toml" + force)["motions"][0];
  const auto limits = lines_of(text_of("study/limits.csv"));
  EXPECT_EQ(std::stod(field(limits, 1, "limit_deg")), limit["limit_deg"].get<double>());
  EXPECT_EQ(field(lines_of(text_of("study/hips.csv")), 1, "exact"), "0");
  const Ran planned = run("study joints.csv --out planned --resect flexion=90" + force);
  EXPECT_EQ(planned.exit_code, 3);
  EXPECT_TRUE(says(planned.err, "is a free joint, and a study plans none"));
  for (const auto& [arguments, saying] : {std::pair{"--follow-load", "needs --force"},
                                          {"--force 1 2 3", "needs --load or --follow-load"},
                                          {"--follow-load --load \"\" --force 1 2 3", "stands beside --load"},
                                          {"--follow-load --force 300 900 0 --band", "limits only"}}) {
    expect_refused(2, std::string("study joints.csv --out other ") + arguments, saying);
  }
}

}  // namespace
}  // namespace condyle::test
