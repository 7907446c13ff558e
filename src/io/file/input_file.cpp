#include "io/file/input_file.hpp"

#include <dirent.h>
#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstdlib>
#include <memory>
#include <optional>
#include <system_error>
#include <utility>

#include "condyle/error.hpp"
#include "core/one_line.hpp"
#include "io/file/environment.hpp"
#include "io/file/file_digest.hpp"
#include "io/file/input_recorder.hpp"
#include "io/mesh/parse.hpp"

namespace condyle::io {
namespace {

namespace fs = std::filesystem;

constexpr const char* nothing_there = "none";

/// Whether the same call may succeed the next time though nothing changed that an answer depends on.
bool passes(int error) noexcept {
  switch (error) {
    case EIO:
    case EINTR:
    case EAGAIN:
    case EMFILE:
    case ENFILE:
    case ENOMEM:
    case ENOSPC:
    case EDQUOT:
    case EBUSY:
    case ENOLCK:
    case ESTALE:
    case ETIMEDOUT:
      return true;
    default:
      return false;
  }
}

/// The call's result, begun again where a signal broke it off; not for ever, if each attempt is.
template <class Call>
auto uninterrupted(const Call& call) {
  constexpr int most_attempts = 1000;
  auto result = call();
  for (int attempt = 1; result < 0 && errno == EINTR && attempt < most_attempts; ++attempt) result = call();
  return result;
}

[[noreturn]] void fail_to_read(const fs::path& path, int error, const char* what = "cannot be read") {
  const std::string message =
      fmt::format("{}: {}: {}", path.string(), what, std::generic_category().message(error));
  if (passes(error))
    InputRecorder::add_passing_failure(message);
  else
    InputRecorder::add({Input::Kind::file, path, "unreadable"});
  throw FileError(message);
}

EntryKind kind_of(const struct stat& status) noexcept {
  return S_ISREG(status.st_mode)   ? EntryKind::file
         : S_ISDIR(status.st_mode) ? EntryKind::folder
                                   : EntryKind::other;
}

/// What has the name, and its status; throws for what passes.
EntryKind looked_at(const fs::path& path, struct stat& status) {
  if (uninterrupted([&] { return ::stat(path.c_str(), &status); }) == 0) return kind_of(status);
  if (passes(errno)) fail_to_read(path, errno);
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

struct CloseFolder {
  void operator()(DIR* folder) const noexcept { ::closedir(folder); }
};

std::vector<std::string> sorted_names(const fs::path& folder, const std::string& like) {
  const std::unique_ptr<DIR, CloseFolder> open(::opendir(folder.empty() ? "." : folder.c_str()));
  if (!open) {
    if (passes(errno)) fail_to_read(folder, errno);
    return {};
  }
  const std::string wanted = lower_case(like);
  std::vector<std::string> names;
  errno = 0;
  while (const dirent* entry = ::readdir(open.get())) {
    if (std::string name = entry->d_name; lower_case(name) == wanted) names.push_back(std::move(name));
    errno = 0;
  }
  if (errno != 0) fail_to_read(folder, errno);
  std::sort(names.begin(), names.end());
  return names;
}

std::string state_of(const std::vector<std::string>& names) {
  Digester digester;
  for (const std::string& name : names) digester.add(name + '\0');
  return digester.digest().sha256;
}

std::string state_of_file(const fs::path& path) {
  struct stat status {};
  if (looked_at(path, status) != EntryKind::file) return nothing_there;
  if (::access(path.c_str(), R_OK) != 0) return "unreadable";
  return digest_of_open(InputFile(path)).sha256;
}

std::string state_of_variable(const std::optional<std::string>& value) {
  return value ? io::digest_of(*value).sha256 : std::string(nothing_there);
}

}  // namespace

InputFile::InputFile(const fs::path& path, WithoutDigest) : path_(path) {
  check_is_file(path);
  // What is a file now may be a FIFO by the time it is opened.
  stream_ = uninterrupted([&] { return ::open(path.c_str(), O_RDONLY | O_NOCTTY | O_NONBLOCK | O_CLOEXEC); });
  if (stream_ < 0) fail_to_read(path, errno);
  struct stat status {};
  if (uninterrupted([&] { return ::fstat(stream_, &status); }) != 0) {
    const int error = errno;
    ::close(stream_);
    fail_to_read(path, error);
  }
  size_ = static_cast<std::uint64_t>(status.st_size);
  InputRecorder::add_read({status.st_dev, status.st_ino});
}

InputFile::InputFile(const fs::path& path) : InputFile(path, WithoutDigest{}) {
  if (InputRecorder::takes_digests())
    InputRecorder::add({Input::Kind::file, path_, digest_of_open(*this).sha256});
}

InputFile::~InputFile() {
  if (stream_ >= 0) ::close(stream_);
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
    const ssize_t more = uninterrupted(
        [&] { return ::pread(stream_, out.data() + got, out.size() - got, static_cast<off_t>(at + got)); });
    if (more < 0) fail_to_read(path_, errno, "cannot be read to its end");
    if (more == 0) break;
    got += static_cast<std::size_t>(more);
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
  struct stat status {};
  const EntryKind kind = looked_at(path, status);
  InputRecorder::add({Input::Kind::entry, path, word_of(kind)});
  return kind;
}

void check_is_file(const fs::path& path) {
  require_file(entry_at(path), path);
}

std::uint64_t size_of_file(const fs::path& path) {
  struct stat status {};
  require_file(looked_at(path, status), path);
  return static_cast<std::uint64_t>(status.st_size);
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
  const char* const text = std::getenv(name.c_str());
  std::optional<std::string> value;
  if (text != nullptr) value = text;
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
  const char* const value = std::getenv(path.c_str());
  return state_of_variable(value == nullptr ? std::nullopt : std::optional<std::string>(value));
}

}  // namespace condyle::io
