#pragma once

#include <cstddef>
#include <functional>
#include <string_view>

#include "condyle/answer.hpp"

namespace condyle::answer {

/// The progress that one stage reports, under the name of what it counts; null if nobody follows.
inline std::function<void(std::size_t done, std::size_t total)> staged(const AnswerControl& control,
                                                                       std::string_view stage) {
  if (!control.progress) return nullptr;
  return [&control, stage](std::size_t done, std::size_t total) { control.progress(stage, done, total); };
}

}  // namespace condyle::answer
