#include <dirent.h>
#include <dlfcn.h>
#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <atomic>
#include <cerrno>
#include <cstdarg>
#include <cstdio>
#include <cstdlib>
#include <string_view>

/// Preloaded before a program: one call that looks at a file fails, as a disk or a full table of open files makes it.
///
///     CONDYLE_CALLS   "NUMBER ERROR": which call, from 1 on, and its errno; NUMBER 0 is none
///     CONDYLE_BELOW   counted are calls on names that have this in them, and on files that were opened by such a name
///     CONDYLE_FAILED  a file that is made if the call was reached

namespace {

constexpr int most_files = 1024;
std::atomic<bool> is_counted[most_files];
std::atomic<long> calls = 0;

template <class Function>
Function next(const char* name) {
  return reinterpret_cast<Function>(::dlsym(RTLD_NEXT, name));
}

bool is_below(const char* path) {
  static const char* const below = std::getenv("CONDYLE_BELOW");
  return below != nullptr && path != nullptr && std::string_view(path).find(below) != std::string_view::npos;
}

/// Counts a call that matters; true if it is the one that fails, with errno set.
bool fails() {
  static const char* const which = std::getenv("CONDYLE_CALLS");
  static const char* const marker = std::getenv("CONDYLE_FAILED");
  long number = 0;
  int error = 0;
  if (which == nullptr || std::sscanf(which, "%ld %d", &number, &error) != 2 || ++calls != number)
    return false;
  static const auto open_file = next<int (*)(const char*, int, ...)>("open");
  if (const int made = open_file(marker, O_WRONLY | O_CREAT | O_CLOEXEC, 0600); made >= 0) ::close(made);
  errno = error;
  return true;
}

bool fails_below(const char* path) {
  return is_below(path) && fails();
}

bool fails_on(int file) {
  return file >= 0 && file < most_files && is_counted[file] && fails();
}

}  // namespace

extern "C" {

int open(const char* path, int flags, ...) {
  static const auto original = next<int (*)(const char*, int, ...)>("open");
  mode_t mode = 0;
  if ((flags & O_CREAT) != 0) {
    va_list rest;
    va_start(rest, flags);
    mode = va_arg(rest, mode_t);
    va_end(rest);
  }
  if (fails_below(path)) return -1;
  const int file = original(path, flags, mode);
  if (file >= 0 && file < most_files) is_counted[file] = is_below(path);
  return file;
}

int stat(const char* path, struct stat* status) noexcept {
  static const auto original = next<int (*)(const char*, struct stat*)>("stat");
  return fails_below(path) ? -1 : original(path, status);
}

int fstat(int file, struct stat* status) noexcept {
  static const auto original = next<int (*)(int, struct stat*)>("fstat");
  return fails_on(file) ? -1 : original(file, status);
}

ssize_t pread(int file, void* bytes, size_t count, off_t at) {
  static const auto original = next<ssize_t (*)(int, void*, size_t, off_t)>("pread");
  return fails_on(file) ? -1 : original(file, bytes, count, at);
}

int access(const char* path, int mode) noexcept {
  static const auto original = next<int (*)(const char*, int)>("access");
  return fails_below(path) ? -1 : original(path, mode);
}

DIR* opendir(const char* path) {
  static const auto original = next<DIR* (*)(const char*)>("opendir");
  return fails_below(path) ? nullptr : original(path);
}
}
