#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <string>

#include "command.hpp"
#include "condyle/io/mesh_file.hpp"
#include "io/file/whole_file.hpp"
#include "support/temporary_folder.hpp"
#include "support/test_meshes.hpp"

namespace condyle::test {
namespace {

namespace fs = std::filesystem;

class PictureCommand : public ::testing::Test {
 protected:
  void SetUp() override { sample_into(folder.path(), "hip"); }
  Ran run(const std::string& arguments) const { return run_condyle(folder.path(), arguments); }
  void expect_refused(int exit_code, const std::string& arguments, std::string_view saying) const {
    expect_refusal(run(arguments), exit_code, saying, arguments);
    EXPECT_EQ(std::distance(fs::directory_iterator(folder.path()), {}), 3) << arguments;
  }
  std::string bytes(const char* name) const { return io::read_whole_file(folder / name); }

  const TemporaryFolder folder;
};

/// Big-endian, as PNG has it.
std::size_t word_at(const std::string& bytes, std::size_t at) {
  std::size_t word = 0;
  for (std::size_t i = 0; i < 4; ++i) word = word << 8 | static_cast<unsigned char>(bytes[at + i]);
  return word;
}

TEST_F(PictureCommand, WritesAPngOfTheSizeAskedFor) {
  const Ran ran =
      run("picture hip.toml --pose 'flexion=110 adduction=15 internal_rotation=35' --view anterior-superior "
          "--hide fixed "
          "--size 320x200 --out pictures/deep.png");
  ASSERT_EQ(ran.exit_code, 0) << ran.err;
  EXPECT_EQ(ran.out, "");
  EXPECT_EQ(ran.err, "condyle: note: wrote pictures/deep.png\n");
  const std::string png = bytes("pictures/deep.png");
  ASSERT_EQ(png.substr(0, 8), "\x89PNG\r\n\x1a\n");
  EXPECT_EQ(word_at(png, 16), 320u);
  EXPECT_EQ(word_at(png, 20), 200u);
  EXPECT_NE(png.find("--view anterior-superior"), png.npos);
}

TEST_F(PictureCommand, EveryOptionChangesThePicture) {
  const std::string base = "picture hip.toml --pose flexion=110 --size 200x150 --out ";
  ASSERT_EQ(run(base + "base.png").exit_code, 0);
  for (const char* option :
       {"--view posterior", "--colour gap", "--colour nearest", "--colour none", "--range 50", "--field 60",
        "--field all", "--hide mobile", "--transparent fixed", "--measures"}) {
    ASSERT_EQ(run(base + "other.png " + option).exit_code, 0) << option;
    // The texts in it name the command line, so it is what follows them that is compared.
    const auto pixels = [](const std::string& png) { return png.substr(png.find("IDAT")); };
    EXPECT_NE(pixels(bytes("base.png")), pixels(bytes("other.png"))) << option;
  }
}

TEST_F(PictureCommand, SaysWhichMeasuresItCannotDraw) {
  std::string text = io::read_whole_file(folder / "hip.toml");
  text.replace(text.find("femur.ply"), 9, "box.ply");
  std::ofstream(folder / "box.toml") << text;
  io::write_mesh(folder / "box.ply", box({-8, -30, -8}, {8, -10, 8}));
  const Ran ran = run("picture box.toml --measures --colour none --size 200x150 --out p.png");
  EXPECT_EQ(ran.exit_code, 0);
  EXPECT_NE(ran.err.find("note: no axis of a neck is drawn: no spherical head"), ran.err.npos) << ran.err;
  EXPECT_NE(ran.err.find("note: no plane of a rim is drawn: no spherical head"), ran.err.npos) << ran.err;
  EXPECT_EQ(run("picture hip.toml --measures --size 200x150 --out p.png").err,
            "condyle: note: wrote p.png\n");
}

TEST_F(PictureCommand, IsTheSameBytesOnOneThreadAndOnTwo) {
  for (const char* threads : {"1", "2"})
    ASSERT_EQ(run(std::string("picture hip.toml --pose flexion=110 --size 300x200 --threads ") + threads +
                  " --out p" + threads + ".png")
                  .exit_code,
              0);
  EXPECT_EQ(bytes("p1.png"), bytes("p2.png"));
}

TEST_F(PictureCommand, RefusesInOneLineAndWritesNothing) {
  expect_refused(2, "picture hip.toml", "--out is required");
  expect_refused(2, "picture hip.toml --out p.jpg", "p.jpg: a picture is written, FILE.png");
  expect_refused(2, "picture hip.toml --out p.png --view above", "view 'above'");
  expect_refused(2, "picture hip.toml --out p.png --colour red", "--colour");
  expect_refused(2, "picture hip.toml --out p.png --hide both", "--hide");
  expect_refused(2, "picture hip.toml --out p.png --size 1200", "--size");
  expect_refused(2, "picture hip.toml --out p.png --size 10x10", "64 to 8192");
  expect_refused(2, "picture hip.toml --out p.png --size 100x-100", "--size");
  expect_refused(2, "picture hip.toml --out p.png --range 0", "not above 0");
  expect_refused(2, "picture hip.toml --out p.png --field nan", "not 0.1 to 100000");
  expect_refused(2, "picture hip.toml --out p.png --field some", "--field: 'some' is neither mm nor all");
  expect_refused(2, "picture hip.toml --out p.png --pose tilt=3", "tilt");
  expect_refused(3, "picture none.toml --out p.png", "none.toml");
  expect_refused(3, "picture hip.toml --out hip.toml/p.png", "cannot be written");
  fs::create_directory(folder / "p.png");
  const Ran ran = run("picture hip.toml --out p.png");
  EXPECT_EQ(ran.exit_code, 3);
  EXPECT_NE(ran.err.find("is a folder"), ran.err.npos) << ran.err;
}

}  // namespace
}  // namespace condyle::test
