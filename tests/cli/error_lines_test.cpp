#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <string>
#include <string_view>

#include "command.hpp"
#include "condyle/io/mesh_file.hpp"
#include "support/temporary_folder.hpp"
#include "support/test_meshes.hpp"

/// The line of an error begins with the file that is wrong: a script that asks for many joints has nothing else to go by.

namespace condyle::test {
namespace {

namespace fs = std::filesystem;

/// A body that hangs from the joint centre, and a post in front of it.
class ErrorLines : public ::testing::Test {
 protected:
  void SetUp() override {
    const TriMesh arm = box({-1, -100, -2}, {1, -10, 2});
    io::write_mesh(folder / "post.ply", box({40, -120, -50}, {60, -80, 50}));
    io::write_mesh(folder / "arm.ply", arm);
    io::write_mesh(folder / "open.ply", without_triangle(arm));
    io::write_mesh(folder / "met.ply", box({39, -100, -2}, {41, -10, 2}));
    for (const char* mobile : {"arm", "open", "met"}) write_joint(mobile);
  }
  static TriMesh without_triangle(TriMesh mesh) {
    mesh.triangles.pop_back();
    return mesh;
  }
  void write(const std::string& name, std::string_view text) const { std::ofstream(folder / name) << text; }
  void write_joint(const std::string& mobile) const {
    write(
        mobile + ".toml",
        "condyle = 1\nname = \"" + mobile +
            "\"\nkind = \"ball\"\nside = \"right\"\nunits = \"mm\"\n[fixed]\nmesh = \"post.ply\"\n[mobile]\n"
            "mesh = \"" +
            mobile + ".ply\"\n[frame]\ncentre = [0, 0, 0]\nanterior = [1, 0, 0]\nsuperior = [0, 1, 0]\n");
  }
  void expect_begins(const std::string& arguments, int exit_code, const std::string& beginning) const {
    const Ran ran = run_condyle(folder.path(), arguments);
    EXPECT_EQ(ran.exit_code, exit_code) << arguments << "\n" << ran.err;
    const std::string line = without_notes(ran.err);
    EXPECT_TRUE(is_one_error_line(line)) << arguments << "\n" << ran.err;
    EXPECT_TRUE(line.starts_with("condyle: " + beginning)) << arguments << "\n" << line;
  }

  const TemporaryFolder folder;
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
  expect_begins("report --empty --out ''", 3, "output file: no name given");
}

}  // namespace
}  // namespace condyle::test
