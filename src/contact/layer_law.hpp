#pragma once

#include "condyle/pressure.hpp"

namespace condyle::contact {

/// One layer, or none if the thickness is 0.
struct LayerHere {
  double modulus;  ///< confined, MPa
  double thickness;
};

/// The answer of one or two layers, one on the other, to an overlap.
struct LayerAnswer {
  double pressure;  ///< MPa
  double slope;     ///< of the pressure over the overlap, MPa / mm
  double energy;    ///< per area: integral of the pressure over the overlap, N / mm
  double strain;    ///< the overlap over the thickness of both layers
};

/// For an overlap above 0, and below the sum of thicknesses with the logarithmic law. Both layers carry one pressure:
///
///     linear        d = p (h1 / M1 + h2 / M2)
///     logarithmic   d = h1 (1 - exp(-p / M1)) + h2 (1 - exp(-p / M2))
LayerAnswer answer_of(PressureLaw law, const LayerHere& a, const LayerHere& b, double overlap) noexcept;

}  // namespace condyle::contact
