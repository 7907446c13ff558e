#pragma once

#include <filesystem>
#include <string_view>
#include <vector>

#include "io/file/folder_calls.hpp"

namespace condyle::io {

/// Hidden folders and files in a folder of results begin so.
inline constexpr std::string_view aside_prefix = ".condyle-";

/// A hidden folder in the folder that results go to, with those that had to be made for it. The hidden one is removed with its
/// files when this goes out of scope, and what was made around it where nothing came into it; so they are by
/// end_temporary_folders(), where a signal ends the process. Removing needs no memory.
class TemporaryFolder {
 public:
  /// In `folder`, which is made where it is missing. Throws FileError.
  explicit TemporaryFolder(const std::filesystem::path& folder);
  ~TemporaryFolder();
  TemporaryFolder(const TemporaryFolder&) = delete;
  TemporaryFolder& operator=(const TemporaryFolder&) = delete;

  const SystemName& path() const noexcept { return aside_; }
  /// Whether nothing else is in the folder that it was made in.
  bool is_alone() const;

 private:
  friend void end_temporary_folders() noexcept;
  void remove() const noexcept;

  std::vector<std::filesystem::path> created_;  ///< outermost first
  SystemName aside_;
  TemporaryFolder *previous_ = nullptr, *next_ = nullptr;  ///< those that live now
};

/// Removes all that live now. A signal handler may call it, and whoever ends the process next: no folder can be made or go out
/// of scope afterwards, its thread waits for the end.
void end_temporary_folders() noexcept;

/// Whether one lives now: results are being written.
bool temporary_folders_live() noexcept;

}  // namespace condyle::io
