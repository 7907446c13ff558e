#include "contact/layer_law.hpp"
#include "support/test.hpp"

namespace condyle::contact {
namespace {

const ElasticLayer thick_cartilage{10, 0.45, 6.0};
const double modulus = thick_cartilage.confined_modulus_mpa();
const LayerHere nothing{0, 0};

TEST(LayerLaw, ConfinedModulusOfCartilage) {
  EXPECT_NEAR(modulus, 37.931034482758620, 1e-13);
}

TEST(LayerLaw, LogarithmicPressuresOfSixMillimetres) {
  // -M ln(1 - d / h); printed to six decimals in docs/mathematics/08-known-answers.md.
  const double known[][2] = {{0.2, 1.285921}, {0.5, 3.300432}, {1, 6.915645}, {2, 15.379711}};
  for (const auto& [d, p] : known) {
    const double pressure = answer_of(PressureLaw::logarithmic, {modulus, 6}, nothing, d).pressure;
    EXPECT_NEAR(pressure, p, 0.5e-6);
    EXPECT_NEAR(pressure, -modulus * std::log(1 - d / 6), 1e-12 * pressure);
  }
}

TEST(LayerLaw, TwoEqualLayersAreOneOfBothThicknesses) {
  for (const auto law : {PressureLaw::linear, PressureLaw::logarithmic}) {
    for (const double d : {1e-6, 0.3, 2.0, 5.9}) {
      const auto one = answer_of(law, {modulus, 6}, nothing, d),
                 two = answer_of(law, {modulus, 2}, {modulus, 4}, d);
      EXPECT_NEAR(one.pressure, two.pressure, 1e-12 * one.pressure);
      EXPECT_NEAR(one.slope, two.slope, 1e-12 * one.slope);
      EXPECT_NEAR(one.energy, two.energy, 1e-10 * one.energy + 1e-15);
      // Nearly equal ones take the other way, by Newton's method.
      const auto nearly = answer_of(law, {modulus, 2}, {modulus * (1 + 1e-12), 4}, d);
      EXPECT_NEAR(one.pressure, nearly.pressure, 1e-10 * one.pressure);
    }
  }
}

TEST(LayerLaw, BothLayersCarryOnePressureAndGiveWayTogether) {
  const LayerHere soft{5, 2}, stiff{40, 3};
  for (const double d : {0.01, 0.5, 2.0, 4.5, 4.999}) {
    const auto answer = answer_of(PressureLaw::logarithmic, soft, stiff, d);
    const auto gives = [&](const LayerHere& layer) {
      return layer.thickness * (1 - std::exp(-answer.pressure / layer.modulus));
    };
    EXPECT_NEAR(gives(soft) + gives(stiff), d, 1e-13 * 5) << d;
  }
  EXPECT_NEAR(answer_of(PressureLaw::linear, soft, stiff, 0.5).pressure, 0.5 / (2.0 / 5 + 3.0 / 40), 1e-15);
}

TEST(LayerLaw, SlopeAndEnergyAreDerivativeAndIntegral) {
  for (const auto law : {PressureLaw::linear, PressureLaw::logarithmic}) {
    for (const LayerHere& second : {nothing, LayerHere{40, 3}}) {
      const LayerHere first{5, 2};
      const double d = 1.2, step = 1e-5;
      const auto low = answer_of(law, first, second, d - step), here = answer_of(law, first, second, d),
                 high = answer_of(law, first, second, d + step);
      // Central differences err by step^2 / 6 of the third derivative, which is below 1e3 here, and by rounding.
      EXPECT_NEAR((high.pressure - low.pressure) / (2 * step), here.slope, 1e-7 * here.slope);
      EXPECT_NEAR((high.energy - low.energy) / (2 * step), here.pressure, 1e-7 * here.pressure);
    }
  }
}

}  // namespace
}  // namespace condyle::contact
