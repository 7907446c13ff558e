#pragma once

#include <cstddef>
#include <string_view>

#include "condyle/answer.hpp"

namespace condyle::answer {

/// The control of one stage, which reports its progress under the name of what it counts.
inline Control staged(const AnswerControl& control, std::string_view stage) {
  if (!control.progress) return {.stop = control.stop};
  return {[&control, stage](std::size_t done, std::size_t total) { control.progress(stage, done, total); },
          control.stop};
}

}  // namespace condyle::answer
