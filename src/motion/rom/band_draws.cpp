#include <algorithm>
#include <cmath>
#include <random>
#include <string>

#include "condyle/error.hpp"
#include "core/exponential.hpp"
#include "motion/rom/displacement.hpp"

namespace condyle::motion {

std::span<const SurfaceOrigin> surface_origins() noexcept {
  // A root mean square against the bone itself, taken for the standard deviation of one bone's surface: as if all of it went together.
  static constexpr SurfaceOrigin origins[] = {
      {"ct", 0.84, "CT segmented by people",
       "Soodmand 2018: nine models of a femur by seven groups, against an optical scan, at the neck"},
      {"ct_network", 0.90, "CT segmented by a network",
       "as ct, and 0.33 from people's, of whom 95 % lie within 0.65 mm: Kuiper 2022"},
      {"mr", 0.98, "MR", "Stephen 2020: 12 femora against structured light"},
      {"radiographs", 1.6, "a shape model fitted to radiographs",
       "doi 10.1186/s12938-023-01093-z: whole femora against CT"},
      {"design", 0, "a design", "by definition; what is made of it is off by its tolerances"},
  };
  return origins;
}
namespace {

/// At some milliseconds each the most are an hour, and percentiles have long settled.
constexpr std::size_t fewest_samples = 20, most_samples = 100'000;

/// Three for the centre, three for the axes, one for each surface.
constexpr std::size_t dimensions = 8;

/// Numbers in [0, 1) of the generator's upper 53 bits: std::uniform_real_distribution may differ between libraries.
class Uniform {
 public:
  explicit Uniform(std::uint64_t seed) : bits_(seed) {}
  double operator()() { return static_cast<double>(bits_() >> 11) * 0x1p-53; }
  std::size_t below(std::size_t count) {
    return std::min(static_cast<std::size_t>((*this)() * static_cast<double>(count)), count - 1);
  }

 private:
  std::mt19937_64 bits_;
};

}  // namespace

std::vector<Displacement> displacements(const BandOptions& options, std::size_t parameters) {
  const std::size_t count = options.samples;
  Uniform uniform(options.seed);
  std::vector<std::vector<double>> standard(count, std::vector<double>(dimensions + parameters));
  std::vector<std::size_t> stratum(count);
  for (std::size_t k = 0; k < dimensions + parameters; ++k) {
    for (std::size_t i = 0; i < count; ++i) stratum[i] = i;
    for (std::size_t i = count; i-- > 1;) std::swap(stratum[i], stratum[uniform.below(i + 1)]);
    for (std::size_t i = 0; i < count; ++i) {
      // Within the stratum, clear of 0 and 1.
      const double u =
          (static_cast<double>(stratum[i]) + 0.005 + 0.99 * uniform()) / static_cast<double>(count);
      standard[i][k] = core::normal_quantile(u);
    }
  }
  const Uncertainty& sigma = options.sigma;
  std::vector<Displacement> out;
  for (const auto& z : standard)
    out.push_back({sigma.centre_mm * Vec3(z[0], z[1], z[2]),
                   sigma.axes.radians() * Vec3(z[3], z[4], z[5]),
                   z[6],
                   z[7],
                   {z.begin() + dimensions, z.end()}});
  return out;
}

double quantile(const std::vector<double>& sorted, double q) {
  const double at = q * static_cast<double>(sorted.size() - 1);
  const auto low = static_cast<std::size_t>(at);
  const std::size_t high = std::min(low + 1, sorted.size() - 1);
  return sorted[low] + (at - static_cast<double>(low)) * (sorted[high] - sorted[low]);
}

void check_band(const BandOptions& options) {
  if (options.samples < fewest_samples || options.samples > most_samples)
    throw UsageError("band: " + std::to_string(fewest_samples) + " samples or more are needed, up to " +
                     std::to_string(most_samples) + ", not " + std::to_string(options.samples));
  const auto bad = [](double sigma) { return !(sigma >= 0) || !std::isfinite(sigma); };
  const Uncertainty& sigma = options.sigma;
  if (bad(sigma.centre_mm) || bad(sigma.axes.radians()) || bad(sigma.surface_mm) || bad(sigma.surface_voxels))
    throw UsageError("band: standard deviations must be 0 or more");
}

}  // namespace condyle::motion
