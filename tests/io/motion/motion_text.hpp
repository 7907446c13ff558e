#pragma once

#include <gtest/gtest.h>

#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "condyle/error.hpp"
#include "condyle/io/recorded_motion.hpp"
#include "support/temporary_folder.hpp"

/// Recorded motions as text, and what reading them gives.

namespace condyle::test {

inline std::string replaced(std::string text, std::string_view from, std::string_view to) {
  const auto at = text.find(from);
  EXPECT_NE(at, text.npos) << from;
  return at == text.npos ? text : text.replace(at, from.size(), to);
}

inline io::MotionTable read_table(std::string_view name, std::string_view text) {
  const TemporaryFolder folder;
  return io::read_motion_table(folder.file(name, text));
}

/// Message of the error of `question` after the file's name; "accepted" if there is none. One line, with that name
/// first.
template <class Question>
std::string refusal(std::string_view name, std::string_view text, const Question& question) {
  const TemporaryFolder folder;
  const auto path = folder.file(name, text);
  try {
    question(path);
  } catch (const FileError& error) {
    const std::string message = error.what(), start = path.string() + ": ";
    EXPECT_EQ(message.find('\n'), message.npos) << message;
    EXPECT_TRUE(message.starts_with(start)) << message;
    return message.substr(std::min(message.size(), start.size()));
  }
  return "accepted";
}

/// A damaged file, and what reading it complains about behind the file's name.
struct Damage {
  std::string text;
  std::string complaint;
};

/// Ten kinds of damage at least, each with its one line; the file that is not damaged is accepted.
inline void expect_complaints(std::string_view name, const std::string& good,
                              const std::vector<Damage>& damages,
                              const std::function<void(const std::filesystem::path&)>& question) {
  ASSERT_EQ(refusal(name, good, question), "accepted");
  EXPECT_GE(damages.size(), 10u);
  for (const Damage& damage : damages)
    EXPECT_EQ(refusal(name, damage.text, question), damage.complaint) << damage.text;
}

}  // namespace condyle::test
