#include "range.hpp"

#include <fmt/format.h>

#include "answer.hpp"
#include "followed.hpp"

namespace condyle::cli {

RangeAnswer answered_range(const io::LoadedJoint& loaded, const RangeRequest& request,
                           std::string_view whose) {
  RangeAnswer answer = followed_by_stage([&](const AnswerControl& control) {
    return answer_range(loaded.joint, loaded.report.placement, request, control);
  });
  for (const RangeNote& each : answer.notes)
    note(fmt::format("{}{}: {}", whose, name_of(each.code), each.text));
  return answer;
}

}  // namespace condyle::cli
