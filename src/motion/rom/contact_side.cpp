#include <cmath>

#include "condyle/range_of_motion.hpp"
#include "core/trigonometry.hpp"

namespace condyle::motion {

std::string_view name_of(ContactSide side) noexcept {
  switch (side) {
    case ContactSide::superior:
      return "superior";
    case ContactSide::anterior:
      return "anterior";
    case ContactSide::inferior:
      return "inferior";
    case ContactSide::posterior:
      return "posterior";
  }
  return "";
}

std::optional<ContactSide> contact_side(const Joint& joint, const MotionLimit& limit) noexcept {
  constexpr double least_aside = 0.5;  // the sine of 30 degrees
  const auto& contact = limit.end.contact;
  if (joint.anatomy != Anatomy::shoulder || !contact || contact->kind == ContactKind::bearing)
    return std::nullopt;
  const Vec3 from_centre = contact->fixed_point - limit.translation_mm.value_or(Vec3::Zero());
  const double x = from_centre.x(), y = from_centre.y();
  if (!(core::hypotenuse(x, y) >= least_aside * from_centre.norm()) || from_centre.isZero())
    return std::nullopt;
  if (std::abs(y) >= std::abs(x)) return y > 0 ? ContactSide::superior : ContactSide::inferior;
  return x > 0 ? ContactSide::anterior : ContactSide::posterior;
}

}  // namespace condyle::motion
