#pragma once

#include <optional>
#include <string>

namespace condyle::io {

/// The value of an environment variable, empty if it is not set. A page has none.
std::optional<std::string> environment_variable(const std::string& name);

}  // namespace condyle::io
