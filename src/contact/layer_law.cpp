#include "contact/layer_law.hpp"

#include "core/exponential.hpp"

namespace condyle::contact {
namespace {

/// The pressure at which the layers give way by d. What gives way is concave in p, so Newton's steps from the linear law's
/// pressure, which is below, rise to it and never pass it.
double logarithmic_pressure(const LayerHere& a, const LayerHere& b, double d) noexcept {
  if (b.thickness == 0) return -a.modulus * core::logarithm_of_1_and(-d / a.thickness);
  if (a.thickness == 0) return -b.modulus * core::logarithm_of_1_and(-d / b.thickness);
  if (a.modulus == b.modulus) return -a.modulus * core::logarithm_of_1_and(-d / (a.thickness + b.thickness));
  double p = d / (a.thickness / a.modulus + b.thickness / b.modulus);
  for (int step = 0; step < 200; ++step) {
    const double given = -a.thickness * core::exponential_less_1(-p / a.modulus) -
                         b.thickness * core::exponential_less_1(-p / b.modulus);
    const double slope = a.thickness / a.modulus * core::exponential(-p / a.modulus) +
                         b.thickness / b.modulus * core::exponential(-p / b.modulus);
    const double next = p + (d - given) / slope;
    if (!(next > p)) break;
    p = next;
  }
  return p;
}

}  // namespace

LayerAnswer answer_of(PressureLaw law, const LayerHere& a, const LayerHere& b, double d) noexcept {
  const double strain = d / (a.thickness + b.thickness);
  if (law == PressureLaw::linear) {
    const double compliance =
        (a.thickness > 0 ? a.thickness / a.modulus : 0) + (b.thickness > 0 ? b.thickness / b.modulus : 0);
    return {d / compliance, 1 / compliance, d * d / (2 * compliance), strain};
  }
  const double p = logarithmic_pressure(a, b, d);
  double softness = 0, complementary = 0;  // d(d)/dp, and the integral of d over p
  for (const LayerHere& layer : {a, b}) {
    if (layer.thickness == 0) continue;
    softness += layer.thickness / layer.modulus * core::exponential(-p / layer.modulus);
    complementary += layer.thickness * (p + layer.modulus * core::exponential_less_1(-p / layer.modulus));
  }
  return {p, 1 / softness, p * d - complementary, strain};
}

}  // namespace condyle::contact
