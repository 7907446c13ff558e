#pragma once

#include "condyle/io/recorded_motion.hpp"
#include "support/test.hpp"

/// Recorded motions as text, and what reading them gives.

namespace condyle::test {

/// A table with a time of 0, 1, 2 and so on before these columns.
inline io::MotionTable motion_table(std::vector<std::string> columns, std::vector<std::vector<double>> values,
                                    bool in_degrees = false) {
  io::MotionTable table;
  table.path = "walk.mot";
  table.rows = values.empty() ? 1 : values[0].size();
  table.in_degrees = in_degrees;
  columns.insert(columns.begin(), "time"), table.columns = std::move(columns);
  values.emplace(values.begin()), table.values = std::move(values);
  for (std::size_t row = 0; row < table.rows; ++row) {
    table.values[0].push_back(static_cast<double>(row));
    table.line_of_row.push_back(row + 9);
  }
  return table;
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
  return complaint_about<FileError>(folder.file(name, text), question);
}

/// Ten kinds of damage at least, each with its one line; the file that is not damaged is accepted.
inline void expect_complaints(std::string_view name, const std::string& good,
                              const std::vector<Refusal>& damages,
                              const std::function<void(const std::filesystem::path&)>& question) {
  ASSERT_EQ(refusal(name, good, question), "accepted");
  EXPECT_GE(damages.size(), 10u);
  for (const auto& [text, says] : damages) EXPECT_EQ(refusal(name, text, question), says) << text;
}

}  // namespace condyle::test
