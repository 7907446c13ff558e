#include "command.hpp"

#include <sys/wait.h>

#include <algorithm>
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
  std::istringstream lines(text);
  std::string rest;
  for (std::string line; std::getline(lines, line);)
    if (!line.starts_with("condyle: note: ")) rest += line + '\n';
  return rest;
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
