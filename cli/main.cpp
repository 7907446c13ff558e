#include <fmt/format.h>
#include <fmt/ranges.h>

#include <CLI/App.hpp>
#include <CLI/Config.hpp>
#include <CLI/Formatter.hpp>
#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <limits>
#include <new>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#ifdef __GLIBC__
#include <malloc.h>
#endif

#include "answer.hpp"
#include "commands.hpp"
#include "condyle/version.hpp"
#include "core/near_name.hpp"
#include "core/thread_limit.hpp"
#include "help_formatter.hpp"
#include "interrupt.hpp"
#include "io/file/failure.hpp"
#include "io/file/input_recorder.hpp"
#include "io/file/temporary_folder.hpp"
#include "standard_streams.hpp"
#include "whole_number.hpp"

namespace {

namespace cli = condyle::cli;

constexpr const char* exit_codes =
    "Exit codes: 0 answered, 2 wrong usage, 3 bad file, 4 mesh unfit for the question, 5 internal error, 6 "
    "bodies in contact in the reference pose, 130 interrupted.";

/// One line on standard error.
int fail(const condyle::io::Failure& failure) {
  std::fprintf(stderr, "condyle: %s\n", failure.message.c_str());
  return failure.exit_code;
}

/// Notes come after the refusal, which is often what they explain; after an error of the program nothing does. Where there is
/// no memory for the message either, that is what is said.
int refuse_for_current_exception() noexcept {
  try {
    const condyle::io::Failure failure = condyle::io::failure_of_current_exception();
    fail(failure);
    if (failure.exit_code != condyle::io::internal_error) cli::say_notes();
    return failure.exit_code;
  } catch (...) {
    std::fputs("condyle: out of memory\n", stderr);
    return condyle::io::internal_error;
  }
}

/// What is freed is kept for what is made next: the system clears every page that it hands out, and a command soon ends.
void keep_freed_memory() {
#ifdef __GLIBC__
  constexpr int largest_kept = 32 << 20;  // The C library keeps no larger block.
  mallopt(M_MMAP_THRESHOLD, largest_kept), mallopt(M_TRIM_THRESHOLD, std::numeric_limits<int>::max());
  mallopt(M_TOP_PAD, 1 << 20);
#endif
}

/// Where an exception cannot be handled: some destructors of libraries take memory, and none may fail.
[[noreturn]] void end_without_answer() noexcept {
  std::string_view line = "condyle: internal error: ended\n";
  try {
    if (std::current_exception()) throw;
  } catch (const std::bad_alloc&) {
    line = "condyle: out of memory\n";
  } catch (...) {
  }
  cli::write_to_standard_error(line);
  condyle::io::end_temporary_folders();
  std::_Exit(condyle::io::internal_error);
}

/// HDF5 ends the program itself, without a word, where some of its allocations fail.
bool is_running = true;
void say_that_a_library_ended_it() {
  if (is_running) end_without_answer();
}

/// The commands below one, "hip, cartilages, cohort".
std::vector<std::string> commands_of(const CLI::App& app) {
  std::vector<std::string> names;
  for (const CLI::App* command : app.get_subcommands(nullptr)) names.push_back(command->get_name());
  return names;
}

bool is_number(const std::string& word) {
  return !word.empty() && word.find_first_not_of("0123456789") == word.npos;
}

/// A number after the flag --band, which takes it after an equals sign only: the next word may be a file.
std::optional<std::string> number_after_band(const std::vector<std::string>& words) {
  for (std::size_t i = 0; i + 1 < words.size(); ++i)
    if (words[i] == "--band" && is_number(words[i + 1])) return words[i + 1];
  return std::nullopt;
}

/// "sample hip": as it is typed.
std::string full_name(const CLI::App& command) {
  const CLI::App* above = command.get_parent();
  return above && above->get_parent() ? full_name(*above) + " " + command.get_name() : command.get_name();
}

/// The command that is named, the whole program if none is.
const CLI::App& named_command(const CLI::App& app) {
  const auto below = app.get_subcommands();
  return below.empty() ? app : named_command(*below.front());
}

/// An argument unknown to the command.
std::string describe_unexpected(const std::string& word, const CLI::App& command) {
  const std::string name = full_name(command);
  if (const auto below = commands_of(command); !below.empty() && !word.starts_with('-'))
    return fmt::format("{0}: there is no {0} '{1}'{2}; there are {3}", name, word,
                       condyle::core::did_you_mean(word, below), fmt::join(below, ", "));
  if (word.starts_with("--sheet") || word.starts_with("--pdf"))
    return fmt::format(
        "{}: there is no option {}: condyle hip makes a sheet, and python3 -m condyle.plot sheet makes one "
        "of its folder",
        name, word.substr(0, word.find('=')));
  if (word == "-q" || word == "--quiet")
    return fmt::format(
        "{}: there is no option {}: answers go to standard output, and 2>/dev/null hides notes and progress",
        name, word);
  if (!word.starts_with('-'))
    return fmt::format("{0}: '{1}' is one argument too many; {2}", name, word,
                       word.find('=') != word.npos
                           ? "several values of one option stand in quotes, \"a=1 b=2\""
                           : "condyle help " + name + " has them");
  std::vector<std::string> options;
  for (const CLI::Option* option : command.get_options())
    for (const std::string& known : option->get_lnames()) options.push_back("--" + known);
  const std::string option = word.substr(0, word.find('='));
  return fmt::format("{0}: there is no option {1}{2}; condyle help {0} has those there are", name, option,
                     condyle::core::did_you_mean(option, options));
}

/// The fault of the command line, with a correction.
std::string describe(const CLI::ParseError& error, const CLI::App& app,
                     const std::vector<std::string>& words) {
  if (!app.get_subcommands().empty()) {
    const CLI::App& command = named_command(app);
    if (const auto number = number_after_band(words))
      return fmt::format("{}: --band takes a number after an equals sign only: --band={}", full_name(command),
                         *number);
    const auto unexpected = app.remaining(true);
    if (!unexpected.empty()) return describe_unexpected(unexpected.front(), command);
    return full_name(command) + ": " + error.what();
  }
  const std::vector<std::string> names = commands_of(app);
  const auto unknown = app.remaining();
  if (!unknown.empty())
    return fmt::format("unknown command '{}'{}; there are {}", unknown.front(),
                       condyle::core::did_you_mean(unknown.front(), names), fmt::join(names, ", "));
  if (error.get_exit_code() == static_cast<int>(CLI::ExitCodes::RequiredError))
    return fmt::format("a command is needed: {}", fmt::join(names, ", "));
  return error.what();
}

/// The arguments as the parser takes them, the last one first: `help rom` is `rom --help`.
std::vector<std::string> arguments(std::vector<std::string> words) {
  if (!words.empty() && words.front() == "help") {
    words.erase(words.begin());
    if (std::find(words.begin(), words.end(), "--help-all") == words.end()) words.emplace_back("--help");
  }
  std::reverse(words.begin(), words.end());
  return words;
}

/// A name that is empty is mostly a variable of the shell that is not set, and would be taken for an option that is not given. An option
/// that stands where a value should is mostly one whose value was left out.
void refuse_empty_names(CLI::App& command) {
  const auto why_not = [](const std::string& name) {
    return std::string(name.empty() ? "a name is needed, and this one is empty" : "");
  };
  const auto is_value = [&command](const std::string& value) {
    const bool is_option = value.starts_with("--") && command.get_option_no_throw(value);
    return is_option ? "needs a value, and the option " + value + " comes after it" : std::string();
  };
  for (CLI::Option* option : command.get_options()) {
    option->check(is_value, "");
    const std::string& value = option->get_option_text();
    if (option->get_positional() || value.starts_with("FILE") || value.starts_with("FOLDER"))
      option->check(why_not);
  }
  for (CLI::App* below : command.get_subcommands(nullptr)) refuse_empty_names(*below);
}

/// In the order of the help.
struct Command {
  std::string_view name;
  void (*add)(CLI::App&);
};
constexpr Command commands[] = {
    {"init", cli::add_init},       {"hip", cli::add_hip},         {"surface", cli::add_surface},
    {"inspect", cli::add_inspect}, {"frame", cli::add_frame},     {"depth", cli::add_depth},
    {"rom", cli::add_rom},         {"load", cli::add_load},       {"motion", cli::add_motion},
    {"measure", cli::add_measure}, {"resect", cli::add_resect},   {"implant", cli::add_implant},
    {"sweep", cli::add_sweep},     {"picture", cli::add_picture}, {"report", cli::add_report},
    {"sample", cli::add_sample},   {"study", cli::add_study},     {"merge", cli::add_merge},
    {"touch", cli::add_touch},     {"turn", cli::add_turn},       {"slide", cli::add_slide},
};

int run(const std::vector<std::string>& words) {
  CLI::App app(
      "Condyle computes where the bones of a joint run into each other, how deep, and along which direction.",
      "condyle");
  app.formatter(std::make_shared<cli::HelpFormatter>());
  app.set_version_flag("-V,--version", "condyle " + std::string(condyle::version));
  app.require_subcommand(1);
  app.fallthrough();
  app.set_help_all_flag("--help-all", "Print the help with every option");
  app.footer(std::string("Example: condyle sample hip --out sample\n"
                         "         condyle rom sample/hip.toml --band\n"
                         "         condyle help rom\n") +
             exit_codes);

  // Kept to the end of the process: out of memory within itself, oneTBB leaves a lock behind that its destructor waits for.
  [[maybe_unused]] static condyle::core::ThreadLimit* limit = nullptr;
  app.add_option_function<int>(
         "--threads",
         [](int count) { limit = new condyle::core::ThreadLimit(static_cast<std::size_t>(count)); },
         "Use at most this many threads. Results are the same for any number")
      ->check(cli::whole_number(1, 4096))
      ->option_text("N (all cores)");

  // Options of other commands would take longer to make than many an answer: the one that is named comes alone.
  std::vector<std::string> reversed = arguments(words);
  const auto is_named = [&](const Command& command) {
    return !reversed.empty() && reversed.back() == command.name;
  };
  if (const auto* const named = std::find_if(std::begin(commands), std::end(commands), is_named);
      named != std::end(commands))
    named->add(app);
  else
    for (const Command& command : commands) command.add(app);
  refuse_empty_names(app);

  try {
    app.parse(reversed);
  } catch (const CLI::Success& request) {  // --help or --version
    if (dynamic_cast<const CLI::CallForVersion*>(&request)) return cli::print(app.version() + "\n"), 0;
    // A command that does not exist has no help.
    const CLI::App& command = named_command(app);
    if (const auto unknown = app.remaining(true);
        !unknown.empty() && !unknown.front().starts_with('-') && !commands_of(command).empty())
      return fail({condyle::io::bad_usage, condyle::io::one_line(describe(request, app, words))});
    const bool is_all = dynamic_cast<const CLI::CallForAllHelp*>(&request) != nullptr;
    cli::print(app.help("", is_all ? CLI::AppFormatMode::All : CLI::AppFormatMode::Normal));
  } catch (const CLI::ParseError& error) {
    return fail({condyle::io::bad_usage, condyle::io::one_line(describe(error, app, words))});
  }
  cli::say_notes();
  return condyle::io::answered;
}

}  // namespace

int main(int argc, char** argv) {
  keep_freed_memory();
  cli::hold_standard_streams();
  cli::say_when_interrupted();
  std::set_terminate(end_without_answer);
  std::atexit(say_that_a_library_ended_it);
  int exit_code = condyle::io::answered;
  try {
    // Nothing that the command reads is written over.
    const condyle::io::InputRecorder read(condyle::io::InputRecorder::Digests::left_out);
    exit_code = run(cli::words_of_command_line(argc, argv));
  } catch (const cli::Interrupted& stopped) {
    std::fprintf(stderr, "condyle: %s\n", stopped.what());
    exit_code = condyle::io::interrupted;
  } catch (...) {
    exit_code = refuse_for_current_exception();
  }
  is_running = false;
  return exit_code;
}
