#include "io/result/rom_result.hpp"

namespace condyle {

std::string_view name_of(LimitReason reason) noexcept {
  switch (reason) {
    case LimitReason::contact:
      return "contact";
    case LimitReason::end_of_range:
      return "end_of_range";
    case LimitReason::contact_at_start:
      return "contact_at_start";
  }
  return "contact";
}

std::string_view name_of(ContactKind kind) noexcept {
  switch (kind) {
    case ContactKind::unknown:
      return "unknown";
    case ContactKind::bearing:
      return "bearing";
    case ContactKind::impingement:
      return "impingement";
    case ContactKind::cut:
      return "cut";
    case ContactKind::soft:
      return "soft";
  }
  return "unknown";
}

}  // namespace condyle
