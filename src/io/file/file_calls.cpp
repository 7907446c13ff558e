#include "io/file/file_calls.hpp"

#include <dirent.h>
#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstdlib>
#include <memory>

namespace condyle::io {
namespace {

namespace fs = std::filesystem;

/// The call's result, begun again where a signal broke it off; not for ever, if each attempt is.
template <class Call>
auto uninterrupted(const Call& call) {
  constexpr int most_attempts = 1000;
  auto result = call();
  for (int attempt = 1; result < 0 && errno == EINTR && attempt < most_attempts; ++attempt) result = call();
  return result;
}

FileStatus status_of(const struct stat& status) noexcept {
  using Kind = FileStatus::Kind;
  const Kind kind = S_ISREG(status.st_mode)                               ? Kind::file
                    : S_ISDIR(status.st_mode)                             ? Kind::folder
                    : S_ISFIFO(status.st_mode) || S_ISCHR(status.st_mode) ? Kind::characters
                                                                          : Kind::other;
  return {kind, static_cast<std::uint64_t>(status.st_size), {status.st_dev, status.st_ino}};
}

struct CloseFolder {
  void operator()(DIR* folder) const noexcept { ::closedir(folder); }
};

}  // namespace

int look_at(const fs::path& path, FileStatus& status) noexcept {
  struct stat seen {};
  if (uninterrupted([&] { return ::stat(path.c_str(), &seen); }) != 0) return errno;
  status = status_of(seen);
  return 0;
}

int look_at_open(int stream, FileStatus& status) noexcept {
  struct stat seen {};
  if (uninterrupted([&] { return ::fstat(stream, &seen); }) != 0) return errno;
  status = status_of(seen);
  return 0;
}

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

int open_to_read(const fs::path& path, int& stream) noexcept {
  stream = uninterrupted([&] { return ::open(path.c_str(), O_RDONLY | O_NOCTTY | O_NONBLOCK | O_CLOEXEC); });
  return stream < 0 ? errno : 0;
}

int read_at(int stream, std::uint64_t at, std::span<char> out, std::size_t& got) noexcept {
  const ssize_t read =
      uninterrupted([&] { return ::pread(stream, out.data(), out.size(), static_cast<off_t>(at)); });
  if (read < 0) return errno;
  got = static_cast<std::size_t>(read);
  return 0;
}

void close_stream(int stream) noexcept {
  ::close(stream);
}

bool is_readable(const fs::path& path) noexcept {
  return ::access(path.c_str(), R_OK) == 0;
}

int why_not_writable(const fs::path& path) noexcept {
  return ::access(path.c_str(), W_OK) == 0 ? 0 : errno;
}

int names_in(const fs::path& folder, std::vector<std::string>& names) {
  const std::unique_ptr<DIR, CloseFolder> open(::opendir(folder.empty() ? "." : folder.c_str()));
  if (!open) return errno;
  errno = 0;
  while (const dirent* entry = ::readdir(open.get())) {
    names.emplace_back(entry->d_name);
    errno = 0;
  }
  return errno;
}

std::optional<std::string> variable_of_process(const std::string& name) {
  const char* const text = std::getenv(name.c_str());
  return text == nullptr ? std::nullopt : std::optional<std::string>(text);
}

std::FILE* new_file(const fs::path& path) noexcept {
  return std::fopen(path.c_str(), "wbx");
}

std::FILE* opened_to_write_into(const fs::path& path) noexcept {
  const int stream = ::open(path.c_str(), O_WRONLY | O_NOCTTY | O_CLOEXEC);
  if (stream < 0) return nullptr;
  std::FILE* const file = ::fdopen(stream, "wb");
  if (file == nullptr) {
    ::close(stream);
    errno = ENOMEM;
  }
  return file;
}

int move_file(const fs::path& from, const fs::path& to) noexcept {
  return std::rename(from.c_str(), to.c_str()) == 0 ? 0 : errno;
}

int remove_file(const fs::path& path) noexcept {
  return ::unlink(path.c_str()) == 0 ? 0 : errno;
}

int number_of_process() noexcept {
  return ::getpid();
}

}  // namespace condyle::io
