#include "command.hpp"

#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <map>
#include <sstream>
#include <stdexcept>

namespace condyle::test {

Ran run_condyle(const std::filesystem::path& folder, const std::string& arguments,
                const std::string& redirections) {
  const TemporaryFolder caught;
  const std::string command = "cd '" + folder.string() + "' && '" CONDYLE_COMMAND "' " + arguments + " >'" +
                              (caught / "out").string() + "' 2>'" + (caught / "err").string() + "' " +
                              redirections;
  const int status = std::system(command.c_str());
  return {WIFEXITED(status) ? WEXITSTATUS(status) : -1, io::read_whole_file(caught / "out"),
          io::read_whole_file(caught / "err")};
}

Ran run_well(const std::filesystem::path& folder, const std::string& arguments) {
  Ran ran = run_condyle(folder, arguments);
  EXPECT_EQ(ran.exit_code, 0) << arguments << "\n" << ran.err;
  return ran;
}

Ran run_interrupted(const fs::path& folder, const std::string& arguments, const std::string& stage) {
  const TemporaryFolder caught;
  const std::string err = (caught / "err").string();
  const std::string command = "cd '" + folder.string() + "' && { '" CONDYLE_COMMAND "' --threads 1 " +
                              arguments + " >'" + (caught / "out").string() + "' 2>'" + err +
                              "' & p=$!; while kill -0 $p 2>/dev/null && ! grep -qs '" + stage + "' '" + err +
                              "'; do sleep 0.1; done; kill -TERM $p; wait $p; }";
  const int status = std::system(command.c_str());
  return {WIFEXITED(status) ? WEXITSTATUS(status) : -1, io::read_whole_file(caught / "out"),
          io::read_whole_file(err)};
}

pid_t start_condyle(const std::filesystem::path& folder, const std::string& arguments,
                    const std::filesystem::path& err, const std::vector<int>& ignored) {
  std::fflush(nullptr);  // else the child would write it again, or into a file that is full
  const std::string line = "cd '" + folder.string() + "' && exec '" CONDYLE_COMMAND "' " + arguments +
                           " >/dev/null 2>'" + err.string() + "'";
  const pid_t child = ::fork();
  if (child != 0) return child;
  for (const int signal : ignored) std::signal(signal, SIG_IGN);
  ::execl("/bin/sh", "sh", "-c", line.c_str(), nullptr);
  ::_exit(99);
}

int end_of(pid_t process) {
  int status = 0;
  ::waitpid(process, &status, 0);
  return WIFEXITED(status) ? WEXITSTATUS(status) : -WTERMSIG(status);
}

bool has_temporary(const std::filesystem::path& folder) {
  if (!fs::exists(folder)) return false;
  for (const auto& entry : fs::recursive_directory_iterator(folder))
    if (entry.path().filename().string().starts_with(".condyle-")) return true;
  return false;
}

void sample_into(const std::filesystem::path& folder, const std::string& arguments) {
  static std::map<std::string, TemporaryFolder> made;
  const auto [at, is_new] = made.try_emplace(arguments);
  const std::filesystem::path& once = at->second.path();
  if (is_new && run_condyle(once, "sample " + arguments + " --out .").exit_code != 0) {
    made.erase(at);
    throw std::runtime_error("condyle sample " + arguments + " failed");
  }
  std::filesystem::copy(once, folder, std::filesystem::copy_options::recursive);
}

std::string without_notes(const std::string& text) {
  std::string rest;
  for (const std::string& line : lines_of(text))
    if (!line.starts_with("condyle: note: ")) rest += line + '\n';
  return rest;
}

std::vector<std::string> lines_of(const std::string& text) {
  std::istringstream in(text);
  std::vector<std::string> lines;
  for (std::string line; std::getline(in, line);)
    if (!line.starts_with('#')) lines.push_back(line);
  return lines;
}

std::vector<std::string> fields_of(const std::string& line) {
  std::istringstream in(line + ",");
  std::vector<std::string> fields;
  for (std::string field; std::getline(in, field, ',');) fields.push_back(field);
  return fields;
}

bool is_one_error_line(const std::string& text) {
  return text.starts_with("condyle: ") && text.find('\n') == text.size() - 1;
}

::testing::AssertionResult says(std::string_view text, std::string_view piece) {
  return ::testing::AssertionResult(text.find(piece) != text.npos) << '"' << piece << "\" in\n" << text;
}

bool has_note(const Json& answer, std::string_view code, const char* key) {
  return std::any_of(answer[key].begin(), answer[key].end(),
                     [&](const Json& note) { return note["code"] == code; });
}

void expect_refusal(const Ran& ran, int exit_code, std::string_view saying, const std::string& arguments) {
  EXPECT_EQ(ran.exit_code, exit_code) << arguments;
  EXPECT_EQ(ran.out, "") << arguments;
  EXPECT_TRUE(is_one_error_line(without_notes(ran.err))) << ran.err;
  EXPECT_TRUE(says(ran.err, saying)) << arguments;
}

void CommandTest::write_edited(const std::string& name, const std::string& file, std::string_view from,
                               std::string_view to) const {
  std::string text = text_of(file);
  const std::size_t at = text.find(from);
  ASSERT_NE(at, text.npos) << from << " in " << file;
  write(name, text.replace(at, from.size(), to));
}

}  // namespace condyle::test
