#include "with_progress.hpp"

#include <csignal>

#include "interrupt.hpp"
#include "support/test.hpp"

namespace condyle::cli {
namespace {

/// Work that ends before it sees that it is to stop.
std::optional<int> signalled(const Control& control) {
  control.progress("steps", 1, 2);
  std::raise(SIGINT);
  return 7;
}

TEST(WithProgress, ASignalLeavesNoAnswerOfWorkThatEndsBeforeItSeesIt) {
  try {
    with_progress(signalled);
    FAIL() << "was answered";
  } catch (const Interrupted& interrupted) {
    EXPECT_STREQ(interrupted.what(), "interrupted after 1 of 2 steps; nothing is written");
  }
}

TEST(WithProgress, ASignalComesTooLateForFilesThatAreThere) {
  EXPECT_EQ(with_progress(signalled, Writes::files), 7);
}

TEST(WithProgress, WorkThatWasStoppedHasNoAnswer) {
  const auto stopped = [](const Control&) { return std::optional<int>(); };
  EXPECT_THROW(with_progress(stopped), Interrupted);
}

}  // namespace
}  // namespace condyle::cli
