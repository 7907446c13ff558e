#pragma once

#include <mutex>
#include <optional>
#include <string>
#include <string_view>

#include "progress.hpp"
#include "with_progress.hpp"

namespace condyle::cli {

/// The stage that work is in, and how far it is, shown by itself or as a part of the WholeProgress that lives. The work's threads write it, and
/// whoever watches for signals reads it.
class WorkStage {
 public:
  explicit WorkStage(Writes writes);

  void update(std::string_view name, std::size_t done, std::size_t total);
  /// Ends it, and says where.
  std::string interrupted();
  /// One piece of the whole is done.
  static void end_piece();

 private:
  std::mutex mutex_;
  std::optional<Progress> progress_;
  std::string name_, kept_;
  std::size_t done_ = 0, total_ = 0;
};

}  // namespace condyle::cli
