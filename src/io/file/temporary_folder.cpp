#include "io/file/temporary_folder.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <atomic>
#include <iterator>
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

/// Holds the list. The thread gets none of the signals that end a command meanwhile: their handler wants the list too.
class ListHeld {
 public:
  ListHeld() noexcept {
    hold_off_signals();
    while (listing.test_and_set(std::memory_order_acquire)) wait_a_millisecond();
  }
  ~ListHeld() {
    listing.clear(std::memory_order_release);
    let_signals_in();
  }
  ListHeld(const ListHeld&) = delete;
  ListHeld& operator=(const ListHeld&) = delete;
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

}  // namespace

TemporaryFolder::TemporaryFolder(const fs::path& folder)
    : created_(missing_folders(folder)), aside_((folder / (std::string(aside_prefix) + "XXXXXX")).native()) {
  int error = 0;
  {
    const ListHeld held;
    // Another process may make the same ones at the same time.
    for (const fs::path& missing : created_)
      if (error == 0) error = make_folder(missing);
    if (error == 0) error = make_folder_of_own(aside_);
    if (error == 0) {
      next_ = newest;
      if (next_) next_->previous_ = this;
      newest = this;
      return;
    }
    for (auto made = created_.rbegin(); made != created_.rend(); ++made) remove_empty_folder(made->native());
  }
  throw FileError(
      fmt::format("{}: cannot be written to: {}", folder.string(), std::generic_category().message(error)));
}

bool TemporaryFolder::is_alone() const {
  return std::next(fs::directory_iterator(fs::path(aside_).parent_path())) == fs::directory_iterator();
}

TemporaryFolder::~TemporaryFolder() {
  const ListHeld held;
  remove();
  if (next_) next_->previous_ = previous_;
  (previous_ ? previous_->next_ : newest) = next_;
}

void TemporaryFolder::remove() const noexcept {
  remove_with_files(aside_);
  // One that a result came into is not empty and stays.
  for (auto made = created_.rbegin(); made != created_.rend(); ++made) remove_empty_folder(made->native());
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
