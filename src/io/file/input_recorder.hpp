#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <mutex>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "io/file/file_calls.hpp"

/// What an answer depends on outside the program. Whoever reads a file opens it by input_file.hpp, which records it here: a key is
/// made of what was read, and not of what somebody thought would be.

namespace condyle::io {

/// Something outside the program, and what it was when an answer looked at it.
struct Input {
  enum class Kind : std::uint8_t {
    file,   ///< state: SHA-256 of its contents; "none" if there is no file, "unreadable" if it cannot be read
    entry,  ///< whether there is something of that name: "none", "file", "folder" or "other"
    names,  ///< in a folder, those that are the path's last name but for capitals: their SHA-256
    variable  ///< of the environment, which `path` names: SHA-256 of its value, or "none"
  };
  Kind kind = Kind::file;
  std::filesystem::path path;
  std::string state;  ///< one word

  friend bool operator==(const Input&, const Input&) = default;
};

/// The state of what was two things in two looks: nothing is that later.
inline constexpr const char* changing_state = "changing";

/// Whether the state of a file is that of contents.
inline bool is_digest(std::string_view state) noexcept {
  return state.size() == 64;
}

/// "file 9f86... bones/femur.ply", and back; empty if it is no such text.
std::string text_of(const Input& input);
std::optional<Input> input_in(std::string_view text);

/// What an input is now, for comparison with Input::state: "unknown" if that cannot be said for the moment. Records nothing.
std::string state_now(Input::Kind kind, const std::filesystem::path& path);

/// What a recorder holds, to be entered in another one.
struct Recorded {
  std::vector<Input> inputs;
  std::set<FileId> read;
  std::optional<std::string> passing_failure;
};

/// Records what this thread reads, while it lives; other threads that work for the same answer enter it by Recording. One within
/// another passes on what it records.
class InputRecorder {
 public:
  enum class Digests : std::uint8_t { taken, left_out };
  explicit InputRecorder(Digests digests = Digests::taken);
  ~InputRecorder();
  InputRecorder(const InputRecorder&) = delete;
  InputRecorder& operator=(const InputRecorder&) = delete;

  /// Each once, in the order in which they were looked at first. What was two things in two looks has changing_state.
  std::vector<Input> inputs() const;
  /// Why something could not be read that might be read the next time, with the same files: the disk, too many open files.
  std::optional<std::string> passing_failure() const;

  /// All of it.
  Recorded recorded() const;

  /// The one that this thread enters its reading in; null if there is none.
  static InputRecorder* current() noexcept;

  // For readers: into the current one, if there is any.
  static bool takes_digests();
  static void add(Input input);
  static void add_read(FileId file);
  static void add_passing_failure(const std::string& message);
  static void add(const Recorded& elsewhere);
  /// Whether the current one, or one around it, has read this file.
  static bool has_read(FileId file);

 private:
  Digests digests_;
  InputRecorder* outer_;
  mutable std::mutex mutex_;
  Recorded recorded_;
  std::map<std::pair<Input::Kind, std::filesystem::path>, std::size_t> place_of_;
};

/// While it lives, this thread enters what it reads in that recorder; in none if it is null, as for a command's own results.
class Recording {
 public:
  explicit Recording(InputRecorder* in) noexcept;
  ~Recording();
  Recording(const Recording&) = delete;
  Recording& operator=(const Recording&) = delete;

 private:
  InputRecorder* before_;
};

}  // namespace condyle::io
