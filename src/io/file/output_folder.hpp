#pragma once

#include <filesystem>
#include <functional>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace condyle::io {

class TemporaryFolder;

/// The regular files in a folder of results and in those below it, by their paths from there, in order.
std::vector<std::filesystem::path> files_below(const std::filesystem::path& folder);

/// A folder of result files that appear together or not at all.
///
///     OutputFolder out(folder);              creates the folder where it is missing
///     write_mesh(out.file("femur.ply"), m);  written aside, in a hidden folder inside it
///     out.commit();                          all get their names, replacing older ones
///
/// Without commit() nothing is left: no file, nor a folder that was created for them. Regular files and links are replaced,
/// never a device or a FIFO. Throws FileError.
class OutputFolder {
 public:
  /// Whether some run of a command could have written a file of this name.
  using OfCommand = std::function<bool(std::string_view name)>;

  explicit OutputFolder(const std::filesystem::path& folder);
  /// commit() removes files that an earlier run of the command left and this one does not write: no file of another
  /// query stays beside those of this one. Every name passed to file() must be of the command. Refuses a folder in
  /// which one of the files `read` has a name of the command, directly or by a link: it would be replaced or removed. With
  /// the name of a document, which every run of the command writes, nothing is removed where that is missing: no run was there, and
  /// the files are somebody's own: one that check_is_own() refuses is refused before the work. Refuses
  /// too a folder whose files of the command belong to another command's answer, by that one's document.
  OutputFolder(const std::filesystem::path& folder, OfCommand of_command,
               std::span<const std::filesystem::path> read = {}, std::string document = {});
  ~OutputFolder();
  OutputFolder(const OutputFolder&) = delete;
  OutputFolder& operator=(const OutputFolder&) = delete;

  /// Where to write the file that will have this name. One name, no folders in it, each requested once.
  std::filesystem::path file(std::string_view name);

  /// The names requested so far, and the folder in which these files lie until then.
  const std::vector<std::filesystem::path>& names() const noexcept { return names_; }
  std::filesystem::path aside() const;

  /// Moves every file to its name, in the order they were requested, and returns the names with the folder.
  std::vector<std::filesystem::path> commit();

 private:
  std::vector<std::filesystem::path> left_by_earlier_runs() const;

  std::filesystem::path folder_;
  std::vector<std::filesystem::path> names_;
  OfCommand of_command_;
  std::string document_;
  std::unique_ptr<TemporaryFolder> aside_;
};

}  // namespace condyle::io
