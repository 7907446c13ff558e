#include "io/file/whole_file.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <atomic>
#include <cerrno>
#include <cstdio>
#include <memory>
#include <system_error>

#include "condyle/error.hpp"

namespace condyle::io {
namespace {

struct Close {
  void operator()(std::FILE* file) const noexcept { std::fclose(file); }
};
using File = std::unique_ptr<std::FILE, Close>;

std::string reason(int error) {
  return std::generic_category().message(error);
}

/// Two threads or two processes writing the same name must not share a temporary one.
std::filesystem::path temporary_name_beside(const std::filesystem::path& path) {
  static std::atomic<unsigned> counter = 0;
  auto name = path;
  name += fmt::format(".{}-{}.tmp", ::getpid(), counter++);
  return name;
}

}  // namespace

void check_is_file(const std::filesystem::path& path) {
  std::error_code error;
  const auto status = std::filesystem::status(path, error);
  if (!std::filesystem::exists(status)) throw FileError(path.string() + ": no such file");
  if (std::filesystem::is_directory(status)) throw FileError(path.string() + ": is a folder, not a file");
  if (!std::filesystem::is_regular_file(status)) throw FileError(path.string() + ": is not a regular file");
}

std::string read_whole_file(const std::filesystem::path& path) {
  check_is_file(path);

  const File file(std::fopen(path.c_str(), "rb"));
  if (!file) throw FileError(fmt::format("{}: cannot be read: {}", path.string(), reason(errno)));
  std::error_code error;
  const auto size = std::filesystem::file_size(path, error);
  if (error) throw FileError(fmt::format("{}: cannot be read: {}", path.string(), error.message()));
  std::string bytes(size, '\0');
  bytes.resize(std::fread(bytes.data(), 1, bytes.size(), file.get()));
  if (std::ferror(file.get())) throw FileError(path.string() + ": cannot be read to its end");
  return bytes;
}

void write_whole_file(const std::filesystem::path& path, std::string_view bytes) {
  const auto temporary = temporary_name_beside(path);
  const auto fail = [&](const std::string& why) -> void {
    std::error_code ignored;
    std::filesystem::remove(temporary, ignored);
    throw FileError(fmt::format("{}: cannot be written: {}", path.string(), why));
  };
  File file(std::fopen(temporary.c_str(), "wbx"));
  if (!file) throw FileError(fmt::format("{}: cannot be written: {}", path.string(), reason(errno)));
  const bool written = std::fwrite(bytes.data(), 1, bytes.size(), file.get()) == bytes.size();
  const int write_error = errno;
  const bool closed = std::fclose(file.release()) == 0;
  if (!written || !closed) fail(reason(written ? errno : write_error));
  std::error_code error;
  std::filesystem::rename(temporary, path, error);
  if (error) fail(error.message());
}

}  // namespace condyle::io
