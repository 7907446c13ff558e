#include "command.hpp"

namespace condyle::test {
namespace {

class PictureCommand : public CommandTest {
 protected:
  void SetUp() override { sample_into(here, "hip"); }
  void expect_refused(int exit_code, const std::string& arguments, std::string_view saying) const {
    CommandTest::expect_refused(exit_code, arguments, saying);
    EXPECT_EQ(count_entries(here), 3u) << arguments;
  }
};

/// Big-endian, as PNG has it.
std::size_t word_at(const std::string& bytes, std::size_t at) {
  std::size_t word = 0;
  for (std::size_t i = 0; i < 4; ++i) word = word << 8 | static_cast<unsigned char>(bytes[at + i]);
  return word;
}

TEST_F(PictureCommand, WritesAPngOfTheSizeAskedFor) {
  const Ran ran = done(
      "picture hip.toml --pose 'flexion=110 adduction=15 internal_rotation=35' --view anterior-superior "
      "--hide fixed "
      "--size 320x200 --out pictures/deep.png");
  EXPECT_EQ(ran.out, "flexion 110, adduction 15, internal rotation 35 deg, in contact: impinging\n");
  EXPECT_EQ(ran.err, "condyle: note: wrote pictures/deep.png\n");
  const std::string png = text_of("pictures/deep.png");
  ASSERT_EQ(png.substr(0, 8), "\x89PNG\r\n\x1a\n");
  EXPECT_EQ(word_at(png, 16), 320u);
  EXPECT_EQ(word_at(png, 20), 200u);
  EXPECT_TRUE(says(png, "--view anterior-superior"));
}

TEST_F(PictureCommand, EveryOptionChangesThePicture) {
  const std::string base = "picture hip.toml --pose flexion=110 --size 200x150 --out ";
  done(base + "base.png");
  for (const char* option :
       {"--view posterior", "--colour gap", "--colour nearest", "--colour none", "--range 50", "--field 60",
        "--field all", "--hide mobile", "--transparent fixed", "--measures"}) {
    done(base + "other.png " + option);
    // The texts in it name the command line, so it is what follows them that is compared.
    const auto pixels = [](const std::string& png) { return png.substr(png.find("IDAT")); };
    EXPECT_NE(pixels(text_of("base.png")), pixels(text_of("other.png"))) << option;
  }
}

TEST_F(PictureCommand, SaysWhichMeasuresItCannotDraw) {
  write_edited("box.toml", "hip.toml", "femur.ply", "box.ply");
  io::write_mesh(folder / "box.ply", box({-8, -30, -8}, {8, -10, 8}));
  const Ran ran = done("picture box.toml --measures --colour none --size 200x150 --out p.png");
  EXPECT_TRUE(says(ran.err, "note: no axis of a neck is drawn: no spherical head"));
  EXPECT_TRUE(says(ran.err, "note: no plane of a rim is drawn: no spherical head"));
  EXPECT_EQ(run("picture hip.toml --measures --size 200x150 --out p.png").err,
            "condyle: note: wrote p.png\n");
}

TEST_F(PictureCommand, IsTheSameBytesOnOneThreadAndOnTwo) {
  for (const char* threads : {"1", "2"})
    done(std::string("picture hip.toml --pose flexion=110 --size 300x200 --threads ") + threads + " --out p" +
         threads + ".png");
  EXPECT_EQ(text_of("p1.png"), text_of("p2.png"));
}

TEST_F(PictureCommand, RefusesInOneLineAndWritesNothing) {
  expect_refused(2, "picture hip.toml", "--out is required");
  expect_refused(2, "picture hip.toml --out p.jpg", "p.jpg: a picture is written, FILE.png");
  for (const auto& [option, saying] : {std::pair("--view above", "view 'above'"),
                                       {"--colour red", "--colour"},
                                       {"--hide both", "--hide"},
                                       {"--size 1200", "--size"},
                                       {"--size 10x10", "64 to 8192"},
                                       {"--size 100x-100", "--size"},
                                       {"--range 0", "not above 0"},
                                       {"--field nan", "not 0.1 to 100000"},
                                       {"--field some", "--field: 'some' is neither mm nor all"},
                                       {"--pose tilt=3", "tilt"}})
    expect_refused(2, std::string("picture hip.toml --out p.png ") + option, saying);
  expect_refused(3, "picture none.toml --out p.png", "none.toml");
  expect_refused(3, "picture hip.toml --out hip.toml/p.png", "cannot be written");
  fs::create_directory(here / "p.png");
  CommandTest::expect_refused(3, "picture hip.toml --out p.png", "is a folder");
}

}  // namespace
}  // namespace condyle::test
