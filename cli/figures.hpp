#pragma once

#include <string>
#include <vector>

namespace condyle::cli {

/// Runs `python3 -m condyle.plot` with these words, by the first Python that has matplotlib and the module; what it refuses stands on
/// standard error. Returns why nothing was drawn, in one line; empty if it was.
std::string draw_figures(const std::vector<std::string>& words);

}  // namespace condyle::cli
