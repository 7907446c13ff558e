#pragma once

#include <fmt/format.h>
#include <sys/types.h>

#include <nlohmann/json.hpp>

#include "condyle/io/mesh_file.hpp"
#include "io/file/whole_file.hpp"
#include "joint_of_file.hpp"
#include "support/test.hpp"

/// What tests of the command have in common, and what they include: runs of it, its answers, and folders to ask in.

namespace condyle::test {

namespace fs = std::filesystem;
using Json = nlohmann::json;

/// Output of a run of the command.
struct Ran {
  int exit_code;  ///< -1 where it was killed
  std::string out, err;
};

/// Runs `condyle ARGUMENTS` in a folder, by the shell, with `redirections` after it ("" for none: both are
/// caught).
Ran run_condyle(const std::filesystem::path& folder, const std::string& arguments,
                const std::string& redirections = "");

/// The same of a question that has an answer: anything but exit code 0 fails the test.
Ran run_well(const std::filesystem::path& folder, const std::string& arguments);

/// Runs the command on one thread and ends it by SIGTERM once its progress names this stage; SIGINT is ignored in the background of a shell.
Ran run_interrupted(const std::filesystem::path& folder, const std::string& arguments,
                    const std::string& stage);

/// Starts `condyle ARGUMENTS` in a folder by itself, with these signals ignored by its parent; its notes and errors go into a file.
pid_t start_condyle(const std::filesystem::path& folder, const std::string& arguments,
                    const std::filesystem::path& err, const std::vector<int>& ignored = {});

/// Waits for the end of a process: its exit code, the signal that ended it negated.
int end_of(pid_t process);

/// Whether something lies in a folder, or below it, that was being written and has no name yet.
bool has_temporary(const std::filesystem::path& folder);

/// What `condyle sample ARGUMENTS` makes, in this folder; made once per process for all tests that ask for the same.
void sample_into(const std::filesystem::path& folder, const std::string& arguments);

/// Standard error without notes on a joint, which may come before an error.
std::string without_notes(const std::string& text);

/// Whether a text is one line "condyle: ..." and nothing else.
bool is_one_error_line(const std::string& text);

/// Whether a text has this piece; shows both if that is not what was expected.
::testing::AssertionResult says(std::string_view text, std::string_view piece);

/// Lines of a text, comments of a table (#) left out; and what lies between the commas of one.
std::vector<std::string> lines_of(const std::string& text);
std::vector<std::string> fields_of(const std::string& line);

/// Whether an answer has a note of this code, among those on the joint or those of this key.
bool has_note(const Json& answer, std::string_view code, const char* key = "notes");

/// That a run ended with this exit code and one line on standard error, which says this, and gave no answer.
void expect_refusal(const Ran& ran, int exit_code, std::string_view saying, const std::string& arguments);

/// A folder of its own for each test, in which the command runs.
class CommandTest : public ::testing::Test {
 protected:
  Ran run(const std::string& arguments, const std::string& redirections = "") const {
    return run_condyle(here, arguments, redirections);
  }
  Ran done(const std::string& arguments) const { return run_well(here, arguments); }
  Json answer(const std::string& arguments) const { return Json::parse(done(arguments + " --json").out); }
  void expect_refused(int exit_code, const std::string& arguments, std::string_view saying) const {
    expect_refusal(run(arguments), exit_code, saying, arguments);
  }
  std::string text_of(const std::string& name) const { return io::read_whole_file(here / name); }
  Json json_of(const std::string& name) const { return Json::parse(text_of(name)); }
  void write(const std::string& name, std::string_view text) const { folder.file(name, text); }
  void append(const std::string& name, std::string_view text) const {
    std::ofstream(here / name, std::ios::binary | std::ios::app) << text;
  }
  /// Writes `name` as `file` with the first `from` in it replaced.
  void write_edited(const std::string& name, const std::string& file, std::string_view from,
                    std::string_view to) const;
  void edit(const std::string& file, std::string_view from, std::string_view to) const {
    write_edited(file, file, from, to);
  }

  const TemporaryFolder folder;
  const fs::path here = folder.path();
};

/// With an arm that hangs from the joint centre and a post in front of it, as joint.toml.
class ArmAndPost : public CommandTest {
 protected:
  void SetUp() override {
    io::write_mesh(here / "post.ply", post);
    io::write_mesh(here / "arm.ply", arm);
    write("joint.toml", text_of_joint({}));
  }

  const TriMesh post = box({40, -120, -50}, {60, -80, 50}), arm = box({-1, -100, -2}, {1, -10, 2});
};

}  // namespace condyle::test
