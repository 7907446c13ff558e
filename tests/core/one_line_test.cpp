#include "core/one_line.hpp"
#include "support/test.hpp"

namespace condyle::core {
namespace {

TEST(OneLine, KeepsLettersOfAnyScript) {
  for (const char* text : {"fémur_droit.ply", "大腿骨.stl", "бедро", "f\xF0\x9F\xA6\xB4.ply", "plain"})
    EXPECT_EQ(one_line(text), text);
}

TEST(OneLine, ReplacesWhatATerminalObeysAndWhatIsNotUtf8) {
  EXPECT_EQ(one_line("a\nb\tc\x1b[2J\x7f"), "a?b?c?[2J?");
  EXPECT_EQ(one_line("\xC2\x9B"), "?") << "C1";
  EXPECT_EQ(one_line("a\xE2\x80\xAE"
                     "b"),
            "a?b")
      << "turns the direction of writing";
  EXPECT_EQ(one_line("\xE2\x80\xA8"), "?") << "begins a line";
  EXPECT_EQ(one_line("f\xE9mur"), "f?mur") << "Latin-1";
  EXPECT_EQ(one_line("\xC3"), "?") << "cut off";
  EXPECT_EQ(one_line("\xC0\xAF"), "??") << "a longer form than needed";
  EXPECT_EQ(one_line("\xED\xA0\x80"), "???") << "a surrogate";
  EXPECT_EQ(one_line(std::string("a\0b", 3)), "a?b");
}

TEST(OneLine, CountsCharactersAndCutsNone) {
  EXPECT_EQ(one_line("ééé", 3), "ééé");
  EXPECT_EQ(one_line("éééé", 3), "ééé...");
  EXPECT_EQ(one_line("", 0), "");
  EXPECT_EQ(one_line("a", 0), "...");
}

}  // namespace
}  // namespace condyle::core
