#include <fmt/format.h>
#include <sys/wait.h>

#include <csignal>

#include "io/file/whole_file.hpp"
#include "support/test.hpp"

/// A signal that comes while the libraries start, before main() (preload/early_signal.cpp).

namespace condyle::test {
namespace {

TEST(EarlySignal, EndsACommandWithItsLineAndExitCode) {
#ifndef CONDYLE_EARLY_SIGNAL
  GTEST_SKIP() << "a sanitizer comes first";
#else
  const TemporaryFolder folder;
  const auto status_of = [&](int signal, const std::string& before) {
    return std::system(fmt::format("{} CONDYLE_SIGNAL={} LD_PRELOAD='{}' '" CONDYLE_COMMAND
                                   "' --version >'{}' 2>'{}'",
                                   before, signal, CONDYLE_EARLY_SIGNAL, (folder / "out").string(),
                                   (folder / "err").string())
                           .c_str());
  };
  for (const int signal : {SIGINT, SIGTERM, SIGHUP}) {
    const int status = status_of(signal, "");
    EXPECT_TRUE(WIFEXITED(status) && WEXITSTATUS(status) == 130) << signal << ": " << status;
    EXPECT_EQ(io::read_whole_file(folder / "out"), "");
    EXPECT_EQ(io::read_whole_file(folder / "err"), "condyle: interrupted; nothing more is written\n");
  }
  const int ignored = status_of(SIGHUP, "trap '' HUP;");
  EXPECT_TRUE(WIFEXITED(ignored) && WEXITSTATUS(ignored) == 0) << ignored;
#endif
}

}  // namespace
}  // namespace condyle::test
