#include "command.hpp"

#include <gtest/gtest.h>

#include <sys/wait.h>

#include <cstdlib>
#include <fstream>
#include <iterator>
#include <map>
#include <sstream>
#include <stdexcept>

#include "support/temporary_folder.hpp"

namespace condyle::test {
namespace {

std::string contents(const std::filesystem::path& path) {
  std::ifstream in(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

}  // namespace

Ran run_condyle(const std::filesystem::path& folder, const std::string& arguments,
                const std::string& redirections) {
  const TemporaryFolder caught;
  const std::string command = "cd '" + folder.string() + "' && '" CONDYLE_COMMAND "' " + arguments + " >'" +
                              (caught / "out").string() + "' 2>'" + (caught / "err").string() + "' " +
                              redirections;
  const int status = std::system(command.c_str());
  return {WIFEXITED(status) ? WEXITSTATUS(status) : -1, contents(caught / "out"), contents(caught / "err")};
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

void expect_refusal(const Ran& ran, int exit_code, std::string_view saying, const std::string& arguments) {
  EXPECT_EQ(ran.exit_code, exit_code) << arguments;
  EXPECT_EQ(ran.out, "") << arguments;
  EXPECT_TRUE(is_one_error_line(without_notes(ran.err))) << ran.err;
  EXPECT_NE(ran.err.find(saying), ran.err.npos) << ran.err;
}

}  // namespace condyle::test
