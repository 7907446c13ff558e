#include "figures.hpp"

/// As cli/figures.cpp: the Python module, which draws figures, was never built for Windows.

namespace condyle::cli {

std::string draw_figures(const std::vector<std::string>&) {
  return "there is no condyle.plot for Windows";
}

}  // namespace condyle::cli
