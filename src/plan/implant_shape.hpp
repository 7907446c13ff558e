#pragma once

#include "condyle/implant.hpp"

namespace condyle::plan {

/// Unit axes through the centre, in the joint frame at zero angles: out of the liner's opening, and along the neck away from the head.
struct ImplantAxes {
  Vec3 liner, neck;
};
ImplantAxes axes_of(const Implant& implant, Side side);

/// From the centre of the head along the neck to the plane in which neck and stem meet.
double neck_end_mm(const TotalHip& hip);

/// From there on to where the neck's axis meets the stem's: in so much the stem bends.
double stem_bend_mm(const TotalHip& hip);

/// The least that is left for the bend, mm: with less its inside would fold, for stems and angles within their ranges.
inline constexpr double least_stem_bend_mm = 12;

}  // namespace condyle::plan
