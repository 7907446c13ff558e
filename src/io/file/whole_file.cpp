#include "io/file/whole_file.hpp"

#include <fmt/format.h>

#include <atomic>
#include <cerrno>
#include <cstdio>
#include <memory>
#include <system_error>
#include <utility>

#include "condyle/error.hpp"
#include "io/file/file_calls.hpp"
#include "io/file/replaced_files.hpp"
#include "io/file/temporary_folder.hpp"

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
  name += fmt::format(".{}-{}.tmp", number_of_process(), counter++);
  return name;
}

}  // namespace

std::filesystem::path end_of_links(const std::filesystem::path& path) {
  std::error_code error;
  if (!std::filesystem::is_symlink(path, error) || !std::filesystem::exists(path, error)) return path;
  auto end = std::filesystem::canonical(path, error);
  if (error) throw FileError(fmt::format("{}: cannot be written: {}", path.string(), error.message()));
  return end;
}

namespace {

/// Names a file as it was asked for: those of a folder of results are written aside.
[[noreturn]] void fail_to_write(const std::filesystem::path& path, const std::string& why) {
  std::filesystem::path asked;
  for (const std::filesystem::path& part : path)
    if (!part.native().starts_with(aside_prefix)) asked /= part;
  throw FileError(fmt::format("{}: cannot be written: {}", asked.string(), why));
}

/// All bytes, and the file closed; 0, or why not.
int write_and_close(File file, std::string_view bytes) noexcept {
  const bool written = std::fwrite(bytes.data(), 1, bytes.size(), file.get()) == bytes.size();
  const int write_error = errno;
  const bool closed = std::fclose(file.release()) == 0;
  return !written ? write_error : !closed ? errno : 0;
}

/// Nothing is made, cut off or replaced.
void write_into(const std::filesystem::path& path, std::string_view bytes) {
  File file(opened_to_write_into(path));
  if (!file) fail_to_write(path, reason(errno));
  if (const int error = write_and_close(std::move(file), bytes)) fail_to_write(path, reason(error));
}

}  // namespace

void write_whole_file(const std::filesystem::path& path, std::string_view bytes) {
  const NameTaken taken = what_has_the_name(path);
  if (taken == NameTaken::written_into) return write_into(path, bytes);
  if (taken == NameTaken::refused) fail_to_write(path, "is neither a file nor can it be written into");
  const auto end = end_of_links(path);
  const auto temporary = temporary_name_beside(end);
  File file(new_file(temporary));
  if (!file) fail_to_write(path, reason(errno));
  int error = write_and_close(std::move(file), bytes);
  if (error == 0) error = move_file(temporary, end);
  if (error == 0) return;
  remove_file(temporary);
  fail_to_write(path, reason(error));
}

}  // namespace condyle::io
