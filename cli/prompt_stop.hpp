#pragma once

#include <functional>
#include <optional>
#include <stop_token>

#include "condyle/io/study.hpp"

namespace condyle::cli {

/// As followed(), for work whose steps may take longer than anybody waits: a second after SIGINT or SIGTERM the
/// process has ended with exit code 130, whether or not the steps begun are complete. For work that writes only at
/// its end, and whole or not at all.
io::StudyDone stopped_promptly(const char* what,
                               const std::function<std::optional<io::StudyDone>(
                                   const std::function<void(std::size_t done, std::size_t total)>& follow,
                                   std::stop_token stop)>& compute);

}  // namespace condyle::cli
