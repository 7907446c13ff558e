#pragma once

#include <filesystem>
#include <string_view>
#include <vector>

namespace condyle {

/// A folder of result files that appear together or not at all.
///
///     OutputFolder out(folder);              creates the folder where it is missing
///     write_mesh(out.file("femur.ply"), m);  written aside, in a hidden folder inside it
///     out.commit();                          all get their names, replacing older ones
///
/// Without commit() nothing is left: no file, nor a folder that was created for them. Throws FileError.
class OutputFolder {
 public:
  explicit OutputFolder(const std::filesystem::path& folder);
  ~OutputFolder();
  OutputFolder(const OutputFolder&) = delete;
  OutputFolder& operator=(const OutputFolder&) = delete;

  /// Where to write the file that will have this name. One name, no folders in it, each requested once.
  std::filesystem::path file(std::string_view name);

  /// Moves every file to its name, in the order they were requested, and returns the names with the folder.
  std::vector<std::filesystem::path> commit();

 private:
  std::filesystem::path folder_, aside_;
  std::vector<std::filesystem::path> created_;  ///< folders, outermost first
  std::vector<std::filesystem::path> names_;
  bool committed_ = false;
};

}  // namespace condyle
