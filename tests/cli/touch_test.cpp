#include "command.hpp"

/// touch, turn and slide: two meshes without a joint file.

namespace condyle::test {
namespace {

/// A box of 6 x 6 x 5.25, lying 3.75 above where it is 1.25 deep in one of 20 x 20 x 20.
class TouchCommand : public CommandTest {
 protected:
  void SetUp() override {
    io::write_mesh(here / "a.ply", box({-10, -10, -10}, {10, 10, 10}));
    io::write_mesh(here / "b.ply", box({-3, -2, 12.5}, {3, 4, 17.75}));
    io::write_mesh(here / "sheet.ply", plane(9, 2));
    write("down.txt", "# B in A\n1 0 0 0\n0 1 0 0\n0 0 1 -3.75\n0 0 0 1\n");
  }
};

TEST_F(TouchCommand, SaysHowDeepAndHowFarOut) {
  const Json apart = answer("touch a.ply b.ply");
  EXPECT_EQ(apart["in_contact"], false);
  EXPECT_NEAR(apart["nearest_distance_mm"], 2.5, 1e-12);
  EXPECT_TRUE(apart["deepest"].is_null() && apart["free"].empty());

  const Json deep = answer("touch a.ply b.ply --matrix down.txt --measures");
  EXPECT_NEAR(deep["deepest"]["depth_mm"], 1.25, 1e-12);
  EXPECT_NEAR(deep["volume_mm3"], 45, 1e-9);
  EXPECT_NEAR(deep["free"][4]["distance_mm"], 1.25, 1e-12);
  EXPECT_EQ(deep["X_FM"][11], -3.75);
  EXPECT_EQ(deep["provenance"]["meshes"][1]["path"], "b.ply");
  for (const Json& note : deep["notes"]) EXPECT_EQ(note["code"], "unlikely_size");

  const Ran text = done("touch a.ply b.ply --matrix down.txt --along 0 0 1 --out deep");
  EXPECT_TRUE(says(text.out, "a.ply and b.ply: in contact"));
  EXPECT_TRUE(says(text.out, "depth: 1.25 mm to the nearest surface, at "));
  EXPECT_TRUE(says(text.out, "free once b.ply has moved 1.25 mm along (0, 0, 1)"));
  // Each file says where it comes from.
  done("touch a.ply b.ply --matrix down.txt --out origin --ascii --picture origin.png");
  for (const char* said : {"b.ply", "--matrix", "sha256"}) {
    for (const char* name : {"origin/touch.json", "origin.png"})
      EXPECT_TRUE(says(text_of(name), said)) << name << ": " << said;
    // VTK writes texts as the codes of their letters.
    std::string codes;
    for (const char* letter = said; *letter; ++letter) codes += " " + std::to_string(int{*letter});
    for (const char* name : {"origin/fixed.vtp", "origin/mobile.vtp", "origin/place.vtp"}) {
      std::string written = text_of(name);
      std::replace(written.begin(), written.end(), '\n', ' ');
      EXPECT_TRUE(says(written, codes)) << name << ": " << said;
    }
  }
  for (const char* name : {"deep/touch.json", "deep/fixed.vtp", "deep/mobile.vtp", "deep/place.vtp"})
    EXPECT_TRUE(fs::exists(here / name)) << name;
  const TriMesh placed = io::read_mesh(here / "deep/mobile.vtp").mesh;
  EXPECT_EQ(placed.vertices, box({-3, -2, 8.75}, {3, 4, 14}).vertices);

  // In metres a thousand times as far, and no note that 35 mm could be metres.
  EXPECT_NEAR(answer("touch a.ply b.ply --units m")["nearest_distance_mm"].get<double>(), 2500, 1e-9);
}

TEST_F(TouchCommand, SaysWhatHasNoInside) {
  const Ran open = done("touch a.ply sheet.ply");
  EXPECT_TRUE(says(open.err, "condyle: note: open_mesh: the mobile body is open"));
  EXPECT_TRUE(says(open.out, "in contact"));
}

TEST_F(TouchCommand, NamesATwoSidedMesh) {
  const TriMesh ball = sphere({0, 0, 0}, 20, 2);
  io::write_mesh(here / "two.ply", joined(ball, flipped(ball)));
  io::write_mesh(here / "small.ply", sphere({0, 0, 0}, 11, 2));
  const Ran two = run("touch two.ply small.ply");
  EXPECT_TRUE(says(two.err, "condyle: note: two_sided: the fixed body: every triangle is there twice"));
  EXPECT_TRUE(says(two.out, "apart"));
  EXPECT_EQ(run("touch two.ply small.ply --strict").exit_code, 4);
  EXPECT_EQ(run("slide two.ply small.ply --along 1 0 0 --strict").exit_code, 4);
  io::write_mesh(here / "out.ply", flipped(ball));
  EXPECT_EQ(answer("touch out.ply small.ply --repair flip_inverted --strict")["inside"], "mobile");
  EXPECT_TRUE(says(run("inspect two.ply").out, "two-sided: every triangle is there twice"));
}

TEST_F(TouchCommand, SaysWhatItsVolumeCountsTwice) {
  io::write_mesh(here / "twice.ply",
                 joined(box({-10, -10, -10}, {10, 10, 10}), box({5, -5, -5}, {11, 5, 5})));
  // Beside where the body crosses itself, and then with 6 x 6 x 5.25 of b in its first box and 5 x 6 x 5.25 in its second too.
  const Ran beside = run("touch twice.ply b.ply --matrix down.txt --measures");
  EXPECT_FALSE(says(beside.out, "more than once"));
  const Ran within = run("touch twice.ply b.ply --pose \"1 0 0 7 0 1 0 0 0 0 1 -14 0 0 0 1\" --measures");
  EXPECT_TRUE(says(within.out, "penetration volume: 346.5 mm3"));
  EXPECT_TRUE(says(within.out, "of it 157.5 mm3 are counted again: twice.ply"));
}

TEST_F(TouchCommand, TurnsAndSlides) {
  const Json slide = answer("slide a.ply b.ply --along 0 0 -2");
  EXPECT_EQ(slide["along"], Json({0, 0, -1}));
  EXPECT_NEAR(slide["positive"]["moved_mm"], 2.5, 1e-12);
  EXPECT_TRUE(slide["negative"]["moved_mm"].is_null() && slide["free"][0]["low_mm"].is_null());
  EXPECT_NEAR(slide["free"][1]["low_mm"], 27.75, 1e-12);
  const Json turn = answer("turn a.ply b.ply --axis 0 0 1 --centre 1 2 3");
  EXPECT_EQ(turn["free_at_start"], true);
  EXPECT_EQ(turn["positive"]["reason"], "end_of_range");
  EXPECT_EQ(turn["free"][0]["low_deg"], -180);
  const Ran text = run("slide a.ply b.ply --along 0 0 -1");
  EXPECT_TRUE(says(text.out, "first contact on: 2.5 mm, at"));
  EXPECT_TRUE(says(text.out, "free: any to 2.5, 27.75 to any mm"));
}

TEST_F(TouchCommand, RefusesInOneLine) {
  write("mirror.txt", "-1 0 0 0 0 1 0 0 0 0 1 0 0 0 0 1");
  write("nan.txt", "nan 0 0 0 0 1 0 0 0 0 1 0 0 0 0 1");
  write("none.obj", "v 0 0 0\n");
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
  write("needle.obj", "v 0 0 0\nv 1 0 0\nv 2 0 0\nf 1 2 3\n");
  for (const char* needle : {"touch a.ply needle.obj", "turn needle.obj a.ply --axis 0 0 1",
                             "slide a.ply needle.obj --along 1 0 0"})
    refused(needle, 4, "needle.obj: the mesh has no triangle with an area");
}

}  // namespace
}  // namespace condyle::test
