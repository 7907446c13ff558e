#include "condyle/first_contact.hpp"

namespace condyle::motion {

std::string_view name_of(FeatureKind kind) noexcept {
  switch (kind) {
    case FeatureKind::vertex:
      return "vertex";
    case FeatureKind::edge:
      return "edge";
    case FeatureKind::face:
      return "face";
  }
  return "vertex";
}

std::string_view name_of(LimitReason reason) noexcept {
  switch (reason) {
    case LimitReason::contact:
      return "contact";
    case LimitReason::end_of_range:
      return "end_of_range";
    case LimitReason::contact_at_start:
      return "contact_at_start";
    case LimitReason::ligament:
      return "ligament";
    case LimitReason::strained_at_start:
      return "strained_at_start";
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

}  // namespace condyle::motion
