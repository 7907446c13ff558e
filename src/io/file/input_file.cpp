#include "io/file/input_file.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <optional>
#include <system_error>
#include <utility>

#include "condyle/error.hpp"
#include "core/one_line.hpp"
#include "io/file/environment.hpp"
#include "io/file/file_calls.hpp"
#include "io/file/file_digest.hpp"
#include "io/file/input_recorder.hpp"
#include "io/mesh/parse.hpp"

namespace condyle::io {
namespace {

namespace fs = std::filesystem;

constexpr const char* nothing_there = "none";

[[noreturn]] void fail_to_read(const fs::path& path, int error, const char* what = "cannot be read") {
  const std::string message =
      fmt::format("{}: {}: {}", path.string(), what, std::generic_category().message(error));
  if (passes(error))
    InputRecorder::add_passing_failure(message);
  else
    InputRecorder::add({Input::Kind::file, path, "unreadable"});
  throw FileError(message);
}

EntryKind kind_of(const FileStatus& status) noexcept {
  return status.kind == FileStatus::Kind::file     ? EntryKind::file
         : status.kind == FileStatus::Kind::folder ? EntryKind::folder
                                                   : EntryKind::other;
}

/// What has the name, and its status; throws for what passes.
EntryKind looked_at(const fs::path& path, FileStatus& status) {
  const int error = look_at(path, status);
  if (error == 0) return kind_of(status);
  if (passes(error)) fail_to_read(path, error);
  return EntryKind::none;
}

std::string word_of(EntryKind kind) {
  switch (kind) {
    case EntryKind::none:
      return nothing_there;
    case EntryKind::file:
      return "file";
    case EntryKind::folder:
      return "folder";
    case EntryKind::other:
      break;
  }
  return "other";
}

void require_file(EntryKind kind, const fs::path& path) {
  if (kind == EntryKind::file) return;
  InputRecorder::add({Input::Kind::file, path, nothing_there});
  throw FileError(path.string() + (kind == EntryKind::none     ? ": no such file"
                                   : kind == EntryKind::folder ? ": is a folder, not a file"
                                                               : ": is not a regular file"));
}

FileDigest digest_of_open(const InputFile& file) {
  Digester digester;
  std::string block(std::size_t{1} << 16, '\0');
  for (std::uint64_t at = 0; at < file.size();) {
    const std::size_t got = file.read(at, block);
    if (got == 0) break;
    digester.add(std::string_view(block).substr(0, got));
    at += got;
  }
  return digester.digest();
}

std::vector<std::string> sorted_names(const fs::path& folder, const std::string& like) {
  std::vector<std::string> names;
  if (const int error = names_in(folder, names)) {
    if (passes(error)) fail_to_read(folder, error);
    return {};
  }
  const std::string wanted = lower_case(like);
  std::erase_if(names, [&](const std::string& name) { return lower_case(name) != wanted; });
  std::sort(names.begin(), names.end());
  return names;
}

std::string state_of(const std::vector<std::string>& names) {
  Digester digester;
  for (const std::string& name : names) digester.add(name + '\0');
  return digester.digest().sha256;
}

std::string state_of_file(const fs::path& path) {
  FileStatus status;
  if (looked_at(path, status) != EntryKind::file) return nothing_there;
  if (!is_readable(path)) return "unreadable";
  return digest_of_open(InputFile(path)).sha256;
}

std::string state_of_variable(const std::optional<std::string>& value) {
  return value ? io::digest_of(*value).sha256 : std::string(nothing_there);
}

}  // namespace

InputFile::InputFile(const fs::path& path, WithoutDigest) : path_(path) {
  check_is_file(path);
  // What is a file now may be a FIFO by the time it is opened.
  if (const int error = open_to_read(path, stream_)) fail_to_read(path, error);
  FileStatus status;
  if (const int error = look_at_open(stream_, status)) {
    close_stream(stream_);
    fail_to_read(path, error);
  }
  size_ = status.size;
  InputRecorder::add_read(status.id);
}

InputFile::InputFile(const fs::path& path) : InputFile(path, WithoutDigest{}) {
  if (InputRecorder::takes_digests())
    InputRecorder::add({Input::Kind::file, path_, digest_of_open(*this).sha256});
}

InputFile::~InputFile() {
  if (stream_ >= 0) close_stream(stream_);
}

InputFile::InputFile(InputFile&& other) noexcept
    : path_(std::move(other.path_)), stream_(std::exchange(other.stream_, -1)), size_(other.size_) {}

InputFile& InputFile::operator=(InputFile&& other) noexcept {
  std::swap(path_, other.path_);
  std::swap(stream_, other.stream_);
  std::swap(size_, other.size_);
  return *this;
}

std::size_t InputFile::read(std::uint64_t at, std::span<char> out) const {
  if (at >= size_) return 0;
  out = out.first(static_cast<std::size_t>(std::min<std::uint64_t>(out.size(), size_ - at)));
  std::size_t got = 0;
  while (got < out.size()) {
    std::size_t more = 0;
    if (const int error = read_at(stream_, at + got, out.subspan(got), more))
      fail_to_read(path_, error, "cannot be read to its end");
    if (more == 0) break;
    got += more;
  }
  return got;
}

std::string read_whole_file(const fs::path& path, FileDigest* digest) {
  const InputFile file(path, InputFile::WithoutDigest{});
  std::string bytes(file.size(), '\0');
  bytes.resize(file.read(0, bytes));
  if (digest == nullptr && !InputRecorder::takes_digests()) return bytes;
  FileDigest of_bytes = io::digest_of(bytes);
  InputRecorder::add({Input::Kind::file, path, of_bytes.sha256});
  if (digest != nullptr) *digest = std::move(of_bytes);
  return bytes;
}

EntryKind entry_at(const fs::path& path) {
  FileStatus status;
  const EntryKind kind = looked_at(path, status);
  InputRecorder::add({Input::Kind::entry, path, word_of(kind)});
  return kind;
}

void check_is_file(const fs::path& path) {
  require_file(entry_at(path), path);
}

std::uint64_t size_of_file(const fs::path& path) {
  FileStatus status;
  require_file(looked_at(path, status), path);
  return status.size;
}

std::string why_no_file(const fs::path& path) {
  if (entry_at(path) != EntryKind::none) return {};
  InputRecorder::add({Input::Kind::file, path, nothing_there});
  return "there is no file " + core::one_line(path.string(), 300);
}

std::vector<std::string> names_like(const fs::path& folder, const std::string& name) {
  std::vector<std::string> names = sorted_names(folder, name);
  InputRecorder::add({Input::Kind::names, folder / name, state_of(names)});
  return names;
}

std::optional<std::string> environment_variable(const std::string& name) {
  std::optional<std::string> value = variable_of_process(name);
  InputRecorder::add({Input::Kind::variable, name, state_of_variable(value)});
  return value;
}

std::string state_now(Input::Kind kind, const fs::path& path) {
  const Recording none(nullptr);
  try {
    switch (kind) {
      case Input::Kind::file:
        return state_of_file(path);
      case Input::Kind::entry:
        return word_of(entry_at(path));
      case Input::Kind::names:
        return state_of(sorted_names(path.parent_path(), path.filename().string()));
      case Input::Kind::variable:
        break;
    }
  } catch (const FileError&) {
    return "unknown";
  }
  return state_of_variable(variable_of_process(path.string()));
}

}  // namespace condyle::io
