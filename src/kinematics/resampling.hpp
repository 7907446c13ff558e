#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <map>
#include <random>
#include <vector>

#include "condyle/mesh.hpp"

/// How far a fit moves when other parts of the same surface are fitted: the bootstrap, over blocks of neighbouring
/// vertices. Residuals of a bone's surface go together over millimetres: vertices drawn one by one would count the same
/// bump many times and promise too much (Künsch 1989, for time series; blocks are patches here).

namespace condyle::kinematics {

/// Enough for the 95 % point to be two draws from the end; more would not change which decimal it is in.
constexpr std::size_t usual_resamples = 50;
constexpr std::uint64_t resampling_seed = 1;

struct Resamples {
  std::vector<std::vector<Index>> draws;  ///< vertices, with repetitions
  /// With few blocks what is drawn from them spreads less than the surfaces they stand for: the root of blocks over
  /// blocks less unknowns.
  double widening;
};

/// As many blocks as there are, each drawn at random: the same draws for the same input, everywhere.
/// `block_of(vertex)` numbers blocks in any way; the fit has so many `unknowns`.
template <class BlockOf>
Resamples resampled(const std::vector<Index>& vertices, std::size_t count, std::size_t unknowns,
                    const BlockOf& block_of) {
  std::map<std::int64_t, std::vector<Index>> by_number;
  for (const Index v : vertices) by_number[block_of(v)].push_back(v);
  std::vector<const std::vector<Index>*> blocks;
  for (const auto& numbered : by_number) blocks.push_back(&numbered.second);
  const std::size_t redundant = blocks.size() > unknowns ? blocks.size() - unknowns : 1;
  Resamples out{std::vector<std::vector<Index>>(count),
                std::sqrt(static_cast<double>(blocks.size()) / static_cast<double>(redundant))};
  std::mt19937_64 random(resampling_seed);
  for (std::vector<Index>& drawn : out.draws)
    for (std::size_t k = 0; k < blocks.size(); ++k) {
      const auto& block = *blocks[random() % blocks.size()];
      drawn.insert(drawn.end(), block.begin(), block.end());
    }
  return out;
}

/// The 95 % point of how far the fits moved.
inline double upper_bound_of(std::vector<double> changes) {
  const auto at = changes.begin() + static_cast<std::ptrdiff_t>((95 * changes.size() - 1) / 100);
  std::nth_element(changes.begin(), at, changes.end());
  return *at;
}

}  // namespace condyle::kinematics
