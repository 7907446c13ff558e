#include "io/file/folder_calls.hpp"

#include <dirent.h>
#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <csignal>
#include <cstdlib>
#include <ctime>

namespace condyle::io {
namespace {

/// What the thread held off before.
thread_local sigset_t held_before;

}  // namespace

int make_folder(const std::filesystem::path& folder) noexcept {
  return ::mkdir(folder.c_str(), 0777) == 0 || errno == EEXIST ? 0 : errno;
}

int make_folder_of_own(SystemName& name) noexcept {
  return ::mkdtemp(name.data()) != nullptr ? 0 : errno;
}

void remove_empty_folder(const SystemName& folder) noexcept {
  ::rmdir(folder.c_str());
}

// By calls that a signal handler may make; readdir() is none.
void remove_with_files(const SystemName& folder) noexcept {
  // Another thread may write one more file between the last look and the folder's end.
  for (int attempt = 0; attempt < 100; ++attempt) {
    if (::rmdir(folder.c_str()) == 0 || (errno != ENOTEMPTY && errno != EEXIST)) return;
    const int at = ::open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_NOFOLLOW | O_CLOEXEC);
    if (at < 0) return;
    alignas(dirent64) char entries[4096];
    long bytes;
    while ((bytes = ::getdents64(at, reinterpret_cast<dirent64*>(entries), sizeof entries)) > 0) {
      for (long i = 0; i < bytes;) {
        const auto* entry = reinterpret_cast<const dirent64*>(entries + i);
        ::unlinkat(at, entry->d_name, 0);  // fails for . and ..
        i += entry->d_reclen;
      }
    }
    ::close(at);
  }
}

void wait_a_millisecond() noexcept {
  const timespec millisecond{0, 1'000'000};
  ::nanosleep(&millisecond, nullptr);
}

void hold_off_signals() noexcept {
  sigset_t ending;
  ::sigemptyset(&ending);
  for (const int signal : {SIGINT, SIGTERM, SIGHUP}) ::sigaddset(&ending, signal);
  ::pthread_sigmask(SIG_BLOCK, &ending, &held_before);
}

void let_signals_in() noexcept {
  ::pthread_sigmask(SIG_SETMASK, &held_before, nullptr);
}

}  // namespace condyle::io
