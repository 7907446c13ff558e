#pragma once

#include <CLI/App.hpp>

namespace condyle::cli {

/// `condyle sample replacement` and `condyle sample reverse-shoulder`.
void add_sample_implants(CLI::App& sample);

}  // namespace condyle::cli
