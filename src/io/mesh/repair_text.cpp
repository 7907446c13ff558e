#include "io/result/repair_text.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "condyle/error.hpp"
#include "core/counted.hpp"
#include "core/one_line.hpp"

namespace condyle::io {
namespace {

constexpr std::array<std::string_view, 3> repair_names{"weld", "drop_unreferenced", "flip_inverted"};

}  // namespace

Repair repair_named(std::string_view name) {
  const auto found = std::find(repair_names.begin(), repair_names.end(), name);
  if (found == repair_names.end())
    throw UsageError(fmt::format("unknown repair \"{}\"; there are weld, drop_unreferenced and flip_inverted",
                                 core::one_line(name)));
  return static_cast<Repair>(found - repair_names.begin());
}

std::string_view name_of(Repair repair) noexcept {
  return repair_names[static_cast<std::size_t>(repair)];
}

std::string describe(const RepairDone& done) {
  switch (done.repair) {
    case Repair::weld:
      return fmt::format("weld: merged {}",
                         core::counted(done.count, "duplicate vertex", "duplicate vertices"));
    case Repair::drop_unreferenced:
      return fmt::format("drop_unreferenced: dropped {}", core::counted(done.count, "vertex", "vertices"));
    case Repair::flip_inverted:
      break;
  }
  return fmt::format("flip_inverted: flipped {}", core::counted(done.count, "triangle", "triangles"));
}

}  // namespace condyle::io
