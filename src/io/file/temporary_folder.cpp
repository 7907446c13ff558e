#include "io/file/temporary_folder.hpp"

#include <dirent.h>
#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <cerrno>
#include <csignal>
#include <cstdlib>
#include <ctime>
#include <system_error>

#include "condyle/error.hpp"

namespace condyle::io {
namespace {

namespace fs = std::filesystem;

/// The newest of those that live, and the lock of their list. A signal handler knows of no other object, so they are of the
/// process.
TemporaryFolder* newest = nullptr;
std::atomic_flag listing = ATOMIC_FLAG_INIT;
static_assert(std::atomic<TemporaryFolder*>::is_always_lock_free);

void wait_a_millisecond() noexcept {
  const timespec millisecond{0, 1'000'000};
  ::nanosleep(&millisecond, nullptr);
}

/// Holds the list. The thread gets none of the signals that end a command meanwhile: their handler wants the list too.
class ListHeld {
 public:
  ListHeld() noexcept {
    sigset_t ending;
    ::sigemptyset(&ending);
    for (const int signal : {SIGINT, SIGTERM, SIGHUP}) ::sigaddset(&ending, signal);
    ::pthread_sigmask(SIG_BLOCK, &ending, &before_);
    while (listing.test_and_set(std::memory_order_acquire)) wait_a_millisecond();
  }
  ~ListHeld() {
    listing.clear(std::memory_order_release);
    ::pthread_sigmask(SIG_SETMASK, &before_, nullptr);
  }
  ListHeld(const ListHeld&) = delete;
  ListHeld& operator=(const ListHeld&) = delete;

 private:
  sigset_t before_;
};

/// The folders on the way to `folder` that are not there yet, outermost first.
std::vector<fs::path> missing_folders(const fs::path& folder) {
  std::vector<fs::path> missing;
  std::error_code ignored;
  for (fs::path at = folder; !at.empty() && !fs::exists(at, ignored); at = at.parent_path())
    missing.push_back(at);
  std::reverse(missing.begin(), missing.end());
  return missing;
}

/// A folder that has files and no folders, by calls that a signal handler may make; readdir() is none.
void remove_with_files(const char* folder) noexcept {
  // Another thread may write one more file between the last look and the folder's end.
  for (int attempt = 0; attempt < 100; ++attempt) {
    if (::rmdir(folder) == 0 || (errno != ENOTEMPTY && errno != EEXIST)) return;
    const int at = ::open(folder, O_RDONLY | O_DIRECTORY | O_NOFOLLOW | O_CLOEXEC);
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

}  // namespace

TemporaryFolder::TemporaryFolder(const fs::path& folder)
    : created_(missing_folders(folder)), aside_((folder / ".condyle-XXXXXX").string()) {
  int error = 0;
  {
    const ListHeld held;
    // Another process may make the same ones at the same time.
    for (const fs::path& missing : created_)
      if (error == 0 && ::mkdir(missing.c_str(), 0777) != 0 && errno != EEXIST) error = errno;
    if (error == 0 && ::mkdtemp(aside_.data()) == nullptr) error = errno;
    if (error == 0) {
      next_ = newest;
      if (next_) next_->previous_ = this;
      newest = this;
      return;
    }
    for (auto made = created_.rbegin(); made != created_.rend(); ++made) ::rmdir(made->c_str());
  }
  throw FileError(
      fmt::format("{}: cannot be written to: {}", folder.string(), std::generic_category().message(error)));
}

TemporaryFolder::~TemporaryFolder() {
  const ListHeld held;
  remove();
  if (next_) next_->previous_ = previous_;
  (previous_ ? previous_->next_ : newest) = next_;
}

void TemporaryFolder::remove() const noexcept {
  remove_with_files(aside_.c_str());
  // One that a result came into is not empty and stays.
  for (auto made = created_.rbegin(); made != created_.rend(); ++made) ::rmdir(made->c_str());
}

void end_temporary_folders() noexcept {
  // Whoever holds the list lets it go soon, unless its thread is gone.
  constexpr int longest_wait_ms = 2000;
  for (int waited = 0; listing.test_and_set(std::memory_order_acquire); ++waited) {
    if (waited == longest_wait_ms) return;
    wait_a_millisecond();
  }
  for (const TemporaryFolder* folder = newest; folder; folder = folder->next_) folder->remove();
}

bool temporary_folders_live() noexcept {
  const ListHeld held;
  return newest != nullptr;
}

}  // namespace condyle::io
