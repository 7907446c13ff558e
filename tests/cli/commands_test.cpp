#include <regex>
#include <sstream>

#include "command.hpp"
#include "condyle/version.hpp"

namespace condyle::test {
namespace {

/// A hip of a socket and a head on a neck.
class Command : public CommandTest {
 protected:
  void SetUp() override {
    io::write_mesh(here / "femur.ply", femur);
    io::write_mesh(here / "hip_bone.ply", hip_bone);
    write("right_hip.toml", joint);
  }
  void write_joint(std::string_view from, std::string_view to) const {
    write("right_hip.toml", joint);
    edit("right_hip.toml", from, to);
  }

  const std::string joint = text_of_joint(
      {.fixed = "hip_bone.ply", .mobile = "femur.ply", .name = "right hip", .centre = "\"fit\""});
  const TriMesh femur = joined(sphere({0, 0, 0}, 24, 4), box({-10, -400, -10}, {10, -40, 10})),
                hip_bone = socket({0, 0, 0}, 26, 60, 3);
};

TEST_F(Command, InspectAnswersInTextAndJson) {
  const Ran text = done("inspect femur.ply hip_bone.ply");
  EXPECT_EQ(text.err, "");
  EXPECT_TRUE(says(text.out, "femur.ply\n  " + std::to_string(femur.vertices.size()) + " vertices"));
  const Json answer = this->answer("inspect femur.ply hip_bone.ply");
  ASSERT_EQ(answer["meshes"].size(), 2u);
  EXPECT_EQ(answer["meshes"][0]["file"], "femur.ply");
  EXPECT_EQ(answer["meshes"][0]["vertices"], femur.vertices.size());
  EXPECT_EQ(answer["meshes"][1]["triangles"], hip_bone.triangles.size());
  EXPECT_EQ(answer["meshes"][0]["closed"], true);
  EXPECT_EQ(answer["meshes"][0]["components"].size(), 2u);
  EXPECT_EQ(answer["meshes"][0]["likely_unit"], "mm");
  const Json& from = answer["provenance"];
  EXPECT_EQ(from["version"], version);
  EXPECT_EQ(from["command"], (Json{"inspect", "femur.ply", "hip_bone.ply"}));
  ASSERT_EQ(from["meshes"].size(), 2u);
  EXPECT_EQ(from["meshes"][1]["path"], "hip_bone.ply");
  EXPECT_EQ(from["meshes"][1]["bytes"], fs::file_size(here / "hip_bone.ply"));
  EXPECT_EQ(from["meshes"][1]["sha256"], io::digest_of(text_of("hip_bone.ply")).sha256);
}

TEST_F(Command, InspectRepairsOnRequestAndWritesTheResult) {
  TriMesh dirty = flipped(femur);
  dirty.vertices.push_back({5, 5, 5});
  io::write_mesh(here / "dirty.ply", dirty);
  const Json answer =
      this->answer("inspect dirty.ply --repair drop_unreferenced,flip_inverted --out repaired");
  EXPECT_EQ(answer["meshes"][0]["repairs"][0], (Json{{"repair", "drop_unreferenced"}, {"count", 1}}));
  EXPECT_EQ(answer["meshes"][0]["inverted_components"]["count"], 0);
  const TriMesh repaired = io::read_mesh(here / "repaired/dirty.ply").mesh;
  EXPECT_EQ(repaired.vertices, femur.vertices);
  EXPECT_EQ(io::read_mesh(here / "dirty.ply").mesh, dirty);
}

TEST_F(Command, FrameAnswersInTextAndJson) {
  const Ran text = done("frame right_hip.toml");
  EXPECT_TRUE(text.err.starts_with("condyle: note: separate_pieces: mobile is 2 pieces")) << text.err;
  EXPECT_EQ(std::count(text.err.begin(), text.err.end(), '\n'), 1);
  EXPECT_TRUE(says(text.out, "sphere of radius 24.000 mm"));
  const Json answer = this->answer("frame right_hip.toml");
  EXPECT_EQ(answer["side"], "right");
  EXPECT_EQ(answer["kind"], "ball");
  EXPECT_EQ(answer["axes"]["right"], (Json{0.0, 0.0, 1.0}));
  // The sphere's 1026 vertices are 24 mm from the origin to u; see the tests of the fit.
  EXPECT_NEAR(answer["fit"]["radius_mm"], 24, 1e-12);
  EXPECT_EQ(answer["fit"]["vertex_count"], answer["fit"]["vertices"].size());
  EXPECT_EQ(answer["mobile"]["vertices"], femur.vertices.size());
  EXPECT_NEAR(answer["mobile"]["bounds_mm"]["low"][1], -400, 1e-9);
  EXPECT_EQ(answer["provenance"]["command"], (Json{"frame", "right_hip.toml"}));
  EXPECT_EQ(answer["provenance"]["mobile_mesh"]["bytes"], fs::file_size(here / "femur.ply"));
}

TEST_F(Command, WrongUsageEndsWithTwo) {
  expect_refused(2, "", "a command is needed: init, hip, surface, inspect, frame");
  expect_refused(2, "inspekt femur.ply", "unknown command 'inspekt'");
  expect_refused(2, "inspect", "MESH is required");
  expect_refused(2, "frame", "JOINT is required");
  expect_refused(2, "frame right_hip.toml --jsn", "--jsn");
  expect_refused(2, "--threads 0 inspect femur.ply", "--threads");
  expect_refused(2, "--threads two inspect femur.ply", "--threads");
  expect_refused(2, "inspect femur.ply --repair fill", "unknown repair \"fill\"");
  expect_refused(2, "inspect femur.ply ./femur.ply --out repaired",
                 "two meshes would be written as femur.ply");
  EXPECT_FALSE(fs::exists(here / "repaired"));
}

TEST_F(Command, ABadFileEndsWithThree) {
  write("empty.stl", "");
  write("line\nbreak.ply", "ply\nformat");
  expect_refused(3, "inspect none.ply", "none.ply");
  expect_refused(3, "inspect empty.stl", "empty.stl");
  expect_refused(3, "inspect femur.ply empty.stl", "empty.stl");
  expect_refused(3, "inspect 'line\nbreak.ply'", "line break.ply");
  expect_refused(3, "inspect .", ".");
  expect_refused(3, "frame none.toml", "none.toml");
  expect_refused(3, "inspect right_hip.toml", "right_hip.toml: is a joint file, not a mesh: condyle rom ");
  expect_refused(3, "frame .", ".");
  write_joint("\"right\"", "\"up\"");
  expect_refused(3, "frame right_hip.toml",
                 "right_hip.toml: line 4: side: must be \"right\" or \"left\", not \"up\"");
}

/// By content or, where that shows nothing, by name: whatever is no joint file has a command that takes it.
TEST_F(Command, WhatIsNoJointFileIsNamedWithWhatTakesIt) {
  const auto refused = [&](const std::string& name, const std::string& text, const std::string& saying) {
    write(name, text);
    expect_refused(3, "rom " + name, name + ": is " + saying);
  };
  const std::string text = "some text\n";
  const auto mesh = "a mesh, not a joint file: condyle init FIXED MOBILE --out hip.toml makes one\n";
  expect_refused(3, "rom femur.ply", "femur.ply: is " + std::string(mesh));
  for (const char* command : {"frame", "measure", "depth", "load"})
    expect_refused(3, command + std::string(" femur.ply"), "femur.ply: is a mesh, not a joint file: ");
  refused("deep.ply", std::string(40, '['), mesh);
  for (const char* name : {"a.stl", "a.obj", "a.vtk", "a.vtp", "A.STL"}) refused(name, text, mesh);
  refused("renamed.toml", "ply\nformat ascii 1.0\n", mesh);
  refused("vtk.toml", "# vtk DataFile Version 3.0\nmesh\n", mesh);
  refused("stl.toml", "solid bone\nfacet normal 0 0 1\n", mesh);
  refused("vtp.toml", "<?xml version=\"1.0\"?>\n<VTKFile type=\"PolyData\">", mesh);
  refused("binary.toml", std::string(84, '\0'), mesh);
  refused("article.pdf", "%PDF-1.7\n", "a PDF, not a joint file: condyle init FIXED MOBILE ");
  for (const char* name : {"map.nii", "map.nii.gz", "map.nrrd", "map.nhdr", "map.mha", "map.mhd"})
    refused(name, text,
            "a label map, not a joint file: condyle init " + std::string(name) +
                " --fixed LABEL --mobile LABEL --out hip.toml makes one");
  refused("map", "NRRD0005\ntype: short\n", "a label map, not a joint file: ");
  refused("model.osim", "<?xml version=\"1.0\"?>\n<OpenSimDocument Version=\"40000\"/>",
          "a model of OpenSim, not a joint file: condyle init model.osim --joint NAME --out joint.toml ");
  refused("model.xml", "<OpenSimDocument/>", "a model of OpenSim, not a joint file: ");
  refused("page.html", "<html></html>", "a page, not a joint file: condyle init ");
  refused("some.xml", "<a></a>", "XML, not a joint file: ");
  refused("rom.json", "{\"joint\": \"hip\"}", "JSON, not a joint file: an answer names the joint file ");
  refused("hip.png", "\x89PNG\r\n", "a picture, not a joint file: ");
  refused("walk.mot", text, "a recorded motion, not a joint file: condyle motion JOINT --motion walk.mot ");
  refused("table.csv", "id,joint\n", "a table, not a joint file: condyle study takes ");
  refused("joint.toml", "PK\3\4", "compressed by zip, not a joint file: uncompress it first");
  write("scan.dcm", text);
  expect_refused(3, "rom scan.dcm", "scan.dcm: DICOM is not read");
  write("text.toml", text);
  expect_refused(3, "rom text.toml", "text.toml: line 1: not TOML: ");
  // A joint file is one under any name.
  fs::copy_file(here / "right_hip.toml", here / "hip.ply");
  done("frame hip.ply");
}

TEST_F(Command, AnUnwritableFolderEndsWithThreeAndLeavesNothing) {
  const std::size_t before = count_entries(folder.path());
  expect_refused(3, "inspect femur.ply --out femur.ply", "femur.ply");
  expect_refused(3, "inspect femur.ply --out femur.ply/below", "femur.ply/below");
  expect_refused(3, "inspect femur.ply --out /proc/condyle", "/proc/condyle");
  EXPECT_EQ(count_entries(folder.path()), before);
}

TEST_F(Command, AnUnfitMeshEndsWithFour) {
  write_joint("\"fit\"", "\"fit\"\nfit_within = { centre = [0, -300, 0], radius = 20 }");
  expect_refused(4, "frame right_hip.toml", "no spherical head");
  TriMesh open = femur;
  open.triangles.pop_back();
  io::write_mesh(here / "open.ply", open);
  expect_refused(4, "inspect open.ply --repair flip_inverted --out repaired", "open.ply");
  EXPECT_FALSE(fs::exists(here / "repaired"));
}

TEST_F(Command, AnAnswerThatCannotBeWrittenEndsWithThree) {
  for (const char* redirection : {">&-", ">/dev/full"}) {
    const Ran ran = run("inspect femur.ply", redirection);
    EXPECT_EQ(ran.exit_code, 3) << redirection;
    EXPECT_EQ(ran.err, "condyle: standard output: cannot be written\n") << redirection;
  }
}

TEST_F(Command, AClosedStandardOutputIsNotMixedIntoResultFiles) {
  const Ran ran = run("inspect femur.ply --out written", ">&-");
  EXPECT_EQ(ran.exit_code, 3);
  EXPECT_EQ(io::read_mesh(here / "written/femur.ply").mesh, femur);
}

TEST_F(Command, HelpAndVersionAreAnswers) {
  for (const char* arguments : {"--help", "inspect --help", "frame --help", "--version"}) {
    const Ran ran = done(arguments);
    EXPECT_EQ(ran.err, "") << arguments;
    EXPECT_NE(ran.out, "") << arguments;
  }
  EXPECT_TRUE(run("--version").out.starts_with("condyle "));
  EXPECT_EQ(run("-V").out, run("--version").out);
  EXPECT_EQ(run("help rom").out, run("rom --help").out);
  EXPECT_EQ(run("help").out, run("--help").out);
}

/// Every option in one group, and first the five that matter most.
TEST_F(Command, HelpBeginsWithFiveOptionsAndLeavesNoneWithoutAGroup) {
  for (const char* command : {"depth", "rom", "load", "motion", "measure", "resect", "implant", "picture",
                              "report", "sample hip", "sample cartilages", "study"}) {
    SCOPED_TRACE(command);
    std::istringstream help(run(std::string(command) + " --help-all").out);
    std::map<std::string, std::set<std::string>> options;
    std::set<std::string> all;
    std::string group;
    for (std::string line; std::getline(help, line);) {
      if (line.ends_with(":") && !line.starts_with(" ")) group = line;
      if (line.empty()) group.clear();
      std::smatch option;
      if (!group.empty() && std::regex_search(line, option, std::regex("^  (?:-h,)?(--[a-z-]+)"))) {
        EXPECT_TRUE(all.insert(option[1]).second) << option[1] << " is there twice";
        options[group].insert(option[1]);
      }
    }
    EXPECT_EQ(options["Most used:"].size(), 5u);
    EXPECT_TRUE(options["Other:"].empty());
    EXPECT_TRUE(all.contains("--help") && all.contains("--out"));
  }
}

TEST_F(Command, NearMissesAreAnsweredWithWhatWasMeant) {
  expect_refused(2, "insepct femur.ply", "unknown command 'insepct' (did you mean \"inspect\"?)");
  expect_refused(2, "frame right_hip.toml --jsno", "(did you mean \"--json\"?)");
  expect_refused(2, "rom right_hip.toml --bnad=40", "(did you mean \"--band\"?)");
  write_joint("centre = \"fit\"", "center = \"fit\"");
  expect_refused(3, "frame right_hip.toml",
                 "frame.centre: is missing; there is \"center\" (did you mean \"centre\"?)");
  write_joint("mesh = \"femur.ply\"", "mesh = \"femurr.ply\"");
  expect_refused(3, "frame right_hip.toml", "right_hip.toml: mobile.mesh: there is no file ");
}

TEST_F(Command, InitReplacesNoJointFile) {
  const std::string edited = text_of("right_hip.toml");
  expect_refused(3, "init hip_bone.ply femur.ply -o right_hip.toml",
                 "right_hip.toml: is there already, and may have been edited: name another or remove it");
  EXPECT_EQ(text_of("right_hip.toml"), edited);
  done("init hip_bone.ply femur.ply -o new.toml");
  const std::string proposed = text_of("new.toml");
  EXPECT_EQ(run("init hip_bone.ply femur.ply").out, proposed);
  expect_refused(3, "init hip_bone.ply femur.ply -o new.toml", "name another or remove it");
  expect_refused(2, "init hip_bone.ply femur.ply -o new.json",
                 "new.json: a joint file is written, FILE.toml");
}

TEST_F(Command, AnswersDoNotDependOnTheNumberOfThreads) {
  const Ran one = run("--threads 1 frame right_hip.toml --json"),
            many = run("frame right_hip.toml --json --threads 8");
  EXPECT_EQ(one.exit_code, 0);
  EXPECT_EQ(one.out, many.out);
}

}  // namespace
}  // namespace condyle::test
