#include <gtest/gtest.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <string>

#include "command.hpp"
#include "condyle/io/mesh_file.hpp"
#include "io/file/whole_file.hpp"
#include "support/temporary_folder.hpp"
#include "support/test_meshes.hpp"

/// touch, turn and slide: two meshes without a joint file.

namespace condyle::test {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::json;

/// A box of 6 x 6 x 5.25, lying 3.75 above where it is 1.25 deep in one of 20 x 20 x 20.
class TouchCommand : public ::testing::Test {
 protected:
  void SetUp() override {
    io::write_mesh(here / "a.ply", box({-10, -10, -10}, {10, 10, 10}));
    io::write_mesh(here / "b.ply", box({-3, -2, 12.5}, {3, 4, 17.75}));
    io::write_mesh(here / "sheet.ply", plane(9, 2));
    io::write_whole_file(here / "down.txt", "# B in A\n1 0 0 0\n0 1 0 0\n0 0 1 -3.75\n0 0 0 1\n");
  }
  Ran run(const std::string& arguments) const { return run_condyle(here.path(), arguments); }
  Json json(const std::string& arguments) const { return Json::parse(run(arguments + " --json").out); }

  TemporaryFolder here;
};

TEST_F(TouchCommand, SaysHowDeepAndHowFarOut) {
  const Json apart = json("touch a.ply b.ply");
  EXPECT_EQ(apart["in_contact"], false);
  EXPECT_NEAR(apart["nearest_distance_mm"].get<double>(), 2.5, 1e-12);
  EXPECT_TRUE(apart["deepest"].is_null() && apart["free"].empty());

  const Json deep = json("touch a.ply b.ply --matrix down.txt --measures");
  EXPECT_NEAR(deep["deepest"]["depth_mm"].get<double>(), 1.25, 1e-12);
  EXPECT_NEAR(deep["volume_mm3"].get<double>(), 45, 1e-9);
  EXPECT_NEAR(deep["free"][4]["distance_mm"].get<double>(), 1.25, 1e-12);
  EXPECT_EQ(deep["X_FM"][11], -3.75);
  EXPECT_EQ(deep["provenance"]["meshes"][1]["path"], "b.ply");
  for (const Json& note : deep["notes"]) EXPECT_EQ(note["code"], "unlikely_size");

  const Ran text = run("touch a.ply b.ply --matrix down.txt --along 0 0 1 --out deep");
  EXPECT_EQ(text.exit_code, 0) << text.err;
  EXPECT_NE(text.out.find("a.ply and b.ply: in contact"), std::string::npos) << text.out;
  EXPECT_NE(text.out.find("depth: 1.25 mm to the nearest surface, at "), std::string::npos) << text.out;
  EXPECT_NE(text.out.find("free once b.ply has moved 1.25 mm along (0, 0, 1)"), std::string::npos)
      << text.out;
  // Each file says where it comes from.
  ASSERT_EQ(run("touch a.ply b.ply --matrix down.txt --out origin --ascii --picture origin.png").exit_code,
            0);
  for (const char* said : {"b.ply", "--matrix", "sha256"}) {
    for (const char* name : {"origin/touch.json", "origin.png"})
      EXPECT_NE(io::read_whole_file(here / name).find(said), std::string::npos) << name << ": " << said;
    // VTK writes texts as the codes of their letters.
    std::string codes;
    for (const char* letter = said; *letter; ++letter) codes += " " + std::to_string(int{*letter});
    for (const char* name : {"origin/fixed.vtp", "origin/mobile.vtp", "origin/place.vtp"}) {
      std::string written = io::read_whole_file(here / name);
      std::replace(written.begin(), written.end(), '\n', ' ');
      EXPECT_NE(written.find(codes), std::string::npos) << name << ": " << said;
    }
  }
  for (const char* name : {"deep/touch.json", "deep/fixed.vtp", "deep/mobile.vtp", "deep/place.vtp"})
    EXPECT_TRUE(fs::exists(here / name)) << name;
  const TriMesh placed = io::read_mesh(here / "deep/mobile.vtp").mesh;
  EXPECT_EQ(placed.vertices, box({-3, -2, 8.75}, {3, 4, 14}).vertices);

  // In metres a thousand times as far, and no note that 35 mm could be metres.
  EXPECT_NEAR(json("touch a.ply b.ply --units m")["nearest_distance_mm"].get<double>(), 2500, 1e-9);
}

TEST_F(TouchCommand, SaysWhatHasNoInside) {
  const Ran open = run("touch a.ply sheet.ply");
  EXPECT_EQ(open.exit_code, 0);
  EXPECT_NE(open.err.find("condyle: note: open_mesh: the mobile body is open"), std::string::npos)
      << open.err;
  EXPECT_NE(open.out.find("in contact"), std::string::npos);
}

TEST_F(TouchCommand, NamesATwoSidedMesh) {
  const TriMesh ball = sphere({0, 0, 0}, 20, 2);
  io::write_mesh(here / "two.ply", joined(ball, flipped(ball)));
  io::write_mesh(here / "small.ply", sphere({0, 0, 0}, 11, 2));
  const Ran two = run("touch two.ply small.ply");
  EXPECT_NE(two.err.find("condyle: note: two_sided: the fixed body: every triangle is there twice"),
            std::string::npos)
      << two.err;
  EXPECT_NE(two.out.find("apart"), std::string::npos);
  EXPECT_EQ(run("touch two.ply small.ply --strict").exit_code, 4);
  EXPECT_EQ(run("slide two.ply small.ply --along 1 0 0 --strict").exit_code, 4);
  io::write_mesh(here / "out.ply", flipped(ball));
  EXPECT_EQ(json("touch out.ply small.ply --repair flip_inverted --strict")["inside"], "mobile");
  EXPECT_NE(run("inspect two.ply").out.find("two-sided: every triangle is there twice"), std::string::npos);
}

TEST_F(TouchCommand, SaysWhatItsVolumeCountsTwice) {
  io::write_mesh(here / "twice.ply",
                 joined(box({-10, -10, -10}, {10, 10, 10}), box({5, -5, -5}, {11, 5, 5})));
  // Beside where the body crosses itself, and then with 6 x 6 x 5.25 of b in its first box and 5 x 6 x 5.25 in its second too.
  const Ran beside = run("touch twice.ply b.ply --matrix down.txt --measures");
  EXPECT_EQ(beside.out.find("more than once"), std::string::npos) << beside.out;
  const Ran within = run("touch twice.ply b.ply --pose \"1 0 0 7 0 1 0 0 0 0 1 -14 0 0 0 1\" --measures");
  EXPECT_NE(within.out.find("penetration volume: 346.5 mm3"), std::string::npos) << within.out;
  EXPECT_NE(within.out.find("of it 157.5 mm3 are counted again: twice.ply"), std::string::npos) << within.out;
}

TEST_F(TouchCommand, TurnsAndSlides) {
  const Json slide = json("slide a.ply b.ply --along 0 0 -2");
  EXPECT_EQ(slide["along"], Json({0, 0, -1}));
  EXPECT_NEAR(slide["positive"]["moved_mm"].get<double>(), 2.5, 1e-12);
  EXPECT_TRUE(slide["negative"]["moved_mm"].is_null() && slide["free"][0]["low_mm"].is_null());
  EXPECT_NEAR(slide["free"][1]["low_mm"].get<double>(), 27.75, 1e-12);
  const Json turn = json("turn a.ply b.ply --axis 0 0 1 --centre 1 2 3");
  EXPECT_EQ(turn["free_at_start"], true);
  EXPECT_EQ(turn["positive"]["reason"], "end_of_range");
  EXPECT_EQ(turn["free"][0]["low_deg"], -180);
  const Ran text = run("slide a.ply b.ply --along 0 0 -1");
  EXPECT_NE(text.out.find("first contact on: 2.5 mm, at"), std::string::npos) << text.out;
  EXPECT_NE(text.out.find("free: any to 2.5, 27.75 to any mm"), std::string::npos) << text.out;
}

TEST_F(TouchCommand, RefusesInOneLine) {
  io::write_whole_file(here / "mirror.txt", "-1 0 0 0 0 1 0 0 0 0 1 0 0 0 0 1");
  io::write_whole_file(here / "nan.txt", "nan 0 0 0 0 1 0 0 0 0 1 0 0 0 0 1");
  io::write_whole_file(here / "none.obj", "v 0 0 0\n");
  const auto refused = [&](const std::string& arguments, int code, std::string_view saying) {
    expect_refusal(run(arguments), code, saying, arguments);
  };
  refused("touch a.ply b.ply --matrix mirror.txt", 3, "mirror.txt: pose: the matrix mirrors");
  refused("touch a.ply b.ply --matrix nan.txt", 3, "nan.txt: pose");
  refused("touch a.ply b.ply --pose \"2 0 0 0 0 2 0 0 0 0 2 0 0 0 0 1\"", 2, "not orthonormal");
  refused("touch a.ply b.ply --pose flexion=90", 2, "pose: a matrix begins with a number");
  refused("touch a.ply b.ply --along 1 0", 2, "--along");
  refused("touch a.ply b.ply --along 0 0 0", 2, "direction");
  refused("turn a.ply b.ply --axis 0 0 0", 2, "direction");
  refused("slide a.ply b.ply", 2, "--along");
  refused("touch a.ply missing.ply", 3, "missing.ply");
  refused("touch a.ply none.obj", 3, "none.obj");
  refused("touch a.ply", 2, "B");
  io::write_whole_file(here / "needle.obj", "v 0 0 0\nv 1 0 0\nv 2 0 0\nf 1 2 3\n");
  for (const char* needle : {"touch a.ply needle.obj", "turn needle.obj a.ply --axis 0 0 1",
                             "slide a.ply needle.obj --along 1 0 0"})
    refused(needle, 4, "needle.obj: the mesh has no triangle with an area");
}

}  // namespace
}  // namespace condyle::test
