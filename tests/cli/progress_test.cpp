#include "progress.hpp"
#include "support/test.hpp"

namespace condyle::cli {
namespace {

using namespace std::chrono_literals;

TEST(RemainingSeconds, FollowsThePaceSoFar) {
  EXPECT_EQ(remaining_seconds(10, 25, 100), 30);
  EXPECT_EQ(remaining_seconds(10, 100, 100), 0);
}

TEST(RemainingSeconds, IsUnknownBeforeThereIsAPace) {
  EXPECT_EQ(remaining_seconds(10, 0, 100), std::nullopt);
  EXPECT_EQ(remaining_seconds(0, 5, 100), std::nullopt);
}

TEST(DurationText, IsRoundedUpToTheUnitPeopleWaitIn) {
  EXPECT_EQ(duration_text(0), "0 s");
  EXPECT_EQ(duration_text(0.2), "1 s");
  EXPECT_EQ(duration_text(59), "59 s");
  EXPECT_EQ(duration_text(61), "2 min");
  EXPECT_EQ(duration_text(3600), "1 h 00 min");
  EXPECT_EQ(duration_text(3601), "1 h 01 min");
  EXPECT_EQ(duration_text(7.99 * 3600), "8 h 00 min");
}

/// A clock that is set by hand, and what was shown.
struct Stage {
  Progress::Clock::time_point now{};
  std::vector<std::string> shown;

  Progress progress(ProgressPlace place) {
    return Progress(
        "points", place, [this] { return now; }, [this](std::string_view text) { shown.emplace_back(text); });
  }
};

TEST(Progress, SaysNothingAboutWorkOfLessThanTwoSeconds) {
  for (const ProgressPlace place : {ProgressPlace::terminal, ProgressPlace::log}) {
    Stage stage;
    {
      Progress progress = stage.progress(place);
      for (std::size_t i = 1; i < 100; ++i) stage.now += 20ms, progress.update(i, 100);
    }
    EXPECT_TRUE(stage.shown.empty());
  }
}

TEST(Progress, OfAllTheWorkIsAShare) {
  Stage stage;
  Progress progress = stage.progress(ProgressPlace::log);
  stage.now += 10s, progress.update(0.25);
  EXPECT_EQ(stage.shown, std::vector<std::string>{"points: 25 %, about 30 s left\n"});
}

TEST(Progress, GivesALogALineEveryTenSeconds) {
  Stage stage;
  {
    Progress progress = stage.progress(ProgressPlace::log);
    for (std::size_t i = 1; i <= 250; ++i) stage.now += 100ms, progress.update(i, 250);
  }
  ASSERT_EQ(stage.shown.size(), 3u);
  EXPECT_EQ(stage.shown[0], "points: 20 of 250 (8 %), about 23 s left\n");
  EXPECT_EQ(stage.shown[1], "points: 120 of 250 (48 %), about 13 s left\n");
  EXPECT_EQ(stage.shown[2], "points: 220 of 250 (88 %), about 3 s left\n");
}

TEST(Progress, WritesOverOneLineOfATerminalAndWipesItAtTheEnd) {
  Stage stage;
  {
    Progress progress = stage.progress(ProgressPlace::terminal);
    for (std::size_t i = 1; i <= 300; ++i) stage.now += 10ms, progress.update(i, 300);
  }
  // From 2 s on every 0.2 s, not at 3 s when all is done: 2.0, 2.2, ... 2.8, and the wiping.
  ASSERT_EQ(stage.shown.size(), 6u);
  EXPECT_EQ(stage.shown[0], "\r\x1b[Kpoints: 200 of 300 (66 %), about 1 s left");
  EXPECT_EQ(stage.shown.back(), "\r\x1b[K");
  for (const std::string& text : stage.shown) EXPECT_EQ(text.find('\n'), text.npos);
}

}  // namespace
}  // namespace condyle::cli
