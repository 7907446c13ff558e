#include "figures.hpp"

#include "interrupt.hpp"

/// As cli/figures.cpp, by node's child_process: words with a 0 after each. Gives the exit code of the program; -1 if it did not run.
extern "C" int condyle_run(const char* words, std::size_t bytes, int shows_errors);

namespace condyle::cli {
namespace {

int run(const std::vector<std::string>& words, bool shows_errors) {
  std::string all;
  for (const std::string& word : words) all += word + '\0';
  const InterruptWatch watch;
  const int code = condyle_run(all.data(), all.size(), shows_errors);
  if (watch.interrupted()) throw Interrupted("interrupted while figures were drawn; all else is written");
  return code;
}

}  // namespace

std::string draw_figures(const std::vector<std::string>& words) {
  for (const char* python : {"python3", "/usr/bin/python3"}) {
    if (run({python, "-c", "import condyle.plot"}, false) != 0) continue;
    std::vector<std::string> all{python, "-m", "condyle.plot"};
    all.insert(all.end(), words.begin(), words.end());
    return run(all, true) == 0 ? "" : "python3 -m condyle.plot ended with an error";
  }
  return "no python3 has condyle.plot, which needs matplotlib";
}

}  // namespace condyle::cli
