#include "command.hpp"

/// The line of an error begins with the file that is wrong: a script that asks for many joints has nothing else to go by.

namespace condyle::test {
namespace {

class ErrorLines : public ArmAndPost {
 protected:
  void SetUp() override {
    ArmAndPost::SetUp();
    io::write_mesh(here / "open.ply", without_triangle(arm));
    io::write_mesh(here / "met.ply", box({39, -100, -2}, {41, -10, 2}));
    for (const char* mobile : {"arm", "open", "met"}) write_joint(mobile);
  }
  static TriMesh without_triangle(TriMesh mesh) {
    mesh.triangles.pop_back();
    return mesh;
  }
  void write_joint(const std::string& mobile) const {
    write(mobile + ".toml", text_of_joint({.mobile = mobile + ".ply", .name = mobile}));
  }
  void expect_begins(const std::string& arguments, int exit_code, const std::string& beginning) const {
    const Ran ran = run(arguments);
    EXPECT_EQ(ran.exit_code, exit_code) << arguments << "\n" << ran.err;
    const std::string line = without_notes(ran.err);
    EXPECT_TRUE(is_one_error_line(line)) << arguments << "\n" << ran.err;
    EXPECT_TRUE(line.starts_with("condyle: " + beginning)) << arguments << "\n" << line;
  }
};

TEST_F(ErrorLines, OfAMeshThatIsUnfitBeginWithTheJointFile) {
  expect_begins("rom met.toml", 6, "met.toml: mobile and fixed are in contact in the reference pose");
  expect_begins("rom open.toml --motion flexion --allow-depth 1", 4, "open.toml: mobile: is open");
  expect_begins("picture open.toml --out open.png", 4, "open.toml: mobile: an open boundary");
}

TEST_F(ErrorLines, OfACentreOnASurfaceBeginWithTheJointFile) {
  io::write_mesh(folder / "through.ply", box({-1, -10, 0}, {1, 10, 5}));
  write_joint("through");
  for (const char* command : {"depth through.toml", "rom through.toml --allow-depth 1"})
    expect_begins(command, 4, "through.toml: mobile body: the joint centre lies on the surface");
}

TEST_F(ErrorLines, ShowLettersOfEveryScriptAsTheyAre) {
  write_joint("fémur_大腿骨");
  const std::string name = "fémur_大腿骨.toml";
  expect_begins("rom " + name, 3, name + ": mobile.mesh: there is no file ");
  EXPECT_TRUE(says(run("rom " + name).err, "fémur_大腿骨.ply"));
  write("schräg.obj", "v 0 0 müde\n");
  expect_begins("inspect schräg.obj", 3, "schräg.obj: line 1: 'müde' should be a coordinate");
  write("latin.obj",
        "v 0 0 m\xFC"
        "de\n");
  expect_begins("inspect latin.obj", 3, "latin.obj: line 1: 'm?de' should be a coordinate");
}

/// Whatever is quoted: a name of a file, of a motion, of a part, of a column, a word on the command line.
TEST_F(ErrorLines, HaveABoundWhateverTheyQuote) {
  const std::string name(60'000, 'x'), umlauts = [] {
    std::string text;
    for (int i = 0; i < 30'000; ++i) text += "\xc3\xbc";
    return text;
  }();
  for (const std::string& word : {name, umlauts, "a" + umlauts})
    for (const std::string& arguments : std::vector<std::string>{
             "rom " + word + ".toml", "rom arm.toml --motion " + word, "rom arm.toml --" + word, word,
             "depth arm.toml --pose " + word + "=1", "depth arm.toml --set " + word + "=1",
             "rom arm.toml --out " + word, "rom arm.toml --bearing " + word, "merge " + word}) {
      const Ran ran = run(arguments);
      EXPECT_NE(ran.exit_code, 0) << arguments.substr(0, 40);
      const std::string line = without_notes(ran.err);
      EXPECT_TRUE(is_one_error_line(line)) << line;
      EXPECT_LE(line.size(), 2'020u) << line;
      EXPECT_FALSE(says(line, "??"));
    }
}

TEST_F(ErrorLines, OfImagesThatAreNotReadNameWhatConvertsThem) {
  write("aseg.mgz", "x");
  write("IM000001", std::string(128, '\0') + "DICM and more");
  for (const char* command : {"inspect aseg.mgz", "surface aseg.mgz --label 4 --out a.ply",
                              "init aseg.mgz --fixed 1 --mobile 2 -o a.toml"})
    expect_begins(command, 3, "aseg.mgz: FreeSurfer's images are not read: its mri_convert makes .nii.gz");
  for (const char* command :
       {"inspect IM000001", "surface IM000001 --label 4 --out a.ply", "init IM000001 arm.ply"})
    expect_begins(command, 3, "IM000001: DICOM is not read: open it in 3D Slicer");
}

TEST_F(ErrorLines, OfTwistedPolygonsSayHowTheyAreRead) {
  // A comb whose corners are above and below their plane by turns.
  const std::string comb =
      "v 0 0 -1\nv 9 0 1\nv 9 9 -1\nv 6 9 1\nv 6 3 -1\nv 3 3 1\nv 3 9 -1\nv 0 9 1\nf 1 2 3 4 5 6 7 8\n";
  write("comb.obj", comb);
  expect_begins("inspect comb.obj --polygons split", 3, "comb.obj: face 0 of 8 corners is twisted");
  const Ran ran = run("inspect comb.obj --polygons guess");
  EXPECT_EQ(ran.exit_code, 0) << ran.err;
  EXPECT_TRUE(
      says(ran.out,
           "split 1 polygon into triangles, 1 of them by a guess: their corners are up to 1 off one plane"));
}

TEST_F(ErrorLines, OfPolygonsAreAvoidedByTheirRuleInAJointFileToo) {
  write("quads.obj",
        "v 40 -120 -50\nv 60 -120 -50\nv 60 -80 -50\nv 40 -80 -50\nv 40 -120 50\nv 60 -120 50\nv 60 -80 "
        "50\nv 40 -80 50\n"
        "f 4 3 2 1\nf 5 6 7 8\nf 1 2 6 5\nf 2 3 7 6\nf 3 4 8 7\nf 4 1 5 8\n");
  expect_begins("init quads.obj arm.ply", 3, "quads.obj: line 9: face 0 has 4 corners");
  const Ran proposed = run("init quads.obj arm.ply --polygons split");
  EXPECT_EQ(proposed.exit_code, 0) << proposed.err;
  EXPECT_TRUE(says(proposed.out, "mesh = 'quads.obj'\npolygons = \"split\"\n"));
  const auto joint = [&](const std::string& rule) {
    write("quads.toml", text_of_joint({.fixed = "mesh = \"quads.obj\"\npolygons = \"" + rule + "\""}));
    return done("rom quads.toml --motion flexion").out;
  };
  EXPECT_EQ(joint("guess"), joint("split")) << "of flat polygons";
  write("mark.toml", "\xEF\xBB\xBF" + text_of_joint({}));
  EXPECT_EQ(run("frame mark.toml").exit_code, 0) << "a byte order mark";
}

TEST_F(ErrorLines, OfAStudyBeginWithTheJointFileOrTheLine) {
  write("met.csv", "id,joint\na,met.toml\n");
  expect_begins("study met.csv --out out --strict", 6, "met.toml: mobile and fixed are in contact");
  expect_begins("study met.csv --out out", 6,
                "met.csv: none of 1 joints was answered; the first one: met.toml: mobile and fixed are");
  write("gone.csv", "id,joint\na,arm.toml\nb,gone.toml\n");
  expect_begins("study gone.csv --out out --strict", 3,
                "gone.csv: line 3: column 'joint': gone.toml: no such file");
  write("meshes.csv", "id,fixed,mobile,side\na,post.ply,gone.ply,right\n");
  expect_begins("study meshes.csv --out out --strict", 3,
                "meshes.csv: line 2: column 'mobile': gone.ply: no such file");
}

TEST_F(ErrorLines, OfAnOutputThatCannotBeBeginWithItsName) {
  fs::create_symlink("circle", folder / "circle");
  fs::create_symlink("circle.png", folder / "circle.png");
  const std::string longer(300, 'n');
  expect_begins("report arm.toml --out circle", 3, "circle: cannot be written: Too many levels");
  expect_begins("picture arm.toml --out circle.png", 3, "circle.png: cannot be written: Too many levels");
  expect_begins("picture arm.toml --out " + longer + ".png", 3,
                longer + ".png: cannot be written: File name");
  expect_begins("report --empty --out " + longer, 3, longer + ": cannot be written: File name too long");
  expect_begins("init post.ply arm.ply --out " + longer, 3, longer + ": cannot be written: File name");
}

TEST_F(ErrorLines, OfAnEmptyNameNameItsOption) {
  expect_begins("report --empty --out ''", 2, "report: --out: a name is needed, and this one is empty");
  expect_begins("touch arm.ply post.ply --matrix ''", 2, "touch: --matrix: a name is needed");
  expect_begins("touch arm.ply post.ply --pose ''", 2, "pose: a matrix begins with a number");
  expect_begins("touch '' post.ply", 2, "touch: A: a name is needed");
  expect_begins("sample hip --out ''", 2, "sample hip: --out: a name is needed");
  expect_begins("rom arm.toml --write-limits ''", 2, "rom: --write-limits: a name is needed");
}

}  // namespace
}  // namespace condyle::test
