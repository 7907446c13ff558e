#include "figures.hpp"

#include <fcntl.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <csignal>
#include <cstdlib>
#include <filesystem>
#include <string>
#include <system_error>
#include <thread>

#include "interrupt.hpp"
#include "io/file/environment.hpp"

extern char** environ;

namespace condyle::cli {
namespace {

namespace fs = std::filesystem;

enum class Errors { shown, hidden };

/// The exit code of a program, whose standard output is its standard error; -1 if it did not run or did not end by itself.
int run(std::vector<std::string> words, Errors errors) {
  std::vector<char*> arguments;
  for (std::string& word : words) arguments.push_back(word.data());
  arguments.push_back(nullptr);
  posix_spawn_file_actions_t actions;
  if (posix_spawn_file_actions_init(&actions) != 0) return -1;
  if (errors == Errors::hidden)
    posix_spawn_file_actions_addopen(&actions, STDERR_FILENO, "/dev/null", O_WRONLY, 0);
  posix_spawn_file_actions_adddup2(&actions, STDERR_FILENO, STDOUT_FILENO);  // names of files are no answer
  pid_t child = 0;
  const int failed = posix_spawnp(&child, arguments[0], &actions, nullptr, arguments.data(), environ);
  posix_spawn_file_actions_destroy(&actions);
  if (failed != 0) return -1;
  // A signal to this process alone is for the program too.
  const InterruptWatch watch;
  int status = 0;
  pid_t ended = 0;
  while ((ended = waitpid(child, &status, WNOHANG)) == 0) {
    if (watch.interrupted()) kill(child, SIGTERM);
    std::this_thread::sleep_for(std::chrono::milliseconds(20));
  }
  if (watch.interrupted()) throw Interrupted("interrupted while figures were drawn; all else is written");
  return ended == child && WIFEXITED(status) ? WEXITSTATUS(status) : -1;
}

/// A command that was built and not installed has its module beside it.
void look_beside_command() {
  std::error_code failed;
  const fs::path module = fs::read_symlink("/proc/self/exe", failed).parent_path() / "python";
  if (failed || !fs::exists(module / "condyle", failed)) return;
  const std::string before = io::environment_variable("PYTHONPATH").value_or("");
  const std::string path = module.string() + (before.empty() ? "" : ":" + before);
  setenv("PYTHONPATH", path.c_str(), 1);
}

}  // namespace

std::string draw_figures(const std::vector<std::string>& words) {
  look_beside_command();
  setenv("PYTHONSAFEPATH", "1", 1);  // no modules of the working folder
  setenv("CONDYLE_STARTED_BY", std::to_string(getpid()).c_str(), 1);
  for (const char* python : {"python3", "/usr/bin/python3"}) {
    if (run({python, "-c", "import condyle.plot"}, Errors::hidden) != 0) continue;
    std::vector<std::string> all{python, "-m", "condyle.plot"};
    all.insert(all.end(), words.begin(), words.end());
    return run(std::move(all), Errors::shown) == 0 ? "" : "python3 -m condyle.plot ended with an error";
  }
  return "no python3 has condyle.plot, which needs matplotlib";
}

}  // namespace condyle::cli
