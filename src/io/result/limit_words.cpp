#include "io/result/rom_result.hpp"

namespace condyle::io {

std::string_view name_of(motion::LimitReason reason) noexcept {
  switch (reason) {
    case motion::LimitReason::contact:
      return "contact";
    case motion::LimitReason::end_of_range:
      return "end_of_range";
    case motion::LimitReason::contact_at_start:
      return "contact_at_start";
  }
  return "contact";
}

std::string_view name_of(motion::ContactKind kind) noexcept {
  switch (kind) {
    case motion::ContactKind::unknown:
      return "unknown";
    case motion::ContactKind::bearing:
      return "bearing";
    case motion::ContactKind::impingement:
      return "impingement";
    case motion::ContactKind::cut:
      return "cut";
    case motion::ContactKind::soft:
      return "soft";
  }
  return "unknown";
}

}  // namespace condyle::io
