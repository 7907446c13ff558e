#include <fcntl.h>
#include <fmt/format.h>
#include <tbb/global_control.h>
#include <unistd.h>

#include <CLI/App.hpp>
#include <CLI/Config.hpp>
#include <CLI/Formatter.hpp>
#include <algorithm>
#include <cstdio>
#include <memory>
#include <string>
#include <vector>

#include "answer.hpp"
#include "commands.hpp"
#include "condyle/version.hpp"
#include "core/near_name.hpp"
#include "help_formatter.hpp"
#include "interrupt.hpp"
#include "io/file/failure.hpp"

namespace {

namespace cli = condyle::cli;

constexpr const char* exit_codes =
    "Exit codes: 0 answered, 2 wrong usage, 3 bad file, 4 mesh unfit for the question, 5 internal error, "
    "6 bodies in contact in the reference pose, 130 interrupted.";

/// A closed standard stream would give its number to the next file that is opened, and answers would be
/// written into it. Opened for reading, the number is taken and writing still fails.
void hold_standard_streams() {
  for (const int stream : {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO})
    while (::fcntl(stream, F_GETFD) == -1)
      if (::open("/dev/null", O_RDONLY) == -1) return;
}

/// One line on standard error.
int fail(const condyle::io::Failure& failure) {
  std::fprintf(stderr, "condyle: %s\n", failure.message.c_str());
  return failure.exit_code;
}

/// What is wrong with the command line, with the commands there are where none was given.
std::string describe(const CLI::ParseError& error, const CLI::App& app) {
  if (!app.get_subcommands().empty()) {
    const CLI::App& command = *app.get_subcommands().front();
    std::string text = command.get_name() + ": " + error.what();
    const auto unexpected = app.remaining(true);
    if (unexpected.empty()) return text;
    std::vector<std::string> options;
    for (const CLI::Option* option : command.get_options())
      for (const std::string& name : option->get_lnames()) options.push_back("--" + name);
    return text +
           condyle::core::did_you_mean(unexpected.front().substr(0, unexpected.front().find('=')), options);
  }
  std::string commands;
  std::vector<std::string> names;
  for (const CLI::App* command : app.get_subcommands(nullptr)) {
    commands += (commands.empty() ? "" : ", ") + command->get_name();
    names.push_back(command->get_name());
  }
  const auto unknown = app.remaining();
  if (!unknown.empty())
    return fmt::format("unknown command '{}'{}; there are {}", unknown.front(),
                       condyle::core::did_you_mean(unknown.front(), names), commands);
  if (error.get_exit_code() == static_cast<int>(CLI::ExitCodes::RequiredError))
    return fmt::format("a command is needed: {}", commands);
  return error.what();
}

/// The arguments as the parser takes them, the last one first: `help rom` is `rom --help`.
std::vector<std::string> arguments(int argc, char** argv) {
  std::vector<std::string> words(argv + std::min(argc, 1), argv + argc);
  if (!words.empty() && words.front() == "help") {
    words.erase(words.begin());
    words.emplace_back("--help");
  }
  std::reverse(words.begin(), words.end());
  return words;
}

int run(int argc, char** argv) {
  CLI::App app(
      "Condyle computes where the bones of a joint run into each other, how deep, and along which direction.",
      "condyle");
  app.formatter(std::make_shared<cli::HelpFormatter>());
  app.set_version_flag("-V,--version", "condyle " + std::string(condyle::version));
  app.require_subcommand(1);
  app.fallthrough();
  app.footer(std::string("Example: condyle sample hip --out sample\n"
                         "         condyle rom sample/hip.toml --band\n"
                         "         condyle help rom\n") +
             exit_codes);

  std::unique_ptr<tbb::global_control> limit;
  app.add_option_function<int>(
         "--threads",
         [&](int count) {
           limit = std::make_unique<tbb::global_control>(tbb::global_control::max_allowed_parallelism,
                                                         static_cast<std::size_t>(count));
         },
         "Most threads to use; all cores if not given. Results are the same for any number")
      ->check(CLI::Range(1, 4096));

  cli::add_init(app);
  cli::add_inspect(app);
  cli::add_frame(app);
  cli::add_depth(app);
  cli::add_rom(app);
  cli::add_load(app);
  cli::add_motion(app);
  cli::add_picture(app);
  cli::add_report(app);
  cli::add_sample(app);
  cli::add_study(app);
  cli::add_merge(app);

  try {
    app.parse(arguments(argc, argv));
  } catch (const CLI::Success& request) {  // --help or --version
    const bool version = dynamic_cast<const CLI::CallForVersion*>(&request) != nullptr;
    cli::print(version ? app.version() + "\n" : app.help());
  } catch (const CLI::ParseError& error) {
    return fail({condyle::io::bad_usage, condyle::io::one_line(describe(error, app))});
  }
  return condyle::io::answered;
}

}  // namespace

int main(int argc, char** argv) {
  hold_standard_streams();
  cli::say_when_interrupted();
  try {
    return run(argc, argv);
  } catch (const cli::Interrupted& stopped) {
    return fail({condyle::io::interrupted, stopped.what()});
  } catch (...) {
    return fail(condyle::io::failure_of_current_exception());
  }
}
