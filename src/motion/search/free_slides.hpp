#pragma once

#include "condyle/first_contact.hpp"
#include "motion/search/translation_contacts.hpp"

/// Free slides of bodies of which one is asked about often.

namespace condyle::motion {

/// free_slides() within a range, with the fixed body in the frame of the direction already. An end of the range ends an interval without a
/// contact.
FreeSlides free_slides(const Mesh& fixed, const SlidingBody& placed_fixed, const Mesh& mobile,
                       const AxisFrame& frame, const Pose& X_FM, const SlideRange& range);

/// What is free of both.
FreeSlides free_in_both(const FreeSlides& a, const FreeSlides& b);

}  // namespace condyle::motion
