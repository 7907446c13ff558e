#pragma once

#include "condyle/angle.hpp"

namespace condyle::io {

/// The degrees that an angle was given in, where those had 15 digits or fewer: an Angle is in radians, and degrees that
/// come back from there may differ in the last digit (30 comes back as 29.999999999999996). Else degrees(). Never -0.
double given_degrees(Angle angle);

}  // namespace condyle::io
