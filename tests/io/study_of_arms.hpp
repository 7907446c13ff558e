#pragma once

#include <sstream>

#include "condyle/io/study.hpp"
#include "io/file/csv_fields.hpp"
#include "io/file/whole_file.hpp"
#include "support/small_cohort.hpp"
#include "support/test.hpp"

namespace condyle::test {

/// A table by its header, behind its comments: one map per row.
inline std::vector<std::map<std::string, std::string>> rows_of(const std::filesystem::path& path) {
  const std::string text = io::read_whole_file(path), name = path.string();
  const io::Source source{text, name};
  std::istringstream lines(text);
  std::string line;
  while (std::getline(lines, line) && line.starts_with("#")) {
  }
  const std::vector<std::string> header = io::csv_fields(line, 1, source);
  std::vector<std::map<std::string, std::string>> rows;
  while (std::getline(lines, line)) {
    const std::vector<std::string> fields = io::csv_fields(line, rows.size() + 2, source);
    EXPECT_EQ(fields.size(), header.size()) << path << ": " << line;
    rows.emplace_back();
    for (std::size_t c = 0; c < header.size(); ++c) rows.back()[header[c]] = fields[c];
  }
  return rows;
}

class StudyOfArms : public ::testing::Test {
 protected:
  io::StudyDone run(const io::Study& study) const { return *io::run_study(study); }
  io::Study study(const std::string& out) const { return {cohort.table(), folder / out, flexion_only()}; }
  io::Study shard(const std::string& out, std::size_t number, std::size_t of) const {
    io::Study one = study(out);
    one.shard = {number, of};
    return one;
  }
  static io::StudyOptions flexion_only() {
    io::StudyOptions options;
    options.motions = {"flexion", "extension"};
    return options;
  }
  void expect_same_tables(const std::string& a, const std::string& b) const {
    for (const char* name : {"limits.csv", "hips.csv", "failures.csv", "columns.csv", "study.h5"})
      EXPECT_EQ(io::read_whole_file(folder / a / name), io::read_whole_file(folder / b / name)) << name;
  }
  /// A study of one joint, which is a hinge and no hip.
  io::Study knees() const {
    folder.file("knee.toml", replaced(io::read_whole_file(folder / "hip1.toml"), "kind = \"ball\"",
                                      "kind = \"hinge\"\njoint = \"knee\""));
    io::Study study{folder.file("knees.csv", "id,joint\nk,knee.toml\n"), folder / "knees", {}};
    study.options.anatomy = Anatomy::knee;
    return study;
  }

  const TemporaryFolder folder;
  const SmallCohort cohort{folder.path(), 9};
};

}  // namespace condyle::test
