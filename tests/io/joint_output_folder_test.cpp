#include <unistd.h>

#include "io/file/output_folder.hpp"
#include "io/file/whole_file.hpp"
#include "support/test.hpp"

namespace condyle {
namespace {

namespace fs = std::filesystem;
using test::count_entries;
using test::TemporaryFolder;

void write(const fs::path& path, std::string_view text) {
  std::ofstream(path) << text;
}

TEST(OutputFolder, FilesAppearTogetherOnCommitAndNothingElse) {
  const TemporaryFolder folder;
  const fs::path out = folder / "a/b";
  {
    io::OutputFolder files(out);
    write(files.file("one.txt"), "1");
    write(files.file("two.txt"), "2");
    EXPECT_FALSE(fs::exists(out / "one.txt"));
    EXPECT_EQ(files.commit(), (std::vector<fs::path>{out / "one.txt", out / "two.txt"}));
  }
  EXPECT_EQ(io::read_whole_file(out / "one.txt") + io::read_whole_file(out / "two.txt"), "12");
  EXPECT_EQ(count_entries(out), 2u);
}

TEST(OutputFolder, WithoutCommitNothingIsLeftNotEvenTheFolders) {
  const TemporaryFolder folder;
  {
    io::OutputFolder files(folder / "a/b/");
    write(files.file("one.txt"), "1");
  }
  EXPECT_EQ(count_entries(folder.path()), 0u);
}

TEST(OutputFolder, OlderFilesStayUntilCommitAndAreReplacedThen) {
  const TemporaryFolder folder;
  folder.file("one.txt", "old");
  folder.file("other.txt", "kept");
  {
    io::OutputFolder files(folder.path());
    write(files.file("one.txt"), "new");
  }
  EXPECT_EQ(io::read_whole_file(folder / "one.txt"), "old");
  io::OutputFolder files(folder.path());
  write(files.file("one.txt"), "new");
  files.commit();
  EXPECT_EQ(io::read_whole_file(folder / "one.txt"), "new");
  EXPECT_EQ(io::read_whole_file(folder / "other.txt"), "kept");
}

/// Names that a command may write.
bool is_text(std::string_view name) {
  return name.ends_with(".txt");
}

TEST(OutputFolder, WhatAnEarlierRunOfTheCommandLeftGoesWithTheCommitAndNothingElse) {
  const TemporaryFolder folder;
  folder.file("one.txt", "old");
  folder.file("two.txt", "of an earlier run");
  folder.file("notes.md", "somebody's");
  fs::create_directory(folder / "folder.txt");
  {
    io::OutputFolder files(folder.path(), is_text);
    write(files.file("one.txt"), "new");
  }
  EXPECT_TRUE(fs::exists(folder / "two.txt")) << "not committed";
  io::OutputFolder files(folder.path(), is_text);
  write(files.file("one.txt"), "new");
  EXPECT_EQ(files.commit(), std::vector<fs::path>{folder / "one.txt"});
  EXPECT_FALSE(fs::exists(folder / "two.txt"));
  EXPECT_EQ(io::read_whole_file(folder / "one.txt"), "new");
  EXPECT_EQ(io::read_whole_file(folder / "notes.md"), "somebody's");
  EXPECT_TRUE(fs::exists(folder / "folder.txt"));
}

TEST(OutputFolder, OfAnotherCommandsAnswerIsRefusedAndItsOwnIsNot) {
  const TemporaryFolder folder;
  folder.file("limits.csv", "of a plan");
  folder.file("resection.json", "{}");
  const auto opens = [&](std::string_view document) {
    io::OutputFolder(folder.path(),
                     [=](std::string_view name) { return name == document || name == "limits.csv"; });
  };
  EXPECT_THROW(opens("rom.json"), FileError);
  EXPECT_NO_THROW(opens("resection.json"));
  EXPECT_NO_THROW(io::OutputFolder(folder.path(), is_text)) << "nothing of the same name";
  folder.file("rom.json", "{}");
  EXPECT_NO_THROW(opens("rom.json"));
}

// Where the document that every run writes is missing no run was.
TEST(OutputFolder, WithoutItsDocumentFilesAreSomebodysOwn) {
  const TemporaryFolder folder;
  folder.file("two.txt", "somebody's");
  const auto run = [&](std::string_view text) {
    io::OutputFolder files(folder.path(), is_text, {}, "one.txt");
    write(files.file("one.txt"), std::string(text));
    files.commit();
  };
  EXPECT_THROW(run("first"), FileError) << "it would go with the next run";
  EXPECT_EQ(io::read_whole_file(folder / "two.txt"), "somebody's");
  fs::remove(folder / "two.txt");
  run("first");
  folder.file("two.txt", "of an earlier run");
  run("second");
  EXPECT_FALSE(fs::exists(folder / "two.txt"));
}

TEST(OutputFolder, AFolderThatCannotBeMadeIsRefusedAndLeavesNothing) {
  const TemporaryFolder folder;
  const auto file = folder.file("plain", "text");
  EXPECT_THROW(io::OutputFolder{file}, FileError);
  EXPECT_THROW(io::OutputFolder{file / "below"}, FileError);
  EXPECT_THROW(io::OutputFolder{fs::path()}, FileError);
  EXPECT_THROW(io::OutputFolder{"/proc/condyle/out"}, FileError);
  EXPECT_EQ(io::read_whole_file(file), "text");
  EXPECT_EQ(count_entries(folder.path()), 1u);
}

TEST(OutputFolder, AFolderWithoutWritePermissionIsRefused) {
  if (::geteuid() == 0) GTEST_SKIP() << "root may write anywhere";
  const TemporaryFolder folder;
  fs::permissions(folder.path(), fs::perms::owner_read | fs::perms::owner_exec);
  EXPECT_THROW(io::OutputFolder{folder.path()}, FileError);
}

TEST(OutputFolder, AFolderUnderAFilesNameStopsTheCommitBeforeTheFirstMove) {
  const TemporaryFolder folder;
  fs::create_directory(folder / "two.txt");
  {
    io::OutputFolder files(folder.path());
    write(files.file("one.txt"), "1");
    write(files.file("two.txt"), "2");
    EXPECT_THROW(files.commit(), FileError);
  }
  EXPECT_EQ(count_entries(folder.path()), 1u);
}

}  // namespace
}  // namespace condyle
