#pragma once

#include <filesystem>

#include "experiment.hpp"

namespace bench {

/// Writes into the folder, which exists, as far as there are outcomes for them:
///   cost_QUESTION.svg       cost of a pose against the size of the sample bones, with the fitted exponents
///   accuracy_QUESTION.svg   share of wrong answers against cost, real bones; none where nobody is wrong
void write_plots(const ExperimentResult& result, const std::filesystem::path& folder);

}  // namespace bench
