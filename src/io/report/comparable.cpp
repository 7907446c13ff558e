#include <fmt/format.h>

#include "condyle/error.hpp"
#include "io/report/report.hpp"

namespace condyle::io {
namespace {

std::string kind_text(const Joint& joint) {
  return fmt::format("{}, {}, {}", name_of(joint.kind), name_of(joint.anatomy), name_of(joint.side));
}

}  // namespace

void check_comparable(const Joint& before, const std::string& before_name, const Joint& after,
                      const std::string& after_name) {
  if (before.kind == after.kind && before.anatomy == after.anatomy && before.side == after.side) return;
  throw UsageError(
      fmt::format("{} ({}) and {} ({}): a report compares joints of the same kind, anatomy and side",
                  before_name, kind_text(before), after_name, kind_text(after)));
}

}  // namespace condyle::io
