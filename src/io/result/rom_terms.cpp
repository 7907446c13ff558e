#include <fmt/format.h>

#include "condyle/io/rom_result.hpp"

namespace condyle {

std::vector<std::string> terms_of(const RangeOptions& options, const RangeOfMotion& range) {
  std::vector<std::string> terms;
  const OverlapOptions& overlap = options.overlap;
  if (overlap.leave_out_reference_contacts)
    terms.push_back(
        fmt::format("left out: triangles in contact in the reference pose and {} rings of neighbours, {} of "
                    "the fixed body and {} "
                    "of the mobile one",
                    overlap.leave_out_reference_contacts->rings, range.left_out().fixed_triangles,
                    range.left_out().mobile_triangles));
  if (overlap.reference_contact == ReferenceContact::accept)
    terms.emplace_back("contact in the reference pose is accepted: motions that start in contact say so");
  return terms;
}

std::string term_of_held(const Vec3& translation_mm) {
  return fmt::format(
      "translation held at x {:g}, y {:g}, z {:g} mm: the mobile body turns about its own origin",
      translation_mm.x() + 0.0, translation_mm.y() + 0.0, translation_mm.z() + 0.0);
}

}  // namespace condyle
