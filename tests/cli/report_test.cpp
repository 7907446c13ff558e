#include "command.hpp"
#include "support/report_block.hpp"

namespace condyle::test {
namespace {

/// An arm hanging from the joint centre and a post in front of it.
class ReportCommand : public ArmAndPost {
 protected:
  void SetUp() override {
    ArmAndPost::SetUp();
    write_joint("");
  }
  void write_arm(const TriMesh& mesh) const { io::write_mesh(here / "arm.ply", mesh); }
  void write_joint(const std::string& more) const {
    write("joint.toml", text_of_joint({.more = more, .name = "arm & <post>"}));
  }
  ReportBlock block() const { return report_block(text_of("report.html")); }
  Json page_of(const std::string& arguments) const {
    const Ran ran = done("report joint.toml --out report.html" + arguments);
    EXPECT_EQ(ran.out, "");
    EXPECT_TRUE(says(ran.err, "wrote report.html"));
    return block().json;
  }
  void expect_refused(int exit_code, const std::string& arguments, std::string_view saying) const {
    CommandTest::expect_refused(exit_code, arguments, saying);
    EXPECT_FALSE(fs::exists(here / "report.html")) << arguments;
  }

  static constexpr const char* layers =
      "[contact]\ncasting = \"fixed\"\n[contact.fixed]\nyoungs_modulus_mpa = 10\npoisson_ratio = 0.45\n"
      "thickness = 6\n";
  static constexpr const char* tilted =
      "[[part]]\nname = \"tilted\"\nbody = \"fixed\"\n[[part.parameter]]\nname = \"tilt\"\n"
      "range = [-20, 20]\n";
};

/// The common part of both without the command line, and the intervals of the map, which have their own place in a
/// report.
Json without_command(Json rom) {
  rom["provenance"].erase("command");
  if (rom.contains("map")) rom["map"].erase("intervals");
  return rom;
}

TEST_F(ReportCommand, SaysWhatRomSaysWithTheSameOptions) {
  const std::string options =
      " --band=20 --seed 7 --sigma-axes 0.5 --bearing count --map adduction=-10:10:10 "
      "internal_rotation=-10:10:10 --vary flexion";
  const Json report = page_of(options + " --title 'Ein \"Titel\" & mehr'");
  const Ran rom = done("rom joint.toml --json" + options);
  EXPECT_EQ(without_command(report["rom"]), without_command(Json::parse(rom.out)));
  EXPECT_EQ(report["rom"]["provenance"]["command"][0], "report");
  EXPECT_EQ(report["title"], "Ein \"Titel\" & mehr");
  EXPECT_EQ(report["joint"]["name"], "arm & <post>");
  EXPECT_EQ(report["map"]["intervals"].size(), 9u);
  EXPECT_EQ(report["recorded"], nullptr);
}

TEST_F(ReportCommand, IsCalledAfterTheJointAndHasItsOwnMotions) {
  write_joint("[[motion]]\nname = \"half_way\"\nvary = \"flexion\"\nrange = [0, 10]\n");
  const Json report = page_of("");
  EXPECT_EQ(report["title"], "arm & <post>");
  EXPECT_EQ(report["poses"].back()["name"], "half_way");
  EXPECT_EQ(report["map"], nullptr);
}

TEST_F(ReportCommand, ShowsBodiesInContactAndSaysWhyThereAreNoLimits) {
  write_arm(box({-1, -100, -2}, {41, -10, 2}));
  const Json report = page_of("");
  EXPECT_EQ(report["rom"], nullptr);
  EXPECT_TRUE(says(report["rom_error"].get<std::string>(), "in contact in the reference pose"));
  EXPECT_EQ(report["poses"].size(), 1u);
  EXPECT_EQ(report["poses"][0]["in_contact"], true);
  EXPECT_EQ(page_of(" --accept-reference-contact")["rom"]["motions"][0]["reason"], "contact_at_start");
}

/// The answer of another command without what the page has of the joint.
Json without_joint(Json json) {
  for (const char* key : {"condyle", "joint", "fixed", "mobile", "side", "notes", "scope", "provenance"})
    json.erase(key);
  return json;
}

TEST_F(ReportCommand, ShowsTheBoneThatMustGoAndTheJointWithoutIt) {
  done("sample hip --scenario 1 --alpha-angle 70 --out hip");
  const std::string cut = "internal_rotation_at_90_flexion=45 --curve 2 --deepest 8 --margin 0";
  done("report hip/hip.toml --out report.html --measures --resect " + cut);
  const ReportBlock block = this->block();
  const Ran resect = done("resect hip/hip.toml --json --out plan --reach " + cut);
  Json plan = block.json["plan"];
  const Json surfaces = plan["surfaces"];
  plan.erase("surfaces");
  EXPECT_EQ(plan, without_joint(Json::parse(resect.out)));
  // The joint and its limits are those of the file that condyle resect writes.
  const Ran rom = run("rom plan/resected.toml --json");
  for (std::size_t i = 0; i < 12; ++i)
    EXPECT_EQ(block.json["rom"]["motions"][i]["limit_deg"], Json::parse(rom.out)["motions"][i]["limit_deg"]);
  const Ran shape = run("measure plan/resected.toml --json");
  const Json measures = without_joint(Json::parse(shape.out));
  EXPECT_EQ(block.json["measures"]["measures"], measures["measures"]);

  EXPECT_EQ(surfaces["fixed"], nullptr);
  const auto lowered = block.array<std::uint32_t>(surfaces["mobile"]["lowered"], "u32");
  const auto before = block.array<double>(surfaces["mobile"]["before"], "f64");
  const auto depth = block.array<double>(surfaces["mobile"]["depth_mm"], "f64");
  const auto after = block.array<double>("mobile_vertices", "f64");
  ASSERT_EQ(before.size(), 3 * lowered.size());
  EXPECT_EQ(*std::max_element(depth.begin(), depth.end()), plan["cuts"][0]["deepest_mm"]);
  for (std::size_t i = 0; i < lowered.size(); ++i) {
    const auto at = [&](const std::vector<double>& xyz, std::size_t v) {
      return Vec3(xyz[3 * v], xyz[3 * v + 1], xyz[3 * v + 2]);
    };
    EXPECT_GE((at(after, lowered[i]) - at(before, i)).norm(), depth[i] * (1 - 1e-12));
  }
}

TEST_F(ReportCommand, RefusesOptionsOfACutWithoutOneAndPlansThatAPageDoesNotShow) {
  expect_refused(2, "report joint.toml --out report.html --margin 1", "--resect");
  expect_refused(2, "report joint.toml --out report.html --resect flexion=500", "cannot reach 500 degrees");
  write_joint(layers);
  expect_refused(2, "report joint.toml --out report.html --load --resect flexion=30", "not with --load");
  EXPECT_EQ(page_of("")["plan"], nullptr);
  EXPECT_EQ(page_of("")["measures"], nullptr);
}

TEST_F(ReportCommand, ComparesAJointWithTheOneBefore) {
  io::write_mesh(folder / "post_after.ply", box({50, -120, -50}, {70, -80, 50}));
  write_edited("after.toml", "joint.toml", "mesh = \"post.ply\"", "mesh = \"post_after.ply\"");
  const std::string options = " --band=20 --seed 7";
  done("report ./joint.toml after.toml --past 5 --out report.html" + options);
  const ReportBlock block = this->block();
  const Json& before = block.json["before"];
  EXPECT_EQ(before["file"], "joint.toml");
  EXPECT_EQ(without_command(before["rom"]), without_command(answer("rom joint.toml" + options)));
  const Json after = answer("rom after.toml --past 5" + options);
  EXPECT_EQ(without_command(block.json["rom"])["motions"][0]["limit_deg"], after["motions"][0]["limit_deg"]);
  const Json& flexion = before["differences"][0];
  EXPECT_EQ(flexion["difference_deg"].get<double>(),
            after["motions"][0]["limit_deg"].get<double>() -
                before["rom"]["motions"][0]["limit_deg"].get<double>());
  EXPECT_EQ(flexion["beyond_band"], true) << "ten millimetres farther away in every displaced joint";
  const Json &paired = flexion["band"], &alone = after["motions"][0]["band"];
  EXPECT_LT(paired["p95_deg"].get<double>() - paired["p5_deg"].get<double>(),
            alone["p95_deg"].get<double>() - alone["p5_deg"].get<double>());
  EXPECT_EQ(before["surfaces"]["mobile"], nullptr);
  EXPECT_EQ(block.array<double>("before_fixed_vertices", "f64").size(), 24u);
  EXPECT_EQ(block.json["title"], "arm & <post>");
}

TEST_F(ReportCommand, SetsParametersOfTheJointAfterOnly) {
  write_joint(tilted);
  done("report joint.toml joint.toml --set tilted.tilt=5 --out report.html");
  const Json block = this->block().json;
  const Json& before = block["before"]["rom"]["provenance"]["parameters"][0];
  EXPECT_EQ(before["value"], before["in_joint_file"]);
  EXPECT_EQ(block["rom"]["provenance"]["parameters"][0]["value"], 5);
  EXPECT_NE(block["before"]["surfaces"]["fixed"], nullptr);
}

TEST_F(ReportCommand, SaysThatWithoutLimitsThereIsNoSafeZone) {
  write_joint(tilted);
  folder.file("targets.csv", "name,motion,reach_deg,pelvic_tilt_deg,source\nsitting,flexion,20,,\n");
  const std::string swept = " --sweep tilted.tilt=-10:10:10 --targets targets.csv";
  EXPECT_EQ(page_of(swept)["sweep"]["parameters"].size(), 1u);

  write_arm(box({-1, -100, -2}, {41, -10, 2}));
  const Ran ran = done("report joint.toml --out report.html" + swept);
  EXPECT_TRUE(says(ran.err, "no safe zone: without limits"));
  EXPECT_FALSE(block().json.contains("sweep"));
}

TEST_F(ReportCommand, ShowsAComparisonOfWhichOneJointHasNoLimits) {
  io::write_mesh(folder / "long.ply", box({-1, -100, -2}, {41, -10, 2}));
  write_edited("after.toml", "joint.toml", "mesh = \"arm.ply\"", "mesh = \"long.ply\"");
  const auto report = [&](const std::string& joints) {
    const Ran ran = done("report " + joints + " --out report.html");
    EXPECT_TRUE(says(ran.err, "after.toml: no limits: "));
    return block().json;
  };
  const std::string_view why = "in contact in the reference pose";
  const Json now = report("joint.toml after.toml");
  EXPECT_EQ(now["rom"], nullptr);
  EXPECT_NE(now["before"]["rom"], nullptr);
  EXPECT_EQ(now["before"]["differences"], Json::array());
  const Json then = report("after.toml joint.toml");
  EXPECT_NE(then["rom"], nullptr);
  EXPECT_TRUE(says(then["before"]["rom_error"].get<std::string>(), why));
}

TEST_F(ReportCommand, RefusesJointsThatDoNotCompareAndNamesBoth) {
  write_edited("left.toml", "joint.toml", "side = \"right\"", "side = \"left\"");
  write_edited("hinge.toml", "joint.toml", "kind = \"ball\"", "kind = \"hinge\"");
  write_edited("other.toml", "joint.toml", "", "");
  for (const std::string other : {"left.toml", "hinge.toml"}) {
    expect_refused(2, "report joint.toml " + other + " --out report.html",
                   "joint.toml (ball, hip, right) and " + other);
    expect_refused(2, "report " + other + " joint.toml --out report.html",
                   " and joint.toml (ball, hip, right): ");
  }
  expect_refused(2, "report joint.toml other.toml --resect flexion=30 --out report.html", "--resect: ");
  expect_refused(2, "report joint.toml other.toml --follow none.csv --out report.html", "--follow: ");
  expect_refused(3, "report none.toml joint.toml --out report.html", "none.toml");
  expect_refused(3, "report joint.toml other.toml --out joint.toml", "joint.toml: is read for this answer");
  expect_refused(2, "report joint.toml other.toml third.toml --out report.html", "third.toml");
  expect_refused(2, "report joint.toml other.toml --empty --out report.html",
                 "JOINT: is for a report of a joint");
}

TEST_F(ReportCommand, PlaysARecordedMotion) {
  folder.file("swing.csv", "time,flexion_deg\n0,0\n0.1,10\n0.2,\n0.3,30\n");
  done("report joint.toml --motion swing.csv --out report.html");
  const ReportBlock block = this->block();
  const Json& recorded = block.json["recorded"];
  EXPECT_EQ(recorded["name"], "swing.csv");
  EXPECT_EQ(block.array<double>(recorded["times_s"], "f64"), (std::vector{0.0, 0.1, 0.2, 0.3}));
  bool found = false;
  for (const Json& curve : recorded["curves"]) {
    if (curve["name"] != "in_contact") continue;
    const auto values = block.array<double>(curve["values"], "f64");
    EXPECT_EQ(values[1], 0);
    EXPECT_EQ(values[3], 1);  // past its limit of some 23 degrees
    found = true;
  }
  EXPECT_TRUE(found);
}

TEST_F(ReportCommand, PressureComesFromLayersOfTheJointFile) {
  folder.file("swing.csv", "time,flexion_deg\n0,0\n0.1,10\n");
  expect_refused(2, "report joint.toml --out report.html --motion swing.csv --load", "no layers");
  write_joint(layers);
  const Json report = page_of(" --motion swing.csv --load");
  bool found = false;
  for (const Json& curve : report["recorded"]["curves"])
    found |= curve["name"] == "max_pressure_mpa" && curve["unit"] == "MPa";
  EXPECT_TRUE(found);
}

TEST_F(ReportCommand, HoldsTheLayersThatThePageComputesPressureWith) {
  write_joint(layers);
  EXPECT_EQ(page_of("")["layers"], nullptr);
  done("report joint.toml --load --out report.html");
  const ReportBlock block = this->block();
  const Json& layers = block.json["layers"];
  EXPECT_EQ(layers["casting"], "fixed");
  EXPECT_EQ(layers["law"], "linear");
  EXPECT_EQ(layers["rule"], "cut_faces");
  EXPECT_EQ(layers["reach_mm"], 20);
  EXPECT_EQ(layers["fixed"]["youngs_modulus_mpa"], 10);
  EXPECT_EQ(layers["fixed"]["poisson_ratio"], 0.45);
  EXPECT_EQ(layers["fixed"]["first_vertex"], 0);
  EXPECT_EQ(block.array<double>(layers["fixed"]["thickness_mm"], "f64"), std::vector(8, 6.0));
  EXPECT_EQ(layers["mobile"]["triangles"], 12);
  EXPECT_FALSE(layers["mobile"].contains("thickness_mm")) << "it is rigid";
}

TEST_F(ReportCommand, HoldsTheTrianglesThatMeetPastALimit) {
  EXPECT_EQ(page_of("")["zones"].size(), 0u);
  done("report joint.toml --past 3 --out report.html");
  const ReportBlock block = this->block();
  done("rom joint.toml --past 3 --out range");
  std::size_t zones = 0;
  for (const Json& zone : block.json["zones"]) {
    EXPECT_EQ(zone["past_deg"], 3);
    for (const std::string body : {"fixed", "mobile"}) {
      const auto triangles = block.array<std::uint32_t>(zone[body], "u32");
      EXPECT_FALSE(triangles.empty());
      EXPECT_TRUE(std::is_sorted(triangles.begin(), triangles.end()));
    }
    ++zones;
  }
  std::size_t files = 0;  // zone_02_extension_fixed.vtp and the like
  for (const auto& entry : fs::directory_iterator(folder / "range"))
    files += entry.path().filename().string().ends_with("_fixed.vtp");
  EXPECT_EQ(zones, files);
  EXPECT_GT(zones, 0u);
}

TEST_F(ReportCommand, WithoutAJointIsThePageThatTakesOne) {
  done("report --empty --out report.html");
  const std::string page = text_of("report.html");
  EXPECT_TRUE(says(page, "<!--condyle-data-->"));
  EXPECT_FALSE(says(page, "id=\"condyle-data\""));
  for (const std::string file : {"hip_bone.ply", "femur.ply", "hip.toml"})
    EXPECT_TRUE(says(page, "data-sample=\"" + file + "\"")) << file;
  fs::remove(folder / "report.html");
  expect_refused(2, "report joint.toml --empty --out report.html", "JOINT: is for a report of a joint");
  expect_refused(2, "report --empty --title x --out report.html", "--title: is for a report of a joint");
}

TEST_F(ReportCommand, RefusesInOneLineAndWritesNothing) {
  expect_refused(2, "report joint.toml", "--out is required");
  for (const std::string joint : {"joint.toml", "--empty"})
    for (const std::string file : {"case.pdf", "page"})
      expect_refused(2, "report " + joint + " --out " + file,
                     file + ": a page is written, FILE.html; print it to PDF from a browser");
  expect_refused(2, "report --out report.html", "JOINT is required");
  expect_refused(2, "report joint.toml --out report.html --seed 4", "requires --band");
  expect_refused(2, "report joint.toml --out report.html --load", "no layers");
  expect_refused(2, "report joint.toml --out report.html --past -1", "past");
  expect_refused(2, "report joint.toml --out report.html --vary flexion", "--vary");
  expect_refused(2, "report joint.toml --out report.html --map tilt=0:1:1 adduction=0:1:1", "'tilt'");
  expect_refused(2, "report joint.toml --out report.html --translation x=1", "only a free joint");
  expect_refused(3, "report none.toml --out report.html", "none.toml");
  expect_refused(3, "report joint.toml --out report.html --motion none.csv", "none.csv");
  expect_refused(3, "report joint.toml --out .", "is a folder");
  expect_refused(3, "report joint.toml --out joint.toml/report.html", "cannot be written");
  io::write_mesh(folder / "arm.ply", box({-0.1, -10, -0.2}, {0.1, -1, 0.2}));
  expect_refused(4, "report joint.toml --strict --out report.html", "--strict");
  EXPECT_EQ(std::distance(fs::directory_iterator(folder.path()), {}), 3);
}

TEST_F(ReportCommand, AnOlderReportStaysWhereANewOneFails) {
  folder.file("report.html", "of The Condyle authors");
  ASSERT_EQ(run("report joint.toml --out report.html --band=3").exit_code, 2);
  EXPECT_EQ(text_of("report.html"), "of The Condyle authors");
  EXPECT_EQ(std::distance(fs::directory_iterator(folder.path()), {}), 4);
}

TEST_F(ReportCommand, IsTheSameBytesOnOneThreadAndOnTwo) {
  done("report joint.toml --threads 1 --band=20 --out one.html");
  done("report joint.toml --threads 2 --band=20 --out two.html");
  EXPECT_EQ(text_of("one.html"), text_of("two.html"));
}

}  // namespace
}  // namespace condyle::test
